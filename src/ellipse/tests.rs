use super::*;
use std::f64::consts::FRAC_PI_2;

/// ∫ over a quarter turn of a smooth function that is even about both ends: the midpoint rule
/// converges faster than any power.
fn quarter(n: usize, f: impl Fn(f64) -> f64) -> f64 {
    let step = FRAC_PI_2 / n as f64;
    (0..n).map(|i| step * f((i as f64 + 0.5) * step)).sum()
}

#[test]
fn the_integrals_are_those_of_their_definition() {
    for k in [1.0, 0.999_999, 0.9, 0.5, 0.1, 0.01] {
        let root = |t: f64| (t.cos().powi(2) + (k * t.sin()).powi(2)).sqrt();
        let (b, d) =
            (quarter(4000, |t| t.cos().powi(2) / root(t)), quarter(4000, |t| t.sin().powi(2) / root(t)));
        let found = Integrals::new(k);
        assert!((found.k / (b + d) - 1.0).abs() < 1e-13, "K({k})");
        assert!((found.share / (d / (b + d)) - 1.0).abs() < 1e-13, "D/K({k})");
    }
    let circle = Integrals::new(1.0);
    assert_eq!((circle.k, circle.share), (FRAC_PI_2, 0.5));
}

/// For small k, K = Λ + (Λ − 1) k²/4 and E = 1 + (Λ − 1/2) k²/2 with Λ = ln(4/k), to fourth order
/// in k.
#[test]
fn long_ellipses_follow_the_expansion_of_the_integrals() {
    for k in [1e-3, 1e-5, 1e-9] {
        let long = f64::ln(4.0 / k);
        let (first, second) = (long + (long - 1.0) * k * k / 4.0, 1.0 + (long - 0.5) * k * k / 2.0);
        let share = (first - second) / ((1.0 - k * k) * first);
        let found = Integrals::new(k);
        assert!((found.k / first - 1.0).abs() < 1e-11 && (found.share / share - 1.0).abs() < 1e-11, "{k}");
    }
}

/// The error of the sum falls like the square of that before: quadratic convergence.
#[test]
fn the_mean_converges_quadratically() {
    let terms = |k: f64| {
        let (mut mean, mut root, mut ratio) = (1.0, k, 1.0);
        let square = (1.0 - k) * (1.0 + k);
        (0..5)
            .map(|_| {
                (mean, root) = (0.5 * (mean + root), f64::sqrt(mean * root));
                ratio *= ratio * square / (16.0 * mean * mean);
                ratio
            })
            .collect::<Vec<f64>>()
    };
    for k in [0.5, 0.1, 0.01] {
        for pair in terms(k).windows(2).filter(|pair| pair[0] < 0.1 && pair[1] > 1e-200) {
            let order = pair[1].ln() / pair[0].ln();
            assert!(order > 2.0, "{k}: {order}");
        }
    }
}

/// The relation of the radii holds at the axis ratio that is found, for all that are accepted.
#[test]
fn the_axis_ratio_solves_the_relation_of_the_radii() {
    let mut last = 1.0 + 1e-9;
    for step in 0..=600 {
        let ratio = 10f64.powf(f64::from(step) / 100.0);
        let k = axis_ratio(ratio);
        let found = Integrals::new(k).ratio_of_radii(k);
        assert!((found / ratio - 1.0).abs() < 2e-14, "{ratio}: {found}, k = {k}");
        assert!(k < last, "{ratio}: {k} {last}");
        last = k;
    }
    // next to a circle ln k = −(2/3) ln(R_major/R_minor)
    let near = axis_ratio(1.0 + 1e-8);
    assert!((near - (1.0 - 2e-8 / 3.0)).abs() < 1e-15, "{near}");
    assert_eq!(axis_ratio(1.0), 1.0);
}

/// The moduli from the displacement at the centre under Q/(2πab) (1 − x²/a² − y²/b²)^(−1/2) by
/// Cerruti's solution: u = (1/(2πG)) ∫ q ((1 − ν)/s + ν x²/s³) dA, of which the radial part is
/// (π/2) s(φ) for the distance s(φ) of the edge.
#[test]
fn the_moduli_are_those_of_cerrutis_solution() {
    let materials = Pair {
        body_1: Elastic { youngs_modulus: 70e9, poisson_ratio: 0.33 },
        body_2: Elastic { youngs_modulus: 210e9, poisson_ratio: 0.2 },
    };
    for (radius_x, radius_y) in [(0.01, 0.01), (0.02, 0.005), (0.004, 0.13)] {
        let ellipse = HertzianEllipse::new(radius_x, radius_y).unwrap();
        let [a, b] = ellipse.semi_axis_factors();
        let displacement = |body: &Elastic, axis: usize| {
            let nu = body.poisson_ratio;
            let turn = 4.0
                * quarter(2000, |phi| {
                    let edge = 1.0 / (phi.cos() / a).hypot(phi.sin() / b);
                    let along = if axis == 0 { phi.cos() } else { phi.sin() };
                    (1.0 - nu + nu * along * along) * FRAC_PI_2 * edge
                });
            turn / (2.0 * PI * body.shear_modulus() * 2.0 * PI * a * b)
        };
        for axis in 0..2 {
            // per unit of force; a rigid slip of 1 of the equivalent sphere takes 2 G* · 1
            let total = displacement(&materials.body_1, axis) + displacement(&materials.body_2, axis);
            let modulus = ellipse.tangential_moduli(&materials)[axis];
            assert!((2.0 * modulus * total - 1.0).abs() < 1e-12, "{radius_x} {radius_y} {axis}");
        }
    }
}

