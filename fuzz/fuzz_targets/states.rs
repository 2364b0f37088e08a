//! Serialised states: whatever has a header that fits is refused, or can be used like any other
//! state.
#![no_main]

use core::ptr::{null, null_mut};
use fmi_sys::fmi2::{fmi2Component, fmi2FMUstate};
use fretting_contact::fmi2::GUID;
use fretting_contact::fmi2::exports::*;
use std::cell::RefCell;
use std::ffi::CString;

/// Magic number, version and GUID; length and checksum follow.
const FIXED: usize = 48;
/// Value references.
const OUTPUTS: [u32; 11] = [5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];
const RESOLUTION: [u32; 1] = [33];
/// More cells make a step too slow to fuzz.
const MOST_CELLS: i32 = 32;
/// Inputs after which a new instance is made.
const LIFE: usize = 1000;

/// An instance that takes the states, and the beginning of its own.
struct Host {
    component: fmi2Component,
    fixed: Vec<u8>,
    left: usize,
}

impl Drop for Host {
    fn drop(&mut self) {
        // SAFETY: the instance is not used again.
        unsafe { fmi2FreeInstance(self.component) }
    }
}

// SAFETY of every call below: the component is alive, results have room and arrays the lengths
// given.
impl Host {
    fn new() -> Self {
        let guid = CString::new(GUID).expect("no null");
        // SAFETY: strings end with a null character.
        unsafe {
            let component = fmi2Instantiate(c"states".as_ptr(), 1, guid.as_ptr(), null(), null(), 0, 0);
            let mut host = Self { component, fixed: Vec::new(), left: LIFE };
            host.fixed = host.saved();
            host.fixed.truncate(FIXED);
            host
        }
    }

    /// The present state, serialised.
    fn saved(&self) -> Vec<u8> {
        let (c, mut state, mut size) = (self.component, null_mut(), 0);
        // SAFETY: see above.
        unsafe {
            assert_eq!(fmi2GetFMUstate(c, &raw mut state), 0);
            assert_eq!(fmi2SerializedFMUstateSize(c, state, &raw mut size), 0);
            let mut bytes = vec![0u8; size];
            assert_eq!(fmi2SerializeFMUstate(c, state, bytes.as_mut_ptr().cast(), size), 0);
            assert_eq!(fmi2FreeFMUstate(c, &raw mut state), 0);
            bytes
        }
    }

    fn take(&mut self, content: &[u8]) {
        self.left -= 1;
        let mut bytes = self.fixed.clone();
        bytes.extend((content.len() as u64).to_le_bytes());
        bytes.extend(crc32fast::hash(content).to_le_bytes());
        bytes.extend(content);
        let (c, mut state) = (self.component, null_mut());
        // SAFETY: see above.
        unsafe {
            if fmi2DeSerializeFMUstate(c, bytes.as_ptr().cast(), bytes.len(), &raw mut state) == 0 {
                assert_eq!(fmi2SetFMUstate(c, state), 0, "what was taken can be used");
                // one in 16, by a sum of the bytes, so that the fuzzer does not spend its time on
                // slow steps
                let sum = content.iter().fold(0u8, |sum, byte| sum.wrapping_mul(31).wrapping_add(*byte));
                self.use_it(state, sum >> 4 == 0);
                assert_eq!(fmi2FreeFMUstate(c, &raw mut state), 0);
            }
        }
    }

    /// Reads, and steps and saves where it `moves`; back again, and the same bits.
    fn use_it(&self, state: fmi2FMUstate, moves: bool) {
        let (c, mut time, mut cells) = (self.component, 0.0, [0]);
        // SAFETY: see above.
        unsafe {
            if fmi2GetRealStatus(c, 2, &raw mut time) != 0 {
                // before or in the initialization, whose end may be refused
                let _ = (fmi2EnterInitializationMode(c), fmi2ExitInitializationMode(c));
                return;
            }
            let first = self.outputs();
            assert_eq!(fmi2GetInteger(c, RESOLUTION.as_ptr(), 1, cells.as_mut_ptr()), 0);
            if cells[0] <= MOST_CELLS && moves {
                // a step may be refused
                let _ = fmi2DoStep(c, time, 1e-3, 1);
                self.outputs();
                self.saved();
            }
            assert_eq!(fmi2SetFMUstate(c, state), 0);
            assert_eq!(self.outputs().map(f64::to_bits), first.map(f64::to_bits));
        }
    }

    fn outputs(&self) -> [f64; 11] {
        let mut values = [0.0; 11];
        // SAFETY: see above.
        assert_eq!(unsafe { fmi2GetReal(self.component, OUTPUTS.as_ptr(), 11, values.as_mut_ptr()) }, 0);
        assert!(values.iter().all(|value| !value.is_nan()), "{values:?}");
        values
    }
}

thread_local!(static HOST: RefCell<Host> = RefCell::new(Host::new()));

libfuzzer_sys::fuzz_target!(|content: &[u8]| {
    HOST.with_borrow_mut(|host| {
        if host.left == 0 {
            *host = Host::new();
        }
        host.take(content);
    });
});
