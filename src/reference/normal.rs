//! Frictionless normal contact of a [`Shape`] with a half-space.
//!
//! g(a) = d, F_N = 2E* [a d − ∫₀ᵃ g dx], p(r) = (E*/π) ∫ᵣᵃ g' dx / √(x² − r²) (Sneddon 1965; Popov
//! and Heß). For the parabola these are Hertz's formulas (1882).

use super::quadrature::{Node, integrate};
use super::root::bisect;
use super::shape::{Shape, less_arc, monomial_factor};
use Shape::{BluntedSphere, Cone, FlatPunch, Parabola, PowerLaw, RoundedPunch};
use std::f64::consts::PI;

/// One state of contact. Depth, radius and force agree to rounding, also where a is next to a
/// flat's radius.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NormalContact {
    shape: Shape,
    modulus: f64,
    depth: f64,
    /// √(a² − b²), m: a alone loses it when a ≈ b.
    overhang: f64,
}

impl NormalContact {
    /// At indentation depth `depth`, m; E* = `modulus`, Pa. A depth ≤ 0 means bodies apart: a = F_N
    /// = 0.
    pub fn at_depth(shape: Shape, modulus: f64, depth: f64) -> Self {
        let depth = depth.max(0.0);
        let overhang = if depth > 0.0 { shape.overhang_at_depth(depth) } else { 0.0 };
        Self { shape, modulus, depth, overhang }
    }

    /// At contact radius `radius` > b, m; E* = `modulus`, Pa.
    ///
    /// # Panics
    /// For the flat punch, whose radius does not tell its depth.
    pub fn at_radius(shape: Shape, modulus: f64, radius: f64) -> Self {
        assert!(!matches!(shape, FlatPunch { .. }), "the radius of a flat punch does not tell its depth");
        Self::at_overhang(shape, modulus, shape.overhang(radius))
    }

    /// At normal force `force`, N; E* = `modulus`, Pa. A force ≤ 0 means bodies apart.
    pub fn at_force(shape: Shape, modulus: f64, force: f64) -> Self {
        if force <= 0.0 {
            return Self::at_depth(shape, modulus, 0.0);
        }
        let reduced = force / modulus;
        let overhang = match shape {
            FlatPunch { flat_radius } => return Self::at_depth(shape, modulus, 0.5 * reduced / flat_radius),
            Parabola { radius } => (0.75 * radius * reduced).cbrt(),
            Cone { slope } => (reduced / (0.5 * PI * slope.tan())).sqrt(),
            PowerLaw { exponent: n, coefficient } => {
                (reduced * (n + 1.0) / (2.0 * n * monomial_factor(n) * coefficient)).powf(1.0 / (n + 1.0))
            }
            // F_N is above E* s³/(3R) for both
            BluntedSphere { radius, .. } | RoundedPunch { radius, .. } => {
                let bound = (3.0 * radius * reduced).cbrt() * (1.0 + 1e-15);
                bisect(0.0, bound, |s| Self::at_overhang(shape, 1.0, s).force() - reduced)
            }
        };
        Self::at_overhang(shape, modulus, overhang)
    }

    fn at_overhang(shape: Shape, modulus: f64, overhang: f64) -> Self {
        Self { shape, modulus, depth: shape.image_at_overhang(overhang), overhang }
    }

    /// The profile.
    pub fn shape(&self) -> Shape {
        self.shape
    }

    /// E*, Pa.
    pub fn modulus(&self) -> f64 {
        self.modulus
    }

    /// d, m.
    pub fn depth(&self) -> f64 {
        self.depth
    }

    /// a, m.
    pub fn radius(&self) -> f64 {
        if self.depth > 0.0 { self.overhang.hypot(self.shape.flat_radius()) } else { 0.0 }
    }

    /// F_N, N.
    pub fn force(&self) -> f64 {
        let (a, s) = (self.radius(), self.overhang);
        self.modulus
            * match self.shape {
                Parabola { radius } => 4.0 / 3.0 * a.powi(3) / radius,
                Cone { slope } => 0.5 * PI * a * a * slope.tan(),
                PowerLaw { exponent: n, .. } => 2.0 * n / (n + 1.0) * self.depth * a,
                BluntedSphere { radius, flat_radius: b } => 2.0 / (3.0 * radius) * (2.0 * a * a + b * b) * s,
                // (1/3R) [(4a² − b²) s − 3 a² b·acos(b/a)], all terms positive
                RoundedPunch { radius, flat_radius: b } => {
                    (s.powi(3) + 3.0 * a * a * less_arc(s, b)) / (3.0 * radius)
                }
                FlatPunch { flat_radius } => 2.0 * self.depth * flat_radius,
            }
    }

