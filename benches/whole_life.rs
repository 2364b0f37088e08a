//! Whole lives to the final state: the engine against the published procedure, error and time in
//! the same run.
//!
//! `cargo bench --bench whole_life` takes about a minute; `cargo bench --bench whole_life --
//! --long` adds the finest grids (some ten minutes). A word runs the scenes whose name has it.
//! Errors are those of the closed final state where the depth is held; at constant force, where
//! none is known, those against the engine at a tight tolerance, which the table names.
//!
//! The engine's times are medians of repeated lives, each from a new contact. The published
//! procedure runs once, with the longest time step that is stable; making its matrices is not
//! counted. Its grids put a point on the stick edge, which is the best place for them.

mod published;

use fretting_contact::problems::{CONE, PARABOLA, Problem};
use fretting_contact::{Error, FrettingContact, NormalControl, Parameters};
use published::{Published, Scheme, Settings};
use std::time::{Duration, Instant};

/// Displacement increments per cycle of the published procedure.
const INCREMENTS: usize = 20;
/// Cycles of a life in the paper's own examples.
const PAPER_CYCLES: usize = 10_000;
/// Resolution and tolerance of the run that stands for the truth at constant force.
const TIGHT: (usize, f64) = (128, 1e-4);
/// Calls in which that run is made: one call is limited in its steps.
const TIGHT_CALLS: u32 = 100;

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let asked = |name: &str| arguments.iter().any(|a| a == name);
    // cargo passes --bench when it benchmarks; anything else only wants to know that this runs
    let effort = match (asked("--bench"), asked("--long")) {
        (false, _) => Effort { points: &[25], paper: &[], tight: (64, 1e-3), repeats: 1 },
        (true, false) => {
            Effort { points: &[50, 100, 200, 400, 800], paper: &[100], tight: TIGHT, repeats: 15 }
        }
        (true, true) => {
            Effort { points: &[50, 100, 200, 400, 800, 1600], paper: &[100, 200], tight: TIGHT, repeats: 51 }
        }
    };
    let scenes = [
        Scene {
            problem: Problem::partial_slip(PARABOLA, NormalControl::Indentation, 0.4),
            life: 9.0,
            reach: 1.5,
        },
        Scene {
            problem: Problem::partial_slip(CONE, NormalControl::Indentation, 0.4),
            life: 9.0,
            reach: 1.65,
        },
        Scene { problem: Problem::parabola_at_constant_force(), life: 4.0, reach: 2.2 },
    ];
    let words: Vec<&String> = arguments.iter().skip(1).filter(|word| !word.starts_with('-')).collect();
    let asked =
        |scene: &&Scene| words.is_empty() || words.iter().any(|word| scene.problem.name.contains(*word));
    scenes.iter().filter(asked).for_each(|scene| scene.report(&effort));
}

/// How much to run.
struct Effort {
    /// Grid points per a₀.
    points: &'static [usize],
    /// Those of the runs with the paper's own number of cycles.
    paper: &'static [usize],
    /// Resolution and tolerance of the engine where it stands for the truth.
    tight: (usize, f64),
    /// Lives of the engine for a median.
    repeats: usize,
}

/// A problem and the life it is run for.
struct Scene {
    problem: Problem,
    /// Ñ.
    life: f64,
    /// End of the uniform grid, in a₀: beyond the largest contact of any run.
    reach: f64,
}

/// What the errors are taken against.
enum Truth {
    /// The closed final state of the problem.
    Closed,
    /// Volume (m³), depth (m) and stick radius (m) of a tight run.
    Tight([f64; 3]),
}

/// Where a run ended.
struct State {
    volume: f64,
    depth: f64,
    stick: f64,
    /// Sup error of the worn profile, d₀, where it is known.
    profile_error: Option<f64>,
}

/// One line of the table.
struct Line {
    method: &'static str,
    settings: String,
    /// Leading error: of the profile, or of the volume.
    errors: [f64; 3],
    time: Duration,
}

