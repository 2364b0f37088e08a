//! Step control: communication points and stop times that are right up to rounding, steps of no
//! length, steps that are discarded and repeated.

use crate::host::{DISCARD, ERROR, Fmu, OK};
use std::ffi::CString;

const X: &str = "tangential_displacement";

/// An experiment from `start` to `stop`, initialized after `set`.
fn experiment(start: f64, stop: f64, set: impl FnOnce(&Fmu)) -> Fmu {
    let fmu = Fmu::new();
    set(&fmu);
    assert_eq!(fmu.setup(start, Some(stop)), OK);
    assert_eq!((fmu.enter_initialization(), fmu.exit_initialization()), (OK, OK));
    fmu
}

fn cyclic(fmu: &Fmu) {
    assert_eq!(fmu.set_integer("loading", 2), OK);
    assert_eq!((fmu.set_real("frequency", 50.0), fmu.set_real("displacement_amplitude", 1.5e-6)), (OK, OK));
}

/// 0.1 k and sums of 0.1, which drift apart in the last digits: the time is that of the master, and
/// the contact, which knows nothing of it, gives the same bits.
#[test]
fn products_and_sums_are_the_same_communication_points() {
    for (start, set) in [(0.0, cyclic as fn(&Fmu)), (0.0, |_| {}), (1e6, |_| {}), (-50.0, cyclic)] {
        let (products, sums) = (experiment(start, start + 30.0, set), experiment(start, start + 30.0, set));
        let (mut sum, mut apart) = (start, 0);
        for k in 0..300 {
            let product = 0.1f64.mul_add(f64::from(k), start);
            let name = if products.integer("loading") == 1 { X } else { "normal_force" };
            let value = if name == X { 2e-6 * (0.1 * f64::from(k)).sin() } else { 100.0 };
            products.step_with(&[(name, value)], product, 0.1);
            sums.step_with(&[(name, value)], sum, 0.1);
            assert_eq!(products.last_successful_time(), product + 0.1);
            sum += 0.1;
            assert_eq!(sums.last_successful_time(), sum);
            apart += i32::from(product + 0.1 != sum);
        }
        assert!(apart > 100, "{apart} of 300 points differ");
        assert_eq!(products.bits(), sums.bits());
        // a master may also change from one to the other
        sums.step_with(&[("normal_force", 90.0)], start + 30.0, 0.0);
        // but not be wrong by a tenth of a step
        sums.refused(sums.do_step(start + 29.99, 0.0), &["currentCommunicationPoint", "ended at"]);
    }
}

/// Neighbours of the stop time are the stop time; a step that passes it in earnest is refused and
/// does nothing.
#[test]
fn a_step_may_end_an_ulp_beyond_the_stop_time() {
    for (start, stop) in [(0.0f64, 0.3f64), (-0.3, 0.0), (1e3, 1e3 + 0.3), (5e8, 5e8 + 1.0)] {
        let way = stop - start;
        for beyond in [stop.next_down(), stop, stop.next_up(), stop.next_up().next_up()] {
            let fmu = experiment(start, stop, |_| {});
            fmu.step_with(&[(X, 1e-6)], start, 0.5 * way);
            let middle = start + 0.5 * way;
            // the step that comes out there, as far as a sum can
            fmu.step_with(&[(X, 2e-6)], middle, beyond - middle);
            let (end, expected) = (fmu.last_successful_time(), fmu.bits());
            assert_eq!(end, middle + (beyond - middle));
            assert!((end - stop).abs() <= 4.0 * (stop.next_up() - stop).max(way * f64::EPSILON));
            // the rest that rounding leaves, if any, and nothing at all
            fmu.step_with(&[], end, f64::max(stop - end, 0.0));
            fmu.step_with(&[], stop, 0.0);
            assert_eq!(fmu.bits(), expected);
            if start < 1e8 {
                fmu.refused(fmu.do_step(stop, 0.01 * way), &["passes the stop time"]);
            } else {
                // 1e-9 of the time is half a second here
                fmu.refused(fmu.do_step(stop, way), &["passes the stop time"]);
            }
            assert_eq!((fmu.bits(), fmu.last_successful_time()), (expected, stop));
            assert_eq!(fmu.terminate(), OK);
        }
    }
    // three tenths end beyond 0.3; ten tenths end before 1
    for (stop, count) in [(0.3, 3), (1.0, 10)] {
        let fmu = experiment(0.0, stop, |_| {});
        for _ in 0..count {
            fmu.step_with(&[(X, 1e-6)], fmu.last_successful_time(), 0.1);
        }
        assert_ne!(fmu.last_successful_time(), stop);
        fmu.refused(fmu.do_step(fmu.last_successful_time(), 0.1), &["passes the stop time"]);
    }
}

