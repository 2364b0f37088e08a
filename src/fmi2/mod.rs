//! The FMI 2.0 co-simulation interface: the only module that knows C, and the only one with unsafe
//! code.
//!
//! | module | subject |
//! | --- | --- |
//! | [`exports`] | the 34 C functions, each a few lines: check the arguments, pass them to the instance |
//! | `guard` | the one way in from C: null, order of calls, panics, status, message |
//! | `lifecycle` | which function is allowed in which state, as data |
//! | `logger` | messages to the importer |
//! | [`variables`] | the variable table, the source of modelDescription.xml |
//! | `settings`, [`enumerations`], `resources` | parameters as the importer sets them → [`crate::Parameters`] |
//! | `derivatives` | of outputs: with respect to inputs and to time |
//! | `component`, `values`, `model`, `clock`, `saved`, `serialized` | one instance: access by value reference, the contact, its time, its saved states, in memory and as bytes |
//! | `status`, `refusal` | what a call returns, and every reason to refuse one, with its numbers |
//! | `warnings` | likely mistakes, each sent once |
//!
//! # What does this FMU do where the standard leaves a choice?
//!
//! - **Status.** A call that cannot be carried out returns fmi2Error and changes nothing. A step
//!   that the model cannot do, for instance to a load beyond its profile table, returns
//!   fmi2Discard: nothing has changed, the last successful time is that before it, and a master may
//!   repeat it with other inputs or another step size without a saved state. A status that this FMU
//!   cannot report is a discard, too. fmi2Warning goes with dissimilar materials, once.
//! - **Repeated discard.** The same step requested again, with nothing changed and no state
//!   restored since its discard, returns fmi2Error: it would be discarded without end, and some
//!   masters ask without end. After fmi2Error the standard lets a master restore a state, reset or
//!   free the instance. This one also stays in the state before the step, as after every refused
//!   call, and takes other inputs, another step or fmi2Terminate.
//! - **Warnings** of likely mistakes (`warnings`) reach the logger with the status fmi2Warning,
//!   each once per instance. The call itself returns fmi2OK, since some masters stop at anything
//!   else.
//! - **Time.** A communication point is the end of the last step if it differs from it by less than
//!   1e-3 of the step (clocks rounded to nanoseconds or single precision) or 1e-9 of the time. A
//!   saved state has no stop time: that of the instance that takes it holds.
//! - **Panic.** It returns fmi2Error, not fmi2Fatal, since instances share nothing. The instance
//!   refuses everything from then on, until fmi2Reset, fmi2SetFMUstate or fmi2FreeInstance.
//! - **Messages.** Warnings, errors and discards always reach the logger; events only under
//!   `loggingOn`, and when their category is selected.
//! - **Start.** Inputs set before fmi2ExitInitializationMode are the state in which the contact
//!   begins, with unstressed springs. In initialization mode outputs follow parameters and inputs
//!   as they are set.
//! - **Steps.** Inputs set at a communication point are the target at the end of the next step.
//!   With fmi2SetRealInputDerivatives (order 1) the target is `u + u̇·h`. Derivatives count from
//!   the communication point at which they are set: they serve one step, after which the input
//!   stands where that step ended, so that a step with no new value set stays there. A step of
//!   length zero takes the new inputs without moving time.
//! - **Derivatives of outputs** are those of the law in the present sliding direction, one-sided
//!   where it has a kink (see [`crate::engine::Gradient`]), at the profile as it is: tangents at
//!   the end of the last step, not averages along it. Those with respect to time hold there, too,
//!   for inputs that continue to change at the same rates; of order 2 and more they are 0. In
//!   initialization mode there are directional derivatives with respect to parameters, too.
//! - **Tunable parameters.** friction_coefficient, wear_coefficient and wear_coefficient_2 may be
//!   changed between steps, but not switched on or off. The next step begins with the new ones;
//!   springs that are then beyond their bound slip back to it.
//! - **Cyclic loading.** A step makes `h` times the mean frequency cycles; the other inputs count
//!   at its end.
//! - **Coating.** A step does not end where the coating wears through; worn_through_time is the
//!   time. In transient loading reading worn_through looks at the depth, too, so that the time may
//!   be that of the read.
//! - **Fields that are not known.** energy_density is not a number where the work per area is not
//!   known; a warning, once per instance, gives the reason. All other values are numbers.
//! - **Tolerance.** The parameter `tolerance` rules; that of fmi2SetupExperiment is noted in the
//!   log only.
#![allow(unsafe_code)]

mod body;
mod clock;
mod component;
mod derivatives;
pub mod enumerations;
pub mod exports;
mod guard;
mod lifecycle;
mod logger;
mod model;
mod refusal;
mod resources;
mod saved;
mod serialized;
mod settings;
mod status;
mod values;
pub mod variables;
mod warnings;

pub use logger::CATEGORIES;

// fmi-sys exports a function of its own, and after link-time optimisation there is no archive whose
// symbols the linker could drop. The strictest visibility that any object requests applies.
#[cfg(target_os = "linux")]
core::arch::global_asm!(".hidden callback_log");

/// Identifier that links modelDescription.xml with this library; derived from the file's content.
pub const GUID: &str = env!("FRETTING_CONTACT_GUID");

/// Base name of the library inside the FMU.
pub const MODEL_IDENTIFIER: &str = "FrettingContact";
