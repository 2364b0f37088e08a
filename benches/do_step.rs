//! One co-simulation step through the C interface, as a host sees it: two inputs set, fmi2DoStep,
//! two outputs read.
//!
//! `cargo bench --bench do_step`. The ball of the default parameters under 100 N, 100 steps a
//! cycle.
#![allow(missing_docs, reason = "criterion's macros")]

#[path = "../tests/fmi/host.rs"]
#[allow(dead_code, reason = "the tests use more of it")]
mod host;

use criterion::{Criterion, criterion_group, criterion_main};
use host::{Fmu, OK, reference};
use std::f64::consts::TAU;
use std::hint::black_box;

/// Steps per cycle.
const STEPS: u32 = 100;

fn step(c: &mut Criterion) {
    let mut group = c.benchmark_group("set 2, doStep, get 2");
    let rigid = f64::INFINITY;
    for (name, amplitude, load_swing, wear, rig) in [
        ("full stick, no wear", 1e-9, 0.0, 0.0, rigid),
        ("partial slip, no wear", 1e-6, 0.0, 0.0, rigid),
        ("partial slip, varying load, no wear", 1e-6, 30.0, 0.0, rigid),
        ("partial slip, wear of steel", 1e-6, 0.0, 3.2e-4, rigid),
        ("gross slip, wear of steel", 5e-6, 0.0, 3.2e-4, rigid),
        // as stiff as the sticking contact: half the drive's way
        ("partial slip behind a rig, no wear", 2e-6, 0.0, 0.0, 3.5e7),
        ("partial slip behind a rig, varying load, no wear", 2e-6, 30.0, 0.0, 3.5e7),
        ("partial slip behind a rig, wear of steel", 2e-6, 0.0, 3.2e-4, 3.5e7),
    ] {
        let fmu = Fmu::started(|fmu| {
            assert_eq!(fmu.set_real("wear_coefficient", wear), OK);
            assert_eq!(fmu.set_real("rig_stiffness", rig), OK);
        });
        let inputs = [reference("normal_force"), reference("tangential_displacement")];
        let outputs = [reference("tangential_force"), reference("dissipated_energy")];
        // sine and cosine are the host's work
        let cycle: Vec<[f64; 2]> = (0..STEPS)
            .map(|k| {
                let phase = TAU * f64::from(k) / f64::from(STEPS);
                [100.0 + load_swing * phase.cos(), amplitude * phase.sin()]
            })
            .collect();
        let mut count = 0u32;
        group.bench_function(name, |b| {
            b.iter(|| {
                let values = &cycle[(count % STEPS) as usize];
                assert_eq!(fmu.set_reals(&inputs, black_box(values)), OK);
                assert_eq!(fmu.do_step(f64::from(count), 1.0), OK);
                let mut read = [0.0; 2];
                assert_eq!(fmu.get_reals(&outputs, &mut read), OK);
                count += 1;
                black_box(read)
            });
        });
    }
    group.finish();
}

criterion_group!(benches, step);
criterion_main!(benches);
