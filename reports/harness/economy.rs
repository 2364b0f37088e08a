//! Scenes in which a contact can leave something out, run and counted.

use crate::counting::{allocations, live_bytes};
use fretting_contact::problems::{PARABOLA, Problem};
use fretting_contact::{Counters, Error, FrettingContact, NormalControl, Parameters, Profile, ProfileTable};
use std::f64::consts::TAU;
use std::time::Instant;

/// Steps of a cycle.
pub(crate) const CYCLE: u32 = 40;
/// Cycles before anything is counted: rows have found their size, the wear its rhythm.
const WARM: u32 = 50;
/// Steps that are counted: 25 cycles.
pub(crate) const STEPS: u32 = 1000;
/// N₀ of wear so slow that the profile need not follow within what is counted, and so fast that it
/// must.
const SLOW: f64 = 1e9;
const FAST: f64 = 1e3;

/// How a scene moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Drive {
    /// Load and displacement stay.
    Still,
    /// U = amplitude·sin, in u_max of the load; the load swings by a share of itself.
    Cycles { amplitude: f64, swing: f64 },
    /// The same in the air.
    Apart,
    /// As many cycles in one call.
    InOneCall { amplitude: f64 },
}

/// What is read after every step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Reads {
    Nothing,
    /// T, stick radius, work, worn volume.
    Scalars,
    /// The pressure at 64 radii.
    Pressure,
    /// The worn depth at 64 radii.
    WornDepth,
    /// Worn height, slip of the stroke and work per area at 64 radii.
    Fields,
}

/// Work that is counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Work {
    Walks,
    Contacts,
    Transforms,
    Tables,
    Updates,
    Factorisations,
    Requests,
}

pub(crate) const ALL: [(Work, &str); 7] = [
    (Work::Walks, "tangential solutions"),
    (Work::Contacts, "normal solutions"),
    (Work::Transforms, "transforms"),
    (Work::Tables, "transform tables"),
    (Work::Updates, "profile updates"),
    (Work::Factorisations, "factorisations"),
    (Work::Requests, "requests for memory"),
];

pub(crate) struct Scene {
    pub(crate) name: &'static str,
    problem: Problem,
    pub(crate) drive: Drive,
    pub(crate) reads: Reads,
    /// What has to be none at all.
    pub(crate) leaves_out: &'static [Work],
}

/// What a scene took over [`STEPS`].
#[derive(Debug, Clone, Default)]
pub(crate) struct Measured {
    pub(crate) counted: [u64; ALL.len()],
    /// Memory of the contact at the end, bytes.
    pub(crate) bytes: i64,
    /// Median, least and most time of a step, ns.
    pub(crate) time: [f64; 3],
}

impl Measured {
    pub(crate) fn of(&self, work: Work) -> u64 {
        ALL.iter().zip(self.counted).find(|((kind, _), _)| *kind == work).map_or(0, |(_, count)| count)
    }
}

/// Everything that only a profile that wears needs, and memory.
const NO_WEAR: &[Work] =
    &[Work::Transforms, Work::Tables, Work::Updates, Work::Factorisations, Work::Requests];
/// The same, and the normal contact.
const SAME_LOAD: &[Work] =
    &[Work::Contacts, Work::Transforms, Work::Tables, Work::Updates, Work::Factorisations, Work::Requests];
/// All there is.
const NOTHING: &[Work] = &[
    Work::Walks,
    Work::Contacts,
    Work::Transforms,
    Work::Tables,
    Work::Updates,
    Work::Factorisations,
    Work::Requests,
];

