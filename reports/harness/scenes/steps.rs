//! The same way in very many steps and in one; amplitudes that change; fineness of cells and time.

use super::{Add, FORCE, SEED, full_slip, held_in_depth, in_parts, pressed, standard, wearing, without_wear};
use crate::judge::Judge;
use fretting_contact::Parameters;

pub(super) fn tiny(add: Add) {
    for (steps, wears) in [(100_000, true), (1_000_000, true), (1_000_000, false), (10_000_000, false)] {
        let kind = if wears { "wear" } else { "no wear" };
        let run = move |j: &mut Judge| {
            let (parameters, amplitude) = wearing(&Parameters::default(), FORCE, SEED)?;
            let parameters = if wears { parameters } else { without_wear() };
            let mut one = pressed(&parameters, FORCE)?;
            let mut many = one.clone();
            let half = steps / 2;
            for (from, to) in
                [((FORCE, 0.0), (FORCE, amplitude)), ((FORCE, amplitude), (0.7 * FORCE, -amplitude))]
            {
                j.step(&mut one, |c| c.advance_to(to.0, to.1))?;
                in_parts(&mut many, from, to, half)?;
            }
            j.reset_work();
            j.state(&many);
            j.split(&one, &many);
            Ok(())
        };
        add("tiny steps against one", format!("{steps:e} steps, {kind}"), Box::new(run));
    }
    let run = |j: &mut Judge| {
        let (parameters, amplitude) = wearing(&Parameters::default(), FORCE, SEED)?;
        let mut one = pressed(&parameters, FORCE)?;
        let mut many = one.clone();
        j.step(&mut one, |c| c.advance_cycles(FORCE, amplitude, SEED))?;
        for _ in 0..2000 {
            many.advance_cycles(FORCE, amplitude, SEED / 2000.0)?;
        }
        j.split(&one, &many);
        Ok(())
    };
    add("tiny steps against one", "2000 parts of a cyclic life".into(), Box::new(run));
}

pub(super) fn amplitudes(add: Add) {
    for (extreme, shares) in [
        ("grows 1e-3 to 3 u_max", [1e-3, 1e-2, 0.1, 0.5, 0.9, 3.0]),
        ("shrinks 3 to 1e-3 u_max", [3.0, 0.9, 0.5, 0.1, 1e-2, 1e-3]),
        ("exactly u_max", [1.0; 6]),
        ("u_max (1 - 1e-12)", [1.0 - 1e-12; 6]),
        ("u_max (1 + 1e-12)", [1.0 + 1e-12; 6]),
    ] {
        for (kind, parameters, normal) in
            [("force", Parameters::default(), FORCE), ("depth", held_in_depth(), 3.5e-6)]
        {
            let run = move |j: &mut Judge| {
                let (parameters, _) = wearing(&parameters, normal, SEED)?;
                let mut contact = pressed(&parameters, normal)?;
                let full = full_slip(&contact);
                for share in shares {
                    j.step(&mut contact, |c| c.advance_cycles(normal, share * full, 0.1 * SEED))?;
                    for place in [-share, share] {
                        j.step(&mut contact, |c| c.advance_to(normal, place * full))?;
                    }
                }
                Ok(())
            };
            add("amplitude", format!("{extreme}, {kind}"), Box::new(run));
        }
    }
}

pub(super) fn fineness(add: Add) {
    for resolution in [8, 16, 32, 128, 256, 512] {
        let parameters = Parameters { resolution, ..Parameters::default() };
        add("resolution", resolution.to_string(), Box::new(move |j| standard(j, &parameters, FORCE)));
    }
    for tolerance in [0.1, 1e-2, 1e-4, 1e-6] {
        let parameters = Parameters { tolerance, ..Parameters::default() };
        add("tolerance", format!("{tolerance:e}"), Box::new(move |j| standard(j, &parameters, FORCE)));
    }
}
