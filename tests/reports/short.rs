//! A short version of the reports, without a clock: a part of the extreme scenes, taken by a rule
//! and not by their outcome, and error against tolerance and resolution.

use crate::judge::Judge;
use crate::scenes::{self, Scene};
use fretting_contact::Error;
use fretting_contact::problems::Problem;

/// Of the scenes every so many-th is run, whatever becomes of it, and all of some kinds.
const EVERY: usize = 7;
/// Inputs and parameters at the ends of double precision, and the kinds of scenes that needed
/// corrections.
const ALL_OF: [&str; 5] = ["input", "parameter", "fast wear", "one step wears more than d0", "amplitude"];

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

#[test]
fn extreme_scenes_keep_every_invariant_or_are_refused() {
    let mut run = 0;
    for (index, scene) in scenes::all().iter().enumerate() {
        if index % EVERY == 0 || ALL_OF.contains(&scene.name.as_str()) {
            // a refusal is as good as an end: that it changes nothing is among the invariants
            let (_, broken) = judged(scene);
            assert_eq!(broken, None, "{}", scene.title());
            run += 1;
        }
    }
    assert!(run >= 30, "only {run} scenes");
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
