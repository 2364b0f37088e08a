//! What a call returns and what an instance can be in.

use State::{Failed, InitializationMode, Instantiated, StepComplete, Terminated};
use fmi_sys::fmi2::{
    fmi2Status, fmi2Status_fmi2Discard, fmi2Status_fmi2Error, fmi2Status_fmi2OK, fmi2Status_fmi2Warning,
};
use serde::{Deserialize, Serialize};
use std::fmt;

/// The statuses that this FMU returns, in order of severity.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Status {
    Ok,
    Warning,
    Discard,
    Error,
}

impl Status {
    pub(super) fn to_fmi(self) -> fmi2Status {
        match self {
            Self::Ok => fmi2Status_fmi2OK,
            Self::Warning => fmi2Status_fmi2Warning,
            Self::Discard => fmi2Status_fmi2Discard,
            Self::Error => fmi2Status_fmi2Error,
        }
    }
}

/// State of one instance.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum State {
    /// After fmi2Instantiate or fmi2Reset.
    Instantiated,
    /// Between fmi2EnterInitializationMode and fmi2ExitInitializationMode.
    InitializationMode,
    /// Ready for fmi2DoStep.
    StepComplete,
    /// After fmi2Terminate: results can be read.
    Terminated,
    /// After an internal failure: nothing of the model can be trusted.
    Failed,
}

impl fmt::Display for State {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Instantiated => "instantiated",
            InitializationMode => "initialization mode",
            StepComplete => "step complete",
            Terminated => "terminated",
            Failed => "failed",
        })
    }
}

/// How the last step ended.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) enum Outcome {
    Done,
    /// The model could not do it.
    Discarded,
    /// It was no step at all.
    Refused,
}
