//! Creation: what is refused, what is tolerated, and how messages reach the importer.
#![allow(unsafe_code, reason = "the C interface is what is tested")]

use crate::host::{ERROR, Fmu, OK, callbacks, messages_of};
use core::ffi::{CStr, c_char};
use core::ptr::null;
use fmi_sys::fmi2::{fmi2CallbackFunctions, fmi2Component};
use fretting_contact::fmi2::GUID;
use fretting_contact::fmi2::exports::*;
use std::ffi::CString;

/// fmi2Instantiate with callbacks that are overwritten and gone when it returns.
fn instantiate(name: *const c_char, kind: u32, guid: *const c_char, logging_on: i32) -> fmi2Component {
    let mut functions = Box::new(callbacks());
    // SAFETY: every string is null or ends with a null character, and the callbacks are alive
    // during the call.
    let component =
        unsafe { fmi2Instantiate(name, kind, guid, null(), &raw const *functions, 0, logging_on) };
    functions.logger = None;
    component
}

fn guid() -> CString {
    CString::new(GUID).unwrap()
}

#[test]
fn refusals_return_null_and_say_why() {
    let guid = guid();
    let model_exchange = instantiate(c"a".as_ptr(), 0, guid.as_ptr(), 0);
    let foreign = instantiate(c"b".as_ptr(), 1, c"{0000-%s}".as_ptr(), 0);
    let without = instantiate(c"c".as_ptr(), 1, null(), 0);
    assert!([model_exchange, foreign, without].iter().all(|component| component.is_null()));
    let one = |name| {
        let messages = messages_of(name);
        assert_eq!(messages.len(), 1, "{messages:?}");
        messages[0].clone()
    };
    assert!(one("a").contains("fmuType = 0 is refused"));
    let message = one("b");
    assert!(message.contains("fmuGUID = {0000-%s}") && message.contains(GUID), "{message}");
    assert!(one("c").contains("fmuGUID is a null pointer"));

    for name in [null(), c"".as_ptr()] {
        assert!(instantiate(name, 1, guid.as_ptr(), 0).is_null());
        assert!(one("FrettingContact").contains("instanceName is null or empty"));
    }
}

#[test]
fn the_callbacks_are_copied() {
    let component = instantiate(c"copied".as_ptr(), 1, guid().as_ptr(), 0);
    // SAFETY: the instance is alive until it is freed.
    unsafe {
        assert_eq!(fmi2DoStep(component, 0.0, 0.1, 1), ERROR);
        assert_eq!(messages_of("copied").len(), 1);
        fmi2FreeInstance(component);
    }
}

#[test]
fn events_are_logged_under_logging_only() {
    let component = instantiate(c"events".as_ptr(), 1, guid().as_ptr(), 1);
    // SAFETY: the instance is alive until it is freed.
    unsafe {
        assert_eq!(fmi2EnterInitializationMode(component), OK);
        assert_eq!(fmi2ExitInitializationMode(component), OK);
        let messages = messages_of("events");
        assert_eq!(messages.len(), 2, "{messages:?}");
        assert!(
            messages[0].contains("is instantiated") && messages[1].contains("E* = 1.153"),
            "{messages:?}"
        );
        assert_eq!(fmi2SetDebugLogging(component, 0, 0, null()), OK);
        assert_eq!(fmi2Terminate(component), OK);
        assert_eq!(messages_of("events"), Vec::<String>::new());
        assert_eq!(fmi2SetDebugLogging(component, 1, 1, [c"logEverything".as_ptr()].as_ptr()), ERROR);
        assert!(messages_of("events")[0].contains("logEverything"));
        assert_eq!(fmi2SetDebugLogging(component, 1, 1, [null()].as_ptr()), ERROR);
        assert!(messages_of("events")[0].contains("categories is a null pointer"));
        fmi2FreeInstance(component);
    }
}

#[test]
fn no_logger_and_no_callbacks_are_tolerated() {
    let (guid, silent) = (guid(), fmi2CallbackFunctions { logger: None, ..callbacks() });
    for functions in [null(), &raw const silent] {
        // SAFETY: the strings are alive; the callbacks are null or alive; the instance is freed
        // last.
        unsafe {
            let none = fmi2Instantiate(c"silent".as_ptr(), 0, guid.as_ptr(), null(), functions, 0, 1);
            assert!(none.is_null());
            let component = fmi2Instantiate(c"silent".as_ptr(), 1, guid.as_ptr(), null(), functions, 0, 1);
            assert_eq!(fmi2DoStep(component, 0.0, 0.1, 1), ERROR);
            assert_eq!(fmi2EnterInitializationMode(component), OK);
            fmi2FreeInstance(component);
        }
    }
}

