//! Tangential contact with Coulomb friction after a normal load that is then held.
//!
//! Cattaneo (1938) and Mindlin (1949) for spheres; Jäger (1995) and Ciavarella (1998) for any
//! axisymmetric profile: the sheared contact is μ times the difference of two normal contacts of
//! the same body, the real one and the one whose radius is the stick radius c, g(c) = d − G*
//! U/(μE*). On reversal the same holds for the change since then, with half the displacement and
//! twice the force (Masing).
//!
//! Sign: T has the sign of the displacement that causes it.

use super::normal::NormalContact;
use super::quadrature::{Node, integrate};
use super::shape::Shape;
use std::f64::consts::{FRAC_2_PI, PI};

/// Contact whose normal force is a power of depth, F_N ∝ dᵐ: parabola m = 3/2, cone m = 2, flat
/// punch m = 1, power law m = 1 + 1/n. Everything is closed in θ = U/u_max.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MonomialContact {
    /// m ≥ 1.
    pub exponent: f64,
    /// μF_N, N.
    pub friction_limit: f64,
    /// u_max = μ d E*/G*, m, > 0: the displacement from rest at which the last spring slips.
    pub full_slip: f64,
}

impl MonomialContact {
    /// The friction limit and full-slip displacement of `normal` for G* = `tangential_modulus` (Pa)
    /// and μ = `friction`.
    ///
    /// # Panics
    /// For the shapes with a rim, whose force is no power of depth.
    pub fn new(normal: &NormalContact, tangential_modulus: f64, friction: f64) -> Self {
        let exponent = match normal.shape() {
            Shape::Parabola { .. } => 1.5,
            Shape::Cone { .. } => 2.0,
            Shape::PowerLaw { exponent, .. } => 1.0 + 1.0 / exponent,
            Shape::FlatPunch { .. } => 1.0,
            other => panic!("the force of {other:?} is no power of depth"),
        };
        Self {
            exponent,
            friction_limit: friction * normal.force(),
            full_slip: friction * normal.depth() * normal.modulus() / tangential_modulus,
        }
    }

    /// T on first loading to `displacement` (m, any sign), N: μF_N [1 − (1 − θ)ᵐ].
    pub fn loading(&self, displacement: f64) -> f64 {
        let theta = (displacement.abs() / self.full_slip).min(1.0);
        self.friction_limit * (1.0 - (1.0 - theta).powf(self.exponent)).copysign(displacement)
    }

    /// T at `displacement` on the way back from the first reversal at `reversal` (both m), N:
    /// T = T(reversal) − 2 T((reversal − displacement)/2). Holds up to the opposite reversal, and
    /// by symmetry on every later branch of the closed loop.
    pub fn returning(&self, reversal: f64, displacement: f64) -> f64 {
        self.loading(reversal) - 2.0 * self.loading(0.5 * (reversal - displacement))
    }

    /// c/a on first loading: (1 − θ)^(m − 1); 0 in gross slip.
    pub fn stick_ratio(&self, displacement: f64) -> f64 {
        let theta = displacement.abs() / self.full_slip;
        if theta < 1.0 { (1.0 - theta).powf(self.exponent - 1.0) } else { 0.0 }
    }

    /// Friction work of one closed loop between ±`amplitude` (m), J. A first quarter from rest
    /// dissipates one fourth.
    ///
    /// θ ≤ 1: μF_N u_max {4θ + 4θ(1−θ)ᵐ − [8/(m+1)] [1 − (1−θ)^(m+1)]}; θ > 1: 4μF_N [U₀ −
    /// 2u_max/(m+1)].
    pub fn loop_work(&self, amplitude: f64) -> f64 {
        let (m, theta) = (self.exponent, amplitude.abs() / self.full_slip);
        let unit = self.friction_limit * self.full_slip;
        if theta > 1.0 {
            return 4.0 * unit * (theta - 2.0 / (m + 1.0));
        }
        if theta > 0.1 {
            let sticking = 1.0 - theta;
            let lost = 8.0 / (m + 1.0) * (1.0 - sticking.powf(m + 1.0));
            return unit * (4.0 * theta * (1.0 + sticking.powf(m)) - lost);
        }
        // The braces are of order θ³ and would cancel. As the sum over the springs they are
        // 4m(m−1) ∫₀^θ y (θ − y) (1 − y)^(m−2) dy, expanded in powers of y.
        let (mut series, mut coefficient) = (0.0, 1.0);
        for k in 0..20 {
            let k = f64::from(k);
            series += coefficient / ((k + 2.0) * (k + 3.0));
            coefficient *= theta * (k - (m - 2.0)) / (k + 1.0);
        }
        4.0 * unit * m * (m - 1.0) * theta.powi(3) * series
    }
}

