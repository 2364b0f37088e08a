//! A straight line in load and displacement.

use nalgebra::Vector2;

/// A load (the controlled quantity) and a place, m.
pub(super) type Point = (f64, Vector2<f64>);

/// A straight line between two of them.
pub(super) struct Line {
    pub(super) from: Point,
    pub(super) to: Point,
}

impl Line {
    /// Point k of n; the last is the end to the bit.
    pub(super) fn at(&self, k: u32, n: u32) -> Point {
        if k == n {
            return self.to;
        }
        let share = f64::from(k) / f64::from(n);
        let mix = |a: f64, b: f64| if a == b { a } else { a + share * (b - a) };
        (mix(self.from.0, self.to.0), self.from.1.zip_map(&self.to.1, mix))
    }

    /// Point k of n that are even in the square root of the control (0 where the control is
    /// negative); the last is the end to the bit.
    pub(super) fn at_root(&self, k: u32, n: u32) -> Point {
        let (from, to) = (self.from.0, self.to.0);
        if k == n || from == to {
            return self.at(k, n);
        }
        let share = f64::from(k) / f64::from(n);
        let (low, high) = (from.max(0.0).sqrt(), to.max(0.0).sqrt());
        let root = low + share * (high - low);
        let share = ((root * root - from) / (to - from)).clamp(0.0, 1.0);
        (root * root, self.from.1 + share * (self.to.1 - self.from.1))
    }

    /// The line in two where the control crosses `level`, else whole.
    pub(super) fn split_at(&self, level: f64) -> [Option<Line>; 2] {
        let (c0, c1) = (self.from.0 - level, self.to.0 - level);
        if c0 * c1 >= 0.0 {
            return [Some(Line { from: self.from, to: self.to }), None];
        }
        let share = c0 / (c0 - c1);
        let middle = (level, self.from.1 + share * (self.to.1 - self.from.1));
        [Some(Line { from: self.from, to: middle }), Some(Line { from: middle, to: self.to })]
    }
}
