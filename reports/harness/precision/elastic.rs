//! Without wear: Hertz' pressure, a Mindlin loop, a random history of load and displacement, by the
//! engine and by a plain row of springs.

use super::point::{Comparison, Point, timed};
use fretting_contact::problems::Problem;
use fretting_contact::reference::springs::PlainSpringRow;
use fretting_contact::reference::{NormalContact, TangentialContact};
use fretting_contact::{Error, FrettingContact};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

/// Steps of a stroke of the loop.
const STROKE: u32 = 50;
/// Loops that are timed together.
const LOOPS: u32 = 20;
/// Lines of the random history.
const LINES: u32 = 100;
const SPRINGS: [usize; 6] = [50, 100, 200, 400, 800, 1600];
/// Springs of the row that is the reference of the random history; its error is estimated with half
/// of them.
const MANY: usize = 100_000;
/// Sub-steps of a line there: the work of a row is right to second order in them.
const SUBSTEPS: usize = 128;

const PLAIN: &str = "plain spring row";
/// The problem of `hertz` that an independent solver can be asked, too:
/// `reports/harness/independent.py`.
pub(crate) const HERTZ: &str = "Hertz contact, ball";

/// A contact of the ball without wear.
struct Ball {
    problem: Problem,
    start: TangentialContact,
}

pub(crate) fn all() -> Result<(Vec<Point>, Vec<Comparison>), Error> {
    let mut problem = Problem::parabola_at_constant_force();
    problem.parameters.wear_coefficient = 0.0;
    let start = problem.start;
    let ball = Ball { problem, start };
    let mut points = ball.hertz()?;
    points.extend(ball.loops()?);
    let (history, own) = ball.random_history()?;
    points.extend(history);
    let comparisons = |problem: &str, of, time_of, reference: String, own| Comparison {
        problem: problem.into(),
        of,
        time_of,
        reference,
        own,
    };
    let references = vec![
        comparisons(HERTZ, "pressure on the axis", "a load and the reading", "closed form".into(), [0.0; 2]),
        comparisons("Mindlin loop, ball", "T on the loop, in μF_N", "a step", "closed form".into(), [0.0; 2]),
        comparisons(
            "random history, ball",
            "T after each line, in μ times the largest load",
            "a line",
            format!(
                "plain row of {MANY} springs in {SUBSTEPS} sub-steps a line, less that with half of both"
            ),
            own,
        ),
    ];
    Ok((points, references))
}

impl Ball {
    fn row(&self, length: f64, count: usize) -> PlainSpringRow {
        let normal = &self.start.normal;
        let (modulus, friction) = (self.start.modulus, self.start.friction);
        PlainSpringRow::under(normal.shape(), length, count, normal.modulus(), modulus, friction)
    }

    fn point(
        &self,
        problem: &str,
        method: &'static str,
        settings: String,
        errors: [f64; 2],
        time: [f64; 3],
    ) -> Point {
        let [error, work_error] = errors;
        Point { problem: problem.into(), method, settings, error, work_error, time, note: String::new() }
    }

    /// Two loads in turn; the pressure on the axis after each.
    fn hertz(&self) -> Result<Vec<Point>, Error> {
        let loads = [self.problem.normal, 0.5 * self.problem.normal];
        let normal = &self.start.normal;
        let references = loads
            .map(|load| NormalContact::at_force(normal.shape(), normal.modulus(), load).central_pressure());
        let mut contact = self.problem.begin()?;
        let mut error = 0.0_f64;
        for k in 0..4 {
            contact.advance_to(loads[k % 2], 0.0)?;
            error = error.max((contact.pressure_at(0.0) / references[k % 2] - 1.0).abs());
        }
        let pairs = 1000;
        let time = timed(|| {
            for k in 0..2 * pairs {
                // it was carried before
                let _ = contact.advance_to(loads[k % 2], 0.0);
                std::hint::black_box(contact.pressure_at(0.0));
            }
        });
        let time = time.map(|t| t / (2 * pairs) as f64);
        Ok(vec![self.point(HERTZ, "engine", "any".into(), [error, f64::NAN], time)])
    }

