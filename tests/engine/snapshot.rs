//! Saving and restoring: what follows a restored state is what followed it before, to the bit.
//! Counted work is left out: tables of the transforms are not saved but made again.

use crate::common::{self, *};
use fretting_contact::{Error, FrettingContact, Parameters, Profile, Snapshot};

fn profiles() -> [Profile; 5] {
    [BALL, CONE, BLUNTED, PUNCH, Profile::Table(sampled_sphere(30))]
}

fn parameters(profile: &Profile, wear: bool) -> Parameters {
    Parameters {
        wear_coefficient: if wear { 0.1 } else { 0.0 },
        resolution: 24,
        ..without_wear(profile.clone())
    }
}

/// Random lines, some without contact.
fn transient(contact: &mut FrettingContact, seed: u64) {
    let mut random = seeded(seed);
    for _ in 0..25 {
        to(contact, uniform(&mut random, -10.0, 100.0), uniform(&mut random, -4e-6, 4e-6));
    }
}

fn cyclic(contact: &mut FrettingContact, seed: u64) {
    let mut random = seeded(seed);
    for _ in 0..3 {
        contact
            .advance_cycles(uniform(&mut random, 50.0, 100.0), uniform(&mut random, 0.5e-6, 3e-6), 2.5)
            .expect("the cycles can be run");
    }
}

/// Everything that can be read, as bits.
fn readings(contact: &FrettingContact) -> Vec<u64> {
    let mut values = vec![
        contact.displacement(),
        contact.tangential_force(),
        contact.wear_volume(),
        contact.wear_depth(),
        contact.dissipated_energy(),
        contact.normal_reaction(),
        contact.indentation_depth(),
        contact.contact_radius(),
        contact.stick_radius(),
        contact.max_pressure(),
        contact.tangential_stiffness(),
        contact.profile_volume(),
        contact.transform_defect(),
        contact.clipped_work(),
    ];
    for r in contact.probe_radii() {
        values.extend([r, contact.worn_depth_at(r), contact.pressure_at(r), contact.shear_traction_at(r)]);
        values.push(contact.image_at(r));
    }
    values.iter().map(|value| value.to_bits()).collect()
}

#[test]
fn a_restored_state_goes_on_with_the_same_bits() {
    let ways: [fn(&mut FrettingContact, u64); 2] = [transient, cyclic];
    for profile in profiles() {
        for wear in [false, true] {
            for (before, after) in
                ways.iter().flat_map(|before| ways.iter().map(move |after| (before, after)))
            {
                let what = format!("{profile:?}, wear {wear}");
                let mut contact = contact(parameters(&profile, wear));
                before(&mut contact, 1);
                let saved = contact.snapshot();
                let at_save = readings(&contact);
                after(&mut contact, 2);
                let first = (state(&contact), readings(&contact));
                assert_ne!(first.1, at_save, "{what}: the run goes on");

                contact.restore(&saved).expect("it is its own state");
                assert_eq!(readings(&contact), at_save, "{what}: restored in place");
                after(&mut contact, 2);
                assert_eq!((state(&contact), readings(&contact)), first, "{what}: again in place");

                // through text, into a contact that has had another life
                let text = serde_json::to_string(&saved).expect("serialisable");
                let read: Snapshot = serde_json::from_str(&text).expect("readable");
                assert_eq!(read, saved, "{what}: text keeps every bit");
                let mut other = common::contact(parameters(&profile, wear));
                transient(&mut other, 3);
                other.restore(&read).expect("the parameters are equal");
                assert_eq!(readings(&other), at_save, "{what}: restored elsewhere");
                after(&mut other, 2);
                assert_eq!((state(&other), readings(&other)), first, "{what}: again elsewhere");
            }
        }
    }
}

/// Reading fields makes them on demand; that must not change what follows.
#[test]
fn reading_leaves_no_trace() {
    for profile in profiles() {
        let (mut read, mut unread) =
            (contact(parameters(&profile, true)), contact(parameters(&profile, true)));
        let mut random = seeded(4);
        for _ in 0..60 {
            let (normal, displacement) =
                (uniform(&mut random, -10.0, 100.0), uniform(&mut random, -4e-6, 4e-6));
            to(&mut read, normal, displacement);
            to(&mut unread, normal, displacement);
            readings(&read);
        }
        assert_eq!(state(&read), state(&unread), "{profile:?}");
    }
}

#[test]
fn saving_leaves_no_trace() {
    let (mut saved, mut unsaved) = (contact(parameters(&BALL, true)), contact(parameters(&BALL, true)));
    for seed in 0..5 {
        transient(&mut saved, seed);
        transient(&mut unsaved, seed);
        let snapshot = saved.snapshot();
        saved.restore(&snapshot).expect("it is its own state");
    }
    assert_eq!(state(&saved), state(&unsaved));
}

