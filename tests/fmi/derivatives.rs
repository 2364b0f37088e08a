//! Derivatives through the C interface: of outputs with respect to inputs and to time, and the
//! dependencies that modelDescription.xml declares.

use crate::host::{self, Fmu, OK};
use fretting_contact::fmi2::variables::variables;

/// All outputs with derivatives.
fn outputs() -> Vec<&'static str> {
    let real = |v: &&fretting_contact::fmi2::variables::Variable| {
        v.causality() == "output" && v.data_type.name() == "Real"
    };
    variables().iter().filter(real).map(|v| v.name).collect()
}

fn values(fmu: &Fmu) -> Vec<f64> {
    outputs().iter().map(|name| fmu.real(name)).collect()
}

#[track_caller]
fn derivatives(fmu: &Fmu, seed: &[(&str, f64)]) -> Vec<f64> {
    let (result, status) = fmu.directional(&outputs(), seed);
    assert_eq!(status, OK, "{:?}", fmu.messages());
    result
}

/// Loading and control by number, and the input of each.
const SCENES: [(i32, i32, &str, f64); 4] = [
    (1, 1, "normal_force", 100.0),
    (1, 2, "indentation", 3.5e-6),
    (2, 1, "normal_force", 100.0),
    (2, 2, "indentation", 3.5e-6),
];

fn started(loading: i32, control: i32, wear: f64) -> Fmu {
    started_behind(f64::INFINITY, loading, control, wear)
}

fn started_behind(rig_stiffness: f64, loading: i32, control: i32, wear: f64) -> Fmu {
    started_with(&[], rig_stiffness, loading, control, wear)
}

/// The same with more parameters.
fn started_with(more: &[(&str, f64)], rig_stiffness: f64, loading: i32, control: i32, wear: f64) -> Fmu {
    Fmu::started(|fmu| {
        for (name, value) in more {
            assert_eq!(fmu.set_real(name, *value), OK);
        }
        assert_eq!(fmu.set_real("rig_stiffness", rig_stiffness), OK);
        assert_eq!(fmu.set_integer("loading", loading), OK);
        assert_eq!(fmu.set_integer("normal_control", control), OK);
        assert_eq!(fmu.set_real("wear_coefficient", wear), OK);
        if loading == 2 {
            assert_eq!(fmu.set_real("displacement_amplitude", 1.2e-6), OK);
        }
    })
}

/// Central differences along the motion, by steps of no length from a saved state. Without wear the
/// cycles of cyclic loading leave the contact as it was, so that it can be moved to and fro.
#[test]
fn directional_derivatives_are_those_of_steps() {
    for (loading, control, normal, value) in SCENES {
        let tangential = if loading == 1 { "tangential_displacement" } else { "displacement_amplitude" };
        let fmu = started(loading, control, 0.0);
        for (point, displacement) in [0.0, 1.2e-6].into_iter().enumerate() {
            fmu.step_with(&[(normal, value), (tangential, displacement)], point as f64, 1.0);
        }
        let h = 1e-5;
        // under a slower change of load the springs outside go on slipping
        for (by_normal, by_displacement) in [(0.0, 1.2e-6), (0.1 * value, 1.2e-6), (-0.1 * value, 1.2e-6)] {
            let saved = fmu.save();
            let mut seen = Vec::new();
            let mut predicted = Vec::new();
            for k in 0..3 {
                let share = h * f64::from(k);
                fmu.step_with(
                    &[(normal, value + share * by_normal), (tangential, 1.2e-6 + share * by_displacement)],
                    2.0,
                    0.0,
                );
                seen.push(values(&fmu));
                if k == 1 {
                    predicted = derivatives(&fmu, &[(normal, by_normal), (tangential, by_displacement)]);
                }
            }
            for (i, name) in outputs().iter().enumerate() {
                let difference = (seen[2][i] - seen[0][i]) / (2.0 * h);
                let scale = difference.abs() + 1e-6 * seen[1][i].abs();
                let error = (predicted[i] - difference).abs();
                assert!(
                    error <= 1e-5 * scale,
                    "{name}, loading {loading}, control {control}: {} against {difference}",
                    predicted[i]
                );
            }
            assert_eq!(fmu.restore(saved), OK);
        }
    }
}

