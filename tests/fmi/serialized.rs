//! States as bytes: the same bits afterwards, in another instance, too; and no bytes that harm.

use crate::host::{ERROR, Fmu, OK};
use fretting_contact::fmi2::variables::variables;
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use std::{env, fs, process};

/// An instance in a random scene, ready for steps.
fn scene(random: &mut StdRng) -> Fmu {
    Fmu::started(|fmu| {
        let profile = random.random_range(1..=6);
        assert_eq!(fmu.set_integer("profile", profile), OK);
        // a sharp tip and a wide one make contacts of the same size
        assert_eq!(fmu.set_real("exponent", random.random_range(1.2..3.0)), OK);
        assert_eq!(fmu.set_integer("normal_control", random.random_range(1..=2)), OK);
        assert_eq!(fmu.set_integer("loading", random.random_range(1..=2)), OK);
        assert_eq!(fmu.set_integer("resolution", random.random_range(8..=24)), OK);
        let wear = [0.0, 3.2e-4, 1e-2][random.random_range(0..3)];
        assert_eq!(fmu.set_real("wear_coefficient", wear), OK);
    })
}

/// Some random steps from a time on; what can be read then.
fn run(fmu: &Fmu, random: &mut StdRng, start: f64) -> Vec<u64> {
    for k in 0..5 {
        let inputs = [
            ("normal_force", random.random_range(-10.0..100.0)),
            ("indentation", random.random_range(-1e-7..3e-6)),
            ("tangential_displacement", random.random_range(-3e-6..3e-6)),
            ("displacement_amplitude", random.random_range(0.0..2e-6)),
            ("frequency", random.random_range(0.0..20.0)),
        ];
        fmu.step_with(&inputs, start + f64::from(k), 1.0);
    }
    readings(fmu)
}

/// All outputs and some of the fields, bit for bit.
fn readings(fmu: &Fmu) -> Vec<u64> {
    let outputs = variables().iter().filter(|v| v.causality() == "output" && v.data_type.name() == "Real");
    let fields = ["worn_depth[12]", "worn_depth[40]", "pressure[30]", "shear_traction[50]", "image[45]"];
    outputs.map(|v| v.name).chain(fields).map(|name| fmu.real(name).to_bits()).collect()
}

/// A state as bytes, the seed of what follows, and what can be read after that.
type History = (Vec<u8>, u64, Vec<u64>);

/// Names the file with histories for [`histories_of_another_process_go_on_with_the_same_bits`].
const HISTORIES: &str = "FRETTING_TEST_HISTORIES";

#[test]
fn a_state_goes_on_with_the_same_bits_wherever_it_is() {
    let mut random = StdRng::seed_from_u64(7);
    let mut histories: Vec<History> = Vec::new();
    for history in 0..1000 {
        let fmu = scene(&mut random);
        run(&fmu, &mut random, 0.0);
        let seed = random.random();
        let again = |fmu: &Fmu| run(fmu, &mut StdRng::seed_from_u64(seed), 5.0);
        let saved = fmu.save();
        let bytes = fmu.serialized(saved);
        let first = again(&fmu);
        assert_eq!(fmu.restore(saved), OK);
        assert_eq!(again(&fmu), first, "{history}: rolled back");
        // into an instance of any other scene, or one that has just been made
        let other = if history % 2 == 0 { scene(&mut random) } else { Fmu::new() };
        let (state, status) = other.deserialized(&bytes);
        assert_eq!(status, OK, "{history}: {:?}", other.messages());
        assert_eq!(other.restore(state), OK);
        assert_eq!(other.serialized(state), bytes, "{history}: the same bytes");
        assert_eq!(again(&other), first, "{history}: in another instance");
        histories.push((bytes, seed, first));
    }
    let file = tempfile::NamedTempFile::new().unwrap();
    fs::write(file.path(), serde_json::to_vec(&histories).unwrap()).unwrap();
    let child = process::Command::new(env::current_exe().unwrap())
        .args(["--exact", "serialized::histories_of_another_process_go_on_with_the_same_bits", "--ignored"])
        .env(HISTORIES, file.path())
        .output()
        .unwrap();
    let text = String::from_utf8_lossy(&child.stdout);
    assert!(child.status.success() && text.contains("1 passed"), "{text}");
}

#[test]
#[ignore = "the test above runs it, in a process of its own"]
fn histories_of_another_process_go_on_with_the_same_bits() {
    let file = env::var_os(HISTORIES).expect("the test above names the file");
    let histories: Vec<History> = serde_json::from_slice(&fs::read(file).unwrap()).unwrap();
    assert_eq!(histories.len(), 1000);
    for (bytes, seed, expected) in histories {
        let fmu = Fmu::new();
        let (state, status) = fmu.deserialized(&bytes);
        assert_eq!((status, fmu.restore(state)), (OK, OK), "{:?}", fmu.messages());
        assert_eq!(run(&fmu, &mut StdRng::seed_from_u64(seed), 5.0), expected);
    }
}