    /// Loops at 0.75 u_max and constant force.
    fn loops(&self) -> Result<Vec<Point>, Error> {
        let name = "Mindlin loop, ball";
        let steps = f64::from(LOOPS * 2 * STROKE);
        let begun = self.problem.begin()?;
        let run = |measure: bool| {
            let mut contact = begun.clone();
            let forces = |u: f64| {
                contact.advance_to(self.problem.normal, u).map_or(f64::NAN, |()| contact.tangential_force())
            };
            let error = self.loop_error(measure, forces);
            [error, self.work_error(contact.dissipated_energy())]
        };
        let time = timed(|| _ = std::hint::black_box(run(false))).map(|t| t / steps);
        let mut points = vec![self.point(name, "engine", "any".into(), run(true), time)];
        for count in SPRINGS {
            let run = |measure: bool| {
                let mut row = self.row(1.05 * self.start.normal.radius(), count);
                row.advance(self.problem.normal, 0.0, 1);
                let error = self.loop_error(measure, |u| {
                    row.advance(self.problem.normal, u, 1);
                    row.tangential_force()
                });
                [error, self.work_error(row.friction_work())]
            };
            let time = timed(|| _ = std::hint::black_box(run(false))).map(|t| t / steps);
            points.push(self.point(name, PLAIN, format!("{count} springs"), run(true), time));
        }
        Ok(points)
    }

    fn amplitude(&self) -> f64 {
        0.75 * self.start.full_slip()
    }

    /// Of the first quarter and one loop.
    fn work_error(&self, work: f64) -> f64 {
        (work / (1.25 * self.start.loop_work(self.amplitude())) - 1.0).abs()
    }

    /// Loading to the amplitude, then loops; one where the force is compared.
    fn loop_error(&self, measure: bool, mut force: impl FnMut(f64) -> f64) -> f64 {
        let amplitude = self.amplitude();
        let limit = self.start.friction * self.start.normal.force();
        force(amplitude);
        let mut worst = 0.0_f64;
        for _ in 0..if measure { 1 } else { LOOPS } {
            for sign in [1.0, -1.0] {
                for k in 1..=STROKE {
                    let u = amplitude * (1.0 - 2.0 * f64::from(k) / f64::from(STROKE));
                    let measured = force(sign * u);
                    if measure {
                        let off = (measured - sign * self.start.returning(amplitude, u)).abs() / limit;
                        worst = if off <= worst { worst } else { off };
                    }
                }
            }
        }
        worst
    }

    /// Lines to random loads, from a tenth to all of the largest, and random displacements within
    /// 1.2 u_max; and its own errors.
    fn random_history(&self) -> Result<(Vec<Point>, [f64; 2]), Error> {
        let name = "random history, ball";
        let (most, slip) = (self.problem.normal, self.start.full_slip());
        let mut random = StdRng::seed_from_u64(4);
        let way: Vec<(f64, f64)> = (0..LINES)
            .map(|_| (most * random.random_range(0.1..1.0), slip * random.random_range(-1.2..1.2)))
            .collect();
        let length = 1.05 * self.start.normal.radius();
        let walk_row = |count: usize, substeps: usize| {
            let mut row = self.row(length, count);
            let forces: Vec<f64> = way
                .iter()
                .map(|(load, place)| {
                    row.advance(*load, *place, substeps);
                    row.tangential_force()
                })
                .collect();
            (forces, row.friction_work())
        };
        let reference = walk_row(MANY, SUBSTEPS);
        let errors = |(forces, work): &(Vec<f64>, f64)| {
            let limit = self.start.friction * most;
            let off = forces.iter().zip(&reference.0).map(|(a, b)| (a - b).abs() / limit);
            [off.fold(0.0, f64::max), (work / reference.1 - 1.0).abs()]
        };
        let own = errors(&walk_row(MANY / 2, SUBSTEPS / 2));
        let lines = f64::from(LINES);
        let mut points = Vec::new();
        for resolution in [8, 16, 32, 64, 128, 512] {
            let mut problem = self.problem.clone();
            problem.parameters.resolution = resolution;
            let mut begun = FrettingContact::new(problem.parameters.clone())?;
            begun.start_at(1e-9, 0.0)?;
            let walk = || -> Result<(Vec<f64>, f64), Error> {
                let mut contact = begun.clone();
                let mut forces = Vec::with_capacity(way.len());
                for (load, place) in &way {
                    contact.advance_to(*load, *place)?;
                    forces.push(contact.tangential_force());
                }
                Ok((forces, contact.dissipated_energy()))
            };
            let errors = errors(&walk()?);
            let time = timed(|| _ = std::hint::black_box(walk())).map(|t| t / lines);
            points.push(self.point(name, "engine", format!("resolution {resolution}"), errors, time));
        }
        for (count, substeps) in [(50, 1), (100, 2), (200, 4), (400, 8), (800, 16), (1600, 32)] {
            let errors = errors(&walk_row(count, substeps));
            let time = timed(|| _ = std::hint::black_box(walk_row(count, substeps))).map(|t| t / lines);
            let settings = format!("{count} springs, {substeps} sub-steps a line");
            points.push(self.point(name, PLAIN, settings, errors, time));
        }
        Ok((points, own))
    }
}
