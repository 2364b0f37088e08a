//! Axisymmetric profiles f(r) and their one-dimensional images g(x).
//!
//! g(x) = x ∫₀ˣ f'(r) dr / √(x² − r²), and back f(r) = (2/π) ∫₀ʳ g(x) dx / √(r² − x²). The images
//! of the monomials and of the blunted shapes are collected in Popov and Heß, *Method of
//! Dimensionality Reduction in Contact Mechanics and Friction*; all follow from Sneddon (1965).
//!
//! For the shapes with a flat, everything is written in s = √(x² − b²): it stays exact where x and
//! b agree to many digits.

use std::f64::consts::{FRAC_PI_2, PI};

/// An unworn profile. Lengths in m, every one > 0 unless said otherwise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shape {
    /// f = r²/(2R): the sphere of radius R near its apex. g = x²/R.
    Parabola {
        /// R, m.
        radius: f64,
    },
    /// f = r tanθ. g = (π/2) x tanθ.
    Cone {
        /// θ between the flank and the surface, rad.
        slope: f64,
    },
    /// f = A rⁿ. g = κₙ A xⁿ, κₙ = √π Γ(n/2 + 1) / Γ((n + 1)/2).
    PowerLaw {
        /// n > 0.
        exponent: f64,
        /// A, m^(1−n).
        coefficient: f64,
    },
    /// Sphere cut off at radius b: f = 0, then (r² − b²)/(2R). g = 0, then (x/R) s.
    BluntedSphere {
        /// R, m.
        radius: f64,
        /// b ≥ 0, m.
        flat_radius: f64,
    },
    /// Flat that turns smoothly into a parabola: f = 0, then (r − b)²/(2R). g = 0, then (x/R) [s −
    /// b·acos(b/x)].
    RoundedPunch {
        /// R of the rim, m.
        radius: f64,
        /// b ≥ 0, m.
        flat_radius: f64,
    },
    /// Flat-ended cylinder: f = g = 0 up to b, infinite beyond.
    FlatPunch {
        /// b, m.
        flat_radius: f64,
    },
}

use Shape::{BluntedSphere, Cone, FlatPunch, Parabola, PowerLaw, RoundedPunch};

impl Shape {
    /// Radius b of the flat tip, m; 0 where there is none.
    pub fn flat_radius(&self) -> f64 {
        match *self {
            Parabola { .. } | Cone { .. } | PowerLaw { .. } => 0.0,
            BluntedSphere { flat_radius, .. }
            | RoundedPunch { flat_radius, .. }
            | FlatPunch { flat_radius } => flat_radius,
        }
    }

    /// f(r), m.
    pub fn height(&self, r: f64) -> f64 {
        if r <= self.flat_radius() {
            return 0.0;
        }
        match *self {
            Parabola { radius } => r * r / (2.0 * radius),
            Cone { slope } => r * slope.tan(),
            PowerLaw { exponent, coefficient } => coefficient * r.powf(exponent),
            BluntedSphere { radius, flat_radius: b } => (r - b) * (r + b) / (2.0 * radius),
            RoundedPunch { radius, flat_radius: b } => (r - b).powi(2) / (2.0 * radius),
            FlatPunch { .. } => f64::INFINITY,
        }
    }

    /// f'(r) for r > 0; infinite beyond the edge of the flat punch.
    pub fn height_slope(&self, r: f64) -> f64 {
        if r <= self.flat_radius() {
            return 0.0;
        }
        match *self {
            Parabola { radius } | BluntedSphere { radius, .. } => r / radius,
            Cone { slope } => slope.tan(),
            PowerLaw { exponent, coefficient } => coefficient * exponent * r.powf(exponent - 1.0),
            RoundedPunch { radius, flat_radius: b } => (r - b) / radius,
            FlatPunch { .. } => f64::INFINITY,
        }
    }

    /// g(x), m.
    pub fn image(&self, x: f64) -> f64 {
        self.image_at_overhang(self.overhang(x))
    }