impl Scene {
    fn report(&self, effort: &Effort) {
        println!("\n{}, to N/N0 = {}", self.problem.name, self.life);
        let truth = match self.truth(effort) {
            Ok(truth) => truth,
            Err(error) => {
                println!("no truth to compare with: {error}");
                return;
            }
        };
        let heads = match truth {
            Truth::Closed => {
                println!("errors against the closed final state");
                ["profile, sup/d0", "V", "c"]
            }
            Truth::Tight(_) => {
                let (resolution, tolerance) = effort.tight;
                println!("errors against the engine at resolution {resolution}, tolerance {tolerance:e}");
                ["V", "d", "c"]
            }
        };
        let [first, second, third] = heads;
        println!(
            "{:<20} {:<34} {first:>16} {second:>9} {third:>9} {:>12} {:>10}",
            "method", "settings", "time", "/ engine"
        );
        let defaults = Parameters::default();
        let default = (defaults.resolution, defaults.tolerance);
        let engine = self.engine(default, &truth, effort.repeats);
        let unit = engine.as_ref().ok().map(|(line, _)| line.time);
        let shown = |done: &Result<(Line, String), Error>, tolerance: f64| match done {
            Ok((line, _)) => line.print(unit),
            Err(error) => println!("engine, tolerance {tolerance:e}: {error}"),
        };
        shown(&engine, default.1);
        let mut others = Vec::new();
        for (resolution, tolerance) in [(16, 1e-2), (32, 1e-2), (default.0, 1e-2), (default.0, 1e-4)] {
            let done = self.engine((resolution, tolerance), &truth, effort.repeats.min(5));
            shown(&done, tolerance);
            others.extend(done.ok().map(|(line, _)| line));
        }
        let mut causal = Vec::new();
        for (method, scheme) in
            [("published, plain", Scheme::Staggered), ("published, causal", Scheme::Causal)]
        {
            for &points in effort.points {
                // the staggered grid converges to something else: what it costs to see that is
                // enough
                if scheme == Scheme::Staggered && points > 400 {
                    continue;
                }
                let settings = Settings::fewest_cycles(&self.problem, self.life, scheme, points, INCREMENTS);
                let line = self.published(method, settings, &truth);
                line.print(unit);
                if scheme == Scheme::Causal {
                    causal.push((points as f64, line));
                }
            }
            for &points in effort.paper {
                let settings = Settings { scheme, points, increments: INCREMENTS, cycles: PAPER_CYCLES };
                self.published(method, settings, &truth).print(unit);
            }
        }
        if let Ok((engine, counted)) = engine {
            println!("engine, counted work: {counted}");
            if let Some((_, finest)) = causal.last() {
                compare(finest, others.iter().chain([&engine]));
            }
            if let Truth::Closed = truth {
                extrapolate(&causal, &engine);
            }
        }
    }

    fn truth(&self, effort: &Effort) -> Result<Truth, Error> {
        if self.problem.end.is_some() {
            return Ok(Truth::Closed);
        }
        let contact = self.contact(effort.tight, TIGHT_CALLS)?;
        Ok(Truth::Tight([contact.wear_volume(), contact.indentation_depth(), contact.stick_radius()]))
    }

    /// A contact that has lived, in one call or several.
    fn contact(&self, (resolution, tolerance): (usize, f64), calls: u32) -> Result<FrettingContact, Error> {
        let mut problem = self.problem.clone();
        problem.parameters.resolution = resolution;
        problem.parameters.tolerance = tolerance;
        let mut contact = problem.begin()?;
        for _ in 0..calls {
            problem.advance(&mut contact, self.life / f64::from(calls))?;
        }
        Ok(contact)
    }

