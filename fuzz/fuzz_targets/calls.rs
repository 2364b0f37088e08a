//! Sequences of calls on the C interface, beside the reference model of the tests. Any panic,
//! caught at the C interface or not, ends the run.
#![no_main]

#[path = "../../tests/fmi/calls/mod.rs"]
mod calls;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| calls::run(bytes));
