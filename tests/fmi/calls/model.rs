//! The state machine of FMI 2.0 for co-simulation, as an importer relies on it: what a call has to
//! return, and what it leaves behind. It is written from the standard and knows nothing of the code
//! under test but its variable table; of the physics it says only which calls may refuse a scene.

use fretting_contact::fmi2::variables::{DataType, Start, Variable, variables};
use std::sync::LazyLock;

/// Number of inputs.
const INPUTS: usize = 7;

/// The variables that are texts.
const TEXTS: [&str; 2] = ["profile_file", "contacts_file"];

/// Room for the variables that are not fields.
const ROOM: usize = 64;

/// References of the variables that are not fields.
pub(crate) static NAMED: LazyLock<Vec<u32>> = LazyLock::new(|| {
    let named = |(_, variable): &(u32, &Variable)| variable.causality() != "local";
    let list: Vec<u32> = (0..).zip(variables()).filter(named).map(|(reference, _)| reference).collect();
    assert!(list.len() <= ROOM);
    list
});

/// References of the inputs.
static INPUT: LazyLock<[u32; INPUTS]> = LazyLock::new(|| {
    let list: Vec<u32> = NAMED.iter().copied().filter(|&reference| is_input(reference)).collect();
    list.try_into().expect("INPUTS is their number")
});

/// Whether it is an input.
pub(crate) fn is_input(reference: u32) -> bool {
    variable(reference).is_some_and(|variable| variable.causality() == "input")
}

/// Where a variable that is no field has its value.
fn slot(reference: u32) -> usize {
    NAMED.binary_search(&reference).expect("it is no field")
}

/// A status: 0 fmi2OK, 1 fmi2Warning, 2 fmi2Discard, 3 fmi2Error.
pub(crate) type Status = u32;

/// What a call may return.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Expected {
    Ok,
    Error,
    Discard,
    /// The scene may be refused: fmi2OK or fmi2Error, also fmi2Warning where it is the end of the
    /// initialization.
    Scene,
    /// The contact may not be able to do the step: fmi2OK or fmi2Discard.
    Step,
}

impl Expected {
    pub(crate) fn admits(self, status: Status) -> bool {
        match self {
            Self::Ok => status == 0,
            Self::Error => status == 3,
            Self::Discard => status == 2,
            Self::Scene => matches!(status, 0 | 1 | 3),
            Self::Step => matches!(status, 0 | 2),
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum State {
    Instantiated,
    Initialization,
    Step,
    Terminated,
}

use State::{Initialization, Instantiated, Step, Terminated};

/// Groups of functions that the standard allows in the same states.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Group {
    /// fmi2SetupExperiment, fmi2EnterInitializationMode.
    Setup,
    /// fmi2ExitInitializationMode.
    Exit,
    /// fmi2DoStep, fmi2Terminate.
    Step,
    /// The getters and fmi2GetDirectionalDerivative.
    Get,
    /// The setters and fmi2SetRealInputDerivatives.
    Set,
    /// fmi2GetRealOutputDerivatives and the statuses.
    Status,
    /// fmi2CancelStep, as steps are synchronous.
    Never,
}

/// Times are the same to this, relative to the larger of the time and the longest step: the promise
/// of the FMU.
const SAME_TIME: f64 = 1e-9;

/// Or to this, relative to the step.
const SAME_OF_STEP: f64 = 1e-3;

/// What an importer knows of an instance.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Model {
    pub(crate) state: State,
    /// By place; the start value, or NaN where the model computes it.
    reals: [f64; ROOM],
    integers: [i32; ROOM],
    /// In the order of [`TEXTS`].
    texts: [&'static str; 2],
    slopes: [f64; INPUTS],
    pub(crate) time: f64,
    stop: Option<f64>,
    longest: f64,
    /// The last step that had a length.
    last: f64,
    pub(crate) last_step: Status,
    discarded: Option<Attempt>,
}

/// A step that has been asked for, with all that has been set.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Attempt {
    point: f64,
    length: f64,
    /// Of inputs and parameters: the bits of what the model computes are not known and stay what
    /// they are.
    reals: [u64; ROOM],
    slopes: [f64; INPUTS],
}

fn variable(reference: u32) -> Option<&'static Variable> {
    variables().get(reference as usize)
}

/// The reference of a variable.
pub(crate) fn reference(name: &str) -> u32 {
    variables().iter().position(|variable| variable.name == name).expect("it is a variable") as u32
}

/// Whether it is an output that is a Real.
pub(crate) fn is_real_output(reference: u32) -> bool {
    variable(reference).is_some_and(|v| v.causality() == "output" && v.data_type.name() == "Real")
}

fn is(reference: u32, name: &str) -> bool {
    variable(reference).is_some_and(|variable| variable.name == name)
}