#[test]
fn a_state_of_any_part_of_a_life_can_be_serialised() {
    let fmu = Fmu::new();
    assert_eq!(fmu.set_real("radius", 0.02), OK);
    let mut states = vec![fmu.save()];
    assert_eq!(fmu.setup(1.0, Some(2.0)), OK);
    assert_eq!(fmu.enter_initialization(), OK);
    states.push(fmu.save());
    fmu.real("contact_radius");
    states.push(fmu.save());
    assert_eq!(fmu.exit_initialization(), OK);
    states.push(fmu.save());
    assert_eq!(fmu.set_slope("tangential_displacement", 1, 1e-6), OK);
    fmu.step_with(&[], 1.0, 1.0);
    states.push(fmu.save());
    assert_eq!(fmu.terminate(), OK);
    states.push(fmu.save());
    for (k, state) in states.into_iter().enumerate() {
        let other = Fmu::new();
        let (copy, status) = other.deserialized(&fmu.serialized(state));
        assert_eq!(status, OK, "{k}: {:?}", other.messages());
        assert_eq!(other.restore(copy), OK);
        if k < 3 {
            if k == 0 {
                assert_eq!(other.enter_initialization(), OK);
            }
            assert_eq!(other.exit_initialization(), OK);
        }
        assert_eq!(other.real("radius"), 0.02);
        // the stop time was that of the experiment before
        if k == 3 {
            assert_eq!(other.do_step(1.0, 2.0), OK);
        }
    }
}

/// A run that has come to its stop time goes on in an instance with a later one, or with none; the
/// stop time that holds is that of the instance.
#[test]
fn a_finished_run_goes_on_to_a_later_stop_time() {
    let ready = |stop: Option<f64>| {
        let fmu = Fmu::new();
        assert_eq!(
            (fmu.setup(0.0, stop), fmu.enter_initialization(), fmu.exit_initialization()),
            (OK, OK, OK)
        );
        fmu
    };
    let go_on = |fmu: &Fmu| {
        for (k, displacement) in [-2e-6, 3e-6].into_iter().enumerate() {
            fmu.step_with(&[("tangential_displacement", displacement)], 1.0 + k as f64, 1.0);
        }
        fmu.bits()
    };
    let first = ready(Some(1.0));
    first.step_with(&[("tangential_displacement", 2e-6)], 0.0, 1.0);
    first.refused(first.do_step(1.0, 1.0), &["stop time 1.0"]);
    let saved = first.save();
    let bytes = first.serialized(saved);
    let whole = ready(None);
    whole.step_with(&[("tangential_displacement", 2e-6)], 0.0, 1.0);
    let expected = go_on(&whole);
    for fmu in [ready(Some(3.0)), ready(None), Fmu::new()] {
        let (state, status) = fmu.deserialized(&bytes);
        assert_eq!((status, fmu.restore(state)), (OK, OK), "{:?}", fmu.messages());
        assert_eq!(go_on(&fmu), expected);
    }
    let short = ready(Some(1.5));
    let (state, _) = short.deserialized(&bytes);
    assert_eq!(short.restore(state), OK);
    short.refused(short.do_step(1.0, 1.0), &["stop time 1.5"]);
    assert_eq!(short.do_step(1.0, 0.5), OK);
    // in the same instance, after a reset, and after an end in good order
    assert_eq!((first.terminate(), first.reset()), (OK, OK));
    assert_eq!((first.setup(0.0, Some(3.0)), first.restore(saved)), (OK, OK));
    assert_eq!(go_on(&first), expected);
}

#[test]
fn wrong_sizes_and_handles_are_refused() {
    let (fmu, other) = (Fmu::started(|_| {}), Fmu::started(|_| {}));
    let (saved, foreign) = (fmu.save(), other.save());
    let bytes = fmu.serialized(saved);
    let mut place = vec![7u8; bytes.len() + 1];
    for size in [0, bytes.len() - 1, bytes.len() + 1] {
        // SAFETY: there is room for that many bytes.
        #[allow(unsafe_code)]
        let status = unsafe {
            fretting_contact::fmi2::exports::fmi2SerializeFMUstate(
                fmu.component,
                saved,
                place.as_mut_ptr().cast(),
                size,
            )
        };
        fmu.refused(status, &[&format!("size = {size}"), &bytes.len().to_string()]);
    }
    assert!(place.iter().all(|byte| *byte == 7), "nothing was written");
    let mut size = 0;
    // SAFETY: the handle is never followed.
    #[allow(unsafe_code)]
    let status = unsafe {
        fretting_contact::fmi2::exports::fmi2SerializedFMUstateSize(fmu.component, foreign, &raw mut size)
    };
    fmu.refused(status, &["does not belong to this instance"]);
}

