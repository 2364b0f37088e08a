//! Scenes, closed forms and small helpers shared by the engine's tests.
#![allow(dead_code, reason = "each test file uses a part of this")]

use fretting_contact::reference::{NormalContact, Shape, TangentialContact};
use fretting_contact::{FrettingContact, NormalControl, Parameters, Profile, ProfileTable};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

/// E* of steel on steel, Pa, written out so that the tests do not lean on the engine's own formula.
pub(crate) const E_STAR: f64 = 210e9 / (2.0 * (1.0 - 0.09));
/// G* of steel on steel, Pa.
pub(crate) const G_STAR: f64 = 2.0 * 210e9 / 2.6 / 1.7;
/// Coefficient of friction of every scene.
pub(crate) const MU: f64 = 0.6;
/// Normal force of the usual scene, N.
pub(crate) const FORCE: f64 = 100.0;

pub(crate) const BALL: Profile = Profile::Parabola { radius: 0.01 };
pub(crate) const CONE: Profile = Profile::Cone { slope: 0.02 };
pub(crate) const BLUNTED: Profile = Profile::BluntedSphere { radius: 0.01, flat_radius: 1e-4 };
pub(crate) const ROUNDED: Profile = Profile::RoundedPunch { radius: 0.01, flat_radius: 1e-4 };
pub(crate) const PUNCH: Profile = Profile::FlatPunch { flat_radius: 1e-4 };

/// Every analytic profile, of such a size that 100 N make a contact of some 0.1 mm.
pub(crate) fn analytic() -> [Profile; 8] {
    [
        BALL,
        CONE,
        Profile::PowerLaw { exponent: 1.5, coefficient: 0.5 },
        Profile::PowerLaw { exponent: 3.0, coefficient: 2e5 },
        Profile::PowerLaw { exponent: 4.0, coefficient: 1e9 },
        BLUNTED,
        ROUNDED,
        PUNCH,
    ]
}

/// The same profile for the closed forms.
pub(crate) fn shape(profile: &Profile) -> Shape {
    match *profile {
        Profile::Parabola { radius } => Shape::Parabola { radius },
        Profile::Cone { slope } => Shape::Cone { slope },
        Profile::PowerLaw { exponent, coefficient } => Shape::PowerLaw { exponent, coefficient },
        Profile::BluntedSphere { radius, flat_radius } => Shape::BluntedSphere { radius, flat_radius },
        Profile::RoundedPunch { radius, flat_radius } => Shape::RoundedPunch { radius, flat_radius },
        Profile::FlatPunch { flat_radius } => Shape::FlatPunch { flat_radius },
        Profile::Table(_) | Profile::Ellipse { .. } => panic!("{profile:?} has no shape of revolution"),
    }
}

/// Points of a sphere of 10 mm radius up to 0.4 mm.
pub(crate) fn sampled_sphere(points: usize) -> ProfileTable {
    let at = |i: usize| {
        let r = 4e-4 * i as f64 / (points - 1) as f64;
        (r, r * r / 0.02)
    };
    ProfileTable::new((0..points).map(at).collect()).expect("the points of a sphere are a profile")
}

/// A profile without wear under force control.
pub(crate) fn without_wear(profile: Profile) -> Parameters {
    Parameters { profile, wear_coefficient: 0.0, ..Parameters::default() }
}

pub(crate) fn contact(parameters: Parameters) -> FrettingContact {
    FrettingContact::new(parameters).expect("valid parameters")
}

/// A contact without wear, pressed by `force` (N) at displacement 0.
pub(crate) fn pressed(profile: Profile, force: f64) -> FrettingContact {
    let mut contact = contact(without_wear(profile));
    contact.start_at(force, 0.0).expect("the load is carried");
    contact
}

/// Closed forms of a profile under a constant force (N).
pub(crate) fn exact(profile: &Profile, force: f64) -> TangentialContact {
    let normal = NormalContact::at_force(shape(profile), E_STAR, force);
    TangentialContact { normal, modulus: G_STAR, friction: MU }
}

pub(crate) fn to(contact: &mut FrettingContact, normal: f64, displacement: f64) {
    contact.advance_to(normal, displacement).expect("the line can be walked");
}

