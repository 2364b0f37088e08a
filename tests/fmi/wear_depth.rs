//! The depth of the wear, as it is read along a run: wear never heals.

use crate::host::{Fmu, OK};
use fretting_contact::{FrettingContact, Parameters};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

/// Runs of strokes of all lengths with a load that varies, and wear that brings the profile up to
/// date many times.
#[test]
fn the_depth_never_falls_between_reads() {
    for seed in 0..8 {
        let mut random = StdRng::seed_from_u64(seed);
        let cyclic = seed % 4 == 3;
        let fmu = Fmu::started(|fmu| {
            assert_eq!(fmu.set_real("wear_coefficient", if cyclic { 3.2e-4 } else { 0.02 }), OK);
            assert_eq!(
                (fmu.set_integer("loading", 1 + i32::from(cyclic)), fmu.set_real("frequency", 5.0)),
                (OK, OK)
            );
        });
        let mut depth = 0.0;
        for k in 0..400 {
            let sine = 2.2e-6 * (0.7 * f64::from(k)).sin();
            let displacement = if seed % 2 == 0 { sine } else { random.random_range(-4e-6..4e-6) };
            let force = if seed % 4 < 2 { 100.0 } else { random.random_range(60.0..100.0) };
            let tangential = if cyclic {
                ("displacement_amplitude", displacement.abs())
            } else {
                ("tangential_displacement", displacement)
            };
            fmu.step_with(&[tangential, ("normal_force", force)], f64::from(k), 1.0);
            let now = fmu.real("wear_depth");
            assert!(now >= depth, "seed {seed}, step {k}: {now:e} after {depth:e}");
            depth = now;
        }
        assert!(depth > 1e-8, "seed {seed}: {depth}");
    }
}

/// A trial that wears more is forgotten with its state, also in an instance that takes the bytes.
#[test]
fn a_saved_state_brings_the_depth_back() {
    let fmu = Fmu::started(|fmu| assert_eq!(fmu.set_real("wear_coefficient", 0.02), OK));
    for k in 0..20 {
        fmu.step_with(
            &[("tangential_displacement", if k % 2 == 0 { 2e-6 } else { -2e-6 })],
            f64::from(k),
            1.0,
        );
    }
    let depth = fmu.real("wear_depth");
    let saved = fmu.save();
    for k in 20..40 {
        fmu.step_with(
            &[("tangential_displacement", if k % 2 == 0 { 5e-6 } else { -5e-6 })],
            f64::from(k),
            1.0,
        );
    }
    let deeper = fmu.real("wear_depth");
    assert!(deeper > 1.5 * depth);
    let other = Fmu::new();
    let (copy, status) = other.deserialized(&fmu.serialized(saved));
    assert_eq!((status, other.restore(copy), fmu.restore(saved)), (OK, OK, OK));
    assert_eq!((fmu.real("wear_depth"), other.real("wear_depth")), (depth, depth));
}

/// The depth costs nothing where it is not read.
#[test]
fn the_depth_is_computed_only_where_it_is_read() {
    let run = |reads: bool| {
        let parameters = Parameters { wear_coefficient: 0.02, ..Parameters::default() };
        let mut contact = FrettingContact::new(parameters).unwrap();
        contact.start_at(100.0, 0.0).unwrap();
        for k in 0..100 {
            contact.advance_to(100.0, 2e-6 * (0.7 * f64::from(k)).sin()).unwrap();
            if reads {
                contact.wear_depth();
            }
        }
        (*contact.counters(), contact.wear_volume())
    };
    assert_eq!(run(true), run(false), "a read changes no counter and no result");
}
