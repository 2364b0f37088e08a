//! Profile files: each is refused, or is a body that can be pressed and moved.
#![no_main]

use fretting_contact::{
    Error, FrettingContact, LengthUnit, NormalControl, Parameters, Profile, ProfileTable,
};

/// A load in a few directions, with wear where `wears`.
fn press(table: ProfileTable, control: NormalControl, wears: bool) -> Result<(), Error> {
    let Parameters { wear_coefficient, .. } = Parameters::default();
    let mut contact = FrettingContact::new(Parameters {
        profile: Profile::Table(table),
        normal_control: control,
        resolution: 8,
        wear_coefficient: if wears { wear_coefficient } else { 0.0 },
        ..Parameters::default()
    })?;
    let load = if control == NormalControl::Force { 10.0 } else { 1e-6 };
    contact.start_at(load, 0.0)?;
    let lines = [(load, 1e-7), (0.5 * load, -1e-7), (2.0 * load, 1e-5), (-load, 0.0), (load, 0.0)];
    // far strokes take a worn table too long
    let count = if wears { 2 } else { lines.len() };
    for &(load, displacement) in &lines[..count] {
        contact.advance_to(load, displacement)?;
        let asked = if control == NormalControl::Force {
            contact.normal_reaction()
        } else {
            contact.indentation_depth()
        };
        assert!(wears || load < 0.0 || (asked - load).abs() <= 1e-6 * load, "{asked:e} instead of {load:e}");
        let radius = contact.contact_radius();
        let values = [
            contact.tangential_force(),
            contact.indentation_depth(),
            radius,
            contact.stick_radius(),
            contact.wear_volume(),
            contact.max_pressure(),
            contact.pressure_at(0.5 * radius),
            contact.shear_traction_at(0.9 * radius),
        ];
        assert!(values.iter().all(|value| !value.is_nan()), "{values:?}");
    }
    Ok(())
}

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let Ok(text) = core::str::from_utf8(bytes) else { return };
    let sum = bytes.iter().fold(0u8, |sum, byte| sum.wrapping_mul(31).wrapping_add(*byte));
    let unit = [LengthUnit::M, LengthUnit::M, LengthUnit::Mm, LengthUnit::Um][usize::from(sum % 4)];
    let Ok(table) = ProfileTable::parse_in(text, unit) else { return };
    // one in 64 wears, by a sum of the bytes, so that the fuzzer does not spend its time on the
    // slow ones; refusing a load is an answer, too
    let _ = press(table.clone(), NormalControl::Force, sum >> 2 == 0);
    let _ = press(table, NormalControl::Indentation, false);
});
