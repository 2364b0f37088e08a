//! extra/org.fmi-standard.fmi-ls-ref/: experiments with reference results (FMI layered standard
//! References, 1.0.0-beta.1), to test that an importer runs the FMU correctly.
//!
//! The results of validation are closed forms, not what the FMU computes: Mindlin's loop, and the
//! final state of wear at constant depth. Start values are those of modelDescription.xml. The smoke
//! test has results of the FMU itself.

use crate::smoke_test;
use anyhow::{Context, Result};
use roxmltree::Document;
use std::collections::BTreeMap;
use std::fmt::Write;

/// Where the files go in the FMU.
pub(crate) const FOLDER: &str = "extra/org.fmi-standard.fmi-ls-ref";

const MANIFEST: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<fmiReferences xmlns:fmi-ls="http://fmi-standard.org/fmi-ls-manifest"
    fmi-ls:fmi-ls-name="org.fmi-standard.fmi-ls-ref"
    fmi-ls:fmi-ls-version="1.0.0-beta.1"
    fmi-ls:fmi-ls-description="Layered Standard providing information on related files included in an FMU.">
  <Related type="application/x-ma-hs-experiments" source="closed-forms.exp" role="experiment/validation" description="A friction loop and a life of wear with their closed forms"/>
  <Related type="text/csv" source="loop-ref.csv" role="result" description="Force in a friction loop by Mindlin's formulas"/>
  <Related type="text/csv" source="life-ref.csv" role="result" description="Final state of wear at constant depth"/>
  <Related type="application/x-ma-hs-experiments" source="smoke-test.exp" role="experiment/smoke-test" description="The default experiment"/>
  <Related type="text/csv" source="default-ref.csv" role="result" description="Results of the FMU in the default experiment"/>
  <Related type="text/html" source="../../documentation/index.html" role="document" description="Model, limits of validity, variables"/>
</fmiReferences>
"#;

const EXPERIMENTS: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<Experiments name="Closed forms" description="Exact results of the model, from formulas and not from the FMU">
  <Experiment name="loop" description="Ball under constant load, moved back and forth in partial slip" startTime="0.0" stopTime="20.0" stepSize="1.0" tolerance="1e-6">
    <Stimuli source="loop-in.csv"/>
    <References source="loop-ref.csv"/>
  </Experiment>
  <Experiment name="life" description="Ball held in depth, worn by cycles until the wear ends" startTime="0.0" stopTime="1.0" stepSize="1.0" tolerance="0.005">
    <Parameters source="life.ssv"/>
    <Stimuli source="life-in.csv"/>
    <References source="life-ref.csv"/>
  </Experiment>
</Experiments>
"#;

const ABOUT: &str = "Reference results in extra/org.fmi-standard.fmi-ls-ref

closed-forms.exp has two experiments. The reference results are closed forms, not results of this FMU. An importer that
runs the FMU correctly reproduces them within the tolerance of each experiment, relative to the largest value of each
column.

loop   Steps of 1 s with nothing set. The displacement rises or falls for one second and rests for the next. The results stand at
       the ends of the rests, so that they hold for importers that set inputs at the start of a step as well as for those
       whose inputs reach their values at its end. Formulas: Mindlin and Deresiewicz (1953) for a sphere.
life   One step of 1 s and 1e7 cycles at constant indentation depth. The stick radius stays, and wear ends when the ring around it
       carries nothing: Popov (2014); Dimaki, Dmitriev, Chai, Popov (2014).

smoke-test.exp has the default experiment of modelDescription.xml with results of the FMU itself. It shows whether an importer runs
the FMU at all, and whether a later version computes the same.

default  Steps of 0.01 s. Load and displacement move for 0.05 s and rest for 0.05 s; the results stand at the ends of the rests.
";

/// Displacements at the rests of the loop, in units of that of full slip.
const LOOP: [f64; 10] = [0.3, 0.6, 0.8, 0.4, 0.0, -0.5, -0.8, -0.2, 0.5, 0.8];