/// At the start, between steps and at the stop time. They count no cycles, take inputs over, and
/// use up slopes, which move nothing in no time.
#[test]
fn steps_of_no_length_may_stand_anywhere() {
    for (name, set) in [("strokes", (|_| {}) as fn(&Fmu)), ("cycles", cyclic)] {
        let (fmu, plain) = (experiment(0.0, 1.0, set), experiment(0.0, 1.0, set));
        let inputs = [("normal_force", 120.0), (X, 1.5e-6)];
        let inputs = &inputs[..if name == "cycles" { 1 } else { 2 }];
        for (point, length) in [(0.0, 0.25), (0.25, 0.75)] {
            let before = fmu.bits();
            assert_eq!((fmu.set_slope(X, 1, 1.0), fmu.set_slope("frequency", 1, 1e9)), (OK, OK));
            assert_eq!(fmu.do_step(point, 0.0), OK);
            assert_eq!(fmu.last_successful_time(), point);
            if name == "cycles" && point == 0.0 {
                // the amplitude has been an input from the start and is taken over now: Mindlin's
                // force, and no cycle
                let force = 60.0 * (1.0 - (1.0f64 - 1.5e-6 / 2.537_551e-6).powf(1.5));
                assert!((fmu.real("tangential_force") / force - 1.0).abs() < 1e-6);
                assert_eq!((fmu.real("wear_volume"), fmu.real("dissipated_energy")), (0.0, 0.0));
            } else {
                assert_eq!(fmu.bits(), before, "{name}");
            }
            for instance in [&fmu, &plain] {
                instance.step_with(inputs, point, length);
            }
            assert_eq!(fmu.bits(), plain.bits(), "{name}: the slopes have been used up");
        }
        // at the stop time new inputs are taken over; no cycles, no wear, but springs slip as the
        // load falls
        let worn = fmu.real("wear_volume");
        fmu.step_with(&[("normal_force", 80.0)], 1.0, 0.0);
        assert_eq!((fmu.real("normal_reaction"), fmu.last_successful_time()), (80.0, 1.0), "{name}");
        assert_eq!(fmu.real("wear_volume") == worn, name == "cycles", "{name}");
        // in no time there are no rates
        for output in ["normal_reaction", "tangential_force", "wear_volume", "dissipated_energy"] {
            assert_eq!(fmu.output_slope(output, 1), (0.0, OK), "{name}, {output}");
        }
        fmu.refused(fmu.do_step(1.0, 1e-3), &["stop time 1.0"]);
    }
}

/// A load that rises beyond the profile's table: a master halves its step until it comes through,
/// and goes on as one that knew the right step from the start.
#[test]
fn a_discarded_step_is_repeated_with_a_shorter_one() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("tip.txt");
    std::fs::write(&file, "0 0\n5e-5 1.25e-7\n1e-4 5e-7\n1.5e-4 1.125e-6\n2e-4 2e-6\n").unwrap();
    let path = CString::new(file.to_str().unwrap()).unwrap();
    for (name, loading) in [("strokes", 1), ("cycles", 2)] {
        let tip = |fmu: &Fmu| {
            assert_eq!((fmu.set_integer("profile", 7), fmu.set_string("profile_file", &path)), (OK, OK));
            assert_eq!(
                (fmu.set_integer("loading", loading), fmu.set_real("wear_coefficient", 0.01)),
                (OK, OK)
            );
            assert_eq!((fmu.set_real("frequency", 20.0), fmu.set_real("normal_force", 50.0)), (OK, OK));
            if loading == 2 {
                assert_eq!(fmu.set_real("displacement_amplitude", 2e-6), OK);
            }
        };
        let (trying, knowing) = (experiment(0.0, 2.0, tip), experiment(0.0, 2.0, tip));
        let way = |x: f64| if loading == 1 { (X, x) } else { ("displacement_amplitude", 2e-6) };
        // some wear that has not all been taken off the profile yet
        for fmu in [&trying, &knowing] {
            for (k, displacement) in [3e-6, -3e-6, 2e-6].into_iter().enumerate() {
                fmu.step_with(&[way(displacement)], 0.25 * k as f64, 0.25);
            }
            let (name, value) = way(-3e-6);
            assert_eq!((fmu.set_slope("normal_force", 1, 1e3), fmu.set_real(name, value)), (OK, OK));
        }
        let before = trying.bits();
        let (mut length, mut discarded) = (1.0, 0);
        while trying.do_step(0.75, length) == DISCARD {
            let message = trying.message();
            assert!(message.contains("beyond the last point") && message.contains("nothing has changed"));
            assert_eq!((trying.bits() == before, trying.last_successful_time()), (true, 0.75), "{name}");
            assert_eq!(trying.step_status(), DISCARD);
            length *= 0.5;
            discarded += 1;
        }
        assert!(discarded > 2 && trying.step_status() == OK, "{name}: {discarded}");
        assert_eq!(knowing.do_step(0.75, length), OK);
        assert_eq!(
            (trying.last_successful_time(), trying.real("normal_force")),
            (0.75 + length, 50.0 + 1e3 * length)
        );
        for fmu in [&trying, &knowing] {
            fmu.step_with(&[way(3e-6), ("normal_force", 60.0)], 0.75 + length, 0.1);
            fmu.step_with(&[way(-1e-6)], 0.85 + length, 0.1);
        }
        assert_eq!(trying.bits(), knowing.bits(), "{name}");
        assert_ne!(trying.bits(), before);
    }
}

