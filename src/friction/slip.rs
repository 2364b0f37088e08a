//! What a row of springs has slipped along a path.

use super::interval::Interval;

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
    /// The slip over an interval between two images.
    pub(super) fn over(image: (f64, f64), slip: (f64, f64), interval: &Interval) -> Self {
        let integral = interval.linear(slip.0, slip.1);
        Self { image, slip, integral, moment: interval.product((0.0, interval.rise), slip) }
    }

    /// The same with slips that are a factor larger.
    pub(crate) fn times(self, factor: f64) -> Self {
        Self {
            image: self.image,
            slip: (factor * self.slip.0, factor * self.slip.1),
            integral: factor * self.integral,
            moment: factor * self.moment,
        }
    }
}
