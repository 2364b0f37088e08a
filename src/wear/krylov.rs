//! Solution of a linear system that is known by what it does to a vector: GMRES (Saad and Schultz,
//! SIAM J. Sci. Stat. Comput. 7 (1986), 856) with an approximate inverse applied first, by modified
//! Gram–Schmidt and Givens rotations.

use crate::transform::{add, dot};

/// x with ‖right − A x‖ ≤ tolerance·‖right‖ in the Euclidean norm, and the number of iterations;
/// `None` where `most` of them do not suffice or numbers are not finite.
pub(super) fn solve(
    mut apply: impl FnMut(&[f64]) -> Vec<f64>,
    mut inverse: impl FnMut(&[f64]) -> Vec<f64>,
    right: &[f64],
    (tolerance, most): (f64, usize),
) -> Option<(Vec<f64>, u64)> {
    let start = norm(right);
    let mut x = vec![0.0; right.len()];
    if start == 0.0 {
        return Some((x, 0));
    }
    let mut basis = vec![right.iter().map(|r| r / start).collect::<Vec<f64>>()];
    let mut directions: Vec<Vec<f64>> = Vec::new();
    // columns of the triangle that the rotations make of the Hessenberg matrix, and the turned
    // right side
    let (mut triangle, mut rotations): (Vec<Vec<f64>>, Vec<(f64, f64)>) = (Vec::new(), Vec::new());
    let mut turned = vec![start];
    loop {
        // what is no number goes on, and ends below
        if turned[triangle.len()].abs() <= tolerance * start {
            break;
        }
        let step = triangle.len();
        if step == most {
            return None;
        }
        let direction = inverse(&basis[step]);
        let mut next = apply(&direction);
        directions.push(direction);
        let mut column: Vec<f64> = Vec::with_capacity(step + 2);
        for vector in &basis {
            let share = dot(&next, vector);
            add(&mut next, -share, vector);
            column.push(share);
        }
        let below = norm(&next);
        for (k, (cos, sin)) in rotations.iter().enumerate() {
            (column[k], column[k + 1]) =
                (cos * column[k] + sin * column[k + 1], cos * column[k + 1] - sin * column[k]);
        }
        let length = column[step].hypot(below);
        if !(length.is_finite() && length > 0.0) {
            return None;
        }
        let (cos, sin) = (column[step] / length, below / length);
        turned.push(-sin * turned[step]);
        turned[step] *= cos;
        rotations.push((cos, sin));
        column[step] = length;
        triangle.push(column);
        if below > 0.0 {
            next.iter_mut().for_each(|v| *v /= below);
        }
        basis.push(next);
    }
    for k in (0..triangle.len()).rev() {
        turned[k] /= triangle[k][k];
        for i in 0..k {
            turned[i] -= triangle[k][i] * turned[k];
        }
    }
    for (factor, direction) in turned.iter().zip(&directions) {
        add(&mut x, *factor, direction);
    }
    Some((x, directions.len() as u64))
}

fn norm(v: &[f64]) -> f64 {
    dot(v, v).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_matrix_of_few_eigenvalues_takes_as_many_iterations() {
        // I + u vᵀ, whose inverse is I − u vᵀ/(1 + v·u)
        let n = 50;
        let u: Vec<f64> = (0..n).map(|i| f64::from(i).sin()).collect();
        let v: Vec<f64> = (0..n).map(|i| 1.0 / f64::from(1 + i)).collect();
        let right: Vec<f64> = (0..n).map(|i| f64::from(i % 7) - 2.0).collect();
        let apply = |x: &[f64]| {
            let mut y = x.to_vec();
            add(&mut y, dot(&v, x), &u);
            y
        };
        let (x, iterations) = solve(apply, <[f64]>::to_vec, &right, (1e-13, 40)).expect("it converges");
        let mut exact = right.clone();
        add(&mut exact, -dot(&v, &right) / (1.0 + dot(&v, &u)), &u);
        assert!(x.iter().zip(&exact).all(|(a, b)| (a - b).abs() < 1e-12));
        assert_eq!(iterations, 2);
    }

    /// Eigenvalues 1 … 3, and a coupling that makes it unsymmetric.
    fn band(x: &[f64]) -> Vec<f64> {
        let eigenvalue = |i: usize| 1.0 + 2.0 * i as f64 / x.len() as f64;
        (0..x.len()).map(|i| eigenvalue(i) * x[i] + if i > 0 { 0.3 * x[i - 1] } else { 0.0 }).collect()
    }

    #[test]
    fn the_solution_is_that_of_the_system_whatever_the_approximate_inverse() {
        let exact: Vec<f64> = (0..120).map(|i| f64::from(i).cos()).collect();
        let right = band(&exact);
        let diagonal = |r: &[f64]| (0..120).map(|i| r[i] / (1.0 + i as f64 / 60.0)).collect();
        let (plain, many) = solve(band, <[f64]>::to_vec, &right, (1e-12, 40)).expect("it converges");
        let (better, few) = solve(band, diagonal, &right, (1e-12, 40)).expect("it converges");
        for x in [plain, better] {
            assert!(x.iter().zip(&exact).all(|(a, b)| (a - b).abs() < 1e-10));
        }
        assert!(few < many, "{few} {many}");
        assert_eq!(solve(band, diagonal, &[0.0; 120], (1e-12, 40)), Some((vec![0.0; 120], 0)));
    }

    #[test]
    fn what_has_no_solution_is_refused() {
        let shift = |x: &[f64]| [&x[1..], &[0.0]].concat();
        assert!(solve(shift, <[f64]>::to_vec, &[0.0, 0.0, 1.0], (1e-10, 40)).is_none());
        assert!(solve(band, <[f64]>::to_vec, &[1.0, f64::NAN], (1e-10, 40)).is_none());
    }
}