    /// g'(x) for x > 0; infinite at the edge of the blunted sphere's flat, and from the edge of the
    /// flat punch on.
    pub fn image_slope(&self, x: f64) -> f64 {
        if x < self.flat_radius() {
            return 0.0;
        }
        let s = self.overhang(x);
        match *self {
            Parabola { radius } => 2.0 * x / radius,
            Cone { slope } => FRAC_PI_2 * slope.tan(),
            PowerLaw { exponent: n, coefficient } => monomial_factor(n) * coefficient * n * x.powf(n - 1.0),
            BluntedSphere { radius, .. } => (x * x + s * s) / (radius * s),
            RoundedPunch { radius, flat_radius: b } => (s + less_arc(s, b)) / radius,
            FlatPunch { .. } => f64::INFINITY,
        }
    }

    /// ∫₀ˣ g dx, m². For the rounded punch the rounding error is that of s³/R.
    pub fn image_integral(&self, x: f64) -> f64 {
        if x <= self.flat_radius() {
            return 0.0;
        }
        let s = self.overhang(x);
        match *self {
            Parabola { radius } => x.powi(3) / (3.0 * radius),
            Cone { slope } => 0.25 * PI * x * x * slope.tan(),
            PowerLaw { exponent: n, .. } => self.image(x) * x / (n + 1.0),
            BluntedSphere { radius, .. } => s.powi(3) / (3.0 * radius),
            RoundedPunch { radius, flat_radius: b } => {
                (0.5 * x * x * less_arc(s, b) - s.powi(3) / 6.0) / radius
            }
            FlatPunch { .. } => f64::INFINITY,
        }
    }

    /// The contact radius a at depth d, m: g(a) = d. 0 for d ≤ 0, when the bodies are apart.
    pub fn contact_radius(&self, depth: f64) -> f64 {
        if depth <= 0.0 { 0.0 } else { self.overhang_at_depth(depth).hypot(self.flat_radius()) }
    }

    /// s = √(x² − b²), m; 0 on the flat.
    pub(super) fn overhang(&self, x: f64) -> f64 {
        let b = self.flat_radius();
        ((x - b).max(0.0) * (x + b)).sqrt()
    }

    /// g at x = √(s² + b²), m.
    pub(super) fn image_at_overhang(&self, s: f64) -> f64 {
        match *self {
            Parabola { radius } => s * s / radius,
            Cone { slope } => FRAC_PI_2 * s * slope.tan(),
            PowerLaw { exponent: n, coefficient } => monomial_factor(n) * coefficient * s.powf(n),
            BluntedSphere { radius, flat_radius: b } => s.hypot(b) * s / radius,
            RoundedPunch { radius, flat_radius: b } => s.hypot(b) * less_arc(s, b) / radius,
            FlatPunch { .. } => {
                if s == 0.0 {
                    0.0
                } else {
                    f64::INFINITY
                }
            }
        }
    }

    /// dg/ds at x = √(s² + b²): finite where g' is not.
    pub(super) fn image_slope_over_overhang(&self, s: f64) -> f64 {
        match *self {
            BluntedSphere { radius, flat_radius: b } => {
                let x = s.hypot(b);
                (s * s + x * x) / (radius * x)
            }
            RoundedPunch { radius, flat_radius: b } => (s + less_arc(s, b)) * s / (radius * s.hypot(b)),
            // without a flat s is x
            Parabola { .. } | Cone { .. } | PowerLaw { .. } | FlatPunch { .. } => self.image_slope(s),
        }
    }

