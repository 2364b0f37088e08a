//! Counting tests from what cargo and pytest print.

use std::fmt;

/// Tests run so far.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct Totals {
    passed: u64,
    failed: u64,
    skipped: u64,
    /// Whether one of the programs that ran them failed.
    ended_badly: bool,
}

impl Totals {
    /// Counts a line such as `test result: ok. 3 passed; 0 failed; 1 ignored; ...`.
    pub(crate) fn add_rust_line(&mut self, line: &str) {
        if let Some(result) = line.trim().strip_prefix("test result: ") {
            self.add_counts(result.split_once(". ").map_or("", |(_, counts)| counts), ';');
        }
    }

    /// Counts a line such as `=== 1 failed, 3 passed, 1 skipped in 0.12s ===`, which pytest ends
    /// with.
    pub(crate) fn add_pytest_line(&mut self, line: &str) {
        let line = line.trim().trim_matches('=').trim();
        if let Some((counts, time)) = line.rsplit_once(" in ")
            && time.starts_with(|c: char| c.is_ascii_digit())
        {
            self.add_counts(counts, ',');
        }
    }

    /// Notes how a program ended.
    pub(crate) fn finish(&mut self, ended_well: bool) {
        self.ended_badly |= !ended_well;
    }

    /// Whether tests were run and none failed.
    pub(crate) fn passed(&self) -> bool {
        !self.ended_badly && self.failed == 0 && self.passed > 0
    }

    fn add_counts(&mut self, counts: &str, separator: char) {
        for part in counts.split(separator) {
            let Some((number, word)) = part.trim().split_once(' ') else { continue };
            let Ok(number) = number.parse::<u64>() else { continue };
            match word {
                "passed" => self.passed += number,
                "failed" | "error" | "errors" => self.failed += number,
                "ignored" | "skipped" => self.skipped += number,
                _ => {}
            }
        }
    }
}

impl fmt::Display for Totals {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} passed, {} failed, {} skipped", self.passed, self.failed, self.skipped)?;
        if self.ended_badly && self.failed == 0 {
            write!(f, ", stopped by an error")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::Totals;

    #[test]
    fn rust_results_add_up() {
        let mut totals = Totals::default();
        for line in [
            "running 3 tests",
            "test result: ok. 3 passed; 0 failed; 1 ignored; 0 measured; 0 filtered out; finished in 0.00s",
            "test result: FAILED. 2 passed; 1 failed; 0 ignored; 0 measured; 0 filtered out; finished in 0.00s",
        ] {
            totals.add_rust_line(line);
        }
        assert_eq!(totals, Totals { passed: 5, failed: 1, skipped: 1, ended_badly: false });
        totals.finish(false);
        assert!(!totals.passed());
    }

    #[test]
    fn pytest_results_are_read_from_the_last_line() {
        let mut totals = Totals::default();
        for line in ["3 passed so far", "=== 1 failed, 30 passed, 2 skipped, 1 error in 61.5s (0:01:01) ==="]
        {
            totals.add_pytest_line(line);
        }
        assert_eq!(totals, Totals { passed: 30, failed: 2, skipped: 2, ended_badly: false });
    }

    #[test]
    fn no_test_at_all_is_no_success() {
        let mut totals = Totals::default();
        totals.finish(true);
        assert!(!totals.passed());
        totals.add_pytest_line("4 passed in 0.2s");
        assert!(totals.passed());
    }
}
