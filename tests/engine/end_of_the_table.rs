//! A contact that grows by wear to the last point of its profile table: nothing is known beyond it,
//! so that the call is refused with the radius, and nothing has changed, in cycles as in strokes.

use fretting_contact::profile::ProfileTable;
use fretting_contact::{Error, FrettingContact, NormalControl, Parameters, Profile};

/// Last radius of the table, m.
const END: f64 = 0.3e-3;

/// A ball of 10 mm up to r = 0.3 mm: 31 points.
fn points() -> Vec<(f64, f64)> {
    (0..=30).map(|k| f64::from(k) / 30.0 * END).map(|r| (r, r * r / 0.02)).collect()
}

fn ball(profile: Profile, control: NormalControl, rig_stiffness: f64) -> (FrettingContact, f64) {
    let parameters = Parameters { profile, normal_control: control, rig_stiffness, ..Parameters::default() };
    let mut contact = FrettingContact::new(parameters).unwrap();
    let normal = if control == NormalControl::Force { 100.0 } else { 5.5e-6 };
    contact.start_at(normal, 0.0).unwrap();
    (contact, normal)
}

fn table() -> Profile {
    Profile::Table(ProfileTable::new(points()).unwrap())
}

fn whole() -> Profile {
    Profile::Parabola { radius: 0.01 }
}

/// Scenes that wear their contact beyond the table: control, stiffness of the rig, amplitude,
/// cycles.
const SCENES: [(NormalControl, f64, f64, f64); 5] = [
    (NormalControl::Force, f64::INFINITY, 5e-6, 1e5),
    (NormalControl::Force, f64::INFINITY, 2.5e-6, 1e7),
    (NormalControl::Force, 3.5e7, 8e-6, 1e5),
    (NormalControl::Indentation, f64::INFINITY, 5e-6, 1e7),
    (NormalControl::Indentation, 3.5e7, 8e-6, 1e7),
];

#[test]
fn cycles_that_wear_the_contact_beyond_the_table_are_refused() {
    for (control, rig, amplitude, cycles) in SCENES {
        let (mut free, normal) = ball(whole(), control, rig);
        free.advance_cycles(normal, amplitude, cycles).unwrap();
        assert!(free.contact_radius() > END, "{control:?} {rig}: {}", free.contact_radius());
        let (mut contact, normal) = ball(table(), control, rig);
        // some wear before, so that what must not change is more than a start
        contact.advance_cycles(normal, amplitude, 10.0).unwrap();
        let before = contact.snapshot();
        match contact.advance_cycles(normal, amplitude, cycles) {
            Err(Error::BeyondTable { radius, value, .. }) => {
                assert_eq!(radius, END);
                assert!((value / normal - 1.0).abs() < 1e-12, "{value}");
            }
            other => panic!("{control:?} {rig}: {other:?}, a = {}", contact.contact_radius()),
        }
        assert_eq!(contact.snapshot(), before, "{control:?} {rig}");
        // fewer cycles are as good as ever
        let (mut free, _) = ball(whole(), control, rig);
        free.advance_cycles(normal, amplitude, 10.0).unwrap();
        let mut total = 10.0;
        loop {
            let mut ahead = free.clone();
            ahead.advance_cycles(normal, amplitude, total).unwrap();
            if ahead.contact_radius() > 0.99 * END {
                break;
            }
            free = ahead;
            contact.advance_cycles(normal, amplitude, total).unwrap();
            total *= 2.0;
        }
        assert!(total > 100.0, "{total}");
        for (table, free) in [
            (contact.wear_volume(), free.wear_volume()),
            (contact.contact_radius(), free.contact_radius()),
            (contact.wear_depth(), free.wear_depth()),
        ] {
            assert!((table / free - 1.0).abs() < 5e-3, "{control:?} {rig}: {table} {free}");
        }
    }
}

/// Calls of a few cycles each come to the end of the table as one call does, with nothing wrong
/// before.
#[test]
fn calls_of_any_length_stop_before_the_end() {
    for (control, rig, amplitude, cycles) in SCENES {
        let (mut contact, normal) = ball(table(), control, rig);
        let (mut free, _) = ball(whole(), control, rig);
        let mut refused = false;
        for _ in 0..200 {
            let part = cycles / 200.0;
            free.advance_cycles(normal, amplitude, part).unwrap();
            match contact.advance_cycles(normal, amplitude, part) {
                Ok(()) => assert!(contact.contact_radius() < END, "{control:?} {rig}"),
                Err(Error::BeyondTable { radius, .. }) => {
                    assert_eq!(radius, END);
                    refused = true;
                    break;
                }
                Err(other) => panic!("{control:?} {rig}: {other}"),
            }
        }
        assert!(refused, "{control:?} {rig}");
        // the first call that is refused is the first that comes beyond it, to the error of a step
        assert!(free.contact_radius() > 0.995 * END, "{control:?} {rig}: {}", free.contact_radius());
    }
}

