//! Meshes of the slipping region in shares of its width in X = x², with the transforms tabulated on them.
//!
//! On an annulus c ≤ x ≤ a with X = c² + L φ, L = a² − c², the transforms of data given at fixed shares φ depend on c
//! and a by factors only: with v/x piecewise linear in X, descent is √L D̂ (v/x); with q piecewise linear in X, pressure is
//! K̂ q / √L. On a disc (c = 0), where v/x would be singular, v itself is taken piecewise linear; its descent depends on
//! ratios of radii, so that it needs no factor at all. Hence one set of tables serves every contact, load and time.
//!
//! φ = (p+1) ξᵖ − p ξᵖ⁺¹ at even ξ: cells shrink like ξᵖ⁻¹ towards the stick edge, where the image develops a jump and
//! the depth a square-root cusp, and like 1 − ξ towards the contact edge, where the depth ends with the power 3/2.

use crate::quadrature::GAUSS;
use crate::transform::{descent_row, leg};
use std::f64::consts::{FRAC_1_PI, FRAC_2_PI};
use std::sync::{Arc, Mutex, Weak};

/// What the mesh covers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub(crate) enum Region {
    /// From the stick radius to the contact edge.
    Annulus,
    /// The whole contact, in gross slip.
    Disc,
}

/// Tables on the shares φ₀ = 0 … φₙ = 1. A depth w at the nodes belongs to z = b·h with w = D̂ z, where h is the image,
/// b = √L/x on an annulus and 1 on a disc.
#[derive(Debug)]
pub(crate) struct UnitMesh {
    pub(crate) region: Region,
    pub(crate) cells: usize,
    pub(crate) share: Vec<f64>,
    /// Weights of the node before, the node and the one after in φ d/dφ at a node, from the parabola through the three.
    pub(crate) drift: Vec<[f64; 3]>,
    /// Row i: D̂ᵢ₀ … D̂ᵢᵢ.
    descent: Vec<f64>,
    /// Row i: K̂ᵢᵢ … K̂ᵢₙ; its last column is that of a line which falls to zero at the last node.
    pressure: Vec<f64>,
    /// Last column of K̂ for a body that ends at the last node, where the line jumps to zero.
    pub(crate) rim: Vec<f64>,
    /// ∫ h dx = √L Σ width·z.
    pub(crate) width: Vec<f64>,
    /// Rows that give zₙ, Σ width·z and the volume (over L) from the depths w; see [`Functional`].
    pub(crate) edge_image: Functional,
    pub(crate) mean_image: Functional,
    pub(crate) volume: Functional,
    /// V = L Σ volume_of_image·z.
    pub(crate) volume_of_image: Vec<f64>,
}

/// A linear functional Σ fⱼ zⱼ written in the depths: Σ wᵢ·depthᵢ + inner·z₀ (z₀ counts on an annulus only, where it is
/// given).
#[derive(Debug)]
pub(crate) struct Functional {
    pub(crate) depth: Vec<f64>,
    pub(crate) inner: f64,
}

impl Functional {
    #[cfg(test)]
    fn of(&self, depth: &[f64], inner: f64) -> f64 {
        crate::transform::dot(&self.depth, depth) + self.inner * inner
    }
}

/// Power of the grading towards the inner edge. On an annulus the depth starts like √(X − c²), and from 4 on the error
/// falls with the square of the number of cells; 4.5 halves it again, and large numbers of cells take less, so that
/// the first cell stays above rounding. On a disc nothing happens at the axis but for the tip of a cone.
fn grading(region: Region, cells: usize) -> f64 {
    match region {
        Region::Annulus => (12.0 / (cells as f64).log10()).min(4.5),
        Region::Disc => 1.5,
    }
}

impl UnitMesh {
    /// The mesh with `cells` cells, shared with every other user of the same.
    pub(crate) fn shared(region: Region, cells: usize) -> Arc<Self> {
        static MESHES: Mutex<Vec<Weak<UnitMesh>>> = Mutex::new(Vec::new());
        // what a panicking thread left is a list of complete meshes
        let mut meshes = MESHES.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        meshes.retain(|mesh| mesh.strong_count() > 0);
        let found = meshes.iter().filter_map(Weak::upgrade);
        if let Some(mesh) = found.into_iter().find(|mesh| mesh.region == region && mesh.cells == cells) {
            return mesh;
        }
        let mesh = Arc::new(Self::new(region, cells));
        meshes.push(Arc::downgrade(&mesh));
        mesh
    }

