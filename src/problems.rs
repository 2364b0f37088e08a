//! Ready problems: a contact, how it is driven, and what is known of the answer.
//!
//! The four cases of Dimaki et al. 2014 (sections 4.1 to 4.4), the same bodies at any other stick
//! radius and control, and two in gross slip. Tests, benchmarks and examples share them:
//!
//! ```
//! use fretting_contact::problems::Problem;
//!
//! let problem = Problem::parabola_at_constant_depth();
//! let mut contact = problem.begin()?;
//! problem.advance(&mut contact, 9.0)?; // Ñ = 9: wear has all but stopped
//! assert!(problem.profile_error(|r| contact.worn_depth_at(r)).is_some_and(|error| error < 0.01));
//! # Ok::<(), fretting_contact::Error>(())
//! ```
//!
//! Life is counted in Ñ = N/N₀, N₀ = π a₀² d₀ σ₀/(k μ F_N U₀) (eqs. (20), (21)), with a₀, d₀ and
//! F_N of the unworn body at the start. A problem uses the public face of the engine and the closed
//! forms of [`crate::reference`]; nothing else of the library uses it.

mod truth;

pub use truth::History;

use crate::engine::FrettingContact;
use crate::error::Error;
use crate::parameters::{NormalControl, Parameters};
use crate::profile::Profile;
use crate::reference::wear::seed_cycles;
use crate::reference::wear_tables::{FLAT_PUNCH_GROSS_SLIP, INITIAL_STICK_RATIO, SPHERE_GROSS_SLIP};
use crate::reference::{ConstantDepthEnd, NormalContact, Shape, TangentialContact};
use std::f64::consts::PI;

/// Initial normal force of every problem, N.
pub const NORMAL_FORCE: f64 = 100.0;
/// The ball: R = 10 mm.
pub const PARABOLA: Shape = Shape::Parabola { radius: 0.01 };
/// The cone: 0.02 rad, under [`NORMAL_FORCE`] a contact as large as that of the ball.
pub const CONE: Shape = Shape::Cone { slope: 0.02 };
/// Flat-ended cylinder of 0.1 mm radius.
pub const FLAT_PUNCH: Shape = Shape::FlatPunch { flat_radius: 1e-4 };
/// Radius b/a₀ of the flat of [`Problem::blunted_parabola`]. The paper gives no number.
pub const BLUNT_RATIO: f64 = 0.3;
/// U₀/u_max of the problems in gross slip: the elastic part of the way shortens the slip by some
/// 1e-5 of it.
const GROSS_SLIP_AMPLITUDE: f64 = 1e5;

/// A contact to be driven by [`FrettingContact::advance_cycles`] at constant load and amplitude.
#[derive(Debug, Clone)]
pub struct Problem {
    /// What it is, for people.
    pub name: String,
    /// Definition of the contact.
    pub parameters: Parameters,
    /// The unworn contact at the initial load: a₀, d₀, F_N, the moduli and μ.
    pub start: TangentialContact,
    /// The prescribed normal quantity: force, N, or indentation depth, m.
    pub normal: f64,
    /// U₀, m.
    pub amplitude: f64,
    /// The Ñ at which the paper's figure or the table shows the state, rising.
    pub checkpoints: Vec<f64>,
    /// What is known on the way.
    pub history: History,
    /// The state in which wear ends, where it has a closed form: partial slip at constant depth.
    pub end: Option<ConstantDepthEnd>,
}

impl Problem {
    /// Section 4.1, figure 2: parabola at constant force, c₀ = 0.4 a₀.
    pub fn parabola_at_constant_force() -> Self {
        Self::partial_slip(PARABOLA, NormalControl::Force, INITIAL_STICK_RATIO)
            .with_checkpoints(&[0.04, 0.16, 0.36, 0.64, 1.0])
    }

    /// Section 4.2, figure 3: cone at constant force, c₀ = 0.4 a₀.
    pub fn cone_at_constant_force() -> Self {
        Self::partial_slip(CONE, NormalControl::Force, INITIAL_STICK_RATIO)
            .with_checkpoints(&[0.1, 0.4, 0.9, 1.6, 2.5])
    }

    /// Section 4.3, figure 4: parabola at constant indentation depth, c₀ = 0.4 a₀.
    pub fn parabola_at_constant_depth() -> Self {
        Self::partial_slip(PARABOLA, NormalControl::Indentation, INITIAL_STICK_RATIO)
            .with_checkpoints(&[0.16, 0.36, 0.64, 1.0, 9.0])
    }

