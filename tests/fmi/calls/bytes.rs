//! Bytes as calls: records of eight of which every one means something, so that a generator or a
//! fuzzer can make and shrink them.

use super::model::{Model, NAMED};
use fretting_contact::fmi2::variables::{DataType, variables};

/// Reference of the first field.
const FIELDS: u32 = 35;

/// One call: what it is, and what its arguments are taken from.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Record(pub(crate) [u8; 8]);

/// Shares of a start or nominal value, and values that are not one.
const SHARES: [f64; 16] = [
    1.0,
    0.0,
    -1.0,
    0.3,
    3.0,
    0.01,
    10.0,
    -2.5,
    1e6,
    1e-9,
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    1e300,
    f64::MIN_POSITIVE,
    1.000_000_1,
];

const LENGTHS: [f64; 8] = [0.1, 1.0, 0.0, 1e-3, 1e-12, 1e9, -1.0, f64::NAN];
const INTEGERS: [i32; 8] = [1, 2, 3, 4, 5, 6, 7, 8];
const ODD_INTEGERS: [i32; 8] = [0, -1, 9, 12, 16, 512, 513, i32::MAX];

impl Record {
    pub(crate) fn kind(self) -> u8 {
        self.0[0]
    }
    pub(crate) fn target(self) -> u8 {
        self.0[1]
    }
    pub(crate) fn mode(self) -> u8 {
        self.0[2]
    }
    pub(crate) fn index(self) -> usize {
        self.0[3].into()
    }
    /// Any number that the upper half of a double can hold.
    pub(crate) fn raw(self) -> f64 {
        let [.., a, b, c, d] = self.0;
        f64::from_bits(u64::from(u32::from_le_bytes([a, b, c, d])) << 32)
    }
    fn tail(self, k: usize) -> usize {
        self.0[4 + k % 4].into()
    }

    /// One to three variables.
    pub(crate) fn references(self) -> Vec<u32> {
        let count = 1 + usize::from(self.mode() >> 6) % 3;
        (0..count).map(|k| reference(self.target().wrapping_add((k * 5) as u8))).collect()
    }

    /// Values for them: shares of what is usual, or anything.
    pub(crate) fn reals(self, references: &[u32]) -> Vec<f64> {
        let one = |(k, &reference): (usize, &u32)| {
            let raw = self.mode() & 1 != 0;
            if raw { self.raw() } else { usual(reference) * SHARES[(self.index() + k) % SHARES.len()] }
        };
        references.iter().enumerate().map(one).collect()
    }

    pub(crate) fn integers(self, count: usize) -> Vec<i32> {
        let list = if self.mode() & 1 != 0 { ODD_INTEGERS } else { INTEGERS };
        (0..count).map(|k| list[(self.index() + k) % list.len()]).collect()
    }

    /// A communication point, mostly the right one, and a step from it.
    pub(crate) fn step(self, model: &Model) -> (f64, f64) {
        let point = match self.mode() % 8 {
            0 => self.raw(),
            1 => model.time * (1.0 + 1e-12),
            2 => model.time + 1e-3,
            _ => model.time,
        };
        let length = if self.mode() & 64 != 0 { self.raw() } else { LENGTHS[self.index() % LENGTHS.len()] };
        (point, length)
    }

    /// Start and stop time of an experiment, and its tolerance.
    pub(crate) fn experiment(self) -> (f64, Option<f64>, Option<f64>) {
        let start = if self.mode() & 1 != 0 { self.raw() } else { 0.0 };
        let stop = (self.mode() & 2 != 0).then(|| start + LENGTHS[self.index() % LENGTHS.len()]);
        let tolerance = (self.mode() & 4 != 0).then(|| SHARES[self.tail(0) % SHARES.len()]);
        (start, stop, tolerance)
    }
}

/// Variables that are not fields mostly, sometimes a field or none at all.
fn reference(target: u8) -> u32 {
    match usize::from(target) {
        named @ 0..=209 => NAMED[named % NAMED.len()],
        field @ 210..=249 => FIELDS + (field as u32 - 210) * 8,
        250..=252 => variables().len() as u32,
        _ => u32::MAX,
    }
}

/// A value of usual size for a variable.
fn usual(reference: u32) -> f64 {
    let Some(variable) = variables().get(reference as usize) else { return 1.0 };
    let start = Model::new().known_real(reference).unwrap_or(0.0);
    match &variable.data_type {
        DataType::Real { nominal: Some(nominal), .. } if start == 0.0 => *nominal,
        _ if start == 0.0 || start.is_nan() => 1.0,
        _ => start,
    }
}
