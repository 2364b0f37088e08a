//! Elliptic contacts, from nearly round to the longest that are accepted, along both axes and in
//! the plane.

use super::{Add, FORCE, Outcome, full_slip, pair, pressed, split_in_plane, without_wear};
use crate::judge::Judge;
use fretting_contact::{Parameters, Profile};
use std::f64::consts::TAU;

/// Smaller radius, m.
const RADIUS: f64 = 0.004;

/// Steps of a circle.
const STEPS: u32 = 40;

pub(super) fn ellipse(add: Add) {
    for ratio in [1.0 + 1e-12, 1.1, 32.5, 1e4, 1e6] {
        for (axis, radii) in [("major", (ratio * RADIUS, RADIUS)), ("minor", (RADIUS, ratio * RADIUS))] {
            let parameters = elliptic(radii, without_wear());
            let (on_line, in_plane) = (parameters.clone(), parameters);
            let run = move |j: &mut Judge| loops(j, &on_line);
            add("ellipse", format!("R ratio {ratio:e}, loops along the {axis} axis"), Box::new(run));
            let run = move |j: &mut Judge| orbits(j, &in_plane);
            add("ellipse", format!("R ratio {ratio:e}, orbits, x along the {axis} axis"), Box::new(run));
        }
    }
    for poisson in [-0.99, 0.0, 0.5] {
        let materials = pair(210e9, poisson);
        let parameters = elliptic((0.13, RADIUS), Parameters { materials, ..without_wear() });
        let run = move |j: &mut Judge| orbits(j, &parameters);
        add("ellipse", format!("orbits, Poisson ratio {poisson}"), Box::new(run));
    }
    for ratio in [1e-6, 1.0, 1e6] {
        let run = move |j: &mut Judge| {
            let parameters = elliptic((0.13, RADIUS), without_wear());
            let bare = pressed(&parameters, FORCE)?;
            let rig_stiffness = ratio * bare.tangential_stiffness();
            orbits(j, &Parameters { rig_stiffness, ..parameters })
        };
        add("ellipse", format!("orbits behind a rig, {ratio:e} of the contact"), Box::new(run));
    }
    let run = |j: &mut Judge| split_in_plane(j, &elliptic((0.13, RADIUS), without_wear()));
    add("ellipse", "1000 steps against one".into(), Box::new(run));
}

fn elliptic((radius_x, radius_y): (f64, f64), parameters: Parameters) -> Parameters {
    Parameters { profile: Profile::Ellipse { radius_x, radius_y }, ..parameters }
}

/// Loops along x, then along y, with swings of load, contact lost and found, and many cycles in one
/// call.
fn loops(j: &mut Judge, parameters: &Parameters) -> Outcome {
    let mut contact = pressed(parameters, FORCE)?;
    let full = full_slip(&contact);
    for axis in 0..2 {
        for (load, place) in
            [(1.0, 0.6), (1.0, -0.6), (0.4, 0.2), (1.5, 0.9), (0.0, 0.3), (1.0, -1.4), (1.0, 1e6), (1.0, 0.0)]
        {
            let to = if axis == 0 { [place * full, 0.0] } else { [0.0, place * full] };
            j.step(&mut contact, |c| c.advance_to_planar(load * FORCE, to))?;
        }
    }
    j.step(&mut contact, |c| c.advance_cycles(FORCE, 0.7 * full, 1e9))
}

/// Orbits of three sizes under a load that stays and one that swings.
fn orbits(j: &mut Judge, parameters: &Parameters) -> Outcome {
    for (radius, swing) in [(0.6, 0.0), (0.6, 0.9), (2.0, 0.3), (1e-9, 0.5)] {
        let mut contact = pressed(parameters, FORCE)?;
        j.reset_work();
        let full = full_slip(&contact);
        for k in 1..=2 * STEPS {
            let phase = TAU * f64::from(k) / f64::from(STEPS);
            let load = FORCE * (1.0 + swing * (1.3 * phase).sin());
            let place = [radius * full * phase.cos(), radius * full * phase.sin()];
            j.step(&mut contact, |c| c.advance_to_planar(load, place))?;
        }
    }
    Ok(())
}
