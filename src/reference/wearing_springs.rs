//! A row of springs that wears, in small explicit steps on an even grid: a brute-force check for
//! wear under load histories that no closed form covers.
//!
//! Eqs. (12), (13), (16) and (18) of Dimaki et al. 2014 as they stand, at every step: springs slip,
//! the transforms turn spring loads into pressure and spring slip into slip, w grows by (k/σ₀) μ p
//! Δs, and the inverse transform gives the new image. Images are linear in x and loads linear in x²
//! between the nodes, so that each transform is a sum of elementary integrals. Nothing is implicit:
//! steps must wear less than about (4/π)(p/E*) Δx. The contact edge is known to a cell, so that the
//! error is of first order in the spacing. O(n²) a step.

mod planar;

pub use planar::PlanarWearingRow;

use std::f64::consts::{FRAC_1_PI, FRAC_2_PI, PI};

/// A wearing contact of a body of revolution under force control.
#[derive(Debug, Clone)]
pub struct WearingRow {
    radii: Vec<f64>,
    /// g of the body as it is, m.
    image: Vec<f64>,
    unworn: Vec<f64>,
    /// w, m.
    depth: Vec<f64>,
    /// Displacement at which each spring is relaxed, m.
    origin: Vec<f64>,
    /// Rows of (2/π) ∫ h dx/√(r² − x²) for h linear in x between the nodes, lower triangle.
    inverse: Vec<Vec<f64>>,
    /// Rows of −(1/π) ∫ q' dx/√(x² − r²) by drops of q from node to node, from the diagonal on.
    pressure: Vec<Vec<f64>>,
    normal_modulus: f64,
    tangential_modulus: f64,
    friction: f64,
    wear_per_work: f64,
    force: f64,
    displacement: f64,
    indentation: f64,
}

impl WearingRow {
    /// A body with the image g(x) (m) on nodes from 0 to `extent` (m), apart from the flat, at
    /// U = 0. E* and G* in Pa, k/σ₀ in m³/J.
    pub fn new(
        image: impl Fn(f64) -> f64,
        (extent, cells): (f64, usize),
        (normal_modulus, tangential_modulus): (f64, f64),
        (friction, wear_per_work): (f64, f64),
    ) -> Self {
        let radii: Vec<f64> = (0..=cells).map(|i| extent * i as f64 / cells as f64).collect();
        let unworn: Vec<f64> = radii.iter().map(|x| image(*x)).collect();
        let zero = vec![0.0; cells + 1];
        Self {
            inverse: (0..=cells).map(|i| inverse_row(&radii, i)).collect(),
            pressure: (0..=cells).map(|i| pressure_row(&radii, i)).collect(),
            image: unworn.clone(),
            unworn,
            depth: zero.clone(),
            origin: zero,
            radii,
            normal_modulus,
            tangential_modulus,
            friction,
            wear_per_work,
            force: 0.0,
            displacement: 0.0,
            indentation: 0.0,
        }
    }

    /// Walks a straight line to a force (N) and a displacement (m) in equal steps.
    pub fn walk(&mut self, force: f64, displacement: f64, steps: usize) {
        let from = (self.force, self.displacement);
        for k in 1..=steps {
            let share = k as f64 / steps as f64;
            self.step(from.0 + share * (force - from.0), from.1 + share * (displacement - from.1));
        }
    }

    /// The same with the indentation depth (m) in place of the force.
    pub fn walk_to_depth(&mut self, depth: f64, displacement: f64, steps: usize) {
        let from = (self.indentation, self.displacement);
        for k in 1..=steps {
            let share = k as f64 / steps as f64;
            self.indentation = from.0 + share * (depth - from.0);
            self.slip_and_wear(from.1 + share * (displacement - from.1));
        }
    }

    fn step(&mut self, force: f64, displacement: f64) {
        self.force = force;
        self.indentation = self.indentation_under(force);
        self.slip_and_wear(displacement);
    }

