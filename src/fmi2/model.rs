//! The contact behind one instance: what the importer has set, and the engine that is built from it
//! when needed.

use super::body::{Body, SavedBody};
use super::clock::Clock;
use super::enumerations::Loading;
use super::refusal::{Checked, Refusal};
use super::resources::Resources;
use super::settings::{Inputs, Settings};
use super::values::{check_inputs, check_settings};
use crate::error::Error;
use serde::{Deserialize, Serialize};

/// Everything but the contact itself.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(super) struct Staged {
    pub(super) settings: Settings,
    pub(super) inputs: Inputs,
    /// Time derivatives of the inputs, for the next step only; `None` where all are 0.
    pub(super) slopes: Option<Inputs>,
    pub(super) clock: Clock,
    pub(super) last_step: LastStep,
    /// Largest wear depth that has been read, m. What the engine gives may fall in its sixth digit
    /// where the profile is updated, but wear never heals.
    pub(super) deepest_read: f64,
    /// When the coating wore through, s.
    pub(super) worn_through_at: Option<f64>,
    /// Whether tunable parameters have changed and the contact does not have them yet.
    retune: bool,
    /// Whether the contact has been brought to its initial state with the present inputs.
    started: bool,
    /// Whether initialization is over: parameters are fixed, and inputs are targets of steps.
    initialized: bool,
}

impl Staged {
    /// Whether the coating has worn through. The time is taken where it is seen for the first time.
    pub(super) fn look_at_coating(&mut self, contact: &Body) -> bool {
        if self.worn_through_at.is_none() && contact.worn_through() {
            self.worn_through_at = Some(self.clock.time());
        }
        self.worn_through_at.is_some()
    }

    /// Takes a contact along a step of `length`, s.
    #[inline]
    fn advance(&self, contact: &mut Body, to: &Inputs, length: f64) -> Result<(), Error> {
        let normal = to.normal(self.settings.normal_control());
        match self.settings.loading() {
            Loading::Transient => contact.advance_to(normal, to.place(), to.rotation),
            Loading::Cyclic => {
                let cycles = 0.5 * (self.inputs.frequency + to.frequency) * length;
                contact.advance_cycles(normal, to.displacement_amplitude, cycles)
            }
        }
    }

    /// The same with tunable parameters that have changed. A step that cannot be done must not
    /// leave the contact retuned either.
    #[cold]
    fn retune_and_advance(&self, contact: &mut Body, to: &Inputs, length: f64) -> Result<(), Error> {
        let (before, settings) = (contact.clone(), &self.settings);
        let advanced = contact
            .retune(settings.friction_coefficient, settings.wear_coefficients())
            .and_then(|()| self.advance(contact, to, length));
        if advanced.is_err() {
            *contact = before;
        }
        advanced
    }

    #[cold]
    fn refuse_step(&self, to: &Inputs, length: f64, problem: Error) -> Box<Refusal> {
        let (start, inputs) = (self.clock.time(), to.describe(&self.settings));
        let context = format!("step from t = {start:?} s by {length:?} s to {inputs}");
        Refusal::Step { context, problem }.into()
    }
}

/// Time that a number of cycles takes whose frequency changes evenly between two, Hz, over a step
/// of `length`: the root of f₀ t + (f₁ − f₀) t²/(2 length) = cycles.
fn time_of_cycles(cycles: f64, (first, last): (f64, f64), length: f64) -> f64 {
    let square = first * first + 2.0 * (last - first) * cycles / length;
    let time = 2.0 * cycles / (first + square.max(0.0).sqrt());
    if time.is_finite() { time.clamp(0.0, length) } else { length }
}

/// The inputs between which the last step went, and its length, s.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
pub(super) struct LastStep {
    from: Inputs,
    to: Inputs,
    length: f64,
}

impl LastStep {
    /// Rates of the inputs along it; 0 where it had no length.
    pub(super) fn rates(&self) -> Inputs {
        if self.length > 0.0 { self.to.rates(&self.from, self.length) } else { Inputs::ZERO }
    }

    /// Frequency, Hz, and amplitude, m, at its end.
    pub(super) fn cycles(&self) -> (f64, f64) {
        if self.length > 0.0 { (self.to.frequency, self.to.displacement_amplitude) } else { (0.0, 0.0) }
    }
}