/// Contact of any [`Shape`] under a constant normal load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TangentialContact {
    /// The normal contact.
    pub normal: NormalContact,
    /// G*, Pa.
    pub modulus: f64,
    /// μ > 0.
    pub friction: f64,
}

impl TangentialContact {
    /// μ E*/G*: a spring's limit of displacement per depth of compression; also the largest dU/dd
    /// that U and d can rise with together, from any state, without slip.
    pub fn slip_ratio(&self) -> f64 {
        self.friction * self.normal.modulus() / self.modulus
    }

    /// u_max = μ d E*/G*, m.
    pub fn full_slip(&self) -> f64 {
        self.slip_ratio() * self.normal.depth()
    }

    /// The normal contact of the stick disc on first loading: its radius is c. Bodies apart means
    /// gross slip.
    fn sticking(&self, displacement: f64) -> NormalContact {
        let depth = self.normal.depth() - displacement.abs() / self.slip_ratio();
        NormalContact::at_depth(self.normal.shape(), self.normal.modulus(), depth)
    }

    /// c on first loading to `displacement` (m, any sign), m; 0 in gross slip.
    pub fn stick_radius(&self, displacement: f64) -> f64 {
        self.sticking(displacement).radius()
    }

    /// T on first loading, N: μ [F_N(a) − F_N(c)].
    ///
    /// Also T after a normal load that was first higher and then fell to the present one at the
    /// held displacement: every spring then carries min(U, μq/G*) with the present q, as on first
    /// loading.
    pub fn loading(&self, displacement: f64) -> f64 {
        self.friction * (self.normal.force() - self.sticking(displacement).force()).copysign(displacement)
    }

    /// T at `displacement` on the way back from the first reversal at `reversal` (both m), N; see
    /// [`MonomialContact::returning`].
    pub fn returning(&self, reversal: f64, displacement: f64) -> f64 {
        self.loading(reversal) - 2.0 * self.loading(0.5 * (reversal - displacement))
    }

    /// ∂T/∂U on first loading, N/m: 2G* c.
    pub fn stiffness(&self, displacement: f64) -> f64 {
        2.0 * self.modulus * self.stick_radius(displacement)
    }

    /// τ(r) on first loading, Pa: μ [p(r; a) − p(r; c)].
    pub fn traction(&self, displacement: f64, r: f64) -> f64 {
        let stuck = self.sticking(displacement);
        self.friction * (self.normal.pressure(r) - stuck.pressure(r)).copysign(displacement)
    }

    /// U − u₃(r) on first loading, m, for r ≤ a: how far the moving body has slid over the
    /// substrate at radius r.
    ///
    /// (2/π) ∫ [U − μq/G*] dx / √(r² − x²) over c < x < r; in gross slip U − μE*/G* · (d − f(r)).
    pub fn slip(&self, displacement: f64, r: f64) -> f64 {
        let (stuck, shape) = (self.sticking(displacement), self.normal.shape());
        let c = stuck.radius();
        let distance = if c == 0.0 {
            displacement.abs() - self.slip_ratio() * (self.normal.depth() - shape.height(r))
        } else if r <= c {
            0.0
        } else {
            let kernel = |n: Node| (shape.image(n.x) - stuck.depth()) / (n.to_end * (r + n.x)).sqrt();
            self.slip_ratio() * FRAC_2_PI * integrate(c, r, kernel)
        };
        distance.copysign(displacement)
    }

    /// Friction work of one closed loop between ±`amplitude` (m), J. A first quarter from rest
    /// dissipates one fourth.
    ///
    /// Between reversals a spring that slips at all slides 2 (U₀ − μq/G*) under the force μq, hence
    /// W = 8 ∫ μq (U₀ − μq/G*) dx over c < x < a; by quadrature.
    pub fn loop_work(&self, amplitude: f64) -> f64 {
        let amplitude = amplitude.abs();
        let c = self.stick_radius(amplitude);
        let density = |x: f64| {
            let limit = self.friction * self.normal.line_force(x);
            8.0 * limit * (amplitude - limit / self.modulus).max(0.0)
        };
        let rim = self.normal.shape().flat_radius().max(c);
        let on_flat = if c == 0.0 { rim * density(0.0) } else { 0.0 };
        on_flat + integrate(rim, self.normal.radius(), |n| density(n.x))
    }

