//! Short versions of the reports, without a clock, and the procedure that they compare with. Their
//! scenes are those of the reports, under `reports/harness`.

#[path = "../fmi/counting.rs"]
mod counting;
mod coupling;
#[path = "../../reports/harness/economy.rs"]
#[allow(dead_code, reason = "the report prints more than is asserted")]
mod economy;
#[path = "../../reports/harness/judge.rs"]
#[allow(dead_code, reason = "the report prints more of a finding than the test asks for")]
mod judge;
mod left_out;
#[path = "../../reports/harness/masters.rs"]
mod masters;
mod published_procedure;
#[path = "../../reports/harness/scenes/mod.rs"]
mod scenes;
mod short;

/// Counts by thread, and so for each test alone.
#[global_allocator]
static ALLOCATOR: counting::Counting = counting::Counting;
