//! Saved states as bytes that any instance of the same FMU can take, in this process or another.
//!
//! A fixed header, then the state: magic number, version of this format, GUID of the FMU, length of
//! what follows and its CRC-32, numbers with the least byte first. The bytes are not trusted: a
//! correct checksum does not prove who made it, so that everything in a state is checked
//! before a handle is given out, down to whether the springs obey friction.

use super::GUID;
use super::refusal::{Checked, Refusal};
use super::saved::Saved;

const MAGIC: [u8; 8] = *b"FRETSTAT";
/// To be raised with every change of what is saved.
const VERSION: u32 = 16;
/// Magic number, version, GUID, length, checksum.
const HEADER: usize = MAGIC.len() + 4 + GUID.len() + 8 + 4;

/// The bytes of a state.
pub(super) fn encode(saved: &Saved) -> Checked<Vec<u8>> {
    let content = postcard::to_stdvec(saved).map_err(|reason| refuse(&format!("{reason}")))?;
    let mut bytes = Vec::with_capacity(HEADER + content.len());
    bytes.extend(MAGIC);
    bytes.extend(VERSION.to_le_bytes());
    bytes.extend(GUID.as_bytes());
    bytes.extend((content.len() as u64).to_le_bytes());
    bytes.extend(crc32fast::hash(&content).to_le_bytes());
    bytes.extend(content);
    Ok(bytes)
}

/// The state in some bytes.
pub(super) fn decode(bytes: &[u8]) -> Checked<Saved> {
    let mut rest = bytes;
    let mut take = |count: usize| {
        let (part, others) =
            rest.split_at_checked(count).ok_or_else(|| refuse("it ends within its header"))?;
        rest = others;
        Ok::<_, Box<Refusal>>(part)
    };
    if take(MAGIC.len())? != MAGIC {
        return Err(refuse("it does not begin like one: was it made by fmi2SerializeFMUstate?"));
    }
    let version = number(take(4)?);
    if version != u64::from(VERSION) {
        return Err(refuse(&format!("it is of format {version}, this FMU reads format {VERSION}")));
    }
    if take(GUID.len())? != GUID.as_bytes() {
        return Err(refuse("it was made by another version of the FMU"));
    }
    let length = number(take(8)?);
    let checksum = number(take(4)?);
    if length != rest.len() as u64 {
        return Err(refuse(&format!("{length} bytes should follow its header, there are {}", rest.len())));
    }
    if checksum != u64::from(crc32fast::hash(rest)) {
        return Err(refuse("its checksum does not fit: bytes have changed"));
    }
    let (saved, remains) =
        postcard::take_from_bytes::<Saved>(rest).map_err(|reason| refuse(&format!("{reason}")))?;
    if !remains.is_empty() {
        return Err(refuse("more follows than a state"));
    }
    saved.check()?;
    Ok(saved)
}

fn number(bytes: &[u8]) -> u64 {
    bytes.iter().rev().fold(0, |value, byte| value << 8 | u64::from(*byte))
}

fn refuse(problem: &str) -> Box<Refusal> {
    Refusal::SerializedState(problem.into()).into()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fmi2::component::Component;
    use crate::fmi2::logger::Logger;
    use serde_json::{Value, json};
    use std::ffi::CString;

    /// A state with a part changed and a checksum that fits, as only a forger would make it: after
    /// `begin`, behind a rig, since JSON has no infinite stiffness.
    fn forged(begin: bool, place: &str, value: Value) -> String {
        let logger = Logger::new(None, CString::default(), false);
        let mut component = Component::new(logger, None);
        component.model.change_settings().rig_stiffness = 1e9;
        if begin {
            component.enter_initialization_mode().unwrap();
            component.exit_initialization_mode().unwrap();
        }
        let handle = component.save(core::ptr::null_mut()).unwrap();
        let sound = decode(&component.serialize(handle).unwrap()).unwrap();
        let mut changed = serde_json::to_value(&sound).unwrap();
        decode(&encode(&serde_json::from_value(changed.clone()).unwrap()).unwrap()).unwrap();
        *changed.pointer_mut(place).expect(place) = value;
        let bytes = encode(&serde_json::from_value(changed).unwrap()).unwrap();
        match decode(&bytes) {
            Err(refusal) => refusal.to_string(),
            Ok(_) => panic!("{place}: taken"),
        }
    }

    #[test]
    fn what_no_instance_could_have_saved_is_refused() {
        let settings = |name: &str| format!("/model/staged/settings/{name}");
        for (begin, place, value, text) in [
            (false, "/state".to_owned(), json!("Failed"), "failed instance"),
            (false, settings("profile_file"), json!([0xff]), "not UTF-8"),
            (false, settings("profile"), json!(9), "give one of"),
            (false, settings("radius"), json!(-1.0), "radius"),
            (false, "/model/staged/started".to_owned(), json!(true), "no contact"),
            (false, "/model/staged/last_step/length".to_owned(), json!(-1.0), "out of range"),
            (true, "/state".to_owned(), json!("Instantiated"), "contradicts its state"),
            (true, settings("profile"), json!(7), "other parameters"),
            (true, settings("radius"), json!(0.02), "other parameters"),
            (true, "/model/staged/inputs/frequency".to_owned(), json!(-1.0), "frequency"),
        ] {
            let message = forged(begin, &place, value);
            assert!(message.contains(text), "{place}: {message}");
        }
    }
}
