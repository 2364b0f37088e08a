//! Meshes of the slipping region in shares of its width in X = x², with the transforms tabulated on
//! them.
//!
//! On an annulus c ≤ x ≤ a with X = c² + L φ, L = a² − c², the transforms of data given at fixed
//! shares φ depend on c and a by factors only: with z = √L v/x interpolated, the inverse Abel
//! transform is D̂ z; with q interpolated, pressure is K̂ q / √L. On a disc (c = 0), where v/x is
//! singular, z is v itself; its inverse transform depends on ratios of radii, so that it needs no
//! factor at all. Hence one set of tables serves every contact, load and time.
//!
//! φ = (p+1) ξᵖ − p ξᵖ⁺¹ at even ξ: cells shrink like ξᵖ⁻¹ towards the stick edge, where the image
//! develops a jump and the depth a square-root cusp, and like 1 − ξ towards the contact edge, where
//! the depth ends with the power 3/2. On an annulus all fields are smooth in ξ, and parabolas
//! through three nodes are of third order.

mod finer;
mod weights;

use crate::surface::Region;
use crate::transform::dot;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};
use weights::Places;

/// Tables on the shares φ₀ = 0 … φₙ = 1. A depth w at the nodes belongs to z = b·h with w = D̂ z,
/// where h is the image, b = √L/x on an annulus and 1 on a disc.
#[derive(Debug)]
pub(crate) struct UnitMesh {
    pub(crate) region: Region,
    pub(crate) cells: usize,
    pub(crate) share: Vec<f64>,
    /// φ d/dφ at a node: the first of five nodes, and their weights.
    drift: Vec<(usize, [f64; 5])>,
    /// Row i: D̂ᵢ₀ … D̂ᵢᵢ.
    inverse: Vec<f64>,
    /// Row i: K̂ᵢᵢ … K̂ᵢₙ; its last column is that of a line which falls to zero at the last node.
    pressure: Vec<f64>,
    /// Last column of K̂ for a body that ends at the last node, where the line jumps to zero.
    pub(crate) rim: Vec<f64>,
    /// ∫ h dx = √L Σ width·z.
    pub(crate) width: Vec<f64>,
    /// ∫ q σ dx = √L Σ work·b q σ.
    pub(crate) work: Vec<f64>,
    /// Rows that give zₙ, Σ width·z and the volume (over L) from the depths w.
    pub(crate) edge_image: Vec<f64>,
    pub(crate) mean_image: Vec<f64>,
    pub(crate) volume: Vec<f64>,
    /// V = L Σ volume_of_image·z.
    pub(crate) volume_of_image: Vec<f64>,
}

/// The meshes in use, in any order.
static MESHES: Mutex<Vec<Weak<UnitMesh>>> = Mutex::new(Vec::new());

fn meshes() -> MutexGuard<'static, Vec<Weak<UnitMesh>>> {
    // what a panicking thread left is a list of complete meshes
    MESHES.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Drop for UnitMesh {
    /// The last user takes its entry off the list: a library that is unloaded leaves nothing
    /// behind.
    fn drop(&mut self) {
        let mut meshes = meshes();
        meshes.retain(|mesh| mesh.strong_count() > 0);
        if meshes.is_empty() {
            *meshes = Vec::new();
        }
    }
}

impl UnitMesh {
    /// The mesh with `cells` cells, shared with every other user of the same.
    pub(crate) fn shared(region: Region, cells: usize) -> Arc<Self> {
        // the list is free again when these are dropped, of which one may be the last
        let in_use: Vec<Arc<Self>> = meshes().iter().filter_map(Weak::upgrade).collect();
        if let Some(mesh) = in_use.into_iter().find(|mesh| mesh.region == region && mesh.cells == cells) {
            return mesh;
        }
        let mesh = Arc::new(Self::new(region, cells));
        meshes().push(Arc::downgrade(&mesh));
        mesh
    }