/// Strokes, whose steady cycles are worn off by the same integration.
#[test]
fn strokes_that_wear_the_contact_beyond_the_table_are_refused() {
    let parameters = Parameters { profile: table(), wear_coefficient: 0.3, ..Parameters::default() };
    let mut contact = FrettingContact::new(parameters).unwrap();
    contact.start_at(100.0, 0.0).unwrap();
    for k in 0..20_000 {
        let before = contact.snapshot();
        match contact.advance_to(100.0, if k % 2 == 0 { 5e-6 } else { -5e-6 }) {
            Ok(()) => assert!(contact.contact_radius() < END),
            Err(Error::BeyondTable { radius, .. }) => {
                assert_eq!(radius, END);
                assert_eq!(contact.snapshot(), before);
                assert!(contact.contact_radius() > 0.9 * END, "{}", contact.contact_radius());
                return;
            }
            Err(other) => panic!("{other}"),
        }
    }
    panic!("never refused: a = {}", contact.contact_radius());
}

/// A contact that reaches a hollow only when it has worn, in cycles and in strokes.
#[test]
fn a_contact_that_grows_into_a_hollow_is_refused() {
    let hollow = |r: f64| if r > 2.45e-4 && r < 2.65e-4 { r * r / 0.02 - 3e-7 } else { r * r / 0.02 };
    let points = (0..=60).map(|k| f64::from(k) / 60.0 * 2.0 * END).map(|r| (r, hollow(r))).collect();
    let table = ProfileTable::new(points).unwrap();
    let edge = table.monotone_up_to();
    let parameters =
        Parameters { profile: Profile::Table(table), wear_coefficient: 0.03, ..Parameters::default() };
    let start = || {
        let mut contact = FrettingContact::new(parameters.clone()).unwrap();
        contact.start_at(40.0, 0.0).unwrap();
        assert!(contact.contact_radius() < edge);
        contact
    };
    let refused = |error: Error| matches!(error, Error::NonMonotoneImage { radius, .. } if radius == edge);
    let mut cycles = start();
    let before = cycles.snapshot();
    // by as many cycles as wear the hollow off on the way, too
    for count in [300.0, 3000.0, 1e4] {
        assert!(refused(cycles.advance_cycles(40.0, 5e-6, count).unwrap_err()), "{count} cycles");
    }
    assert_eq!(cycles.snapshot(), before);
    let mut strokes = start();
    let error =
        (0..20_000).find_map(|k| strokes.advance_to(40.0, if k % 2 == 0 { 5e-6 } else { -5e-6 }).err());
    assert!(error.is_some_and(refused));
}

/// Where a stroke is refused since the contact would grow beyond the table, less load can be taken:
/// on a line, behind a rig and in the plane.
#[test]
fn a_contact_at_the_end_of_its_table_can_be_unloaded() {
    for (rig, amplitude, y) in [(f64::INFINITY, 5e-6, 0.0), (3.5e7, 8e-6, 0.0), (f64::INFINITY, 5e-6, 1e-6)] {
        for swing in [0.0, 3.0] {
            let parameters = Parameters {
                profile: table(),
                wear_coefficient: 0.02,
                rig_stiffness: rig,
                ..Parameters::default()
            };
            let mut contact = FrettingContact::new(parameters).unwrap();
            contact.start_at(100.0, 0.0).unwrap();
            let to = |contact: &mut FrettingContact, force: f64, x: f64| {
                contact.advance_to_planar(force, [x, x.signum() * y])
            };
            let refused = (1..20_000).find_map(|k: u32| {
                let side = if k.is_multiple_of(2) { 1.0 } else { -1.0 };
                to(&mut contact, 100.0 + side * swing, side * amplitude).err()
            });
            assert!(matches!(refused, Some(Error::BeyondTable { .. })), "{rig} {y} {swing}: {refused:?}");
            to(&mut contact, 80.0, 0.0).unwrap_or_else(|error| panic!("{rig} {y} {swing}: {error}"));
            to(&mut contact, 80.0, amplitude).unwrap();
        }
    }
}