    /// s of the contact edge at depth d > 0, m.
    pub(super) fn overhang_at_depth(&self, depth: f64) -> f64 {
        match *self {
            Parabola { radius } => (depth * radius).sqrt(),
            Cone { slope } => depth / (FRAC_PI_2 * slope.tan()),
            PowerLaw { exponent: n, coefficient } => {
                (depth / (monomial_factor(n) * coefficient)).powf(1.0 / n)
            }
            // s² (s² + b²) = (R d)², the positive root for s² without cancellation
            BluntedSphere { radius, flat_radius: b } => {
                let moment = depth * radius;
                moment * (2.0 / (b * b + (b * b).hypot(2.0 * moment))).sqrt()
            }
            // √(s²+b²) (s − b·atan(s/b)) = R d; the left side is above s²/4 for s ≥ 2b and above
            // s³/(5b) below
            RoundedPunch { radius, flat_radius: b } => {
                let moment = depth * radius;
                let bound = (2.0 * moment.sqrt()).max((5.0 * b * moment).cbrt());
                super::root::bisect(0.0, bound, |s| s.hypot(b) * less_arc(s, b) - moment)
            }
            FlatPunch { .. } => 0.0,
        }
    }
}

/// κₙ = √π Γ(n/2 + 1) / Γ((n + 1)/2): the image of rⁿ is κₙ xⁿ. n > 0, and below 300 to stay
/// finite.
pub fn monomial_factor(n: f64) -> f64 {
    PI.sqrt() * libm::tgamma(0.5 * n + 1.0) / libm::tgamma(0.5 * (n + 1.0))
}

