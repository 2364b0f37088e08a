//! Wear far faster and far slower than usual.

use super::{Add, FORCE, SEED, held_in_depth, life, pressed, wearing};
use crate::judge::Judge;
use fretting_contact::Parameters;

pub(super) fn wear(add: Add) {
    for seed in [50.0, 20.0, 5.0, 1.0] {
        let run = move |j: &mut Judge| life(j, &Parameters::default(), FORCE, seed);
        add("fast wear", format!("N0 = {seed} cycles, loads vary"), Box::new(run));
    }
    for (extreme, parameters, normal, share) in [
        ("gross slip, force", Parameters::default(), FORCE, 5.0),
        ("gross slip, depth", held_in_depth(), 3.5e-6, 5.0),
        ("partial slip, force", Parameters::default(), FORCE, 1.0),
        ("partial slip, depth", held_in_depth(), 3.5e-6, 1.0),
    ] {
        let run = move |j: &mut Judge| {
            let (parameters, amplitude) = wearing(&parameters, normal, 0.02)?;
            let mut contact = pressed(&parameters, normal)?;
            for place in [share, -share, share, -share] {
                j.step(&mut contact, |c| c.advance_to(normal, place * amplitude))?;
            }
            Ok(())
        };
        add("one step wears more than d0", extreme.into(), Box::new(run));
    }
    for (extreme, parameters, normal, life) in [
        ("N/N0 = 100, force", Parameters::default(), FORCE, 100.0),
        ("N/N0 = 1e6, force", Parameters::default(), FORCE, 1e6),
        ("N/N0 = 100, depth", held_in_depth(), 3.5e-6, 100.0),
        ("N/N0 = 1e6, depth", held_in_depth(), 3.5e-6, 1e6),
    ] {
        let run = move |j: &mut Judge| {
            let (parameters, amplitude) = wearing(&parameters, normal, SEED)?;
            let mut contact = pressed(&parameters, normal)?;
            j.step(&mut contact, |c| c.advance_cycles(normal, amplitude, life * SEED))
        };
        add("a long life in one call", extreme.into(), Box::new(run));
    }
    for (extreme, seed, cycles) in [
        ("1e9 cycles of a life", 1e9, 1e9),
        ("1e9 cycles, 1e-12 of d0", 1e21, 1e9),
        ("1e15 cycles", 1e15, 1e15),
    ] {
        let run = move |j: &mut Judge| {
            let (parameters, amplitude) = wearing(&Parameters::default(), FORCE, seed)?;
            let mut contact = pressed(&parameters, FORCE)?;
            let mut many = contact.clone();
            j.step(&mut contact, |c| c.advance_cycles(FORCE, amplitude, cycles))?;
            for _ in 0..100 {
                many.advance_cycles(FORCE, amplitude, cycles / 100.0)?;
            }
            j.split(&contact, &many);
            Ok(())
        };
        add("slow wear", extreme.into(), Box::new(run));
    }
}