/// An instance as fmi2Instantiate makes it.
static NEW: LazyLock<Model> = LazyLock::new(|| {
    let starts: Vec<_> = NAMED.iter().map(|&reference| variables()[reference as usize].start()).collect();
    let real = |k: usize| if let Some(Some(Start::Real(x))) = starts.get(k) { *x } else { f64::NAN };
    let integer = |k: usize| if let Some(Some(Start::Integer(x))) = starts.get(k) { *x } else { 0 };
    Model {
        state: Instantiated,
        reals: core::array::from_fn(real),
        integers: core::array::from_fn(integer),
        texts: [""; 2],
        slopes: [0.0; INPUTS],
        time: 0.0,
        stop: None,
        longest: 0.0,
        last: 0.0,
        last_step: 0,
        discarded: None,
    }
});

/// Whether the importer sets it, so that it has a value that is known.
fn is_set(variable: &Variable) -> bool {
    matches!(variable.causality(), "input" | "parameter")
}

impl Model {
    pub(crate) fn new() -> Self {
        *NEW
    }

    /// Whether the state allows a function.
    pub(crate) fn allows(&self, group: Group) -> bool {
        match group {
            Group::Setup => self.state == Instantiated,
            Group::Exit => self.state == Initialization,
            Group::Step => self.state == Step,
            Group::Get => self.state != Instantiated,
            Group::Set => self.state != Terminated,
            Group::Status => matches!(self.state, Step | Terminated),
            Group::Never => false,
        }
    }

    /// `expected` where the function is allowed.
    pub(crate) fn gated(&self, group: Group, expected: Expected) -> Expected {
        if self.allows(group) { expected } else { Expected::Error }
    }

    fn initialized(&self) -> bool {
        matches!(self.state, Step | Terminated)
    }

    /// What a computed value may meet: before the end of the initialization a scene that cannot be.
    pub(crate) fn computes(&self) -> Expected {
        if self.initialized() { Expected::Ok } else { Expected::Scene }
    }

    pub(crate) fn value(&self, name: &str) -> f64 {
        self.reals[slot(reference(name))]
    }

    pub(crate) fn number(&self, name: &str) -> i32 {
        self.integers[slot(reference(name))]
    }

    /// The value that a getter has to give, where the importer has set it.
    pub(crate) fn known_real(&self, reference: u32) -> Option<f64> {
        variable(reference).filter(|v| is_set(v)).map(|_| self.reals[slot(reference)])
    }
    pub(crate) fn known_integer(&self, reference: u32) -> Option<i32> {
        variable(reference).filter(|v| is_set(v)).map(|_| self.integers[slot(reference)])
    }
    pub(crate) fn known_text(&self, reference: u32) -> &str {
        TEXTS.iter().position(|name| is(reference, name)).map_or("", |k| self.texts[k])
    }

    pub(crate) fn get(&self, references: &[u32], kinds: &[&str]) -> Expected {
        let fits = |&r: &u32| variable(r).is_some_and(|v| kinds.contains(&v.data_type.name()));
        if !references.iter().all(fits) {
            return Expected::Error;
        }
        let computed = |&r: &u32| variable(r).is_some_and(|v| !is_set(v));
        let depth = if references.iter().any(computed) { self.computes() } else { Expected::Ok };
        self.gated(Group::Get, depth)
    }

    /// Whether outputs have derivatives with respect to it: an input or, in initialization mode, a
    /// Real parameter.
    pub(crate) fn is_known(&self, reference: u32) -> bool {
        let parameter = |v: &Variable| v.causality() == "parameter" && v.data_type.name() == "Real";
        is_input(reference) || !self.initialized() && variable(reference).is_some_and(parameter)
    }

    /// Whether the importer may set this variable now.
    fn writable(&self, variable: &Variable) -> bool {
        match (variable.causality(), variable.variability()) {
            ("input", _) | ("parameter", "tunable") => true,
            ("parameter", _) => !self.initialized(),
            _ => false,
        }
    }

    pub(crate) fn set_reals(&mut self, references: &[u32], values: &[f64]) -> Expected {
        let fits = |(&r, &value): (&u32, &f64)| {
            let Some(v) = variable(r) else { return false };
            let DataType::Real { range, .. } = &v.data_type else { return false };
            let switched = v.variability() == "tunable"
                && self.initialized()
                && (value == 0.0) != (self.reals[slot(r)] == 0.0);
            self.writable(v) && range.contains(value) && !switched
        };
        let good = self.allows(Group::Set) && references.iter().zip(values).all(fits);
        if good {
            for (&r, &value) in references.iter().zip(values) {
                self.reals[slot(r)] = value;
            }
        }
        if good { Expected::Ok } else { Expected::Error }
    }