    fn new(region: Region, cells: usize) -> Self {
        let places = Places { region, cells };
        let mut share: Vec<f64> = (0..=cells).map(|i| places.rise(0.0, i as f64)).collect();
        share[cells] = 1.0;
        let drift = (0..=cells).map(|i| places.drift(i)).collect();
        let (width, volume) = places.integrals();
        let mut edge = vec![0.0; cells + 1];
        edge[cells] = 1.0;
        let mut mesh = Self {
            region,
            cells,
            drift,
            inverse: places.inverse_table(),
            pressure: places.pressure_table(),
            rim: Vec::new(),
            share,
            work: places.work(&width),
            width,
            edge_image: Vec::new(),
            mean_image: Vec::new(),
            volume: Vec::new(),
            volume_of_image: volume,
        };
        mesh.rim = places.rim_column(|i| mesh.pressure_row(i)[cells - i]);
        mesh.edge_image = mesh.in_depths(edge);
        mesh.mean_image = mesh.in_depths(mesh.width.clone());
        mesh.volume = mesh.in_depths(mesh.volume_of_image.clone());
        mesh
    }

    /// φ dw/dφ at a node inside.
    pub(crate) fn drift_of(&self, w: &[f64], i: usize) -> f64 {
        self.drift_weights(i).map(|(k, weight)| weight * w[k]).sum()
    }

    /// The nodes that φ dw/dφ at a node depends on, with their weights.
    pub(crate) fn drift_weights(&self, i: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let (first, weights) = &self.drift[i];
        (*first..=self.cells).zip(weights.iter().copied())
    }

    /// First node whose image is unknown: on an annulus the image at the inner edge is given, and
    /// no depth depends on it.
    pub(crate) fn first(&self) -> usize {
        match self.region {
            Region::Annulus => 1,
            Region::Disc => 0,
        }
    }

    /// D̂ᵢ₀ … D̂ᵢᵢ.
    pub(crate) fn inverse_row(&self, i: usize) -> &[f64] {
        let start = i * (i + 1) / 2;
        &self.inverse[start..=start + i]
    }

    /// K̂ᵢᵢ … K̂ᵢₙ; the last column is that of a line which falls to zero at the last node.
    pub(crate) fn pressure_row(&self, i: usize) -> &[f64] {
        let start = i * (self.cells + 1) - i * i.saturating_sub(1) / 2;
        &self.pressure[start..start + self.cells + 1 - i]
    }

    /// w = D̂ z.
    pub(crate) fn inverse_abel(&self, z: &[f64], w: &mut [f64]) {
        for i in 0..=self.cells {
            w[i] = dot(self.inverse_row(i), &z[..=i]);
        }
    }

    /// z with D̂ z = w, from the first unknown node on.
    pub(crate) fn abel(&self, w: &[f64], z: &mut [f64]) {
        for i in self.first()..=self.cells {
            let row = self.inverse_row(i);
            z[i] = (w[i] - dot(&row[..i], &z[..i])) / row[i];
        }
    }

    /// K̂ q for a line q that is zero at the last node, or with `rim` for one that jumps to zero
    /// there.
    pub(crate) fn pressure(&self, q: &[f64], rim: bool, p: &mut [f64]) {
        let n = self.cells;
        for i in 0..=n {
            p[i] = dot(&self.pressure_row(i)[..n - i], &q[i..n]);
        }
        if rim {
            p.iter_mut().zip(&self.rim).for_each(|(p, rim)| *p += rim * q[n]);
        }
    }

    /// The row y with y·w = f·z: solves D̂ᵀ y = f.
    fn in_depths(&self, f: Vec<f64>) -> Vec<f64> {
        let mut y = f;
        for i in (self.first()..=self.cells).rev() {
            let row = self.inverse_row(i);
            y[i] /= row[i];
            let value = y[i];
            y.iter_mut().zip(&row[..i]).for_each(|(y, weight)| *y -= value * weight);
        }
        y
    }
}

#[cfg(test)]
mod tests;
