//! Error against run time: lives, a Mindlin loop, and on the same axes the published procedure and a plain spring row.
//! Writes `reports/error_against_time.csv` and `.md`.
//!
//! `cargo run --release --no-default-features --example precision [-- folder]`

#[path = "../../benches/published/mod.rs"]
mod published;

use fretting_contact::problems::Problem;
use fretting_contact::reference::TangentialContact;
use fretting_contact::reference::springs::PlainSpringRow;
use fretting_contact::{Error, FrettingContact};
use published::{Published, Scheme, Settings};
use std::fmt::Write as _;
use std::path::PathBuf;
use std::process::Command;
use std::time::Instant;

const RESOLUTIONS: [usize; 4] = [16, 32, 64, 128];
const TOLERANCES: [f64; 4] = [1e-2, 1e-3, 1e-4, 1e-5];
/// What stands for the truth where no closed form is known, and the run that tells its error; the next pair where the
/// engine refuses one.
const TIGHT: [[(usize, f64); 2]; 2] = [[(256, 1e-5), (192, 1e-5)], [(160, 1e-5), (112, 1e-5)]];
/// Calls in which these are made: one call is limited in its steps.
const TIGHT_CALLS: u32 = 40;
/// Points per a₀ of the published procedure; the next is left out where one takes longer than [`PATIENCE`].
const POINTS: [usize; 4] = [50, 100, 200, 400];
/// Seconds.
const PATIENCE: f64 = 2.0;
/// Displacement increments per cycle of the published procedure.
const INCREMENTS: usize = 20;
/// Runs for a median; one where a run takes longer than [`PATIENCE`].
const REPEATS: usize = 5;
/// Errors that the settings are given for.
const TARGETS: [f64; 3] = [1e-2, 1e-3, 1e-4];

/// One point of the pictures.
struct Point {
    problem: String,
    method: &'static str,
    settings: String,
    error: f64,
    /// Median, least and most, s.
    time: [f64; 3],
    /// Counted work, or why there is none.
    note: String,
}

/// What a life is compared with.
struct Truth {
    worn: Box<dyn Fn(f64) -> f64>,
    reach: f64,
    error: f64,
    source: String,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| "reports".into()));
    std::fs::create_dir_all(&folder)?;
    let gross_slip = [Problem::flat_punch_in_gross_slip(), Problem::sphere_in_gross_slip()];
    let mut points = Vec::new();
    let mut truths = Vec::new();
    for problem in Problem::published().into_iter().chain(gross_slip) {
        match truth(&problem) {
            Ok(truth) => {
                points.extend(lives(&problem, &truth));
                truths.push((problem.name, truth.source, truth.error));
            }
            Err(error) => truths.push((problem.name, format!("none: {error}"), f64::NAN)),
        }
    }
    points.extend(loops()?);
    std::fs::write(folder.join("error_against_time.csv"), csv(&points))?;
    std::fs::write(folder.join("error_against_time.md"), page(&points, &truths))?;
    Ok(())
}

/// A contact that has lived to the last check point.
fn lived(
    problem: &Problem,
    (resolution, tolerance): (usize, f64),
    calls: u32,
) -> Result<FrettingContact, Error> {
    let mut problem = problem.clone();
    problem.parameters.resolution = resolution;
    problem.parameters.tolerance = tolerance;
    let mut contact = problem.begin()?;
    for _ in 0..calls {
        problem.advance(&mut contact, last(&problem) / f64::from(calls))?;
    }
    Ok(contact)
}

fn last(problem: &Problem) -> f64 {
    problem.checkpoints.last().copied().unwrap_or(1.0)
}

fn truth(problem: &Problem) -> Result<Truth, Error> {
    if let Some(end) = problem.end {
        let source =
            format!("closed final state; what is left to wear at N/N0 = {} is in the errors", last(problem));
        let reach = 1.1 * end.outer_radius();
        return Ok(Truth { worn: Box::new(move |r| end.worn_depth(r)), reach, error: 0.0, source });
    }
    let tightly = |settings| lived(problem, settings, TIGHT_CALLS);
    let (tight, next, contact, other) = match TIGHT.map(|[tight, next]| (tight, next)) {
        [(tight, next), (other_tight, other_next)] => match (tightly(tight), tightly(next)) {
            (Ok(contact), Ok(other)) => (tight, next, contact, other),
            _ => (other_tight, other_next, tightly(other_tight)?, tightly(other_next)?),
        },
    };
    let reach = 1.02 * contact.contact_radius();
    let error = sup(reach, problem.depth(), |r| contact.worn_depth_at(r), |r| other.worn_depth_at(r));
    let source =
        format!("engine at resolution {}, tolerance {:e}, less that at {}", tight.0, tight.1, next.0);
    Ok(Truth { worn: Box::new(move |r| contact.worn_depth_at(r)), reach, error, source })
}