    fn slip_and_wear(&mut self, displacement: f64) {
        self.displacement = displacement;
        let room: Vec<f64> = self.room();
        let slope = self.friction * self.normal_modulus / self.tangential_modulus;
        let slip: Vec<f64> = self
            .origin
            .iter()
            .zip(&room)
            .map(|(origin, q)| {
                let deflection = displacement - origin;
                let excess = (deflection.abs() - slope * q).max(0.0);
                excess.copysign(deflection)
            })
            .collect();
        self.origin.iter_mut().zip(&slip).for_each(|(origin, slip)| *origin += slip);
        let drops: Vec<f64> = room.windows(2).map(|q| self.normal_modulus * (q[0] - q[1])).collect();
        let rate = self.wear_per_work * self.friction;
        for i in 0..self.radii.len() {
            let pressure = sum(&self.pressure[i], &drops[i..]);
            self.depth[i] += rate * pressure.max(0.0) * sum(&self.inverse[i], &slip).abs();
        }
        self.abel();
    }

    /// g = g₀ + the image of w, by forward substitution.
    fn abel(&mut self) {
        let mut worn = vec![self.depth[0]; self.radii.len()];
        for i in 1..worn.len() {
            let row = &self.inverse[i];
            worn[i] = (self.depth[i] - sum(&row[..i], &worn)) / row[i];
        }
        for (image, (unworn, worn)) in self.image.iter_mut().zip(self.unworn.iter().zip(&worn)) {
            *image = unworn + worn;
        }
    }

    /// d − g at the nodes inside the contact, 0 outside, m.
    fn room(&self) -> Vec<f64> {
        let inside = self.image.iter().rposition(|g| *g < self.indentation).map_or(0, |last| last + 1);
        let room = |(i, g): (usize, &f64)| if i < inside { (self.indentation - g).max(0.0) } else { 0.0 };
        self.image.iter().enumerate().map(room).collect()
    }

    /// d that gives a force, by bisection.
    fn indentation_under(&self, force: f64) -> f64 {
        let (mut low, mut high) = (self.image[0].min(0.0), self.image[self.image.len() - 1]);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            let cells = self.radii.windows(2).zip(self.image.windows(2));
            let area: f64 = cells.map(|(x, g)| overlap(x[1] - x[0], middle - g[0], middle - g[1])).sum();
            if 2.0 * self.normal_modulus * area < force { low = middle } else { high = middle }
        }
        0.5 * (low + high)
    }

    /// T = 2G* ∫ u dx, N.
    pub fn tangential_force(&self) -> f64 {
        let room = self.room();
        let u = |i: usize| if room[i] > 0.0 { self.displacement - self.origin[i] } else { 0.0 };
        let cells = self.radii.windows(2).enumerate();
        self.tangential_modulus * cells.map(|(i, x)| (x[1] - x[0]) * (u(i) + u(i + 1))).sum::<f64>()
    }

    /// ∫ 2πr w dr, m³.
    pub fn worn_volume(&self) -> f64 {
        let cells = self.radii.windows(2).zip(self.depth.windows(2));
        cells.map(|(r, w)| PI * (r[1] - r[0]) * (r[0] * w[0] + r[1] * w[1])).sum()
    }

    /// The nodes and w there, m.
    pub fn worn_profile(&self) -> impl Iterator<Item = (f64, f64)> {
        self.radii.iter().copied().zip(self.depth.iter().copied())
    }
}

/// ∫ max(q, 0) dx over a cell with the given values of q at its ends.
fn overlap(width: f64, q0: f64, q1: f64) -> f64 {
    let (least, most) = (q0.min(q1), q0.max(q1));
    match (least >= 0.0, most > 0.0) {
        (true, _) => 0.5 * width * (q0 + q1),
        (false, true) => 0.5 * width * most * most / (most - least),
        (false, false) => 0.0,
    }
}

fn sum(weights: &[f64], values: &[f64]) -> f64 {
    weights.iter().zip(values).map(|(weight, value)| weight * value).sum()
}

