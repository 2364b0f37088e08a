//! Inputs and parameters at the ends of double precision, and of what is taken.

use super::{Add, FORCE, full_slip, pair, pressed, without_wear};
use crate::judge::{CLOSED, Judge};
use fretting_contact::{Parameters, Profile};

/// A ball that is pressed and pushed once at constant load: T is known.
pub(super) fn pushes(add: Add) {
    let of_radius = |radius| Parameters { profile: Profile::Parabola { radius }, ..without_wear() };
    let of_young = |young| Parameters { materials: pair(young, 0.3), ..without_wear() };
    for (extreme, parameters, force, share) in [
        ("0.6 u_max", without_wear(), FORCE, 0.6),
        ("1e-8 u_max", without_wear(), FORCE, 1e-8),
        ("1e-12 u_max", without_wear(), FORCE, 1e-12),
        ("1e-17 u_max", without_wear(), FORCE, 1e-17),
        ("1e-30 u_max", without_wear(), FORCE, 1e-30),
        ("1e-300 u_max", without_wear(), FORCE, 1e-300),
        ("1e300 N, 0.6 u_max", without_wear(), 1e300, 0.6),
        ("1e300 N, 1e-206 u_max", without_wear(), 1e300, 1e-206),
        ("1e60 N, 0.6 u_max", without_wear(), 1e60, 0.6),
        ("1e-300 N, 0.6 u_max", without_wear(), 1e-300, 0.6),
        ("R = 1e-300 m, 0.6 u_max", of_radius(1e-300), FORCE, 0.6),
        ("R = 1e300 m, 0.6 u_max", of_radius(1e300), FORCE, 0.6),
        ("R = 1e-30 m, 0.6 u_max", of_radius(1e-30), FORCE, 0.6),
        ("R = 1e30 m, 0.6 u_max", of_radius(1e30), FORCE, 0.6),
        ("E = 1e30 Pa, 0.6 u_max", of_young(1e30), FORCE, 0.6),
        ("E = 1e-30 Pa, 0.6 u_max", of_young(1e-30), FORCE, 0.6),
        ("E = 1e300 Pa, 0.6 u_max", of_young(1e300), FORCE, 0.6),
        ("E = 1e-290 Pa, 0.6 u_max", of_young(1e-290), FORCE, 0.6),
    ] {
        let run = move |j: &mut Judge| {
            let mut contact = pressed(&parameters, force)?;
            let place = share * full_slip(&contact);
            j.step(&mut contact, |c| c.advance_to(force, place))?;
            // T = μF_N [1 − (1 − θ)^(3/2)], without cancellation
            let limit = parameters.friction_coefficient * force;
            let reference = -limit * (1.5 * (-share).ln_1p()).exp_m1();
            j.note("T of a first push", (contact.tangential_force() / reference - 1.0).abs(), CLOSED);
            Ok(())
        };
        add("push from rest", extreme.into(), Box::new(run));
    }
}

pub(super) fn inputs(add: Add) {
    for (extreme, force, displacement) in [
        ("force 5e-324 N", 5e-324, 1e-6),
        ("force 1e-300 N", 1e-300, 1e-6),
        ("force 1e300 N", 1e300, 1e-6),
        ("displacement 5e-324 m", FORCE, 5e-324),
        ("displacement 1e300 m", FORCE, 1e300),
        ("both 1e300", 1e300, 1e300),
        ("force 1e60 N", 1e60, 1e-6),
        ("displacement 1e60 m", FORCE, 1e60),
    ] {
        for (kind, parameters) in [("no wear", without_wear()), ("wear", Parameters::default())] {
            let run = move |j: &mut Judge| {
                let mut contact = pressed(&parameters, FORCE)?;
                for place in [displacement, -displacement, 0.0] {
                    j.step(&mut contact, |c| c.advance_to(force, place))?;
                }
                j.step(&mut contact, |c| c.advance_cycles(FORCE, 1e-6, 1.0))
            };
            add("input", format!("{extreme}, {kind}"), Box::new(run));
        }
    }
    for (extreme, amplitude, cycles) in [
        ("amplitude 1e300 m", 1e300, 1.0),
        ("amplitude 5e-324 m", 5e-324, 1e6),
        ("1e300 cycles", 1e-6, 1e300),
        ("1e30 cycles", 1e-6, 1e30),
    ] {
        let run = move |j: &mut Judge| {
            let mut contact = pressed(&Parameters::default(), FORCE)?;
            j.step(&mut contact, |c| c.advance_cycles(FORCE, amplitude, cycles))
        };
        add("input", extreme.into(), Box::new(run));
    }
}

pub(super) fn parameters(add: Add) {
    let usual = Parameters::default;
    for (extreme, parameters) in [
        ("wear coefficient 1e300", Parameters { wear_coefficient: 1e300, ..usual() }),
        ("wear coefficient 5e-324", Parameters { wear_coefficient: 5e-324, ..usual() }),
        ("hardness 1e-300 Pa", Parameters { hardness: 1e-300, ..usual() }),
        ("E = 1e300 Pa", Parameters { materials: pair(1e300, 0.3), ..usual() }),
        ("E = 1e-300 Pa", Parameters { materials: pair(1e-300, 0.3), ..usual() }),
        ("wear coefficient 1e30", Parameters { wear_coefficient: 1e30, ..usual() }),
        ("hardness 1e-30 Pa", Parameters { hardness: 1e-30, ..usual() }),
        ("hardness 1e30 Pa", Parameters { hardness: 1e30, ..usual() }),
        ("E = 1e30 Pa", Parameters { materials: pair(1e30, 0.3), ..usual() }),
        ("E = 1e-30 Pa", Parameters { materials: pair(1e-30, 0.3), ..usual() }),
        ("R = 1e30 m", Parameters { profile: Profile::Parabola { radius: 1e30 }, ..usual() }),
        ("R = 1e-30 m", Parameters { profile: Profile::Parabola { radius: 1e-30 }, ..usual() }),
        ("R = 1e300 m", Parameters { profile: Profile::Parabola { radius: 1e300 }, ..usual() }),
        ("R = 1e-300 m", Parameters { profile: Profile::Parabola { radius: 1e-300 }, ..usual() }),
    ] {
        let run = move |j: &mut Judge| {
            let mut contact = pressed(&parameters, FORCE)?;
            for place in [1e-6, -1e-6] {
                j.step(&mut contact, |c| c.advance_to(FORCE, place))?;
            }
            j.step(&mut contact, |c| c.advance_cycles(FORCE, 1e-6, 1.0))
        };
        add("parameter", extreme.into(), Box::new(run));
    }
}