/// Largest difference of two worn profiles at 1000 even radii, in d₀.
fn sup(reach: f64, depth: f64, one: impl Fn(f64) -> f64, other: impl Fn(f64) -> f64) -> f64 {
    let radii = (0..1000).map(|i| reach * f64::from(i) / 1000.0);
    radii.map(|r| (one(r) - other(r)).abs() / depth).fold(0.0, f64::max)
}

/// The median of repeated runs with its spread, s.
fn timed(mut run: impl FnMut()) -> [f64; 3] {
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

fn lives(problem: &Problem, truth: &Truth) -> Vec<Point> {
    let mut points = Vec::new();
    let error = |worn: &dyn Fn(f64) -> f64| sup(truth.reach, problem.depth(), worn, &truth.worn);
    for resolution in RESOLUTIONS {
        for tolerance in TOLERANCES {
            let (error, note) = match lived(problem, (resolution, tolerance), 1) {
                Ok(contact) => (error(&|r| contact.worn_depth_at(r)), contact.counters().to_string()),
                Err(refusal) => (f64::NAN, refusal.to_string()),
            };
            let time = timed(|| drop(std::hint::black_box(lived(problem, (resolution, tolerance), 1))));
            let settings = format!("resolution {resolution}, tolerance {tolerance:e}");
            points.push(Point {
                problem: problem.name.clone(),
                method: "engine",
                settings,
                error,
                time,
                note,
            });
        }
    }
    // its grid knows neither the rim of a punch nor gross slip
    if problem.stick_radius() > 0.0 {
        for count in POINTS {
            let settings = Settings::fewest_cycles(problem, last(problem), Scheme::Causal, count, INCREMENTS);
            let reach = 1.05 * truth.reach / problem.contact_radius();
            let mut run = Published::new(problem, last(problem), reach, settings);
            let start = Instant::now();
            run.run();
            let time = [start.elapsed().as_secs_f64(); 3];
            points.push(Point {
                problem: problem.name.clone(),
                method: "published",
                settings: format!("{count} points per a0"),
                error: error(&|r| run.worn_depth_at(r)),
                time,
                note: format!("{} time steps", run.steps()),
            });
            if time[0] > PATIENCE {
                break;
            }
        }
    }
    for point in &points {
        println!(
            "{}: {}, {}: {:.1e} in {:.3e} s",
            point.problem, point.method, point.settings, point.error, point.time[0]
        );
    }
    points
}

/// Steps of a stroke of the loop.
const STROKE: u32 = 50;
/// Loops that are timed together.
const LOOPS: u32 = 20;

/// A Mindlin loop of the ball at 0.75 u_max and constant force: largest error of T on it, in μF_N; time of one step.
fn loops() -> Result<Vec<Point>, Error> {
    let mut problem = Problem::parabola_at_constant_force();
    problem.parameters.wear_coefficient = 0.0;
    let start = problem.start;
    let amplitude = 0.75 * start.full_slip();
    let mut points = Vec::new();
    let engine = problem.begin()?;
    let steps = f64::from(LOOPS * 2 * STROKE);
    let run = |measure: bool| {
        let mut contact = engine.clone();
        let force =
            |u: f64| contact.advance_to(problem.normal, u).map_or(f64::NAN, |()| contact.tangential_force());
        loop_error(&start, amplitude, measure, force)
    };
    let time = timed(|| _ = std::hint::black_box(run(false))).map(|t| t / steps);
    let note = "time is that of a step".to_string();
    let name = "Mindlin loop, ball".to_string();
    points.push(Point {
        problem: name.clone(),
        method: "engine",
        settings: "any".into(),
        error: run(true),
        time,
        note: note.clone(),
    });
    for count in [50, 100, 200, 400, 800, 1600] {
        let normal = start.normal;
        let length = 1.05 * normal.radius();
        let run = |measure: bool| {
            let mut row = PlainSpringRow::under(
                normal.shape(),
                length,
                count,
                normal.modulus(),
                start.modulus,
                start.friction,
            );
            row.advance(problem.normal, 0.0, 1);
            loop_error(&start, amplitude, measure, |u| {
                row.advance(problem.normal, u, 1);
                row.tangential_force()
            })
        };
        let time = timed(|| _ = std::hint::black_box(run(false))).map(|t| t / steps);
        let settings = format!("{count} springs");
        points.push(Point {
            problem: name.clone(),
            method: "plain spring row",
            settings,
            error: run(true),
            time,
            note: note.clone(),
        });
    }
    Ok(points)
}

/// Loading to the amplitude, then loops.
fn loop_error(
    start: &TangentialContact,
    amplitude: f64,
    measure: bool,
    mut force: impl FnMut(f64) -> f64,
) -> f64 {
    let limit = start.friction * start.normal.force();
    force(amplitude);
    let mut worst = 0.0_f64;
    for _ in 0..if measure { 1 } else { LOOPS } {
        for sign in [1.0, -1.0] {
            for k in 1..=STROKE {
                let u = amplitude * (1.0 - 2.0 * f64::from(k) / f64::from(STROKE));
                let measured = force(sign * u);
                if measure {
                    let off = (measured - sign * start.returning(amplitude, u)).abs() / limit;
                    worst = if off <= worst { worst } else { off };
                }
            }
        }
    }
    worst
}

fn csv(points: &[Point]) -> String {
    let mut text = String::from("problem,method,settings,error,seconds,seconds_least,seconds_most,note\n");
    for Point { problem, method, settings, error, time: [median, least, most], note } in points {
        let _ = writeln!(
            text,
            "\"{problem}\",{method},\"{settings}\",{error:e},{median:e},{least:e},{most:e},\"{note}\""
        );
    }
    text
}

/// The fastest point of the engine that keeps an error.
fn fastest<'a>(points: &'a [Point], problem: &str, target: f64) -> Option<&'a Point> {
    let fitting = points.iter().filter(|p| p.problem == problem && p.method == "engine" && p.error <= target);
    fitting.min_by(|a, b| a.time[0].total_cmp(&b.time[0]))
}

