use super::*;
use std::f64::consts::{FRAC_2_PI, PI};

type Grading = (&'static str, fn(f64) -> f64);

/// Shapes of unit meshes.
const GRADINGS: [Grading; 4] = [
    ("even", |xi| xi),
    ("cubic", |xi| xi.powi(3)),
    ("towards both ends", |xi| xi.powi(3) * (4.0 - 3.0 * xi)),
    ("geometric over twelve decades", |xi| (27.0 * xi).exp_m1() / 27f64.exp_m1()),
];

fn nodes(grading: fn(f64) -> f64, cells: usize) -> Vec<f64> {
    (0..=cells).map(|i| grading(i as f64 / cells as f64)).collect()
}

fn values(x: &[f64], f: impl Fn(f64) -> f64) -> Vec<f64> {
    x.iter().map(|&x| f(x)).collect()
}

fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |most, value| if value.is_nan() { f64::NAN } else { most.max(value.abs()) })
}

/// Largest difference over the largest value.
fn difference(a: &[f64], b: &[f64]) -> f64 {
    largest(a.iter().zip(b).map(|(a, b)| a - b)) / largest(b.iter().copied())
}

/// Result of one transform, on memory that holds nonsense.
fn apply(transform: impl Fn(&[f64], &mut [f64], &mut Vec<f64>), values: &[f64]) -> Vec<f64> {
    let mut out = vec![f64::NAN; values.len()];
    transform(values, &mut out, &mut Vec::new());
    out
}

fn abel(tables: &Abel, s: &[f64]) -> Vec<f64> {
    apply(|s, o, t| tables.abel(s, o, t), s)
}

#[test]
fn what_is_linear_is_transformed_exactly() {
    for (name, grading) in GRADINGS {
        let x = nodes(grading, 700);
        let tables = Abel::new(&x);
        let end = x[700];
        // image x² belongs to profile r²/2
        let profile = values(&x, |z| z / 2.0);
        let s = apply(|v, o, t| tables.inverse_abel(v, o, t), &x);
        assert!(difference(&s, &profile) < 1e-13, "{name}: {:e}", difference(&s, &profile));
        let back = abel(&tables, &profile);
        assert!(difference(&back, &x) < 1e-9, "{name}, back: {:e}", difference(&back, &x));
        let constant = vec![0.7; 701];
        assert_eq!(apply(|v, o, t| tables.inverse_abel(v, o, t), &constant), constant);
        // Hertz; q is given to rounding only, which a narrow cell turns into pressure
        let p = apply(|v, o, t| tables.pressure(v, o, t), &values(&x, |x| end - x));
        let error = difference(&p, &values(&x, |z| FRAC_2_PI * (end - z).sqrt()));
        let narrowest = x.windows(2).map(|pair| pair[1] - pair[0]).fold(1.0, f64::min);
        assert!(error < 1e-13 + f64::EPSILON / narrowest.sqrt(), "{name}, Hertz: {error:e}");
    }
}

/// Largest errors on a mesh of so many cells against closed forms that are not linear: both
/// directions of v = X² and of v = √X, and the pressures of q = (1 − X)² and of q = √(1 − X), which
/// is constant.
fn errors(grading: fn(f64) -> f64, cells: usize) -> [f64; 6] {
    let x = nodes(grading, cells);
    let tables = Abel::new(&x);
    let error = |result: Vec<f64>, exact: &[f64]| largest(result.iter().zip(exact).map(|(a, b)| a - b));
    let (square, square_down) = (values(&x, |x| x * x), values(&x, |z| 0.375 * z * z));
    let (root, root_down) = (values(&x, f64::sqrt), values(&x, |z| FRAC_2_PI * z.sqrt()));
    let smooth = apply(|v, o, t| tables.pressure(v, o, t), &values(&x, |x| (1.0 - x).powi(2)));
    // up to the cell next to the edge, where it jumps
    let edge = apply(|v, o, t| tables.pressure(v, o, t), &values(&x, |x| (1.0 - x).max(0.0).sqrt()));
    let inside = x.partition_point(|&z| z < 0.75);
    [
        error(apply(|v, o, t| tables.inverse_abel(v, o, t), &square), &square_down),
        error(abel(&tables, &square_down), &square),
        error(apply(|v, o, t| tables.inverse_abel(v, o, t), &root), &root_down),
        error(abel(&tables, &root_down), &root),
        error(smooth, &values(&x, |z| 8.0 / (3.0 * PI) * (1.0 - z).powf(1.5))),
        error(edge[..inside].to_vec(), &vec![0.5; inside]),
    ]
}

#[test]
fn errors_fall_with_their_orders() {
    // second order where cells follow the data; x = √X has the root of the first cell's width for
    // error, both ways; the pressure loses half an order to the cell next to its singular kernel
    for ((name, grading), expected) in GRADINGS.into_iter().zip([
        [2.0, 2.0, 0.5, 0.5, 1.5, 1.5],
        [2.0, 2.0, 1.5, 1.5, 1.5, 1.5],
        [2.0, 2.0, 1.5, 1.5, 1.5, 1.5],
        [2.0, 2.0, 2.0, 2.0, 1.5, 1.5],
    ]) {
        let (coarse, fine) = (errors(grading, 500), errors(grading, 2000));
        for (case, ((coarse, fine), expected)) in coarse.into_iter().zip(fine).zip(expected).enumerate() {
            let order = (coarse / fine).log2() / 2.0;
            assert!(
                (order - expected).abs() < 0.1,
                "{name}, case {case}: {coarse:e} {fine:e}, order {order}"
            );
        }
    }
}