#[test]
fn a_seed_is_a_linear_combination_and_lists_may_be_empty() {
    let fmu = started(1, 1, 3.2e-4);
    fmu.step_with(&[("tangential_displacement", 1e-6)], 0.0, 1.0);
    let by_force = derivatives(&fmu, &[("normal_force", 1.0)]);
    let by_displacement = derivatives(&fmu, &[("tangential_displacement", 1.0)]);
    let both = derivatives(&fmu, &[("normal_force", -2.0), ("tangential_displacement", 3.0)]);
    for i in 0..both.len() {
        let sum = -2.0 * by_force[i] + 3.0 * by_displacement[i];
        assert!((both[i] - sum).abs() <= 1e-12 * (by_force[i].abs() + by_displacement[i].abs()));
    }
    let stiffness = fmu.real("tangential_stiffness");
    assert_eq!(fmu.directional(&["tangential_force"], &[("tangential_displacement", 1.0)]).0, [stiffness]);
    assert_eq!(fmu.directional(&["tangential_force"], &[]), (vec![0.0], OK));
    assert_eq!(fmu.directional(&[], &[("normal_force", 1.0)]), (vec![], OK));
    // inputs that are not in use change nothing
    for name in ["indentation", "displacement_amplitude", "frequency"] {
        assert_eq!(derivatives(&fmu, &[(name, 1.0)]), vec![0.0; outputs().len()]);
    }
    let before = fmu.bits();
    derivatives(&fmu, &[("normal_force", 1.0)]);
    assert_eq!(fmu.bits(), before, "asking changes nothing");
}

/// In initialization mode the body is pressed down wherever it is; only where that is follows the
/// displacement.
#[test]
fn during_the_initialization_nothing_else_follows_the_displacement() {
    let fmu = Fmu::new();
    assert_eq!(fmu.enter_initialization(), OK);
    let h = 1e-3;
    let before = values(&fmu);
    let predicted = derivatives(&fmu, &[("normal_force", 1.0), ("tangential_displacement", 1.0)]);
    let at = |force: f64| {
        assert_eq!(fmu.set_real("normal_force", force), OK);
        assert_eq!(fmu.set_real("tangential_displacement", force), OK);
        values(&fmu)
    };
    let (above, below) = (at(100.0 + h), at(100.0 - h));
    for (i, name) in outputs().iter().enumerate() {
        let difference = (above[i] - below[i]) / (2.0 * h);
        assert!(
            (predicted[i] - difference).abs() <= 1e-7 * before[i].abs() / 100.0 + 1e-10 * predicted[i].abs(),
            "{name}: {} against {difference}",
            predicted[i]
        );
    }
}

#[test]
fn derivatives_with_respect_to_time_continue_the_last_step() {
    let fmu = started(1, 1, 3.2e-4);
    let slope = |name: &str| {
        let (value, status) = fmu.output_slope(name, 1);
        assert_eq!(status, OK);
        value
    };
    assert_eq!(slope("tangential_force"), 0.0, "before the first step nothing moves");
    let (h, mut forces) = (1e-3, Vec::new());
    for k in 1..=3 {
        let time = h * f64::from(k);
        let inputs = [("tangential_displacement", 1e-6 + 1e-6 * time), ("normal_force", 100.0 + 5.0 * time)];
        fmu.step_with(&inputs, time - h, h);
        forces.push((fmu.real("tangential_force"), fmu.real("wear_volume"), fmu.real("normal_reaction")));
        if k == 2 {
            forces.push((slope("tangential_force"), slope("wear_volume"), slope("normal_reaction")));
        }
    }
    let [first, _, slopes, last] = forces[..] else { panic!("three steps") };
    for (seen, expected) in
        [(last.0 - first.0, slopes.0), (last.1 - first.1, slopes.1), (last.2 - first.2, slopes.2)]
    {
        assert!((seen / (2.0 * h) / expected - 1.0).abs() < 1e-4, "{seen} {expected}");
    }
    // a step that holds the inputs, or has no length, ends at rest
    fmu.step_with(&[], 3.0 * h, h);
    assert_eq!((slope("tangential_force"), slope("wear_volume")), (0.0, 0.0));
    fmu.step_with(&[("tangential_displacement", 2e-6)], 4.0 * h, 0.0);
    assert_eq!(slope("tangential_force"), 0.0);
}

#[test]
fn cycles_wear_at_a_rate() {
    for control in [1, 2] {
        let fmu = started(2, control, 3.2e-4);
        fmu.step_with(&[("frequency", 10.0)], 0.0, 100.0);
        let expected =
            ["wear_volume", "dissipated_energy", "wear_depth"].map(|name| fmu.output_slope(name, 1).0);
        let read = || ["wear_volume", "dissipated_energy", "wear_depth"].map(|name| fmu.real(name));
        let before = read();
        fmu.step_with(&[], 100.0, 0.5);
        let after = read();
        for i in 0..3 {
            let rate = (after[i] - before[i]) / 0.5;
            // the depth at one node is as exact as the mesh
            let tolerance = if i == 2 { 2e-2 } else { 1e-3 };
            assert!(
                (rate / expected[i] - 1.0).abs() < tolerance,
                "control {control}, {i}: {rate} {}",
                expected[i]
            );
        }
    }
}

