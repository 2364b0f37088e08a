//! Friction that runs in, wear of both bodies, coatings: from next to none to far too much of each.

use super::{Add, FORCE, Outcome, SEED, life, standard, wearing};
use crate::judge::Judge;
use fretting_contact::{Interface, Parameters, Summit};

pub(super) fn joints(add: Add) {
    // a stroke of the standard life dissipates some 1e-4 J
    for energy in [1e-30, 1e-9, 1e-4, 1.0, 1e30] {
        for (start, end) in [(0.1, 0.9), (0.9, 0.1), (1e-6, 1e3)] {
            let parameters = Parameters {
                friction_coefficient: start,
                friction_coefficient_final: end,
                running_in_energy: energy,
                ..Parameters::default()
            };
            let run = move |j: &mut Judge| standard(j, &parameters, FORCE);
            add("running in", format!("over {energy:e} J from {start} to {end}"), Box::new(run));
        }
    }
    for share in [1e-30, 0.5, 1.0 - 1e-12] {
        let run = move |j: &mut Judge| {
            let (one, _) = wearing(&Parameters::default(), FORCE, SEED)?;
            let parameters = Parameters {
                wear_coefficient: (1.0 - share) * one.wear_coefficient,
                wear_coefficient_2: share * one.wear_coefficient,
                hardness_2: one.hardness,
                ..one
            };
            life(j, &parameters, FORCE, SEED)
        };
        add("both bodies wear", format!("{share:e} of it off body 2"), Box::new(run));
    }
    for thickness in [1e-30, 1e-9, 1e30] {
        let parameters = Parameters { coating_thickness: thickness, ..Parameters::default() };
        let run = move |j: &mut Judge| standard(j, &parameters, FORCE);
        add("coating", format!("{thickness:e} m"), Box::new(run));
    }
    for (count, step) in [(1, 0.0), (50, 1e-9), (50, 1e-6)] {
        let run = move |j: &mut Judge| interface(j, count, step);
        add("many contacts", format!("{count}, offsets in steps of {step:e} m"), Box::new(run));
    }
}

/// An interface under a load that swings, against the laws that hold for the whole.
fn interface(judge: &mut Judge, count: u32, step: f64) -> Outcome {
    let (parameters, amplitude) = wearing(&Parameters::default(), FORCE, SEED)?;
    let per_work = parameters.wear_per_work();
    let friction = parameters.friction_coefficient;
    let summits: Vec<_> = (0..count).map(|k| Summit::at_offset(step * f64::from(k))).collect();
    let mut joint = Interface::new(parameters, &summits)?;
    let normal = FORCE * f64::from(count);
    joint.start_at(normal, [0.0; 2], 0.0)?;
    for k in 1..=40 {
        let phase = 0.4 * f64::from(k);
        let load = if k == 30 { 0.0 } else { normal * (1.0 + 0.5 * phase.cos()) };
        joint.advance_to(load, [amplitude * phase.sin(), 0.0], 0.0)?;
        let bound = friction * load;
        judge.note("|T| over mu F_N", joint.tangential_force().abs() - bound, 1e-9 * normal);
        judge.note("force that the contacts miss", (joint.normal_reaction() - load).abs(), 1e-9 * normal);
    }
    let work = per_work * joint.dissipated_energy();
    judge.note("volume = (k/s0) work", (joint.wear_volume() - work).abs(), 1e-9 * work);
    Ok(())
}
