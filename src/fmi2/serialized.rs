//! Saved states as bytes that any instance of the same FMU can take, in this process or another.
//!
//! A fixed header, then the state: magic number, version of this format, GUID of the FMU, length of what follows and its
//! CRC-32, numbers with the least byte first. The bytes are not trusted: a checksum that fits says nothing about who made
//! it, so that everything in a state is checked before a handle is given out, down to whether the springs obey friction.

use super::GUID;
use super::refusal::{Checked, Refusal};
use super::saved::Saved;

const MAGIC: [u8; 8] = *b"FRETSTAT";
/// To be raised with every change of what is saved.
const VERSION: u32 = 2;
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
