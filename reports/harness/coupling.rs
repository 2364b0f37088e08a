//! The section on stiff systems of the stability page, from what the masters came to.

#[path = "masters.rs"]
mod masters;

use fretting_contact::Error;
use masters::{Limit, MASSES, Master, RATIOS, Row, STIFFNESSES, comparison, explicit_limits};
use std::fmt::Write as _;

/// What the masters came to.
pub(crate) struct Coupling {
    limits: Vec<Limit>,
    rows: Vec<Row>,
}

impl Coupling {
    /// Runs them all.
    pub(crate) fn run() -> Result<Self, Error> {
        Ok(Self { limits: explicit_limits()?, rows: comparison(&RATIOS, &STIFFNESSES)? })
    }

    pub(crate) fn csv(&self) -> String {
        let mut text = String::from("master,k_over_2Ga,h_omega,stable,growth,work_error,force_error,calls\n");
        for row in &self.rows {
            let Row { master, ratio, stiffness, growth, work_error, force_error, calls } = row;
            let (name, stable) = (master.name(), row.stable());
            let _ = writeln!(
                text,
                "{name},{ratio},{stiffness},{stable},{growth:e},{work_error:e},{force_error:e},{calls}"
            );
        }
        text
    }

    /// The largest deviation of a limit that was found from 2/ω, relative.
    fn off(&self) -> f64 {
        self.limits.iter().map(|limit| (limit.step / limit.theory - 1.0).abs()).fold(0.0, f64::max)
    }

    pub(crate) fn section(&self) -> String {
        let stable = |master: Master| {
            let rows = self.rows.iter().filter(|row| row.master == master);
            let (mut stable, mut all, mut worst) = (0, 0, 0.0_f64);
            for row in rows {
                all += 1;
                stable += u32::from(row.stable());
                worst = if row.stable() { worst.max(row.work_error.abs()) } else { worst };
            }
            format!("{stable} of {all} stable, work within {:.1} %", 100.0 * worst)
        };
        let mut text = format!(
            "## As a part of a stiff system\n\nA mass m on a spring k, driven by its far end, with the contact between mass and ground, in steps of h; \
             ω² = (k + 2G*a)/m. All masters update the velocity first and give the contact the new position. **Explicit coupling is then stable up to h = 2/ω and no further**: found within {:.0e} of that for k from {:e} to {:e} \
             times 2G*a and m from {:e} to {:e} kg. **With the derivative that the contact gives, the implicit masters are stable at any step.** \
             Without it, k at the end of the step and T at its start (half-explicit), one is stable only for h² (2G*a − k)/m < 4.\n\n| master | contact steps a step | {} systems, hω from {} to {} |\n| --- | --- | --- |\n",
            self.off(),
            RATIOS[0],
            RATIOS[RATIOS.len() - 1],
            MASSES[0],
            MASSES[MASSES.len() - 1],
            RATIOS.len() * STIFFNESSES.len(),
            STIFFNESSES[0],
            STIFFNESSES[STIFFNESSES.len() - 1],
        );
        for master in Master::ALL {
            let calls = self.rows.iter().filter(|row| row.master == master).map(|row| row.calls);
            let most = calls.fold(0.0, f64::max);
            let _ = writeln!(text, "| {} | {most:.1} at most | {} |", master.name(), stable(master));
        }
        text += "\n![Work of friction against that of a fine iterative run](coupling.png)\n\nIn every run the step is 1/200 of the period of the drive; hω grows because \
                 the mass is made smaller. With less inertia the motion comes closer to the static answer to the drive, which the implicit masters \
                 solve exactly at each step. So their error falls as hω grows.\n\nError of the work of friction in the last of three periods, \
                 against the iterative master with 20 times finer steps, by hω:\n\n";
        let heads = STIFFNESSES.map(|stiffness| stiffness.to_string()).join(" | ");
        let _ =
            writeln!(text, "| master | k/(2G*a) | {heads} |\n|{}", " --- |".repeat(STIFFNESSES.len() + 2));
        for master in Master::ALL {
            for ratio in RATIOS {
                let rows = self.rows.iter().filter(|row| row.master == master && row.ratio == ratio);
                let cells: Vec<String> = rows
                    .map(|row| {
                        if row.stable() { format!("{:.1e}", row.work_error.abs()) } else { "unstable".into() }
                    })
                    .collect();
                let _ = writeln!(text, "| {} | {ratio:e} | {} |", master.name(), cells.join(" | "));
            }
        }
        text.push('\n');
        text
    }
}
