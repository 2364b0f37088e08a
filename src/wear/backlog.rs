//! Slip gathered since the profile last changed, in one dimension.
//!
//! Springs with the same image g have the same history, so slip is a function of g. What it wears
//! depends besides on the pressure under which it happens, so on the indentation depth. The backlog
//! keeps, for each of a few depths, the slip path E(g) as a constant, a slope and *hinges* C (g −
//! g_c)₊, all of which a straight line in (load, displacement) adds to in a few operations. Hinges
//! are gathered in bins that are narrow next to the contact edge and keep their sum and their mean
//! place, so a repeated motion stays exact, and the slip of a stroke does not depend on the steps
//! that it is made of.

mod levels;

use super::{Mixture, Sliding, per_disc};
use crate::friction::SlipPiece;
use crate::surface::{Contact, ROUNDING};
use levels::{Level, Levels};
use serde::{Deserialize, Serialize};
use std::mem::{replace, take};

/// Leading bits of the mantissa that tell two bins of one octave apart, for depths and for places
/// of hinges: there are eight. See `docs/decisions/wear_backlog.md`.
const BITS: u32 = 3;

/// And of places where the body has moved in the plane: 32. On an orbit the slip of a line rises
/// like a square root behind its front, by many hinges.
const BITS_IN_PLANE: u32 = 5;

/// Most bins in the range of a double.
const MOST_BINS: i64 = 2048 << BITS_IN_PLANE;

/// Share of the depth at first slip below which all depths have one bin: slip there wears little.
const LEAST_DEPTH: f64 = 0.125;

/// Bin of a length in the range of a double: bins grow with the length.
fn bin_of_length(length: f64, bits: u32) -> i64 {
    (length.abs().to_bits() >> (f64::MANTISSA_DIGITS - 1 - bits)) as i64
}

/// Bin of a depth over the tip, of which that at first slip is `reference`, m.
fn bin_of_depth(depth: f64, reference: f64) -> i32 {
    let bin = |length: f64| bin_of_length(length, BITS);
    (bin(depth) - bin(LEAST_DEPTH * reference)).max(0) as i32
}

/// Bins of the places of hinges.
#[derive(Debug, Clone, Copy)]
struct Bins {
    /// Place of the contact edge, m. Beyond it, where there is no pressure, is one bin.
    edge: f64,
    bits: u32,
}

impl Bins {
    fn of(self, hinge: &Hinge) -> i64 {
        let place = hinge.place;
        if place < self.edge {
            i64::MIN
        } else if place < 0.0 {
            -bin_of_length(place, self.bits)
        } else {
            bin_of_length(place, self.bits)
        }
    }
}

/// A hinge, or one of two at the ends of the range of several in one bin: their slopes have the sum
/// Σ C and the moment Σ C y of all.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Hinge {
    /// C.
    slope: f64,
    /// y = reference − g, m.
    place: f64,
}

/// Slip and friction work since the last profile update.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct WearBacklog {
    /// Depth at the first slip, m: images are counted from here.
    reference: f64,
    /// Whether its slip is that of motion in the plane.
    in_plane: bool,
    levels: Levels,
    /// Friction work, J.
    pub(crate) work: f64,
    /// The same, of each line over π a² d of its larger contact, Pa.
    pub(crate) work_density: f64,
    /// Largest contact radius, m.
    pub(crate) radius: f64,
}

/// A motion that repeats at constant load, and how much of it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct RepeatedMotion {
    pub(crate) sliding: Sliding,
    /// Where the cycles are of several amplitudes.
    pub(crate) mixture: Option<Mixture>,
    /// Cycles or metres, as its kind has it.
    pub(crate) amount: f64,
}

impl RepeatedMotion {
    /// An amount of one kind of sliding.
    pub(crate) fn of(sliding: Sliding, amount: f64) -> Self {
        Self { sliding, mixture: None, amount }
    }
}

/// Relative difference of two places of hinges, or of two slips, that are taken for one.
pub(crate) const SAME: f64 = 1e-6;

/// Most by which the image at the contact edge may differ from the depth by rounding, where a worn
/// body is steep.
const ROUNDING_OF_EDGE: f64 = 1e-9;

/// Share of the largest slope below which a sum of slopes is the rounding of those that cancel.
const CANCELLED: f64 = 1e-10;

impl WearBacklog {
    pub(crate) fn is_empty(&self) -> bool {
        self.levels.is_empty()
    }

    /// Becomes a copy of another backlog in its own memory.
    pub(crate) fn copy_from(&mut self, other: &Self) {
        let mut levels = take(&mut self.levels);
        levels.copy_from(&other.levels);
        *self = Self { levels, ..*other };
    }

