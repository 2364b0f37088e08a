use super::*;
use std::f64::consts::{FRAC_2_PI, PI};

/// Errors of the three tables against closed forms on a mesh of n cells.
fn errors(region: Region, n: usize) -> (f64, f64, f64) {
    let mesh = UnitMesh::shared(region, false, n);
    let phi = &mesh.share;
    // z = φ on the annulus: (1/π)∫ X dX/√(Z − X) = 4 Z^{3/2}/(3π); on the disc h = x² : w = r²/2
    let linear: Vec<f64> = phi.clone();
    let w = mesh.inverse_abel(&linear);
    let exact = |z: f64| match region {
        Region::Annulus => 4.0 / (3.0 * PI) * z.powf(1.5),
        Region::Disc => z / 2.0,
    };
    let inverse = (0..=n).map(|i| (w[i] - exact(phi[i])).abs()).fold(0.0, f64::max);
    // z = X²: not linear
    let square: Vec<f64> = phi.iter().map(|x| x * x).collect();
    let w = mesh.inverse_abel(&square);
    let exact = |z: f64| match region {
        Region::Annulus => 16.0 / (15.0 * PI) * z.powf(2.5),
        Region::Disc => 3.0 / 8.0 * z * z,
    };
    let curved = (0..=n).map(|i| (w[i] - exact(phi[i])).abs()).fold(0.0, f64::max);
    // Hertz: q = 1 − X gives (2/π) √(1 − Z)
    let q: Vec<f64> = phi.iter().map(|x| 1.0 - x).collect();
    let p = mesh.pressure(&q, false);
    let hertz = (0..=n).map(|i| (p[i] - FRAC_2_PI * (1.0 - phi[i]).sqrt()).abs()).fold(0.0, f64::max);
    (inverse, hertz, curved)
}

#[test]
fn transforms_are_of_third_order() {
    let region = Region::Annulus;
    let (coarse, fine) = (errors(region, 32), errors(region, 128));
    for (coarse, fine) in [(coarse.0, fine.0), (coarse.2, fine.2)] {
        let order = (coarse / fine).log2() / 2.0;
        assert!(order > 2.8 && fine < 1e-5, "{fine:e}, order {order}");
    }
    // next to the stick edge, where X is a power of ξ
    let order = (coarse.1 / fine.1).log2() / 2.0;
    assert!(order > 1.9 && fine.1 < 2e-4, "Hertz {:e}, order {order}", fine.1);
}

/// Image, depth and pressure of an unworn ball; all else is of second order.
#[test]
fn transforms_on_a_disc_are_exact_for_a_ball() {
    let (coarse, fine) = (errors(Region::Disc, 32), errors(Region::Disc, 128));
    assert!(coarse.0 < 1e-9 && coarse.1 < 1e-12, "{:e} {:e}", coarse.0, coarse.1);
    let order = (coarse.2 / fine.2).log2() / 2.0;
    assert!((1.9..2.2).contains(&order), "order {order}");
}

/// q = (1 − X)³: p = (16/5π) (1 − Z)^{5/2}.
#[test]
fn the_pressure_of_a_steep_edge_is_of_order_two_and_a_half() {
    let error = |n: usize| {
        let mesh = UnitMesh::shared(Region::Annulus, false, n);
        let q: Vec<f64> = mesh.share.iter().map(|x| (1.0 - x).powi(3)).collect();
        let p = mesh.pressure(&q, false);
        let exact = |z: f64| 16.0 / (5.0 * PI) * (1.0 - z).powf(2.5);
        p.iter().zip(&mesh.share).map(|(p, z)| (p - exact(*z)).abs()).fold(0.0, f64::max)
    };
    let (coarse, fine) = (error(32), error(128));
    let order = (coarse / fine).log2() / 2.0;
    assert!(order > 2.4 && fine < 1e-4, "{coarse:e} {fine:e}, order {order}");
}

/// On even places, with the root of the kernel taken out, weights of parabolas in ξ are exact: a
/// disc whose image is 1, and an annulus whose z is 1 (√Z times 2/π).
#[test]
fn constants_are_transformed_exactly() {
    let disc = UnitMesh::shared(Region::Disc, false, 20);
    let w = disc.inverse_abel(&[1.0; 21]);
    assert!(w.iter().all(|w| (w - 1.0).abs() < 2e-9), "{w:?}");
    let annulus = UnitMesh::shared(Region::Annulus, false, 20);
    let w = annulus.inverse_abel(&[1.0; 21]);
    for (w, share) in w.iter().zip(&annulus.share) {
        assert!((w - FRAC_2_PI * share.sqrt()).abs() < 2e-9, "{w} at {share}");
    }
}