/// One contact under the importer's control.
#[derive(Default)]
pub(super) struct Model {
    staged: Staged,
    /// None while it has to be built from the settings.
    contact: Option<Body>,
}

/// A requested step, with everything on which its success depends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Attempt {
    point: f64,
    length: f64,
    inputs: Inputs,
    slopes: Option<Inputs>,
    friction_coefficient: f64,
    wear_coefficients: [f64; 2],
}

/// A copy of a model.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct SavedModel {
    staged: Staged,
    contact: Option<SavedBody>,
}

impl Model {
    /// What has been set.
    pub(super) fn staged(&mut self) -> &mut Staged {
        &mut self.staged
    }

    /// The parameters, to change one; the contact will be built again.
    pub(super) fn change_settings(&mut self) -> &mut Settings {
        self.contact = None;
        self.staged.started = false;
        &mut self.staged.settings
    }

    /// The tunable parameters, to change one; the contact takes it over with the next step.
    pub(super) fn tune(&mut self) -> &mut Settings {
        if !self.staged.initialized {
            return self.change_settings();
        }
        self.staged.retune = true;
        &mut self.staged.settings
    }

    /// The inputs, to change one.
    pub(super) fn change_inputs(&mut self) -> &mut Inputs {
        self.staged.started &= self.staged.initialized;
        &mut self.staged.inputs
    }

    /// Whether initialization is over.
    pub(super) fn is_initialized(&self) -> bool {
        self.staged.initialized
    }

    /// Whether the contact has still to be brought to its initial state.
    #[inline]
    pub(super) fn has_to_start(&self) -> bool {
        !self.staged.started
    }

    /// The contact in its present state. During initialization that is the start which follows from
    /// what has been set so far.
    #[inline]
    pub(super) fn contact(&mut self, resources: &Resources) -> Checked<&Body> {
        if !self.staged.started {
            self.start(resources)?;
        }
        Ok(self.contact.as_ref().expect("a started contact has been built"))
    }

    #[cold]
    fn start(&mut self, resources: &Resources) -> Checked {
        let Self { staged: Staged { settings, inputs, started, .. }, contact } = self;
        // Dropped where it cannot start, so that a profile file that has been corrected is read
        // again.
        let built = match contact.take() {
            Some(contact) => contact,
            None => build(settings, resources)?,
        };
        *contact = Some(press(built, settings, inputs)?);
        *started = true;
        Ok(())
    }

    /// The contact as it would begin now with other settings.
    pub(super) fn beginning_with(&self, settings: &Settings, resources: &Resources) -> Checked<Body> {
        press(build(settings, resources)?, settings, &self.staged.inputs)
    }

    /// The contact as far as it has been built, and what has been set.
    pub(super) fn parts(&mut self) -> (Option<&Body>, &mut Staged) {
        (self.contact.as_ref(), &mut self.staged)
    }

    /// Ends the initialization.
    pub(super) fn begin(&mut self, resources: &Resources) -> Checked<&Body> {
        self.contact(resources)?;
        self.staged.initialized = true;
        self.staged.last_step.to = self.staged.inputs;
        self.contact(resources)
    }

    /// A step of `length`, s, from `point`, s, as it would be done now.
    pub(super) fn attempt(&self, point: f64, length: f64) -> Attempt {
        let Staged { settings, inputs, slopes, .. } = &self.staged;
        let friction_coefficient = settings.friction_coefficient;
        let wear_coefficients = settings.wear_coefficients();
        Attempt { point, length, inputs: *inputs, slopes: *slopes, friction_coefficient, wear_coefficients }
    }

    /// One step of `length`, s, at whose end the clock is `end`.
    pub(super) fn step(&mut self, end: Clock, length: f64) -> Checked {
        let Self { staged, contact } = self;
        let from = &staged.inputs;
        let moved = staged.slopes.as_ref().map(|slopes| from.after(slopes, length));
        let to = moved.as_ref().unwrap_or(from);
        let contact =
            contact.as_mut().expect("initialization builds the contact, and nothing discards it later");
        let cycles_before = contact.cycles_on_coating();
        let advanced = if staged.retune {
            staged.retune_and_advance(contact, to, length)
        } else {
            staged.advance(contact, to, length)
        };
        if let Err(problem) = advanced {
            return Err(staged.refuse_step(to, length, problem));
        }
        if staged.worn_through_at.is_none() && contact.is_known_worn_through() {
            let time = match contact.cycles_to_wear_through() {
                Some(life) => {
                    let frequencies = (from.frequency, to.frequency);
                    staged.clock.time() + time_of_cycles(life - cycles_before, frequencies, length)
                }
                None => end.time(),
            };
            staged.worn_through_at = Some(time);
        }
        staged.retune = false;
        let last = &mut staged.last_step;
        (last.from, last.to, last.length) = (last.to, *to, length);
        staged.clock = end;
        if let Some(inputs) = moved {
            (staged.inputs, staged.slopes) = (inputs, None);
        }
        Ok(())
    }

