use super::*;
use std::f64::consts::PI;

/// The transforms at all nodes at once.
struct Nodal(Abel, usize);

impl Nodal {
    fn new(x: &[f64]) -> Self {
        let squares: Vec<f64> = x.iter().map(|x| x * x).collect();
        Self(Abel::new(&squares), x.len())
    }

    fn inverse_abel(&self, v: &[f64]) -> Vec<f64> {
        let mut s = vec![0.0; self.1];
        self.0.inverse_abel(v, &mut s, &mut Vec::new());
        s
    }

    fn abel(&self, s: &[f64]) -> Vec<f64> {
        let mut v = vec![0.0; self.1];
        self.0.abel(s, &mut v, &mut Vec::new());
        v
    }

    fn pressure(&self, q: &[f64]) -> Vec<f64> {
        let mut p = vec![0.0; self.1];
        self.0.pressure(q, &mut p, &mut Vec::new());
        p
    }
}

fn nodes(n: usize, a: f64) -> Vec<f64> {
    (0..=n).map(|i| a * i as f64 / n as f64).collect()
}

#[test]
fn the_inverse_transform_of_a_paraboloid_is_exact() {
    // image x² belongs to profile r²/2
    let x = nodes(7, 2.0);
    let v: Vec<f64> = x.iter().map(|x| x * x).collect();
    for r in [0.0, 0.1, 0.9, 2.0 / 7.0, 2.0] {
        assert!((inverse_at(&x, &v, r) - r * r / 2.0).abs() < 1e-14, "{r}");
    }
    let table = Nodal::new(&x);
    for (r, s) in x.iter().zip(table.inverse_abel(&v)) {
        assert!((s - r * r / 2.0).abs() < 1e-14);
    }
}

#[test]
fn the_inverse_transform_of_a_constant_is_itself() {
    let x = [0.0, 1e-9, 0.3, 0.3 + 1e-9, 1.0];
    let table = Nodal::new(&x);
    assert!(table.inverse_abel(&[4.0; 5]).iter().all(|s| *s == 4.0));
}

#[test]
fn the_transforms_converge_with_their_orders() {
    // image x⁴ ↔ profile (3/8) r⁴; q = (1 − x²)² ↔ p = (2/π)(4/3)(1 − r²)^{3/2}
    let errors = |n: usize| {
        let x = nodes(n, 1.0);
        let table = Nodal::new(&x);
        let v: Vec<f64> = x.iter().map(|x| x.powi(4)).collect();
        let q: Vec<f64> = x.iter().map(|x| (1.0 - x * x).powi(2)).collect();
        let s = table.inverse_abel(&v);
        let inverse = x.iter().zip(s).map(|(r, s)| (s - 0.375 * r.powi(4)).abs()).fold(0.0, f64::max);
        let p = |r: f64| 8.0 / (3.0 * PI) * (1.0 - r * r).powf(1.5);
        let found = table.pressure(&q);
        let pressure = (0..n / 2).map(|i| (found[i] - p(x[i])).abs()).fold(0.0, f64::max);
        (inverse, pressure)
    };
    let (coarse, fine) = (errors(40), errors(160));
    let order = |e: f64, f: f64| (e / f).log2() / 2.0;
    assert!(order(coarse.0, fine.0) > 1.9, "{coarse:?} {fine:?}");
    // the cell next to the singular kernel limits the pressure to order 3/2
    assert!(order(coarse.1, fine.1) > 1.45, "{coarse:?} {fine:?}");
}

#[test]
fn tables_agree_with_the_single_radius_forms() {
    let x: Vec<f64> = nodes(23, 1.0).iter().map(|x| x * x * x + 0.2 * x).collect();
    let v: Vec<f64> = x.iter().map(|x| (3.0 * x).cos()).collect();
    let table = Nodal::new(&x);
    let s = table.inverse_abel(&v);
    let p = table.pressure(&v);
    for i in 0..x.len() {
        assert!((s[i] - inverse_at(&x, &v, x[i])).abs() < 1e-13);
        let of_cell = |j: usize| (v[j] - v[j + 1]) * pressure_weight(x[j], x[j + 1], x[i]);
        let single: f64 = (i..x.len() - 1).map(of_cell).sum();
        assert!((p[i] - single).abs() < 1e-11 * (1.0 + p[i].abs()));
    }
}

#[test]
fn abel_undoes_inverse_abel_even_on_a_strongly_graded_grid() {
    let mut x = nodes(20, 1.0);
    x.extend((1..30).map(|k| 0.5 + 0.01 * 0.5f64.powi(k)));
    x.sort_by(f64::total_cmp);
    x.dedup();
    let v: Vec<f64> = x.iter().map(|x| if *x > 0.5 { 1.0 - x } else { 0.2 * x }).collect();
    let table = Nodal::new(&x);
    let back = table.abel(&table.inverse_abel(&v));
    for (a, b) in v.iter().zip(&back) {
        assert!((a - b).abs() < 1e-9, "{a} {b}");
    }
    let last = x.len() - 1;
    let s = table.inverse_abel(&v);
    let mut cut = v.clone();
    cut[last] = f64::NAN;
    assert!((abel_last(&x, &cut, s[last]) - v[last]).abs() < 1e-12);
}

#[test]
fn a_row_that_has_not_slipped_gives_exactly_nothing() {
    let x = nodes(16, 1.0);
    let table = Nodal::new(&x);
    let v: Vec<f64> = x.iter().map(|x| if *x > 0.5 { x - 0.5 } else { 0.0 }).collect();
    let s = table.inverse_abel(&v);
    assert!(s[..=8].iter().all(|s| *s == 0.0));
    assert!(s[9..].iter().all(|s| *s > 0.0));
}

#[test]
fn a_step_in_the_image_is_a_square_root_cusp() {
    // g = 1 for x > c: f = (2/π) acos(c/r)
    let c = 0.4;
    let x = [0.0, c, c * (1.0 + 1e-12), 0.7, 1.0];
    let s = inverse_at(&x, &[0.0, 0.0, 1.0, 1.0, 1.0], 0.7);
    assert!((s - FRAC_2_PI * (c / 0.7).acos()).abs() < 1e-6);
}

#[test]
fn weights_are_exact_next_to_the_axis_and_next_to_the_radius() {
    // series of the means of (2/π) acos(x/r) over cells narrow against r; at the axis x = √X is not
    // smooth in X
    let axis = |x: f64| 1.0 - 4.0 / (3.0 * PI) * x * (1.0 + x * x / 10.0);
    let rim = |x: f64| ((1.0 - x) * (1.0 + x)).sqrt() * 4.0 / (3.0 * PI) * (1.0 + (1.0 - x) / 5.0);
    for (x0, x1, exact) in [
        (0.0, 1e-3, axis(1e-3)),
        (0.0, 1e-8, axis(1e-8)),
        (1.0 - 1e-7, 1.0, rim(1.0 - 1e-7)),
        (1.0 - 1e-12, 1.0, rim(1.0 - 1e-12)),
    ] {
        let mut weight = f64::NAN;
        inverse_row(&[x0, x1], 1.0, |_, c| weight = c);
        assert!((weight / exact - 1.0).abs() < 4e-14, "{x0} {x1}: {weight:.16e} {exact:.16e}");
    }
}
