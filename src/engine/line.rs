//! A straight line in load and displacement.

use nalgebra::Vector2;

/// A load (the controlled quantity) and a place, m.
pub(super) type Point = (f64, Vector2<f64>);

/// A straight line between two of them.
pub(in crate::engine) struct Line {
    pub(super) from: Point,
    pub(super) to: Point,
    /// The shares of a whole line from and up to which this is a part of it.
    part: (f64, f64),
}

impl Line {
    pub(super) fn new(from: Point, to: Point) -> Self {
        Self { from, to, part: (0.0, 1.0) }
    }

    /// The share of the whole line at one of this part of it.
    pub(super) fn of_whole(&self, share: f64) -> f64 {
        let (from, to) = self.part;
        if share == 1.0 { to } else { from + share * (to - from) }
    }

    /// The point at a share of the line; at 1 the end to the bit.
    pub(super) fn at_share(&self, share: f64) -> Point {
        if share == 1.0 {
            return self.to;
        }
        let mix = |a: f64, b: f64| if a == b { a } else { a + share * (b - a) };
        (mix(self.from.0, self.to.0), self.from.1.zip_map(&self.to.1, mix))
    }

    /// The share of point k of n that are even in the square root of the control (0 where the
    /// control is negative).
    pub(super) fn root_share(&self, k: u32, n: u32) -> f64 {
        let (from, to) = (self.from.0, self.to.0);
        let share = f64::from(k) / f64::from(n);
        if k == n || from == to {
            return share;
        }
        let (low, high) = (from.max(0.0).sqrt(), to.max(0.0).sqrt());
        let root = low + share * (high - low);
        ((root * root - from) / (to - from)).clamp(0.0, 1.0)
    }

    /// The line in two where the control crosses `level`, else whole.
    pub(super) fn split_at(&self, level: f64) -> [Option<Line>; 2] {
        let (c0, c1) = (self.from.0 - level, self.to.0 - level);
        if c0 * c1 >= 0.0 {
            return [Some(Line { ..*self }), None];
        }
        let share = c0 / (c0 - c1);
        let middle = (level, self.from.1 + share * (self.to.1 - self.from.1));
        let half = |from, to, part| Some(Line { from, to, part });
        let (first, cut, last) = (self.part.0, self.of_whole(share), self.part.1);
        [half(self.from, middle, (first, cut)), half(middle, self.to, (cut, last))]
    }
}
