//! Messages to the importer's logger.

use super::refusal::{Checked, Refusal};
use super::status::Status;
use core::ffi::{CStr, c_void};
use fmi_sys::fmi2::{fmi2CallbackFunctions, fmi2CallbackLogger};
use std::ffi::CString;

/// Name and meaning of the log categories, as in modelDescription.xml. The last one means all of
/// them.
pub const CATEGORIES: [(&CStr, &str); 6] = [
    (c"logEvents", "what the instance does: creation, initialization, termination"),
    (c"logStatusWarning", "warnings, of calls that return fmi2OK as well"),
    (c"logStatusDiscard", "messages of calls that return fmi2Discard"),
    (c"logStatusError", "messages of calls that return fmi2Error"),
    (c"logStatusFatal", "messages of calls that return fmi2Fatal"),
    (c"logAll", "all messages"),
];

const ALL: usize = CATEGORIES.len() - 1;

/// The importer's callback with what it needs. The struct of callbacks is copied, since the
/// importer may drop its own after fmi2Instantiate.
pub(super) struct Logger {
    callback: fmi2CallbackLogger,
    environment: *mut c_void,
    instance_name: CString,
    logging_on: bool,
    selected: [bool; CATEGORIES.len()],
}

impl Logger {
    /// A logger with every category selected. Without callbacks it is silent.
    pub(super) fn new(
        callbacks: Option<&fmi2CallbackFunctions>,
        instance_name: CString,
        logging_on: bool,
    ) -> Self {
        Self {
            callback: callbacks.and_then(|c| c.logger),
            environment: callbacks.map_or(core::ptr::null_mut(), |c| c.componentEnvironment),
            instance_name,
            logging_on,
            selected: [true; CATEGORIES.len()],
        }
    }

    /// fmi2SetDebugLogging: an empty list means every category.
    pub(super) fn select(&mut self, logging_on: bool, categories: &[&CStr]) -> Checked {
        let mut selected = [categories.is_empty(); CATEGORIES.len()];
        for &category in categories {
            let known = CATEGORIES.iter().position(|(name, _)| *name == category);
            selected[known.ok_or_else(|| Refusal::LogCategory(format!("{category:?}")))?] = true;
        }
        self.logging_on = logging_on;
        self.selected = selected;
        Ok(())
    }

    /// Passes `text` on if it is wanted.
    pub(super) fn log(&self, status: Status, text: &str) {
        let Some(callback) = self.callback else { return };
        if !self.admits(status) {
            return;
        }
        // The text is an argument of "%s", never the format: it may contain per cent signs.
        // A hash is doubled, since a single one begins a value reference that the importer
        // replaces.
        let text = text.replace('\0', "\u{fffd}").replace('#', "##");
        let text = CString::new(text).unwrap_or_default();
        let category = CATEGORIES[category(status)].0;
        let name = self.instance_name.as_ptr();
        // SAFETY: the importer vouches for its callback until fmi2FreeInstance; every string ends
        // with a null and outlives the call, and the one conversion in the format has its argument.
        unsafe {
            callback(
                self.environment,
                name,
                status.to_fmi(),
                category.as_ptr(),
                c"%s".as_ptr(),
                text.as_ptr(),
            );
        }
    }

    /// What goes wrong must never be opaque, so the debug switch does not silence it.
    fn admits(&self, status: Status) -> bool {
        match status {
            Status::Warning | Status::Discard | Status::Error => true,
            Status::Ok => self.logging_on && (self.selected[category(status)] || self.selected[ALL]),
        }
    }
}

fn category(status: Status) -> usize {
    match status {
        Status::Ok => 0,
        Status::Warning => 1,
        Status::Discard => 2,
        Status::Error => 3,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn logger(logging_on: bool) -> Logger {
        Logger::new(None, CString::default(), logging_on)
    }

    #[test]
    fn what_goes_wrong_passes_whatever_is_selected() {
        for (on, events) in [(true, true), (false, false)] {
            let logger = logger(on);
            assert_eq!(logger.admits(Status::Ok), events);
            assert!([Status::Warning, Status::Discard, Status::Error].iter().all(|s| logger.admits(*s)));
        }
    }

    #[test]
    fn categories_select_events() {
        let mut logger = logger(false);
        for (on, categories, events) in [
            (true, &[c"logStatusDiscard"][..], false),
            (true, &[c"logAll"], true),
            (false, &[c"logAll"], false),
            (true, &[c"logStatusError", c"logEvents"], true),
            (true, &[], true),
        ] {
            logger.select(on, categories).unwrap();
            assert_eq!(logger.admits(Status::Ok), events, "{categories:?}");
        }
    }

    #[test]
    fn an_unknown_category_is_named_and_changes_nothing() {
        let mut logger = logger(true);
        let refusal = logger.select(false, &[c"logEvents", c"logNonsense"]).unwrap_err();
        assert!(refusal.to_string().contains("logNonsense"), "{refusal}");
        assert!(logger.admits(Status::Ok));
    }
}
