//! Which function may be called in which state: the co-simulation state machine of FMI 2.0 as data.
//!
//! Steps are synchronous and a refused step changes nothing, so the standard's states "step in
//! progress", "step failed" and "step canceled" do not occur; its state "error" is
//! [`State::Failed`].

use super::refusal::{Checked, Refusal};
use super::status::State::{self, Failed, InitializationMode, Instantiated, StepComplete, Terminated};

/// One C function that acts on an instance.
#[derive(Debug)]
pub(super) struct Call {
    pub(super) name: &'static str,
    allowed: &'static [State],
    /// `allowed` as a set of bits.
    mask: u8,
}

impl Call {
    const fn new(name: &'static str, allowed: &'static [State]) -> Self {
        let mut mask = 0;
        let mut i = 0;
        while i < allowed.len() {
            mask |= bit(allowed[i]);
            i += 1;
        }
        Self { name, allowed, mask }
    }

    /// The one gate.
    #[inline]
    pub(super) fn check(&self, state: State) -> Checked {
        if self.mask & bit(state) != 0 { Ok(()) } else { self.refuse(state) }
    }

    #[cold]
    fn refuse(&self, state: State) -> Checked {
        Err(Refusal::OutOfOrder { state, allowed: self.allowed }.into())
    }
}

const fn bit(state: State) -> u8 {
    1 << state as u8
}

macro_rules! calls {
    ($($constant:ident = $name:ident in [$($state:ident),*];)*) => {
        $(pub(super) const $constant: Call = Call::new(stringify!($name), &[$($state),*]);)*

        /// Every one of them.
        #[cfg(test)]
        pub(super) const ALL: &[Call] = &[$($constant),*];
    };
}

calls! {
    SET_DEBUG_LOGGING = fmi2SetDebugLogging in [Instantiated, InitializationMode, StepComplete, Terminated, Failed];
    SETUP_EXPERIMENT = fmi2SetupExperiment in [Instantiated];
    ENTER_INITIALIZATION_MODE = fmi2EnterInitializationMode in [Instantiated];
    EXIT_INITIALIZATION_MODE = fmi2ExitInitializationMode in [InitializationMode];
    TERMINATE = fmi2Terminate in [StepComplete];
    RESET = fmi2Reset in [Instantiated, InitializationMode, StepComplete, Terminated, Failed];

    GET_REAL = fmi2GetReal in [InitializationMode, StepComplete, Terminated];
    GET_INTEGER = fmi2GetInteger in [InitializationMode, StepComplete, Terminated];
    GET_BOOLEAN = fmi2GetBoolean in [InitializationMode, StepComplete, Terminated];
    GET_STRING = fmi2GetString in [InitializationMode, StepComplete, Terminated];
    SET_REAL = fmi2SetReal in [Instantiated, InitializationMode, StepComplete];
    SET_INTEGER = fmi2SetInteger in [Instantiated, InitializationMode, StepComplete];
    SET_BOOLEAN = fmi2SetBoolean in [Instantiated, InitializationMode, StepComplete];
    SET_STRING = fmi2SetString in [Instantiated, InitializationMode, StepComplete];

    GET_FMU_STATE = fmi2GetFMUstate in [Instantiated, InitializationMode, StepComplete, Terminated];
    SET_FMU_STATE = fmi2SetFMUstate in [Instantiated, InitializationMode, StepComplete, Terminated, Failed];
    FREE_FMU_STATE = fmi2FreeFMUstate in [Instantiated, InitializationMode, StepComplete, Terminated, Failed];
    SERIALIZED_FMU_STATE_SIZE = fmi2SerializedFMUstateSize
        in [Instantiated, InitializationMode, StepComplete, Terminated];
    SERIALIZE_FMU_STATE = fmi2SerializeFMUstate in [Instantiated, InitializationMode, StepComplete, Terminated];
    DE_SERIALIZE_FMU_STATE = fmi2DeSerializeFMUstate in [Instantiated, InitializationMode, StepComplete, Terminated];
    GET_DIRECTIONAL_DERIVATIVE = fmi2GetDirectionalDerivative in [InitializationMode, StepComplete, Terminated];

    SET_REAL_INPUT_DERIVATIVES = fmi2SetRealInputDerivatives in [Instantiated, InitializationMode, StepComplete];
    GET_REAL_OUTPUT_DERIVATIVES = fmi2GetRealOutputDerivatives in [StepComplete, Terminated];
    DO_STEP = fmi2DoStep in [StepComplete];
    // Only a step in progress can be cancelled, and here none ever is.
    CANCEL_STEP = fmi2CancelStep in [];
    GET_STATUS = fmi2GetStatus in [StepComplete, Terminated];
    GET_REAL_STATUS = fmi2GetRealStatus in [StepComplete, Terminated];
    GET_INTEGER_STATUS = fmi2GetIntegerStatus in [StepComplete, Terminated];
    GET_BOOLEAN_STATUS = fmi2GetBooleanStatus in [StepComplete, Terminated];
    GET_STRING_STATUS = fmi2GetStringStatus in [StepComplete, Terminated];
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of all sets of states: a call is let through in those and in no other, and the refusal names
    /// them.
    #[test]
    fn the_gate_lets_through_what_is_in_its_list() {
        const STATES: [State; 5] = [Instantiated, InitializationMode, StepComplete, Terminated, Failed];
        for set in 0..1 << STATES.len() {
            let allowed: Vec<State> = STATES
                .into_iter()
                .enumerate()
                .filter(|(k, _)| set & 1 << k != 0)
                .map(|(_, state)| state)
                .collect();
            let call = Call::new("fmi2Something", Vec::leak(allowed.clone()));
            for state in STATES {
                match call.check(state) {
                    Ok(()) => assert!(allowed.contains(&state)),
                    Err(refusal) => {
                        let message = refusal.to_string();
                        assert!(
                            !allowed.contains(&state) && message.contains(&state.to_string()),
                            "{message}"
                        );
                        assert!(
                            allowed.iter().all(|state| message.contains(&format!("{state}"))),
                            "{message}"
                        );
                    }
                }
            }
        }
    }
}
