//! The levels of a backlog and their hinges, each in one array: there are many backlogs, and few
//! hinges at each level.

use super::{Bins, CANCELLED, Hinge};
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// Slip under one indentation depth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::wear) struct Level {
    pub(in crate::wear) bin: i32,
    /// Number of hinges.
    hinges: u32,
    /// Σ ∫ e dx, m².
    pub(in crate::wear) slip: f64,
    /// Σ d ∫ e dx, m³.
    pub(super) moment: f64,
    /// Slip of a spring at the reference depth, m, as the innermost springs go on.
    pub(super) constant: f64,
    /// dE/dg of the innermost springs.
    pub(super) slope: f64,
}

/// Levels in the order of their bins.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(from = "Vec<SavedLevel>", into = "Vec<SavedLevel>")]
pub(super) struct Levels {
    levels: Vec<Level>,
    /// Those of all levels in turn, at each in the order of their bins.
    hinges: Vec<Hinge>,
}

/// A level in a saved state.
#[derive(Serialize, Deserialize)]
#[serde(rename = "Level")]
struct SavedLevel {
    bin: i64,
    slip: f64,
    moment: f64,
    constant: f64,
    slope: f64,
    hinges: Vec<Hinge>,
}

impl From<Vec<SavedLevel>> for Levels {
    fn from(saved: Vec<SavedLevel>) -> Self {
        let mut levels = Self::default();
        for SavedLevel { bin, slip, moment, constant, slope, hinges } in saved {
            // a number beyond all bins is refused with the state
            let bin = i32::try_from(bin).unwrap_or(i32::MAX);
            let level = Level { slip, moment, constant, slope, ..Level::new(bin) };
            levels.insert(levels.len(), level, &hinges);
        }
        levels
    }
}

impl From<Levels> for Vec<SavedLevel> {
    fn from(levels: Levels) -> Self {
        let saved = |(level, hinges): (&Level, &[Hinge])| {
            let Level { bin, slip, moment, constant, slope, .. } = *level;
            SavedLevel { bin: bin.into(), slip, moment, constant, slope, hinges: hinges.to_vec() }
        };
        levels.iter().map(saved).collect()
    }
}

impl Level {
    pub(super) fn new(bin: i32) -> Self {
        Self { bin, hinges: 0, slip: 0.0, moment: 0.0, constant: 0.0, slope: 0.0 }
    }
}

impl Levels {
    pub(super) fn len(&self) -> usize {
        self.levels.len()
    }

    pub(super) fn is_empty(&self) -> bool {
        self.levels.is_empty()
    }

    /// The levels, each with its hinges.
    pub(super) fn iter(&self) -> impl Iterator<Item = (&Level, &[Hinge])> {
        let mut others = &self.hinges[..];
        self.levels.iter().map(move |level| {
            let (own, rest) = others.split_at(level.hinges as usize);
            others = rest;
            (level, own)
        })
    }

    /// Place of a bin, or where it would be.
    pub(super) fn find(&self, bin: i32) -> Result<usize, usize> {
        self.levels.binary_search_by_key(&bin, |level| level.bin)
    }

    /// The level in a place, to be changed.
    pub(super) fn level(&mut self, place: usize) -> LevelMut<'_> {
        let first = self.hinges_of(place).start;
        LevelMut { level: &mut self.levels[place], first, hinges: &mut self.hinges }
    }

    /// Places of the hinges of a level.
    fn hinges_of(&self, place: usize) -> Range<usize> {
        let first = self.levels[..place].iter().map(|level| level.hinges as usize).sum();
        first..first + self.levels.get(place).map_or(0, |level| level.hinges as usize)
    }

    /// Puts a level with its hinges in a place, before those from there on.
    pub(super) fn insert(&mut self, place: usize, level: Level, hinges: &[Hinge]) {
        let first = self.hinges_of(place).start;
        // no room that may stay empty
        self.levels.reserve_exact(1);
        self.levels.insert(place, Level { hinges: hinges.len() as u32, ..level });
        self.hinges.reserve_exact(hinges.len());
        self.hinges.splice(first..first, hinges.iter().copied());
    }

    /// Becomes a copy of other levels in its own memory.
    pub(super) fn copy_from(&mut self, other: &Self) {
        self.levels.clone_from(&other.levels);
        self.hinges.clone_from(&other.hinges);
    }
}

/// A level and its hinges, to be changed.
pub(super) struct LevelMut<'a> {
    pub(super) level: &'a mut Level,
    /// Place of its first hinge.
    first: usize,
    /// Those of all levels.
    hinges: &'a mut Vec<Hinge>,
}

impl LevelMut<'_> {
    /// Adds a hinge, a slope that begins at a place (m), in its bin.
    pub(super) fn add_hinge(&mut self, slope: f64, place: f64, bins: Bins) {
        if slope == 0.0 {
            return;
        }
        let new = Hinge { slope, place };
        let bin = bins.of(&new);
        let own = &self.hinges[self.first..self.first + self.level.hinges as usize];
        let start = self.first + own.partition_point(|hinge| bins.of(hinge) < bin);
        let others = self.hinges[start..self.first + own.len()].iter();
        let others = others.take_while(|hinge| bins.of(hinge) == bin).count();
        let mut end = start + others;
        match &mut self.hinges[start..end] {
            [same] if same.place == place => same.slope += slope,
            [first, between @ .., last] => {
                for hinge in between.iter().chain([&new]) {
                    let (low, middle, high) = if hinge.place < first.place {
                        (*hinge, *first, *last)
                    } else if hinge.place > last.place {
                        (*first, *last, *hinge)
                    } else {
                        (*first, *hinge, *last)
                    };
                    let share = (middle.place - low.place) / (high.place - low.place);
                    *first = Hinge { slope: low.slope + (1.0 - share) * middle.slope, ..low };
                    *last = Hinge { slope: high.slope + share * middle.slope, ..high };
                }
                // of those that the edge has passed
                self.hinges.drain(start + 1..end - 1);
                self.level.hinges -= (others - 2) as u32;
                end = start + 2;
            }
            others => {
                let place = start + others.partition_point(|hinge| hinge.place < place);
                self.hinges.reserve_exact(1);
                self.hinges.insert(place, new);
                self.level.hinges += 1;
                return;
            }
        }
        // a knot of the springs bends what slips one way, and unbends it on the way back
        for place in (start..end).rev() {
            if self.hinges[place].slope.abs() <= CANCELLED * slope.abs() {
                self.hinges.remove(place);
                self.level.hinges -= 1;
            }
        }
    }
}