/// Stick radius of the life, in contact radii, its worn volume in a² d and its final force in that
/// of the start (a parabola's).
const STICK: f64 = 0.4;
const LIFE_VOLUME: f64 = 1.131108;
const LIFE_FORCE: f64 = 0.568;

/// Names (below the archive's top) and contents.
pub(crate) fn files(description: &str) -> Result<BTreeMap<String, String>> {
    let ball = Ball::of(description)?;
    let (life_parameters, life_stimuli, life_results) = ball.life();
    let (stimuli, results) = ball.friction_loop();
    let in_folder = [
        ("fmi-ls-manifest.xml", MANIFEST.to_owned()),
        ("closed-forms.exp", EXPERIMENTS.to_owned()),
        ("loop-in.csv", stimuli),
        ("loop-ref.csv", results),
        ("life.ssv", life_parameters),
        ("life-in.csv", life_stimuli),
        ("life-ref.csv", life_results),
        ("smoke-test.exp", smoke_test::experiment(description)?),
        ("default-in.csv", smoke_test::STIMULI.to_owned()),
        ("default-ref.csv", smoke_test::RESULTS.to_owned()),
    ];
    let mut files: BTreeMap<_, _> =
        in_folder.into_iter().map(|(name, text)| (format!("{FOLDER}/{name}"), text)).collect();
    files.insert("documentation/fmi-ls-ref.txt".to_owned(), ABOUT.to_owned());
    Ok(files)
}

/// The contact that the FMU is with nothing set: a sphere on a flat.
struct Ball {
    force: f64,
    friction: f64,
    shear: f64,
    contact_radius: f64,
    depth: f64,
    full_slip: f64,
}

impl Ball {
    fn of(description: &str) -> Result<Self> {
        let document = Document::parse(description).context("modelDescription.xml is not well-formed")?;
        let start = |name: &str| -> Result<f64> {
            let variable = document.descendants().find(|node| node.attribute("name") == Some(name));
            let start = variable.and_then(|node| node.children().find_map(|type_| type_.attribute("start")));
            start
                .and_then(|text| text.parse().ok())
                .with_context(|| format!("modelDescription.xml has no start value of {name}"))
        };
        let body = |number: u8| -> Result<(f64, f64)> {
            let (young, poisson) =
                (start(&format!("youngs_modulus_{number}"))?, start(&format!("poisson_ratio_{number}"))?);
            let shear = young / (2.0 * (1.0 + poisson));
            Ok(((1.0 - poisson * poisson) / young, (2.0 - poisson) / (4.0 * shear)))
        };
        let (first, second) = (body(1)?, body(2)?);
        let (normal, shear) = (1.0 / (first.0 + second.0), 1.0 / (first.1 + second.1));
        let (radius, force, friction) =
            (start("radius")?, start("normal_force")?, start("friction_coefficient")?);
        let contact_radius = (0.75 * force * radius / normal).cbrt();
        let depth = contact_radius * contact_radius / radius;
        let full_slip = friction * depth * normal / shear;
        Ok(Self { force, friction, shear, contact_radius, depth, full_slip })
    }

    /// Tangential force on first loading to a displacement, in units of the friction limit and of
    /// that of full slip.
    fn first_loading(theta: f64) -> f64 {
        theta.signum() * (1.0 - (1.0 - theta.abs()).powf(1.5))
    }

    /// Stimuli and results: every branch after a reversal is the first, twice as large.
    fn friction_loop(&self) -> (String, String) {
        let mut stimuli = "time,tangential_displacement\n0.0,0.0\n".to_owned();
        let mut results =
            format!("time,tangential_force,contact_radius\n0.0,0.0,{:e}\n", self.contact_radius);
        let (mut turn, mut at_turn, mut last, mut direction) = (None, 0.0, 0.0, 1.0);
        for (k, &theta) in LOOP.iter().enumerate() {
            let side = f64::signum(theta - last);
            if side != direction {
                (at_turn, direction) = (Self::branch(turn, at_turn, last), side);
                turn = Some(last);
            }
            let force = self.friction * self.force * Self::branch(turn, at_turn, theta);
            let (rise, rest) = (2 * k + 1, 2 * k + 2);
            let displacement = theta * self.full_slip;
            for time in [rise, rest] {
                let _ = writeln!(stimuli, "{time}.0,{displacement:e}");
            }
            let _ = writeln!(results, "{rest}.0,{force:e},{:e}", self.contact_radius);
            last = theta;
        }
        (stimuli, results)
    }

