//! Scenes, closed forms and small helpers shared by the engine's tests.

use fretting_contact::problems::Problem;
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

/// Knots of the row of springs.
pub(crate) fn knots(contact: &FrettingContact) -> usize {
    let saved = serde_json::to_value(contact.snapshot()).expect("a state is plain data");
    saved.pointer("/state/row/line/knots").and_then(|knots| knots.as_array()).expect("a row").len()
}

/// A profile without wear under force control.
pub(crate) fn without_wear(profile: Profile) -> Parameters {
    Parameters { profile, wear_coefficient: 0.0, ..Parameters::default() }
}

pub(crate) fn contact(parameters: Parameters) -> FrettingContact {
    FrettingContact::new(parameters).expect("valid parameters")
}

/// A contact under the usual force at displacement 0.
pub(crate) fn started(parameters: Parameters) -> FrettingContact {
    let mut contact = contact(parameters);
    contact.start_at(FORCE, 0.0).expect("the load is carried");
    contact
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

/// The input of a normal control at which a profile without wear carries a force (N); the bodies
/// are apart where it is not positive.
pub(crate) fn normal_input(profile: &Profile, control: NormalControl, force: f64) -> f64 {
    match control {
        NormalControl::Force => force,
        NormalControl::Indentation if force <= 0.0 => force * 1e-8,
        NormalControl::Indentation => exact(profile, force).normal.depth(),
    }
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
    let mut snapshot = serde_json::to_value(contact.snapshot()).expect("a snapshot is serialisable");
    let state = snapshot["state"].as_object_mut().expect("the state is a record");
    state.remove("counters").expect("it has counters");
    snapshot
}

/// A body that wears, with c₀ = 0.4 a₀; its N₀ is `seed_cycles`.
pub(crate) fn wear_scene(profile: &Profile, control: NormalControl, seed_cycles: f64) -> Problem {
    Problem::partial_slip(shape(profile), control, 0.4).with_seed_cycles(seed_cycles)
}

/// The contact of a problem, pressed and at rest.
pub(crate) fn begun(problem: &Problem) -> FrettingContact {
    problem.begin().expect("the load is carried")
}

/// Runs whole cycles 0 → U₀ → −U₀ → 0 … in `steps` steps each, as a sine.
pub(crate) fn cycle(problem: &Problem, contact: &mut FrettingContact, cycles: usize, steps: usize) {
    for _ in 0..cycles {
        for k in 1..=steps {
            let phase = std::f64::consts::TAU * k as f64 / steps as f64;
            to(contact, problem.normal, problem.amplitude * phase.sin());
        }
    }
}
