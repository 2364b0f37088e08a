//! With wear, step by step: a random history of load and displacement; a life on a table of points.

use super::lives::sup;
use super::point::{Comparison, Point, timed};
use fretting_contact::problems::{CONE, Problem};
use fretting_contact::{Error, FrettingContact, NormalControl, Profile, ProfileTable};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

/// Lines of the random history, and N₀ there: some 0.4 d₀ is worn at the end.
const LINES: u32 = 60;
const SEED_CYCLES: f64 = 60.0;
/// Resolution, tolerance and parts of each line of the run that is the reference, and of the run
/// from which its error is estimated.
const TIGHT: [(usize, f64, u32); 2] = [(128, 1e-4, 4), (96, 1e-4, 2)];
/// N/N₀ at the end of the life on a table: what is left to wear is below all errors.
const END: f64 = 9.0;
/// c/a₀ of that life.
const STICK_RATIO: f64 = 0.4;

pub(crate) fn all() -> (Vec<Point>, Vec<Comparison>) {
    let (mut points, mut comparisons) = random_history();
    let (on_tables, about) = tables();
    points.extend(on_tables);
    comparisons.push(about);
    (points, comparisons)
}

/// Settings of a run: resolution, tolerance, parts of a line.
type Settings = (usize, f64, u32);

/// Loads from a fifth to all of the largest, displacements within 0.9 u_max.
fn random_history() -> (Vec<Point>, Vec<Comparison>) {
    let name = "random history with wear, ball";
    let problem = Problem::parabola_at_constant_force().with_seed_cycles(SEED_CYCLES);
    let mut random = StdRng::seed_from_u64(5);
    let slip = problem.start.full_slip();
    let way: Vec<(f64, f64)> = (0..LINES)
        .map(|_| (problem.normal * random.random_range(0.2..1.0), slip * random.random_range(-0.9..0.9)))
        .collect();
    let walk = |(resolution, tolerance, parts): Settings| -> Result<FrettingContact, Error> {
        let mut problem = problem.clone();
        (problem.parameters.resolution, problem.parameters.tolerance) = (resolution, tolerance);
        let mut contact = problem.begin()?;
        let mut from = (problem.normal, 0.0);
        for to in &way {
            for k in 1..=parts {
                let share = f64::from(k) / f64::from(parts);
                let at = |a: f64, b: f64| if k == parts { b } else { a + share * (b - a) };
                contact.advance_to(at(from.0, to.0), at(from.1, to.1))?;
            }
            from = *to;
        }
        Ok(contact)
    };
    let about = |reference, own| Comparison {
        problem: name.into(),
        of: "worn profile at the end, largest error in d₀",
        time_of: "the whole history",
        reference,
        own,
    };
    let both = TIGHT.map(walk);
    let [Ok(reference), Ok(next)] = both else {
        let refusal = both.into_iter().find_map(Result::err).map_or(String::new(), |error| error.to_string());
        return (Vec::new(), vec![about(format!("none: {refusal}"), [f64::NAN; 2])]);
    };
    let reach = 1.02 * reference.contact_radius();
    let errors = |contact: &FrettingContact| {
        let error = sup(reach, problem.depth(), |r| contact.worn_depth_at(r), |r| reference.worn_depth_at(r));
        [error, (contact.wear_volume() / reference.wear_volume() - 1.0).abs()]
    };
    let mut points = Vec::new();
    for resolution in [16, 32, 64] {
        for tolerance in [1e-2, 1e-3, 1e-4] {
            let settings = (resolution, tolerance, 1);
            let ([error, work_error], note) = match walk(settings) {
                Ok(contact) => (errors(&contact), contact.counters().to_string()),
                Err(refusal) => ([f64::NAN; 2], refusal.to_string()),
            };
            points.push(Point {
                problem: name.into(),
                method: "engine",
                settings: format!("resolution {resolution}, tolerance {tolerance:e}"),
                error,
                work_error,
                time: timed(|| drop(std::hint::black_box(walk(settings)))),
                note,
            });
        }
    }
    let [(resolution, tolerance, parts), (other, ..)] = TIGHT;
    let source = format!(
        "engine at resolution {resolution}, tolerance {tolerance:e}, lines in {parts} parts, less that at {other} and half the parts"
    );
    (points, vec![about(source, errors(&next))])
}

/// The cone at constant depth as a table of ever more points, between which no table follows it
/// exactly: its final state is the cone's.
fn tables() -> (Vec<Point>, Comparison) {
    let name = "table of a cone at constant depth";
    let cone = Problem::partial_slip(CONE, NormalControl::Indentation, STICK_RATIO);
    let about = Comparison {
        problem: name.into(),
        of: "worn profile at the end, largest error in d₀",
        time_of: "reading the table and the whole life",
        reference: format!(
            "closed final state of the cone; what is left to wear at N/N₀ = {END} is in the errors"
        ),
        own: [0.0; 2],
    };
    let Some(end) = cone.end else { return (Vec::new(), about) };
    let Profile::Cone { slope } = cone.parameters.profile else { return (Vec::new(), about) };
    let outer = 1.6 * end.outer_radius();
    let mut points = Vec::new();
    for count in [10_u32, 30, 100, 1000, 10_000] {
        let rows: Vec<(f64, f64)> =
            (0..count).map(|i| outer * f64::from(i) / f64::from(count - 1)).map(|r| (r, r * slope)).collect();
        for (resolution, tolerance) in [(32, 1e-3), (64, 1e-3), (128, 1e-4)] {
            let live = || -> Result<FrettingContact, Error> {
                let mut problem = cone.clone();
                problem.parameters.profile = Profile::Table(ProfileTable::new(rows.clone())?);
                (problem.parameters.resolution, problem.parameters.tolerance) = (resolution, tolerance);
                let mut contact = problem.begin()?;
                problem.advance(&mut contact, END)?;
                Ok(contact)
            };
            let (error, work_error, note) = match live() {
                Ok(contact) => (
                    sup(
                        1.1 * end.outer_radius(),
                        cone.depth(),
                        |r| contact.worn_depth_at(r),
                        |r| end.worn_depth(r),
                    ),
                    (contact.wear_volume() / end.worn_volume() - 1.0).abs(),
                    contact.counters().to_string(),
                ),
                Err(refusal) => (f64::NAN, f64::NAN, refusal.to_string()),
            };
            points.push(Point {
                problem: name.into(),
                method: "engine",
                settings: format!("{count} points, resolution {resolution}, tolerance {tolerance:e}"),
                error,
                work_error,
                time: timed(|| drop(std::hint::black_box(live()))),
                note,
            });
        }
    }
    (points, about)
}
