//! What one update of the worn profile costs, against the number of cells.
//!
//! `cargo bench --bench profile_update`. The ball at constant depth in partial slip wears from an
//! early to a middle age. The time of the shortest of some runs is divided by the number of steps
//! tried. The call before, whose time stands in a column of its own, makes the mesh. Last comes the
//! exponent of growth.
#![allow(missing_docs, reason = "a benchmark")]

use fretting_contact::Parameters;
use fretting_contact::problems::Problem;
use std::time::{Duration, Instant};

/// Ñ before, and measured.
const LIVES: (f64, f64) = (0.05, 0.45);

/// Runs are repeated until they have taken this, at most five times.
const ENOUGH: Duration = Duration::from_secs(1);

fn main() {
    // cargo passes --bench when it benchmarks; anything else only wants to know that this runs
    let most = if std::env::args().any(|a| a == "--bench") { Parameters::RESOLUTION_RANGE.1 } else { 128 };
    println!("{:>8} {:>15} {:>8} {:>13}", "cells", "per update, ms", "updates", "made in, ms");
    let mut points = Vec::new();
    let mut cells = 64;
    while cells <= most {
        let time = measure(&Problem::parabola_at_constant_depth(), cells);
        if cells >= 128 {
            points.push(((cells as f64).ln(), time.ln()));
        }
        cells *= 2;
    }
    if points.len() > 1 {
        println!("exponent of growth from 128 cells on: {:.2}", slope(&points));
    }
}

/// Seconds per update.
fn measure(problem: &Problem, cells: usize) -> f64 {
    let mut problem = problem.clone();
    problem.parameters.resolution = cells;
    let mut young = problem.begin().expect("a ready problem begins");
    let start = Instant::now();
    problem.advance(&mut young, LIVES.0).expect("it wears");
    let made = start.elapsed();
    let before = *young.counters();
    let (mut shortest, mut spent) = (Duration::MAX, Duration::ZERO);
    let mut after = before;
    for _ in 0..5 {
        let mut contact = young.clone();
        let start = Instant::now();
        problem.advance(&mut contact, LIVES.1).expect("it wears");
        let time = start.elapsed();
        (shortest, spent) = (shortest.min(time), spent + time);
        after = *contact.counters();
        if spent >= ENOUGH {
            break;
        }
    }
    let updates = after.factorisations - before.factorisations;
    let time = shortest.as_secs_f64() / updates as f64;
    let made = made.as_secs_f64() * 1e3;
    println!("{cells:>8} {:>15.3} {updates:>8} {made:>13.1}", time * 1e3);
    time
}

/// Of the least-squares line.
fn slope(points: &[(f64, f64)]) -> f64 {
    let mean = |pick: fn(&(f64, f64)) -> f64| points.iter().map(pick).sum::<f64>() / points.len() as f64;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum::<f64>()
        / points.iter().map(|p| (p.0 - x).powi(2)).sum::<f64>()
}
