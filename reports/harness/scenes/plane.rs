//! Motion in both tangential directions.

use super::{Add, FORCE, SEED, full_slip, held_in_depth, pressed, split_in_plane, wearing, without_wear};
use crate::judge::Judge;
use fretting_contact::{Parameters, Profile};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use std::f64::consts::TAU;

/// Steps of a circle.
const STEPS: u32 = 40;

/// Loads and places of a way, in those of the start: (load, x, y) of step k.
type Way = fn(u32) -> [f64; 3];

/// (cos, sin) of step k of a circle.
fn turned(k: u32, steps: u32) -> [f64; 2] {
    let (y, x) = (TAU * f64::from(k) / f64::from(steps)).sin_cos();
    [x, y]
}

const WAYS: [(&str, Way); 8] = [
    ("circle, 0.6 u_max", |k| circle(0.6, k)),
    ("circle, 1.5 u_max", |k| circle(1.5, k)),
    ("spiral, 1e-6 to 1e3 u_max", |k| circle(10f64.powf(-6.0 + 9.0 * f64::from(k) / 80.0), k)),
    ("circle, 1e-12 u_max", |k| circle(1e-12, k)),
    ("there and back across, 1e6 u_max", |k| circle(1e6, 17 * k)),
    ("circle, load to and fro by 1e3", |k| {
        let [_, x, y] = circle(0.6, k);
        [if k.is_multiple_of(2) { 1.0 } else { 1e-3 }, x, y]
    }),
    ("circle, lifted at every third step", |k| {
        let [_, x, y] = circle(1.5, k);
        [if k.is_multiple_of(3) { 0.0 } else { 1.0 }, x, y]
    }),
    ("circle, then a line along x", |k| {
        if k < STEPS { circle(0.6, k) } else { [1.0, 0.6 * turned(3 * k, STEPS)[0], 0.0] }
    }),
];

fn circle(radius: f64, k: u32) -> [f64; 3] {
    let [x, y] = turned(k, STEPS);
    [1.0, radius * x, radius * y]
}

pub(super) fn plane(add: Add) {
    for (extreme, way) in WAYS {
        for (kind, parameters, normal, wears) in [
            ("no wear", without_wear(), FORCE, false),
            ("wear", Parameters::default(), FORCE, true),
            ("wear, depth held", held_in_depth(), 3.5e-6, true),
        ] {
            let run = move |j: &mut Judge| {
                let parameters =
                    if wears { wearing(&parameters, normal, SEED)?.0 } else { parameters.clone() };
                let mut contact = pressed(&parameters, normal)?;
                let full = full_slip(&contact);
                for k in 0..2 * STEPS {
                    let [load, x, y] = way(k);
                    j.step(&mut contact, |c| c.advance_to_planar(load * normal, [x * full, y * full]))?;
                }
                Ok(())
            };
            add("plane", format!("{extreme}, {kind}"), Box::new(run));
        }
    }
    for seed in [50.0, 5.0, 1.0] {
        let run = move |j: &mut Judge| circles(j, &Parameters::default(), seed);
        add("plane", format!("circles that wear fast, N0 = {seed}"), Box::new(run));
    }
    for (extreme, profile) in [
        ("flat punch", Profile::FlatPunch { flat_radius: 1e-4 }),
        ("rounded punch", Profile::RoundedPunch { radius: 0.01, flat_radius: 1e-4 }),
        ("cone", Profile::Cone { slope: 0.02 }),
    ] {
        let parameters = Parameters { profile, ..Parameters::default() };
        add(
            "plane",
            format!("circles, {extreme}"),
            Box::new(move |j: &mut Judge| circles(j, &parameters, SEED)),
        );
    }
    for (extreme, profile) in [
        ("ball", Profile::Parabola { radius: 0.01 }),
        ("cone", Profile::Cone { slope: 0.02 }),
        ("rounded punch", Profile::RoundedPunch { radius: 0.01, flat_radius: 1e-4 }),
        ("flat punch", Profile::FlatPunch { flat_radius: 1e-4 }),
    ] {
        for (ways, across) in [("along x", 0.0), ("in the plane", 1.0)] {
            let parameters = Parameters { profile: profile.clone(), ..Parameters::default() };
            add(
                "plane",
                format!("to anywhere within 3 u_max under random loads, {ways}, {extreme}"),
                Box::new(move |j: &mut Judge| anywhere(j, &parameters, across)),
            );
        }
    }
    // a line at any angle in one step and in many
    for (extreme, wears) in [("no wear", false), ("wear", true)] {
        let run = move |j: &mut Judge| {
            let parameters =
                if wears { wearing(&Parameters::default(), FORCE, SEED)?.0 } else { without_wear() };
            split_in_plane(j, &parameters)
        };
        add("plane", format!("1000 steps against one, {extreme}"), Box::new(run));
    }
}

/// Lines in gross slip and back, with places along y times `across`.
fn anywhere(j: &mut Judge, parameters: &Parameters, across: f64) -> super::Outcome {
    let (parameters, _) = wearing(parameters, FORCE, 60.0)?;
    let mut contact = pressed(&parameters, FORCE)?;
    let full = full_slip(&contact);
    let mut random = StdRng::seed_from_u64(1);
    for _ in 0..60 {
        let mut up_to = |most: f64| random.random_range(-most..most) * full;
        let place = [up_to(3.0), across * up_to(3.0)];
        let load = FORCE * random.random_range(0.7..1.3);
        j.step(&mut contact, |c| c.advance_to_planar(load, place))?;
    }
    Ok(())
}

/// Four circles of 0.8 u_max.
fn circles(j: &mut Judge, parameters: &Parameters, seed: f64) -> super::Outcome {
    let (parameters, _) = wearing(parameters, FORCE, seed)?;
    let mut contact = pressed(&parameters, FORCE)?;
    let full = full_slip(&contact);
    for k in 0..4 * STEPS {
        let [load, x, y] = circle(0.8, k);
        j.step(&mut contact, |c| c.advance_to_planar(load * FORCE, [x * full, y * full]))?;
    }
    Ok(())
}
