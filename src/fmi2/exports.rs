//! The C functions of FMI 2.0 for co-simulation, and none of model exchange.
//!
//! Each takes its arguments over and hands them to the instance, inside one guard. Their meaning is
//! that of the standard; where it leaves a choice, see [`crate::fmi2`].
//!
//! # What every function relies on
//! An importer promises, as the standard demands:
//! - a component is null or comes from [`fmi2Instantiate`], has not been freed, and serves one call
//!   at a time;
//! - an array argument is null or has as many elements as its length says; strings end with a null
//!   character;
//! - what a function fills is not used by anyone else meanwhile.
//!
//! Null pointers are refused where a value is needed. The signatures are checked against the
//! standard's header when this is compiled.

mod common;
mod state;
mod stepping;
mod values;

pub use common::*;
pub use state::*;
pub use stepping::*;
pub use values::*;

/// Fails to compile where a function does not have its type of the standard's header.
macro_rules! conforming {
    ($($function:ident: $signature:ident),* $(,)?) => {
        $(const _: fmi_sys::fmi2::$signature = Some($function);)*
    };
}
use conforming;
