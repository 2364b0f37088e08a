use super::*;
use crate::reference::wear::initial_rate;
use NormalControl::{Force, Indentation};

const RATIOS: [f64; 4] = [0.2, 0.4, 0.6, 0.8];

fn gross_slip() -> [Problem; 2] {
    [Problem::flat_punch_in_gross_slip(), Problem::sphere_in_gross_slip()]
}

fn sweep() -> Vec<Problem> {
    let at = |ratio| {
        [PARABOLA, CONE].map(|body| [Force, Indentation].map(|c| Problem::partial_slip(body, c, ratio)))
    };
    RATIOS.into_iter().flat_map(at).flatten().collect()
}

fn all() -> Vec<Problem> {
    Problem::published().into_iter().chain(gross_slip()).chain(sweep()).collect()
}

#[track_caller]
fn assert_close(value: f64, exact: f64, relative: f64, what: &str) {
    let error = (value / exact - 1.0).abs();
    assert!(error <= relative, "{what}: {value:e} against {exact:e}, off by {error:e}");
}

/// Worn by some 1e-4 of the unit, the engine's V/Ñ is the closed initial rate: Ñ, N₀, the amplitude
/// and the load belong together.
#[test]
fn life_is_counted_in_seed_cycles() {
    for problem in all() {
        let life = 1e-6;
        let mut contact = problem.begin().expect("a ready problem is valid");
        problem.advance(&mut contact, life).expect("it can be advanced");
        let limit = problem.start.friction * problem.start.normal.force();
        let rate = initial_rate(problem.start.loop_work(problem.amplitude), limit, problem.amplitude);
        let measured = contact.wear_volume() / problem.volume_unit() / life;
        assert_close(measured, rate, 1e-4, &format!("{}: dV/dN", problem.name));
    }
}

#[test]
fn the_unworn_contact_has_the_stated_scales() {
    for problem in all() {
        let mut contact = problem.begin().expect("a ready problem is valid");
        let name = &problem.name;
        assert_close(contact.contact_radius(), problem.contact_radius(), 1e-12, name);
        assert_close(contact.indentation_depth(), problem.depth(), 1e-12, name);
        assert_close(contact.normal_reaction(), NORMAL_FORCE, 1e-12, name);
        contact.advance_to(problem.normal, 0.0).expect("it is at rest");
        assert_eq!(contact.tangential_force(), 0.0);
    }
}

#[test]
fn the_amplitude_makes_the_stick_radius() {
    for problem in Problem::published().into_iter().chain(sweep()) {
        let mut contact = problem.begin().expect("a ready problem is valid");
        contact.advance_to(problem.normal, problem.amplitude).expect("a first loading");
        assert_close(contact.stick_radius(), problem.stick_radius(), 1e-11, &problem.name);
        let stated: f64 = problem.name.rsplit(' ').next().and_then(|c| c.parse().ok()).expect("a ratio");
        assert_close(problem.stick_radius() / problem.contact_radius(), stated, 1e-11, &problem.name);
    }
    for problem in gross_slip() {
        let mut contact = problem.begin().expect("a ready problem is valid");
        contact.advance_to(problem.normal, problem.amplitude).expect("a first loading");
        assert_eq!((contact.stick_radius(), problem.stick_radius()), (0.0, 0.0), "{}", problem.name);
    }
}

/// The final state is that of this very amplitude and depth, and only where the depth is held.
#[test]
fn the_final_state_belongs_to_the_problem() {
    for problem in all() {
        let held = problem.parameters.normal_control == Indentation;
        assert_eq!(problem.end.is_some(), held, "{}", problem.name);
        let Some(end) = problem.end else { continue };
        assert_close(problem.amplitude, end.amplitude(problem.start.slip_ratio()), 1e-11, "U0");
        assert!(end.outer_radius() > problem.contact_radius());
        assert!(end.normal_force(problem.start.normal.modulus()) < NORMAL_FORCE);
        // its profile has no error, one without wear misses the deepest point, one beyond the front
        // the whole of it
        assert_eq!(problem.profile_error(|r| end.worn_depth(r)), Some(0.0));
        let deepest = end.deepest_wear().1 / problem.depth();
        assert_close(problem.profile_error(|_| 0.0).expect("it has an end"), deepest, 1e-6, "unworn");
        let leak =
            |r| if r < 0.5 * problem.stick_radius() { 0.01 * problem.depth() } else { end.worn_depth(r) };
        assert_close(problem.profile_error(leak).expect("it has an end"), 0.01, 1e-12, "leak into the stick");
        assert!(problem.profile_error(|_| f64::NAN).expect("it has an end").is_nan());
    }
}