/// Clocks that are rounded to single precision or to nanoseconds, from the first step to the last.
#[test]
fn rounded_clocks_are_the_same_communication_points() {
    let single: fn(f64) -> f64 = |time| f64::from(time as f32);
    let nanoseconds: fn(f64) -> f64 = |time| (time * 1e9).round() * 1e-9;
    let microseconds: fn(f64) -> f64 = |time| (time * 1e6).round() * 1e-6;
    for (round, length, count) in [
        (single, 1e-3, 16_000),
        (single, 1e-3 / 3.0, 3_000),
        (single, 0.1, 3_000),
        (nanoseconds, 1e-3 / 3.0, 3_000),
        (nanoseconds, 1e-6, 3_000),
        (microseconds, 1e-2 / 3.0, 3_000),
    ] {
        let stop = f64::from(count) * length;
        let set = |fmu: &Fmu| {
            cyclic(fmu);
            assert_eq!(fmu.set_real("wear_coefficient", 0.0), OK);
        };
        let (rounded, exact) = (experiment(0.0, round(stop), set), experiment(0.0, stop, set));
        for k in 0..count {
            for (fmu, point) in [(&rounded, round(f64::from(k) * length)), (&exact, f64::from(k) * length)] {
                assert_eq!(fmu.do_step(point, length), OK, "{k} of {length}: {:?}", fmu.messages());
            }
        }
        assert_eq!(rounded.bits(), exact.bits());
        // without wear the work per area is not known
        assert!(rounded.message().contains("energy_density"));
        assert!(exact.real("dissipated_energy") > 0.0);
        // what is no rounding: a step that is repeated, left out or off by a hundredth
        let last = f64::from(count) * length;
        for point in [last - length, last + length, last - 0.01 * length, last + 0.01 * length] {
            rounded.refused(rounded.do_step(point, 0.0), &["currentCommunicationPoint"]);
        }
    }
}

/// Some masters repeat a discarded step without end. The same step with nothing changed is an
/// error; the instance stays as it is.
#[test]
fn a_discarded_step_that_is_repeated_unchanged_is_an_error() {
    let fmu = Fmu::started(|_| {});
    fmu.step_with(&[(X, 1e-6)], 0.0, 1.0);
    let before = fmu.bits();
    let discarded = || {
        let status = fmu.do_step(1.0, 1.0);
        let message = fmu.message();
        assert!(status == DISCARD && message.contains("1e60 at most"), "{message}");
        assert_eq!(fmu.step_status(), DISCARD);
    };
    let repeated = || {
        fmu.refused(fmu.do_step(1.0, 1.0), &["asked for again", "1e60 at most", "change the inputs"]);
        assert_eq!((fmu.step_status(), fmu.last_successful_time()), (ERROR, 1.0));
        assert_eq!(fmu.bits(), before);
    };
    // far beyond all ranges
    assert_eq!(fmu.set_real("normal_force", 1e121), OK);
    discarded();
    repeated();
    repeated();
    // reading changes nothing, nor does the same value set again
    assert_eq!(fmu.real("normal_force"), 1e121);
    assert_eq!(fmu.set_real("normal_force", 1e121), OK);
    repeated();
    // a wrong call in between neither
    fmu.refused(fmu.do_step(5.0, 1.0), &["currentCommunicationPoint"]);
    repeated();
    // other inputs, a tunable parameter, a derivative, another step size, a state put back: each is
    // a new attempt
    assert_eq!(fmu.set_real("normal_force", 1e122), OK);
    discarded();
    assert_eq!(fmu.set_real("wear_coefficient", 1e-4), OK);
    discarded();
    assert_eq!(fmu.set_slope(X, 1, 1e-6), OK);
    discarded();
    repeated();
    assert_eq!(fmu.do_step(1.0, 0.5), DISCARD);
    fmu.message();
    discarded();
    let saved = fmu.save();
    assert_eq!(fmu.restore(saved), OK);
    discarded();
    repeated();
    // and the run goes on
    assert_eq!(fmu.set_slope(X, 1, 0.0), OK);
    fmu.step_with(&[("normal_force", 100.0), (X, 2e-6)], 1.0, 1.0);
    fmu.step_with(&[(X, 0.0)], 2.0, 1.0);
    assert_eq!((fmu.terminate(), fmu.last_successful_time()), (OK, 3.0));
    // an error ends nothing but the attempt: a reset makes a new run
    assert_eq!((fmu.reset(), fmu.set_real("normal_force", 100.0)), (OK, OK));
    fmu.initialize();
    fmu.step_with(&[(X, 1e-6)], 0.0, 1.0);
}
