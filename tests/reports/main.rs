//! Short versions of the reports, without a clock, and the procedure that they compare with. Their
//! scenes are those of the reports, under `examples/report`.

#[path = "../fmi/counting.rs"]
mod counting;
mod coupling;
#[path = "../../examples/report/economy.rs"]
#[allow(dead_code, reason = "the report prints more than is asserted")]
mod economy;
#[path = "../../examples/report/judge.rs"]
#[allow(dead_code, reason = "the report prints more of a finding than the test asks for")]
mod judge;
mod left_out;
#[path = "../../examples/report/masters.rs"]
mod masters;
mod published_procedure;
#[path = "../../examples/report/scenes/mod.rs"]
mod scenes;
mod short;

/// Counts by thread, and so for each test alone.
#[global_allocator]
static ALLOCATOR: counting::Counting = counting::Counting;