    fn new(region: Region, cells: usize) -> Self {
        let p = grading(region, cells);
        let xi = |i: usize| i as f64 / cells as f64;
        let share: Vec<f64> = (0..=cells).map(|i| xi(i).powf(p) * ((p + 1.0) - p * xi(i))).collect();
        let drift =
            (0..=cells).map(|i| if i == 0 || i == cells { [0.0; 3] } else { drift_at(&share, i) }).collect();
        let (descent, width, volume) = match region {
            Region::Annulus => annulus_tables(&share),
            Region::Disc => disc_tables(&share),
        };
        let (pressure, rim) = pressure_tables(&share);
        let mut edge = vec![0.0; cells + 1];
        edge[cells] = 1.0;
        let empty = || Functional { depth: Vec::new(), inner: 0.0 };
        let mut mesh = Self {
            region,
            cells,
            share,
            drift,
            descent,
            pressure,
            rim,
            width,
            edge_image: empty(),
            mean_image: empty(),
            volume: empty(),
            volume_of_image: volume,
        };
        mesh.edge_image = mesh.in_depths(edge);
        mesh.mean_image = mesh.in_depths(mesh.width.clone());
        mesh.volume = mesh.in_depths(mesh.volume_of_image.clone());
        mesh
    }

    /// First node whose image is unknown: on an annulus the image at the inner edge is given.
    pub(crate) fn first(&self) -> usize {
        match self.region {
            Region::Annulus => 1,
            Region::Disc => 0,
        }
    }

    pub(crate) fn descent_row(&self, i: usize) -> &[f64] {
        let start = i * (i + 1) / 2;
        &self.descent[start..=start + i]
    }

    pub(crate) fn pressure_row(&self, i: usize) -> &[f64] {
        let start = i * (self.cells + 1) - i * i.saturating_sub(1) / 2;
        &self.pressure[start..start + self.cells + 1 - i]
    }

    /// w = D̂ z.
    pub(crate) fn descend(&self, z: &[f64], w: &mut [f64]) {
        for i in 0..=self.cells {
            let row = self.descent_row(i);
            w[i] = crate::transform::dot(row, &z[..=i]);
        }
    }

    /// z with D̂ z = w; z₀ has to be set before on an annulus.
    pub(crate) fn ascend(&self, w: &[f64], z: &mut [f64]) {
        for i in self.first()..=self.cells {
            let row = self.descent_row(i);
            z[i] = (w[i] - crate::transform::dot(&row[..i], &z[..i])) / row[i];
        }
    }

    /// K̂ q for a line q that is zero at the last node, or with `rim` for one that jumps to zero there.
    pub(crate) fn pressure(&self, q: &[f64], rim: bool, p: &mut [f64]) {
        for i in 0..=self.cells {
            let row = self.pressure_row(i);
            let inside = row.len() - 1;
            p[i] = crate::transform::dot(&row[..inside], &q[i..i + inside]);
            if rim {
                p[i] += self.rim[i] * q[self.cells];
            }
        }
    }

    /// Writes Σ fⱼ zⱼ in the depths: solves D̂ᵀ y = f.
    fn in_depths(&self, f: Vec<f64>) -> Functional {
        let (n, first) = (self.cells, self.first());
        let mut y = f;
        for i in (first..=n).rev() {
            let row = self.descent_row(i);
            y[i] /= row[i];
            let value = y[i];
            for j in 0..i {
                y[j] -= value * row[j];
            }
        }
        let inner = if first == 1 { std::mem::take(&mut y[0]) } else { 0.0 };
        Functional { depth: y, inner }
    }
}