/// s − b·atan(s/b) = √(x² − b²) − b·acos(b/x), m, without cancellation for s ≪ b.
pub(super) fn less_arc(s: f64, b: f64) -> f64 {
    if s == 0.0 {
        return 0.0;
    }
    let t = s / b;
    if t >= 0.3 {
        return s - b * s.atan2(b);
    }
    // t³/3 − t⁵/5 + …; 0.09¹⁶ is below rounding
    let series = (0..16).rev().fold(0.0, |tail, k| 1.0 / f64::from(2 * k + 3) - t * t * tail);
    s * t * t * series
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::reference::quadrature::{Node, integrate};

    /// One of each; lengths of the size met in practice.
    pub(in crate::reference) const SHAPES: [Shape; 8] = [
        Parabola { radius: 1e-2 },
        Cone { slope: 0.02 },
        PowerLaw { exponent: 0.7, coefficient: 1e-3 },
        PowerLaw { exponent: 1.5, coefficient: 0.4 },
        PowerLaw { exponent: 4.0, coefficient: 2e9 },
        BluntedSphere { radius: 1e-2, flat_radius: 1e-4 },
        RoundedPunch { radius: 1e-2, flat_radius: 1e-4 },
        FlatPunch { flat_radius: 2e-4 },
    ];

    const RADII: [f64; 5] = [3e-5, 1.0001e-4, 1.2e-4, 3e-4, 1.7e-3];

    fn curved() -> impl Iterator<Item = Shape> {
        SHAPES.into_iter().filter(|shape| !matches!(shape, FlatPunch { .. }))
    }

    fn assert_close(value: f64, exact: f64, tolerance: f64, what: &str) {
        let error = (value - exact).abs();
        assert!(error <= tolerance * exact.abs(), "{what}: {value:e} against {exact:e}");
    }

    #[test]
    fn the_image_is_the_abel_integral_of_the_slope() {
        for shape in curved() {
            for x in RADII {
                let b = shape.flat_radius();
                let abel = |n: Node| shape.height_slope(n.x) / (n.to_end * (x + n.x)).sqrt();
                let image = if x > b { x * integrate(b, x, abel) } else { 0.0 };
                // 1e-9 is the worst rounding of x − b = 1e-8 m, from (r − b) in f'
                assert_close(shape.image(x), image, 1e-9, &format!("{shape:?} at {x}"));
                if x > 1.1 * b {
                    assert_close(shape.image(x), image, 1e-13, &format!("{shape:?} at {x}"));
                }
            }
        }
    }

    #[test]
    fn the_profile_is_the_inverse_abel_integral_of_the_image() {
        for shape in curved() {
            for r in RADII.into_iter().filter(|&r| r > 1.1 * shape.flat_radius()) {
                let inverse = |n: Node| shape.image(n.x) / (n.to_end * (r + n.x)).sqrt();
                let height = 2.0 / PI * integrate(shape.flat_radius(), r, inverse);
                assert_close(shape.height(r), height, 1e-13, &format!("{shape:?} at {r}"));
            }
        }
    }

    #[test]
    fn slopes_and_integrals_belong_to_the_image() {
        for shape in curved() {
            let b = shape.flat_radius();
            for x in RADII.into_iter().filter(|&x| x > 1.1 * b) {
                let what = format!("{shape:?} at {x}");
                assert_close(shape.image_integral(x), integrate(b, x, |n| shape.image(n.x)), 1e-13, &what);
                // the blunted sphere's slope has a root singularity at b, which x alone cannot
                // resolve
                assert_close(shape.image(x), integrate(b, x, |n| shape.image_slope(n.x)), 1e-7, &what);
                let h = 1e-3 * (x - b);
                let central = |f: &dyn Fn(f64) -> f64| {
                    (8.0 * (f(x + h) - f(x - h)) - (f(x + 2.0 * h) - f(x - 2.0 * h))) / (12.0 * h)
                };
                assert_close(shape.image_slope(x), central(&|x| shape.image(x)), 1e-10, &what);
                assert_close(shape.height_slope(x), central(&|r| shape.height(r)), 1e-10, &what);
            }
        }
    }

    #[test]
    fn the_contact_radius_inverts_the_image_over_twelve_decades() {
        for shape in curved() {
            for exponent in -16..=-4 {
                let depth = 10f64.powi(exponent);
                let s = shape.overhang_at_depth(depth);
                assert_close(shape.image_at_overhang(s), depth, 1e-14, &format!("{shape:?}"));
                assert_eq!(shape.contact_radius(depth), s.hypot(shape.flat_radius()));
            }
        }
        assert_eq!(FlatPunch { flat_radius: 2e-4 }.contact_radius(1e-9), 2e-4);
        assert!(
            SHAPES.iter().all(|shape| shape.contact_radius(0.0) == 0.0 && shape.contact_radius(-1.0) == 0.0)
        );
    }

    #[test]
    fn limits_agree() {
        let x = 3e-4;
        let parabola = Parabola { radius: 1e-2 };
        for same in [
            PowerLaw { exponent: 2.0, coefficient: 50.0 },
            BluntedSphere { radius: 1e-2, flat_radius: 0.0 },
            RoundedPunch { radius: 1e-2, flat_radius: 0.0 },
        ] {
            assert_close(same.image(x), parabola.image(x), 1e-15, "image");
            assert_close(same.image_slope(x), parabola.image_slope(x), 1e-15, "slope");
            assert_close(same.image_integral(x), parabola.image_integral(x), 1e-15, "integral");
        }
        let cone = Cone { slope: 0.02 };
        let same = PowerLaw { exponent: 1.0, coefficient: 0.02f64.tan() };
        assert_close(same.image(x), cone.image(x), 1e-15, "cone");
        assert_close(monomial_factor(1.0), FRAC_PI_2, 1e-15, "κ₁");
        assert_close(monomial_factor(2.0), 2.0, 1e-15, "κ₂");
        assert_close(monomial_factor(4.0), 8.0 / 3.0, 1e-15, "κ₄");
    }

    #[test]
    fn the_flat_punch_is_flat_and_then_infinite() {
        let punch = FlatPunch { flat_radius: 2e-4 };
        assert_eq!([punch.height(2e-4), punch.image(2e-4), punch.image_integral(2e-4)], [0.0; 3]);
        assert_eq!([punch.height(2.1e-4), punch.image(2.1e-4)], [f64::INFINITY; 2]);
    }

    #[test]
    fn the_series_of_the_arc_difference_meets_the_formula() {
        let b = 1e-4;
        for t in [0.2f64, 0.29, 0.3, 0.31] {
            assert_close(less_arc(t * b, b), b * (t - t.atan()), 1e-14, "s − b·atan(s/b)");
        }
        assert_close(less_arc(1e-3 * b, b), b * (1e-9 / 3.0 - 1e-15 / 5.0), 1e-12, "leading terms");
    }
}
