//! The contact as a part of a stiff system: a mass m on a spring k, driven harmonically by its far
//! end, with the contact between the mass and the ground, under four masters with a fixed step h.
//!
//! m v' = k (x_d − x) − T(x), x' = v. All masters are of first order and update the velocity first,
//! so that the position at the end of the step is what the contact is given:
//!
//! - **explicit**: m (v⁺ − v)/h = k (x_d − x) − T; one contact step a step. With a linear contact
//!   of stiffness k_c it is stable for h < 2/ω, ω² = (k + k_c)/m, and no further.
//! - **half-explicit**: k at the end of the step, T at its start, as where the contact gives no
//!   derivative. Stable for h² (k_c − k)/m < 4 (the roots of (1 + h²k/m) z² − (2 − h²k_c/m) z + 1
//!   lie in the unit circle).
//! - **semi-implicit**: k and T at the end of the step, T⁺ = T + (∂T/∂U) h v⁺ with the contact's
//!   own derivative: one contact step a step, no iteration.
//! - **iterative**: T⁺ at the end of the step by Newton's method, from the same saved state each
//!   time: rollback.
#![allow(dead_code, reason = "the report and the tests each use a part of this")]

use fretting_contact::{Error, FrettingContact, Parameters, Snapshot};
use std::f64::consts::TAU;

/// F_N, N.
const FORCE: f64 = 100.0;
/// Steps in a period of the drive.
const STEPS: u32 = 200;
/// Periods of a run; the last one is looked at.
const PERIODS: u32 = 3;
/// Displacement amplitude of the mass in the comparison, in u_max: well into partial slip.
const SLIP_SHARE: f64 = 0.7;
/// Most Newton iterations of the iterative master in a step.
const MOST_ITERATIONS: u32 = 30;

/// How the contact is coupled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Master {
    Explicit,
    HalfExplicit,
    SemiImplicit,
    Iterative,
}

impl Master {
    pub(crate) const ALL: [Self; 4] =
        [Self::Explicit, Self::HalfExplicit, Self::SemiImplicit, Self::Iterative];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Explicit => "explicit",
            Self::HalfExplicit => "half-explicit",
            Self::SemiImplicit => "semi-implicit",
            Self::Iterative => "iterative",
        }
    }
}

/// The largest stable step of the explicit master where the contact sticks.
#[derive(Debug, Clone)]
pub(crate) struct Limit {
    /// k/(2G*a).
    pub(crate) ratio: f64,
    /// m, kg.
    pub(crate) mass: f64,
    /// The largest step found stable, s.
    pub(crate) step: f64,
    /// 2/ω, s.
    pub(crate) theory: f64,
}

/// A master at work on one system in partial slip.
#[derive(Debug, Clone)]
pub(crate) struct Row {
    pub(crate) master: Master,
    /// k/(2G*a).
    pub(crate) ratio: f64,
    /// hω, ω² = (k + 2G*a)/m: the explicit limit is 2.
    pub(crate) stiffness: f64,
    /// Largest |x| over the run, in that of the reference; infinite where the run broke off.
    pub(crate) growth: f64,
    /// Work of friction in the last period against the reference, relative.
    pub(crate) work_error: f64,
    /// Largest force in the last period against the reference, relative.
    pub(crate) force_error: f64,
    /// Contact steps for each step of the master.
    pub(crate) calls: f64,
}

impl Row {
    /// Whether the run stayed near the reference.
    pub(crate) fn stable(&self) -> bool {
        self.growth < 1.5 && self.work_error.abs() < 0.5
    }
}

/// Coupling stiffnesses of the sweep, in 2G*a.
pub(crate) const RATIOS: [f64; 7] = [1e-3, 1e-2, 1e-1, 1.0, 1e1, 1e2, 1e3];
/// Stiffnesses hω of the comparison.
pub(crate) const STIFFNESSES: [f64; 6] = [0.5, 1.9, 2.1, 5.0, 50.0, 500.0];
/// Masses of the sweep, kg.
pub(crate) const MASSES: [f64; 3] = [1e-3, 1.0, 1e3];

/// A contact as a master sees it, at constant load.
pub(crate) trait Coupled {
    /// What brings it back to where it was.
    type State;
    /// T, N.
    fn force(&self) -> f64;
    /// ∂T/∂U in the present sliding direction, N/m.
    fn slope(&self) -> f64;
    /// W, J.
    fn work(&self) -> f64;
    /// Moves the body to U, m; `false` if that cannot be done.
    fn advance(&mut self, displacement: f64) -> bool;
    /// The present state.
    fn save(&self) -> Self::State;
    /// Goes back.
    fn restore(&mut self, state: &Self::State);
}

