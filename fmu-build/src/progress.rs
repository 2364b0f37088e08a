//! What the user sees while work runs: a spinner on a terminal, plain lines elsewhere.

use anyhow::Result;
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::time::{Duration, Instant};

/// One step of a command, while it runs.
pub(crate) struct Step {
    bar: ProgressBar,
}

impl Step {
    /// Shows what the step is busy with, on a terminal only.
    pub(crate) fn detail(&self, text: &str) {
        self.bar.set_message(text.to_owned());
    }

    /// A step that shows nothing: one beside another, which is shown.
    pub(crate) fn hidden() -> Self {
        Self { bar: ProgressBar::hidden() }
    }
}

/// Runs a step whose own output is not shown; ends with one line that gives its name and time.
pub(crate) fn quiet<T>(name: &str, work: impl FnOnce(&Step) -> Result<T>) -> Result<T> {
    let started = Instant::now();
    let on_terminal = std::io::stderr().is_terminal();
    let bar = if on_terminal { spinner(name) } else { ProgressBar::hidden() };
    if !on_terminal {
        eprintln!("{name} ...");
    }
    let result = work(&Step { bar: bar.clone() });
    bar.finish_and_clear();
    finish(name, started, &result);
    result
}

/// Runs a step that writes its own output to the terminal, under a heading.
pub(crate) fn shown<T>(name: &str, work: impl FnOnce() -> Result<T>) -> Result<T> {
    let started = Instant::now();
    eprintln!("{name} ...");
    let result = work();
    finish(name, started, &result);
    result
}

/// Seconds and tenths, with minutes where there are any.
pub(crate) fn seconds(elapsed: Duration) -> String {
    let total = elapsed.as_secs_f64();
    let minutes = (total / 60.0).floor();
    if minutes > 0.0 {
        format!("{minutes:.0} min {:.0} s", total - 60.0 * minutes)
    } else {
        format!("{total:.1} s")
    }
}

fn finish<T>(name: &str, started: Instant, result: &Result<T>) {
    let outcome = if result.is_ok() { "done" } else { "FAILED" };
    eprintln!("{name}: {outcome} ({})", seconds(started.elapsed()));
}

fn spinner(name: &str) -> ProgressBar {
    let bar = ProgressBar::new_spinner().with_prefix(name.to_owned());
    if let Ok(style) = ProgressStyle::with_template("{spinner} {prefix} [{elapsed}] {wide_msg}") {
        bar.set_style(style);
    }
    bar.enable_steady_tick(Duration::from_millis(120));
    bar
}

#[cfg(test)]
mod tests {
    use super::seconds;
    use std::time::Duration;

    #[test]
    fn times_read_well() {
        assert_eq!(seconds(Duration::from_millis(1234)), "1.2 s");
        assert_eq!(seconds(Duration::from_secs(61)), "1 min 1 s");
    }
}