    pub(crate) fn set_integers(&mut self, references: &[u32], values: &[i32]) -> Expected {
        let fits = |(&r, &value): (&u32, &i32)| {
            let Some(v) = variable(r) else { return false };
            let range = match &v.data_type {
                DataType::Integer { min, max } => *min..=*max,
                DataType::Enumeration(enumeration) => 1..=enumeration.items.len() as i32,
                _ => return false,
            };
            self.writable(v) && range.contains(&value)
        };
        let good = self.allows(Group::Set) && references.iter().zip(values).all(fits);
        if good {
            for (&r, &value) in references.iter().zip(values) {
                self.integers[slot(r)] = value;
            }
        }
        if good { Expected::Ok } else { Expected::Error }
    }

    pub(crate) fn set_text(&mut self, reference: u32, value: Option<&'static str>) -> Expected {
        let which = TEXTS.iter().position(|name| is(reference, name));
        let good = self.allows(Group::Set) && !self.initialized();
        match (value, which) {
            (Some(text), Some(which)) if good => {
                self.texts[which] = text;
                Expected::Ok
            }
            _ => Expected::Error,
        }
    }

    pub(crate) fn set_slope(&mut self, reference: u32, order: i32, value: f64) -> Expected {
        let Some(input) = INPUT.iter().position(|&input| input == reference) else { return Expected::Error };
        if !(self.allows(Group::Set) && order == 1 && value.is_finite()) {
            return Expected::Error;
        }
        self.slopes[input] = value;
        Expected::Ok
    }

    pub(crate) fn setup(&mut self, tolerance: Option<f64>, start: f64, stop: Option<f64>) -> Expected {
        let good = tolerance.is_none_or(|t| t > 0.0 && t.is_finite())
            && start.is_finite()
            && stop.is_none_or(|stop| stop >= start && stop.is_finite());
        if !(good && self.allows(Group::Setup)) {
            return Expected::Error;
        }
        (self.time, self.stop, self.longest, self.last) = (start, stop, 0.0, 0.0);
        Expected::Ok
    }

    /// Inputs at the end of a step of `length`.
    fn targets(&self, length: f64) -> [f64; INPUTS] {
        let moves = self.slopes.iter().any(|slope| *slope != 0.0);
        core::array::from_fn(|k| {
            let value = self.reals[slot(INPUT[k])];
            if moves { value + self.slopes[k] * length } else { value }
        })
    }

    /// fmi2DoStep: what it may return. The step itself is taken by [`Self::stepped`].
    pub(crate) fn step(&mut self, point: f64, length: f64) -> Expected {
        if !self.allows(Group::Step) {
            return Expected::Error;
        }
        let slack = |time: f64| {
            let of_time = SAME_TIME * time.abs().max(length).max(self.longest);
            of_time.max(SAME_OF_STEP * length.max(self.last))
        };
        let end = point + length;
        let in_range = |(&reference, &target): (&u32, &f64)| match variable(reference).map(|v| &v.data_type) {
            Some(DataType::Real { range, .. }) => range.contains(target),
            _ => false,
        };
        let good = length >= 0.0
            && length.is_finite()
            && (point == self.time || (point - self.time).abs() <= slack(point))
            && end.is_finite()
            && self.stop.is_none_or(|stop| end <= stop + slack(stop))
            && INPUT.iter().zip(&self.targets(length)).all(in_range);
        // a discarded step that is asked for again with nothing changed ends the run
        let repeated = self.discarded.is_some_and(|discarded| discarded == self.attempt(point, length));
        if !good || repeated {
            self.last_step = 3;
            return Expected::Error;
        }
        Expected::Step
    }

    fn attempt(&self, point: f64, length: f64) -> Attempt {
        // 0 is 0, whatever its sign
        let reals = self.reals.map(|value| (value + 0.0).to_bits());
        Attempt { point, length, reals, slopes: self.slopes }
    }

    /// As it is in a serialised state, which has no stop time.
    pub(crate) fn serialized(self) -> Self {
        Self { stop: None, ..self }
    }

    /// After fmi2SetFMUstate in an instance that was in another state: its own stop time holds for
    /// a run that has begun.
    pub(crate) fn restored(&mut self, state: Self) {
        let stop = if state.state == Instantiated { state.stop } else { self.stop };
        *self = Self { stop, discarded: None, ..state };
    }

    /// After a step that was allowed.
    pub(crate) fn stepped(&mut self, status: Status, point: f64, length: f64) {
        self.last_step = status;
        self.discarded = (status == 2).then(|| self.attempt(point, length));
        if status == 0 {
            let targets = self.targets(length);
            INPUT.iter().zip(targets).for_each(|(&input, target)| self.reals[slot(input)] = target);
            self.slopes.fill(0.0);
            self.time = point + length;
            self.longest = self.longest.max(length);
            self.last = if length > 0.0 { length } else { self.last };
        }
    }
}
