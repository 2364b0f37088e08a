//! The page: first which settings give which error in which time, then with what it is compared,
//! then every point.

use super::machine;
use super::point::{Comparison, Point};
use std::fmt::Write as _;

/// Errors that the settings are given for.
const TARGETS: [f64; 3] = [1e-2, 1e-3, 1e-4];

/// One of the two errors of a point.
type Measure = fn(&Point) -> f64;

/// The fastest point of the engine that keeps an error.
fn fastest<'a>(points: &'a [Point], problem: &str, target: f64, measure: Measure) -> Option<&'a Point> {
    let of_engine = |p: &&Point| p.problem == problem && p.method == "engine";
    let fitting = points.iter().filter(of_engine).filter(|p| measure(p) <= target);
    fitting.min_by(|a, b| a.time[0].total_cmp(&b.time[0]))
}

/// What the other methods cost, each at its most exact and at its finest, against the engine with
/// at most that error.
fn against_others(points: &[Point], problem: &str, measure: Measure) -> String {
    let mut said = Vec::new();
    for method in ["published", "plain spring row", "boundary elements"] {
        let theirs = || points.iter().filter(|p| p.problem == problem && p.method == method);
        let best =
            theirs().filter(|p| measure(p).is_finite()).min_by(|a, b| measure(a).total_cmp(&measure(b)));
        let Some(best) = best else { continue };
        let mut shown = vec![best];
        shown.extend(theirs().next_back().filter(|finest| finest.settings != best.settings));
        for point in shown {
            let ratio =
                fastest(points, problem, measure(point), measure).map_or("engine: not reached".into(), |p| {
                    let ratio = point.time[0] / p.time[0];
                    if ratio >= 1.0 {
                        format!("engine **{} times faster**", short(ratio))
                    } else {
                        format!("engine {:.1} times slower", 1.0 / ratio)
                    }
                });
            let Point { settings, time: [median, ..], .. } = point;
            said.push(format!("{method}, {settings}: {:.1e} in {}; {ratio}", measure(point), time(*median)));
        }
    }
    if said.is_empty() { "–".into() } else { said.join("<br>") }
}

/// Two digits.
fn short(number: f64) -> String {
    match number {
        n if n >= 1e4 => format!("{n:.0e}"),
        n if n >= 100.0 => format!("{:.0}", 10.0 * (n / 10.0).round()),
        n => format!("{n:.1}"),
    }
}

/// An error, or a dash for none.
fn share(error: f64) -> String {
    if error.is_nan() { "–".into() } else { format!("{error:.1e}") }
}

fn time(seconds: f64) -> String {
    match seconds {
        s if s >= 1.0 => format!("{s:.1} s"),
        s if s >= 1e-3 => format!("{:.1} ms", 1e3 * s),
        s if s >= 1e-6 => format!("{:.1} µs", 1e6 * s),
        s => format!("{:.0} ns", 1e9 * s),
    }
}

fn answers(
    text: &mut String,
    points: &[Point],
    comparisons: &[Comparison],
    measure: Measure,
    own: fn(&Comparison) -> f64,
) {
    for about in comparisons {
        let problem = &about.problem;
        if !points.iter().any(|p| p.problem == *problem && measure(p).is_finite()) {
            continue;
        }
        let cells = TARGETS.map(|target| {
            let own = own(about);
            if own > 0.5 * target || own.is_nan() {
                return format!("not known: the reference is accurate to {own:.0e}");
            }
            fastest(points, problem, target, measure)
                .map_or("not reached".into(), |p| format!("{}: **{}**", p.settings, time(p.time[0])))
        });
        let _ = writeln!(text, "| {problem} ({}) | {} |", about.time_of, cells.join(" | "));
    }
}

pub(crate) fn page(points: &[Point], comparisons: &[Comparison], word: &str) -> String {
    let mut text = String::from(
        "# Error against run time\n\n**For an error of 1 %, 0.1 %, 0.01 % take these settings, it costs this much** (one core). With wear the \
         error is the largest one of the worn profile, in the initial depth d₀: its worst place is the edge of the stick zone. \
         Without wear it is that of T in μF_N, or of the pressure.\n\n\
         | problem (time of) | 1 % | 0.1 % | 0.01 % |\n| --- | --- | --- | --- |\n",
    );
    answers(&mut text, points, comparisons, |p| p.error, |t| t.own[0]);
    text += "\nWho wants only the worn volume, or the work of friction, takes:\n\n\
             | problem (time of) | 1 % | 0.1 % | 0.01 % |\n| --- | --- | --- | --- |\n";
    answers(&mut text, points, comparisons, |p| p.work_error, |t| t.own[1]);
    text += "\nOther methods in the same run, each at its most exact and at its finest, and the engine with at most that error:\n\n\
             | problem | by the profile, T or pressure | by the worn volume or work |\n| --- | --- | --- |\n";
    for about in comparisons {
        let others = against_others(points, &about.problem, |p| p.error);
        if others != "–" {
            let by_work = against_others(points, &about.problem, |p| p.work_error);
            let _ = writeln!(text, "| {} | {others} | {by_work} |", about.problem);
        }
    }
    let _ = writeln!(
        text,
        "\n![Error against time](error_against_time.png)\n\nPublished: the procedure of the paper on up to 400 points per a₀, with its \
         longest stable time step, median of three runs; its grid does not know gross slip. Plain spring row: the same springs without transforms, \
         hence without wear. {word}\n\n## With what are the results compared?\n\n| problem | error of | reference | its own error | of the \
         volume or work |\n| --- | --- | --- | --- | --- |"
    );
    for Comparison { problem, of, reference, own, .. } in comparisons {
        let _ = writeln!(text, "| {problem} | {of} | {reference} | {} | {} |", share(own[0]), share(own[1]));
    }
    text += "\n## Every point\n\nTimes are medians of seven runs, with the least and the most: a wide spread says that the machine had other \
             work. Counted work, which no machine changes, is in the CSV.\n\n\
             | problem | method | settings | error | of volume or work | time | least | most |\n| --- | --- | --- | --- | --- | --- | --- | --- |\n";
    for Point { problem, method, settings, error, work_error, time: [median, least, most], .. } in points {
        let _ = writeln!(
            text,
            "| {problem} | {method} | {settings} | {} | {} | {} | {} | {} |",
            share(*error),
            share(*work_error),
            time(*median),
            time(*least),
            time(*most)
        );
    }
    let _ = writeln!(text, "\n{}", machine::provenance());
    text
}