impl Coupled for FrettingContact {
    type State = Snapshot;
    fn force(&self) -> f64 {
        self.tangential_force()
    }
    fn slope(&self) -> f64 {
        self.tangential_force_gradient().displacement
    }
    fn work(&self) -> f64 {
        self.dissipated_energy()
    }
    fn advance(&mut self, displacement: f64) -> bool {
        self.advance_to(FORCE, displacement).is_ok()
    }
    fn save(&self) -> Snapshot {
        self.snapshot()
    }
    fn restore(&mut self, state: &Snapshot) {
        FrettingContact::restore(self, state).expect("it is its own state");
    }
}

/// A mass, its spring and the contact.
struct System<C> {
    contact: C,
    /// ∂T/∂U of the contact at rest, N/m.
    elastic: f64,
    stiffness: f64,
    mass: f64,
    x: f64,
    v: f64,
    calls: u64,
}

impl<C: Coupled> System<C> {
    fn new(contact: C, stiffness: f64, mass: f64) -> Self {
        let elastic = contact.slope();
        Self { contact, elastic, stiffness, mass, x: 0.0, v: 0.0, calls: 0 }
    }

    fn contact_to(&mut self, x: f64) -> Option<f64> {
        self.calls += 1;
        self.contact.advance(x).then(|| self.contact.force())
    }

    /// One step of `h` to the instant at which the drive stands at `drive`, from that at
    /// `drive_before`; `None` if the contact cannot follow.
    fn step(&mut self, master: Master, h: f64, (drive_before, drive): (f64, f64)) -> Option<()> {
        let (k, m, force) = (self.stiffness, self.mass, self.contact.force());
        let pull = k * (drive - self.x) - force;
        match master {
            Master::Explicit => self.v += h / m * (k * (drive_before - self.x) - force),
            Master::HalfExplicit => self.v = (m * self.v + h * pull) / (m + h * h * k),
            Master::SemiImplicit => {
                let slope = self.slope_towards(pull + m / h * self.v);
                self.v = (m * self.v + h * pull) / (m + h * h * (k + slope));
            }
            Master::Iterative => return self.iterate(h, drive),
        }
        self.x += h * self.v;
        self.contact_to(self.x).map(drop)
    }

    /// Newton's method on m (v⁺ − v)/h = k (x_d − x⁺) − T(x⁺), kept between ends that are known to
    /// be on either side.
    fn iterate(&mut self, h: f64, drive: f64) -> Option<()> {
        let (k, m) = (self.stiffness, self.mass);
        let saved = self.contact.save();
        let (mut next, mut force) = (self.x, self.contact.force());
        let mut slope = self.slope_towards(k * (drive - self.x) - force + m / h * self.v);
        let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
        for _ in 0..MOST_ITERATIONS {
            let residual = k * (drive - next) - force - m / h * ((next - self.x) / h - self.v);
            if residual > 0.0 {
                low = next;
            } else {
                high = next;
            }
            let change = residual / (k + slope + m / (h * h));
            if change.abs() <= 1e-12 * next.abs().max(self.x.abs()) {
                break;
            }
            next += change;
            if next <= low || next >= high {
                next = 0.5 * (low + high);
            }
            self.contact.restore(&saved);
            force = self.contact_to(next)?;
            slope = self.contact.slope();
        }
        self.v = (next - self.x) / h;
        self.x = next;
        Some(())
    }

    /// ∂T/∂U for a motion to the side of `push`: the contact's own derivative where it goes on as
    /// before; where it turns, all springs stick, as they did at rest.
    fn slope_towards(&self, push: f64) -> f64 {
        if push * self.v < 0.0 { self.elastic } else { self.contact.slope() }
    }
}

/// The default contact, pressed and at rest.
pub(crate) fn rest() -> Result<FrettingContact, Error> {
    let mut contact = FrettingContact::new(Parameters { wear_coefficient: 0.0, ..Parameters::default() })?;
    contact.start_at(FORCE, 0.0)?;
    Ok(contact)
}

