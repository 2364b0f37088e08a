//! Sequences of calls on the C interface, beside the reference model of the tests. Any panic,
//! caught at the C interface or not, ends the run. Every million calls is reported.
#![no_main]

#[path = "../../tests/fmi/calls/mod.rs"]
mod calls;

use std::sync::atomic::{AtomicUsize, Ordering};

/// Calls so far.
static CALLS: AtomicUsize = AtomicUsize::new(0);

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let count = calls::run(bytes);
    let before = CALLS.fetch_add(count, Ordering::Relaxed);
    let millions = (before + count) / 1_000_000;
    if millions > before / 1_000_000 {
        eprintln!("{millions} million calls of the C interface");
    }
});