    /// Its line, and the work that it counted.
    fn engine(&self, settings: (usize, f64), truth: &Truth, repeats: usize) -> Result<(Line, String), Error> {
        let contact = self.contact(settings, 1)?;
        let mut times: Vec<Duration> = (0..repeats)
            .map(|_| {
                let start = Instant::now();
                std::hint::black_box(self.contact(settings, 1)).map(|_| start.elapsed())
            })
            .collect::<Result<_, _>>()?;
        times.sort_unstable();
        let state = State {
            volume: contact.wear_volume(),
            depth: contact.indentation_depth(),
            stick: contact.stick_radius(),
            profile_error: self.problem.profile_error(|r| contact.worn_depth_at(r)),
        };
        let line = Line {
            method: "engine",
            settings: format!("resolution {}, tolerance {:e}", settings.0, settings.1),
            errors: self.errors(&state, truth),
            time: times[times.len() / 2],
        };
        Ok((line, contact.counters().to_string()))
    }

    fn published(&self, method: &'static str, settings: Settings, truth: &Truth) -> Line {
        let mut run = Published::new(&self.problem, self.life, self.reach, settings);
        let start = Instant::now();
        run.run();
        let time = start.elapsed();
        let state = State {
            volume: run.wear_volume(),
            depth: run.depth(),
            stick: run.stick_radius(),
            profile_error: self.problem.profile_error(|r| run.worn_depth_at(r)),
        };
        let Settings { points, cycles, increments, .. } = settings;
        let settings = format!("{points} per a0, {cycles} × {increments} steps");
        Line { method, settings, errors: self.errors(&state, truth), time }
    }

    /// The three errors of the table.
    fn errors(&self, state: &State, truth: &Truth) -> [f64; 3] {
        match (truth, self.problem.end, state.profile_error) {
            (Truth::Tight([volume, depth, stick]), ..) => {
                [state.volume / volume - 1.0, state.depth / depth - 1.0, state.stick / stick - 1.0]
            }
            (Truth::Closed, Some(end), Some(error)) => [
                error,
                state.volume / end.worn_volume() - 1.0,
                state.stick / self.problem.stick_radius() - 1.0,
            ],
            (Truth::Closed, ..) => [f64::NAN; 3],
        }
    }
}

impl Line {
    fn print(&self, unit: Option<Duration>) {
        let [first, second, third] = self.errors;
        let ratio =
            unit.map_or("-".into(), |unit| format!("{:.3}", self.time.as_secs_f64() / unit.as_secs_f64()));
        println!(
            "{:<20} {:<34} {first:>16.1e} {second:>+9.1e} {third:>+9.1e} {:>12} {ratio:>10}",
            self.method,
            self.settings,
            format!("{:.2?}", self.time),
        );
    }
}

/// The fastest run of the engine none of whose errors is larger than those of a published one.
fn compare<'a>(published: &Line, engine: impl Iterator<Item = &'a Line>) {
    let as_good =
        |line: &&Line| line.errors.iter().zip(published.errors).all(|(own, other)| own.abs() <= other.abs());
    if let Some(line) = engine.filter(as_good).min_by_key(|line| line.time) {
        println!(
            "published, {}: {:.0} times the time of the engine at no larger error ({})",
            published.settings,
            published.time.as_secs_f64() / line.time.as_secs_f64(),
            line.settings
        );
    }
}

/// What the published procedure would need for the engine's error: the measured order of its last
/// two grids, and work that grows with the cube of the points, as many more time steps times the
/// squared size of the transforms. An estimate, and named so.
fn extrapolate(lines: &[(f64, Line)], engine: &Line) {
    let [.., (coarse_points, coarse), (points, fine)] = lines else { return };
    let order = (coarse.errors[0] / fine.errors[0]).ln() / (points / coarse_points).ln();
    let finer = (fine.errors[0] / engine.errors[0]).powf(1.0 / order);
    println!(
        "published, causal: error of order {order:.2} in the points per a0; for the error of the engine, {:.1e}, an \
         extrapolation gives {:.0} points per a0 and {:.0e} times the engine's time",
        engine.errors[0],
        points * finer,
        fine.time.as_secs_f64() * finer.powi(3) / engine.time.as_secs_f64()
    );
}