#[test]
fn check_points_are_those_of_the_tables() {
    for problem in Problem::published() {
        assert!(problem.checkpoints.is_sorted() && problem.checkpoints.len() == 5, "{}", problem.name);
        let places = problem.history.places();
        // the final state at Ñ = 9 has a closed form and no row
        let tabulated: Vec<f64> = problem.checkpoints.iter().copied().filter(|n| *n < 9.0).collect();
        assert!(places == tabulated || problem.history == History::Unknown, "{}", problem.name);
    }
    for problem in gross_slip() {
        for (life, path) in problem.checkpoints.iter().zip(problem.history.places()) {
            assert_close(problem.reduced_path(*life), path, 1e-14, &problem.name);
            // S = κE*s/a₀ with s = 4U₀N
            let per_path = problem.parameters.wear_per_work() * problem.start.friction;
            let slid = 4.0 * problem.amplitude * life * problem.seed_cycles();
            let reduced = per_path * problem.start.normal.modulus() * slid / problem.contact_radius();
            assert_close(reduced, path, 1e-13, &problem.name);
        }
    }
    // what the definition comes to: 3π Ñ for the sphere, 2π Ñ for the punch
    let [punch, sphere] = gross_slip();
    assert_close(punch.reduced_path(1.0), 2.0 * PI, 1e-13, "punch");
    assert_close(sphere.reduced_path(1.0), 3.0 * PI, 1e-13, "sphere");
}

#[test]
fn tables_are_given_only_for_their_own_scene() {
    for problem in sweep() {
        let known = problem.history != History::Unknown;
        let cone_at_depth =
            matches!(problem.start.normal.shape(), Shape::Cone { .. }) && problem.end.is_some();
        assert_eq!(known, problem.name.ends_with("= 0.4") && !cone_at_depth, "{}", problem.name);
    }
}

#[test]
fn the_flat_of_the_blunted_parabola_is_a_share_of_its_contact() {
    for ratio in [0.1, 0.3, 0.9] {
        let body = blunted_parabola(ratio);
        let start = initial(body);
        assert_close(body.flat_radius() / start.normal.radius(), ratio, 1e-12, "b/a0");
    }
}

#[test]
fn a_life_can_be_made_short_without_changing_what_happens() {
    let long = Problem::cone_at_constant_force();
    let short = long.clone().with_seed_cycles(200.0);
    assert_close(short.seed_cycles(), 200.0, 1e-14, "N0");
    let [long, short] = [long, short].map(|problem| {
        let mut contact = problem.begin().expect("a ready problem is valid");
        problem.advance(&mut contact, 0.1).expect("it can be advanced");
        contact.wear_volume()
    });
    // the steps are the same, except for the rounding of their control
    assert_close(short, long, 1e-7, "V at the same life");
}

#[test]
#[should_panic(expected = "between the flat and the edge of the contact")]
fn a_stick_radius_on_the_flat_is_refused() {
    Problem::partial_slip(blunted_parabola(0.5), Force, 0.4);
}

/// Error of the final profile of the ball at constant depth, in d₀.
fn final_error(resolution: usize, tolerance: f64) -> f64 {
    let mut problem = Problem::parabola_at_constant_depth();
    (problem.parameters.resolution, problem.parameters.tolerance) = (resolution, tolerance);
    let mut contact = problem.begin().expect("a ready problem begins");
    // until nothing is left to wear
    problem.advance(&mut contact, 1e7).expect("it wears to its end");
    problem.profile_error(|r| contact.worn_depth_at(r)).expect("the end is known")
}

#[test]
fn the_mesh_is_of_second_order_over_a_whole_life() {
    let (coarse, fine) = (final_error(64, 1e-6), final_error(256, 1e-6));
    let order = (coarse / fine).log2() / 2.0;
    assert!(order > 1.9, "{coarse:e} {fine:e}, order {order}");
}

#[test]
fn a_life_on_the_finest_mesh_is_better_than_its_tolerance() {
    let error = final_error(Parameters::RESOLUTION_RANGE.1, 1e-4);
    assert!(error < 2e-5, "{error:e}");
}
