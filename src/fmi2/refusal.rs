//! Every reason to refuse a call. A function that returns one has changed nothing.

use super::status::{State, Status};
use crate::error::Error;
use std::path::PathBuf;
use thiserror::Error as ThisError;

/// What a call or a part of it returns. The reason is boxed, since almost every call succeeds and a
/// step takes a few hundred nanoseconds.
pub(super) type Checked<T = ()> = Result<T, Box<Refusal>>;

/// Why a call was refused; its text goes to the FMI logger. Values print in their shortest exact
/// form.
#[derive(Debug, ThisError)]
pub(super) enum Refusal {
    #[error("not allowed in state \"{state}\", {}", describe(.allowed))]
    OutOfOrder { state: State, allowed: &'static [State] },
    #[error("the instance is unusable since {0}: call fmi2Reset to start again, or fmi2FreeInstance")]
    Unusable(String),
    #[error("argument {0} is a null pointer")]
    NullPointer(&'static str),
    #[error("argument {argument}: {length} elements are more than memory can hold")]
    Length { argument: &'static str, length: usize },
    #[error("value reference {reference} does not exist: modelDescription.xml lists 0 to {last}")]
    UnknownReference { reference: u32, last: usize },
    #[error(
        "{name} (value reference {reference}) is of type {actual}, not {asked}: use the functions for {actual}"
    )]
    WrongType { name: String, reference: u32, actual: &'static str, asked: String },
    #[error(
        "{name} = {value} is refused: it is computed by the model (causality {causality}) and cannot be set"
    )]
    ReadOnly { name: String, value: String, causality: &'static str },
    #[error(
        "{name} = {value} is refused: a parameter is fixed after initialization; call fmi2Reset to change it"
    )]
    Fixed { name: String, value: String },
    #[error("{name} = {value} is refused: {requirement}")]
    Value { name: String, value: String, requirement: String },
    #[error("{name}: {problem}")]
    Text { name: String, problem: &'static str },
    #[error("{argument} = {value:?} is refused: {requirement}")]
    Argument { argument: &'static str, value: f64, requirement: &'static str },
    #[error("currentCommunicationPoint = {given:?} is refused: the last step ended at {expected:?}")]
    CommunicationPoint { given: f64, expected: f64 },
    #[error(
        "a step from {from:?} of length {length:?} is refused: it passes the stop time {stop:?} of fmi2SetupExperiment"
    )]
    BeyondStopTime { from: f64, length: f64, stop: f64 },
    #[error("derivative of {name}: order {order} is refused; only order 1 of inputs is supported")]
    DerivativeOrder { name: String, order: i32 },
    #[error("derivative of {name} = {value:?} is refused: {requirement}")]
    Derivative { name: String, value: f64, requirement: &'static str },
    #[error(
        "derivative of {name}: order {order} is refused; an order is 1 or more, and from 2 on the derivative is 0"
    )]
    OutputDerivativeOrder { name: String, order: i32 },
    #[error("{name} is refused as an unknown: {reason}")]
    Unknown { name: String, reason: String },
    #[error("derivative of {name} is refused: {reason}")]
    OutputDerivative { name: String, reason: String },
    #[error(
        "{name} is refused as a known: derivatives are with respect to inputs and, in initialization mode, Real parameters"
    )]
    Known { name: String },
    #[error("{0} is not a log category of modelDescription.xml")]
    LogCategory(String),
    #[error("status kind {kind} cannot be reported by this function")]
    StatusKind { kind: u32 },
    #[error("FMU state {0:#x} does not belong to this instance, or has been freed")]
    UnknownState(usize),
    #[error("serialised state is refused: {0}")]
    SerializedState(String),
    #[error(
        "size = {given} is refused: the serialised state has {needed} bytes, see fmi2SerializedFMUstateSize"
    )]
    SerializedSize { given: usize, needed: usize },
    #[error(
        "profile_file = \"\" is refused: profile = table needs a file with two columns, r and f in profile_unit"
    )]
    NoProfileFile,
    #[error("{parameter} = \"{name}\" cannot be read from {}: {reason}{}", tried(.places), path_hint(.name))]
    File { parameter: &'static str, name: String, places: Vec<PathBuf>, reason: std::io::Error },
    #[error("profile_file = \"{name}\" ({}): {problem}", .path.display())]
    ProfileContent { name: String, path: PathBuf, problem: Error },
    #[error("contacts_file = \"{name}\" ({}): {problem}", .path.display())]
    ContactsContent { name: String, path: PathBuf, problem: Error },
    #[error(
        "{context} cannot be done, and nothing has changed: {problem}; try a shorter step or other inputs"
    )]
    Step { context: String, problem: Error },
    #[error(
        "the same step is asked for again, with nothing set since it was discarded: change the inputs or the step size, restore a \
         state, or end the run; it was discarded for this reason: {0}"
    )]
    Repeated(String),
    #[error("{context}: {problem}")]
    Engine { context: String, problem: Error },
}

impl Refusal {
    /// A step that the model cannot do is a discard, and so is a missing status; see the module's
    /// documentation.
    pub(super) fn status(&self) -> Status {
        match self {
            Self::Step { .. } | Self::StatusKind { .. } => Status::Discard,
            _ => Status::Error,
        }
    }
}

fn describe(allowed: &[State]) -> String {
    if allowed.is_empty() {
        return "nor in any other: steps are carried out synchronously".into();
    }
    let names: Vec<_> = allowed.iter().map(|state| format!("\"{state}\"")).collect();
    format!("only in {}", names.join(", "))
}

/// The places where a file was looked for.
fn tried(places: &[PathBuf]) -> String {
    let places: Vec<_> = places.iter().map(|place| place.display().to_string()).collect();
    places.join(" or ")
}

/// What to do with a URI.
fn path_hint(name: &str) -> &'static str {
    let is_uri = name.get(..5).is_some_and(|start| start.eq_ignore_ascii_case("file:"));
    if is_uri { "; it is a URI: give a path" } else { "" }
}
