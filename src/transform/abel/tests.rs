use super::*;
use crate::transform::cell;
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

/// Rows of exact weights: row i has those of the values at nodes 0 … i.
fn rows(square: &[f64]) -> Vec<Vec<f64>> {
    let root = values(square, f64::sqrt);
    let row = |i: usize| {
        let mut row = vec![0.0; i + 1];
        cell::add_inverse(square, &root, square[i], 0..i, &mut row);
        row
    };
    (1..square.len()).map(row).collect()
}

fn sum(row: &[f64], values: &[f64]) -> f64 {
    row.iter().zip(values).map(|(weight, value)| weight * value).sum()
}

/// The inverse Abel transform, its inverse and the pressure by all weights of all cells.
fn inverse_abel_by_sums(square: &[f64], v: &[f64]) -> Vec<f64> {
    std::iter::once(v[0]).chain(rows(square).iter().map(|row| sum(row, v))).collect()
}

fn abel_by_sums(square: &[f64], s: &[f64]) -> Vec<f64> {
    let mut v = vec![s[0]];
    for (row, s) in rows(square).iter().zip(&s[1..]) {
        let (diagonal, before) = row.split_last().expect("a row has two weights at least");
        v.push((s - sum(before, &v)) / diagonal);
    }
    v
}

fn pressure_by_sums(square: &[f64], q: &[f64]) -> Vec<f64> {
    let last = square.len() - 1;
    let drops: Vec<f64> = q.windows(2).map(|pair| pair[0] - pair[1]).collect();
    let at = |i: usize| {
        let mut weights = vec![0.0; last - i];
        cell::pressure(square, square[i], i..last, &mut weights);
        sum(&weights, &drops[i..])
    };
    (0..last).map(at).chain([0.0]).collect()
}

#[test]
fn what_is_linear_is_transformed_exactly() {
    for (name, grading) in GRADINGS {
        // image x² belongs to profile r²/2
        let x = nodes(grading, 700);
        let transforms = Abel::new(&x);
        let s = apply(|v, o, t| transforms.inverse_abel(v, o, t), &x);
        let half = values(&x, |z| z / 2.0);
        assert!(difference(&s, &half) < 1e-13, "{name}, paraboloid: {:e}", difference(&s, &half));
        let back = apply(|s, o, t| transforms.abel(s, o, t), &half);
        assert!(difference(&back, &x) < 1e-9, "{name}, paraboloid back: {:e}", difference(&back, &x));
        let constant = vec![0.7; 701];
        assert_eq!(apply(|v, o, t| transforms.inverse_abel(v, o, t), &constant), constant);
        assert_eq!(apply(|s, o, t| transforms.abel(s, o, t), &constant), constant);
        // Hertz; q is given to rounding only, which a narrow cell turns into pressure
        let p = apply(|v, o, t| transforms.pressure(v, o, t), &values(&x, |x| 1.0 - x));
        let error = difference(&p, &values(&x, |z| FRAC_2_PI * (1.0 - z).max(0.0).sqrt()));
        let narrowest = x.windows(2).map(|pair| pair[1] - pair[0]).fold(1.0, f64::min);
        assert!(error < 1e-13 + f64::EPSILON / narrowest.sqrt(), "{name}, Hertz: {error:e}");
    }
}

/// Largest errors on a mesh of so many cells against closed forms that are not linear: both
/// directions of v = X² and of v = √X, and the pressures of q = (1 − X)² and of q = √(1 − X), which
/// is constant.
fn errors(grading: fn(f64) -> f64, cells: usize) -> [f64; 6] {
    let x = nodes(grading, cells);
    let transforms = Abel::new(&x);
    let error = |result: Vec<f64>, exact: &[f64]| largest(result.iter().zip(exact).map(|(a, b)| a - b));
    let (square, square_down) = (values(&x, |x| x * x), values(&x, |z| 3.0 / 8.0 * z * z));
    let (root, root_down) = (values(&x, f64::sqrt), values(&x, |z| FRAC_2_PI * z.sqrt()));
    let smooth = apply(|v, o, t| transforms.pressure(v, o, t), &values(&x, |x| (1.0 - x).powi(2)));
    // up to the cell next to the edge, where it jumps
    let edge = apply(|v, o, t| transforms.pressure(v, o, t), &values(&x, |x| (1.0 - x).max(0.0).sqrt()));
    let inside = x.partition_point(|&z| z < 0.75);
    [
        error(apply(|v, o, t| transforms.inverse_abel(v, o, t), &square), &square_down),
        error(apply(|s, o, t| transforms.abel(s, o, t), &square_down), &square),
        error(apply(|v, o, t| transforms.inverse_abel(v, o, t), &root), &root_down),
        error(apply(|s, o, t| transforms.abel(s, o, t), &root_down), &root),
        error(smooth, &values(&x, |z| 8.0 / (3.0 * PI) * (1.0 - z).powf(1.5))),
        error(edge[..inside].to_vec(), &vec![0.5; inside]),
    ]
}

