//! Fretting wear where it has a closed form.
//!
//! Local law (eq. (18) of Dimaki et al. 2014): Δf = (k/σ₀) τ Δs, hence worn volume = (k/σ₀) ·
//! friction work. Under a constant indentation depth the stick radius c stands still and wear ends
//! when the ring around it carries nothing: g = g₀ inside c and g = d from there to the new edge a∞
//! (Popov 2014).

use super::quadrature::{Node, integrate};
use super::root::bisect;
use super::shape::Shape;
use Shape::{Cone, FlatPunch, Parabola};
use std::f64::consts::{FRAC_2_PI, PI};

/// The final state of fretting at constant depth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConstantDepthEnd {
    shape: Shape,
    depth: f64,
    stick_radius: f64,
    outer_radius: f64,
}

impl ConstantDepthEnd {
    /// Of an initial `shape` held at `depth` (m) with the stick radius c = `stick_radius` (m).
    ///
    /// # Panics
    /// Unless b ≤ c < a₀, with the flat radius b and the initial contact radius a₀; for the flat
    /// punch, which knows no partial slip.
    pub fn new(shape: Shape, depth: f64, stick_radius: f64) -> Self {
        let initial = shape.contact_radius(depth);
        assert!(!matches!(shape, FlatPunch { .. }), "a flat punch knows no partial slip");
        assert!(
            stick_radius > 0.0 && stick_radius >= shape.flat_radius() && stick_radius < initial,
            "the stick radius {stick_radius:e} m lies between the flat and the contact radius {initial:e} m"
        );
        let mut end = Self { shape, depth, stick_radius, outer_radius: initial };
        // f∞ < d meets the unbounded f₀ beyond a₀
        let mut beyond = 2.0 * initial;
        while shape.height(beyond) <= depth {
            beyond *= 2.0;
        }
        end.outer_radius = bisect(initial, beyond, |r| end.flattened(r) - shape.height(r));
        end
    }

    /// a∞, m: where the worn profile runs into the initial one.
    pub fn outer_radius(&self) -> f64 {
        self.outer_radius
    }

    /// g∞(x), m, for x ≤ a∞: g₀ inside c, d outside.
    pub fn image(&self, x: f64) -> f64 {
        if x < self.stick_radius { self.shape.image(x) } else { self.depth }
    }

    /// f∞(r), m: f₀ up to c and from a∞ on; between,
    ///
    /// | shape | f∞ |
    /// | --- | --- |
    /// | parabola | (1/πR) [r² asin(c/r) − c √(r² − c²)] + (2/π) d acos(c/r) |
    /// | cone | tanθ [r − √(r² − c²)] + (2/π) d acos(c/r) |
    /// | others | (2/π) ∫₀ᶜ g₀ dx / √(r² − x²) + (2/π) d acos(c/r), by quadrature |
    pub fn height(&self, r: f64) -> f64 {
        if r <= self.stick_radius || r >= self.outer_radius {
            self.shape.height(r)
        } else {
            self.flattened(r)
        }
    }

    fn flattened(&self, r: f64) -> f64 {
        let c = self.stick_radius;
        let chord = ((r - c) * (r + c)).sqrt();
        let stuck = match self.shape {
            Parabola { radius } => (r * r * (c / r).asin() - c * chord) / (PI * radius),
            Cone { slope } => slope.tan() * (r - chord),
            other => stuck_height(other, c, r),
        };
        stuck + FRAC_2_PI * self.depth * chord.atan2(c)
    }

    /// f∞ − f₀, m.
    pub fn worn_depth(&self, r: f64) -> f64 {
        self.height(r) - self.shape.height(r)
    }

    /// V∞, m³: ∫ 2πr (f∞ − f₀) dr, by quadrature.
    pub fn worn_volume(&self) -> f64 {
        let ring = |n: Node| 2.0 * PI * n.x * (self.flattened(n.x) - self.shape.height(n.x));
        integrate(self.stick_radius, self.outer_radius, ring)
    }

