//! The Hertzian contact of bodies that are curved differently in two planes, such as a ball in a
//! groove, unequal crossed cylinders or a crowned roller.
//!
//! With the relative radii of curvature R_major ≥ R_minor, 1/R = 1/R₁ + 1/R₂ in each principal
//! plane, the contact is an ellipse with the semi-axes a along the larger radius and b = k a along
//! the smaller one. With e² = 1 − k² and the complete elliptic integrals K = K(e), E = E(e),
//! D = (K − E)/e² and B = K − D (K. L. Johnson, *Contact Mechanics*, 1985, sections 4.2 and 7.2):
//!
//! | quantity | formula |
//! | --- | --- |
//! | k | R_major/R_minor = B/(k² D) |
//! | a, b | a³ = 3 F_N D R_major/(π E*), b = k a |
//! | p | p₀ √(1 − x²/a² − y²/b²), p₀ = 3 F_N/(2π a b) |
//! | d | p₀ b K/E* |
//! | tangential moduli | 1/G*_major = Σ (1 − νᵢ + νᵢ D/K)/(2Gᵢ), 1/G*_minor = Σ (1 − νᵢ D/K)/(2Gᵢ) |
//!
//! Force and depth are those of the *equivalent sphere* of radius R_e = (π²/2) R_major D/K³,
//! F_N = (4/3) E* √R_e d^(3/2), whose contact has the radius √(R_e d) = π a/(2K). In the
//! approximation of Cattaneo (1938) the stick region is an ellipse of the same shape, and the
//! tangential force along either axis is that of the equivalent sphere with the modulus of that
//! axis. The moduli follow from the uniform displacement under the traction
//! Q/(2π a b) (1 − x²/a² − y²/b²)^(−1/2), (Q/(2π G a)) ((1 − ν) K + ν D) along the major axis.

use crate::error::Error;
use crate::material::{Elastic, Pair};
use crate::range;
use std::f64::consts::PI;

/// The complete elliptic integrals of the modulus e = √(1 − k²).
#[derive(Debug, Clone, Copy, PartialEq)]
struct Integrals {
    /// K.
    k: f64,
    /// D/K: 1/2 for a circle, towards 1 for a long ellipse.
    share: f64,
}

impl Integrals {
    /// By the arithmetic-geometric mean of 1 and k (NIST *Digital Library of Mathematical
    /// Functions*, 19.8.1 and 19.8.6): K = π/(2 M), K − E = K Σ 2^(n−1) cₙ², cₙ₊₁ = cₙ²/(4 aₙ₊₁).
    /// The ratios cₙ²/e² are followed in place of cₙ², since e² vanishes for a circle. All terms
    /// are positive, so that no digits are lost at any k in (0, 1].
    fn new(k: f64) -> Self {
        let square = (1.0 - k) * (1.0 + k);
        let (mut mean, mut root) = (1.0, k);
        let (mut share, mut weight, mut ratio) = (0.5, 1.0, 1.0);
        // convergence is quadratic: 1e-9 takes 8 iterations
        while weight * ratio > 0.1 * f64::EPSILON {
            (mean, root) = (0.5 * (mean + root), f64::sqrt(mean * root));
            ratio *= ratio * square / (16.0 * mean * mean);
            share += weight * ratio;
            weight *= 2.0;
        }
        Self { k: PI / (mean + root), share }
    }

    /// R_major/R_minor = B/(k² D) at the axis ratio k.
    fn ratio_of_radii(&self, k: f64) -> f64 {
        (1.0 - self.share) / (self.share * k * k)
    }
}

/// The shape of an elliptic contact, which does not depend on the load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HertzianEllipse {
    /// R_e, m.
    equivalent_radius: f64,
    /// Semi-axes along x and y over the contact radius of the equivalent sphere.
    semi_axes: [f64; 2],
    /// Part of ν by which the compliance along x and along y rises: D/K along the major axis,
    /// B/K along the minor one.
    shares: [f64; 2],
}

