//! One instance of the FMU: the model, where it is in its life, and how it reports to the importer.

use super::body::Body;
use super::lifecycle::Call;
use super::logger::Logger;
use super::model::{Attempt, Model};
use super::refusal::{Checked, Refusal};
use super::resources::Resources;
use super::saved::{Saved, SavedStates};
use super::serialized;
use super::settings::{Inputs, Settings};
use super::status::{Outcome, State, Status};
use super::warnings::Warnings;
use super::{GUID, MODEL_IDENTIFIER};
use crate::engine::FrettingContact;
use crate::number::short;
use crate::profile::Profile;
use core::ffi::CStr;
use fmi_sys::fmi2::{fmi2FMUstate, fmi2Type, fmi2Type_fmi2CoSimulation};

/// Below this the materials count as elastically similar: it is round-off of the two sides of the
/// paper's eq. (6).
const SIMILAR: f64 = 1e-9;

/// What an importer's fmi2Component points to.
pub(super) struct Component {
    pub(super) model: Model,
    pub(super) resources: Resources,
    logger: Logger,
    state: State,
    /// What made the instance unusable.
    failure: Option<String>,
    /// Worst status of the call that is being carried out, apart from its result.
    worst: Status,
    last_step: Outcome,
    /// The last step, where it has been discarded.
    discarded: Option<Box<Discarded>>,
    warnings: Warnings,
    saved: SavedStates,
}

/// A step that the model could not do, and why.
struct Discarded {
    attempt: Attempt,
    reason: String,
}

impl Component {
    pub(super) fn new(logger: Logger, resources: Option<Resources>) -> Self {
        Self {
            model: Model::default(),
            resources: resources.unwrap_or_default(),
            logger,
            state: State::Instantiated,
            failure: None,
            worst: Status::Ok,
            last_step: Outcome::Done,
            discarded: None,
            warnings: Warnings::default(),
            saved: SavedStates::default(),
        }
    }

    /// fmi2Instantiate, once the arguments are checked; the error is the message for the
    /// importer.
    pub(super) fn instantiate(
        logger: Logger,
        kind: fmi2Type,
        guid: Option<&CStr>,
        resource_location: Option<&CStr>,
    ) -> Result<Self, (Logger, String)> {
        if kind != fmi2Type_fmi2CoSimulation {
            let text =
                format!("fmuType = {kind} is refused: {MODEL_IDENTIFIER} is for co-simulation, fmuType = 1");
            return Err((logger, text));
        }
        let Some(guid) = guid else {
            return Err((logger, "argument fmuGUID is a null pointer".into()));
        };
        if guid.to_bytes() != GUID.as_bytes() {
            let text = format!(
                "fmuGUID = {} is refused: this library belongs to the modelDescription.xml with guid {GUID}; use the \
                 two files of one FMU",
                guid.to_string_lossy()
            );
            return Err((logger, text));
        }
        let resources = resource_location.and_then(|uri| Resources::from_uri(&uri.to_string_lossy()));
        if let (None, Some(uri)) = (&resources, resource_location) {
            let uri = uri.to_string_lossy();
            let text = format!(
                "fmi2Instantiate: fmuResourceLocation = {uri} is no folder of this machine; not used"
            );
            logger.log(Status::Ok, &text);
        }
        let component = Self::new(logger, resources);
        component.event(&format!("{MODEL_IDENTIFIER} {} is instantiated", env!("CARGO_PKG_VERSION")));
        Ok(component)
    }

    /// Whether `call` is allowed now.
    #[inline]
    pub(super) fn admit(&mut self, call: &Call) -> Checked {
        self.worst = Status::Ok;
        call.check(self.state).map_err(|out_of_order| match &self.failure {
            Some(failure) => Refusal::Unusable(failure.clone()).into(),
            None => out_of_order,
        })
    }

    /// The status of a call with this result; a refusal is reported to the importer.
    #[inline]
    pub(super) fn conclude(&mut self, call: &Call, result: Checked) -> Status {
        match result {
            Ok(()) => self.worst,
            Err(refusal) => self.refuse(call, &refusal),
        }
    }

    #[cold]
    fn refuse(&mut self, call: &Call, refusal: &Refusal) -> Status {
        self.logger.log(refusal.status(), &format!("{}: {refusal}", call.name));
        self.worst.max(refusal.status())
    }

