//! Saved states and derivatives of a contact that moves in both tangential directions.

use crate::common::{
    self, BALL, BLUNTED, CONE, FORCE, PUNCH, ROUNDED, contact, exact, seeded, started, state, uniform,
    without_wear,
};
use fretting_contact::{Error, FrettingContact, Gradient, NormalControl, Parameters, Profile, Snapshot};

/// A random step: in the plane, on the line, off the counter body.
fn step(contact: &mut FrettingContact, random: &mut rand::rngs::StdRng) -> Result<(), Error> {
    let mut up_to = |most: f64| uniform(random, -most, most);
    let place = [up_to(2e-6), up_to(2e-6)];
    let load = FORCE * (1.0 + 0.3 * up_to(1.0));
    match (up_to(8.0) + 8.0) as u32 {
        0 => contact.advance_to_planar(-1.0, place),
        1..4 => contact.advance_to(load, place[0]),
        4..6 => contact.advance_to_planar(load, place),
        _ => contact.advance_to_planar(FORCE, place),
    }
}

fn readings(contact: &FrettingContact) -> Vec<u64> {
    let mut values = vec![
        contact.displacement(),
        contact.displacement_y(),
        contact.tangential_force(),
        contact.tangential_force_y(),
        contact.wear_volume(),
        contact.wear_depth(),
        contact.dissipated_energy(),
        contact.stick_radius(),
        contact.tangential_stiffness(),
        contact.profile_volume(),
    ];
    for r in contact.probe_radii() {
        values.extend([
            contact.worn_depth_at(r),
            contact.shear_traction_at(r),
            contact.shear_traction_y_at(r),
        ]);
    }
    values.iter().map(|value| value.to_bits()).collect()
}

/// Forward and back again, by a copy of the state and by its text: the same bits in any instance.
#[test]
fn a_restored_state_goes_on_with_the_same_bits() {
    for (profile, wear) in
        [(BALL, 0.0), (CONE, 0.0), (PUNCH, 0.0), (BALL, 3.2e-3), (ROUNDED, 3.2e-3), (PUNCH, 3.2e-3)]
    {
        for seed in 0..6 {
            let parameters = Parameters { wear_coefficient: wear, ..without_wear(profile.clone()) };
            let mut random = seeded(seed);
            let mut one = contact(parameters.clone());
            one.start_at_planar(FORCE, [0.0, 1e-7]).unwrap();
            for _ in 0..12 {
                step(&mut one, &mut random).unwrap();
            }
            let saved = one.snapshot();
            let text = serde_json::to_string(&saved).unwrap();
            assert_eq!(serde_json::from_str::<Snapshot>(&text).unwrap(), saved);
            let mut on = seeded(100 + seed);
            for _ in 0..8 {
                step(&mut one, &mut on).unwrap();
            }
            let expected = readings(&one);
            one.restore(&saved).unwrap();
            let mut other = contact(parameters);
            other.restore(&serde_json::from_str(&text).unwrap()).unwrap();
            for again in [&mut one, &mut other] {
                let mut on = seeded(100 + seed);
                for _ in 0..8 {
                    step(again, &mut on).unwrap();
                }
                assert_eq!(readings(again), expected, "{profile:?}, wear {wear}, seed {seed}");
            }
            assert_eq!(state(&one), state(&other));
        }
    }
}

#[test]
fn reading_and_saving_leave_no_trace() {
    let parameters = Parameters { wear_coefficient: 3.2e-3, ..Parameters::default() };
    let (mut plain, mut watched) = (contact(parameters.clone()), contact(parameters));
    let (mut random, mut again) = (seeded(5), seeded(5));
    for contact in [&mut plain, &mut watched] {
        contact.start_at(FORCE, 0.0).unwrap();
    }
    for _ in 0..40 {
        step(&mut plain, &mut random).unwrap();
        step(&mut watched, &mut again).unwrap();
        let _ = (readings(&watched), watched.snapshot(), watched.tangential_stiffness_gradient());
    }
    assert_eq!(state(&plain), state(&watched));
}

#[test]
fn a_refused_step_leaves_no_trace() {
    for wear in [0.0, 3.2e-4] {
        let mut contact = started(Parameters { wear_coefficient: wear, ..Parameters::default() });
        contact.advance_to_planar(FORCE, [1e-6, 5e-7]).unwrap();
        let before = state(&contact);
        for (load, place) in
            [(f64::NAN, [0.0; 2]), (FORCE, [0.0, f64::NAN]), (FORCE, [1e300, 0.0]), (1e300, [0.0, 1e-6])]
        {
            contact.advance_to_planar(load, place).unwrap_err();
            assert_eq!(state(&contact), before);
        }
    }
}

/// States that no contact could be in are refused, whatever part of the plane has been changed.
#[test]
fn impossible_states_are_refused() {
    let mut contact = started(Parameters::default());
    contact.advance_to_planar(FORCE, [1e-6, 1e-6]).unwrap();
    let sound = serde_json::to_value(contact.snapshot()).unwrap();
    let changes: [(&str, serde_json::Value, &str); 5] = [
        ("/state/row/plane/spacing", (-1.0).into(), "out of order"),
        ("/state/row/plane/knots/3/origin/1", 1.0.into(), "beyond their friction bound"),
        ("/state/row/plane/knots/3/place/x", 1.0.into(), "out of order"),
        ("/state/row/plane/knots/0/place/x", 1e-9.into(), "out of order"),
        ("/state/direction/0", 2.0.into(), "direction"),
    ];
    for (place, value, problem) in changes {
        let mut changed = sound.clone();
        *changed.pointer_mut(place).expect(place) = value;
        let changed: Snapshot = serde_json::from_value(changed).unwrap();
        let refused = contact.restore(&changed).unwrap_err();
        assert!(refused.to_string().contains(problem), "{place}: {refused}");
    }
    contact.restore(&serde_json::from_value(sound).unwrap()).unwrap();
}