#[test]
fn a_profile_is_found_in_the_resources() {
    let folder = tempfile::tempdir().unwrap();
    let resources = folder.path().join("with blank and {braces}");
    std::fs::create_dir(&resources).unwrap();
    std::fs::write(resources.join("tip.txt"), "0 0\n1e-4 5e-7\n2e-4 2e-6\n4e-4 8e-6\n").unwrap();
    let plain = format!("file://{}", resources.display());
    let escaped = plain.replace(' ', "%20").replace('{', "%7B").replace('}', "%7D");
    for uri in [plain.replace("file://", "file:"), plain, escaped] {
        let fmu = Fmu::with_resources(Some(&CString::new(uri).unwrap()));
        assert_eq!(fmu.set_integer("profile", 7), OK);
        assert_eq!(fmu.set_string("profile_file", c"tip.txt"), OK);
        fmu.initialize();
        assert_eq!(fmu.get_string("profile_file"), "tip.txt");
        assert!(fmu.real("contact_radius") > 1e-4);
    }
}

/// One sphere in three units, as files of instruments: the same contact; a height on the axis is
/// reported.
#[test]
fn a_profile_file_in_other_units_is_the_same_body() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("tip.txt");
    let name = CString::new(file.to_str().unwrap()).unwrap();
    for (unit, text, reported) in [
        (1, "0 0\n1e-4 5e-7\n2e-4 2e-6\n4e-4 8e-6\n".as_bytes(), false),
        (2, b"\xef\xbb\xbfRadius;H\xf6he\r\n0,4;0,008\r\n0,2;0,002\r\n0,1;0,0005\r\n0;0\r\n", false),
        (3, b"r\tf\n0\t1,5\n100\t2,0\n200\t3,5\n400\t9,5\n", true),
    ] {
        std::fs::write(&file, text).unwrap();
        let fmu = Fmu::new();
        assert_eq!((fmu.set_integer("profile", 7), fmu.set_integer("profile_unit", unit)), (OK, OK));
        assert_eq!(fmu.set_string("profile_file", &name), OK);
        // SAFETY: the instance lives; no category is asked for, which means all.
        assert_eq!(unsafe { fmi2SetDebugLogging(fmu.component, 1, 0, null()) }, OK);
        fmu.initialize();
        let expected = 186.626e-6; // coarsely sampled
        assert!((fmu.real("contact_radius") / expected - 1.0).abs() < 0.02, "{}", fmu.real("contact_radius"));
        let messages = fmu.messages();
        let said = messages.iter().any(|text| text.contains("f(0) = 1.5e-6 m, which is subtracted"));
        assert_eq!(said, reported, "{messages:?}");
    }
}

/// Needed by a table only: reported under logging, not refused.
#[test]
fn a_resource_location_that_is_no_folder_is_reported() {
    let (guid, functions) = (guid(), callbacks());
    for (logging_on, expected) in [(1, 1), (0, 0)] {
        // SAFETY: the strings and callbacks are alive; the instance is freed last.
        unsafe {
            let uri = c"http://example.org/resources".as_ptr();
            let component = fmi2Instantiate(
                c"elsewhere".as_ptr(),
                1,
                guid.as_ptr(),
                uri,
                &raw const functions,
                0,
                logging_on,
            );
            let messages = messages_of("elsewhere");
            let count = messages
                .iter()
                .filter(|text| text.contains("http://example.org/resources is no folder"))
                .count();
            assert_eq!(count, expected, "{messages:?}");
            assert_eq!(fmi2EnterInitializationMode(component), OK);
            fmi2FreeInstance(component);
        }
    }
}

#[test]
fn versions() {
    // SAFETY: the functions return strings that live for ever.
    let text = |pointer| unsafe { CStr::from_ptr(pointer) };
    assert_eq!(text(fmi2GetVersion()), c"2.0");
    assert_eq!(text(fmi2GetTypesPlatform()), c"default");
}