impl HertzianEllipse {
    /// Largest ratio of the two radii that is accepted: with 1 m along one axis, 1 µm along the
    /// other.
    pub const MOST_RATIO: f64 = 1e6;

    /// From the relative radii of curvature R, m, in the planes xz and yz: 1/R = 1/R₁ + 1/R₂ of
    /// both bodies, where a groove counts below 0. The longer axis of the contact lies along the
    /// larger radius.
    ///
    /// # Errors
    /// [`Error::Parameter`] with the radius that is outside 1e-30 to 1e30 m, or the larger one
    /// where
    /// it is more than [`Self::MOST_RATIO`] times the other.
    pub fn new(radius_x: f64, radius_y: f64) -> Result<Self, Error> {
        for (name, value) in [("radius_x", radius_x), ("radius_y", radius_y)] {
            let requirement = "a relative radius of curvature lies in 1e-30 to 1e30 m";
            range::parameter(name, value, &range::LENGTH, requirement)?;
        }
        let along_x = radius_x >= radius_y;
        let (name, major, minor) =
            if along_x { ("radius_x", radius_x, radius_y) } else { ("radius_y", radius_y, radius_x) };
        if major > Self::MOST_RATIO * minor {
            let requirement = "radius_x and radius_y differ by a factor of 1e6 at most: a contact that is \
                               longer is one along a line, which this model does not have";
            return Err(Error::Parameter { name, value: major, requirement });
        }
        let k = axis_ratio(major / minor);
        let Integrals { k: integral, share } = Integrals::new(k);
        let half = 2.0 / PI * integral;
        let by_axis = |major: f64, minor: f64| if along_x { [major, minor] } else { [minor, major] };
        Ok(Self {
            // (π²/2) R D/K³
            equivalent_radius: 2.0 * share * major / (half * half),
            semi_axes: by_axis(half, k * half),
            shares: by_axis(share, 1.0 - share),
        })
    }

    /// Radius R_e of the sphere with the same force at the same depth, m.
    pub fn equivalent_radius(&self) -> f64 {
        self.equivalent_radius
    }

    /// Semi-axes of the contact along x and y over the contact radius √(R_e d) of the equivalent
    /// sphere. The larger one is 2K/π.
    pub fn semi_axis_factors(&self) -> [f64; 2] {
        self.semi_axes
    }

    /// Tangential moduli G* along x and y, Pa; both are [`Pair::tangential_modulus`] for a circle.
    pub fn tangential_moduli(&self, materials: &Pair) -> [f64; 2] {
        self.shares.map(|share| {
            let compliance =
                |body: &Elastic| (1.0 - body.poisson_ratio * (1.0 - share)) / (2.0 * body.shear_modulus());
            1.0 / (compliance(&materials.body_1) + compliance(&materials.body_2))
        })
    }
}

/// Most iterations of the secant method; 4 to 7 are usual.
const MOST_ITERATIONS: u32 = 40;

/// Axis ratio k at which R_major/R_minor = B/(k² D) takes a value from 1 on. The logarithm of the
/// right side is nearly linear in that of k, with a slope between −3/2 and −2.
fn axis_ratio(ratio: f64) -> f64 {
    let wanted = ratio.ln();
    let miss = |depth: f64| {
        let k = (-depth).exp();
        Integrals::new(k).ratio_of_radii(k).ln() - wanted
    };
    // -ln k of a slightly elongated ellipse, and a point below
    let (mut last, mut depth) = (0.6 * wanted, 2.0 / 3.0 * wanted);
    let (mut last_miss, mut now) = (miss(last), miss(depth));
    for _ in 0..MOST_ITERATIONS {
        let step = now * (depth - last) / (now - last_miss);
        // of equal radii, and where the last step was rounding, it is 0 or not a number
        let moves = step.is_finite() && step.abs() > f64::EPSILON * depth;
        if !moves {
            break;
        }
        (last, last_miss, depth) = (depth, now, depth - step);
        now = miss(depth);
    }
    (-depth).exp()
}

#[cfg(test)]
mod tests;