/// Finds the largest stable step of the explicit master for motions so small that the contact
/// sticks.
pub(crate) fn explicit_limits() -> Result<Vec<Limit>, Error> {
    let contact_stiffness = rest()?.tangential_stiffness();
    let mut limits = Vec::new();
    for ratio in RATIOS {
        for mass in MASSES {
            let stiffness = ratio * contact_stiffness;
            let theory = 2.0 / ((stiffness + contact_stiffness) / mass).sqrt();
            // the limit lies between half and twice the theory, if that is of any use
            let (mut low, mut high) = (0.5 * theory, 2.0 * theory);
            for _ in 0..12 {
                let middle = 0.5 * (low + high);
                if stays_small(stiffness, mass, middle)? {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            limits.push(Limit { ratio, mass, step: low, theory });
        }
    }
    Ok(limits)
}

/// Whether a tiny free motion stays as small as it began for a thousand steps.
fn stays_small(stiffness: f64, mass: f64, h: f64) -> Result<bool, Error> {
    let mut system = System::new(rest()?, stiffness, mass);
    let start = 1e-6 * full_slip();
    system.x = start;
    let mut done = system.contact_to(start).map(drop);
    // next to the limit the motion of a stable step grows to a multiple of its start before it
    // falls again
    for _ in 0..1000 {
        done = done.and_then(|()| system.step(Master::Explicit, h, (0.0, 0.0)));
        if done.is_none() || system.x.abs() > 1e3 * start {
            return Ok(false);
        }
    }
    Ok(true)
}

/// u_max = (μE*/G*) d, m.
fn full_slip() -> f64 {
    let parameters = Parameters::default();
    let (normal, tangential) =
        (parameters.materials.normal_modulus(), parameters.materials.tangential_modulus());
    let radius = (0.75 * FORCE * 0.01 / normal).cbrt();
    parameters.friction_coefficient * normal / tangential * radius * radius / 0.01
}

/// What a run came to: largest |x|, and largest |T| and work of the last period.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Outcome {
    pub(crate) extent: f64,
    pub(crate) force: f64,
    pub(crate) work: f64,
    pub(crate) calls: f64,
}

/// Mass for which hω is `stiffness` at STEPS steps of a period of 1 s, kg.
pub(crate) fn mass_for(ratio: f64, stiffness: f64) -> Result<f64, Error> {
    let h = 1.0 / f64::from(STEPS);
    Ok((1.0 + ratio) * rest()?.tangential_stiffness() * (h / stiffness).powi(2))
}

/// Drives a system with period 1 s by steps of 1/(STEPS·finer) s; `None` if it breaks off.
pub(crate) fn drive<C: Coupled>(
    contact: C,
    master: Master,
    ratio: f64,
    mass: f64,
    finer: u32,
) -> Option<Outcome> {
    let stiffness = ratio * contact.slope();
    // the spring's far end moves so far that a slow motion takes the mass to SLIP_SHARE
    let limit = Parameters::default().friction_coefficient * FORCE;
    let force = limit * (1.0 - (1.0 - SLIP_SHARE).powf(1.5));
    let amplitude = SLIP_SHARE * full_slip() + force / stiffness;
    let mut system = System::new(contact, stiffness, mass);
    let steps = STEPS * finer;
    let h = 1.0 / f64::from(steps);
    let at = |n: u32| amplitude * (TAU * f64::from(n) * h).sin();
    let (mut extent, mut largest, mut before) = (0.0f64, 0.0f64, 0.0);
    for n in 0..PERIODS * steps {
        if n == (PERIODS - 1) * steps {
            before = system.contact.work();
            largest = 0.0;
        }
        system.step(master, h, (at(n), at(n + 1)))?;
        extent = extent.max(system.x.abs());
        largest = largest.max(system.contact.force().abs());
    }
    let work = system.contact.work() - before;
    let calls = system.calls as f64 / f64::from(PERIODS * steps);
    Some(Outcome { extent, force: largest, work, calls })
}

/// All masters on all systems, against the iterative one with 20 times finer steps.
pub(crate) fn comparison(ratios: &[f64], stiffnesses: &[f64]) -> Result<Vec<Row>, Error> {
    let mut rows = Vec::new();
    for &ratio in ratios {
        for &stiffness in stiffnesses {
            let mass = mass_for(ratio, stiffness)?;
            let reference =
                drive(rest()?, Master::Iterative, ratio, mass, 20).expect("an implicit master goes on");
            for master in Master::ALL {
                // what grows without bound ends where double precision does
                let broken =
                    Outcome { extent: f64::INFINITY, force: f64::INFINITY, work: f64::INFINITY, calls: 1.0 };
                let outcome = drive(rest()?, master, ratio, mass, 1).unwrap_or(broken);
                rows.push(Row {
                    master,
                    ratio,
                    stiffness,
                    growth: outcome.extent / reference.extent,
                    work_error: outcome.work / reference.work - 1.0,
                    force_error: outcome.force / reference.force - 1.0,
                    calls: outcome.calls,
                });
            }
        }
    }
    Ok(rows)
}