/// All scenes.
pub(crate) fn scenes() -> Result<Vec<Scene>, Error> {
    let [[none, slow, fast], [held_none, held_slow, held_fast]] =
        [NormalControl::Force, NormalControl::Indentation]
            .map(|control| [f64::INFINITY, SLOW, FAST].map(|cycles| ball(control, cycles)));
    let mut table = none.clone();
    table.parameters.profile = sampled_ball()?;
    let with = |one: &Problem, change: fn(&mut Parameters)| {
        let mut problem = one.clone();
        change(&mut problem.parameters);
        problem
    };
    let both = |one| {
        with(one, |p| {
            p.wear_coefficient *= 0.5;
            (p.wear_coefficient_2, p.hardness_2) = (p.wear_coefficient, p.hardness);
        })
    };
    let coated = |one| with(one, |p| p.coating_thickness = 1.0);
    let fixed = |one| with(one, |p| p.probe_radius_max = 3e-4);
    let mut ellipse = none.clone();
    ellipse.parameters.profile = Profile::Ellipse { radius_x: 0.02, radius_y: 0.005 };
    let stick = Drive::Cycles { amplitude: 1e-12, swing: 0.0 };
    let partial = Drive::Cycles { amplitude: 0.6, swing: 0.0 };
    let gross = Drive::Cycles { amplitude: 2.0, swing: 0.0 };
    let swings = Drive::Cycles { amplitude: 0.6, swing: 0.3 };
    let one = Drive::InOneCall { amplitude: 0.6 };
    let list: [(&'static str, &Problem, Drive, Reads, &'static [Work]); 34] = [
        ("nothing moves", &none, Drive::Still, Reads::Nothing, NOTHING),
        ("bodies apart", &none, Drive::Apart, Reads::Nothing, SAME_LOAD),
        ("full stick", &none, stick, Reads::Nothing, SAME_LOAD),
        ("partial slip", &none, partial, Reads::Nothing, SAME_LOAD),
        ("partial slip, scalars read", &none, partial, Reads::Scalars, SAME_LOAD),
        ("partial slip, pressure read", &none, partial, Reads::Pressure, &SAME_LOAD[..5]),
        ("partial slip, depth held", &held_none, partial, Reads::Nothing, SAME_LOAD),
        ("partial slip, table of 1e4 points", &table, partial, Reads::Nothing, SAME_LOAD),
        ("partial slip, ellipse", &ellipse, partial, Reads::Nothing, SAME_LOAD),
        ("gross slip", &none, gross, Reads::Nothing, SAME_LOAD),
        ("load varies", &none, swings, Reads::Nothing, NO_WEAR),
        ("depth varies", &held_none, swings, Reads::Nothing, NO_WEAR),
        ("load varies, table of 1e4 points", &table, swings, Reads::Nothing, NO_WEAR),
        ("25 cycles in one call", &none, one, Reads::Nothing, &NO_WEAR[..4]),
        ("nothing moves, wear", &slow, Drive::Still, Reads::Nothing, NOTHING),
        ("bodies apart, wear", &slow, Drive::Apart, Reads::Nothing, SAME_LOAD),
        ("full stick, wear", &slow, stick, Reads::Nothing, SAME_LOAD),
        ("partial slip, slow wear", &slow, partial, Reads::Nothing, SAME_LOAD),
        ("partial slip, slow wear, scalars read", &slow, partial, Reads::Scalars, SAME_LOAD),
        ("partial slip, slow wear, worn depth read", &slow, partial, Reads::WornDepth, &[]),
        ("gross slip, slow wear", &slow, gross, Reads::Nothing, SAME_LOAD),
        ("load varies, slow wear", &slow, swings, Reads::Nothing, NO_WEAR),
        ("depth varies, slow wear", &held_slow, swings, Reads::Nothing, NO_WEAR),
        ("partial slip, fast wear", &fast, partial, Reads::Nothing, &[]),
        ("partial slip, fast wear, depth held", &held_fast, partial, Reads::Nothing, &[]),
        ("load varies, fast wear", &fast, swings, Reads::Nothing, &[]),
        ("25 cycles in one call, fast wear", &fast, one, Reads::Nothing, &[]),
        ("partial slip, slow wear, both bodies", &both(&slow), partial, Reads::Nothing, SAME_LOAD),
        ("partial slip, fast wear, both bodies", &both(&fast), partial, Reads::Nothing, &[]),
        ("partial slip, slow wear, coated", &coated(&slow), partial, Reads::Nothing, SAME_LOAD),
        ("partial slip, fast wear, coated", &coated(&fast), partial, Reads::Nothing, &[]),
        ("25 cycles in one call, fast wear, coated", &coated(&fast), one, Reads::Nothing, &[]),
        ("partial slip, slow wear, fixed probes", &fixed(&slow), partial, Reads::Nothing, SAME_LOAD),
        ("partial slip, slow wear, fields read", &fixed(&slow), partial, Reads::Fields, &[]),
    ];
    let scene = |(name, problem, drive, reads, leaves_out): (_, &Problem, _, _, _)| Scene {
        name,
        problem: problem.clone(),
        drive,
        reads,
        leaves_out,
    };
    Ok(list.into_iter().map(scene).collect())
}

