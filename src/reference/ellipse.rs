//! The elliptic contact of Hertz and its shear in the approximation of Cattaneo.
//!
//! K. L. Johnson, *Contact Mechanics* (1985), eqs. (4.24)–(4.28): with A = 1/(2R_major),
//! B = 1/(2R_minor) and p₀ the largest pressure,
//!
//! A = (p₀/E*) (b/(e²a²)) (K − E), B = (p₀/E*) (b/(e²a²)) ((a²/b²) E − K), d = (p₀/E*) b K.
//!
//! K and E are taken from their defining integrals, so that nothing here is shared with the
//! engine's arithmetic-geometric mean.

use super::quadrature::integrate;
use super::root::bisect;
use super::tangential::MonomialContact;
use std::f64::consts::{FRAC_PI_2, PI};

/// An elliptic contact at a normal force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EllipticContact {
    /// Semi-axis a along the larger radius, m.
    pub semi_major: f64,
    /// Semi-axis b, m.
    pub semi_minor: f64,
    /// Approach d, m.
    pub depth: f64,
    /// F_N, N.
    pub force: f64,
    /// p₀, Pa.
    pub central_pressure: f64,
    /// E*, Pa.
    pub normal_modulus: f64,
    /// G* along the major and the minor axis, Pa.
    pub tangential_moduli: [f64; 2],
}

/// Young's modulus, Pa, and Poisson ratio.
pub type Material = (f64, f64);

/// K = ∫ dφ/√(1 − e² sin²φ) and D = (K − E)/e² = ∫ sin²φ dφ/√(1 − e² sin²φ) from 0 to π/2 at b/a =
/// k.
fn integrals(k: f64) -> (f64, f64) {
    let integral = |power: i32| {
        integrate(0.0, FRAC_PI_2, |node| {
            // the integrand of a long ellipse is steepest at the end
            let (cosine, sine) = node.to_end.sin_cos();
            sine.powi(power) / cosine.hypot(k * sine)
        })
    };
    (integral(0), integral(2))
}

impl EllipticContact {
    /// The contact of two bodies with these relative radii of curvature (m), R_major > R_minor,
    /// under a force (N).
    pub fn at_force((radius_major, radius_minor): (f64, f64), materials: [Material; 2], force: f64) -> Self {
        let normal_modulus = 1.0 / materials.iter().map(|(e, nu)| (1.0 - nu * nu) / e).sum::<f64>();
        // B/A − R_major/R_minor falls as ln k rises
        let miss = |logarithm: f64| {
            let k = logarithm.exp();
            let ((big_k, d), square) = (integrals(k), 1.0 - k * k);
            let big_e = big_k - square * d;
            (big_e / (k * k) - big_k) / (square * d) - radius_major / radius_minor
        };
        let k = bisect((radius_minor / radius_major).ln(), -1e-9, miss).exp();
        let (big_k, d) = integrals(k);
        let semi_major = (3.0 * force * d * radius_major / (PI * normal_modulus)).cbrt();
        let semi_minor = k * semi_major;
        let central_pressure = 3.0 * force / (2.0 * PI * semi_major * semi_minor);
        let compliance =
            |part: f64| materials.iter().map(|(e, nu)| (1.0 - nu * part) * (1.0 + nu) / e).sum::<f64>();
        Self {
            semi_major,
            semi_minor,
            depth: central_pressure / normal_modulus * semi_minor * big_k,
            force,
            central_pressure,
            normal_modulus,
            tangential_moduli: [1.0 - d / big_k, d / big_k].map(|part| 1.0 / compliance(part)),
        }
    }

    /// Shear along the major (0) or the minor (1) axis with a coefficient of friction: T = μF_N (1
    /// −
    /// (1 − U/u_max)^(3/2)), u_max = μ d E*/G*.
    pub fn shear(&self, axis: usize, friction: f64) -> MonomialContact {
        MonomialContact {
            exponent: 1.5,
            friction_limit: friction * self.force,
            full_slip: friction * self.depth * self.normal_modulus / self.tangential_moduli[axis],
        }
    }

    /// Initial tangential stiffness along an axis, N/m: 2G* times the radius of the sphere with the
    /// same normal stiffness 2E* r = dF/dd = (3/2) F/d.
    pub fn tangential_stiffness(&self, axis: usize) -> f64 {
        1.5 * self.force / self.depth * self.tangential_moduli[axis] / self.normal_modulus
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::{NormalContact, Shape};

    const STEEL: [Material; 2] = [(210e9, 0.3); 2];

    /// b/a, d, a, p₀ and u_max of two contacts of steel bodies under 100 N, to six digits.
    #[test]
    fn two_contacts_to_six_digits() {
        for (radii, friction, expected) in [
            ((0.02, 0.005), 0.6, [0.399887, 3.39345e-6, 0.287724e-3, 1442.28e6, 2.56826e-6, 2.37648e-6]),
            ((0.13, 0.004), 0.15, [0.107327, 2.28299e-6, 0.657184e-3, 1030.05e6, 0.449235e-6, 0.382427e-6]),
        ] {
            let contact = EllipticContact::at_force(radii, STEEL, 100.0);
            let found = [
                contact.semi_minor / contact.semi_major,
                contact.depth,
                contact.semi_major,
                contact.central_pressure,
                contact.shear(0, friction).full_slip,
                contact.shear(1, friction).full_slip,
            ];
            for (found, expected) in found.into_iter().zip(expected) {
                assert!((found / expected - 1.0).abs() < 4e-6, "{radii:?}: {found:e} {expected:e}");
            }
        }
    }

    /// Nearly equal radii: a sphere of their geometric mean, with an error of second order.
    #[test]
    fn nearly_equal_radii_are_nearly_a_sphere() {
        let modulus = 210e9 / (2.0 * 0.91);
        let sphere = NormalContact::at_force(Shape::Parabola { radius: 0.01 }, modulus, 100.0);
        let error = |change: f64| {
            let contact = EllipticContact::at_force((0.01 * change, 0.01 / change), STEEL, 100.0);
            assert!((contact.tangential_moduli[0] / contact.tangential_moduli[1] - 1.0).abs() < change - 1.0);
            (contact.depth / sphere.depth() - 1.0).abs()
        };
        let (coarse, fine) = (error(1.02), error(1.01));
        assert!(fine < 1e-4 && (coarse / fine - 4.0).abs() < 0.1, "{coarse:e} {fine:e}");
    }
}
