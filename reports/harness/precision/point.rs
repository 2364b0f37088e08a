//! A measured point: what was run, how wrong it is, how long it took.

use std::fmt::Write as _;
use std::time::Instant;

/// Seconds after which a run is neither repeated nor followed by a finer one.
pub(crate) const PATIENCE: f64 = 2.0;
/// Runs for a median.
const REPEATS: usize = 7;

/// One point of the pictures.
#[derive(Debug, Clone)]
pub(crate) struct Point {
    pub(crate) problem: String,
    pub(crate) method: &'static str,
    pub(crate) settings: String,
    /// Of the profile (in d₀), T (in μF_N) or the pressure (relative), by problem.
    pub(crate) error: f64,
    /// Of the worn volume, which is the work of friction, relative; NaN where it was not looked at.
    pub(crate) work_error: f64,
    /// Median, least and most, s.
    pub(crate) time: [f64; 3],
    /// Counted work, or why there is none.
    pub(crate) note: String,
}

/// What the points of a problem are compared with.
#[derive(Debug, Clone)]
pub(crate) struct Comparison {
    pub(crate) problem: String,
    /// What `error` is of.
    pub(crate) of: &'static str,
    /// What the time is of.
    pub(crate) time_of: &'static str,
    pub(crate) reference: String,
    /// The error of the reference itself, in both measures; NaN where there is none.
    pub(crate) own: [f64; 2],
}

/// The median of repeated runs with its spread, s.
pub(crate) fn timed(mut run: impl FnMut()) -> [f64; 3] {
    let mut times = Vec::new();
    for _ in 0..REPEATS {
        let start = Instant::now();
        run();
        times.push(start.elapsed().as_secs_f64());
        if times[0] > PATIENCE {
            break;
        }
    }
    times.sort_by(f64::total_cmp);
    [times[times.len() / 2], times[0], times[times.len() - 1]]
}

pub(crate) fn csv(points: &[Point], comparisons: &[Comparison]) -> String {
    let mut text = String::from(
        "problem,method,settings,error,work_error,seconds,seconds_least,seconds_most,reference_error,note\n",
    );
    for point in points {
        let Point { problem, method, settings, error, work_error, time: [median, least, most], note } = point;
        let own =
            comparisons.iter().find(|about| about.problem == *problem).map_or(f64::NAN, |about| about.own[0]);
        let _ = writeln!(
            text,
            "\"{problem}\",{method},\"{settings}\",{error:e},{work_error:e},{median:e},{least:e},{most:e},{own:e},\"{note}\""
        );
    }
    text
}