/// The ball at 0.6 u_max, which is 1 − c₀²/a₀², whose N₀ is so many cycles; ∞ is without wear.
fn ball(control: NormalControl, cycles: f64) -> Problem {
    Problem::partial_slip(PARABOLA, control, 0.4_f64.sqrt()).with_seed_cycles(cycles)
}

/// The ball as a table.
fn sampled_ball() -> Result<Profile, Error> {
    let points = (0..10_000).map(|i| {
        let r = 4e-4 * f64::from(i) / 9999.0;
        (r, r * r / 0.02)
    });
    Ok(Profile::Table(ProfileTable::new(points.collect())?))
}

impl Scene {
    /// Steps from the `from`-th on.
    fn run(&self, contact: &mut FrettingContact, from: u32, steps: u32) -> Result<(), Error> {
        let (normal, full_slip) = (self.problem.normal, self.problem.start.full_slip());
        if let Drive::InOneCall { amplitude } = self.drive {
            return contact.advance_cycles(normal, amplitude * full_slip, f64::from(steps / CYCLE));
        }
        for k in from + 1..=from + steps {
            let phase = TAU * f64::from(k % CYCLE) / f64::from(CYCLE);
            match self.drive {
                Drive::Still => contact.advance_to(normal, 0.0)?,
                Drive::Apart => contact.advance_to(-normal, 1e-6 * phase.sin())?,
                Drive::Cycles { amplitude, swing } => contact
                    .advance_to(normal * (1.0 + swing * phase.cos()), amplitude * full_slip * phase.sin())?,
                Drive::InOneCall { .. } => {}
            }
            self.read(contact);
        }
        Ok(())
    }

    fn read(&self, contact: &FrettingContact) {
        let sum: f64 = match self.reads {
            Reads::Nothing => return,
            Reads::Scalars => {
                contact.tangential_force()
                    + contact.stick_radius()
                    + contact.dissipated_energy()
                    + contact.wear_volume()
            }
            Reads::Pressure => contact.probe_radii().iter().map(|r| contact.pressure_at(*r)).sum(),
            Reads::Fields => contact
                .probe_radii()
                .iter()
                .map(|r| {
                    let density = contact.energy_density_at(*r).unwrap_or_default();
                    contact.profile_height_at(*r) + contact.slip_amplitude_at(*r) + density
                })
                .sum(),
            Reads::WornDepth => contact.probe_radii().iter().map(|r| contact.worn_depth_at(*r)).sum(),
        };
        std::hint::black_box(sum);
    }

    /// Runs the scene; `repeats` runs of the same steps are timed.
    pub(crate) fn measure(&self, repeats: usize) -> Result<Measured, Error> {
        let held = live_bytes();
        let mut contact = self.problem.begin()?;
        self.run(&mut contact, 0, WARM * CYCLE)?;
        // no copy: that would share memory with the contact until its next slip
        let mut warm = self.problem.begin()?;
        self.run(&mut warm, 0, WARM * CYCLE)?;
        let (counters, requests) = (*contact.counters(), allocations());
        self.run(&mut contact, WARM * CYCLE, STEPS)?;
        let requests = allocations() - requests;
        let mut measured = Measured { counted: since(&counters, contact.counters()), ..Measured::default() };
        measured.counted[ALL.len() - 1] = requests;
        drop(warm.clone());
        let mut times = Vec::with_capacity(repeats);
        for _ in 0..repeats {
            let mut again = warm.clone();
            let start = Instant::now();
            self.run(&mut again, WARM * CYCLE, STEPS)?;
            times.push(start.elapsed().as_secs_f64() * 1e9 / f64::from(STEPS));
        }
        drop(warm);
        measured.bytes = live_bytes() - held - (times.capacity() * size_of::<f64>()) as i64;
        times.sort_by(f64::total_cmp);
        if let (Some(least), Some(most)) = (times.first(), times.last()) {
            measured.time = [times[times.len() / 2], *least, *most];
        }
        Ok(measured)
    }
}

/// Counted work between two readings, in the order of [`ALL`]; requests for memory are not among
/// the counters.
fn since(before: &Counters, after: &Counters) -> [u64; ALL.len()] {
    let counts = |c: &Counters| {
        [
            c.spring_walks,
            c.contact_solutions,
            c.descent_transforms + c.pressure_transforms,
            c.transform_tables,
            c.profile_updates,
            c.factorisations,
            0,
        ]
    };
    let (before, after) = (counts(before), counts(after));
    std::array::from_fn(|i| after[i] - before[i])
}
