//! How an elliptic contact follows from that of its equivalent sphere, which is what the engine
//! computes.
//!
//! Coordinates of the engine are radii of the sphere. Users get √(a b)/√(R_e d) times these: the
//! radius of the circle of the same area as the ellipse through a point, on which pressure and
//! traction are constant (Hertz, Cattaneo). Stresses are smaller by the ratio of the areas.
//! Lengths along y are multiplied by G*_y/G*_x for the springs. For a body of revolution all
//! factors are 1, by which nothing changes to the last bit.

use super::FrettingContact;
use crate::ellipse::HertzianEllipse;
use crate::material::Pair;
use nalgebra::Vector2;

/// Factors from the equivalent sphere to the ellipse.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Axes {
    /// √(a b) over the radius of the sphere's contact.
    pub(super) size: f64,
    /// Semi-axes along x and y over the same.
    semi_axes: [f64; 2],
    /// G*_y/G*_x.
    pub(super) stiffness_ratio: f64,
}

impl Axes {
    /// Those of a body of revolution.
    pub(super) const CIRCLE: Self = Self { size: 1.0, semi_axes: [1.0; 2], stiffness_ratio: 1.0 };

    pub(super) fn new(ellipse: &HertzianEllipse, materials: &Pair) -> Self {
        let (semi_axes, moduli) = (ellipse.semi_axis_factors(), ellipse.tangential_moduli(materials));
        Self { size: (semi_axes[0] * semi_axes[1]).sqrt(), semi_axes, stiffness_ratio: moduli[1] / moduli[0] }
    }

    /// Semi-axes over √(a b).
    pub(super) fn per_contact_radius(&self) -> [f64; 2] {
        self.semi_axes.map(|factor| factor / self.size)
    }

    /// A displacement as the springs see it, m.
    #[inline]
    pub(super) fn for_springs(&self, place: Vector2<f64>) -> Vector2<f64> {
        Vector2::new(place.x, self.stiffness_ratio * place.y)
    }

    /// A radius that users give in coordinates of the engine, m.
    #[inline]
    pub(super) fn inner(&self, radius: f64) -> f64 {
        radius / self.size
    }

    /// A stress of the sphere's contact on the ellipse, Pa.
    #[inline]
    pub(super) fn stress(&self, stress: f64) -> f64 {
        stress / (self.size * self.size)
    }
}

/// Elliptic contacts.
impl FrettingContact {
    /// Semi-axes of the contact along x and y, m: both are [`Self::contact_radius`] for a body of
    /// revolution.
    pub fn contact_semi_axes(&self) -> [f64; 2] {
        self.model.axes.semi_axes.map(|factor| factor * self.state.contact.radius)
    }

    /// Tangential moduli G* along x and y, Pa: they differ for an ellipse.
    pub fn tangential_moduli(&self) -> [f64; 2] {
        [1.0, self.model.axes.stiffness_ratio].map(|factor| factor * self.model.constants.tangential_modulus)
    }
}