    /// Whether all slip was under one depth (m).
    pub(crate) fn is_at(&self, depth: f64) -> bool {
        self.levels.len() <= 1 && self.is_near(depth, SAME * depth.abs())
    }

    /// Whether the depths of all slip differ from one (m) by some length at most, m.
    pub(crate) fn is_near(&self, depth: f64, most: f64) -> bool {
        self.levels().all(|(level, _)| (level.moment - depth * level.slip).abs() <= most * level.slip)
    }

    /// Numbers that a backlog can have.
    pub(crate) fn is_sound(&self) -> bool {
        let amount = |value: f64| value >= 0.0 && value.is_finite();
        fn rises(mut bins: impl Iterator<Item = i32>) -> bool {
            let mut last = i32::MIN;
            bins.all(|bin| replace(&mut last, bin) < bin)
        }
        let level = |(level, hinges): (&Level, &[Hinge])| {
            let numbers = [level.moment, level.constant, level.slope];
            amount(level.slip)
                && level.slip > 0.0
                && numbers.iter().all(|value| value.is_finite())
                && i64::from(level.bin).abs() < MOST_BINS
                && hinges.len() < MOST_BINS as usize
                && hinges.windows(2).all(|pair| pair[0].place < pair[1].place)
                && hinges.iter().all(|hinge| hinge.slope.is_finite() && hinge.place.is_finite())
        };
        amount(self.work)
            && (self.work == 0.0 || !self.levels.is_empty())
            && amount(self.work_density)
            && amount(self.radius)
            && self.reference.is_finite()
            && self.levels.len() < MOST_BINS as usize
            && rises(self.levels().map(|(level, _)| level.bin))
            && self.levels().all(level)
    }

    /// Adds the slip of a straight line between two contacts and its friction work, J, where there
    /// was slip. `overlap_moment` is ∫ (d − g) e dx with d at the instant at which a spring
    /// slips, m³, which is the work over 2μE*; `tip` is the image at the axis, m. The first line of
    /// a backlog says whether its motion is `in_plane`.
    pub(crate) fn record(
        &mut self,
        pieces: &[SlipPiece],
        (work, overlap_moment): (f64, f64),
        (from, to): (&Contact, &Contact),
        (tip, in_plane): (f64, bool),
    ) {
        let slip: f64 = pieces.iter().map(|piece| piece.integral).sum();
        if slip.is_nan() || slip <= 0.0 {
            return;
        }
        self.work += work;
        self.work_density += per_disc(work, if from.load > to.load { from } else { to });
        let depth = if from.depth == to.depth {
            to.depth
        } else {
            let image: f64 = pieces.iter().map(|piece| piece.image.0 * piece.integral + piece.moment).sum();
            ((image + overlap_moment) / slip).clamp(from.depth.min(to.depth), from.depth.max(to.depth))
        };
        self.radius = self.radius.max(from.radius).max(to.radius);
        if self.levels.is_empty() {
            self.reference = to.depth.max(from.depth);
            self.in_plane = in_plane;
        }
        let reference = self.reference;
        let bits = self.bits();
        let index = bin_of_depth(depth - tip, reference - tip);
        let at = self.levels.find(index).unwrap_or_else(|place| {
            self.levels.insert(place, Level::new(index), &[]);
            place
        });
        let mut at_depth = self.levels.level(at);
        at_depth.level.slip += slip;
        at_depth.level.moment += slip * depth;
        let bins = Bins { edge: at_depth.level.edge(reference), bits };
        // the slope of E between knots, and the hinges where it changes
        let (mut slope, mut end) = (0.0, f64::NEG_INFINITY);
        let size = (reference - tip).abs();
        let flat = 1e-13 * size;
        // where the depth hardly changes, the slip of springs that touch or leave drops to zero in
        // a band as narrow as that change: beside its slope other hinges would pass for rounding
        let stays = (to.depth - from.depth).abs() <= SAME * size;
        let edge = if stays { to.depth.min(from.depth) - ROUNDING_OF_EDGE * size } else { f64::INFINITY };
        for (k, piece) in pieces.iter().take_while(|piece| piece.image.0 < edge).enumerate() {
            let ((g0, g1), (e0, e1)) = (piece.image, piece.slip);
            let next = if g1 - g0 > flat { (e1 - e0) / (g1 - g0) } else { 0.0 };
            // springs at the tip that stick, as all of a flat do, are a front
            if k == 0 && g0 <= tip + flat && e0 > 0.0 {
                at_depth.level.constant += e0 + next * (reference - g0);
                at_depth.level.slope += next;
            } else {
                if k > 0 && g0 > end + flat {
                    at_depth.add_hinge(-slope, reference - end, bins);
                    slope = 0.0;
                }
                at_depth.add_hinge(next - slope, reference - g0, bins);
            }
            (slope, end) = (next, g1);
        }
        if !stays {
            at_depth.add_hinge(-slope, reference - end, bins);
        }
    }

