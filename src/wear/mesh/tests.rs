use super::*;
use std::f64::consts::{FRAC_2_PI, PI};

/// Errors of the three tables against closed forms on a mesh of n cells.
fn errors(region: Region, n: usize) -> (f64, f64, f64) {
    let mesh = UnitMesh::shared(region, n);
    let phi = &mesh.share;
    // z = φ on the annulus: (1/π)∫ X dX/√(Z − X) = 4 Z^{3/2}/(3π); on the disc h = x² : w = r²/2
    let mut w = vec![0.0; n + 1];
    let linear: Vec<f64> = phi.clone();
    mesh.inverse_abel(&linear, &mut w);
    let exact = |z: f64| match region {
        Region::Annulus => 4.0 / (3.0 * PI) * z.powf(1.5),
        Region::Disc => z / 2.0,
    };
    let inverse = (0..=n).map(|i| (w[i] - exact(phi[i])).abs()).fold(0.0, f64::max);
    // z = X²: not linear
    let square: Vec<f64> = phi.iter().map(|x| x * x).collect();
    mesh.inverse_abel(&square, &mut w);
    let exact = |z: f64| match region {
        Region::Annulus => 16.0 / (15.0 * PI) * z.powf(2.5),
        Region::Disc => 3.0 / 8.0 * z * z,
    };
    let curved = (0..=n).map(|i| (w[i] - exact(phi[i])).abs()).fold(0.0, f64::max);
    // Hertz: q = 1 − X gives (2/π) √(1 − Z)
    let q: Vec<f64> = phi.iter().map(|x| 1.0 - x).collect();
    let mut p = vec![0.0; n + 1];
    mesh.pressure(&q, false, &mut p);
    let hertz = (0..=n).map(|i| (p[i] - FRAC_2_PI * (1.0 - phi[i]).sqrt()).abs()).fold(0.0, f64::max);
    (inverse, hertz, curved)
}

#[test]
fn transforms_are_exact_for_lines_and_of_second_order_else() {
    for region in [Region::Annulus, Region::Disc] {
        let (inverse, hertz, coarse) = errors(region, 32);
        assert!(inverse < 1e-9 && hertz < 1e-12, "{region:?}: {inverse:e} {hertz:e}");
        let fine = errors(region, 128).2;
        let order = (coarse / fine).log2() / 2.0;
        assert!((1.9..2.2).contains(&order), "{region:?}: order {order}");
    }
}

#[test]
fn the_drift_is_of_fourth_order() {
    for region in [Region::Annulus, Region::Disc] {
        let p = grading(region, 64);
        // w = sin 2ξ − 2ξ + (4/3) ξ³, of fifth order at ξ = 0, where the last neighbours are
        // missing
        let error = |n: usize| {
            let mesh = UnitMesh::graded(region, n, p);
            let xi = |i: usize| i as f64 / n as f64;
            let w = |x: f64| (2.0 * x).sin() - 2.0 * x + 4.0 / 3.0 * x.powi(3);
            let slope = |x: f64| 2.0 * (2.0 * x).cos() - 2.0 + 4.0 * x * x;
            let values: Vec<f64> = (0..=n).map(|i| w(xi(i))).collect();
            let rate = |x: f64| x * (p + 1.0 - p * x) / (p * (p + 1.0) * (1.0 - x));
            let off = |i: usize| (mesh.drift_of(&values, i) / rate(xi(i)) - slope(xi(i))).abs();
            (1..n).map(off).fold(0.0, f64::max)
        };
        let (coarse, fine) = (error(40), error(80));
        let order = (coarse / fine).log2();
        assert!(order > 3.7 && fine < 1e-5, "{region:?}: {coarse:e} {fine:e}, order {order}");
    }
}

#[test]
fn abel_undoes_inverse_abel_and_functionals_agree() {
    for region in [Region::Annulus, Region::Disc] {
        let mesh = UnitMesh::shared(region, 40);
        let z: Vec<f64> = mesh.share.iter().map(|x| 0.3 + x - 2.0 * x * x).collect();
        let (mut w, mut back) = (vec![0.0; 41], vec![0.0; 41]);
        mesh.inverse_abel(&z, &mut w);
        back[0] = z[0];
        mesh.abel(&w, &mut back);
        for (a, b) in z.iter().zip(&back) {
            assert!((a - b).abs() < 1e-12, "{region:?}: {a} {b}");
        }
        assert!((mesh.edge_image.of(&w, z[0]) - z[40]).abs() < 1e-11);
        let mean: f64 = mesh.width.iter().zip(&z).map(|(f, z)| f * z).sum();
        assert!((mesh.mean_image.of(&w, z[0]) - mean).abs() < 1e-11);
    }
}

#[test]
fn the_volume_is_that_of_the_depth() {
    // disc: w = r²/2 (h = x²): ∫₀¹ 2πr w dr = π/4. Annulus (in L = 1): π ∫ w dZ with w = (4/3π)
    // Z^{3/2}: 8/15
    for (region, exact) in [(Region::Disc, PI / 4.0), (Region::Annulus, 8.0 / 15.0)] {
        let mesh = UnitMesh::shared(region, 40);
        let mut w = vec![0.0; 41];
        mesh.inverse_abel(&mesh.share, &mut w);
        let volume = mesh.volume.of(&w, 0.0);
        assert!((volume - exact).abs() < 1e-10, "{region:?}: {volume} against {exact}");
    }
}

#[test]
fn equal_meshes_are_shared() {
    let (a, b) = (UnitMesh::shared(Region::Disc, 24), UnitMesh::shared(Region::Disc, 24));
    assert!(Arc::ptr_eq(&a, &b));
    assert!(!Arc::ptr_eq(&a, &UnitMesh::shared(Region::Annulus, 24)));
}