/// Every output depends on every input in some scene, as the ModelStructure says, but for those
/// that it leaves out: by friction, through a rig, in the plane or both, as one of several contacts
/// or, through wear, in time.
#[test]
fn every_declared_dependency_is_one() {
    let inputs: Vec<_> = variables().iter().filter(|v| v.causality() == "input").map(|v| v.name).collect();
    let mut missing: Vec<(&str, &str)> =
        inputs.iter().flat_map(|input| outputs().into_iter().map(move |output| (*input, output))).collect();
    let independent = |(input, output): &(&str, &str)| {
        let variable = variables().iter().find(|variable| variable.name == *output);
        variable.is_some_and(|variable| variable.independent_of.contains(input))
    };
    let folder = tempfile::tempdir().expect("a folder for the file");
    let file = folder.path().join("contacts.txt");
    std::fs::write(&file, "0 1e-3 0\n1e-7 -1e-3 5e-4\n").expect("the file can be written");
    let file = std::ffi::CString::new(file.to_str().expect("a path in UTF-8")).expect("a path");
    let scenes = SCENES.iter().flat_map(|(loading, control, ..)| {
        [
            (1e8, (1.0, 0.0), false),
            (1e60, (0.7, 3e-7), false),
            (1e8, (0.7, 3e-7), false),
            (1e60, (0.7, 3e-7), true),
        ]
        .map(|scene| (scene, loading, control))
    });
    for ((rig, (share, aside), many), &loading, &control) in scenes {
        let run = |changed: Option<&str>| {
            let set = [
                ("wear_coefficient_2", 0.02),
                ("hardness_2", 8e9),
                ("coating_thickness", 2e-7),
                ("friction_coefficient_final", 0.61),
                ("running_in_energy", 1.0),
            ];
            let fmu = if many {
                Fmu::started(|fmu| {
                    assert_eq!(fmu.set_string("contacts_file", &file), OK);
                    assert_eq!(fmu.set_integer("loading", loading), OK);
                    assert_eq!(fmu.set_integer("normal_control", control), OK);
                    assert_eq!(fmu.set_real("wear_coefficient", 0.1), OK);
                    for (name, value) in &set {
                        assert_eq!(fmu.set_real(name, *value), OK);
                    }
                })
            } else {
                started_with(&set, rig, loading, control, 0.1)
            };
            for (k, displacement) in [3e-6, -3e-6, 2e-6, -3e-6].into_iter().enumerate() {
                let mut set = vec![
                    ("normal_force", 100.0),
                    ("indentation", 3.5e-6),
                    ("tangential_displacement", share * displacement),
                    ("displacement_amplitude", 1.5e-6),
                    ("frequency", 100.0),
                    ("tangential_displacement_y", aside * k as f64),
                    ("rotation", if many { 1e-4 * k as f64 } else { 0.0 }),
                ];
                for (name, value) in &mut set {
                    *value *= if changed == Some(*name) { 1.01 } else { 1.0 };
                }
                fmu.step_with(&set, k as f64, 1.0);
            }
            values(&fmu)
        };
        let base = run(None);
        for input in &inputs {
            let changed = run(Some(input));
            for (i, output) in outputs().into_iter().enumerate() {
                if changed[i].to_bits() != base[i].to_bits() {
                    assert!(!independent(&(*input, output)), "{output} depends on {input}");
                    missing.retain(|pair| *pair != (*input, output));
                }
            }
        }
    }
    missing.retain(|pair| !independent(pair));
    // strokes set only in which step, of four, the coating wears through; for a rotation that does
    // it alone see `interface::a_rotation_wears_a_coating_through`
    missing.retain(|(input, output)| match *output {
        "worn_through_time" => !(input.starts_with("tangential_displacement") || *input == "rotation"),
        "worn_through" => *input != "rotation",
        _ => true,
    });
    assert_eq!(missing, []);
}

/// Of an order that the FMU does not have the derivative is 0, as in the standard's example; an
/// order of 0 is refused.
#[test]
fn output_derivatives_of_second_order_are_zero() {
    for loading in [1, 2] {
        let fmu = started(loading, 1, 3.2e-4);
        let tangential = if loading == 1 { "tangential_displacement" } else { "displacement_amplitude" };
        fmu.step_with(&[(tangential, 1e-6), ("normal_force", 110.0)], 0.0, 1.0);
        for name in outputs() {
            assert_eq!(
                (fmu.output_slope(name, 2), fmu.output_slope(name, 7)),
                ((0.0, OK), (0.0, OK)),
                "{name}"
            );
            assert_eq!(fmu.output_slope(name, 1).1, OK);
            fmu.refused(fmu.output_slope(name, 0).1, &["order 0", name]);
        }
        assert_ne!(fmu.output_slope("normal_reaction", 1).0, 0.0);
    }
}

