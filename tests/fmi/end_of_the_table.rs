//! A contact that grows by wear to the last point of its profile file.

use crate::host::{DISCARD, Fmu, OK};
use std::ffi::CString;

/// As a user of the FMU meets it: a parabola of 10 mm to r = 0.3 mm, 100 N, ±5 µm, 1e5 cycles.
#[test]
fn the_component_discards_the_step_with_the_radius() {
    let file = tempfile::NamedTempFile::new().unwrap();
    let radii = (0..=30).map(|k| f64::from(k) / 30.0 * 3e-4);
    let lines: String = radii.map(|r| format!("{r:e} {:e}\n", r * r / 0.02)).collect();
    std::fs::write(file.path(), lines).unwrap();
    let path = CString::new(file.path().to_str().unwrap()).unwrap();
    let fmu = Fmu::started(|fmu| {
        assert_eq!((fmu.set_integer("profile", 7), fmu.set_string("profile_file", &path)), (OK, OK));
        assert_eq!((fmu.set_integer("loading", 2), fmu.set_real("displacement_amplitude", 5e-6)), (OK, OK));
        assert_eq!(fmu.set_real("frequency", 1e5), OK);
    });
    let before = fmu.bits();
    assert_eq!(fmu.do_step(0.0, 1.0), DISCARD);
    let message = fmu.message();
    assert!(message.contains("r = 3.000000e-4 m") && message.contains("nothing has changed"), "{message}");
    assert_eq!((fmu.bits(), fmu.last_successful_time()), (before, 0.0));
    // a thousand cycles are not too many
    assert_eq!(fmu.set_real("frequency", 1e3), OK);
    assert_eq!(fmu.do_step(0.0, 1.0), OK);
}