/// φ times the weights of a derivative at node i from its neighbours.
fn drift_at(share: &[f64], i: usize) -> [f64; 3] {
    let (h0, h1) = (share[i] - share[i - 1], share[i + 1] - share[i]);
    let (before, after) = (-h1 / (h0 * (h0 + h1)), h0 / (h1 * (h0 + h1)));
    [share[i] * before, -share[i] * (before + after), share[i] * after]
}

/// Weights for k piecewise linear in X: (1/π) ∫ k dX/√(Z − X), ∫ k dX / 2 and 2 ∫ k √(1 − X) dX.
fn annulus_tables(share: &[f64]) -> (Vec<f64>, Vec<f64>, Vec<f64>) {
    let n = share.len() - 1;
    let mut descent = Vec::with_capacity((n + 1) * (n + 2) / 2);
    for i in 0..=n {
        let start = descent.len();
        descent.resize(start + i + 1, 0.0);
        for j in 0..i {
            let cell = share[j + 1] - share[j];
            let (far, near) = ((share[i] - share[j]).sqrt(), (share[i] - share[j + 1]).sqrt());
            // 2 (far − near), and the share of the outer end in it, without cancellation
            let whole = 2.0 * cell / (far + near);
            let outer = (2.0 * far + near) / (3.0 * (far + near)) * whole;
            descent[start + j] += FRAC_1_PI * (whole - outer);
            descent[start + j + 1] += FRAC_1_PI * outer;
        }
    }
    let mut width = vec![0.0; n + 1];
    let mut volume = vec![0.0; n + 1];
    for j in 0..n {
        let cell = share[j + 1] - share[j];
        width[j] += cell / 4.0;
        width[j + 1] += cell / 4.0;
        // ∫ √(1 − X) dX with the weight of the outer end, in t = √(1 − X)
        let (s, t) = ((1.0 - share[j]).sqrt(), (1.0 - share[j + 1]).max(0.0).sqrt());
        let whole = 2.0 / 3.0 * cell * (s * s + s * t + t * t) / (s + t);
        let outer =
            2.0 / 15.0 * cell * (2.0 * s * s * s + 4.0 * s * s * t + 6.0 * s * t * t + 3.0 * t * t * t)
                / ((s + t) * (s + t));
        volume[j] += 2.0 * (whole - outer);
        volume[j + 1] += 2.0 * outer;
    }
    (descent, width, volume)
}

/// Weights for h piecewise linear in X on a disc of radius 1: descent, ∫ h dx and the volume 4 ∫ h √(1 − x²) dx.
fn disc_tables(share: &[f64]) -> (Vec<f64>, Vec<f64>, Vec<f64>) {
    let n = share.len() - 1;
    let x: Vec<f64> = share.iter().map(|s| s.sqrt()).collect();
    let mut descent = Vec::with_capacity((n + 1) * (n + 2) / 2);
    for i in 0..=n {
        let start = descent.len();
        descent.resize(start + i + 1, 0.0);
        descent[start] = 1.0;
        descent_row(&x[..=i], x[i], |j, c| {
            descent[start + j] -= c;
            descent[start + j + 1] += c;
        });
    }
    let mut width = vec![0.0; n + 1];
    let mut volume = vec![0.0; n + 1];
    for j in 0..n {
        let outer = crate::surface::outer_weight(x[j], x[j + 1]);
        let cell = x[j + 1] - x[j];
        width[j] += (1.0 - outer) * cell;
        width[j + 1] += outer * cell;
        let (inner, outer) = depth_volume(x[j], x[j + 1], 1.0);
        volume[j] += inner;
        volume[j + 1] += outer;
    }
    (descent, width, volume)
}

/// Weights of the two ends of a cell in 4 ∫ h √(a² − x²) dx, the volume of the depth that belongs to an image h linear
/// in x² and none beyond a.
pub(crate) fn depth_volume(x0: f64, x1: f64, a: f64) -> (f64, f64) {
    // x = a sin θ leaves a polynomial in sin θ, cos θ for three-point Gauss
    let (t0, t1) = (x0.atan2(leg(a, x0)), x1.atan2(leg(a, x1)));
    let (middle, half) = (0.5 * (t0 + t1), 0.5 * (t1 - t0));
    let (mut inner, mut outer) = (0.0, 0.0);
    for (node, weight) in GAUSS {
        let (sin, cos) = (middle + half * node).sin_cos();
        let x = a * sin;
        let share = ((x - x0) * (x + x0) / ((x1 - x0) * (x1 + x0))).clamp(0.0, 1.0);
        let value = 4.0 * half * weight * a * a * cos * cos;
        inner += value * (1.0 - share);
        outer += value * share;
    }
    (inner, outer)
}

