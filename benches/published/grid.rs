//! The uniform grid and the three Abel transforms on it, as matrices made once.
//!
//! Each is a product rule: the data are taken piecewise linear and the singular kernel is
//! integrated exactly over every cell, so that no sample falls on a singularity.
//!
//! | transform | equation |
//! | --- | --- |
//! | image of the wear | (1), h(x) = w(0) + x ∫₀ˣ w' dr/√(x² − r²) |
//! | traction | (17), τ(r) = −(1/π) ∫ᵣ q' dx/√(x² − r²) |
//! | surface displacement | (16), u₃(r) = (2/π) ∫₀ʳ u dx/√(r² − x²) |

use super::rows::Rows;
use std::f64::consts::{FRAC_2_PI, PI};

/// Where profile and springs are sampled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Scheme {
    /// Springs on the nodes iΔ, profile, traction and slip in the middle between them; data linear
    /// in x and r. Derivatives are central differences and no kernel is ever evaluated at its
    /// singularity: what one writes down first. But a spring sees half a cell of profile that lies
    /// outside it, and that half cell sees the next spring: wear seeps through the stick edge.
    Staggered,
    /// Everything on the nodes iΔ, data linear in x² and r²: nothing depends on anything further
    /// out that eqs. (1) and (16) do not let it depend on, so that where all springs stick nothing
    /// wears.
    Causal,
}

/// Positions and transforms.
#[derive(Debug, Clone)]
pub(crate) struct Grid {
    pub(crate) scheme: Scheme,
    /// Δ, m.
    pub(crate) spacing: f64,
    /// Places of the springs, m.
    pub(crate) springs: Vec<f64>,
    /// Radii of the profile, m.
    pub(crate) radii: Vec<f64>,
    /// Worn depth at the radii → its image at the springs.
    pub(crate) image: Rows,
    /// Line force at the springs → traction at the radii.
    pub(crate) traction: Rows,
    /// Displacement of the springs → that of the surface at the radii.
    pub(crate) inverse: Rows,
}

impl Grid {
    pub(crate) fn new(scheme: Scheme, spacing: f64, count: usize) -> Self {
        let springs: Vec<f64> = (0..count).map(|i| spacing * i as f64).collect();
        let shift = if scheme == Scheme::Staggered { 0.5 } else { 0.0 };
        let radii: Vec<f64> = (0..count).map(|j| spacing * (j as f64 + shift)).collect();
        let (image, traction, inverse): (Row, Row, Row) = match scheme {
            Scheme::Staggered => (staggered::image, staggered::traction, staggered::inverse),
            Scheme::Causal => (causal::image, causal::traction, causal::inverse),
        };
        let rows = |row: Row| Rows::new((0..count).map(|i| row(i, count, spacing)));
        Self {
            scheme,
            spacing,
            image: rows(image),
            traction: rows(traction),
            inverse: rows(inverse),
            springs,
            radii,
        }
    }

    /// ∫ 2πr w dr, m³.
    pub(crate) fn volume(&self, worn: &[f64]) -> f64 {
        match self.scheme {
            Scheme::Staggered => {
                self.radii.iter().zip(worn).map(|(r, w)| 2.0 * PI * r * w).sum::<f64>() * self.spacing
            }
            Scheme::Causal => {
                let square = |i: usize| self.radii[i] * self.radii[i];
                let cell = |i: usize| 0.5 * PI * (worn[i] + worn[i + 1]) * (square(i + 1) - square(i));
                (0..worn.len() - 1).map(cell).sum()
            }
        }
    }

    /// The sampled field between the radii, linear as the scheme takes it; constant inside the
    /// first.
    pub(crate) fn at(&self, field: &[f64], r: f64) -> f64 {
        let j = self.radii.partition_point(|&node| node <= r);
        if j == 0 || j == field.len() {
            return field[j.min(field.len() - 1)];
        }
        let (low, high) = (self.radii[j - 1], self.radii[j]);
        let share = match self.scheme {
            Scheme::Staggered => (r - low) / (high - low),
            Scheme::Causal => (r - low) * (r + low) / ((high - low) * (high + low)),
        };
        field[j - 1] + share * (field[j] - field[j - 1])
    }
}

/// Row i of a transform on `count` points of `spacing`: first column and values.
type Row = fn(usize, usize, f64) -> (usize, Vec<f64>);