/// Walks a straight line in `steps` equal steps.
pub(crate) fn in_steps(contact: &mut FrettingContact, from: (f64, f64), target: (f64, f64), steps: usize) {
    for k in 1..=steps {
        let share = k as f64 / steps as f64;
        let mix = |a: f64, b: f64| if k == steps { b } else { a + share * (b - a) };
        to(contact, mix(from.0, target.0), mix(from.1, target.1));
    }
}

/// Asserts |value − target| ≤ tolerance; NaN fails.
#[track_caller]
pub(crate) fn close(value: f64, target: f64, tolerance: f64, what: &str) {
    assert!(
        (value - target).abs() <= tolerance,
        "{what}: {value:e} against {target:e}, off by {:e} where {tolerance:e} is allowed",
        value - target
    );
}

/// Asserts a relative error.
#[track_caller]
pub(crate) fn close_to(value: f64, target: f64, relative: f64, what: &str) {
    close(value, target, relative * target.abs(), what);
}

pub(crate) fn seeded(seed: u64) -> StdRng {
    StdRng::seed_from_u64(seed)
}

/// A number evenly distributed over [low, high).
pub(crate) fn uniform(random: &mut StdRng, low: f64, high: f64) -> f64 {
    random.random_range(low..high)
}

/// The whole state of a contact, without the counters: these also count work that ended in an
/// error.
pub(crate) fn state(contact: &FrettingContact) -> serde_json::Value {
    let mut state = serde_json::to_value(contact.snapshot()).expect("a snapshot is serialisable");
    state.as_object_mut().expect("a snapshot is a record").remove("counters").expect("it has counters");
    state
}

/// One wearing scene of `physics.md`-like seed units: stick radius c₀ = 0.4 a₀ at the start, life N₀ set by the wear
/// coefficient.
#[derive(Debug, Clone)]
pub(crate) struct WearScene {
    pub(crate) parameters: Parameters,
    pub(crate) start: TangentialContact,
    /// Value of the controlled quantity, N or m.
    pub(crate) normal: f64,
    /// U₀, m.
    pub(crate) amplitude: f64,
    /// N₀.
    pub(crate) seed_cycles: f64,
}

impl WearScene {
    /// `seed_cycles` N₀ is reached by the choice of the wear coefficient.
    pub(crate) fn new(profile: Profile, normal_control: NormalControl, seed_cycles: f64) -> Self {
        let start = exact(&profile, FORCE);
        let a = start.normal.radius();
        let stuck = NormalContact::at_radius(start.normal.shape(), E_STAR, 0.4 * a);
        let amplitude = start.slip_ratio() * (start.normal.depth() - stuck.depth());
        let hardness = 8e9;
        let wear_per_work =
            std::f64::consts::PI * a * a * start.normal.depth() / (seed_cycles * MU * FORCE * amplitude);
        let wear_coefficient = wear_per_work * hardness;
        let parameters =
            Parameters { profile, normal_control, wear_coefficient, hardness, ..Parameters::default() };
        let normal = match normal_control {
            NormalControl::Force => FORCE,
            NormalControl::Indentation => start.normal.depth(),
        };
        Self { parameters, start, normal, amplitude, seed_cycles }
    }

    /// a₀² d₀, m³.
    pub(crate) fn volume_unit(&self) -> f64 {
        self.start.normal.radius().powi(2) * self.start.normal.depth()
    }

    pub(crate) fn begin(&self) -> FrettingContact {
        let mut contact = contact(self.parameters.clone());
        contact.start_at(self.normal, 0.0).expect("the load is carried");
        contact
    }

    /// Runs whole cycles 0 → U₀ → −U₀ → 0 … in `steps` steps each, as a sine.
    pub(crate) fn cycle(&self, contact: &mut FrettingContact, cycles: usize, steps: usize) {
        for _ in 0..cycles {
            for k in 1..=steps {
                let phase = std::f64::consts::TAU * k as f64 / steps as f64;
                to(contact, self.normal, self.amplitude * phase.sin());
            }
        }
    }
}
