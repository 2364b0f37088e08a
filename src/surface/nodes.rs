//! Nodes that carry the image of the wear.

mod levelled;
mod placement;
mod rim;
mod shape;
mod thinning;

use super::depth_volume::depth_volume;
use super::{Contact, Region};
use crate::profile::Profile;
use levelled::load_of_line;
pub(crate) use placement::FrontMotion;
use serde::{Deserialize, Serialize};
pub(crate) use thinning::kept_nodes;

/// Nodes 0 = x₀ < x₁ < … with the image h of the wear at each, linear in X = x² between them;
/// behind the last node, where nothing has worn yet, h falls as 1/x² (the far field of a worn
/// volume).
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(crate) struct Nodes {
    x: Vec<f64>,
    worn_image: Vec<f64>,
    /// Worn depth at each node, m.
    depth: Vec<f64>,
    /// What follows from the rest, at each node.
    #[serde(skip)]
    integrals: Vec<Integrals>,
    /// And the number of cells from the axis on in which wear has levelled the body.
    #[serde(skip)]
    levelled: usize,
    /// Cells across the contact that the nodes are meant to give.
    resolution: usize,
    /// The moving mesh among the nodes, where one has left its state here.
    mesh: Option<Box<MeshPlace>>,
    /// Where one has done so before other motion: from which radius on (m) cells narrower than the
    /// second number (m) are its remains.
    remains: Option<(f64, f64)>,
}

/// Integrals up to a node.
#[derive(Debug, Clone, Copy, Default)]
struct Integrals {
    /// ∫₀ ξ g' dξ of the whole profile less that of the body, m².
    worn_load: f64,
    /// ∫₀ g² dξ of the whole profile less that of the body, m³.
    worn_square: f64,
}

impl Integrals {
    /// Those of nodes that are being made.
    const UNKNOWN: Self = Self { worn_load: f64::NAN, worn_square: f64::NAN };
}

/// A mesh of the slipping region whose nodes are among those of a surface, from index `first` on.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct MeshPlace {
    pub(crate) region: Region,
    pub(crate) cells: usize,
    pub(crate) first: usize,
    /// The contact under the load that has worn it. Near its final state the image is flat up to
    /// the contact edge, and only the mesh knows where that is.
    pub(crate) contact: Contact,
}

/// Most nodes for each cell of the resolution, far beyond what histories leave.
const MOST_NODES: usize = 64;

/// Weight of the outer end in ∫ over a cell [x0, x1] of a function linear in X: Δx ((1 − ω) f₀ + ω
/// f₁).
pub(crate) fn outer_weight(x0: f64, x1: f64) -> f64 {
    (x1 + 2.0 * x0) / (3.0 * (x1 + x0))
}

impl Nodes {
    pub(crate) fn x(&self) -> &[f64] {
        &self.x
    }

    pub(crate) fn worn_image(&self) -> &[f64] {
        &self.worn_image
    }

    /// Worn depth at the nodes, m.
    pub(crate) fn depth(&self) -> &[f64] {
        &self.depth
    }