/// √(a² − b²) for a ≥ b, also where rounding makes it negative.
fn leg(a: f64, b: f64) -> f64 {
    ((a - b).max(0.0) * (a + b)).sqrt()
}

fn arcsine(ratio: f64) -> f64 {
    ratio.min(1.0).asin()
}

/// Springs at iΔ, radii at (j + ½)Δ, in units of Δ.
mod staggered {
    use super::{FRAC_2_PI, PI, arcsine, leg};

    pub(super) fn image(i: usize, count: usize, _: f64) -> (usize, Vec<f64>) {
        let x = i as f64;
        let mut row = vec![0.0; (i + 1).min(count)];
        row[0] = 1.0;
        // the slope between the radii j − 1 and j is their difference; flat inside the first radius
        for j in 1..=i {
            let (low, high) = (j as f64 - 0.5, (j as f64 + 0.5).min(x));
            let weight = x * (arcsine(high / x) - arcsine(low / x));
            row[j] += weight;
            row[j - 1] -= weight;
        }
        (0, row)
    }

    pub(super) fn traction(j: usize, count: usize, spacing: f64) -> (usize, Vec<f64>) {
        let r = j as f64 + 0.5;
        let mut row = vec![0.0; count - j];
        for i in j..count - 1 {
            let (low, high) = ((i as f64).max(r), i as f64 + 1.0);
            let weight = ((high / r).acosh() - (low / r).acosh()) / (PI * spacing);
            row[i - j] += weight;
            row[i + 1 - j] -= weight;
        }
        (j, row)
    }

    pub(super) fn inverse(j: usize, count: usize, _: f64) -> (usize, Vec<f64>) {
        let r = j as f64 + 0.5;
        let mut row = vec![0.0; (j + 2).min(count)];
        for i in 0..=j.min(count - 2) {
            let (low, high) = (i as f64, (i as f64 + 1.0).min(r));
            // ∫ dx/√(r² − x²) and ∫ (x − i) dx/√(r² − x²)
            let whole = arcsine(high / r) - arcsine(low / r);
            let slope = leg(r, low) - leg(r, high) - low * whole;
            row[i] += FRAC_2_PI * (whole - slope);
            row[i + 1] += FRAC_2_PI * slope;
        }
        (0, row)
    }
}

/// Springs and radii at iΔ, in units of Δ; the squares of neighbours differ by 2k + 1.
mod causal {
    use super::{FRAC_2_PI, PI, arcsine, leg};

    fn gap(k: usize) -> f64 {
        2.0 * k as f64 + 1.0
    }

    pub(super) fn image(i: usize, _: usize, _: f64) -> (usize, Vec<f64>) {
        let x = i as f64;
        let mut row = vec![0.0; i + 1];
        row[0] = 1.0;
        for k in 0..i {
            let weight = 2.0 * x * (leg(x, k as f64) - leg(x, k as f64 + 1.0)) / gap(k);
            row[k + 1] += weight;
            row[k] -= weight;
        }
        (0, row)
    }

    pub(super) fn traction(i: usize, count: usize, spacing: f64) -> (usize, Vec<f64>) {
        let r = i as f64;
        let mut row = vec![0.0; count - i];
        for k in i..count - 1 {
            let weight = 2.0 * (leg(k as f64 + 1.0, r) - leg(k as f64, r)) / (PI * gap(k) * spacing);
            row[k - i] += weight;
            row[k + 1 - i] -= weight;
        }
        (i, row)
    }

    pub(super) fn inverse(i: usize, _: usize, _: f64) -> (usize, Vec<f64>) {
        if i == 0 {
            return (0, vec![1.0]);
        }
        let r = i as f64;
        let mut row = vec![0.0; i + 1];
        for k in 0..i {
            let (low, high) = (k as f64, k as f64 + 1.0);
            // ∫ dx/√(r² − x²) and ∫ x² dx/√(r² − x²)
            let whole = arcsine(high / r) - arcsine(low / r);
            let square = 0.5 * (r * r * whole - high * leg(r, high) + low * leg(r, low));
            let outer = (square - low * low * whole) / gap(k);
            row[k] += FRAC_2_PI * (whole - outer);
            row[k + 1] += FRAC_2_PI * outer;
        }
        (0, row)
    }
}
