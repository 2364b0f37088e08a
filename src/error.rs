//! The one error type of the engine. Every variant carries the numbers that were wrong.

use crate::number::short;
use thiserror::Error;

/// What the engine refuses, and why. Nothing that returns an error has changed the contact's state.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Error {
    /// A parameter is outside the range in which the model is defined.
    #[error("parameter {name} = {value:?} is not allowed: {requirement}")]
    Parameter {
        /// Name as in [`crate::Parameters`] and in the FMU's variable list.
        name: &'static str,
        /// The offending value (SI units).
        value: f64,
        /// What the value has to satisfy.
        requirement: &'static str,
    },
    /// An input of a step is not a usable number.
    #[error("input {name} = {value:?} is not allowed: {requirement}")]
    Input {
        /// Name as in the FMU's variable list.
        name: &'static str,
        /// The offending value (SI units).
        value: f64,
        /// What the value has to satisfy.
        requirement: &'static str,
    },
    /// A point table that is not a profile.
    #[error("profile table, {place}: {problem}")]
    ProfileTable {
        /// Where in the table, e.g. `line 12` or `point 3`.
        place: String,
        /// What is wrong there and what to do about it.
        problem: String,
    },
    /// A table of contacts that is not one.
    #[error("contacts table, {place}: {problem}")]
    ContactsTable {
        /// Where in the table, e.g. `line 12` or `contact 3`.
        place: String,
        /// What is wrong there and what to do about it.
        problem: String,
    },
    /// One of several contacts refuses a step.
    #[error("contact {contact} of the interface: {problem}")]
    InContact {
        /// Its number in the table, from 1.
        contact: usize,
        /// What it refuses.
        problem: Box<Error>,
    },
    /// Many contacts that no approach lets carry a force within the numbers that are computed with.
    #[error(
        "normal_force = {} N is carried by no approach of the {contacts} contacts: check the load, the radii and the moduli", short(.force))]
    NoApproach {
        /// N.
        force: f64,
        /// Their number.
        contacts: usize,
    },
    /// Motion that a rigid body on several contacts cannot follow in one call.
    #[error(
        "the interface wears too fast: {share:.1e} of the normal force passes between contacts in one part of the step \
         ({what}), and it is not divided into more than {parts} parts: take smaller steps, or check wear_coefficient \
         and hardness"
    )]
    InterfaceOutrun {
        /// Share of the normal force that the wear of the last part moved between contacts.
        share: f64,
        /// What was asked for.
        what: String,
        /// Into how many parts the step was divided.
        parts: u64,
    },
    /// The contact would reach a radius where the one-dimensional image of the profile falls, so
    /// that the contact region would not be one disc.
    #[error(
        "the contact edge reaches r = {contact_radius:.6e} m, but the 1-D image of the profile is not monotone: it first falls at \
         r = {radius:.6e} m, its largest fall in the table is {fall:.2e} m, and the points lie {roughness:.2e} m rms off the line in r^2 \
         through their neighbours; the contact would not be one disc: lower the load, or make an admissible table from the \
         measurement with `cargo fmu profile`"
    )]
    NonMonotoneImage {
        /// First radius at which the image decreases, m.
        radius: f64,
        /// Contact radius that the load asks for, m.
        contact_radius: f64,
        /// Largest depth by which the image lies below an earlier value, m:
        /// [`crate::ProfileTable::largest_fall`].
        fall: f64,
        /// Roughness of the table, m: [`crate::ProfileTable::roughness`].
        roughness: f64,
    },
    /// The load, on the profile as it has worn by then, needs a contact larger than the tabulated
    /// profile.
    #[error(
        "{quantity} = {value:.6e} needs a contact radius beyond the last point of the profile table, \
         r = {radius:.6e} m: check the unit of the table (profile_unit), extend it, lower the load or let it wear less"
    )]
    BeyondTable {
        /// The controlled quantity, `normal_force` or `indentation`.
        quantity: &'static str,
        /// Its value, N or m.
        value: f64,
        /// Last tabulated radius, m.
        radius: f64,
    },
    /// A computation overflowed or produced something that is not a number.
    #[error(
        "{what} is not finite for normal = {}, displacement = {}: the scene is outside the range of double precision", short(.normal), short(.displacement))]
    NotFinite {
        /// The quantity that overflowed.
        what: &'static str,
        /// Controlled normal quantity, N or m.
        normal: f64,
        /// Tangential displacement or its amplitude, m.
        displacement: f64,
    },
    /// A contact larger or loaded more than what is computed with.
    #[error(
        "{what} = {} is beyond what can be computed with, {}: check the units, N, m and Pa throughout", short(.value), short(.most))]
    BeyondNumbers {
        /// The quantity and its unit.
        what: &'static str,
        /// Its value.
        value: f64,
        /// The largest accepted one.
        most: f64,
    },
    /// A call that wears so much that its integration would not end in reasonable time.
    #[error(
        "{} cycles of amplitude {} m wear more than {steps} internal steps can follow \
         ({} cycles are left): take fewer cycles at a time, or check amplitude and wear coefficient", short(.cycles), short(.amplitude), short(.left))]
    TooMuchWear {
        /// Cycles that were asked for.
        cycles: f64,
        /// Cycles that were left when it was given up.
        left: f64,
        /// Displacement amplitude, m.
        amplitude: f64,
        /// Internal steps that were taken.
        steps: u32,
    },
    /// A step in which the contact wears more than its profile can follow.
    #[error(
        "the step from displacement {} m to {} m wears more than the profile can follow: take smaller \
         steps, or check wear coefficient and hardness", short(.from), short(.displacement))]
    WearOutrun {
        /// Displacement at its start, m.
        from: f64,
        /// Displacement at its end, m.
        displacement: f64,
    },
    /// A snapshot that does not belong to this contact or is damaged.
    #[error("the saved state cannot be used: {0}")]
    Snapshot(String),
}
