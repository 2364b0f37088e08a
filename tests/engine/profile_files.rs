//! Profile files as they should not be: each is refused with its place, or is a body that can be
//! pressed and moved.

use fretting_contact::{Error, FrettingContact, NormalControl, Parameters, Profile, ProfileTable};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

const FILES: [&str; 3] = [
    "# r f\n0 0\n1e-4 5e-7\n2e-4 2e-6\n4e-4 8e-6\n8e-4 3.2e-5\n1.6e-3 1.28e-4\n",
    "0,0\n1e-3;0\n2e-3\t1e-5\n3e-3 3e-5\n",
    "0 0\r\n0.0001 2e-6\r\n0.0002 4e-6 # a cone\r\n\r\n0.0004 8e-6\r\n0.003 6e-5",
];

/// What people, editors and disks do to a file.
fn spoil(text: &str, random: &mut StdRng) -> Vec<u8> {
    const STRANGE: [&str; 12] =
        ["nan", "inf", "-", "1e999", "1e-320", "0x1", ",", "\n", "\u{feff}", "1,5", "#", "\0"];
    let mut bytes = text.as_bytes().to_vec();
    for _ in 0..random.random_range(1..=4) {
        let place = random.random_range(0..bytes.len().max(1));
        match random.random_range(0..6) {
            0 if !bytes.is_empty() => bytes[place] ^= 1 << random.random_range(0..8),
            1 if !bytes.is_empty() => bytes[place] = b"0123456789.e-+ \n"[random.random_range(0..16)],
            2 => bytes.truncate(place),
            3 if !bytes.is_empty() => {
                bytes.remove(place);
            }
            4 => {
                let word = STRANGE[random.random_range(0..STRANGE.len())].as_bytes();
                bytes.splice(place.min(bytes.len())..place.min(bytes.len()), word.iter().copied());
            }
            _ => {
                let mut lines: Vec<&[u8]> = bytes.split(|byte| *byte == b'\n').collect();
                let (a, b) = (random.random_range(0..lines.len()), random.random_range(0..lines.len()));
                lines.swap(a, b);
                bytes = lines.join(&b'\n');
            }
        }
    }
    bytes
}

/// Some loads on a body of that profile; an error says why it cannot carry one.
fn press(table: ProfileTable, control: NormalControl) -> Result<(), Error> {
    let mut contact = FrettingContact::new(Parameters {
        profile: Profile::Table(table),
        normal_control: control,
        wear_coefficient: 0.0,
        ..Parameters::default()
    })?;
    let load = if control == NormalControl::Force { 1.0 } else { 1e-6 };
    contact.start_at(load, 0.0)?;
    for (load, displacement) in [(load, 1e-7), (2.0 * load, -1e-6), (0.5 * load, 0.0), (-load, 0.0)] {
        contact.advance_to(load, displacement)?;
        let carried = match control {
            NormalControl::Force => contact.normal_reaction(),
            NormalControl::Indentation => contact.indentation_depth(),
        };
        assert!(load < 0.0 || (carried - load).abs() <= 1e-9 * load, "{carried:e} instead of {load:e}");
        let bound = contact.parameters().friction_coefficient * contact.normal_reaction();
        assert!(contact.tangential_force().abs() <= bound * (1.0 + 1e-9), "friction is bounded");
        assert!(!(contact.max_pressure().is_nan() || contact.contact_radius().is_nan()));
    }
    Ok(())
}

#[test]
fn mutated_files_are_refused_or_usable() {
    let mut random = StdRng::seed_from_u64(5);
    let (mut refused, mut usable, mut unable) = (0, 0, 0);
    for round in 0..100_000 {
        let bytes = spoil(FILES[round % FILES.len()], &mut random);
        let parsed = match std::str::from_utf8(&bytes) {
            Ok(text) => ProfileTable::parse(text),
            Err(_) => continue, // refused as a file
        };
        match parsed {
            Err(Error::ProfileTable { place, problem }) => {
                assert!(!place.is_empty() && !problem.is_empty());
                refused += 1;
            }
            Err(other) => panic!("{round}: {other}"),
            Ok(table) => {
                for control in [NormalControl::Force, NormalControl::Indentation] {
                    match press(table.clone(), control) {
                        Ok(()) => usable += 1,
                        Err(_) => unable += 1,
                    }
                }
            }
        }
    }
    println!("{refused} refused, {usable} usable, {unable} cannot carry their load");
    assert!(refused > 20_000 && usable > 10_000 && unable > 100);
}