/// InitialUnknowns declares that outputs depend on parameters: Hertz's formulas, d ln a = (d ln F +
/// d ln R - d ln E*)/3 and the like.
#[test]
fn initial_outputs_have_derivatives_with_respect_to_parameters() {
    let fmu = Fmu::new();
    assert_eq!(fmu.enter_initialization(), OK);
    let unknowns =
        ["contact_radius", "indentation_depth", "max_pressure", "normal_reaction", "tangential_force"];
    let powers = |known: &str| match known {
        "normal_force" => [1.0 / 3.0, 2.0 / 3.0, 1.0 / 3.0, 1.0, 0.0],
        "radius" => [1.0 / 3.0, -1.0 / 3.0, -2.0 / 3.0, 0.0, 0.0],
        // each body is half of the compliance
        "youngs_modulus_1" | "youngs_modulus_2" => [-1.0 / 6.0, -1.0 / 3.0, 1.0 / 3.0, 0.0, 0.0],
        _ => [0.0; 5],
    };
    let others =
        ["hardness", "wear_coefficient", "friction_coefficient", "rig_stiffness", "tolerance", "cone_slope"];
    for known in ["normal_force", "radius", "youngs_modulus_1", "youngs_modulus_2"].into_iter().chain(others)
    {
        let value = fmu.real(known);
        let (slopes, status) = fmu.directional(&unknowns, &[(known, value)]);
        assert_eq!(status, OK, "{known}: {:?}", fmu.messages());
        for ((unknown, power), slope) in unknowns.iter().zip(powers(known)).zip(slopes) {
            let relative = if power == 0.0 { slope } else { slope / fmu.real(unknown) };
            assert!((relative - power).abs() < 1e-6, "d {unknown}/d {known}: {relative}, {power}");
        }
    }
    // a seed of several knowns is the sum
    let seeds = [("radius", 0.01), ("normal_force", 100.0)];
    let (sum, _) = fmu.directional(&["indentation_depth"], &seeds);
    assert!((sum[0] / (fmu.real("indentation_depth") / 3.0) - 1.0).abs() < 1e-6);
    // at the ends of a range differences are one-sided; friction is switched on and off, which is
    // no derivative
    for (name, value, slopes) in [
        // a ~ (1 - nu1^2 + 1 - nu2^2)^(1/3)
        ("poisson_ratio_1", 0.0, true),
        ("poisson_ratio_1", 0.5, true),
        ("friction_coefficient", 0.0, false),
    ] {
        assert_eq!(fmu.set_real(name, value), OK);
        let (slope, status) = fmu.directional(&["contact_radius", "stick_radius"], &[(name, 1.0)]);
        let compliance = 2.0 - value * value - 0.3 * 0.3;
        let expected =
            if slopes { fmu.real("contact_radius") / 3.0 * (-2.0 * value) / compliance } else { 0.0 };
        assert!(
            status == OK && (slope[0] - expected).abs() < 1e-5 * fmu.real("contact_radius"),
            "{name}: {slope:?}"
        );
    }
    // afterwards parameters are fixed
    assert_eq!(fmu.exit_initialization(), host::WARNING);
    fmu.messages();
    let (_, status) = fmu.directional(&["contact_radius"], &[("radius", 1.0)]);
    fmu.refused(status, &["radius is refused as a known", "initialization mode"]);
}

/// They are tangents at the end of the step: of a step to 0.5 µm, a fifth of full slip, dT/dU is
/// 5.6 % below the mean of the step. The guide has these numbers.
#[test]
fn directional_derivatives_are_tangents_at_the_end_of_the_step() {
    let fmu = started(1, 1, 0.0);
    let step = |to: f64| {
        fmu.step_with(&[("tangential_displacement", to)], fmu.last_successful_time(), 1.0);
        fmu.real("tangential_force")
    };
    let force = step(0.5e-6);
    let (tangent, _) = fmu.directional(&["tangential_force"], &[("tangential_displacement", 1.0)]);
    let next = step(0.5e-6 + 1e-12);
    assert!(((next - force) / 1e-12 / tangent[0] - 1.0).abs() < 1e-3);
    let mean = force / 0.5e-6;
    // 2G*a (1 - θ)^(1/2) and μF [1 - (1 - θ)^(3/2)]/U at θ = 0.5/2.53755
    assert!((tangent[0] - 31.781e6).abs() < 1e4 && (mean - 33.66e6).abs() < 1e4, "{} {mean}", tangent[0]);
    assert!((tangent[0] / mean - 0.944).abs() < 1e-3, "{}", tangent[0] / mean);
}