#[test]
fn a_saved_state_fits_only_the_same_setting_of_wear() {
    for wear in [false, true] {
        let mut source = contact(parameters(&BALL, wear));
        transient(&mut source, 1);
        let mut target = contact(parameters(&BALL, !wear));
        transient(&mut target, 2);
        let before = (target.snapshot(), readings(&target));
        match target.restore(&source.snapshot()) {
            Err(Error::Snapshot(problem)) => assert!(problem.contains("wear"), "{problem}"),
            other => panic!("{other:?}"),
        }
        assert_eq!((target.snapshot(), readings(&target)), before);
    }
}

/// Steps that fail on their way: the state is as before, to the bit, and what follows is, too.
#[test]
fn a_refused_step_leaves_no_trace() {
    let table = Profile::Table(sampled_sphere(30));
    for wear in [0.0, 1e-9, 0.1] {
        let mut refused = contact(Parameters { wear_coefficient: wear, ..without_wear(table.clone()) });
        let mut spared = refused.clone();
        // half cycles of a rhythm, whose reversals take a way of their own
        for k in 0..9 {
            let displacement = if k % 2 == 0 { 1e-6 } else { -1e-6 };
            to(&mut refused, 100.0, displacement);
            to(&mut spared, 100.0, displacement);
            let before = (refused.snapshot(), readings(&refused));
            for (normal, displacement) in [
                (1e6, -displacement),
                (1e6, displacement),
                (1e6, 0.0),
                (100.0, -f64::MAX.copysign(displacement)),
                (100.0, f64::MAX.copysign(displacement)),
                (50.0, -f64::MAX.copysign(displacement)),
            ] {
                let error = refused.advance_to(normal, displacement).expect_err("it cannot be done");
                let what = format!("wear {wear}, {normal} N, {displacement} m: {error}");
                assert_eq!((refused.snapshot(), readings(&refused)), before, "{what}");
            }
        }
        transient(&mut refused, 5);
        transient(&mut spared, 5);
        assert_eq!((state(&refused), readings(&refused)), (state(&spared), readings(&spared)), "wear {wear}");
    }
}

/// A saved state of `contact` with one number in another's place.
fn changed(contact: &FrettingContact, place: &str, number: f64) -> Result<(), Error> {
    let mut saved = serde_json::to_value(contact.snapshot()).unwrap();
    *saved.pointer_mut(place).expect("the state has this part") = number.into();
    contact.clone().restore(&serde_json::from_value(saved).unwrap())
}

/// Bodies that are apart rub on nothing: a state that says otherwise would be worn off a contact of
/// no size.
#[test]
fn a_state_with_work_between_bodies_apart_is_refused() {
    let mut contact = FrettingContact::new(Parameters::default()).unwrap();
    contact.start_at(-1.0, 0.0).unwrap();
    assert_eq!(changed(&contact, "/state/wear/backlog/work", 0.0), Ok(()));
    let refusal = changed(&contact, "/state/wear/backlog/work", 1e-9).unwrap_err().to_string();
    assert!(refusal.contains("what is still to wear"), "{refusal}");
}

/// Nodes for the wear of the backlog reach as far as the largest contact in which it slipped.
#[test]
fn a_state_with_slip_in_a_contact_larger_than_the_largest_is_refused() {
    let mut contact = started(Parameters { wear_coefficient: 0.01, ..without_wear(BALL) });
    for (normal, displacement) in [(FORCE, 1e-6), (FORCE, -1e-6), (2.0 * FORCE, 1e-6)] {
        to(&mut contact, normal, displacement);
    }
    let (radius, largest) = ("/state/wear/backlog/radius", contact.contact_radius());
    assert_eq!(changed(&contact, radius, largest), Ok(()));
    let refusal = changed(&contact, radius, 2.0 * largest).unwrap_err().to_string();
    assert!(refusal.contains("what is still to wear"), "{refusal}");
    let refusal = changed(&contact, "/state/reach", 1e61).unwrap_err().to_string();
    assert!(refusal.contains("out of range"), "{refusal}");
}

/// On fine meshes the image behind the front rises in a cell as narrow as the rounding of its
/// radius. The springs that stand there are on the profile.
#[test]
fn a_state_with_a_steep_front_is_taken_back() {
    for resolution in [64, 128, 256, 512] {
        let parameters = Parameters { wear_coefficient: 0.01, resolution, ..without_wear(BALL) };
        let mut contact = started(parameters.clone());
        for cycles in [1000.0, 2000.0, 2000.0] {
            contact.advance_cycles(FORCE, 1.5e-6, cycles).unwrap();
            let mut other = started(parameters.clone());
            other.restore(&contact.snapshot()).unwrap();
            assert_eq!(readings(&other), readings(&contact), "{resolution} cells");
        }
    }
}