    /// The slip path under each depth, m, as functions of g.
    pub(crate) fn law(&self) -> Vec<SlipAtDepth> {
        let mut law = vec![SlipAtDepth::default(); self.levels.len()];
        law.iter_mut().zip(self.levels()).for_each(|(law, level)| self.law_into(level, law));
        law
    }

    /// Image of the innermost spring that has slipped, m.
    pub(crate) fn front(&self) -> f64 {
        let front = |(level, hinges): (&Level, &[Hinge])| {
            let rounding = level.rounding(hinges);
            let innermost = hinges.iter().rfind(|hinge| hinge.slope.abs() > rounding);
            let place = innermost.map_or(0.0, |hinge| hinge.place);
            let core = level.constant.abs().max(level.slope.abs() * place);
            if core > rounding * place { f64::NEG_INFINITY } else { self.reference - place }
        };
        self.levels().map(front).fold(f64::INFINITY, f64::min)
    }

    /// The levels, each with its hinges.
    pub(super) fn levels(&self) -> impl Iterator<Item = (&Level, &[Hinge])> {
        self.levels.iter()
    }

    /// The slip path under one depth, in memory that is there.
    pub(super) fn law_into(&self, (level, hinges): (&Level, &[Hinge]), law: &mut SlipAtDepth) {
        let bins = Bins { edge: level.edge(self.reference), bits: self.bits() };
        level.law_into((hinges, bins), self.reference, law);
    }

    /// Leading bits that tell its bins apart.
    fn bits(&self) -> u32 {
        if self.in_plane { BITS_IN_PLANE } else { BITS }
    }
}

impl Level {
    /// Mean depth of its slip, m.
    fn depth(&self) -> f64 {
        self.moment / self.slip
    }

    /// Slope that is rounding, as what strokes that cancel leave in their bins.
    fn rounding(&self, hinges: &[Hinge]) -> f64 {
        CANCELLED * hinges.iter().map(|hinge| hinge.slope.abs()).fold(self.slope.abs(), f64::max)
    }

    /// Place of the contact edge under that depth, m.
    fn edge(&self, reference: f64) -> f64 {
        reference - self.depth()
    }

    fn law_into(&self, (hinges, bins): (&[Hinge], Bins), reference: f64, law: &mut SlipAtDepth) {
        let knots = &mut law.knots;
        knots.clear();
        let rounding = self.rounding(hinges);
        for ends in hinges.chunk_by(|a, b| bins.of(a) == bins.of(b)) {
            if let [low, high] = ends {
                let sum = low.slope + high.slope;
                let mean = low.place + high.slope / sum * (high.place - low.place);
                let slack = SAME * low.place.abs().max(high.place.abs());
                if sum.abs() > rounding && mean >= low.place - slack && mean <= high.place + slack {
                    knots.push((reference - mean.clamp(low.place, high.place), sum, 0.0));
                    continue;
                }
            }
            // slopes that nearly cancel have no place of their own
            let ends = ends.iter().filter(|hinge| hinge.slope.abs() > rounding);
            knots.extend(ends.map(|hinge| (reference - hinge.place, hinge.slope, 0.0)));
        }
        knots.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        let (mut slope, mut offset) = (self.slope, self.constant - self.slope * reference);
        law.first = (slope, offset);
        for knot in knots {
            slope += knot.1;
            offset -= knot.1 * knot.0;
            (knot.1, knot.2) = (slope, offset);
        }
        law.depth = self.depth();
        law.find_rounding();
    }
}

/// The slip path of springs under one indentation depth, piecewise linear in g.
#[derive(Debug, Clone, Default)]
pub(crate) struct SlipAtDepth {
    /// m.
    pub(crate) depth: f64,
    /// Slip that is rounding, m.
    least: f64,
    /// Slope and value at g = 0 before the first knot.
    first: (f64, f64),
    /// Place, and slope and value at g = 0 behind it.
    knots: Vec<(f64, f64, f64)>,
}

impl SlipAtDepth {
    /// Slip path of the springs of an image and its slope there, m and 1.
    pub(crate) fn at(&self, image: f64) -> (f64, f64) {
        self.behind(self.knots.partition_point(|knot| knot.0 < image), image)
    }