    /// Radius and depth of the deepest wear, m.
    ///
    /// Root of (f∞ − f₀)' by bisection; f∞' = (2/πr) [∫₀ᶜ x g₀' dx / √(r² − x²) + (d − g₀(c)) c /
    /// √(r² − c²)].
    pub fn deepest_wear(&self) -> (f64, f64) {
        let (c, shape) = (self.stick_radius, self.shape);
        let step = self.depth - shape.image(c);
        let slope = |r: f64| {
            let chord = ((r - c) * (r + c)).sqrt();
            let stuck = match shape {
                Parabola { radius } => (r * r * (c / r).asin() - c * chord) / radius,
                Cone { slope } => 0.5 * PI * slope.tan() * (r - chord),
                other => stuck_slope(other, c, r),
            };
            FRAC_2_PI / r * (stuck + step * c / chord) - shape.height_slope(r)
        };
        let radius = bisect(c * (1.0 + 1e-12), self.outer_radius, slope);
        (radius, self.worn_depth(radius))
    }

    /// F∞, N: what the stick disc carries, 2E* ∫₀ᶜ (d − g₀) dx.
    pub fn normal_force(&self, normal_modulus: f64) -> f64 {
        let c = self.stick_radius;
        2.0 * normal_modulus * (self.depth * c - self.shape.image_integral(c))
    }

    /// U₀, m: the amplitude that has this stick radius, (μE*/G*)(d − g₀(c)), for `slip_ratio` =
    /// μE*/G*.
    pub fn amplitude(&self, slip_ratio: f64) -> f64 {
        slip_ratio * (self.depth - self.shape.image(self.stick_radius))
    }

    /// Amplitude of T at the end, N: 2G* c U₀. The loop has closed to a line.
    pub fn tangential_force(&self, tangential_modulus: f64, amplitude: f64) -> f64 {
        2.0 * tangential_modulus * self.stick_radius * amplitude
    }
}

/// (2/π) ∫₀ᶜ g₀ dx / √(r² − x²) for r > c, m.
fn stuck_height(shape: Shape, c: f64, r: f64) -> f64 {
    let kernel = |n: Node| shape.image(n.x) / ((r - c + n.to_end) * (r + n.x)).sqrt();
    FRAC_2_PI * integrate(shape.flat_radius(), c, kernel)
}

/// ∫₀ᶜ x g₀' dx / √(r² − x²) for r > c, m; over s = √(x² − b²), in which g₀' dx has no singularity.
fn stuck_slope(shape: Shape, c: f64, r: f64) -> f64 {
    let (b, rim) = (shape.flat_radius(), shape.overhang(c));
    let kernel = |n: Node| {
        let x = n.x.hypot(b);
        // r² − x² = (r² − c²) + (rim² − s²)
        let distance = (r - c) * (r + c) + n.to_end * (rim + n.x);
        x * shape.image_slope_over_overhang(n.x) / distance.sqrt()
    };
    integrate(0.0, rim, kernel)
}

/// N₀ = π a₀² d₀ σ₀ / (k μ F_N U₀), cycles: the unit of Ñ = N/N₀. `energy_coefficient` is k/σ₀,
/// m³/J.
pub fn seed_cycles(
    radius: f64,
    depth: f64,
    energy_coefficient: f64,
    friction_limit: f64,
    amplitude: f64,
) -> f64 {
    PI * radius * radius * depth / (energy_coefficient * friction_limit * amplitude)
}

/// dV/dÑ at the start, in units of a₀² d₀: π W / (μF_N U₀), with the friction work W of one loop
/// (J) of the unworn body.
pub fn initial_rate(loop_work: f64, friction_limit: f64, amplitude: f64) -> f64 {
    PI * loop_work / (friction_limit * amplitude)
}

/// V after sliding over a `path` (m) in gross slip, m³: (k/σ₀) μF_N s. Exact for every shape and at
/// every wear.
pub fn gross_slip_volume(energy_coefficient: f64, friction_limit: f64, path: f64) -> f64 {
    energy_coefficient * friction_limit * path
}