/// A state in partial slip with a worn profile and wear that is pending.
fn rich(fmu: &Fmu) -> Vec<u8> {
    for (k, displacement) in [1e-6, -1.2e-6, 2e-6, -3e-6, 0.5e-6, 1e-6].into_iter().enumerate() {
        fmu.step_with(
            &[("tangential_displacement", displacement), ("normal_force", 100.0 - 5.0 * k as f64)],
            k as f64,
            1.0,
        );
    }
    fmu.serialized(fmu.save())
}

#[test]
fn bytes_that_have_changed_are_refused() {
    let fmu = Fmu::started(|fmu| assert_eq!(fmu.set_real("wear_coefficient", 0.03), OK));
    let bytes = rich(&fmu);
    let refused = |bytes: &[u8], what: &str| {
        let (_, status) = fmu.deserialized(bytes);
        fmu.refused(status, &["serialised state is refused"]);
        assert_eq!(status, ERROR, "{what}");
    };
    for length in 0..bytes.len() {
        refused(&bytes[..length], &format!("cut to {length}"));
    }
    for place in 0..bytes.len() {
        let mut changed = bytes.clone();
        changed[place] ^= 1 << (place % 8);
        refused(&changed, &format!("byte {place}"));
    }
    refused(&[&bytes[..], &[0]].concat(), "longer");
    assert_eq!(fmu.deserialized(&bytes).1, OK);
}

/// Length of the header; the checksum is its end.
const HEADER: usize = 60;

/// Mutations whose checksum fits: each is refused, or a state that can be used without harm.
#[test]
fn mutated_states_are_refused_or_usable() {
    let source = || {
        Fmu::started(|fmu| {
            assert_eq!(fmu.set_integer("resolution", 8), OK);
            assert_eq!(fmu.set_real("wear_coefficient", 0.03), OK);
        })
    };
    mutate(&rich(&source()), 100_000);
    let plane = source();
    rich(&plane);
    plane.step_with(&[("tangential_displacement_y", 0.5e-6)], 6.0, 1.0);
    mutate(&plane.serialized(plane.save()), 30_000);
}

fn mutate(bytes: &[u8], rounds: u32) {
    let mut random = StdRng::seed_from_u64(11);
    let (mut accepted, mut refused) = (0, 0);
    let mut fmu = Fmu::new();
    for round in 0..rounds {
        if round % 1000 == 0 {
            fmu = Fmu::new();
        }
        let mut changed = bytes.to_vec();
        for _ in 0..random.random_range(1..=3) {
            let place = random.random_range(HEADER..changed.len());
            match random.random_range(0..4) {
                0 => changed[place] = random.random(),
                1 => changed[place] ^= 1 << random.random_range(0..8),
                2 => changed.truncate(place),
                _ => changed.insert(place, random.random()),
            }
            if changed.len() <= HEADER {
                break;
            }
        }
        let length = changed.len() as u64 - HEADER as u64;
        changed[HEADER - 12..HEADER - 4].copy_from_slice(&length.to_le_bytes());
        let checksum = crc32fast::hash(&changed[HEADER..]).to_le_bytes();
        changed[HEADER - 4..HEADER].copy_from_slice(&checksum);
        let (mut state, status) = fmu.deserialized(&changed);
        if status != OK {
            refused += 1;
            assert_eq!(status, ERROR);
            let message = fmu.message();
            assert!(!message.contains("internal failure"), "{round}: {message}");
            continue;
        }
        accepted += 1;
        assert_eq!(fmu.restore(state), OK);
        let mut time = [0.0];
        // SAFETY: there is room for the time.
        #[allow(unsafe_code)]
        let status = unsafe {
            fretting_contact::fmi2::exports::fmi2GetRealStatus(fmu.component, 2, time.as_mut_ptr())
        };
        if status == OK && fmu.do_step(time[0], 0.5) == OK {
            let force = fmu.real("tangential_force");
            assert!(force.is_finite() && fmu.real("wear_volume").is_finite(), "{round}: {force}");
        }
        let messages = fmu.messages();
        assert!(!messages.iter().any(|text| text.contains("internal failure")), "{round}: {messages:?}");
        assert_eq!(fmu.free_saved(&mut state), OK);
    }
    println!("{accepted} accepted, {refused} refused");
    assert!(accepted > 100 && refused > 10_000, "{accepted} accepted, {refused} refused");
}
