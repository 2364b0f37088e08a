//! What springs have slipped over a stretch of the history, for wear.

use super::PlanarRow;
use super::spring::{Moved, Vector, along, difference, dot, norm, scaled, sum};
use crate::friction::interval::Interval;
use serde::{Deserialize, Serialize};

/// The slip of one spring over a stretch.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Slip {
    /// Origin at the start of the stretch, m.
    pub(super) start: Vector,
    /// ∫u |de|, m².
    pub(super) pull: Vector,
    /// Work of friction over the stiffness, ∫|u| |de|, m².
    pub(super) work: f64,
    /// ∫|de|, m.
    pub(super) path: f64,
}

impl Slip {
    pub(super) fn starting(origin: Vector) -> Self {
        Self { start: origin, pull: [0.0; 2], work: 0.0, path: 0.0 }
    }

    /// Whether these are numbers that springs could have slipped by.
    pub(super) fn is_sound(&self) -> bool {
        let amount = |value: f64| value >= 0.0 && value.is_finite();
        let [x, y] = self.pull;
        self.start.iter().all(|part| part.is_finite())
            && amount(self.work)
            && amount(self.path)
            && amount(x.hypot(y))
    }

    /// With one more line, on which the origin went by `moved`. While it turned, u pointed along that in the mean.
    pub(super) fn and(&self, line: &Moved, moved: Vector) -> Self {
        let work = line.mean_bound * line.slip;
        if work == 0.0 {
            return *self;
        }
        Self {
            start: self.start,
            pull: sum(self.pull, along(moved, work)),
            work: self.work + work,
            path: self.path + line.slip,
        }
    }

    /// The work that mean deflection and whole slip make of the stretch, m²: all of it where it went one way.
    pub(super) fn work_one_way(&self, origin: Vector) -> f64 {
        if self.path > 0.0 { dot(self.pull, difference(origin, self.start)) / self.path } else { 0.0 }
    }

    pub(super) fn between(&self, other: &Self, share: f64) -> Self {
        let mix = |a: f64, b: f64| a + share * (b - a);
        let mix2 = |a: Vector, b: Vector| [mix(a[0], b[0]), mix(a[1], b[1])];
        Self {
            start: mix2(self.start, other.start),
            pull: mix2(self.pull, other.pull),
            work: mix(self.work, other.work),
            path: mix(self.path, other.path),
        }
    }
}

/// Deflections that pull over a stretch and slip of the springs at given radii, by components, m.
#[derive(Debug, Clone, Default)]
pub(crate) struct Fields {
    pub(crate) deflection: [Vec<f64>; 2],
    pub(crate) slip: [Vec<f64>; 2],
}

impl PlanarRow {
    /// Starts to count slip anew, or ends it.
    pub(crate) fn count_slip(&mut self, counts: bool) {
        self.slips.clear();
        if counts {
            self.slips.extend(self.knots.iter().map(|knot| Slip::starting(knot.origin)));
        }
    }

    /// Goes on with the count of a row whose springs these are, moved since without slip that counts.
    pub(crate) fn count_slip_of(&mut self, other: &Self) {
        let mut j = 0;
        self.slips.clear();
        for knot in &self.knots {
            while j + 1 < other.knots.len() && other.knots[j + 1].place.x <= knot.place.x {
                j += 1;
            }
            let mut slip = Slip::starting(knot.origin);
            if let (Some(before), Some(counted)) = (other.knots.get(j), other.slips.get(j)) {
                let next = other.knots.get(j + 1).zip(other.slips.get(j + 1));
                let (share, next) = match next {
                    Some((next, slip)) => {
                        let share = (knot.place.x - before.place.x) / (next.place.x - before.place.x);
                        (share.clamp(0.0, 1.0), (next.origin, *slip))
                    }
                    None => (0.0, (before.origin, *counted)),
                };
                let mix = |k: usize| before.origin[k] + share * (next.0[k] - before.origin[k]);
                slip = counted.between(&next.1, share);
                let slipped = difference([mix(0), mix(1)], slip.start);
                slip.start = difference(knot.origin, slipped);
            }
            self.slips.push(slip);
        }
    }

    /// Share of the stretch's work that is found in its mean deflections and whole slips: 1 − φ²/12 of springs that turn evenly by φ.
    pub(crate) fn one_way(&self) -> f64 {
        let (mut found, mut work) = (0.0, 0.0);
        for (pair, slips) in self.knots.windows(2).zip(self.slips.windows(2)) {
            if slips[0].work == 0.0 && slips[1].work == 0.0 {
                continue;
            }
            let interval = Interval::between(&pair[0].place, &pair[1].place);
            let one_way = |i: usize| slips[i].work_one_way(pair[i].origin);
            found += interval.linear(one_way(0), one_way(1));
            work += interval.linear(slips[0].work, slips[1].work);
        }
        if work > 0.0 { found / work } else { 1.0 }
    }

    /// Fields of the stretch at rising radii. Springs out of contact have gone along with the body, by `moved`.
    pub(crate) fn fields(&self, radii: &[f64], displacement: Vector, moved: Vector) -> Fields {
        let mut fields = Fields::default();
        let mut j = 0;
        for &x in radii {
            while j + 1 < self.knots.len() && self.knots[j + 1].place.x <= x {
                j += 1;
            }
            let (deflection, slip) = match (self.knots.get(j), self.slips.get(j)) {
                (Some(knot), Some(slip)) if knot.place.x == x => {
                    let now = difference(displacement, knot.origin);
                    let mean = if slip.path > 0.0 { scaled(slip.pull, 1.0 / slip.path) } else { now };
                    (mean, difference(knot.origin, slip.start))
                }
                (Some(knot), Some(slip)) if j + 1 < self.knots.len() => {
                    let next = &self.knots[j + 1];
                    let share = (x - knot.place.x) / (next.place.x - knot.place.x);
                    let slip = slip.between(&self.slips[j + 1], share);
                    let mix = |k: usize| knot.origin[k] + share * (next.origin[k] - knot.origin[k]);
                    let origin = [mix(0), mix(1)];
                    let now = difference(displacement, origin);
                    let mean = if slip.path > 0.0 { scaled(slip.pull, 1.0 / slip.path) } else { now };
                    (mean, difference(origin, slip.start))
                }
                _ => ([0.0; 2], moved),
            };
            for k in 0..2 {
                fields.deflection[k].push(deflection[k]);
                fields.slip[k].push(slip[k]);
            }
        }
        fields
    }

    /// Radius of the sample so many behind the first that has slipped, m.
    pub(crate) fn innermost_slip(&self, behind: usize) -> f64 {
        let first = self.slips.iter().position(|slip| slip.path > 0.0);
        first.and_then(|first| self.knots.get(first + behind)).map_or(f64::INFINITY, |knot| knot.place.x)
    }

    /// Whether springs have slipped since the count began.
    pub(crate) fn has_slipped(&self) -> bool {
        self.slips.iter().any(|slip| slip.path > 0.0 && norm(slip.pull) > 0.0)
    }
}
