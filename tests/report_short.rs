//! A short version of the reports, without a clock: a dozen of the extreme scenes, and error against tolerance and
//! resolution.

#[path = "../examples/report/judge.rs"]
#[allow(dead_code, reason = "the report prints more of a finding than the test asks for")]
mod judge;
#[path = "../examples/report/scenes/mod.rs"]
#[allow(dead_code, reason = "scenes are looked up by name and extreme here")]
mod scenes;

use fretting_contact::problems::Problem;
use judge::Judge;

/// Scenes that run to their end with every invariant kept. Those of the short wearing life are not among them: the
/// profile read within a stroke misses its volume by 1 % in some, see `reports/stability.md`.
const SOUND: [(&str, &str); 15] = [
    ("friction", "mu = 0"),
    ("load jump in one step", "1e9 up, no wear"),
    ("load jump in one step", "1e18 down, no wear"),
    ("load jump in one step", "1e9 up, wear"),
    ("load jump in one step", "1e9 down, wear"),
    ("displacement step", "1e6 u_max, no wear"),
    ("displacement step", "1e6 u_max, wear"),
    ("displacement step", "1e-12 u_max, wear, depth held"),
    ("amplitude", "exactly u_max, force"),
    ("amplitude", "u_max (1 + 1e-12), depth"),
    ("amplitude", "shrinks 3 to 1e-3 u_max, depth"),
    ("input", "displacement 5e-324 m, wear"),
    ("input", "force 1e300 N, no wear"),
    ("input", "force 1e300 N, wear"),
    ("parameter", "E = 1e-300 Pa"),
];
/// Scenes beyond double precision, refused with the contact left as it was.
const REFUSED: [(&str, &str); 2] = [("input", "amplitude 1e300 m"), ("input", "displacement 1e300 m, wear")];

#[test]
fn extreme_scenes_keep_every_invariant_or_are_refused() {
    let wanted = SOUND.map(|key| (key, true)).into_iter().chain(REFUSED.map(|key| (key, false)));
    let all = scenes::all();
    for ((name, extreme), runs) in wanted {
        let scene = all.iter().find(|scene| scene.name == name && scene.extreme == extreme);
        let scene = scene.unwrap_or_else(|| panic!("no scene {name}, {extreme}"));
        let mut judge = Judge::default();
        let outcome = (scene.run)(&mut judge);
        println!("{name}, {extreme}: {outcome:?}, {:?}", judge.worst());
        assert_eq!(outcome.is_ok(), runs, "{name}, {extreme}: {outcome:?}");
        if let Some(worst) = judge.worst().filter(|worst| worst.broken()) {
            panic!("{name}, {extreme}: {worst:?}");
        }
    }
}

/// Error of the final profile of the parabola at constant depth, d₀.
fn delivered(resolution: usize, tolerance: f64) -> f64 {
    let mut problem = Problem::parabola_at_constant_depth();
    problem.parameters.resolution = resolution;
    problem.parameters.tolerance = tolerance;
    let mut contact = problem.begin().expect("a ready problem is valid");
    problem.advance(&mut contact, 9.0).expect("it can be advanced");
    let error = problem.profile_error(|r| contact.worn_depth_at(r)).expect("its end is known");
    println!("resolution {resolution}, tolerance {tolerance:e}: {error:.2e}, {}", contact.counters());
    error
}

#[test]
fn a_tighter_tolerance_delivers_no_more_error() {
    let runs = [1e-2, 1e-3, 1e-4, 1e-5].map(|tolerance| delivered(128, tolerance));
    for pair in runs.windows(2) {
        assert!(pair[1] <= pair[0], "{runs:?}");
    }
}

#[test]
fn the_error_falls_with_resolution_at_an_order_of_at_least_1_5() {
    // tight in time, so that what is left is of the cells
    let [coarse, fine] = [16, 64].map(|resolution| delivered(resolution, 1e-6));
    let order = (coarse / fine).ln() / 4.0_f64.ln();
    assert!(order >= 1.5, "{coarse:e} {fine:e}: order {order}");
}