/// A depth that is smooth in ξ, on an annulus after division by √φ.
#[test]
fn the_drift_is_of_fourth_order() {
    for region in [Region::Annulus, Region::Disc] {
        // sin 2ξ − 2ξ + (4/3) ξ³, of fifth order at ξ = 0, where the last neighbours are missing
        let error = |n: usize| {
            let mesh = UnitMesh::shared(region, false, n);
            let places = Places { region, power: mesh.power, cells: n };
            let xi = |i: usize| i as f64 / n as f64;
            let smooth = |x: f64| (2.0 * x).sin() - 2.0 * x + 4.0 / 3.0 * x.powi(3);
            let slope = |x: f64| 2.0 * (2.0 * x).cos() - 2.0 + 4.0 * x * x;
            let power = if region == Region::Annulus { 0.5 } else { 0.0 };
            let factor = |i: usize| mesh.share[i].powf(power);
            let values: Vec<f64> = (0..=n).map(|i| factor(i) * smooth(xi(i))).collect();
            let rate = |i: usize| mesh.share[i] / (places.slope(i as f64) * n as f64);
            let off = |i: usize| {
                let exact = power * smooth(xi(i)) + rate(i) * slope(xi(i));
                (mesh.drift_of(&values, i) / factor(i) - exact).abs() / rate(i)
            };
            (1..n).map(off).fold(0.0, f64::max)
        };
        let (coarse, fine) = (error(40), error(80));
        let order = (coarse / fine).log2();
        assert!(order > 3.7 && fine < 1e-5, "{region:?}: {coarse:e} {fine:e}, order {order}");
    }
}

/// The depth of an image that jumps at the stick edge, (2/π) √φ, drifts by half of itself.
#[test]
fn the_drift_of_a_jump_is_exact() {
    let mesh = UnitMesh::shared(Region::Annulus, false, 40);
    let depth: Vec<f64> = mesh.share.iter().map(|share| FRAC_2_PI * share.sqrt()).collect();
    for i in 1..40 {
        let off = mesh.drift_of(&depth, i) / depth[i] - 0.5;
        assert!(off.abs() < 1e-13, "node {i}: {off:e}");
    }
}

/// Half way between nodes: an image and a depth smooth in ξ.
#[test]
fn middles_are_of_third_order() {
    let error = |n: usize| {
        let mesh = UnitMesh::shared(Region::Annulus, false, n);
        let smooth = |i: f64| (3.0 * i / n as f64).cos();
        let nodes: Vec<f64> = (0..=n).map(|i| smooth(i as f64)).collect();
        // without the first cells, which are lines in X
        let off = |values: Vec<f64>| {
            assert_eq!(values.len(), 2 * n + 1);
            let from = |k: usize| (values[k] - smooth(k as f64 / 2.0)).abs();
            (n / 4..=2 * n).map(from).fold(0.0, f64::max)
        };
        assert_eq!(mesh.shares(1), mesh.share);
        (off(mesh.images(2, &nodes)), off(mesh.depths(2, &nodes)))
    };
    let (coarse, fine) = (error(20), error(80));
    for (coarse, fine) in [(coarse.0, fine.0), (coarse.1, fine.1)] {
        let order = (coarse / fine).log2() / 2.0;
        assert!(order > 2.8 && fine < 2e-5, "{coarse:e} {fine:e}, order {order}");
    }
}

#[test]
fn abel_undoes_inverse_abel_and_functionals_agree() {
    for region in [Region::Annulus, Region::Disc] {
        let mesh = UnitMesh::shared(region, false, 40);
        let z: Vec<f64> = mesh.share.iter().map(|x| 0.3 + x - 2.0 * x * x).collect();
        let w = mesh.inverse_abel(&z);
        let back = mesh.abel(&w);
        for (a, b) in z.iter().zip(&back).skip(mesh.first()) {
            assert!((a - b).abs() < 1e-12, "{region:?}: {a} {b}");
        }
        assert!((dot(&mesh.edge_image, &w) - z[40]).abs() < 1e-11);
        let mean: f64 = mesh.width.iter().zip(&z).map(|(f, z)| f * z).sum();
        assert!((dot(&mesh.mean_image, &w) - mean).abs() < 1e-11);
    }
}

#[test]
fn the_volume_is_that_of_the_depth() {
    // disc: w = r²/2 (h = x²): ∫₀¹ 2πr w dr = π/4. Annulus (in L = 1): π ∫ w dZ with w = (4/3π)
    // Z^{3/2}: 8/15
    let error = |region: Region, n: usize, exact: f64| {
        let mesh = UnitMesh::shared(region, false, n);
        let w = mesh.inverse_abel(&mesh.share);
        (dot(&mesh.volume, &w) - exact).abs()
    };
    let disc = error(Region::Disc, 40, PI / 4.0);
    assert!(disc < 1e-9, "{disc:e}");
    let (coarse, fine) = (error(Region::Annulus, 20, 8.0 / 15.0), error(Region::Annulus, 80, 8.0 / 15.0));
    let order = (coarse / fine).log2() / 2.0;
    assert!(order > 2.8 && fine < 1e-5, "{coarse:e} {fine:e}, order {order}");
}

#[test]
fn equal_meshes_are_shared() {
    let (a, b) = (UnitMesh::shared(Region::Disc, false, 24), UnitMesh::shared(Region::Disc, false, 24));
    assert!(Arc::ptr_eq(&a, &b));
    assert!(!Arc::ptr_eq(&a, &UnitMesh::shared(Region::Annulus, false, 24)));
}