    /// ∂F_N/∂d = 2E* a, N/m.
    pub fn stiffness(&self) -> f64 {
        2.0 * self.modulus * self.radius()
    }

    /// q(x) = E* (d − g(x)), N/m; 0 outside the contact.
    pub fn line_force(&self, x: f64) -> f64 {
        self.modulus * (self.depth - self.shape.image(x)).max(0.0)
    }

    /// F_N / (π a²), Pa; 0 when the bodies are apart.
    pub fn mean_pressure(&self) -> f64 {
        let a = self.radius();
        if a > 0.0 { self.force() / (PI * a * a) } else { 0.0 }
    }

    /// p(0), Pa: infinite for the cone and the power laws with n ≤ 1.
    ///
    /// | shape | p(0) |
    /// | --- | --- |
    /// | parabola | 2E* a/(πR) |
    /// | power law, n > 1 | (E*/π) κₙ A a^(n−1) n/(n−1) |
    /// | blunted sphere | (E*/πR) [2s − b·acos(b/a)] |
    /// | rounded punch | quadrature |
    /// | flat punch | E* d/(πb) |
    pub fn central_pressure(&self) -> f64 {
        if self.depth == 0.0 {
            return 0.0;
        }
        let (a, s) = (self.radius(), self.overhang);
        match self.shape {
            Parabola { radius } => 2.0 * self.modulus * a / (PI * radius),
            Cone { .. } => f64::INFINITY,
            PowerLaw { exponent: n, .. } if n <= 1.0 => f64::INFINITY,
            PowerLaw { exponent: n, .. } => self.modulus * self.depth * n / (PI * a * (n - 1.0)),
            BluntedSphere { radius, flat_radius: b } => {
                self.modulus / (PI * radius) * (2.0 * s - b * s.atan2(b))
            }
            RoundedPunch { .. } => self.pressure_by_quadrature(0.0),
            FlatPunch { flat_radius } => self.modulus * self.depth / (PI * flat_radius),
        }
    }

    /// p(r), Pa; 0 outside the contact. Infinite at the edge of the flat punch and, as a logarithm,
    /// at the rim r = b of the blunted sphere.
    ///
    /// | shape | p(r) |
    /// | --- | --- |
    /// | parabola | p(0) √(1 − r²/a²) |
    /// | cone | (E* tanθ/2) arcosh(a/r) |
    /// | flat punch | E* d / (π √(b² − r²)) |
    /// | others | quadrature, to about 1e-13 of p(0) or p_mean |
    pub fn pressure(&self, r: f64) -> f64 {
        let a = self.radius();
        if r == 0.0 {
            return self.central_pressure();
        }
        if r > a || self.depth == 0.0 {
            return 0.0;
        }
        match self.shape {
            BluntedSphere { flat_radius, .. } if r == flat_radius => f64::INFINITY,
            Parabola { .. } => self.central_pressure() * ((a - r) * (a + r)).sqrt() / a,
            Cone { slope } => 0.5 * self.modulus * slope.tan() * (a / r).acosh(),
            PowerLaw { .. } | BluntedSphere { .. } | RoundedPunch { .. } => self.pressure_by_quadrature(r),
            FlatPunch { flat_radius: b } => self.modulus * self.depth / (PI * ((b - r) * (b + r)).sqrt()),
        }
    }

