//! A short version of the reports, without a clock: the extreme scenes, and error against tolerance
//! and resolution.

use crate::judge::Judge;
use crate::scenes::{self, Scene};
use fretting_contact::Error;
use fretting_contact::problems::Problem;

/// The outcomes that the report shows.
const REPORT: &str = include_str!("../../reports/stability.csv");

/// Work of 1e600 J: any number would be a wrong one.
const REFUSED: [(&str, &str); 2] = [("input", "both 1e300, wear"), ("input", "both 1e300, no wear")];

/// The outcome of a scene, and the invariant that it breaks, if any.
fn judged(scene: &Scene) -> (Result<(), Error>, Option<String>) {
    let mut judge = Judge::default();
    let outcome = (scene.run)(&mut judge);
    println!("{}: {outcome:?}, {:?}", scene.title(), judge.worst());
    let broken = judge.worst().filter(|worst| worst.broken()).map(|worst| format!("{worst:?}"));
    (outcome, broken)
}

/// Whether the report shows a scene as refused.
fn is_refused_in_report(scene: &Scene) -> bool {
    let line = |outcome: &str| format!("\"{}\",\"{}\",\"{outcome}\"", scene.name, scene.extreme);
    let refused = REPORT.contains(&line("refused"));
    assert!(refused || REPORT.contains(&line("passed")), "not in the report: {}", scene.title());
    refused
}

/// Runs every second scene.
fn keep_every_invariant(first: usize) {
    for scene in scenes::all().iter().skip(first).step_by(2) {
        // that a refusal changes nothing is among the invariants
        let (outcome, broken) = judged(scene);
        assert_eq!(broken, None, "{}", scene.title());
        assert!(outcome.is_ok() || is_refused_in_report(scene), "{}: {outcome:?}", scene.title());
    }
}

#[test]
fn extreme_scenes_keep_every_invariant_and_none_is_newly_refused() {
    keep_every_invariant(0);
}

#[test]
fn the_other_extreme_scenes_do_so_too() {
    keep_every_invariant(1);
}

#[test]
fn what_double_precision_cannot_hold_is_refused() {
    let all = scenes::all();
    for (name, extreme) in REFUSED {
        let scene = all.iter().find(|scene| scene.name == name && scene.extreme == extreme);
        let scene = scene.unwrap_or_else(|| panic!("no scene {name}, {extreme}"));
        assert!(judged(scene).0.is_err(), "{}", scene.title());
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
    let [coarse, fine] = [48, 192].map(|resolution| delivered(resolution, 1e-6));
    let order = (coarse / fine).ln() / 4.0_f64.ln();
    assert!(order >= 1.5, "{coarse:e} {fine:e}: order {order}");
}
