use super::*;
use crate::transform::DenseAbel;
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

/// Clusters of narrow cells in between wide ones, so that leaves differ in width by many decades.
fn clusters(cells: usize) -> Vec<f64> {
    let mut x = vec![0.0];
    for j in 0..cells {
        let width = 10f64.powf(-6.0 * (j as f64 * 0.013).sin().abs() - (j as f64 * 1.7).cos());
        x.push(x[j] + width);
    }
    x
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
fn apply(transform: impl Fn(&[f64], &mut [f64], &mut Scratch), values: &[f64]) -> Vec<f64> {
    let mut out = vec![f64::NAN; values.len()];
    transform(values, &mut out, &mut Scratch::default());
    out
}

fn abel(fast: &FastAbel, s: &[f64]) -> Vec<f64> {
    apply(|s, o, t| fast.abel(s, o, t), s)
}

#[test]
fn what_is_linear_is_transformed_exactly() {
    for (name, grading) in GRADINGS {
        let x = nodes(grading, 700);
        let fast = FastAbel::new(&x);
        let end = x[700];
        // image x² belongs to profile r²/2
        let profile = values(&x, |z| z / 2.0);
        let s = apply(|v, o, t| fast.inverse_abel(v, o, t), &x);
        assert!(difference(&s, &profile) < 1e-13, "{name}: {:e}", difference(&s, &profile));
        let back = abel(&fast, &profile);
        assert!(difference(&back, &x) < 1e-9, "{name}, back: {:e}", difference(&back, &x));
        let constant = vec![0.7; 701];
        assert_eq!(apply(|v, o, t| fast.inverse_abel(v, o, t), &constant), constant);
        // Hertz; q is given to rounding only, which a narrow cell turns into pressure
        let p = apply(|v, o, t| fast.pressure(v, o, t), &values(&x, |x| end - x));
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
    let fast = FastAbel::new(&x);
    let error = |result: Vec<f64>, exact: &[f64]| largest(result.iter().zip(exact).map(|(a, b)| a - b));
    let (square, square_down) = (values(&x, |x| x * x), values(&x, |z| 0.375 * z * z));
    let (root, root_down) = (values(&x, f64::sqrt), values(&x, |z| FRAC_2_PI * z.sqrt()));
    let smooth = apply(|v, o, t| fast.pressure(v, o, t), &values(&x, |x| (1.0 - x).powi(2)));
    // up to the cell next to the edge, where it jumps
    let edge = apply(|v, o, t| fast.pressure(v, o, t), &values(&x, |x| (1.0 - x).max(0.0).sqrt()));
    let inside = x.partition_point(|&z| z < 0.75);
    [
        error(apply(|v, o, t| fast.inverse_abel(v, o, t), &square), &square_down),
        error(abel(&fast, &square_down), &square),
        error(apply(|v, o, t| fast.inverse_abel(v, o, t), &root), &root_down),
        error(abel(&fast, &root_down), &root),
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
fn the_fast_form_is_the_dense_one() {
    let meshes = GRADINGS.iter().map(|&(name, grading)| (name, nodes(grading, 3000)));
    for (name, x) in meshes.chain([("clusters", clusters(3000)), ("short", clusters(60))]) {
        let (dense, fast) = (DenseAbel::new(&x), FastAbel::new(&x));
        let width = x[x.len() - 1];
        let v = values(&x, |x| (7.0 * x / width).cos() + (x / width).sqrt());
        let check = |what: &str, fast: &[f64], dense: &[f64], most: f64| {
            let error = difference(fast, dense);
            assert!(error < most, "{name}, {what}: {error:e}");
        };
        let s = apply(|v, o, t| dense.inverse_abel(v, o, t), &v);
        check("inverse", &apply(|v, o, t| fast.inverse_abel(v, o, t), &v), &s, 1e-13);
        let p = apply(|v, o, t| dense.pressure(v, o, t), &v);
        check("pressure", &apply(|v, o, t| fast.pressure(v, o, t), &v), &p, 1e-13);
        let back = abel(&fast, &s);
        check("there and back", &apply(|v, o, t| fast.inverse_abel(v, o, t), &back), &s, 1e-13);
        // narrow cells far out leave the inverse badly conditioned, the dense one as well
        let most = if name == "clusters" { 1e-9 } else { 1e-11 };
        let mut dense_back = vec![v[0]; v.len()];
        dense.abel(&s, &mut dense_back, &mut Scratch::default());
        check("Abel", &back, &dense_back, most);
        check("there and back", &back, &v, most);
    }
}

#[test]
fn some_meshes_have_exact_weights_for_leaves_that_do_not_adjoin() {
    let tree = Tree::new(&clusters(3000));
    let pairs = tree.pairs();
    assert!(Sweep::inverse(&tree, &pairs).has_sources_apart());
    assert!(Sweep::pressure(&tree, &pairs).has_sources_apart());
}

#[test]
fn work_grows_in_proportion_to_the_cells() {
    for (name, grading) in GRADINGS {
        let work = |cells: usize| FastAbel::new(&nodes(grading, cells)).work();
        let (few, many) = (work(4096), work(32_768));
        for (few, many) in [(few.0, many.0), (few.1, many.1)] {
            let exponent = (many as f64 / few as f64).log2() / 3.0;
            assert!(exponent < 1.05, "{name}: {few} to {many}, exponent {exponent}");
            assert!(many < 140 * 32_768, "{name}: {many}");
        }
    }
    // where cells grow by several per cent each, all leaves are neighbours: then it is that of the
    // tables
    for cells in [200, 400, 1000] {
        let x = nodes(GRADINGS[3].1, cells);
        let (dense, fast) = (DenseAbel::new(&x), FastAbel::new(&x));
        assert!(fast.work() <= dense.work(), "{cells}: {:?} {:?}", fast.work(), dense.work());
    }
}

#[test]
fn transforms_are_causal_to_the_last_digit() {
    let x = nodes(GRADINGS[2].1, 1500);
    let fast = FastAbel::new(&x);
    for edge in [1, 40, 777, 1499] {
        // what comes later may be anything
        let v: Vec<f64> = (0..=1500).map(|i| if i <= edge { (i as f64).cos() } else { f64::NAN }).collect();
        let s = apply(|v, o, t| fast.inverse_abel(v, o, t), &v);
        let back = abel(&fast, &s);
        assert!(s[..=edge].iter().chain(&back[..=edge]).all(|s| s.is_finite()));
        assert!(s[edge + 1..].iter().all(|s| s.is_nan()));
        let q: Vec<f64> = v.iter().rev().copied().collect();
        let p = apply(|v, o, t| fast.pressure(v, o, t), &q);
        assert!(p[1500 - edge..].iter().all(|p| p.is_finite()));
        assert!(p[..1500 - edge].iter().all(|p| p.is_nan()));
        // what has not slipped stays exactly where it is
        let slip: Vec<f64> = (0..=1500).map(|i| if i <= edge { 0.0 } else { 1.0 }).collect();
        let s = apply(|v, o, t| fast.inverse_abel(v, o, t), &slip);
        assert!(s[..=edge].iter().all(|s| *s == 0.0) && s[edge + 1..].iter().all(|s| *s > 0.0));
        assert!(abel(&fast, &s)[..=edge].iter().all(|v| *v == 0.0));
    }
}

#[test]
fn scratch_carries_nothing_from_one_call_to_the_next() {
    let (long, short) = (nodes(GRADINGS[1].1, 2000), nodes(GRADINGS[0].1, 900));
    let (of_long, of_short) = (FastAbel::new(&long), FastAbel::new(&short));
    let (v, w) = (values(&long, f64::cos), values(&short, f64::exp));
    let (mut scratch, mut out) = (Scratch::default(), vec![0.0; 2001]);
    of_long.inverse_abel(&v, &mut out, &mut scratch);
    of_short.pressure(&w, &mut out[..901], &mut scratch);
    assert_eq!(out[..901], apply(|v, o, t| of_short.pressure(v, o, t), &w));
    of_short.inverse_abel(&w, &mut out[..901], &mut scratch);
    assert_eq!(out[..901], apply(|v, o, t| of_short.inverse_abel(v, o, t), &w));
    of_long.inverse_abel(&v, &mut out, &mut scratch);
    assert_eq!(out, apply(|v, o, t| of_long.inverse_abel(v, o, t), &v));
}
