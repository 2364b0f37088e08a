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
mod row_blocks;
mod weights;

use crate::surface::Region;
use crate::transform::{add, dot};
use row_blocks::RowBlocks;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};
use weights::Places;

/// Tables on the shares φ₀ = 0 … φₙ = 1. A depth w at the nodes belongs to z = b·h with w = D̂ z,
/// where h is the image, b = √L/x on an annulus and 1 on a disc.
#[derive(Debug)]
pub(crate) struct UnitMesh {
    pub(crate) region: Region,
    /// p of the shares.
    power: i32,
    pub(crate) cells: usize,
    pub(crate) share: Vec<f64>,
    /// φ d/dφ at a node: the first of five nodes, and their weights.
    drift: Vec<(usize, [f64; 5])>,
    /// Column j: D̂ⱼⱼ … D̂ₙⱼ.
    inverse: Vec<f64>,
    /// Column j: K̂₀ⱼ … K̂ⱼⱼ; the last is that of a line which falls to zero at the last node.
    pressure: Vec<f64>,
    /// D̂ and K̂, without its last column, for products.
    inverse_rows: RowBlocks,
    pressure_rows: RowBlocks,
    /// Column j: φ dw/dφ at all nodes where zⱼ is 1 and the others are 0.
    drift_of_image: Vec<f64>,
    /// Last column of K̂ for a body that ends at the last node, where the line jumps to zero.
    pub(crate) rim: Vec<f64>,
    /// ∫ q dx = √L Σ width·b q for the overlap q of the bodies, or its product with a slip.
    pub(crate) width: Vec<f64>,
    /// Rows that give zₙ, Σ width·z and the volume (over L) from the depths w.
    pub(crate) edge_image: Vec<f64>,
    pub(crate) mean_image: Vec<f64>,
    pub(crate) volume: Vec<f64>,
    /// V = L Σ volume_of_image·z.
    pub(crate) volume_of_image: Vec<f64>,
    /// z of the depth φ, and its Σ width·z.
    pub(crate) image_of_share: Vec<f64>,
    pub(crate) mean_of_share: f64,
}