#[test]
fn transforms_are_causal_to_the_last_digit() {
    let x = nodes(GRADINGS[2].1, 1500);
    let tables = Abel::new(&x);
    for edge in [1, 40, 777, 1499] {
        // what comes later may be anything
        let v: Vec<f64> = (0..=1500).map(|i| if i <= edge { (i as f64).cos() } else { f64::NAN }).collect();
        let s = apply(|v, o, t| tables.inverse_abel(v, o, t), &v);
        let back = abel(&tables, &s);
        assert!(s[..=edge].iter().chain(&back[..=edge]).all(|s| s.is_finite()));
        assert!(s[edge + 1..].iter().all(|s| s.is_nan()));
        let q: Vec<f64> = v.iter().rev().copied().collect();
        let p = apply(|v, o, t| tables.pressure(v, o, t), &q);
        assert!(p[1500 - edge..].iter().all(|p| p.is_finite()));
        assert!(p[..1500 - edge].iter().all(|p| p.is_nan()));
        // what has not slipped stays exactly where it is
        let slip: Vec<f64> = (0..=1500).map(|i| if i <= edge { 0.0 } else { 1.0 }).collect();
        let s = apply(|v, o, t| tables.inverse_abel(v, o, t), &slip);
        assert!(s[..=edge].iter().all(|s| *s == 0.0) && s[edge + 1..].iter().all(|s| *s > 0.0));
        assert!(abel(&tables, &s)[..=edge].iter().all(|v| *v == 0.0));
    }
}

#[test]
fn the_buffer_carries_nothing_from_one_call_to_the_next() {
    let (long, short) = (nodes(GRADINGS[1].1, 2000), nodes(GRADINGS[0].1, 900));
    let (of_long, of_short) = (Abel::new(&long), Abel::new(&short));
    let (v, w) = (values(&long, f64::cos), values(&short, f64::exp));
    let (mut buffer, mut out) = (Vec::new(), vec![0.0; 2001]);
    of_long.inverse_abel(&v, &mut out, &mut buffer);
    of_short.pressure(&w, &mut out[..901], &mut buffer);
    assert_eq!(out[..901], apply(|v, o, t| of_short.pressure(v, o, t), &w));
    of_short.inverse_abel(&w, &mut out[..901], &mut buffer);
    assert_eq!(out[..901], apply(|v, o, t| of_short.inverse_abel(v, o, t), &w));
    of_long.inverse_abel(&v, &mut out, &mut buffer);
    assert_eq!(out, apply(|v, o, t| of_long.inverse_abel(v, o, t), &v));
}

/// Values that begin to change at a node, and a load that ends at another.
#[test]
fn some_nodes_have_the_values_that_they_have_among_all() {
    for (nodes, first, end) in [(100, 37, 81), (100, 1, 100), (300, 37, 38), (300, 90, 211), (300, 150, 300)]
    {
        let x: Vec<f64> = (0..nodes).map(|i| (i as f64 / (nodes - 1) as f64).powi(2)).collect();
        let transforms = Abel::new(&x);
        let values = |from: usize, to: usize| -> Vec<f64> {
            (0..nodes).map(|i| 1.0 + x[i.clamp(from, to)].sin()).collect()
        };
        let (slip, load) = (values(first - 1, nodes), values(0, end - 1));
        let mut buffer = Vec::new();
        let (mut all, mut some) = (vec![0.0; nodes], vec![0.0; nodes]);
        transforms.inverse_abel(&slip, &mut all, &mut buffer);
        transforms.inverse_abel_at(first..end, &slip, &mut some, &mut buffer);
        let mut off: Vec<f64> = (first..end).map(|i| some[i] - all[i]).collect();
        transforms.pressure(&load, &mut all, &mut buffer);
        transforms.pressure_at(first..end, &load, &mut some, &mut buffer);
        off.extend((first..end).map(|i| some[i] - all[i]));
        assert!(off.iter().all(|off| off.abs() < 1e-12), "{nodes} nodes, {first} to {end}");
    }
}

#[test]
fn transforms_scale_with_the_width_of_the_mesh() {
    // what lets the tables of a unit mesh serve all meshes of its shape
    let share: Vec<f64> = (0..=300).map(|i| (f64::from(i) / 300.0).powi(2)).collect();
    let v: Vec<f64> = share.iter().map(|x| 1.0 + x.sin()).collect();
    let width = 2.25;
    let x: Vec<f64> = share.iter().map(|x| width * x).collect();
    let (unit, wide) = (Abel::new(&share), Abel::new(&x));
    let (mut a, mut b) = (vec![0.0; 301], vec![0.0; 301]);
    unit.inverse_abel(&v, &mut a, &mut Vec::new());
    wide.inverse_abel(&v, &mut b, &mut Vec::new());
    assert!(a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 1e-12));
    unit.pressure(&v, &mut a, &mut Vec::new());
    wide.pressure(&v, &mut b, &mut Vec::new());
    let root = f64::sqrt(width);
    assert!(a.iter().zip(&b).all(|(a, b)| (a / root - b).abs() < 1e-10));
}