/// a of a parabola long after the start of gross slip, m: a⁴ → 4RV/π, the volume of the segment
/// worn off.
pub fn worn_flat_radius(radius: f64, volume: f64) -> f64 {
    (4.0 * radius * volume / PI).powf(0.25)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::normal::NormalContact;
    use crate::reference::tangential::{MonomialContact, TangentialContact};
    use Shape::{BluntedSphere, PowerLaw, RoundedPunch};

    fn assert_close(value: f64, exact: f64, tolerance: f64, what: &str) {
        let error = (value - exact).abs();
        assert!(error <= tolerance, "{what}: {value:.9} against {exact:.9}");
    }

    /// Shape with a₀ = d₀ = 1: the units of the tables.
    fn unit_parabola() -> Shape {
        Parabola { radius: 1.0 }
    }

    fn unit_cone() -> Shape {
        Cone { slope: FRAC_2_PI.atan() }
    }

    #[test]
    fn final_states_at_c_equal_04() {
        // a∞/a₀, V∞/(a₀²d₀), deepest/d₀, its r/a₀, F∞/F₀, dV/dÑ, F₀/(E* a₀ d₀)
        let parabola = (1.270537, 1.131108, 0.39125, 0.6679, 0.5680, 1.52519, 4.0 / 3.0);
        let cone = (1.326166, 0.740701, 0.25222, 0.6325, 0.6400, 1.50796, 1.0);
        for (shape, (radius, volume, deepest, at, force, rate, initial_force)) in
            [(unit_parabola(), parabola), (unit_cone(), cone)]
        {
            let end = ConstantDepthEnd::new(shape, 1.0, 0.4);
            assert_close(end.outer_radius(), radius, 0.6e-6, "a∞");
            assert_close(end.worn_volume(), volume, 0.6e-6, "V∞");
            assert_close(end.deepest_wear().1, deepest, 0.6e-5, "deepest wear");
            assert_close(end.deepest_wear().0, at, 0.6e-4, "its radius");
            assert_close(end.normal_force(1.0) / initial_force, force, 0.6e-4, "F∞");
            let initial = NormalContact::at_depth(shape, 1.0, 1.0);
            assert_close(initial.radius(), 1.0, 1e-15, "a₀");
            assert_close(initial.force(), initial_force, 1e-15, "F₀");
            let law = MonomialContact::new(&initial, 0.8, 0.6);
            let amplitude = end.amplitude(0.6 / 0.8);
            assert_close(law.stick_ratio(amplitude), 0.4, 1e-14, "c/a₀");
            // the table cuts 1.525198 to 1.52519
            let computed = initial_rate(law.loop_work(amplitude), law.friction_limit, amplitude);
            assert_close(computed, rate, 1e-5, "dV/dÑ");
        }
    }

    #[test]
    fn final_profiles_at_c_equal_04() {
        let (parabola, cone) =
            (ConstantDepthEnd::new(unit_parabola(), 1.0, 0.4), ConstantDepthEnd::new(unit_cone(), 1.0, 0.4));
        for (r, on_parabola, on_cone) in [
            (0.5, 0.445260, 0.536989),
            (0.7, 0.634506, 0.692702),
            (0.9, 0.722895, 0.766501),
            (1.1, 0.775944, 0.811011),
        ] {
            assert_close(parabola.height(r), on_parabola, 0.6e-6, "parabola");
            assert_close(cone.height(r), on_cone, 0.6e-6, "cone");
        }
    }

    #[test]
    fn the_deepest_wear_of_the_cone_is_at_the_geometric_mean() {
        for c in [0.1f64, 0.4, 0.9] {
            let (radius, _) = ConstantDepthEnd::new(unit_cone(), 1.0, c).deepest_wear();
            assert_close(radius, c.sqrt(), 1e-12, "√(a₀ c)");
        }
    }

    #[test]
    fn closed_profiles_are_the_transform_of_the_final_image() {
        for shape in [unit_parabola(), unit_cone()] {
            for c in [0.1, 0.4, 0.9] {
                let end = ConstantDepthEnd::new(shape, 1.0, c);
                for r in [1.01 * c, 0.5 * (c + 1.0), 1.0] {
                    let kernel = |n: Node| end.image(n.x) / (n.to_end * (r + n.x)).sqrt();
                    let height = stuck_height(shape, c, r) + FRAC_2_PI * integrate(c, r, kernel);
                    assert_close(end.height(r), height, 1e-13, &format!("{shape:?}, c = {c}, r = {r}"));
                }
            }
        }
    }

    /// The general branch against the two closed ones, through power laws that are the same bodies.
    #[test]
    fn the_general_branch_meets_the_closed_ones() {
        let pairs = [
            (unit_parabola(), PowerLaw { exponent: 2.0, coefficient: 0.5 }),
            (unit_cone(), PowerLaw { exponent: 1.0, coefficient: FRAC_2_PI }),
        ];
        for (closed, general) in pairs {
            let [closed, general] = [closed, general].map(|shape| ConstantDepthEnd::new(shape, 1.0, 0.4));
            assert_close(general.outer_radius(), closed.outer_radius(), 1e-12, "a∞");
            assert_close(general.worn_volume(), closed.worn_volume(), 1e-12, "V∞");
            assert_close(
                general.deepest_wear().0,
                closed.deepest_wear().0,
                1e-9,
                "radius of the deepest wear",
            );
            assert_close(general.deepest_wear().1, closed.deepest_wear().1, 1e-12, "deepest wear");
            assert_close(general.normal_force(1.0), closed.normal_force(1.0), 1e-14, "F∞");
        }
    }

    #[test]
    fn profile_volume_and_deepest_point_agree_for_every_shape() {
        let shapes = [
            unit_parabola(),
            unit_cone(),
            PowerLaw { exponent: 3.0, coefficient: 0.4 },
            BluntedSphere { radius: 1.0, flat_radius: 0.3 },
            RoundedPunch { radius: 1.0, flat_radius: 0.3 },
        ];
        for shape in shapes {
            let c = 0.4 * shape.contact_radius(1.0);
            let end = ConstantDepthEnd::new(shape, 1.0, c);
            let a = end.outer_radius();
            assert_close(end.worn_depth(a * (1.0 - 1e-12)), 0.0, 1e-10, "continuous at a∞");
            assert_eq!([end.worn_depth(0.99 * c), end.worn_depth(1.01 * a)], [0.0; 2]);
            // no ring is worn deeper, and the rings sum to the volume (midpoint rule in r² with a
            // root cusp at c)
            let (radius, deepest) = end.deepest_wear();
            let cells = 20_000;
            let mut volume = 0.0;
            for i in 0..cells {
                let squared = c * c + (a * a - c * c) * (f64::from(i) + 0.5) / f64::from(cells);
                let worn = end.worn_depth(squared.sqrt());
                assert!(worn > 0.0 && worn <= deepest * (1.0 + 1e-14), "{shape:?}: {worn} at {squared}");
                volume += PI * worn * (a * a - c * c) / f64::from(cells);
            }
            assert!(radius > c && radius < a);
            assert_close(volume / end.worn_volume(), 1.0, 1e-6, &format!("{shape:?}"));
        }
    }

    #[test]
    fn the_end_state_has_no_loop_left() {
        // stick disc alone: T = 2G*cU₀ is below μF∞, and springs at c⁻ are just at their limit
        let (e, g, mu) = (1.0, 0.8, 0.6);
        let end = ConstantDepthEnd::new(unit_parabola(), 1.0, 0.4);
        let amplitude = end.amplitude(mu * e / g);
        assert_close(g * amplitude, mu * e * (1.0 - end.image(0.4 * (1.0 - 1e-12))), 1e-11, "limit at c");
        let force = end.tangential_force(g, amplitude);
        assert!(force < mu * end.normal_force(e));
        let start = TangentialContact {
            normal: NormalContact::at_depth(unit_parabola(), e, 1.0),
            modulus: g,
            friction: mu,
        };
        assert!(force < start.loading(amplitude), "wear has unloaded the ring");
        assert_close(start.stick_radius(amplitude), 0.4, 1e-14, "c");
    }

    #[test]
    fn the_seed_cycle_wears_its_unit() {
        // In gross slip far above u_max a cycle wears 4 (k/σ₀) μF_N U₀; N₀ of them wear 4π a₀² d₀.
        let (k, limit, amplitude, a, d) = (4e-14, 60.0, 1e-3, 2e-4, 3e-6);
        let cycles = seed_cycles(a, d, k, limit, amplitude);
        let volume = gross_slip_volume(k, limit, 4.0 * amplitude * cycles);
        assert_close(volume / (a * a * d), 4.0 * PI, 1e-13, "V in a₀²d₀");
        assert_close(initial_rate(4.0 * limit * amplitude, limit, amplitude), 4.0 * PI, 1e-14, "dV/dÑ");
    }

    #[test]
    fn the_late_flat_is_the_segment_of_the_parabola() {
        // cut at height h: a² = 2Rh, V = π a² h/2
        let (radius, a) = (1e-2, 5e-4);
        let volume = 0.5 * PI * a * a * (a * a / (2.0 * radius));
        assert_close(worn_flat_radius(radius, volume) / a, 1.0, 1e-15, "a");
    }

    #[test]
    #[should_panic(expected = "between the flat and the contact radius")]
    fn a_stick_radius_outside_the_contact_is_refused() {
        ConstantDepthEnd::new(unit_parabola(), 1.0, 1.0);
    }
}