/// p of the mesh of a body. On an annulus the depth starts like √(X − c²), and the largest error of
/// the profile, in the first cell, falls with the root of its width: p = 5. On a disc x is smooth
/// in ξ with p = 2. A sharp body wears round from the axis on, and its wear has the kink of its
/// apex, which a line in X takes for less: the depth at the axis lags by a share of the slope of
/// the body times the width of the first cell. With p = 4 that is a 50th of the width with p = 2,
/// on 64 cells. (With 5 the pressure at the axis of a cone worn far beyond its elastic depth is a
/// third of the mean; it is four tenths with 4, a half with 2.)
fn power(region: Region, is_sharp: bool) -> i32 {
    match region {
        Region::Annulus => 5,
        Region::Disc if is_sharp => 4,
        Region::Disc => 2,
    }
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
    /// The mesh with `cells` cells for a body, which may be sharp at the axis, shared with every
    /// other user of the same.
    pub(crate) fn shared(region: Region, is_sharp: bool, cells: usize) -> Arc<Self> {
        // the list is free again when these are dropped, of which one may be the last
        let in_use: Vec<Arc<Self>> = meshes().iter().filter_map(Weak::upgrade).collect();
        let power = power(region, is_sharp);
        let serves = |mesh: &Arc<Self>| mesh.kind() == (region, power, cells);
        if let Some(mesh) = in_use.into_iter().find(serves) {
            return mesh;
        }
        let mesh = Arc::new(Self::new(region, power, cells));
        meshes().push(Arc::downgrade(&mesh));
        mesh
    }

    /// What makes two meshes equal. Two threads may have made the same one at once.
    pub(crate) fn kind(&self) -> (Region, i32, usize) {
        (self.region, self.power, self.cells)
    }

    fn new(region: Region, power: i32, cells: usize) -> Self {
        let places = Places { region, power, cells };
        let mut share: Vec<f64> = (0..=cells).map(|i| places.rise(0.0, i as f64)).collect();
        share[cells] = 1.0;
        let drift = (0..=cells).map(|i| places.drift(i)).collect();
        let (width, volume) = places.integrals();
        let mut edge = vec![0.0; cells + 1];
        edge[cells] = 1.0;
        let mut mesh = Self {
            region,
            power,
            cells,
            drift,
            inverse: places.inverse_table(),
            pressure: places.pressure_table(),
            inverse_rows: RowBlocks::new(0, |_, _| 0.0),
            pressure_rows: RowBlocks::new(0, |_, _| 0.0),
            drift_of_image: Vec::new(),
            rim: Vec::new(),
            share,
            width,
            edge_image: Vec::new(),
            mean_image: Vec::new(),
            volume: Vec::new(),
            volume_of_image: volume,
            image_of_share: Vec::new(),
            mean_of_share: 0.0,
        };
        mesh.rim = places.rim_column(|i| mesh.pressure_column(cells)[i]);
        let inverse = |i: usize, j: usize| if j <= i { mesh.inverse_column(j)[i - j] } else { 0.0 };
        let pressure =
            |i: usize, j: usize| if i <= j && j < cells { mesh.pressure_column(j)[i] } else { 0.0 };
        (mesh.inverse_rows, mesh.pressure_rows) =
            (RowBlocks::new(cells + 1, inverse), RowBlocks::new(cells + 1, pressure));
        mesh.drift_of_image = (0..=cells).flat_map(|j| mesh.drift_of_unit_image(j)).collect();
        mesh.edge_image = mesh.in_depths(edge);
        mesh.mean_image = mesh.in_depths(mesh.width.clone());
        mesh.volume = mesh.in_depths(mesh.volume_of_image.clone());
        mesh.image_of_share = mesh.abel(&mesh.share);
        mesh.mean_of_share = dot(&mesh.mean_image, &mesh.share);
        mesh
    }

    /// φ dw/dφ at a node inside.
    pub(crate) fn drift_of(&self, w: &[f64], i: usize) -> f64 {
        let (first, weights) = &self.drift[i];
        w[*first..][..weights.len()].iter().zip(weights).map(|(w, weight)| weight * w).sum()
    }

    /// φ dw/dφ at all nodes where zⱼ is 1 and the others are 0.
    fn drift_of_unit_image(&self, j: usize) -> Vec<f64> {
        let mut w = vec![0.0; self.cells + 1];
        w[j..].copy_from_slice(self.inverse_column(j));
        (0..=self.cells).map(|i| self.drift_of(&w, i)).collect()
    }

    /// The same from the table.
    pub(crate) fn drift_column(&self, j: usize) -> &[f64] {
        &self.drift_of_image[j * (self.cells + 1)..][..=self.cells]
    }

    /// First node whose image is unknown: on an annulus the image at the inner edge is given, and
    /// no depth depends on it.
    pub(crate) fn first(&self) -> usize {
        match self.region {
            Region::Annulus => 1,
            Region::Disc => 0,
        }
    }

    /// D̂ⱼⱼ … D̂ₙⱼ.
    pub(crate) fn inverse_column(&self, j: usize) -> &[f64] {
        let start = j * (self.cells + 1) - j * j.saturating_sub(1) / 2;
        &self.inverse[start..][..=self.cells - j]
    }

    /// K̂₀ⱼ … K̂ⱼⱼ; the last column is that of a line which falls to zero at the last node.
    pub(crate) fn pressure_column(&self, j: usize) -> &[f64] {
        &self.pressure[j * (j + 1) / 2..][..=j]
    }

    /// w = D̂ z.
    pub(crate) fn inverse_abel(&self, z: &[f64]) -> Vec<f64> {
        self.inverse_rows.times(z)
    }

    /// z with D̂ z = w, from the first unknown node on.
    pub(crate) fn abel(&self, w: &[f64]) -> Vec<f64> {
        let mut z = w.to_vec();
        for j in self.first()..=self.cells {
            let column = self.inverse_column(j);
            z[j] /= column[0];
            let value = z[j];
            add(&mut z[j + 1..], -value, &column[1..]);
        }
        z
    }

    /// K̂ q for a line q that is zero at the last node, or with `rim` for one that jumps to zero
    /// there.
    pub(crate) fn pressure(&self, q: &[f64], rim: bool) -> Vec<f64> {
        let mut p = self.pressure_rows.times(q);
        if rim {
            add(&mut p, q[self.cells], &self.rim);
        }
        p
    }

    /// The row y with y·w = f·z: solves D̂ᵀ y = f.
    fn in_depths(&self, f: Vec<f64>) -> Vec<f64> {
        let mut y = f;
        for i in (self.first()..=self.cells).rev() {
            let column = self.inverse_column(i);
            y[i] = (y[i] - dot(&column[1..], &y[i + 1..])) / column[0];
        }
        y
    }
}

#[cfg(test)]
mod tests;
