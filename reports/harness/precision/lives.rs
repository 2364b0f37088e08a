//! Lives of many cycles: the paper's four cases and gross slip, by the engine and by the published
//! procedure.

use super::point::{Comparison, PATIENCE, Point, timed};
use super::published::{Published, Scheme, Settings};
use fretting_contact::problems::Problem;
use fretting_contact::{Error, FrettingContact};
use std::time::Instant;

const RESOLUTIONS: [usize; 4] = [16, 32, 64, 128];
const TOLERANCES: [f64; 4] = [1e-2, 1e-3, 1e-4, 1e-5];
/// A run that may serve as reference: resolution, tolerance, and calls in which it is made,
/// since one call is limited in its steps.
type Tight = (usize, f64, u32);
/// The reference where no closed form is known, and the runs whose largest difference from it is
/// taken as its error; the next three where the engine refuses one.
const TIGHT: [[Tight; 3]; 3] = [
    [(256, 1e-6, 40), (192, 1e-6, 30), (160, 1e-6, 20)],
    [(256, 1e-5, 40), (192, 1e-5, 30), (160, 1e-5, 20)],
    [(128, 1e-5, 40), (112, 1e-5, 30), (96, 1e-5, 20)],
];
/// Points per a₀ of the published procedure; the next is left out where one takes longer than
/// [`PATIENCE`].
const POINTS: [usize; 4] = [50, 100, 200, 400];
/// Displacement increments per cycle of the published procedure.
const INCREMENTS: usize = 20;
/// Runs of the published procedure for a median.
const RUNS: usize = 3;
/// Radii at which profiles are compared.
const RADII: u32 = 1000;

/// What a life is compared with.
struct Truth {
    worn: Box<dyn Fn(f64) -> f64>,
    volume: f64,
    reach: f64,
}

/// All lives of all problems.
pub(crate) fn all() -> (Vec<Point>, Vec<Comparison>) {
    let gross_slip = [Problem::flat_punch_in_gross_slip(), Problem::sphere_in_gross_slip()];
    let (mut points, mut comparisons) = (Vec::new(), Vec::new());
    for problem in Problem::published().into_iter().chain(gross_slip) {
        println!("  {} …", problem.name);
        let about = |reference: String, own| Comparison {
            problem: problem.name.clone(),
            of: "worn profile at the end, largest error in d₀",
            time_of: "the whole life",
            reference,
            own,
        };
        match reference(&problem) {
            Ok((reference, source, own)) => {
                points.extend(of_the_engine(&problem, &reference));
                points.extend(as_published(&problem, &reference));
                comparisons.push(about(source, own));
            }
            Err(error) => comparisons.push(about(format!("none: {error}"), [f64::NAN; 2])),
        }
    }
    (points, comparisons)
}

/// A contact that has lived to the last check point.
fn lived(problem: &Problem, settings: (usize, f64), calls: u32) -> Result<FrettingContact, Error> {
    let mut problem = problem.clone();
    (problem.parameters.resolution, problem.parameters.tolerance) = settings;
    let mut contact = problem.begin()?;
    for _ in 0..calls {
        problem.advance(&mut contact, last(&problem) / f64::from(calls))?;
    }
    Ok(contact)
}

fn last(problem: &Problem) -> f64 {
    problem.checkpoints.last().copied().unwrap_or(1.0)
}

