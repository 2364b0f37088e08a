//! Jumps of the load, chatter, and steps of displacement far beyond or below what slips.

use super::{Add, FORCE, SEED, full_slip, held_in_depth, pressed, wearing, without_wear};
use crate::judge::Judge;
use fretting_contact::Parameters;

pub(super) fn loads(add: Add) {
    for (extreme, loads) in
        [("1e9 up", [1e-7, FORCE]), ("1e9 down", [FORCE, 1e-7]), ("1e18 down", [1e9, 1e-9])]
    {
        for (kind, parameters) in [("no wear", without_wear()), ("wear", Parameters::default())] {
            let run = move |j: &mut Judge| {
                let (parameters, amplitude) = match kind {
                    "wear" => wearing(&parameters, FORCE, SEED)?,
                    _ => (parameters.clone(), 1e-6),
                };
                let mut contact = pressed(&parameters, loads[0])?;
                for k in 0..10 {
                    let place = if k % 4 < 2 { amplitude } else { -amplitude };
                    j.step(&mut contact, |c| c.advance_to(loads[(k + 1) % 2], place))?;
                }
                Ok(())
            };
            add("load jump in one step", format!("{extreme}, {kind}"), Box::new(run));
        }
    }
    for (extreme, parameters, press, lift) in [
        ("force", Parameters::default(), FORCE, -FORCE),
        ("force, to exactly 0", Parameters::default(), FORCE, 0.0),
        ("depth", held_in_depth(), 3.5e-6, -1e-6),
    ] {
        let run = move |j: &mut Judge| {
            let (parameters, amplitude) = wearing(&parameters, press, SEED)?;
            let mut contact = pressed(&parameters, press)?;
            for k in 0..100 {
                let place = amplitude * (2.7 * f64::from(k)).sin();
                j.step(&mut contact, |c| c.advance_to(if k % 2 == 0 { lift } else { press }, place))?;
            }
            Ok(())
        };
        add("chatter across separation", extreme.into(), Box::new(run));
    }
    for (extreme, share, steps) in [("1e6 u_max", 1e6, 6), ("1e-12 u_max", 1e-12, 2000)] {
        for (kind, parameters, load) in [
            ("no wear", without_wear(), FORCE),
            ("wear", Parameters::default(), FORCE),
            ("wear, depth held", held_in_depth(), 3.5e-6),
        ] {
            let run = move |j: &mut Judge| {
                let mut contact = pressed(&parameters, load)?;
                let way = share * full_slip(&contact);
                let mut place = 0.0;
                for k in 0..steps {
                    place += if k % 3 == 2 { -way } else { way };
                    j.step(&mut contact, |c| c.advance_to(load, place))?;
                }
                Ok(())
            };
            add("displacement step", format!("{extreme}, {kind}"), Box::new(run));
        }
    }
}
