//! The ready problems, driven by whole cycles, against all that is tabulated of them.

use fretting_contact::problems::{CONE, History, PARABOLA, Problem};
use fretting_contact::reference::ConstantDepthEnd;
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

/// The final state at constant depth is closed: the profile, the stick radius and the volume, at
/// default settings.
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

/// Slip that just reaches the axis leaves a needle there, however many cycles: the volume is that
/// of a front at the axis, except for the mesh: its front stands at 1e-3 of the contact radius, and
/// its z rises towards it like 1/x (measured: 5e-4 for the ball, 1.6e-3 for the cone).
#[test]
fn slip_that_just_reaches_the_axis_wears_the_closed_volume() {
    for body in [PARABOLA, CONE] {
        let mut problem = Problem::partial_slip(body, NormalControl::Indentation, 0.5);
        let (depth, a) = (problem.depth(), problem.contact_radius());
        let materials = &problem.parameters.materials;
        let full = problem.parameters.friction_coefficient * materials.normal_modulus() * depth
            / materials.tangential_modulus();
        let volume = ConstantDepthEnd::new(body, depth, 1e-9 * a).worn_volume();
        for share in [1.0 - 1e-9, 1.0 - 1e-12, 1.0, 1.0 + 1e-12, 1.0 + 1e-8, 1.0 + 1e-5] {
            problem.amplitude = share * full;
            let mut contact = problem.begin().expect("a ready problem is valid");
            for life in [1.0, 19.0] {
                problem.advance(&mut contact, life).expect("it can be advanced");
            }
            let off = contact.wear_volume() / volume - 1.0;
            println!("{}, {share} of full slip: V {off:+.2e}, {}", problem.name, contact.counters());
            assert!(off.abs() <= 1e-3, "{}, {share} of full slip: {off:e}", problem.name);
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
        let errors = [48, 96, 192].map(|resolution| final_error(&problem, resolution, 1e-5));
        let orders: Vec<f64> = errors.windows(2).map(|pair| (pair[0] / pair[1]).log2()).collect();
        println!("{}: errors {errors:?}, orders {orders:?}", problem.name);
        assert!(orders.iter().all(|order| *order > 1.8), "{}: {errors:?} {orders:?}", problem.name);
    }
}

/// A life in one call.
fn lived(problem: &Problem, resolution: usize, tolerance: f64, life: f64) -> FrettingContact {
    let mut problem = problem.clone();
    problem.parameters.resolution = resolution;
    problem.parameters.tolerance = tolerance;
    let mut contact = problem.begin().expect("a ready problem is valid");
    problem.advance(&mut contact, life).expect("it can be advanced");
    contact
}

/// No closed form is known at constant force: the values that the cells converge to, with their
/// order.
#[test]
fn the_worn_volume_at_constant_force_converges() {
    for (body, life) in [(PARABOLA, 1.0), (PARABOLA, 4.0), (CONE, 1.0), (CONE, 2.5)] {
        let problem = Problem::partial_slip(body, NormalControl::Force, 0.4);
        let volume = |resolution: usize, tolerance: f64| {
            lived(&problem, resolution, tolerance, life).wear_volume() / problem.volume_unit()
        };
        let volumes = [32, 64, 128, 256].map(|resolution| volume(resolution, 1e-5));
        let usual = volume(64, 1e-3);
        println!("{} at {life}: V {volumes:.5?}, at default settings {usual:.5}", problem.name);
        let changes: Vec<f64> = volumes.windows(2).map(|pair| (pair[1] / pair[0] - 1.0).abs()).collect();
        // on the ball errors of either sign all but cancel: what is left is that of the moving
        // front, below 2e-4
        assert!(changes[2] < changes[0] / 8.0 + 2e-4, "{}: {volumes:?}", problem.name);
        assert!(changes[2] <= 1e-3, "{}: {volumes:?}", problem.name);
        assert!((usual / volumes[3] - 1.0).abs() <= 3e-3, "{}: {usual} {volumes:?}", problem.name);
    }
}

/// Errors of the worn profile (largest, in the indentation depth), of it away from the front, of
/// the stick radius and of the volume.
fn errors(contact: &FrettingContact, exact: &FrettingContact) -> [f64; 4] {
    let (reach, depth, front) =
        (1.1 * exact.contact_radius(), exact.indentation_depth(), exact.stick_radius());
    let off = |r: f64| (contact.worn_depth_at(r) - exact.worn_depth_at(r)).abs() / depth;
    let radii = || (0..=1000).map(|i| reach * f64::from(i) / 1000.0);
    let relative = |a: f64, b: f64| (a / b - 1.0).abs();
    [
        radii().map(off).fold(0.0, f64::max),
        radii().filter(|r| (r / front - 1.0).abs() > 0.05).map(off).fold(0.0, f64::max),
        relative(contact.stick_radius(), front),
        relative(contact.wear_volume(), exact.wear_volume()),
    ]
}

/// What is delivered follows the tolerance, during the life and at its end, where the front stands
/// still and where it moves: against runs on the same cells at a tenth of the finest tolerance.
/// Behind a pinned front the worn depth starts like a square root, so that there an error in its
/// place counts by its root.
#[test]
fn the_delivered_error_follows_the_tolerance() {
    const TOLERANCES: [f64; 4] = [1e-2, 1e-3, 1e-4, 1e-5];
    for control in [NormalControl::Indentation, NormalControl::Force] {
        for (body, life) in [(PARABOLA, 0.36), (PARABOLA, 4.0), (CONE, 1.0)] {
            let problem = Problem::partial_slip(body, control, 0.4);
            let exact = lived(&problem, 256, 1e-6, life);
            let all = TOLERANCES.map(|tolerance| errors(&lived(&problem, 256, tolerance, life), &exact));
            println!("{} at {life}:", problem.name);
            for (error, tolerance) in all.iter().zip(TOLERANCES) {
                println!("  {tolerance:e}: {error:?}");
                assert!(error[0] <= 0.15 * tolerance.sqrt(), "{} at {life}: {all:?}", problem.name);
                for error in &error[1..] {
                    assert!(*error <= tolerance, "{} at {life}: {all:?}", problem.name);
                }
            }
            // a front that moves is followed by new meshes, whose errors are those of the cells:
            // below 1e-5 with 256. That of the volume may pass through zero, so that it is compared
            // with the largest at a looser tolerance
            let falls = |fine: f64, coarse: f64| {
                assert!(fine < coarse || fine < 1e-5, "{} at {life}: {all:?}", problem.name);
            };
            for (k, fine) in all.iter().enumerate().skip(1) {
                (0..3).for_each(|i| falls(fine[i], all[k - 1][i]));
                falls(fine[3], all[..k].iter().map(|looser| looser[3]).fold(0.0, f64::max));
            }
        }
    }
}

/// Worn volume on the way, one call each, at default settings, where slip comes near the axis of a
/// cone under a force. As wear takes the load off the rest, what sticks has to carry all of it, and
/// the smaller that is, the more V depends on the load. (With the load from the wear in parabolas
/// beside an exact body V was twice as far off.)
#[test]
fn slip_near_the_axis_of_a_cone_wears_as_on_fine_cells() {
    for (stick_ratio, most) in [(0.1, 1.5e-3), (0.02, 2e-3)] {
        let problem = Problem::partial_slip(CONE, NormalControl::Force, stick_ratio);
        let errors = [0.3, 1.0, 2.0, 4.0].map(|life| {
            let exact = lived(&problem, 256, 1e-5, life).wear_volume();
            lived(&problem, 64, 1e-3, life).wear_volume() / exact - 1.0
        });
        println!("{}: V {errors:?}", problem.name);
        assert!(errors.iter().all(|error| error.abs() <= most), "{}: {errors:?}", problem.name);
    }
}

/// Worn volume on the way to the final state, one call each, at default settings. A slip zone of a
/// twentieth of the radius can wear by a twentieth of the depth (cone), and is as exact.
#[test]
fn the_volume_on_the_way_is_exact_in_narrow_slip_zones_too() {
    for body in [PARABOLA, CONE] {
        for (stick_ratio, most) in [(0.4, 3e-4), (0.8, 2e-4), (0.9, 2e-4), (0.95, 2e-4)] {
            let problem = Problem::partial_slip(body, NormalControl::Indentation, stick_ratio);
            let errors = [0.01, 0.04, 0.16, 0.36, 0.64, 1.0, 4.0].map(|life| {
                let exact = lived(&problem, 192, 1e-5, life).wear_volume();
                lived(&problem, 64, 1e-3, life).wear_volume() / exact - 1.0
            });
            println!("{}: V {errors:?}", problem.name);
            assert!(errors.iter().all(|error| error.abs() <= most), "{}: {errors:?}", problem.name);
        }
    }
}
