//! Derivatives of an interface on worn profiles, and a compliant fixture around it that is solved
//! with them.

use crate::common::*;
use fretting_contact::{Error, FrettingContact, Gradient, Interface, Parameters, Summit};

/// An output of an interface, with its gradient.
pub(crate) type Output = (&'static str, fn(&Interface) -> f64, fn(&Interface) -> Gradient);

pub(crate) const OUTPUTS: [Output; 4] = [
    ("tangential_force", Interface::tangential_force, |i| {
        i.total_gradient(FrettingContact::tangential_force_gradient)
    }),
    ("moment", Interface::moment, Interface::moment_gradient),
    ("indentation_depth", Interface::indentation_depth, Interface::indentation_depth_gradient),
    ("normal_reaction", Interface::normal_reaction, |i| {
        i.total_gradient(FrettingContact::normal_reaction_gradient)
    }),
];

/// Contacts on the y axis: a rotation moves them along x.
fn on_a_line() -> Vec<Summit> {
    let at = |k: u32| {
        let share = |factor: f64| (f64::from(k) * factor).fract();
        let y = 2e-3 * (share(0.569_840_291) - 0.3);
        let radius_factor = 0.5 + share(0.414_213_562);
        Summit { offset: 2e-6 * share(0.618_033_988_75), x: 0.0, y, radius_factor }
    };
    (0..8).map(at).collect()
}

/// Under force control, with wear and rotation, against differences on the way that the body goes.
/// Between two updates of the profiles these are the derivatives of the law itself.
#[test]
fn gradients_on_worn_profiles_are_differences() {
    let parameters = Parameters { wear_coefficient: 3.2e-2, resolution: 32, ..without_wear(BALL) };
    let mut joint = Interface::new(parameters, &on_a_line()).unwrap();
    joint.start_at(400.0, [0.0; 2], 0.0).unwrap();
    for k in 1..=120 {
        let phase = 0.1 * f64::from(k);
        let (force, u) = (400.0 * (1.0 + 0.2 * (0.7 * phase).sin()), 1e-6 * phase.sin());
        joint.advance_to(force, [u, 0.0], 2e-4 * phase.sin()).unwrap();
    }
    assert!(joint.counters().profile_updates > 10, "{}", joint.counters());
    let (force, u, turn) = (joint.normal_reaction(), joint.displacement(), joint.rotation());
    // back from where the body stands, so that it goes one way
    let (mut here, down) = (joint.clone(), -1e-8);
    here.advance_to(force, [u + 40.0 * down, 0.0], turn).unwrap();
    let u = here.displacement();
    let work: Output = ("dissipated_energy", Interface::dissipated_energy, |i| {
        i.total_gradient(FrettingContact::dissipated_energy_gradient)
    });
    let moved = |[normal, along, turned]: [f64; 3]| {
        let mut moved = here.clone();
        moved.advance_to(force + normal, [u + along, 0.0], turn + turned).unwrap();
        moved
    };
    let base = moved([0.0, 1e-3 * down, 0.0]);
    for (name, read, gradient) in OUTPUTS.into_iter().chain([work]) {
        let given = gradient(&here);
        // scales of what each input changes, so that a derivative of 0 is one
        let ways = [
            ([1e-4, 1e-3 * down, 0.0], given.normal, 1e-4, 400.0),
            ([0.0, 2e-3 * down, 0.0], given.displacement, 1e-3 * down, 1e-6),
            ([0.0, 1e-3 * down, 1e-9], given.rotation, 1e-9, 1e-3),
        ];
        for (way, given, step, scale) in ways {
            let difference = (read(&moved(way)) - read(&base)) / step;
            let size = given.abs() + 1e-4 * read(&here).abs() / scale;
            close(difference, given, 2e-3 * size, &format!("{name}, {way:?}"));
        }
    }
}

/// Takes an interface in a fixture of stiffness k (N/m) to a displacement D (m) of its drive.
/// Returns the number of trials and the residual force, N.
fn drive(joint: &mut Interface, force: f64, drive: f64, stiffness: f64) -> Result<(u32, f64), Error> {
    let start = joint.clone();
    let (mut u, mut bounds) = (start.displacement(), [f64::NEG_INFINITY, f64::INFINITY]);
    let mut trials = 0;
    loop {
        trials += 1;
        *joint = start.clone();
        joint.advance_to(force, [u, 0.0], 0.0)?;
        let residual = stiffness * (drive - u) - joint.tangential_force();
        if residual.abs() <= 1e-10 * stiffness * drive.abs().max(u.abs()) || trials == 50 {
            return Ok((trials, residual));
        }
        // the residual falls as U grows, so that each trial is a bound
        bounds[usize::from(residual < 0.0)] = u;
        let slope = joint.total_gradient(FrettingContact::tangential_force_gradient).displacement;
        u += residual / (stiffness + slope);
        if u <= bounds[0] || u >= bounds[1] {
            u = 0.5 * (bounds[0] + bounds[1]);
        }
    }
}

/// Equal contacts in a fixture are one contact with a share of it, which the engine solves by
/// itself; in sliding the fixture is deflected by μF/k.
#[test]
fn a_fixture_around_an_interface_is_the_rig_of_one_contact() {
    let rig_stiffness = 2e7;
    let mut one = started(Parameters { rig_stiffness, ..without_wear(BALL) });
    let mut three = Interface::new(without_wear(BALL), &[Summit::at_offset(0.0); 3]).unwrap();
    three.start_at(3.0 * FORCE, [0.0; 2], 0.0).unwrap();
    for target in [2e-6, 4e-6, 2e-6, -4e-6, -3e-6, 1e-6, 1e-5] {
        one.advance_to(FORCE, target).unwrap();
        let (trials, _) = drive(&mut three, 3.0 * FORCE, target, 3.0 * rig_stiffness).unwrap();
        assert!(trials <= 9, "{target:e} m: {trials} trials");
        close_to(three.tangential_force(), 3.0 * one.tangential_force(), 1e-8, "T");
        close_to(three.displacement(), target - one.tangential_force() / rig_stiffness, 1e-8, "U");
    }
    close_to(three.displacement(), 1e-5 - MU * FORCE / rig_stiffness, 1e-8, "U in sliding");
}

/// Steps that reverse in gross slip, in a soft fixture. (Newton's method without bounds alternated
/// between slip forward and backward, and ended with a residual of 2 μF_N after 50 trials.)
#[test]
fn steps_that_reverse_in_gross_slip_are_solved_in_a_soft_fixture() {
    let stiffness = started(without_wear(BALL)).tangential_stiffness();
    for (ratio, reach, steps) in
        [(0.05, 2.0, 40), (0.1, 2.0, 20), (0.2, 4.0, 20), (0.5, 4.0, 12), (2.0, 2.0, 8)]
    {
        let rig_stiffness = ratio * stiffness;
        let mut one = started(Parameters { rig_stiffness, ..without_wear(BALL) });
        let mut joint = Interface::new(without_wear(BALL), &[Summit::at_offset(0.0)]).unwrap();
        joint.start_at(FORCE, [0.0; 2], 0.0).unwrap();
        let amplitude = reach * MU * FORCE * (1.0 / rig_stiffness + 1.5 / stiffness);
        for k in 0..3 * steps {
            let target = amplitude * (std::f64::consts::TAU * (f64::from(k) + 0.3) / f64::from(steps)).sin();
            one.advance_to(FORCE, target).unwrap();
            let (trials, _) = drive(&mut joint, FORCE, target, rig_stiffness).unwrap();
            let what = format!("{ratio}, step {k}");
            assert!(trials < 15, "{what}: {trials} trials");
            close(joint.tangential_force(), one.tangential_force(), 1e-8 * MU * FORCE, &what);
        }
        close_to(joint.dissipated_energy(), one.dissipated_energy(), 1e-8, "work");
    }
}

/// The same with wear, to the error of its updates.
#[test]
fn a_fixture_around_an_interface_that_wears_is_the_rig_of_one_contact() {
    let rig_stiffness = 2e7;
    let parameters = Parameters { wear_coefficient: 3.2e-2, resolution: 32, ..without_wear(BALL) };
    let mut one = started(Parameters { rig_stiffness, ..parameters.clone() });
    let mut three = Interface::new(parameters, &[Summit::at_offset(0.0); 3]).unwrap();
    three.start_at(3.0 * FORCE, [0.0; 2], 0.0).unwrap();
    let mut trials = 0;
    for k in 1..=400 {
        let target = 4e-6 * (0.1 * f64::from(k)).sin();
        one.advance_to(FORCE, target).unwrap();
        trials += drive(&mut three, 3.0 * FORCE, target, 3.0 * rig_stiffness).unwrap().0;
        close(three.tangential_force(), 3.0 * one.tangential_force(), 3e-3 * 3.0 * MU * FORCE, "T");
    }
    assert!(one.counters().profile_updates > 3 && trials < 4 * 400, "{trials} trials");
    close_to(three.wear_volume(), 3.0 * one.wear_volume(), 2e-3, "worn volume");
}
