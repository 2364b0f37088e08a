use super::*;
use crate::quadrature::composite;
use crate::transform::{DenseAbel, Scratch, abel_last};
use std::f64::consts::FRAC_2_PI;

/// Rough radii, unevenly spaced over three decades, and heights: a sphere with waves on it.
fn rough(points: usize) -> (Vec<f64>, Vec<f64>) {
    let radii: Vec<f64> = (0..points)
        .map(|i| {
            let t = i as f64 / (points - 1) as f64;
            3e-4 * (0.1 * t + 0.9 * t.powi(3)) + 1e-8 * (i as f64 * 2.4).sin() * t * (1.0 - t)
        })
        .collect();
    let heights = radii.iter().map(|r| 2e-7 + r * r / 0.02 + 1e-9 * (r * 7e5).sin()).collect();
    (radii, heights)
}

/// Radii at the points, next to them, in the middle between them and far from all.
fn places(radii: &[f64]) -> Vec<f64> {
    let mut places = vec![0.0, radii[1] * 1e-3];
    for pair in radii.windows(2).step_by(97) {
        places.extend([pair[0], pair[0] * (1.0 + 1e-13), 0.5 * (pair[0] + pair[1]), pair[1] * (1.0 - 1e-9)]);
    }
    places
}

/// The slope integral piece by piece.
fn direct_slope_integral(radii: &[f64], image: &[f64], r: f64, a: f64) -> f64 {
    let piece = |j: usize| {
        let (x0, x1) = (radii[j], radii[j + 1]);
        let slope = (image[j + 1] - image[j]) / ((x1 - x0) * (x1 + x0));
        2.0 * slope * (leg(x1.min(a), r) - leg(x0.min(a), r))
    };
    (0..radii.len() - 1).map(piece).sum()
}

/// The height by quadrature: with x = r sin φ, f = (2/π) ∫ g dφ; g is smooth in φ on every piece.
fn height_by_quadrature(radii: &[f64], image: &[f64], r: f64) -> f64 {
    let angle = |x: f64| x.atan2(leg(r, x));
    let mut sum = 0.0;
    for j in 0..radii.len() - 1 {
        let (x0, x1) = (radii[j], radii[j + 1]);
        if x0 >= r {
            break;
        }
        let slope = (image[j + 1] - image[j]) / ((x1 - x0) * (x1 + x0));
        let value = |phi: f64| image[j] + slope * (r * phi.sin() - x0) * (r * phi.sin() + x0);
        sum += FRAC_2_PI * composite(angle(x0), angle(x1.min(r)), value);
    }
    sum
}

/// Largest difference over the largest value.
fn difference(a: &[f64], b: &[f64]) -> f64 {
    let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, |most: f64, v| most.max(v.abs()));
    largest(&mut a.iter().zip(b).map(|(a, b)| a - b)) / largest(&mut b.iter().copied())
}

#[test]
fn the_image_is_that_of_the_direct_solution() {
    for points in [3, 20, 300, 2000] {
        let (radii, heights) = rough(points);
        let fixed = FixedImage::through(&radii, &heights);
        let square: Vec<f64> = radii.iter().map(|r| r * r).collect();
        let mut direct = vec![f64::NAN; points];
        DenseAbel::new(&square).abel(&heights, &mut direct, &mut Scratch::default());
        let error = difference(fixed.values(), &direct);
        assert!(error < 1e-11, "{points} points: {error:e}");
    }
    // node by node from single radii
    for points in [3, 20, 300, 2000] {
        let (radii, heights) = rough(points);
        let mut direct = vec![heights[0]];
        for i in 1..radii.len() {
            direct.push(f64::NAN);
            direct[i] = abel_last(&radii[..=i], &direct, heights[i]);
        }
        let error = difference(FixedImage::through(&radii, &heights).values(), &direct);
        assert!(error < 1e-11, "{points} points, single radii: {error:e}");
    }
}

#[test]
fn heights_and_slope_integrals_are_those_of_the_direct_sums() {
    let (radii, heights) = rough(3000);
    let fixed = FixedImage::through(&radii, &heights);
    let (image, outer) = (fixed.values().to_vec(), radii[2999]);
    for r in places(&radii) {
        let height = fixed.height(r);
        let direct = if r > 0.0 { height_by_quadrature(&radii, &image, r) } else { heights[0] };
        assert!((height - direct).abs() < 1e-12 * direct, "height at {r:e}: {height:e} {direct:e}");
        for a in [r * (1.0 + 1e-6), 1.1 * r, 0.3 * outer, 0.77 * outer, outer, 2.0 * outer] {
            let direct = direct_slope_integral(&radii, &image, r, a);
            let integral = fixed.slope_integral(r, a);
            let scale = fixed.slope_integral(0.0, outer);
            assert!((integral - direct).abs() < 1e-12 * scale, "{r:e} to {a:e}: {integral:e} {direct:e}");
        }
    }
}

#[test]
fn the_heights_at_the_points_are_the_given_ones() {
    let (radii, heights) = rough(5000);
    let fixed = FixedImage::through(&radii, &heights);
    for (r, f) in radii.iter().zip(&heights) {
        assert!((fixed.height(*r) - f).abs() < 1e-12 * f, "{r:e}");
    }
    assert_eq!(fixed.height(1.0), fixed.height(radii[4999]));
}

#[test]
fn work_per_radius_grows_with_the_logarithm_of_the_points() {
    // far blocks count with their points, near cells with one square root each
    let work = |points: usize| {
        let (radii, heights) = rough(points);
        let fixed = FixedImage::through(&radii, &heights);
        let mut most = 0;
        for r in places(&radii) {
            for (from, to, outward) in [(0.0, r, true), (r, 2.5e-4, false)] {
                let mut count = 0;
                fixed.cover(0, from * fixed.scale, to * fixed.scale, outward, &mut |part| {
                    count += match part {
                        Part::Far { .. } => ORDER,
                        Part::Near { cells } => cells.len(),
                    }
                });
                most = most.max(count);
            }
        }
        most
    };
    let (few, many) = (work(1000), work(16_000));
    assert!(many < 2 * few, "{few} for 1,000 points, {many} for 16,000");
}

#[test]
fn a_flat_tip_has_an_image_of_exactly_nothing_at_any_size() {
    for unit in [1e-150, 1e-4, 1e100] {
        let radii: Vec<f64> = (0..200).map(|i| unit * f64::from(i)).collect();
        let heights: Vec<f64> =
            radii.iter().map(|r| 7.0 * unit + (r - 80.0 * unit).max(0.0) / 50.0).collect();
        let fixed = FixedImage::through(&radii, &heights);
        assert!(fixed.values()[..=80].iter().all(|g| *g == 7.0 * unit), "{unit:e}");
        assert!(fixed.values()[81..].iter().all(|g| *g > 7.0 * unit), "{unit:e}");
        assert_eq!(fixed.height(33.3 * unit), 7.0 * unit);
    }
}