/// Second order where cells follow the data. √X costs the root of the first cell, and the pressure
/// loses half an order to the cell next to its singular kernel.
#[test]
fn errors_fall_with_their_orders() {
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
fn blocks_and_far_fields_give_the_sums_of_all_cells() {
    let meshes = GRADINGS.iter().map(|&(name, grading)| (name, nodes(grading, 3000)));
    for (name, x) in
        meshes.chain([("clusters", clusters(3000)), ("short", clusters(60)), ("two", clusters(1))])
    {
        let (transforms, width) = (Abel::new(&x), x[x.len() - 1]);
        let v = values(&x, |x| (7.0 * x / width).cos() + (x / width).sqrt());
        let check = |what: &str, result: &[f64], exact: &[f64], most: f64| {
            let error = difference(result, exact);
            assert!(error < most, "{name}, {what}: {error:e}");
        };
        let s = inverse_abel_by_sums(&x, &v);
        check("inverse", &apply(|v, o, t| transforms.inverse_abel(v, o, t), &v), &s, 1e-13);
        let p = apply(|v, o, t| transforms.pressure(v, o, t), &v);
        check("pressure", &p, &pressure_by_sums(&x, &v), 1e-13);
        let back = apply(|s, o, t| transforms.abel(s, o, t), &s);
        check("there and back", &apply(|v, o, t| transforms.inverse_abel(v, o, t), &back), &s, 1e-13);
        // narrow cells far out leave the inverse badly conditioned, by whichever way
        let most = if name == "clusters" { 1e-9 } else { 1e-11 };
        check("Abel", &back, &abel_by_sums(&x, &s), most);
        check("back", &back, &v, most);
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
        let work = |cells: usize| Abel::new(&nodes(grading, cells)).work();
        let (few, many) = (work(4096), work(32_768));
        for (few, many) in [(few.0, many.0), (few.1, many.1)] {
            let exponent = (many as f64 / few as f64).log2() / 3.0;
            assert!(exponent < 1.05, "{name}: {few} to {many}, exponent {exponent}");
            assert!(many < 140 * 32_768, "{name}: {many}");
        }
    }
    // where cells grow by several per cent each, all leaves are neighbours: then all weights of all
    // cells are there, and no more
    for cells in [200, 400, 1000] {
        let work = Abel::new(&nodes(GRADINGS[3].1, cells)).work();
        let all = cells * (cells + 1) / 2;
        assert!(work.0 <= all + cells && work.1 <= all, "{cells}: {work:?}");
    }
}

#[test]
fn transforms_are_causal_to_the_last_digit() {
    let x = nodes(GRADINGS[2].1, 1500);
    let transforms = Abel::new(&x);
    for edge in [1, 40, 777, 1499] {
        // what comes later may be anything
        let v: Vec<f64> = (0..=1500).map(|i| if i <= edge { (i as f64).cos() } else { f64::NAN }).collect();
        let s = apply(|v, o, t| transforms.inverse_abel(v, o, t), &v);
        let back = apply(|s, o, t| transforms.abel(s, o, t), &s);
        assert!(s[..=edge].iter().chain(&back[..=edge]).all(|s| s.is_finite()));
        assert!(s[edge + 1..].iter().all(|s| s.is_nan()));
        let q: Vec<f64> = v.iter().rev().copied().collect();
        let p = apply(|v, o, t| transforms.pressure(v, o, t), &q);
        assert!(p[1500 - edge..].iter().all(|p| p.is_finite()));
        assert!(p[..1500 - edge].iter().all(|p| p.is_nan()));
        // what has not slipped stays exactly where it is
        let slip: Vec<f64> = (0..=1500).map(|i| if i <= edge { 0.0 } else { 1.0 }).collect();
        let s = apply(|v, o, t| transforms.inverse_abel(v, o, t), &slip);
        assert!(s[..=edge].iter().all(|s| *s == 0.0) && s[edge + 1..].iter().all(|s| *s > 0.0));
        let back = apply(|s, o, t| transforms.abel(s, o, t), &s);
        assert!(back[..=edge].iter().all(|v| *v == 0.0));
    }
}

#[test]
fn the_width_of_the_mesh_changes_no_transform_and_its_root_divides_the_pressure() {
    let share = nodes(|xi| xi * xi, 300);
    let (width, v) = (2.25, values(&share, |x| 1.0 + x.sin()));
    let (unit, wide) = (Abel::new(&share), Abel::new(&values(&share, |x| width * x)));
    let a = apply(|v, o, t| unit.inverse_abel(v, o, t), &v);
    assert!(difference(&apply(|v, o, t| wide.inverse_abel(v, o, t), &v), &a) < 1e-12);
    let a = apply(|v, o, t| unit.pressure(v, o, t), &v);
    let b = values(&apply(|v, o, t| wide.pressure(v, o, t), &v), |p| p * width.sqrt());
    assert!(difference(&b, &a) < 1e-12);
}

#[test]
fn scratch_carries_nothing_from_one_call_to_the_next() {
    let (long, short) = (nodes(GRADINGS[1].1, 2000), nodes(GRADINGS[0].1, 900));
    let (of_long, of_short) = (Abel::new(&long), Abel::new(&short));
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
