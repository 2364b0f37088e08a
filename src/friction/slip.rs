//! What a row of springs has slipped along a path.

use super::interval::Interval;
use crate::surface::Place;

/// The slip of the springs between two places, linear in the image g.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SlipPiece {
    /// Images of the inner and the outer end, m.
    pub(crate) image: (f64, f64),
    /// Slip of the inner and the outer end, m ≥ 0.
    pub(crate) slip: (f64, f64),
    /// ∫ e dx, m².
    pub(crate) integral: f64,
    /// ∫ (g − g_inner) e dx, m³.
    pub(crate) moment: f64,
}

impl SlipPiece {
    pub(super) fn over((inner, outer): (&Place, &Place), slip: (f64, f64)) -> Self {
        let interval = Interval::between(inner, outer);
        Self {
            image: (inner.image, outer.image),
            slip,
            integral: interval.linear(slip.0, slip.1),
            moment: interval.product((0.0, interval.rise), slip),
        }
    }
}

#[cfg(test)]
impl SlipPiece {
    /// ∫ (d − g) e dx under a depth d, m³.
    pub(crate) fn overlap_moment(&self, depth: f64) -> f64 {
        (depth - self.image.0) * self.integral - self.moment
    }
}