    /// Force on the present branch. The reversals of [`LOOP`] have equal amplitudes, so that one is
    /// remembered.
    fn branch(turn: Option<f64>, at_turn: f64, theta: f64) -> f64 {
        match turn {
            None => Self::first_loading(theta),
            Some(turn) => at_turn + 2.0 * Self::first_loading(0.5 * (theta - turn)),
        }
    }

    /// Parameters, stimuli and results of the life.
    fn life(&self) -> (String, String, String) {
        let parameters = r#"<?xml version="1.0" encoding="UTF-8"?>
<ssv:ParameterSet xmlns:ssv="http://ssp-standard.org/SSP1/SystemStructureParameterValues" version="1.0" name="life">
  <ssv:Parameters>
    <ssv:Parameter name="loading"><ssv:Enumeration value="cyclic"/></ssv:Parameter>
    <ssv:Parameter name="normal_control"><ssv:Enumeration value="indentation"/></ssv:Parameter>
  </ssv:Parameters>
</ssv:ParameterSet>
"#;
        let amplitude = (1.0 - STICK * STICK) * self.full_slip;
        let names = "time,indentation,displacement_amplitude,frequency";
        let row = |time: u8| format!("{time}.0,{:e},{amplitude:e},1e7\n", self.depth);
        let stimuli = format!("{names}\n{}{}", row(0), row(1));
        let stick = STICK * self.contact_radius;
        let (volume, force) =
            (LIFE_VOLUME * self.contact_radius.powi(2) * self.depth, LIFE_FORCE * self.force);
        let results = format!(
            "time,wear_volume,stick_radius,normal_reaction,tangential_force\n1.0,{volume:e},{stick:e},{force:e},{:e}\n",
            2.0 * self.shear * stick * amplitude
        );
        (parameters.to_owned(), stimuli, results)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ball() -> Ball {
        let description = std::fs::read_to_string("../modelDescription.xml").unwrap();
        Ball::of(&description).unwrap()
    }

    /// Steel on steel, 10 mm, 100 N, μ = 0.6.
    #[test]
    fn the_contact_is_that_of_hertz() {
        let ball = ball();
        for (value, known) in
            [(ball.contact_radius, 186.626e-6), (ball.depth, 3.48291e-6), (ball.full_slip, 2.53755e-6)]
        {
            assert!((value / known - 1.0).abs() < 5e-6, "{value:e} {known:e}");
        }
    }

    #[test]
    fn the_loop_closes_and_is_odd() {
        let (_, results) = ball().friction_loop();
        let force = |row: usize| -> f64 {
            results.lines().nth(row + 1).unwrap().split(',').nth(1).unwrap().parse().unwrap()
        };
        let top = 60.0 * (1.0 - 0.2f64.powf(1.5));
        assert!((force(3) - top).abs() < 1e-9, "{}", force(3));
        assert!((force(7) + top).abs() < 1e-9, "{}", force(7));
        assert!((force(10) - top).abs() < 1e-9, "{}", force(10));
    }

    /// F∞ = 2E* ∫ (d − g) dx over the stick disc, and F₀ the same over the contact: (3/2) (s −
    /// s³/3), s = c/a.
    #[test]
    fn the_final_force_is_what_the_stick_disc_carries() {
        assert!((1.5 * (STICK - STICK.powi(3) / 3.0) - LIFE_FORCE).abs() < 1e-12);
        let (_, _, results) = ball().life();
        assert!(results.ends_with('\n') && results.lines().count() == 2, "{results}");
    }
}