    /// Section 4.4, figure 5: parabola with a worn, flat tip at constant force. b = [`BLUNT_RATIO`]
    /// a₀ and c₀ = 0.4 a₀ are choices: the paper says neither.
    pub fn blunted_parabola() -> Self {
        let body = blunted_parabola(BLUNT_RATIO);
        Self::partial_slip(body, NormalControl::Force, INITIAL_STICK_RATIO)
            .with_checkpoints(&[0.04, 0.16, 0.36, 0.64, 1.44])
    }

    /// The four cases of the paper in its order.
    pub fn published() -> [Self; 4] {
        [
            Self::parabola_at_constant_force(),
            Self::cone_at_constant_force(),
            Self::parabola_at_constant_depth(),
            Self::blunted_parabola(),
        ]
    }

    /// Any body whose amplitude is such that the unworn contact sticks up to `stick_ratio` = c₀/a₀.
    /// No check points.
    ///
    /// # Panics
    /// For the flat punch, which knows no partial slip; unless b < c₀ < a₀, with the radius b of a
    /// flat.
    pub fn partial_slip(body: Shape, control: NormalControl, stick_ratio: f64) -> Self {
        let start = initial(body);
        let stick = stick_ratio * start.normal.radius();
        assert!(
            stick_ratio < 1.0 && stick > body.flat_radius(),
            "c/a0 = {stick_ratio} lies between the flat and the edge of the contact"
        );
        // μq(c)/G* of the unworn body
        let amplitude =
            start.slip_ratio() * (start.normal.depth() - NormalContact::at_radius(body, 1.0, stick).depth());
        let end = (control == NormalControl::Indentation)
            .then(|| ConstantDepthEnd::new(body, start.normal.depth(), stick));
        let history = History::of_partial_slip(&body, control, stick_ratio);
        let name = format!("{} at constant {}, c/a0 = {stick_ratio}", name(&body), quantity(control));
        Self { end, history, ..Self::new(name, start, control, amplitude) }
    }

    /// Flat punch in gross slip at constant force.
    pub fn flat_punch_in_gross_slip() -> Self {
        Self::gross_slip(FLAT_PUNCH, History::CentralPressure(&FLAT_PUNCH_GROSS_SLIP))
    }

    /// Sphere in gross slip at constant force.
    pub fn sphere_in_gross_slip() -> Self {
        Self::gross_slip(PARABOLA, History::CentralWear(&SPHERE_GROSS_SLIP))
    }

    fn gross_slip(body: Shape, history: History) -> Self {
        let start = initial(body);
        let name = format!("{} in gross slip", name(&body));
        let amplitude = GROSS_SLIP_AMPLITUDE * start.full_slip();
        let problem = Self { history, ..Self::new(name, start, NormalControl::Force, amplitude) };
        let checkpoints: Vec<f64> =
            history.places().iter().map(|path| path / problem.reduced_path(1.0)).collect();
        problem.with_checkpoints(&checkpoints)
    }

    fn new(name: String, start: TangentialContact, control: NormalControl, amplitude: f64) -> Self {
        let parameters =
            Parameters { profile: profile(start.normal.shape()), normal_control: control, ..material() };
        let normal = match control {
            NormalControl::Force => start.normal.force(),
            NormalControl::Indentation => start.normal.depth(),
        };
        Self {
            name,
            parameters,
            start,
            normal,
            amplitude,
            checkpoints: Vec::new(),
            history: History::Unknown,
            end: None,
        }
    }

    /// The same with other check points.
    pub fn with_checkpoints(self, checkpoints: &[f64]) -> Self {
        Self { checkpoints: checkpoints.to_vec(), ..self }
    }

    /// The same problem whose N₀ is `cycles` (> 0), by the choice of the wear coefficient: short
    /// lives that can be followed cycle by cycle.
    pub fn with_seed_cycles(mut self, cycles: f64) -> Self {
        self.parameters.wear_coefficient *= self.seed_cycles() / cycles;
        self
    }

    /// a₀, m.
    pub fn contact_radius(&self) -> f64 {
        self.start.normal.radius()
    }

    /// d₀, m.
    pub fn depth(&self) -> f64 {
        self.start.normal.depth()
    }

    /// c₀, m: stick radius of the unworn contact at the amplitude; 0 in gross slip.
    pub fn stick_radius(&self) -> f64 {
        self.start.stick_radius(self.amplitude)
    }

    /// a₀² d₀, m³: the unit of worn volumes.
    pub fn volume_unit(&self) -> f64 {
        self.contact_radius().powi(2) * self.depth()
    }

    /// N₀ = π a₀² d₀ σ₀/(k μ F_N U₀), cycles (eq. (20)).
    pub fn seed_cycles(&self) -> f64 {
        let limit = self.start.friction * self.start.normal.force();
        seed_cycles(
            self.contact_radius(),
            self.depth(),
            self.parameters.wear_per_work(),
            limit,
            self.amplitude,
        )
    }

