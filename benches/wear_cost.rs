//! What wear adds to a step through the C interface, where the load or the direction varies at
//! every step.
//!
//! `cargo bench --bench wear_cost`. The ball of the default parameters, 100 steps a cycle; each
//! scene without wear, with next to none and with that of steel, one after the other in one run.
//! Means of µs a step, and their ratio to the step without wear. Then the time of a reading of the
//! wear depth after each step.

#[path = "../tests/fmi/host.rs"]
#[allow(dead_code, reason = "the tests use more of it")]
mod host;

use host::{Fmu, OK, reference};
use std::f64::consts::TAU;
use std::time::Instant;

/// Steps of a cycle.
const STEPS: u32 = 100;

/// k of steel, with the default hardness 4e-14 m³/J.
const STEEL: f64 = 3.2e-4;

/// What a master reads after each step.
const OUTPUTS: [&str; 2] = ["tangential_force", "dissipated_energy"];

/// Load (N) and displacement (m) of a step.
type Scene = fn(u32) -> [f64; 3];

fn phase(step: u32) -> f64 {
    TAU * f64::from(step) / f64::from(STEPS)
}

fn varying_load(step: u32) -> [f64; 3] {
    [100.0 + 50.0 * (phase(step) + 0.7).sin(), 1e-6 * phase(step).sin(), 0.0]
}

/// To and fro between random places, each stroke in ten steps.
fn random_strokes(step: u32) -> [f64; 3] {
    let place = |stroke: u32| {
        let mixed = u64::from(stroke + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let share = (mixed >> 11) as f64 / (1u64 << 53) as f64;
        if stroke.is_multiple_of(2) { share } else { -share }
    };
    let (stroke, share) = (step / 10, f64::from(step % 10 + 1) / 10.0);
    let from = if stroke == 0 { 0.0 } else { place(stroke - 1) };
    [100.0, 1.4e-6 * (from + share * (place(stroke) - from)), 0.0]
}

fn orbit(step: u32) -> [f64; 3] {
    [100.0, 1e-6 * phase(step).sin(), 0.7e-6 * (2.0 * phase(step)).cos()]
}

fn orbit_under_varying_load(step: u32) -> [f64; 3] {
    let [_, x, y] = orbit(step);
    [100.0 + 30.0 * (phase(step) + 0.7).sin(), x, y]
}

/// Mean time (µs) of a step and of reading outputs after it.
fn measured(scene: Scene, wear_coefficient: f64, steps: u32, outputs: &[&str]) -> f64 {
    let fmu = Fmu::started(|fmu| assert_eq!(fmu.set_real("wear_coefficient", wear_coefficient), OK));
    let inputs = ["normal_force", "tangential_displacement", "tangential_displacement_y"].map(reference);
    let outputs: Vec<u32> = outputs.iter().map(|name| reference(name)).collect();
    let mut read = vec![0.0; outputs.len()];
    let clock = Instant::now();
    for step in 0..steps {
        assert_eq!(fmu.set_reals(&inputs, &scene(step)), OK);
        assert_eq!(fmu.do_step(f64::from(step), 1.0), OK);
        assert_eq!(fmu.get_reals(&outputs, &mut read), OK);
    }
    assert!(read.iter().all(|value| value.is_finite()));
    1e6 * clock.elapsed().as_secs_f64() / f64::from(steps)
}

fn main() {
    // cargo passes --bench when it benchmarks; anything else only wants to know that this runs
    let benchmark = std::env::args().any(|argument| argument == "--bench");
    let share = if benchmark { 1 } else { 1000 };
    let scenes: [(&str, Scene, u32); 4] = [
        ("load varies by 50 %", varying_load, 20_000),
        ("random strokes under constant load", random_strokes, 20_000),
        ("orbit in the plane", orbit, 4_000),
        ("orbit in the plane, load varies by 30 %", orbit_under_varying_load, 4_000),
    ];
    println!("µs a step: without wear; with next to none (1e-7 of steel's); with steel's; wear_depth");
    for (name, scene, steps) in scenes {
        let [none, little, steel] =
            [0.0, 1e-7 * STEEL, STEEL].map(|wear| measured(scene, wear, steps / share, &OUTPUTS));
        let [tangential_force, energy] = OUTPUTS;
        let reading =
            measured(scene, STEEL, steps / share, &[tangential_force, energy, "wear_depth"]) - steel;
        println!(
            "{name}: {none:.2}; {little:.2} ({:.1} times); {steel:.2} ({:.1} times); {reading:.2}",
            little / none,
            steel / none
        );
    }
    println!("load varies by 50 %, steel, µs a step over a run of so many cycles");
    for cycles in [200, 1000, 4000] {
        println!("{cycles}: {:.2}", measured(varying_load, STEEL, cycles * STEPS / share, &OUTPUTS));
    }
}