    /// Worn depth at the nodes with more on top, m; what is empty adds nothing.
    pub(crate) fn depths_with<'a>(&'a self, more: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        let more = more.iter().copied().chain(std::iter::repeat(0.0));
        self.depth.iter().zip(more).map(|(depth, more)| depth + more)
    }

    pub(crate) fn last(&self) -> usize {
        self.x.len() - 1
    }

    /// Whether the last node is the rim of a body that ends there.
    pub(crate) fn reach_rim(&self, profile: &Profile) -> bool {
        self.x[self.last()] >= profile.outer_radius()
    }

    /// Becomes a copy of other nodes in its own memory.
    pub(crate) fn copy_from(&mut self, other: &Self) {
        self.x.clone_from(&other.x);
        self.worn_image.clone_from(&other.worn_image);
        self.depth.clone_from(&other.depth);
        self.integrals.clone_from(&other.integrals);
        self.levelled = other.levelled;
        self.mesh.clone_from(&other.mesh);
        (self.resolution, self.remains) = (other.resolution, other.remains);
    }

    /// Place of the moving mesh whose state the nodes hold.
    pub(crate) fn mesh(&self) -> Option<MeshPlace> {
        self.mesh.as_deref().copied()
    }

    /// Takes new image values with the depths they belong to, and brings the integrals up to date.
    pub(crate) fn set_worn(&mut self, worn_image: Vec<f64>, depth: Vec<f64>, profile: &Profile) {
        self.worn_image = worn_image;
        self.depth = depth;
        self.leave_mesh();
        self.update_integrals(profile);
    }

    /// These nodes without the mesh among them, with the depths of their image, m. The mesh tells
    /// both by lines in x² of the image over x, which at a front near the axis is another profile
    /// between nodes. What has not worn stays so: a depth of rounding at the last node would look
    /// like wear up to the end of the body.
    pub(crate) fn without_mesh(&self, depth: Vec<f64>) -> Self {
        let worn = |(new, old): (f64, &f64)| if *old == 0.0 { 0.0 } else { new.max(0.0) };
        let depth = depth.into_iter().zip(&self.depth).map(worn).collect();
        let mut nodes = Self { depth, ..self.clone() };
        nodes.leave_mesh();
        nodes
    }

    pub(crate) fn update_integrals(&mut self, profile: &Profile) {
        self.integrals.clear();
        self.integrals.reserve_exact(self.x.len());
        self.levelled = self.levelled_from_axis(profile);
        let mut load = 0.0;
        for j in 0..self.x.len() {
            self.integrals.push(Integrals { worn_load: load, worn_square: 0.0 });
            if j < self.last() {
                let (x0, x1) = (self.x[j], self.x[j + 1]);
                load += 2.0 / 3.0 * self.slope(j) * (x1 - x0) * (x1 * x1 + x1 * x0 + x0 * x0);
                if j < self.levelled {
                    load += load_of_line(profile, (x0, x1))
                        - (profile.load_integral(x1) - profile.load_integral(x0));
                }
            }
        }
        // after the loads, of which the parts at a radius are made
        let mut square = 0.0;
        for j in 0..self.last() {
            square += self.worn_square_in_cell(profile, Some(j), self.x[j + 1]);
            self.integrals[j + 1].worn_square = square;
        }
    }

    /// ∫ 2πr w dr, m³: from the image where a mesh has left it, else from the depths, which updates
    /// scale to the work.
    pub(crate) fn worn_volume(&self) -> f64 {
        if self.mesh.is_none() { self.volume(&self.depth) } else { self.image_volume() }
    }

    /// Volume of the depth that belongs to the image, m³, up to where the wear ends.
    pub(crate) fn image_volume(&self) -> f64 {
        let worn = self.worn_nodes();
        depth_volume(&self.x[..worn], &self.worn_image[..worn])
    }

    /// Number of nodes up to the first one beyond all wear; 0 where nothing has worn.
    fn worn_nodes(&self) -> usize {
        let last = self.depth.iter().rposition(|w| *w > 0.0);
        last.map_or(0, |last| (last + 2).min(self.x.len()))
    }

    /// ∫ 2πr w dr of a field given at the nodes, linear in r² between them (m³ for a depth in m):
    /// what is added to it node by node adds up.
    pub(crate) fn volume(&self, field: &[f64]) -> f64 {
        let mut volume = 0.0;
        for (x, w) in self.x.windows(2).zip(field.windows(2)) {
            volume += (w[0] + w[1]) * (x[1] - x[0]) * (x[1] + x[0]);
        }
        volume * std::f64::consts::PI / 2.0
    }

    /// The same for a field that ends at radius `a` like √(a² − r²), as pressure and traction do.
    pub(crate) fn integral_to_edge(&self, field: &[f64], a: f64) -> f64 {
        let end = self.x.partition_point(|&x| x < a).max(1);
        let mut sum = 0.0;
        for j in 1..end {
            sum += (field[j - 1] + field[j]) * (self.x[j] - self.x[j - 1]) * (self.x[j] + self.x[j - 1]);
        }
        let last = self.x[end - 1];
        sum += field[end - 1] * 4.0 / 3.0 * (a - last) * (a + last);
        sum * std::f64::consts::PI / 2.0
    }

    /// These nodes with their integrals, which a saved state leaves out.
    pub(crate) fn completed(&self, profile: &Profile) -> Self {
        let mut nodes = self.clone();
        if nodes.integrals.len() != nodes.x.len() {
            nodes.update_integrals(profile);
        }
        nodes
    }

    /// The same if these are nodes of a worn profile: numbers in order.
    pub(crate) fn checked(&self, profile: &Profile, resolution: usize) -> Option<Self> {
        let count = self.x.len();
        let is_field = |field: &Vec<f64>| field.len() == count && field.iter().all(|value| value.is_finite());
        let placed = count >= 2
            && count <= MOST_NODES * (resolution + MOST_NODES)
            && self.x[0] == 0.0
            && self.x.windows(2).all(|pair| pair[0] < pair[1])
            && self.x[count - 1] <= profile.outer_radius()
            && self.x[count - 1].is_finite();
        let meshed = |mesh: &MeshPlace| {
            let Contact { control, depth, radius, load } = mesh.contact;
            let numbers = [control, depth, radius, load].iter().all(|value| value.is_finite());
            let end = mesh.first.checked_add(mesh.cells);
            numbers && radius >= 0.0 && load >= 0.0 && mesh.cells > 0 && end.is_some_and(|end| end < count)
        };
        if !(placed
            && [&self.worn_image, &self.depth].into_iter().all(is_field)
            && self.resolution == resolution
            && self.mesh.as_deref().is_none_or(meshed))
        {
            return None;
        }
        let nodes = self.completed(profile);
        let finite = |at: &Integrals| at.worn_load.is_finite() && at.worn_square.is_finite();
        nodes.integrals.iter().all(finite).then_some(nodes)
    }
}

/// The integrals follow from the rest.
impl PartialEq for Nodes {
    fn eq(&self, other: &Self) -> bool {
        let own = (&self.x, &self.worn_image, &self.depth, self.resolution, &self.mesh, self.remains);
        own == (&other.x, &other.worn_image, &other.depth, other.resolution, &other.mesh, other.remains)
    }
}