    /// S = κE*s/a₀ after Ñ = `life` in gross slip, κ = kμ/σ₀: a cycle slips s = 4U₀. S = 4π Ñ E* a₀
    /// d₀/F_N.
    pub fn reduced_path(&self, life: f64) -> f64 {
        let normal = &self.start.normal;
        4.0 * PI * life * normal.modulus() * normal.radius() * normal.depth() / normal.force()
    }

    /// A contact, pressed and at rest.
    ///
    /// # Errors
    /// None for a problem as it was made; [`Error::Parameter`] after a bad change of its public
    /// fields.
    pub fn begin(&self) -> Result<FrettingContact, Error> {
        let mut contact = FrettingContact::new(self.parameters.clone())?;
        contact.start_at(self.normal, 0.0)?;
        Ok(contact)
    }

    /// Runs ΔÑ = `life` of cycles.
    ///
    /// # Errors
    /// As [`FrettingContact::advance_cycles`].
    pub fn advance(&self, contact: &mut FrettingContact, life: f64) -> Result<(), Error> {
        contact.advance_cycles(self.normal, self.amplitude, life * self.seed_cycles())
    }

    /// Largest error of a worn depth `worn(r)` (m) against the final state, in d₀; none where that
    /// is not known.
    ///
    /// Taken at 500 even radii inside c, where nothing may wear, and at 4000 from there to 1.1 a∞,
    /// dense at c, where the final depth starts like a square root.
    pub fn profile_error(&self, worn: impl Fn(f64) -> f64) -> Option<f64> {
        let end = self.end.as_ref()?;
        let (c, outer) = (self.stick_radius(), 1.1 * end.outer_radius());
        let inside = (0..500).map(|i| c * f64::from(i) / 500.0);
        let outside = (1..=4000).map(|i| {
            let share = (f64::from(i) / 4000.0).powi(2);
            (c * c + (outer - c) * (outer + c) * share).sqrt()
        });
        let error = |r: f64| (worn(r) - end.worn_depth(r)).abs() / self.depth();
        // NaN is an error, too, and f64::max would drop it
        inside.chain(outside).map(error).reduce(|most, error| if error <= most { most } else { error })
    }
}

/// Steel on steel with the wear coefficient of 52100 steel.
fn material() -> Parameters {
    Parameters::default()
}

/// The unworn contact under [`NORMAL_FORCE`].
fn initial(body: Shape) -> TangentialContact {
    let Parameters { materials, friction_coefficient: friction, .. } = material();
    let normal = NormalContact::at_force(body, materials.normal_modulus(), NORMAL_FORCE);
    TangentialContact { normal, modulus: materials.tangential_modulus(), friction }
}

/// The ball cut off at b = `ratio`·a₀ (0 < ratio < 1) under [`NORMAL_FORCE`], from F_N =
/// (2E*/3R)(2a² + b²) √(a² − b²).
pub fn blunted_parabola(ratio: f64) -> Shape {
    let radius = 0.01;
    let cube = 1.5 * radius * NORMAL_FORCE
        / material().materials.normal_modulus()
        / ((2.0 + ratio * ratio) * (1.0 - ratio * ratio).sqrt());
    Shape::BluntedSphere { radius, flat_radius: ratio * cube.cbrt() }
}

/// The engine's description of a body.
fn profile(shape: Shape) -> Profile {
    match shape {
        Shape::Parabola { radius } => Profile::Parabola { radius },
        Shape::Cone { slope } => Profile::Cone { slope },
        Shape::PowerLaw { exponent, coefficient } => Profile::PowerLaw { exponent, coefficient },
        Shape::BluntedSphere { radius, flat_radius } => Profile::BluntedSphere { radius, flat_radius },
        Shape::RoundedPunch { radius, flat_radius } => Profile::RoundedPunch { radius, flat_radius },
        Shape::FlatPunch { flat_radius } => Profile::FlatPunch { flat_radius },
    }
}

fn name(shape: &Shape) -> &'static str {
    match shape {
        Shape::Parabola { .. } => "parabola",
        Shape::Cone { .. } => "cone",
        Shape::PowerLaw { .. } => "power law",
        Shape::BluntedSphere { .. } => "blunted parabola",
        Shape::RoundedPunch { .. } => "rounded punch",
        Shape::FlatPunch { .. } => "flat punch",
    }
}

fn quantity(control: NormalControl) -> &'static str {
    match control {
        NormalControl::Force => "force",
        NormalControl::Indentation => "depth",
    }
}

#[cfg(test)]
mod tests;
