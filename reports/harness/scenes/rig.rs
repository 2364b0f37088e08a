//! A spring in series with the contact, from far softer than it to far stiffer, along a line and in
//! the plane.

use super::{Add, FORCE, Outcome, SEED, full_slip, held_in_depth, in_parts, pressed, wearing};
use crate::judge::Judge;
use fretting_contact::{Error, FrettingContact, NormalControl, Parameters, Profile};
use std::f64::consts::TAU;

/// Stiffness of the rig over that of the sticking contact.
const RATIOS: [f64; 7] = [1e-9, 1e-3, 0.1, 1.0, 10.0, 1e3, 1e9];

/// Steps of a circle.
const STEPS: u32 = 40;

pub(super) fn rig(add: Add) {
    for ratio in RATIOS {
        for (kind, parameters, normal) in
            [("load held", Parameters::default(), FORCE), ("depth held", held_in_depth(), 3.5e-6)]
        {
            let scene = (parameters, normal, ratio);
            let (of_life, of_circles) = (scene.clone(), scene);
            let run = move |j: &mut Judge| life(j, &of_life);
            add("rig", format!("life, {ratio:e} of the contact, {kind}"), Box::new(run));
            let run = move |j: &mut Judge| circles(j, &of_circles);
            add("rig", format!("circles, {ratio:e} of the contact, {kind}"), Box::new(run));
        }
    }
    for (extreme, profile) in [
        ("flat punch", Profile::FlatPunch { flat_radius: 1e-4 }),
        ("rounded punch", Profile::RoundedPunch { radius: 0.01, flat_radius: 1e-4 }),
        ("cone", Profile::Cone { slope: 0.02 }),
    ] {
        let scene = (Parameters { profile, ..Parameters::default() }, FORCE, 1.0);
        let (of_life, of_circles) = (scene.clone(), scene);
        add("rig", format!("life, {extreme}"), Box::new(move |j: &mut Judge| life(j, &of_life)));
        add("rig", format!("circles, {extreme}"), Box::new(move |j: &mut Judge| circles(j, &of_circles)));
    }
}

/// A contact behind a rig, and the amplitude of the drive at which the contact slips by some 0.6
/// u_max.
fn behind((parameters, normal, ratio): &(Parameters, f64, f64)) -> Result<(FrettingContact, f64), Error> {
    let (parameters, own) = wearing(parameters, *normal, SEED)?;
    let bare = pressed(&parameters, *normal)?;
    let stiffness = ratio * 2.0 * parameters.materials.tangential_modulus() * bare.contact_radius();
    let limit = parameters.friction_coefficient * bare.normal_reaction();
    let parameters = Parameters { rig_stiffness: stiffness, ..parameters };
    Ok((pressed(&parameters, *normal)?, own + 0.75 * limit / stiffness))
}

/// Strokes, swings of load, cycles in one call, contact lost and found, a slide; and a stroke in
/// one step and in many.
fn life(j: &mut Judge, scene: &(Parameters, f64, f64)) -> Outcome {
    let (mut contact, amplitude) = behind(scene)?;
    let normal = scene.1;
    j.state(&contact);
    let way =
        [(1.0, 1.0), (1.0, -1.0), (0.5, 0.2), (1.2, 0.9), (0.9, -1.0), (1.0, 0.0), (0.0, 0.5), (1.0, 1.0)];
    for (load, place) in way {
        j.step(&mut contact, |c| c.advance_to(load * normal, place * amplitude))?;
    }
    j.step(&mut contact, |c| c.advance_cycles(normal, amplitude, 0.2 * SEED))?;
    let mut parts = contact.clone();
    j.step(&mut contact, |c| c.advance_to(0.9 * normal, -0.5 * amplitude))?;
    in_parts(&mut parts, (normal, amplitude), (0.9 * normal, -0.5 * amplitude), 7)?;
    j.split(&contact, &parts);
    let slide = amplitude + 3.0 * full_slip(&contact);
    j.step(&mut contact, |c| c.advance_to(normal, slide))
}

/// Circles of the drive, the last lifted at every fifth step: there a soft rig lets go of more than
/// the contact is wide.
fn circles(j: &mut Judge, scene: &(Parameters, f64, f64)) -> Outcome {
    let (mut contact, amplitude) = behind(scene)?;
    let lifted = if contact.parameters().normal_control == NormalControl::Force { 0.0 } else { -1e-9 };
    for k in 0..3 * STEPS {
        let (y, x) = (TAU * f64::from(k) / f64::from(STEPS)).sin_cos();
        let lifts = scene.2 >= 0.1 && k > 2 * STEPS && k.is_multiple_of(5);
        let normal = if lifts { lifted } else { scene.1 };
        j.step(&mut contact, |c| c.advance_to_planar(normal, [amplitude * x, amplitude * y]))?;
    }
    Ok(())
}