/// Weights of the pressure: rows for a line that falls to zero at the end, and the last column where it jumps instead.
fn pressure_tables(share: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let n = share.len() - 1;
    let mut pressure = Vec::with_capacity((n + 1) * (n + 2) / 2);
    let mut rim = Vec::with_capacity(n + 1);
    for i in 0..=n {
        let start = pressure.len();
        pressure.resize(start + n + 1 - i, 0.0);
        for j in i..n {
            let (near, far) = ((share[j] - share[i]).sqrt(), (share[j + 1] - share[i]).sqrt());
            let weight = FRAC_2_PI / (near + far);
            pressure[start + j - i] += weight;
            pressure[start + j + 1 - i] -= weight;
        }
        // a jump of q at the end: q/(π √(1 − Z)); at the last node its mean over the outer half of the cell
        let distance = if i < n { 1.0 - share[i] } else { 0.5 * (1.0 - share[n - 1]) };
        let jump = if i < n { FRAC_1_PI } else { FRAC_2_PI } / distance.sqrt();
        rim.push(jump + pressure[start + n - i]);
    }
    (pressure, rim)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// Errors of the three tables against closed forms on a mesh of n cells.
    fn errors(region: Region, n: usize) -> (f64, f64, f64) {
        let mesh = UnitMesh::shared(region, n);
        let phi = &mesh.share;
        // z = φ on the annulus: (1/π)∫ X dX/√(Z − X) = 4 Z^{3/2}/(3π); on the disc h = x² : w = r²/2
        let mut w = vec![0.0; n + 1];
        let linear: Vec<f64> = phi.clone();
        mesh.descend(&linear, &mut w);
        let exact = |z: f64| match region {
            Region::Annulus => 4.0 / (3.0 * PI) * z.powf(1.5),
            Region::Disc => z / 2.0,
        };
        let descent = (0..=n).map(|i| (w[i] - exact(phi[i])).abs()).fold(0.0, f64::max);
        // z = X²: not linear
        let square: Vec<f64> = phi.iter().map(|x| x * x).collect();
        mesh.descend(&square, &mut w);
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
        (descent, hertz, curved)
    }

    #[test]
    fn transforms_are_exact_for_lines_and_of_second_order_else() {
        for region in [Region::Annulus, Region::Disc] {
            let (descent, hertz, coarse) = errors(region, 32);
            assert!(descent < 1e-9 && hertz < 1e-12, "{region:?}: {descent:e} {hertz:e}");
            let fine = errors(region, 128).2;
            let order = (coarse / fine).log2() / 2.0;
            assert!((1.9..2.2).contains(&order), "{region:?}: order {order}");
        }
    }

    #[test]
    fn ascending_undoes_descending_and_functionals_agree() {
        for region in [Region::Annulus, Region::Disc] {
            let mesh = UnitMesh::shared(region, 40);
            let z: Vec<f64> = mesh.share.iter().map(|x| 0.3 + x - 2.0 * x * x).collect();
            let (mut w, mut back) = (vec![0.0; 41], vec![0.0; 41]);
            mesh.descend(&z, &mut w);
            back[0] = z[0];
            mesh.ascend(&w, &mut back);
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
        // disc: w = r²/2 (h = x²): ∫₀¹ 2πr w dr = π/4. Annulus (in L = 1): π ∫ w dZ with w = (4/3π) Z^{3/2}: 8/15
        for (region, exact) in [(Region::Disc, PI / 4.0), (Region::Annulus, 8.0 / 15.0)] {
            let mesh = UnitMesh::shared(region, 40);
            let mut w = vec![0.0; 41];
            mesh.descend(&mesh.share, &mut w);
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
}