fn inverse_row(x: &[f64], i: usize) -> Vec<f64> {
    let r = x[i];
    let mut row = vec![0.0; i + 1];
    if i == 0 {
        row[0] = 1.0;
    }
    for j in 0..i {
        // ∫ dx/√(r² − x²) and ∫ (x − x₀) dx/√(r² − x²)
        let whole = (x[j + 1] / r).min(1.0).asin() - (x[j] / r).asin();
        let root = |x: f64| ((r - x) * (r + x)).max(0.0).sqrt();
        let outer = (root(x[j]) - root(x[j + 1]) - x[j] * whole) / (x[j + 1] - x[j]);
        row[j] += FRAC_2_PI * (whole - outer);
        row[j + 1] += FRAC_2_PI * outer;
    }
    row
}

fn pressure_row(x: &[f64], i: usize) -> Vec<f64> {
    let r = x[i];
    let leg = |x: f64| ((x - r) * (x + r)).max(0.0).sqrt();
    x[i..]
        .windows(2)
        .map(|x| 2.0 * FRAC_1_PI * (leg(x[1]) - leg(x[0])) / ((x[1] - x[0]) * (x[1] + x[0])))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::{NormalContact, Shape, TangentialContact};

    /// Hertz of a unit sphere under E* = 1: d and the central pressure.
    fn errors(cells: usize) -> (f64, f64) {
        let mut row = WearingRow::new(|x| x * x, (1.6, cells), (1.0, 1.0), (0.5, 0.0));
        row.walk(4.0 / 3.0, 0.0, 1);
        let room = row.room();
        let drops: Vec<f64> = room.windows(2).map(|q| q[0] - q[1]).collect();
        ((row.indentation - 1.0).abs(), (sum(&row.pressure[0], &drops) - FRAC_2_PI).abs())
    }

    #[test]
    fn normal_contact_converges_to_hertz() {
        let (coarse, fine) = (errors(100), errors(400));
        assert!(fine.0 < 1e-4 && fine.1 < 3e-3, "{coarse:?} {fine:?}");
        assert!(coarse.0 / fine.0 > 4.0 && coarse.1 / fine.1 > 2.0, "{coarse:?} {fine:?}");
    }

    #[test]
    fn abel_and_its_inverse_are_exact_for_lines() {
        // h = x has w = (2/π) r
        let mut row = WearingRow::new(|_| 0.0, (1.0, 50), (1.0, 1.0), (0.5, 1.0));
        row.depth = row.radii.iter().map(|r| FRAC_2_PI * r).collect();
        row.abel();
        for (image, x) in row.image.iter().zip(&row.radii) {
            assert!((image - x).abs() < 1e-12, "{image} {x}");
        }
    }

    #[test]
    fn a_loop_under_next_to_no_wear_has_mindlins_force_and_wears_its_work() {
        let exact = TangentialContact {
            normal: NormalContact::at_force(Shape::Parabola { radius: 1.0 }, 1.0, 4.0 / 3.0),
            modulus: 1.0,
            friction: 0.5,
        };
        let errors = |cells: usize| {
            let mut row = WearingRow::new(|x| x * x, (1.6, cells), (1.0, 1.0), (0.5, 1e-6));
            row.walk(4.0 / 3.0, 0.0, 1);
            row.walk(4.0 / 3.0, 0.3, 1);
            let force = (row.tangential_force() / exact.loading(0.3) - 1.0).abs();
            row.walk(4.0 / 3.0, -0.3, 1);
            row.walk(4.0 / 3.0, 0.3, 1);
            (force, (row.worn_volume() / (1.25e-6 * exact.loop_work(0.3)) - 1.0).abs())
        };
        let (coarse, fine) = (errors(100), errors(400));
        assert!(fine.0 < 1e-4 && fine.1 < 3e-3, "{coarse:?} {fine:?}");
        assert!(coarse.0 / fine.0 > 4.0 && coarse.1 / fine.1 > 4.0, "{coarse:?} {fine:?}");
    }
}
