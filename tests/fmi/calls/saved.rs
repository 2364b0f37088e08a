//! Saved states: in memory and as bytes.

use super::Called;
use super::model::{Expected, Group, Model, Status};
use core::ptr::null_mut;
use fmi_sys::fmi2::{fmi2Component, fmi2FMUstate};
use fretting_contact::fmi2::exports::*;

/// Value references of all real outputs.
const OUTPUTS: [u32; 11] = [5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];

/// What was known when a state was saved.
#[derive(Clone, Copy)]
struct Known {
    model: Model,
    /// The outputs' bits, where they can be read.
    outputs: Option<[u64; 11]>,
}

/// A few places for states; some bytes that outlive the instance.
#[derive(Default)]
pub(crate) struct Slots {
    places: [Option<(fmi2FMUstate, Known)>; 3],
    /// A handle that has been freed.
    stale: usize,
    bytes: Option<(Vec<u8>, Known)>,
}

fn outputs(c: fmi2Component, model: &Model) -> Option<[u64; 11]> {
    let mut values = [0.0; 11];
    // SAFETY: the component is alive and the arrays have these lengths.
    let status = unsafe { fmi2GetReal(c, OUTPUTS.as_ptr(), OUTPUTS.len(), values.as_mut_ptr()) };
    let readable = model.gated(Group::Status, Expected::Ok) == Expected::Ok;
    assert!(!readable || status == 0, "outputs can be read after the initialization");
    readable.then(|| values.map(f64::to_bits))
}

// SAFETY of every call below: the component is alive, results have room, arrays have the lengths
// given; handles may be anything.
impl Slots {
    /// The states of the former instance are gone; the bytes are not.
    pub(crate) fn forget(&mut self) {
        *self = Self { bytes: self.bytes.take(), ..Self::default() };
    }

    /// A handle: of a place, or null, stale or made up.
    fn handle(&self, index: usize) -> (fmi2FMUstate, Option<&Known>) {
        let raw = match index % 6 {
            place @ 0..=2 => self.places[place].as_ref().map_or(null_mut(), |(handle, _)| *handle),
            3 => null_mut(),
            4 => core::ptr::without_provenance_mut(self.stale),
            _ => core::ptr::without_provenance_mut(0x10),
        };
        let found = self.places.iter().flatten().find(|(handle, _)| *handle == raw);
        (raw, found.map(|(_, known)| known))
    }

    pub(crate) fn save(&mut self, c: fmi2Component, model: &Model, index: usize) -> Called {
        let place = index % 3;
        let mut handle = self.places[place].as_ref().map_or(null_mut(), |(handle, _)| *handle);
        // SAFETY: see above.
        let status = unsafe { fmi2GetFMUstate(c, &raw mut handle) };
        if status == 0 {
            let known = Known { model: *model, outputs: outputs(c, model) };
            self.places[place] = Some((handle, known));
        }
        (status, Expected::Ok)
    }

    /// The model after it, where it has to be another.
    pub(crate) fn restore(
        &mut self,
        c: fmi2Component,
        _: &Model,
        index: usize,
    ) -> (Status, Expected, Option<Model>) {
        let (handle, known) = self.handle(index);
        // SAFETY: see above.
        let status = unsafe { fmi2SetFMUstate(c, handle) };
        let Some(known) = known else { return (status, Expected::Error, None) };
        if status == 0 {
            assert_eq!(outputs(c, &known.model), known.outputs, "a rollback gives the same bits");
        }
        (status, Expected::Ok, Some(known.model))
    }

    pub(crate) fn free(&mut self, c: fmi2Component, index: usize) -> Called {
        let (mut handle, known) = self.handle(index);
        let expected = if known.is_some() || handle.is_null() { Expected::Ok } else { Expected::Error };
        let freed = handle;
        // SAFETY: see above.
        let status = unsafe { fmi2FreeFMUstate(c, &raw mut handle) };
        if status == 0 && !freed.is_null() {
            assert!(handle.is_null());
            self.stale = freed.addr();
            for place in &mut self.places {
                place.take_if(|(handle, _)| *handle == freed);
            }
        }
        (status, expected)
    }

    pub(crate) fn serialize(&mut self, c: fmi2Component, index: usize) -> Called {
        let (handle, known) = self.handle(index);
        let known = known.copied();
        let mut size = 0;
        // SAFETY: see above.
        let status = unsafe { fmi2SerializedFMUstateSize(c, handle, &raw mut size) };
        let Some(known) = known else { return (status, Expected::Error) };
        let mut bytes = vec![0u8; size];
        // SAFETY: see above.
        unsafe {
            assert_eq!(fmi2SerializeFMUstate(c, handle, bytes.as_mut_ptr().cast(), size + 1), 3);
            assert_eq!(fmi2SerializeFMUstate(c, handle, bytes.as_mut_ptr().cast(), size), 0);
        }
        self.bytes = Some((bytes, known));
        (status, Expected::Ok)
    }

    /// Takes the bytes back as a state, whole or with one of them changed.
    pub(crate) fn deserialize(&mut self, c: fmi2Component, index: usize, mode: u8, place: f64) -> Called {
        let Some((bytes, known)) = &self.bytes else { return (0, Expected::Ok) };
        let spoiled = mode & 1 != 0;
        let mut bytes = bytes.clone();
        if spoiled {
            let at = place.to_bits() as usize % bytes.len() + (place.to_bits() >> 32) as usize % bytes.len();
            let length = bytes.len();
            bytes[at % length] ^= 1 << (mode >> 5);
        }
        let mut handle = null_mut();
        // SAFETY: see above.
        let status =
            unsafe { fmi2DeSerializeFMUstate(c, bytes.as_ptr().cast(), bytes.len(), &raw mut handle) };
        if spoiled {
            return (status, Expected::Error);
        }
        if status == 0 {
            let known = Known { model: known.model.serialized(), ..*known };
            if let Some((mut former, _)) = self.places[index % 3].replace((handle, known)) {
                // SAFETY: see above.
                assert_eq!(unsafe { fmi2FreeFMUstate(c, &raw mut former) }, 0);
            }
        }
        (status, Expected::Ok)
    }
}