/// The best that the published procedure came to, and what that costs here.
fn against_published(points: &[Point], problem: &str) -> String {
    let theirs = points.iter().filter(|p| p.problem == problem && p.method == "published");
    let Some(best) = theirs.min_by(|a, b| a.error.total_cmp(&b.error)) else { return "not run".into() };
    let ratio = fastest(points, problem, best.error).map_or(String::new(), |p| {
        format!("; engine as good in 1/{:.0} of the time", best.time[0] / p.time[0])
    });
    format!("{:.1e} in {:.0} ms ({}){ratio}", best.error, 1e3 * best.time[0], best.settings)
}

fn page(points: &[Point], truths: &[(String, String, f64)]) -> String {
    let mut text = String::from(
        "# Error against run time\n\n**For an error of 1 %, 0.1 %, 0.01 % take these settings.** Error: largest one of \
         the worn profile at the end of the life, in the initial depth d₀. Time: of the whole life, one core.\n\n\
         | life | 1 % | 0.1 % | 0.01 % | published procedure at its best |\n| --- | --- | --- | --- | --- |\n",
    );
    for (problem, _, own) in truths {
        let cell = |target: f64| {
            if *own > 0.5 * target || own.is_nan() {
                return format!("not known: the truth is good to {own:.0e}");
            }
            let fitting = fastest(points, problem, target);
            fitting.map_or("not reached".into(), |p| format!("{}: {:.1} ms", p.settings, 1e3 * p.time[0]))
        };
        let cells = TARGETS.map(cell).join(" | ");
        let _ = writeln!(text, "| {problem} | {cells} | {} |", against_published(points, problem));
    }
    text += "\n![Error against time](error_against_time.svg)\n\nThe published procedure runs on up to 400 points per a₀, with the longest stable time step; \
             its grid does not know gross slip.\n\n## What the errors are taken against\n\n| life | truth | its own error, d₀ |\n| --- | --- | --- |\n";
    for (problem, source, error) in truths {
        let _ = writeln!(text, "| {problem} | {source} | {error:.1e} |");
    }
    text += "\n## Every point\n\nTimes are medians, with the least and the most: a wide spread says that the machine had other work. The published procedure ran once. Counted work is in the CSV.\n\n\
             | problem | method | settings | error | time, s | least | most |\n| --- | --- | --- | --- | --- | --- | --- |\n";
    for Point { problem, method, settings, error, time: [median, least, most], .. } in points {
        let _ = writeln!(
            text,
            "| {problem} | {method} | {settings} | {error:.1e} | {median:.2e} | {least:.2e} | {most:.2e} |"
        );
    }
    let said = |program: &str, arguments: &[&str]| {
        let output = Command::new(program).args(arguments).output();
        output.map_or("unknown".into(), |o| String::from_utf8_lossy(&o.stdout).trim().to_string())
    };
    let processor = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let processor = processor.lines().find_map(|l| l.strip_prefix("model name")).unwrap_or("unknown");
    let _ = writeln!(
        text,
        "\nProcessor {}; {}; commit {}.",
        processor.trim_start_matches([' ', '\t', ':']),
        said("rustc", &["-V"]),
        said("git", &["describe", "--always", "--dirty"])
    );
    text
}
