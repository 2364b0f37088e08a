//! A mass on a spring whose friction joint is the contact, by four masters with ever finer steps.

#[path = "../masters.rs"]
mod masters;

use super::point::{Comparison, Point, timed};
use fretting_contact::Error;
use masters::{Master, Outcome, drive, mass_for, rest};

const NAME: &str = "mass on a spring, ball";
/// k/(2G*a), and hω with 200 steps a period: the mass swings freely, too, which no damped step may
/// hide.
const RATIO: f64 = 1.0;
const STIFFNESS: f64 = 0.5;
/// Steps of a period at the coarsest, and periods of a run.
const STEPS: u32 = 200;
const PERIODS: f64 = 3.0;
const FINER: [u32; 7] = [1, 2, 4, 8, 16, 32, 64];
/// The reference, and the run from which its error is estimated: explicit, since that master does
/// not damp the free swing.
const REFERENCE: [u32; 2] = [1024, 512];

pub(crate) fn all() -> Result<(Vec<Point>, Vec<Comparison>), Error> {
    let mass = mass_for(RATIO, STIFFNESS)?;
    let run =
        |master, finer| -> Result<Option<Outcome>, Error> { Ok(drive(rest()?, master, RATIO, mass, finer)) };
    let about = |reference: String, own| Comparison {
        problem: NAME.into(),
        of: "largest force of the last period, relative",
        time_of: "a period",
        reference,
        own,
    };
    let [Ok(Some(reference)), Ok(Some(next))] = REFERENCE.map(|finer| run(Master::Explicit, finer)) else {
        return Ok((Vec::new(), vec![about("none: the explicit master broke off".into(), [f64::NAN; 2])]));
    };
    let errors = |outcome: &Outcome| {
        [(outcome.force / reference.force - 1.0).abs(), (outcome.work / reference.work - 1.0).abs()]
    };
    let mut points = Vec::new();
    for master in Master::ALL {
        for finer in FINER {
            let [error, work_error] = run(master, finer)?.map_or([f64::NAN; 2], |outcome| errors(&outcome));
            points.push(Point {
                problem: NAME.into(),
                method: "engine",
                settings: format!("{}, {} steps a period", master.name(), STEPS * finer),
                error,
                work_error,
                time: timed(|| _ = std::hint::black_box(run(master, finer))).map(|t| t / PERIODS),
                note: String::new(),
            });
        }
    }
    let source =
        format!("explicit master, {} steps a period, less that with half of them", STEPS * REFERENCE[0]);
    Ok((points, vec![about(source, errors(&next))]))
}