    /// A copy of the present state.
    pub(super) fn save(&self) -> SavedModel {
        SavedModel { staged: self.staged.clone(), contact: self.contact.as_ref().map(Body::save) }
    }

    /// Back to a saved state. Keeps the engine where only its state differs.
    pub(super) fn restore(&mut self, saved: &SavedModel) -> Checked {
        let taken = match (&saved.contact, &mut self.contact) {
            (Some(saved), Some(contact)) => {
                contact.take(saved).map_err(|problem| engine("saved state", problem))?
            }
            _ => false,
        };
        if !taken {
            self.contact = saved.build()?;
        }
        self.staged = saved.staged.clone();
        Ok(())
    }
}

impl SavedModel {
    /// A model in this state that shares nothing with an earlier one.
    pub(super) fn revive(&self) -> Checked<Model> {
        Ok(Model { staged: self.staged.clone(), contact: self.build()? })
    }

    fn build(&self) -> Checked<Option<Body>> {
        let revive =
            |saved: &SavedBody| saved.revive(false).map_err(|problem| engine("saved state", problem));
        Ok(self.contact.as_ref().map(revive).transpose()?)
    }

    /// Refuses what no instance could have saved, `initialized` or before.
    pub(super) fn check(&self, initialized: bool) -> Checked {
        let refuse = |problem: &str| Err(Refusal::SerializedState(problem.into()).into());
        let Self { staged, contact } = self;
        check_settings(&staged.settings)?;
        for inputs in [&staged.inputs, &staged.last_step.from, &staged.last_step.to] {
            check_inputs(inputs)?;
        }
        let slopes = staged.slopes.as_ref().is_none_or(Inputs::is_finite);
        let length = staged.last_step.length;
        let lengths = [length, staged.deepest_read].iter().all(|value| (0.0..f64::INFINITY).contains(value));
        let times = staged.worn_through_at.is_none_or(f64::is_finite);
        if !(slopes && staged.clock.is_sound() && lengths && times) {
            return refuse("its time, its derivatives or its wear depth are out of range");
        }
        if staged.initialized != initialized || (initialized && !staged.started) {
            return refuse("its progress contradicts its state");
        }
        let Some(body) = contact else {
            return if staged.started { refuse("it has no contact") } else { Ok(()) };
        };
        let parameters = body.parameters();
        if body.is_interface() == staged.settings.contacts_file.is_empty() {
            return refuse("its contacts are not those that it sets");
        }
        let mut settings = staged.settings.clone();
        if staged.retune {
            settings.friction_coefficient = parameters.friction_coefficient;
            settings.wear_coefficient = parameters.wear_coefficient;
            settings.wear_coefficient_2 = parameters.wear_coefficient_2;
        }
        if !settings.give(parameters) {
            return refuse("its contact has other parameters than it sets");
        }
        body.revive(true).map(drop).map_err(|problem| engine("serialised state", problem).into())
    }
}

fn build(settings: &Settings, resources: &Resources) -> Checked<Body> {
    let summits = settings.summits(resources)?;
    let body = Body::new(settings.parameters(resources)?, summits.as_deref());
    Ok(body.map_err(|problem| engine("start values", problem))?)
}

/// A contact brought to its initial state.
fn press(mut contact: Body, settings: &Settings, inputs: &Inputs) -> Checked<Body> {
    let (displacement, rotation) = match settings.loading() {
        Loading::Transient => (inputs.place(), inputs.rotation),
        Loading::Cyclic => ([0.0; 2], 0.0),
    };
    contact
        .start_at(inputs.normal(settings.normal_control()), displacement, rotation)
        .map_err(|problem| engine(&format!("start with {}", inputs.describe(settings)), problem))?;
    Ok(contact)
}

fn engine(context: &str, problem: Error) -> Refusal {
    Refusal::Engine { context: context.into(), problem }
}