    /// Marks the instance as unusable after a panic that said `text`.
    pub(super) fn fail(&mut self, call: &Call, text: &str) -> Status {
        let failure = format!("an internal failure in {} ({text})", call.name);
        self.logger.log(
            Status::Error,
            &format!("{}: internal failure: {text}; call fmi2Reset to start again", call.name),
        );
        self.failure = Some(failure);
        self.state = State::Failed;
        Status::Error
    }

    /// A warning of the present call.
    pub(super) fn warn(&mut self, text: &str) {
        self.logger.log(Status::Warning, text);
        self.worst = self.worst.max(Status::Warning);
    }

    fn event(&self, text: &str) {
        self.logger.log(Status::Ok, text);
    }

    pub(super) fn set_debug_logging(&mut self, logging_on: bool, categories: &[&CStr]) -> Checked {
        self.logger.select(logging_on, categories)
    }

    pub(super) fn setup_experiment(
        &mut self,
        tolerance: Option<f64>,
        start: f64,
        stop: Option<f64>,
    ) -> Checked {
        if let Some(value) = tolerance.filter(|tolerance| !(tolerance.is_finite() && *tolerance > 0.0)) {
            let requirement = "a tolerance is finite and greater than 0";
            return Err(Refusal::Argument { argument: "tolerance", value, requirement }.into());
        }
        self.model.staged().clock = super::clock::Clock::new(start, stop)?;
        if let Some(tolerance) = tolerance {
            self.event(&format!(
                "tolerance {tolerance:?} of the experiment is not used: set the parameter tolerance"
            ));
        }
        Ok(())
    }

    pub(super) fn enter_initialization_mode(&mut self) -> Checked {
        self.state = State::InitializationMode;
        Ok(())
    }

    pub(super) fn exit_initialization_mode(&mut self) -> Checked {
        let contact = self.model.begin(&self.resources)?;
        let materials = contact.parameters().materials;
        let subtracted = match &contact.parameters().profile {
            Profile::Table(table) => table.subtracted_height(),
            _ => 0.0,
        };
        let [along_x, along_y] = contact.read(FrettingContact::tangential_moduli);
        self.state = State::StepComplete;
        if subtracted != 0.0 {
            self.event(&format!(
                "profile_file begins with f(0) = {subtracted} m, which is subtracted from all its heights: the tip is at f = 0", subtracted = short(subtracted)));
        }
        self.event(&format!(
            "initialized with E* = {} Pa and G* = {along_x} Pa along x, {along_y} Pa along y",
            short(materials.normal_modulus()),
            along_x = short(along_x),
            along_y = short(along_y)
        ));
        let defect = materials.similarity_defect();
        if defect > SIMILAR {
            self.warn(&format!(
                "the materials are not elastically similar: (1 - 2 poisson_ratio)/shear modulus of the two bodies \
                 differs by {:.3} %; the coupling of normal and tangential contact that follows is neglected",
                100.0 * defect
            ));
        }
        self.warn_of_mistakes(Warnings::at_start);
        Ok(())
    }

    /// Sends the messages of likely mistakes, if there are any; the status of the call stays what
    /// it is.
    fn warn_of_mistakes(
        &mut self,
        find: fn(&mut Warnings, &FrettingContact, &Settings, &Inputs) -> Vec<String>,
    ) {
        let (Some(contact), staged) = self.model.parts() else { return };
        let find =
            |contact: &FrettingContact| find(&mut self.warnings, contact, &staged.settings, &staged.inputs);
        for message in contact.read(find) {
            self.logger.log(Status::Warning, &message);
        }
    }

    /// Says once why a field has no numbers.
    #[cold]
    pub(super) fn warn_of_unknown_field(&mut self, name: &str) {
        if self.warnings.take_unknown_field() {
            self.logger.log(
                Status::Warning,
                &format!(
                    "{name} is not a number: friction work per area is known as worn depth over wear coefficient, so only with \
                     wear_coefficient > 0 or wear_coefficient_2 > 0, and as long as these are not changed between steps. \
                     Set them before the initialization (wear_coefficient = 1e-12 leaves the profile as it is; an ellipse \
                     has no wear), or do not read energy_density"
                ),
            );
        }
    }