    /// Slip paths of the springs of images that hardly ever fall, m.
    pub(crate) fn along(&self, images: impl Iterator<Item = f64>) -> impl Iterator<Item = f64> {
        let mut above = 0;
        images.map(move |image| {
            while above < self.knots.len() && self.knots[above].0 < image {
                above += 1;
            }
            while above > 0 && self.knots[above - 1].0 >= image {
                above -= 1;
            }
            self.behind(above, image).0
        })
    }

    /// [`Self::at`] where so many knots are below the image.
    fn behind(&self, above: usize, image: f64) -> (f64, f64) {
        let (slope, offset) = match above {
            0 => self.first,
            k => (self.knots[k - 1].1, self.knots[k - 1].2),
        };
        let slip = offset + slope * image;
        // a spring at the front slips by the rounding of its place
        if slip > self.least { (slip, slope) } else { (0.0, 0.0) }
    }

    fn new(depth: f64, first: (f64, f64), knots: Vec<(f64, f64, f64)>) -> Self {
        let mut law = Self { depth, least: 0.0, first, knots };
        law.find_rounding();
        law
    }

    fn find_rounding(&mut self) {
        let largest = self.knots.iter().map(|knot| knot.2.abs()).fold(self.first.1.abs(), f64::max);
        self.least = ROUNDING * largest;
    }

    /// Cycles of an amplitude U₀, E = 4N (U₀ − m (d − g))₊, or sliding onward, E = s, under a depth
    /// d, m.
    pub(crate) fn of_motion(sliding: Sliding, amount: f64, depth: f64, bound_slope: f64) -> Self {
        match sliding {
            Sliding::Onward => Self::new(depth, (0.0, amount), Vec::new()),
            Sliding::Cycles(amplitude) => {
                let front = depth - amplitude / bound_slope;
                let slope = 4.0 * amount * bound_slope;
                Self::new(depth, (0.0, 0.0), vec![(front, slope, -slope * front)])
            }
        }
    }

    /// The motion at one load that makes this law: sliding onward, or cycles of which each hinge is
    /// the front of one amplitude. There are so many that cycles of the largest would slip as much
    /// at the contact edge. `None` where a core slips as in no cycles: evenly beside others that do
    /// not, or less further out.
    pub(crate) fn motion(&self, bound_slope: f64) -> Option<RepeatedMotion> {
        let (slope, whole) = (self.first.0, self.at(self.depth).0);
        let inside = |(place, _): &(f64, f64)| *place < self.depth;
        let rounding = SAME * whole;
        if self.first.1 > self.least && slope * self.depth <= rounding {
            let is_even =
                -slope * self.depth <= rounding && !self.knots.iter().any(|knot| knot.0 < self.depth);
            return is_even.then(|| RepeatedMotion::of(Sliding::Onward, whole));
        }
        let fronts = self.rises().map(|(place, rise)| {
            // all of a core that slips has its front where the line through it is 0
            let place = if place.is_finite() { place } else { -self.first.1 / slope };
            (place, rise)
        });
        let fronts: Vec<(f64, f64)> = fronts.filter(|(_, rise)| *rise != 0.0).filter(inside).collect();
        let innermost = fronts.iter().map(|front| front.0).fold(self.depth, f64::min);
        let amplitude = bound_slope * (self.depth - innermost);
        let amount = whole / (4.0 * amplitude);
        if !(amount > 0.0 && amount.is_finite()) {
            return None;
        }
        let share = |(place, rise): &(f64, f64)| {
            (rise / (4.0 * amount * bound_slope), bound_slope * (self.depth - place))
        };
        let mixture = (fronts.len() > 1).then(|| fronts.iter().map(share).collect());
        Some(RepeatedMotion { sliding: Sliding::Cycles(amplitude), mixture, amount })
    }

    /// Images (m) from which on its slope is larger, and by how much.
    pub(super) fn rises(&self) -> impl Iterator<Item = (f64, f64)> {
        let mut last = 0.0;
        let slopes = [(f64::NEG_INFINITY, self.first.0)].into_iter();
        let slopes = slopes.chain(self.knots.iter().map(|knot| (knot.0, knot.1)));
        slopes.map(move |(image, slope)| (image, slope - replace(&mut last, slope)))
    }

    /// Image of the innermost spring that slips, m.
    pub(crate) fn front(&self) -> f64 {
        let inmost = self.knots.first().map_or(f64::INFINITY, |knot| knot.0);
        // what is rounding is no slip of the core
        let core_slips = [0.0, inmost.min(self.depth)].iter().any(|image| self.behind(0, *image).0 > 0.0);
        if core_slips { f64::NEG_INFINITY } else { inmost }
    }
}

#[cfg(test)]
mod tests;