    /// Worn volume of one closed loop between ±`amplitude` (m) at frozen profile, from the local
    /// law Δf = (k/σ₀) · 4 μ p(r) s(r), per k/σ₀: 4μ ∫ 2πr p s dr, J. Equals [`Self::loop_work`];
    /// by nested quadrature, slow, and not for the flat punch, whose p and s are both those of its
    /// edge.
    pub fn loop_work_from_fields(&self, amplitude: f64) -> f64 {
        let amplitude = amplitude.abs();
        let (a, c) = (self.normal.radius(), self.stick_radius(amplitude));
        let ring = |n: Node| {
            let pressure = self.normal.pressure(n.x);
            // rounding puts nodes on the blunted sphere's rim, where the logarithm of p has no
            // weight
            if pressure.is_finite() { 2.0 * PI * n.x * pressure * self.slip(amplitude, n.x) } else { 0.0 }
        };
        let rim = self.normal.shape().flat_radius().max(c);
        let on_flat = if c == 0.0 { integrate(0.0, rim, ring) } else { 0.0 };
        4.0 * self.friction * (on_flat + integrate(rim, a, ring))
    }
}

/// ΔT while U and d rise together at dU/dd = `ratio`, N, for a rise of the normal force by
/// `force_rise` (N): (dU/dd)(G*/E*) ΔF_N. From any state, `ratio` at most μE*/G* in size: no spring
/// slips.
pub fn oblique_rise(ratio: f64, tangential_modulus: f64, normal_modulus: f64, force_rise: f64) -> f64 {
    ratio * tangential_modulus / normal_modulus * force_rise
}

/// τ(r) on the sphere on first loading, Pa (Cattaneo–Mindlin): μp₀ √(1 − r²/a²), less μp₀ (c/a) √(1
/// − r²/c²) inside c.
pub fn sphere_traction(friction: f64, central_pressure: f64, a: f64, c: f64, r: f64) -> f64 {
    let dome = |radius: f64| ((radius - r).max(0.0) * (radius + r)).sqrt() / a;
    friction * central_pressure * (dome(a) - dome(c))
}

/// U − u₃(r) on the parabola R in partial slip with stick radius c, m, per μE*/G*, for c < r ≤ a:
/// [(r² − 2c²) acos(c/r) + c √(r² − c²)] / (πR).
pub fn parabola_slip(radius: f64, c: f64, r: f64) -> f64 {
    ((r * r - 2.0 * c * c) * (c / r).acos() + c * ((r - c) * (r + c)).sqrt()) / (PI * radius)
}