/// The reference, where it comes from, and its own errors.
fn reference(problem: &Problem) -> Result<(Truth, String, [f64; 2]), Error> {
    if let Some(end) = problem.end {
        let source =
            format!("closed final state; what is left to wear at N/N₀ = {} is in the errors", last(problem));
        let (reach, volume) = (1.1 * end.outer_radius(), end.worn_volume());
        return Ok((Truth { worn: Box::new(move |r| end.worn_depth(r)), volume, reach }, source, [0.0; 2]));
    }
    let mut refusal = None;
    for tight in TIGHT {
        let runs: Result<Vec<_>, Error> =
            tight.iter().map(|(n, t, calls)| lived(problem, (*n, *t), *calls)).collect();
        let mut runs = match runs {
            Ok(runs) => runs,
            Err(error) => {
                refusal = Some(error);
                continue;
            }
        };
        let contact = runs.remove(0);
        let reach = 1.02 * contact.contact_radius();
        let off = |other: &FrettingContact| {
            sup(reach, problem.depth(), |r| contact.worn_depth_at(r), |r| other.worn_depth_at(r))
        };
        let own = runs.iter().map(off).fold(0.0, f64::max);
        let volume = contact.wear_volume();
        let off = |other: &FrettingContact| (other.wear_volume() / volume - 1.0).abs();
        let own_volume = runs.iter().map(off).fold(0.0, f64::max);
        let [(n, tolerance, calls), (second, ..), (third, ..)] = tight;
        let source = format!(
            "engine at resolution {n}, tolerance {tolerance:e}, in {calls} calls; its error: the largest difference from {second} and {third}"
        );
        let reference = Truth { worn: Box::new(move |r| contact.worn_depth_at(r)), volume, reach };
        return Ok((reference, source, [own, own_volume]));
    }
    refusal.map_or_else(|| unreachable!("there are settings to try"), Err)
}

/// Largest difference of two worn profiles at even radii, in d₀.
pub(crate) fn sup(reach: f64, depth: f64, one: impl Fn(f64) -> f64, other: impl Fn(f64) -> f64) -> f64 {
    let radii = (0..RADII).map(|i| reach * f64::from(i) / f64::from(RADII));
    radii.map(|r| (one(r) - other(r)).abs() / depth).fold(0.0, f64::max)
}

fn of_the_engine(problem: &Problem, reference: &Truth) -> Vec<Point> {
    let mut points = Vec::new();
    for settings in RESOLUTIONS.into_iter().flat_map(|n| TOLERANCES.map(|tolerance| (n, tolerance))) {
        let (error, work_error, note) = match lived(problem, settings, 1) {
            Ok(contact) => (
                sup(reference.reach, problem.depth(), |r| contact.worn_depth_at(r), &reference.worn),
                (contact.wear_volume() / reference.volume - 1.0).abs(),
                contact.counters().to_string(),
            ),
            Err(refusal) => (f64::NAN, f64::NAN, refusal.to_string()),
        };
        points.push(Point {
            problem: problem.name.clone(),
            method: "engine",
            settings: format!("resolution {}, tolerance {:e}", settings.0, settings.1),
            error,
            work_error,
            time: timed(|| drop(std::hint::black_box(lived(problem, settings, 1)))),
            note,
        });
    }
    points
}

fn as_published(problem: &Problem, reference: &Truth) -> Vec<Point> {
    let mut points = Vec::new();
    // its grid knows neither the rim of a punch nor gross slip
    if problem.stick_radius() == 0.0 {
        return points;
    }
    for count in POINTS {
        let settings = Settings::fewest_cycles(problem, last(problem), Scheme::Causal, count, INCREMENTS);
        let reach = 1.05 * reference.reach / problem.contact_radius();
        let begin = || Published::new(problem, last(problem), reach, settings);
        // making its matrices is not counted
        let mut run = begin();
        let mut times = Vec::new();
        while times.len() < RUNS && times.iter().all(|t| *t < PATIENCE) {
            run = begin();
            let start = Instant::now();
            run.run();
            times.push(start.elapsed().as_secs_f64());
        }
        times.sort_by(f64::total_cmp);
        let time = [times[times.len() / 2], times[0], times[times.len() - 1]];
        points.push(Point {
            problem: problem.name.clone(),
            method: "published",
            settings: format!("{count} points per a0"),
            error: sup(reference.reach, problem.depth(), |r| run.worn_depth_at(r), &reference.worn),
            work_error: (run.wear_volume() / reference.volume - 1.0).abs(),
            time,
            note: format!("{} time steps", run.steps()),
        });
        if time[0] > PATIENCE {
            break;
        }
    }
    points
}
