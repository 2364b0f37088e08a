//! What every page says of where its numbers come from.

use std::process::Command;

/// Processor, cores, compiler and commit, as a sentence.
pub(crate) fn provenance() -> String {
    let processors = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = processors.lines().find_map(|line| line.strip_prefix("model name"));
    let model = model.map_or("unknown processor", |name| name.trim_start_matches([' ', '\t', ':']));
    let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    // the pages themselves do not make a tree dirty: they are what is being written
    let changed = said("git", &["status", "--porcelain", "--", ".", ":!reports"]);
    let changes = if changed.is_empty() { "" } else { " with changes that are not committed" };
    format!(
        "Measured on {model}, {cores} cores, {} {}; {}; optimised build; commit {}{changes}.",
        std::env::consts::OS,
        std::env::consts::ARCH,
        said("rustc", &["-V"]),
        said("git", &["rev-parse", "--short", "HEAD"]),
    )
}

fn said(program: &str, arguments: &[&str]) -> String {
    let output = Command::new(program).args(arguments).output();
    output.map_or("unknown".into(), |output| String::from_utf8_lossy(&output.stdout).trim().to_string())
}