    /// p(r) as the Abel integral over s = √(x² − b²), in which g' dx has no singularity.
    fn pressure_by_quadrature(&self, r: f64) -> f64 {
        let b = self.shape.flat_radius();
        let start = self.shape.overhang(r);
        if start >= self.overhang {
            return 0.0; // r = a, to rounding
        }
        // x² − r² = s² − start² for r ≥ b, s² + (b² − r²) below
        let inside_flat = ((b - r).max(0.0) * (b + r)).sqrt();
        let kernel = |n: Node| {
            self.shape.image_slope_over_overhang(n.x)
                / (n.from_start * (n.x + start)).sqrt().hypot(inside_flat)
        };
        self.modulus / PI * integrate(start, self.overhang, kernel)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::shape::tests::SHAPES;

    const STEEL: f64 = 210e9 / (2.0 * (1.0 - 0.09));

    fn assert_close(value: f64, exact: f64, tolerance: f64, what: &str) {
        let error = (value - exact).abs();
        assert!(error <= tolerance * exact.abs(), "{what}: {value:e} against {exact:e}");
    }

    /// From light touch to a contact that is large against the flat.
    fn contacts() -> impl Iterator<Item = NormalContact> {
        let depths = [1e-9, 1e-6, 2e-4];
        SHAPES.into_iter().flat_map(move |shape| depths.map(|d| NormalContact::at_depth(shape, STEEL, d)))
    }

    #[test]
    fn steel_numbers() {
        // ball on flat, R = 10 mm, F_N = 100 N
        let ball = NormalContact::at_force(Parabola { radius: 0.01 }, STEEL, 100.0);
        assert_close(STEEL, 115.385e9, 5e-6, "E*");
        assert_close(ball.radius(), 186.626e-6, 5e-6, "a");
        assert_close(ball.depth(), 3.48291e-6, 2e-6, "d");
        assert_close(ball.central_pressure(), 1.37088e9, 4e-6, "p₀");
        let blunted = BluntedSphere { radius: 0.01, flat_radius: 1e-4 };
        let blunted = NormalContact::at_force(blunted, STEEL, 100.0);
        assert_close(blunted.radius(), 188.717e-6, 4e-6, "a, blunted");
        assert_close(blunted.depth(), 3.02029e-6, 2e-6, "d, blunted");
    }

    #[test]
    fn the_force_is_the_integral_of_the_line_force() {
        for contact in contacts() {
            let (b, a) = (contact.shape.flat_radius(), contact.radius());
            let line = 2.0 * contact.modulus * contact.depth * b
                + 2.0 * integrate(b, a, |n| contact.line_force(n.x));
            // q loses digits in a − b, by the ratio b/(a − b)
            let tolerance = if contact.overhang == 0.0 { 1e-14 } else { 1e-13 * (1.0 + 0.01 * b / (a - b)) };
            assert_close(line, contact.force(), tolerance, &format!("{contact:?}"));
        }
    }

    #[test]
    fn the_force_is_the_integral_of_the_pressure() {
        for contact in contacts() {
            let (b, a) = (contact.shape.flat_radius(), contact.radius());
            if contact.overhang > 0.0 && a - b < 1e-3 * b {
                continue; // the ring outside the flat has no digits left in r
            }
            let force = if let FlatPunch { .. } = contact.shape {
                // the singular edge, in the distance from it
                let p = |n: Node| contact.modulus * contact.depth / (PI * (n.to_end * (b + n.x)).sqrt());
                integrate(0.0, b, |n| 2.0 * PI * n.x * p(n))
            } else {
                // rounding puts nodes on the blunted sphere's rim, with no weight
                let ring = |n: Node| if n.x == b { 0.0 } else { 2.0 * PI * n.x * contact.pressure(n.x) };
                integrate(0.0, b, ring) + integrate(b, a, ring)
            };
            assert_close(force, contact.force(), 1e-11, &format!("{contact:?}"));
        }
    }

    #[test]
    fn closed_pressures_are_the_abel_integral() {
        for contact in contacts().filter(|c| matches!(c.shape, Parabola { .. } | Cone { .. })) {
            let a = contact.radius();
            for r in [0.1 * a, 0.5 * a, 0.9 * a, 0.999 * a] {
                let kernel = |n: Node| contact.shape.image_slope(n.x) / (n.from_start * (n.x + r)).sqrt();
                let abel = contact.modulus / PI * integrate(r, a, kernel);
                assert_close(contact.pressure(r), abel, 1e-13, &format!("{contact:?} at {r}"));
            }
        }
    }

    #[test]
    fn pressures_by_quadrature_meet_closed_forms_where_these_exist() {
        for contact in contacts() {
            let (a, p0) = (contact.radius(), contact.central_pressure());
            match contact.shape {
                // p of x⁴ (Steuermann): p₀ √(1−ρ²) (1 + 2ρ²)
                PowerLaw { exponent: 4.0, .. } => {
                    for rho in [0.05f64, 0.5, 0.99] {
                        let exact = p0 * (1.0 - rho * rho).sqrt() * (1.0 + 2.0 * rho * rho);
                        assert_close(contact.pressure(rho * a), exact, 1e-13, "x⁴");
                    }
                }
                BluntedSphere { .. } => {
                    assert_close(contact.pressure_by_quadrature(0.0), p0, 1e-13, "blunted sphere, centre");
                }
                _ => {}
            }
        }
        // without a flat both blunted shapes are the parabola
        let hertz = NormalContact::at_depth(Parabola { radius: 0.01 }, STEEL, 3e-6);
        for shape in [
            BluntedSphere { radius: 0.01, flat_radius: 0.0 },
            RoundedPunch { radius: 0.01, flat_radius: 0.0 },
        ] {
            let contact = NormalContact::at_depth(shape, STEEL, 3e-6);
            assert_close(contact.force(), hertz.force(), 1e-15, "force");
            for r in [0.0, 0.3 * hertz.radius(), 0.8 * hertz.radius()] {
                assert_close(contact.pressure(r), hertz.pressure(r), 1e-13, "pressure");
            }
        }
    }

    #[test]
    fn the_rounded_punch_has_its_published_force() {
        // (E*/3R) a³ [(4 − k²) √(1−k²) − 3k·acos k] with k = b/a
        let (radius, b, a) = (0.01, 1e-4, 2.5e-4);
        let contact = NormalContact::at_radius(RoundedPunch { radius, flat_radius: b }, STEEL, a);
        let k: f64 = b / a;
        let bracket = (4.0 - k * k) * (1.0 - k * k).sqrt() - 3.0 * k * k.acos();
        assert_close(contact.force(), STEEL / (3.0 * radius) * a.powi(3) * bracket, 1e-14, "F_N");
    }

    #[test]
    fn depth_radius_and_force_name_the_same_state() {
        for contact in contacts() {
            let again = NormalContact::at_force(contact.shape, STEEL, contact.force());
            assert_close(again.depth(), contact.depth(), 1e-14, &format!("{contact:?} from its force"));
            if contact.overhang > 1e-2 * contact.shape.flat_radius() {
                let again = NormalContact::at_radius(contact.shape, STEEL, contact.radius());
                assert_close(again.force(), contact.force(), 1e-11, &format!("{contact:?} from its radius"));
            }
        }
    }

    #[test]
    fn the_stiffness_is_the_derivative_of_the_force() {
        for contact in contacts() {
            let h = 1e-3 * contact.depth;
            let force = |d: f64| NormalContact::at_depth(contact.shape, STEEL, d).force();
            let (d, h2) = (contact.depth, 2.0 * h);
            let slope = (8.0 * (force(d + h) - force(d - h)) - (force(d + h2) - force(d - h2))) / (12.0 * h);
            assert_close(contact.stiffness(), slope, 1e-10, &format!("{contact:?}"));
        }
    }

    #[test]
    fn apart_means_nothing_is_there() {
        for shape in SHAPES {
            for contact in
                [NormalContact::at_depth(shape, STEEL, -1e-6), NormalContact::at_force(shape, STEEL, 0.0)]
            {
                let values = [contact.depth(), contact.radius(), contact.force(), contact.stiffness()];
                assert_eq!(values, [0.0; 4]);
                assert_eq!(
                    [contact.central_pressure(), contact.pressure(1e-5), contact.line_force(0.0)],
                    [0.0; 3]
                );
                assert_eq!(contact.mean_pressure(), 0.0);
            }
        }
    }

    #[test]
    fn pressures_are_infinite_where_they_are() {
        for contact in contacts() {
            let b = contact.shape.flat_radius();
            let infinite = match contact.shape {
                Cone { .. } => true,
                PowerLaw { exponent, .. } => exponent <= 1.0,
                BluntedSphere { .. } | FlatPunch { .. } => true,
                Parabola { .. } | RoundedPunch { .. } => false,
            };
            assert_eq!(contact.pressure(b).is_infinite(), infinite, "{contact:?}");
            assert!(contact.pressure(0.5 * contact.radius()).is_finite());
        }
    }

    #[test]
    fn nothing_presses_outside_the_contact() {
        for contact in contacts() {
            let r = 1.001 * contact.radius();
            assert_eq!([contact.pressure(r), contact.line_force(r)], [0.0; 2], "{contact:?}");
        }
    }

    #[test]
    #[should_panic(expected = "does not tell its depth")]
    fn a_flat_punch_is_not_placed_by_its_radius() {
        NormalContact::at_radius(FlatPunch { flat_radius: 1e-4 }, STEEL, 1e-4);
    }
}
