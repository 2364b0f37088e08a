//! The ready problems, driven by whole cycles, against all that is tabulated of them.

use fretting_contact::problems::{CONE, History, PARABOLA, Problem};
use fretting_contact::{FrettingContact, NormalControl};
use std::f64::consts::PI;

/// Every quantity that the table of `problem` gives in row `i`: (name, measured, tabulated).
fn row(problem: &Problem, i: usize, contact: &FrettingContact) -> Vec<(&'static str, f64, f64)> {
    let (a, d) = (problem.contact_radius(), problem.depth());
    let volume = contact.wear_volume() / problem.volume_unit();
    match problem.history {
        History::Unknown => Vec::new(),
        History::Volume(rows) => vec![("V", volume, rows[i].1)],
        History::ConstantForce(rows) => vec![
            ("d", contact.indentation_depth() / d, rows[i].depth),
            ("c", contact.stick_radius() / a, rows[i].stick_radius),
            ("V", volume, rows[i].volume),
            ("deepest", contact.wear_depth() / d, rows[i].deepest),
        ],
        History::CentralPressure(rows) => {
            let mean = problem.normal / (PI * a * a);
            vec![("p(0)", contact.pressure_at(0.0) / mean, rows[i].1)]
        }
        History::CentralWear(rows) => vec![("w(0)", contact.worn_depth_at(0.0) / d, rows[i].1)],
    }
}

#[test]
fn whole_cycles_follow_every_table() {
    let gross_slip = [Problem::flat_punch_in_gross_slip(), Problem::sphere_in_gross_slip()];
    for problem in Problem::published().into_iter().chain(gross_slip) {
        let mut contact = problem.begin().expect("a ready problem is valid");
        let mut compared = 0;
        for (i, life) in problem.checkpoints.iter().enumerate() {
            let before = if i == 0 { 0.0 } else { problem.checkpoints[i - 1] };
            problem.advance(&mut contact, life - before).expect("it can be advanced");
            if i >= problem.history.places().len() {
                continue;
            }
            for (name, measured, tabulated) in row(&problem, i, &contact) {
                let off = measured / tabulated - 1.0;
                println!("{} at {life:.4}: {name} {measured:.5}, {off:+.2e}", problem.name);
                assert!(off.abs() <= 5e-3, "{} at {life}: {name} {measured} {tabulated}", problem.name);
                compared += 1;
            }
        }
        assert!(compared >= 4 || problem.history == History::Unknown, "{}", problem.name);
        println!("{}", contact.counters());
    }
}

/// The final state at constant depth is closed: the profile, the stick radius and the volume, at default settings.
#[test]
fn the_final_profile_is_the_closed_one_at_default_settings() {
    for body in [PARABOLA, CONE] {
        for stick_ratio in [0.2, 0.4, 0.6, 0.8] {
            let problem = Problem::partial_slip(body, NormalControl::Indentation, stick_ratio);
            let mut contact = problem.begin().expect("a ready problem is valid");
            for life in [0.16, 0.2, 0.28, 0.36, 1.0, 7.0] {
                problem.advance(&mut contact, life).expect("it can be advanced");
                let drift = contact.stick_radius() / problem.stick_radius() - 1.0;
                assert!(drift.abs() <= 1e-9, "{}: the front has moved by {drift:e}", problem.name);
            }
            let error =
                problem.profile_error(|r| contact.worn_depth_at(r)).expect("the final state is closed");
            println!("{}: sup error {error:.2e} d0, {}", problem.name, contact.counters());
            assert!(error <= 5e-4, "{}: {error:e}", problem.name);
            assert!(
                (contact.profile_volume() / contact.wear_volume() - 1.0).abs() <= 1e-5,
                "{}",
                problem.name
            );
        }
    }
}

/// Final profile of a life in one call at a resolution.
fn final_error(problem: &Problem, resolution: usize, tolerance: f64) -> f64 {
    let mut problem = problem.clone();
    problem.parameters.resolution = resolution;
    problem.parameters.tolerance = tolerance;
    let mut contact = problem.begin().expect("a ready problem is valid");
    problem.advance(&mut contact, 9.0).expect("it can be advanced");
    problem.profile_error(|r| contact.worn_depth_at(r)).expect("the final state is closed")
}

#[test]
fn the_error_of_the_final_profile_is_of_second_order_in_the_cells() {
    for body in [PARABOLA, CONE] {
        let problem = Problem::partial_slip(body, NormalControl::Indentation, 0.4);
        let errors = [12, 24, 48, 96].map(|resolution| final_error(&problem, resolution, 1e-5));
        let orders: Vec<f64> = errors.windows(2).map(|pair| (pair[0] / pair[1]).log2()).collect();
        println!("{}: errors {errors:?}, orders {orders:?}", problem.name);
        assert!(orders.iter().all(|order| *order > 1.8), "{}: {errors:?} {orders:?}", problem.name);
    }
}

/// What is delivered follows the tolerance: V amid the life, against a run at a tenth of the finest. Where the front moves, each step
/// lays the mesh anew, and that error, some 5e-5 on 128 cells, remains.
#[test]
fn the_delivered_error_follows_the_tolerance() {
    const TOLERANCES: [f64; 4] = [1e-2, 1e-3, 1e-4, 1e-5];
    for (control, life, followed) in [(NormalControl::Indentation, 0.36, 4), (NormalControl::Force, 1.0, 3)] {
        let problem = Problem::partial_slip(PARABOLA, control, 0.4);
        let volume = |tolerance: f64| {
            let mut problem = problem.clone();
            problem.parameters.resolution = 128;
            problem.parameters.tolerance = tolerance;
            let mut contact = problem.begin().expect("a ready problem is valid");
            problem.advance(&mut contact, life).expect("it can be advanced");
            contact.wear_volume()
        };
        let exact = volume(1e-6);
        let errors = TOLERANCES.map(|tolerance| (volume(tolerance) / exact - 1.0).abs());
        println!("{}: {errors:?}", problem.name);
        for pair in errors[..followed].windows(2) {
            assert!(pair[1] < pair[0], "{}: {errors:?}", problem.name);
        }
        for (error, tolerance) in errors.iter().zip(TOLERANCES) {
            assert!(*error <= tolerance.max(1e-4), "{}: {error:e} at {tolerance:e}", problem.name);
        }
    }
}
