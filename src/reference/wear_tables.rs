//! Wear histories that have no closed form, computed independently to a stated uncertainty.
//!
//! All in seed units: lengths along the surface in a₀, depths in d₀, volumes in a₀² d₀, cycles as Ñ
//! = N/N₀ ([`super::wear::seed_cycles`]); a₀, d₀, F_N of the unworn body at the start. Scenes of
//! Dimaki et al. 2014.

/// Stick radius at the start of every partial-slip table, c₀/a₀.
pub const INITIAL_STICK_RATIO: f64 = 0.4;

/// Parabola at constant depth: (Ñ, V).
pub const PARABOLA_CONSTANT_DEPTH: [(f64, f64); 4] =
    [(0.16, 0.268719), (0.36, 0.619257), (0.64, 0.959203), (1.0, 1.097833)];
/// Relative uncertainty of [`PARABOLA_CONSTANT_DEPTH`].
pub const CONSTANT_DEPTH_UNCERTAINTY: f64 = 2e-6;

/// One row of a history at constant normal force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConstantForceRow {
    /// Ñ.
    pub cycles: f64,
    /// d/d₀.
    pub depth: f64,
    /// c/a₀.
    pub stick_radius: f64,
    /// V/(a₀² d₀).
    pub volume: f64,
    /// Deepest wear /d₀.
    pub deepest: f64,
}

const fn row(cycles: f64, depth: f64, stick_radius: f64, volume: f64, deepest: f64) -> ConstantForceRow {
    ConstantForceRow { cycles, depth, stick_radius, volume, deepest }
}

/// Parabola at constant force.
pub const PARABOLA_CONSTANT_FORCE: [ConstantForceRow; 5] = [
    row(0.04, 1.01901, 0.42037, 0.06256, 0.0333),
    row(0.16, 1.07225, 0.45126, 0.26740, 0.1190),
    row(0.36, 1.15562, 0.4624, 0.64986, 0.2377),
    row(0.64, 1.25818, 0.4626, 1.19591, 0.3681),
    row(1.0, 1.35234, 0.4627, 1.7487, 0.4717),
];
/// Cone at constant force.
pub const CONE_CONSTANT_FORCE: [ConstantForceRow; 5] = [
    row(0.1, 1.04151, 0.42537, 0.16528, 0.0713),
    row(0.4, 1.14765, 0.4317, 0.75813, 0.2254),
    row(0.9, 1.25466, 0.4317, 1.54435, 0.3400),
    row(1.6, 1.3209, 0.4317, 2.1335, 0.4005),
    row(2.5, 1.3542, 0.4317, 2.4619, 0.4295),
];
/// Relative uncertainty of the deepest wear in the constant-force rows; the later ones are the less
/// certain.
pub const CONSTANT_FORCE_UNCERTAINTY: f64 = 3e-3;
/// Relative uncertainty of their depths and volumes.
pub const CONSTANT_FORCE_VOLUME_UNCERTAINTY: f64 = 1e-4;

/// Flat punch of radius b in gross slip over a path s: (S, p(0)/p_mean), S = κE*s/b, κ = kμ/σ₀.
/// Given to its last digit.
pub const FLAT_PUNCH_GROSS_SLIP: [(f64, f64); 5] =
    [(0.05, 0.5441), (0.2, 0.6367), (0.5, 0.7702), (1.0, 0.9016), (2.0, 0.9855)];
/// Sphere at constant force in gross slip over a path s: (S, central wear w₀/d₀), S = κE*s/a₀.
/// Given to its last digit.
pub const SPHERE_GROSS_SLIP: [(f64, f64); 5] =
    [(0.5, 0.277275), (1.0, 0.489101), (2.0, 0.797111), (5.0, 1.371819), (10.0, 1.992577)];
/// Half a unit of the last digit of [`FLAT_PUNCH_GROSS_SLIP`] and [`SPHERE_GROSS_SLIP`], relative,
/// rounded up.
pub const GROSS_SLIP_UNCERTAINTY: f64 = 4e-4;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::normal::NormalContact;
    use crate::reference::shape::Shape;
    use crate::reference::tangential::MonomialContact;
    use crate::reference::wear::{ConstantDepthEnd, initial_rate};
    use std::f64::consts::FRAC_2_PI;

    fn unit_scene(shape: Shape) -> (f64, f64) {
        let law = MonomialContact::new(&NormalContact::at_depth(shape, 1.0, 1.0), 1.0, 1.0);
        let end = ConstantDepthEnd::new(shape, 1.0, INITIAL_STICK_RATIO);
        let amplitude = end.amplitude(1.0);
        (initial_rate(law.loop_work(amplitude), law.friction_limit, amplitude), end.worn_volume())
    }

    #[test]
    fn the_constant_depth_history_lies_between_its_exact_start_and_end() {
        let (rate, end) = unit_scene(Shape::Parabola { radius: 1.0 });
        let mut before = (0.0, 0.0);
        for (cycles, volume) in PARABOLA_CONSTANT_DEPTH {
            assert!(volume > before.1 && volume < end);
            // running-in makes the rate rise at first, above the initial one by less than 20 %
            assert!((volume - before.1) / (cycles - before.0) < 1.2 * rate);
            before = (cycles, volume);
        }
        assert!(end - before.1 < 0.04 * end);
    }

    #[test]
    fn the_constant_force_histories_start_at_the_exact_rate() {
        let cone = Shape::Cone { slope: FRAC_2_PI.atan() };
        for (shape, table) in
            [(Shape::Parabola { radius: 1.0 }, PARABOLA_CONSTANT_FORCE), (cone, CONE_CONSTANT_FORCE)]
        {
            let (rate, _) = unit_scene(shape);
            // the first row's mean rate exceeds the initial one by what running-in adds
            let mean = table[0].volume / table[0].cycles;
            assert!(mean > rate && mean < 1.12 * rate, "{mean} against {rate}");
            for pair in table.windows(2) {
                assert!(pair[1].depth > pair[0].depth && pair[1].stick_radius >= pair[0].stick_radius);
                assert!(pair[1].volume > pair[0].volume && pair[1].deepest > pair[0].deepest);
            }
        }
    }

    #[test]
    fn gross_slip_starts_from_the_unworn_pressures() {
        // flat punch: p(0)/p_mean = 1/2 unworn, 1 when worn in
        let first = FLAT_PUNCH_GROSS_SLIP[0];
        assert!(first.1 > 0.5 && FLAT_PUNCH_GROSS_SLIP.windows(2).all(|w| w[0].1 < w[1].1 && w[1].1 < 1.0));
        // sphere: dw₀/ds = κ p(0), so w₀/d₀ < S (2/π) with p(0) = (2/π) E* d₀/a₀ falling as it
        // wears
        assert!(SPHERE_GROSS_SLIP.iter().all(|&(s, worn)| worn < FRAC_2_PI * s));
        assert!(SPHERE_GROSS_SLIP[0].1 > 0.85 * FRAC_2_PI * 0.5);
        // late: a⁴ = 4RV/π with w₀ ≈ a²/(2R) and V = κF_N s gives (w₀/d₀)² → (4/3π) S in seed units
        let (s, worn) = SPHERE_GROSS_SLIP[4];
        assert!((worn * worn / (4.0 / (3.0 * std::f64::consts::PI) * s) - 1.0).abs() < 0.1);
    }
}
