//! The C interface of FMI 2.0, called as an importer calls it.

mod bad_input;
mod bodies;
#[cfg(target_os = "linux")]
mod c_abi;
#[cfg(target_os = "linux")]
mod c_master;
mod calls;
mod counting;
mod coupling;
mod derivatives;
mod early_end;
mod ellipse;
mod end_of_the_table;
mod host;
mod instantiate;
mod interface;
mod lifecycle;
#[path = "../../reports/harness/masters.rs"]
mod masters;
mod no_allocation;
mod planar;
mod random_calls;
mod rig;
mod running_in;
mod semantics;
mod serialized;
mod slip_state;
mod steps;
mod warnings;
mod wear_depth;

/// Counts by thread, and so for each test alone.
#[global_allocator]
static ALLOCATOR: counting::Counting = counting::Counting;