/// A quantity and its gradient.
type Quantity = (&'static str, fn(&FrettingContact) -> f64, fn(&FrettingContact) -> Gradient, f64);

/// With the error that sampling leaves in a difference over a tenth of a sample, relative.
const QUANTITIES: [Quantity; 5] = [
    ("T_x", FrettingContact::tangential_force, FrettingContact::tangential_force_gradient, 0.01),
    ("T_y", FrettingContact::tangential_force_y, FrettingContact::tangential_force_y_gradient, 0.01),
    ("W", FrettingContact::dissipated_energy, FrettingContact::dissipated_energy_gradient, 0.01),
    ("c", FrettingContact::stick_radius, FrettingContact::stick_radius_gradient, 0.02),
    ("F_N", FrettingContact::normal_reaction, FrettingContact::normal_reaction_gradient, 1e-6),
];

/// Gradients against central differences along paths that turn to the side, onward, with a falling
/// load, and back while the load falls so fast that springs slip on against the motion.
#[test]
fn derivatives_agree_with_differences_along_the_path() {
    for control in [NormalControl::Force, NormalControl::Indentation] {
        for profile in [BALL, CONE, ROUNDED] {
            let parameters =
                Parameters { normal_control: control, resolution: 512, ..without_wear(profile.clone()) };
            let mut contact = contact(parameters);
            let load = if control == NormalControl::Force { FORCE } else { 3e-6 };
            contact.start_at(load, 0.0).unwrap();
            contact.advance_to(load, 4e-7).unwrap();
            contact.advance_to_planar(load, [7e-7, 6e-7]).unwrap();
            for (way, change) in [
                ([1.0, 0.2], 0.0),
                ([0.3, 1.0], 0.0),
                ([0.8, -0.3], -0.3),
                ([1.0, 1.0], 0.1),
                ([-1.0, -0.4], -10.0),
            ] {
                let step = 2e-10;
                let mut at = contact.clone();
                let mut k = 0.0;
                let mut onward = |contact: &mut FrettingContact| {
                    k += 1.0;
                    let place = [7e-7 + k * step * way[0], 6e-7 + k * step * way[1]];
                    let normal = load * (1.0 + k * change * step / 1e-6);
                    contact.advance_to_planar(normal, place).unwrap();
                };
                // so that the direction is that of the path
                onward(&mut at);
                let before = at.clone();
                onward(&mut at);
                let middle = at.clone();
                onward(&mut at);
                for (name, read, gradient, tolerance) in QUANTITIES {
                    let Gradient { normal, displacement, displacement_y, .. } = gradient(&middle);
                    let parts = [
                        normal * load * change * step / 1e-6,
                        displacement * step * way[0],
                        displacement_y * step * way[1],
                    ];
                    let difference = 0.5 * (read(&at) - read(&before));
                    let scale = parts.iter().fold(0.0f64, |most, part| most.max(part.abs()))
                        + 1e-12 * read(&middle).abs();
                    let error = (parts.iter().sum::<f64>() - difference).abs() / scale;
                    assert!(
                        error < tolerance,
                        "{profile:?} {control:?} {way:?} {change}, {name}: {parts:?} against {difference:e}"
                    );
                }
            }
        }
    }
}

/// Before it has moved along y a contact resists that with all its springs, and force along x does
/// not feel it.
#[test]
fn on_a_line_motion_along_y_is_elastic() {
    let mut contact = started(without_wear(BALL));
    contact.advance_to(FORCE, 1e-6).unwrap();
    let gradient = contact.tangential_force_y_gradient();
    let force = contact.tangential_force();
    contact.advance_to_planar(FORCE, [1e-6, 1e-12]).unwrap();
    // but for half of the last sample, at whose outer end there is no bound
    common::close_to(contact.tangential_force_y(), gradient.displacement_y * 1e-12, 5e-3, "force along y");
    common::close_to(contact.tangential_force(), force, 1e-9, "force along x");
}

/// The load falls to next to none while the body moves across by a way that is nothing beside the
/// bound of before, and much beside the one that is left: the springs end at that nevertheless.
#[test]
fn springs_follow_a_bound_that_all_but_vanishes() {
    let mut scenes = vec![(BALL, 1e-12, 1e-13), (BALL, 1e-30, 1e-25), (BALL, 9.35e-307, -3.45e-190)];
    for profile in [CONE, BLUNTED, Profile::PowerLaw { exponent: 4.0, coefficient: 1e9 }] {
        for load in [1e-3, 1e-12] {
            let way = 3.0 * exact(&profile, load).full_slip();
            scenes.push((profile.clone(), load, way));
        }
    }
    for (profile, load, way) in scenes {
        let mut moved = started(without_wear(profile.clone()));
        moved.advance_to_planar(load, [0.0, way]).unwrap();
        let limit = moved.parameters().friction_coefficient * moved.normal_reaction();
        let force = moved.tangential_force_y() * way.signum();
        // the force of the least load is below all numbers
        assert!(
            load < 1e-300 || (force / limit - 1.0).abs() < 1e-12,
            "{profile:?}, {load:e} N: {force:e} of {limit:e}"
        );
        let mut other = contact(without_wear(profile));
        other.restore(&moved.snapshot()).unwrap_or_else(|problem| panic!("{load:e} N: {problem}"));
        assert_eq!(state(&other), state(&moved));
    }
}