/// U − u₃(r) on the cone in partial slip with stick radius c, m, per μE*/G*, for c < r ≤ a:
/// tanθ [√(r² − c²) − c·acos(c/r)].
pub fn cone_slip(slope: f64, c: f64, r: f64) -> f64 {
    slope.tan() * (((r - c) * (r + c)).sqrt() - c * (c / r).acos())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::shape::tests::SHAPES;
    use Shape::{BluntedSphere, Cone, FlatPunch, Parabola, PowerLaw, RoundedPunch};

    const E_STAR: f64 = 210e9 / (2.0 * (1.0 - 0.09));
    /// G* = 2 G/(2 − ν) with G = E/2.6.
    const G_STAR: f64 = 2.0 * 210e9 / 2.6 / 1.7;
    const MU: f64 = 0.6;
    const THETAS: [f64; 6] = [0.05, 0.25, 0.5, 0.75, 1.0, 1.5];

    fn assert_close(value: f64, exact: f64, tolerance: f64, what: &str) {
        let error = (value - exact).abs();
        assert!(error <= tolerance * exact.abs(), "{what}: {value:e} against {exact:e}");
    }

    fn contact(shape: Shape) -> TangentialContact {
        TangentialContact {
            normal: NormalContact::at_force(shape, E_STAR, 100.0),
            modulus: G_STAR,
            friction: MU,
        }
    }

    fn monomial(contact: &TangentialContact) -> MonomialContact {
        MonomialContact::new(&contact.normal, contact.modulus, contact.friction)
    }

    fn has_rim(shape: &Shape) -> bool {
        matches!(shape, BluntedSphere { .. } | RoundedPunch { .. })
    }

    #[test]
    fn steel_numbers() {
        let ball = contact(Parabola { radius: 0.01 });
        let closed = monomial(&ball);
        assert_close(G_STAR, 95.0226e9, 5e-7, "G*");
        assert_close(ball.full_slip(), 2.53755e-6, 2e-6, "u_max");
        assert_close(ball.stiffness(0.0), 35.4673e6, 2e-6, "2G*a");
        for (theta, force, work) in [
            (0.25, 21.0289, 1.27356e-6),
            (0.5, 38.7868, 11.0828e-6),
            (0.75, 52.5, 41.8696e-6),
            (1.0, 60.0, 121.802e-6),
        ] {
            let u = theta * closed.full_slip;
            assert_close(closed.loading(u), force, 3e-6, "T₀");
            assert_close(closed.loop_work(u), work, 5e-6, "W");
        }
        let blunted = contact(BluntedSphere { radius: 0.01, flat_radius: 1e-4 });
        assert_close(blunted.full_slip(), 2.20050e-6, 3e-6, "u_max, blunted");
    }

    #[test]
    fn contact_code_case() {
        // R = 10 mm, G = 80 GPa, ν = 0.3, F_N = 20 N, μ = 0.6, θ = 0.6 (both bodies)
        let (e, g) = (80e9 / (1.0 - 0.3), 80e9 / (1.0 - 0.15));
        let normal = NormalContact::at_force(Parabola { radius: 0.01 }, e, 20.0);
        let closed = MonomialContact::new(&normal, g, 0.6);
        let u = 0.6 * closed.full_slip;
        assert_close(closed.loading(u), 8.9642, 5e-6, "T₀");
        assert_close(closed.loop_work(u), 1.37269e-6, 4e-6, "W");
    }

    #[test]
    fn the_superposition_is_the_closed_form_for_monomials() {
        for contact in SHAPES.iter().filter(|s| !has_rim(s)).map(|&s| contact(s)) {
            let closed = monomial(&contact);
            for theta in THETAS {
                let (u, what) =
                    (theta * closed.full_slip, format!("{:?} at {theta}", contact.normal.shape()));
                assert_close(contact.loading(u), closed.loading(u), 1e-13, &what);
                assert_close(contact.loading(-u), -closed.loading(u), 1e-13, &what);
                for fraction in [0.9, 0.1, -0.6, -1.0] {
                    let (there, back) =
                        (contact.returning(u, fraction * u), closed.returning(u, fraction * u));
                    assert!(
                        (there - back).abs() <= 1e-13 * closed.friction_limit,
                        "{what}, back to {fraction}"
                    );
                }
                let ratio = contact.stick_radius(u) / contact.normal.radius();
                // (c/a)ⁿ = 1 − θ, and 1/n = m − 1: the rounding of the depth shows through this
                // power at θ = 1
                let rounding = 1e-15f64.powf((closed.exponent - 1.0).min(1.0)).max(1e-13);
                let tolerance = if theta == 1.0 { rounding } else { 1e-13 };
                assert!((ratio - closed.stick_ratio(u)).abs() <= tolerance, "{what}: {ratio}");
                let (work, exact) = (contact.loop_work(u), closed.loop_work(u));
                // the difference U₀ − μq/G* loses digits at small θ
                let rounding = 1e-14 * closed.friction_limit * closed.full_slip;
                assert!(
                    (work - exact).abs() <= 1e-12 * exact + rounding,
                    "{what}: {work:e} against {exact:e}"
                );
            }
        }
    }

    /// ∫ u dx over the springs as eq. (13) leaves them: min(U, μq/G*).
    #[test]
    fn the_force_is_the_sum_over_the_springs() {
        for contact in SHAPES.map(contact) {
            for theta in THETAS {
                let u = theta * contact.full_slip();
                let (b, c) = (contact.normal.shape().flat_radius(), contact.stick_radius(u));
                let limit = |x: f64| contact.friction * contact.normal.line_force(x) / contact.modulus;
                let rim = b.max(c);
                let sum = rim * u.min(limit(0.0)) + integrate(rim, contact.normal.radius(), |n| limit(n.x));
                let what = format!("{:?} at {theta}", contact.normal.shape());
                assert_close(2.0 * contact.modulus * sum, contact.loading(u), 1e-10, &what);
            }
        }
    }

    #[test]
    fn the_loop_work_is_the_area_of_the_loop() {
        for contact in SHAPES.map(contact) {
            for theta in THETAS {
                let u0 = theta * contact.full_slip();
                // both branches have their kink (start of gross slip) at a return by 2 u_max
                let kink = (u0 - 2.0 * contact.full_slip()).max(-u0);
                let branch = |n: Node| contact.returning(u0, n.x);
                let area = -2.0 * (integrate(kink, u0, branch) + integrate(-u0, kink, branch));
                let work = contact.loop_work(u0);
                let scale = contact.friction * contact.normal.force() * contact.full_slip();
                let what = format!("{:?} at {theta}", contact.normal.shape());
                assert!((area - work).abs() <= 1e-11 * scale, "{what}: {area:e} against {work:e}");
            }
        }
    }

    #[test]
    fn the_first_quarter_dissipates_one_fourth() {
        for contact in SHAPES.map(contact) {
            for theta in THETAS {
                let u0 = theta * contact.full_slip();
                let kink = u0.min(contact.full_slip());
                let input =
                    integrate(0.0, kink, |n| contact.loading(n.x)) + contact.loading(u0) * (u0 - kink);
                let (c, b) = (contact.stick_radius(u0), contact.normal.shape().flat_radius());
                let limit = |x: f64| contact.friction * contact.normal.line_force(x) / contact.modulus;
                let rim = b.max(c);
                let squares = rim * u0.min(limit(0.0)).powi(2)
                    + integrate(rim, contact.normal.radius(), |n| limit(n.x).powi(2));
                let dissipated = input - contact.modulus * squares;
                let error = (4.0 * dissipated - contact.loop_work(u0)).abs();
                let scale = contact.friction * contact.normal.force() * contact.full_slip();
                assert!(error <= 1e-10 * scale, "{:?} at {theta}: {error:e}", contact.normal.shape());
            }
        }
    }

    #[test]
    fn small_loops_keep_their_digits() {
        let closed = MonomialContact { exponent: 1.5, friction_limit: 1.0, full_slip: 1.0 };
        // leading term 4m(m−1)θ³/6 = θ³/2; next relative term (2−m)θ/2
        assert_close(closed.loop_work(1e-4), 0.5e-12 * (1.0 + 0.25e-4), 1e-8, "W(1e-4)");
        let formula = |theta: f64| {
            let stick: f64 = 1.0 - theta;
            4.0 * theta * (1.0 + stick.powf(1.5)) - 3.2 * (1.0 - stick.powf(2.5))
        };
        assert_close(closed.loop_work(0.1), formula(0.1), 1e-11, "series at its end");
    }

    #[test]
    fn the_traction_is_the_cattaneo_mindlin_one_and_sums_to_the_force() {
        let ball = contact(Parabola { radius: 0.01 });
        for theta in [0.25, 0.6, 1.2] {
            let u = theta * ball.full_slip();
            let (a, c) = (ball.normal.radius(), ball.stick_radius(u));
            for r in [0.0, 0.2 * a, 0.7 * a, 0.99 * a] {
                let exact = sphere_traction(MU, ball.normal.central_pressure(), a, c, r);
                assert_close(ball.traction(u, r), exact, 1e-13, "τ");
                assert_eq!(ball.traction(-u, r), -ball.traction(u, r));
            }
        }
        for contact in
            SHAPES.map(contact).into_iter().filter(|c| !matches!(c.normal.shape(), FlatPunch { .. }))
        {
            let u = 0.6 * contact.full_slip();
            let b = contact.normal.shape().flat_radius();
            let (c, a) = (contact.stick_radius(u), contact.normal.radius());
            // rounding puts nodes on the blunted sphere's rim, with no weight
            let ring = |n: Node| if n.x == b { 0.0 } else { 2.0 * PI * n.x * contact.traction(u, n.x) };
            let sum = integrate(0.0, b, ring) + integrate(b, c, ring) + integrate(c, a, ring);
            assert_close(sum, contact.loading(u), 1e-10, &format!("{:?}", contact.normal.shape()));
        }
    }

    #[test]
    fn the_slip_is_the_closed_one_on_parabola_and_cone() {
        let (radius, slope) = (0.01, 0.02);
        for theta in [0.3, 0.84] {
            let (ball, cone) = (contact(Parabola { radius }), contact(Cone { slope }));
            for ratio in [0.2, 0.5, 0.9, 1.0] {
                let between = |c: f64, a: f64| c + ratio * (a - c);
                let (u, a) = (theta * ball.full_slip(), ball.normal.radius());
                let (c, r) = (ball.stick_radius(u), between(ball.stick_radius(u), a));
                assert_close(
                    ball.slip(u, r),
                    ball.slip_ratio() * parabola_slip(radius, c, r),
                    1e-12,
                    "parabola",
                );
                assert_eq!(ball.slip(u, 0.99 * c), 0.0);
                let (u, a) = (theta * cone.full_slip(), cone.normal.radius());
                let (c, r) = (cone.stick_radius(u), between(cone.stick_radius(u), a));
                assert_close(cone.slip(-u, r), -cone.slip_ratio() * cone_slip(slope, c, r), 1e-12, "cone");
            }
        }
    }

    /// u₃(r) by its definition, eq. (16), on a shape without closed form, in partial and in gross
    /// slip.
    #[test]
    fn the_slip_is_what_the_surface_displacement_leaves() {
        for shape in
            [BluntedSphere { radius: 0.01, flat_radius: 1e-4 }, PowerLaw { exponent: 3.0, coefficient: 1e5 }]
        {
            let contact = contact(shape);
            for theta in [0.5, 1.3] {
                let u0 = theta * contact.full_slip();
                let (c, r) = (contact.stick_radius(u0), 0.95 * contact.normal.radius());
                let u = |x: f64| (contact.friction * contact.normal.line_force(x) / contact.modulus).min(u0);
                let kernel = |x: f64, to_end: f64| u(x) / (to_end * (r + x)).sqrt();
                let rim = c.max(shape.flat_radius());
                let inner = integrate(0.0, rim, |n| kernel(n.x, r - n.x));
                let surface = FRAC_2_PI * (inner + integrate(rim, r, |n| kernel(n.x, n.to_end)));
                assert_close(contact.slip(u0, r), u0 - surface, 1e-11, &format!("{shape:?} at {theta}"));
            }
        }
    }

    /// The identity behind wear = (k/σ₀) · friction work, for a frozen profile.
    #[test]
    fn the_fields_dissipate_the_loop_work() {
        for shape in [
            Parabola { radius: 0.01 },
            Cone { slope: 0.02 },
            PowerLaw { exponent: 1.5, coefficient: 0.4 },
            BluntedSphere { radius: 0.01, flat_radius: 1e-4 },
            RoundedPunch { radius: 0.01, flat_radius: 1e-4 },
        ] {
            let contact = contact(shape);
            for theta in [0.3, 0.8, 1.4] {
                let u0 = theta * contact.full_slip();
                let (fields, loops) = (contact.loop_work_from_fields(u0), contact.loop_work(u0));
                assert_close(fields, loops, 1e-10, &format!("{shape:?} at {theta}"));
            }
        }
    }

    #[test]
    fn an_oblique_rise_at_the_slip_ratio_ends_at_the_friction_limit() {
        let ball = contact(Parabola { radius: 0.01 });
        let force = ball.normal.force();
        let rise = oblique_rise(ball.slip_ratio(), G_STAR, E_STAR, force);
        assert_close(rise, MU * force, 1e-15, "T at dU/dd = μE*/G*");
        // below it, the springs carry (dU/dd)(d − g) each
        let ratio = 0.4 * ball.slip_ratio();
        let sum = integrate(0.0, ball.normal.radius(), |n| ratio * ball.normal.line_force(n.x) / E_STAR);
        assert_close(oblique_rise(ratio, G_STAR, E_STAR, force), 2.0 * G_STAR * sum, 1e-13, "T below");
    }

    #[test]
    #[should_panic(expected = "no power of depth")]
    fn a_rim_has_no_closed_loop() {
        monomial(&contact(RoundedPunch { radius: 0.01, flat_radius: 1e-4 }));
    }
}