    pub(super) fn do_step(&mut self, point: f64, length: f64) -> Checked {
        let result = if self.discarded.is_some() {
            self.step_after_a_discard(point, length)
        } else {
            self.step(point, length)
        };
        self.last_step = match &result {
            Ok(()) => Outcome::Done,
            Err(refusal) if refusal.status() == Status::Discard => Outcome::Discarded,
            Err(_) => Outcome::Refused,
        };
        if let Err(refusal) = &result
            && self.last_step == Outcome::Discarded
        {
            let attempt = self.model.attempt(point, length);
            self.discarded = Some(Box::new(Discarded { attempt, reason: refusal.to_string() }));
        }
        result
    }

    /// A step that is requested again, in the same state in which it was discarded, would be
    /// discarded again: some masters repeat it without end.
    #[cold]
    fn step_after_a_discard(&mut self, point: f64, length: f64) -> Checked {
        if let Some(discarded) = &self.discarded
            && discarded.attempt == self.model.attempt(point, length)
        {
            return Err(Refusal::Repeated(discarded.reason.clone()).into());
        }
        self.step(point, length)?;
        self.discarded = None;
        Ok(())
    }

    fn step(&mut self, point: f64, length: f64) -> Checked {
        let end = self.model.staged().clock.after(point, length)?;
        self.check_targets(length)?;
        self.model.step(end, length)?;
        let (contact, staged) = self.model.parts();
        // what a contact of an interface does in a step has no counterpart in the settings
        if let Some(Body::One(contact)) = contact
            && self.warnings.has_to_look(contact, &staged.inputs)
        {
            self.warn_of_mistakes(Warnings::after_step);
        }
        Ok(())
    }

    /// fmi2DoStepStatus.
    pub(super) fn last_step(&self) -> Status {
        match self.last_step {
            Outcome::Done => Status::Ok,
            Outcome::Discarded => Status::Discard,
            Outcome::Refused => Status::Error,
        }
    }

    pub(super) fn terminate(&mut self) -> Checked {
        self.state = State::Terminated;
        self.warn_of_mistakes(Warnings::at_end);
        if let (Some(contact), _) = self.model.parts() {
            let counters = contact.counters().to_string();
            self.event(&format!("terminated after this work: {counters}"));
        }
        Ok(())
    }

    /// Back to the state after fmi2Instantiate. Saved states remain.
    pub(super) fn reset(&mut self) -> Checked {
        self.model = Model::default();
        self.state = State::Instantiated;
        self.failure = None;
        self.last_step = Outcome::Done;
        self.discarded = None;
        Ok(())
    }

    pub(super) fn save(&mut self, old: fmi2FMUstate) -> Checked<fmi2FMUstate> {
        let saved = Saved { state: self.state, last_step: self.last_step, model: self.model.save() };
        self.saved.keep(saved, old)
    }

    pub(super) fn restore(&mut self, state: fmi2FMUstate) -> Checked {
        let saved = self.saved.get(state)?;
        let experiment = self.model.staged().clock;
        if self.failure.is_some() {
            self.model = saved.model.revive()?;
        } else {
            self.model.restore(&saved.model)?;
        }
        (self.state, self.last_step, self.failure) = (saved.state, saved.last_step, None);
        self.discarded = None;
        // a run that has begun continues to the stop time of this instance's experiment
        if self.state != State::Instantiated {
            let staged = self.model.staged();
            staged.clock = staged.clock.in_experiment_of(&experiment);
        }
        if let (Some(contact), staged) = self.model.parts() {
            contact.read(|contact| self.warnings.resume(contact, &staged.settings, &staged.inputs));
        }
        Ok(())
    }

    /// The bytes of a saved state.
    pub(super) fn serialize(&self, state: fmi2FMUstate) -> Checked<Vec<u8>> {
        serialized::encode(self.saved.get(state)?)
    }

    /// A new saved state from bytes.
    pub(super) fn deserialize(&mut self, bytes: &[u8]) -> Checked<fmi2FMUstate> {
        self.saved.keep(serialized::decode(bytes)?, core::ptr::null_mut())
    }

    pub(super) fn free_saved(&mut self, state: fmi2FMUstate) -> Checked {
        self.saved.free(state)
    }
}