/// A sphere is a sphere: shape and moduli to rounding, and no jump next to it.
#[test]
fn equal_radii_give_the_sphere() {
    let steel = Pair { body_1: Elastic::STEEL, body_2: Elastic::STEEL };
    for (radius_y, tolerance) in [(0.01, 1e-15), (0.01 * (1.0 + 1e-13), 1e-12), (0.01 * (1.0 - 1e-13), 1e-12)]
    {
        let ellipse = HertzianEllipse::new(0.01, radius_y).unwrap();
        assert!((ellipse.equivalent_radius() / 0.01 - 1.0).abs() <= tolerance);
        for factor in ellipse.semi_axis_factors() {
            assert!((factor - 1.0).abs() <= tolerance, "{factor}");
        }
        for modulus in ellipse.tangential_moduli(&steel) {
            assert!((modulus / steel.tangential_modulus() - 1.0).abs() <= tolerance, "{modulus}");
        }
    }
}

/// Which axis is x decides the names alone.
#[test]
fn the_axes_may_be_exchanged() {
    let materials =
        Pair { body_1: Elastic::STEEL, body_2: Elastic { youngs_modulus: 1e9, poisson_ratio: 0.45 } };
    let (one, other) = (HertzianEllipse::new(0.3, 0.002).unwrap(), HertzianEllipse::new(0.002, 0.3).unwrap());
    assert_eq!(one.equivalent_radius(), other.equivalent_radius());
    let turned = |[x, y]: [f64; 2]| [y, x];
    assert_eq!(one.semi_axis_factors(), turned(other.semi_axis_factors()));
    assert_eq!(one.tangential_moduli(&materials), turned(other.tangential_moduli(&materials)));
    // the contact is longer, and the row of springs softer, along the larger radius
    let ([a, b], [along, across]) = (one.semi_axis_factors(), one.tangential_moduli(&materials));
    assert!(a > 1.0 && b < 1.0 && along < across);
}

#[test]
fn radii_outside_their_range_are_named() {
    for (radius_x, radius_y, name) in [
        (0.0, 0.01, "radius_x"),
        (0.01, -0.01, "radius_y"),
        (f64::NAN, 0.01, "radius_x"),
        (0.01, f64::INFINITY, "radius_y"),
        (1.000_001, 1e-6, "radius_x"),
        (1e-6, 1.000_001, "radius_y"),
    ] {
        match HertzianEllipse::new(radius_x, radius_y) {
            Err(Error::Parameter { name: found, .. }) => assert_eq!(found, name),
            other => panic!("{radius_x}, {radius_y}: {other:?}"),
        }
    }
    assert!(HertzianEllipse::new(1.0, 1e-6).is_ok());
}

/// The pressure of the ellipse presses the centre in by d: Boussinesq's solution, and its integral
/// is the force.
#[test]
fn the_depth_is_that_of_boussinesqs_solution() {
    for (radius_x, radius_y) in [(0.02, 0.005), (0.005, 0.3), (10.0, 0.001)] {
        let ellipse = HertzianEllipse::new(radius_x, radius_y).unwrap();
        let [a, b] = ellipse.semi_axis_factors();
        // equivalent sphere of contact radius 1 and E* = 1: d = 1/R_e, F = 4/(3 R_e), p0 =
        // 3F/(2πab)
        let p0 = 2.0 / (PI * ellipse.equivalent_radius() * a * b);
        // w(0) = (1/(πE*)) ∫ p/s dA, of which the radial part is p0 (π/4) s(φ) up to the edge s(φ)
        let depth = p0 * quarter(40_000, |phi| 1.0 / (phi.cos() / a).hypot(phi.sin() / b));
        let expected = 1.0 / ellipse.equivalent_radius();
        assert!((depth / expected - 1.0).abs() < 1e-12, "{radius_x} {radius_y}: {}", depth / expected);
    }
}
