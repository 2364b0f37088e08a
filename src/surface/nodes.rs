//! Nodes that carry the image of the wear.

use super::Contact;
use crate::profile::Profile;
use crate::transform;
use crate::wear::{NodeTransforms, Region, depth_volume};
use serde::{Deserialize, Serialize};

/// Nodes 0 = x₀ < x₁ < … with the image h of the wear at each, linear in X = x² between them; behind the last node,
/// where nothing has worn yet, h falls as 1/x² (the far field of a worn volume).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Nodes {
    x: Vec<f64>,
    worn_image: Vec<f64>,
    /// Worn depth at each node, m.
    depth: Vec<f64>,
    /// Image g of the whole profile at each node, m.
    whole: Vec<f64>,
    /// ∫₀ ξ h' dξ up to each node, m².
    worn_load: Vec<f64>,
    /// ∫₀ g² dξ up to each node, m³.
    square: Vec<f64>,
    /// Cells across the contact that the nodes are meant to give.
    resolution: usize,
    /// The moving mesh among the nodes, where one has left its state here.
    mesh: Option<MeshPlace>,
    /// Where one has done so before other motion: from which radius on (m) cells narrower than the second number (m) are its
    /// remains.
    remains: Option<(f64, f64)>,
}

/// A mesh of the slipping region whose nodes are among those of a surface, from index `first` on.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct MeshPlace {
    pub(crate) region: Region,
    pub(crate) cells: usize,
    pub(crate) first: usize,
    /// The contact under the load that has worn it. Near its final state the image is flat up to the contact edge, and
    /// only the mesh knows where that is.
    pub(crate) contact: Contact,
}

/// Most nodes for each cell of the resolution, far beyond what histories leave.
const MOST_NODES: usize = 64;

/// Nodes kept ready outside the contact, into which it may grow within one update.
const SPARE: usize = 6;

/// Most iterations in the search for a radius; bisection alone would need 60.
const MOST_ITERATIONS: usize = 100;

/// Share of the largest image that thinning may take at the usual tolerance.
const USUAL_SHARE: f64 = 5e-5;

/// Indices of nodes such that the line (in x²) between neighbours meets all others within a share of the largest image, or that
/// crowd at the end: there each lies a part of its distance from the end apart from the next, or of the radius, which falls with the
/// root of the share, as the error of a line does with the square of its length.
pub(crate) fn kept_nodes(x: &[f64], image: &[f64], share: f64, crowd_at_end: bool) -> Vec<usize> {
    let last = x.len() - 1;
    let spread = (share / USUAL_SHARE).sqrt().min(1.0);
    let crowded = |anchor: usize, end: usize| {
        let close = spread * (0.25 * (x[last] - x[anchor])).min(0.01 * x[last]);
        crowd_at_end && x[end] - x[anchor] < close
    };
    thin_unless(x, image, share, crowded, |_, _| true)
}

/// The same, but where a cell is `near`, and never where it may not be.
fn thin_unless(
    x: &[f64],
    image: &[f64],
    share: f64,
    near: impl Fn(usize, usize) -> bool,
    may_be: impl Fn(usize, usize) -> bool,
) -> Vec<usize> {
    let meets = met_by_lines(x, image, share);
    let mut kept = vec![0];
    let (mut anchor, last) = (0, x.len() - 1);
    while anchor < last {
        let mut end = anchor + 1;
        while end < last && (near(anchor, end) || (may_be(anchor, end + 1) && meets(anchor, end + 1))) {
            end += 1;
        }
        kept.push(end);
        anchor = end;
    }
    kept
}

/// Whether the line (in x²) between two nodes meets a field at all between them within a share of its largest value.
fn met_by_lines(x: &[f64], field: &[f64], share: f64) -> impl Fn(usize, usize) -> bool {
    let least = share * field.iter().fold(0.0, |most: f64, h| most.max(h.abs()));
    move |anchor, end| {
        let slope = (field[end] - field[anchor]) / ((x[end] - x[anchor]) * (x[end] + x[anchor]));
        (anchor + 1..end).all(|k| {
            let line = field[anchor] + slope * (x[k] - x[anchor]) * (x[k] + x[anchor]);
            (line - field[k]).abs() <= least
        })
    }
}

/// Slope at the node between two cells, each given by its width and secant, of a cubic that is monotone where the data are
/// (Steffen, Astron. Astrophys. 239 (1990), 443).
fn steffen_slope((h0, before): (f64, f64), (h1, after): (f64, f64)) -> f64 {
    let mean = (before * h1 + after * h0) / (h0 + h1);
    (before.signum() + after.signum()) * before.abs().min(after.abs()).min(0.5 * mean.abs())
}

/// Weight of the outer end in ∫ over a cell [x0, x1] of a function linear in X: Δx ((1 − ω) f₀ + ω f₁).
pub(crate) fn outer_weight(x0: f64, x1: f64) -> f64 {
    (x1 + 2.0 * x0) / (3.0 * (x1 + x0))
}

impl Nodes {
    /// Unworn nodes for a contact of radius `a` whose slip reaches inward to `front`. All cells go to the slipping
    /// annulus (where nothing slips there is no wear to resolve), with nodes at the rim of a flat tip and at the
    /// front, and cells that shrink towards the front from outside.
    pub(crate) fn around(profile: &Profile, resolution: usize, a: f64, front: f64) -> Self {
        let mut nodes = Self {
            x: vec![0.0, a],
            worn_image: vec![0.0; 2],
            depth: vec![0.0; 2],
            whole: Vec::new(),
            worn_load: vec![0.0; 2],
            square: Vec::new(),
            resolution,
            mesh: None,
            remains: None,
        };
        let flat = profile.flat_radius();
        let start = if front < a { front } else { 0.0 };
        for k in 0..resolution {
            nodes.insert(start + (a - start) * k as f64 / resolution as f64);
        }
        nodes.insert(flat);
        nodes.refine_at(front);
        if a >= profile.outer_radius() {
            // the pressure ends in a singularity there until the rim has worn
            let width = (a - start) / resolution as f64;
            for level in 1..=8 {
                nodes.insert(a - width * 0.25f64.powi(level));
            }
        }
        nodes.extend_beyond(a, profile.outer_radius());
        nodes.update_integrals(profile);
        nodes
    }

    /// Nodes left by a moving mesh: radii, image of the wear and depth, m, with the mesh's place among them. Nodes beyond
    /// the mesh keep their depth; their image is that which belongs to it.
    pub(crate) fn assembled(
        profile: &Profile,
        resolution: usize,
        (x, worn_image, depth): (Vec<f64>, Vec<f64>, Vec<f64>),
        mesh: MeshPlace,
    ) -> Self {
        let end = mesh.first + mesh.cells;
        let mut nodes = Self::holding(x, worn_image, depth, resolution, Some(mesh));
        nodes.extend_beyond(nodes.x[end], profile.outer_radius());
        for k in end + 1..nodes.x.len() {
            nodes.worn_image[k] =
                transform::ascend_last(&nodes.x[..=k], &nodes.worn_image[..=k], nodes.depth[k]);
        }
        nodes.update_integrals(profile);
        nodes
    }

    /// Nodes with what they carry; the integrals are still to be made.
    fn holding(
        x: Vec<f64>,
        worn_image: Vec<f64>,
        depth: Vec<f64>,
        resolution: usize,
        mesh: Option<MeshPlace>,
    ) -> Self {
        let worn_load = vec![f64::NAN; x.len()];
        let (whole, square) = (Vec::new(), Vec::new());
        Self { x, worn_image, depth, whole, worn_load, square, resolution, mesh, remains: None }
    }

    /// These nodes with the wear of others on top. Nodes at which the line between others meets image and depth within a share of
    /// their largest values are left out: the volume is told from the depths.
    pub(crate) fn with(&self, others: &Self, share: f64, profile: &Profile) -> Self {
        let mut x: Vec<f64> = self.x.iter().chain(&others.x).copied().collect();
        x.sort_by(f64::total_cmp);
        x.dedup_by(|b, a| *b - *a <= 1e-13 * *a);
        let worn_image: Vec<f64> = x.iter().map(|x| self.worn_part(*x).0 + others.worn_part(*x).0).collect();
        let transforms = NodeTransforms::new(&x);
        let descended = |nodes: &Self| {
            let image: Vec<f64> = x.iter().map(|x| nodes.worn_part(*x).0).collect();
            let end = nodes.x[nodes.last()];
            // behind its last node nothing of a surface has worn, where lines cannot follow its image exactly
            let depth = transforms.descend(&image).into_iter().zip(&x);
            depth.map(|(w, x)| if *x < end { w.max(0.0) } else { 0.0 }).collect::<Vec<f64>>()
        };
        let depth: Vec<f64> =
            descended(self).iter().zip(descended(others)).map(|(base, top)| base + top).collect();
        let kept = thin_unless(&x, &worn_image, share, |_, _| false, met_by_lines(&x, &depth, share));
        let pick = |field: &[f64]| kept.iter().map(|&k| field[k]).collect::<Vec<f64>>();
        let (x, worn_image, depth) = (pick(&x), pick(&worn_image), pick(&depth));
        let mut nodes = Self::holding(x, worn_image, depth, self.resolution, None);
        nodes.update_integrals(profile);
        nodes
    }

    /// Whether these are nodes of a worn profile: numbers in order, with integrals that follow from them.
    pub(crate) fn is_sound(&self, profile: &Profile, resolution: usize) -> bool {
        let count = self.x.len();
        let arrays = [&self.worn_image, &self.depth, &self.whole, &self.worn_load, &self.square];
        let sized = arrays.iter().all(|array| array.len() == count && array.iter().all(|v| v.is_finite()));
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
        if !(sized && placed && self.resolution == resolution && self.mesh.iter().all(meshed)) {
            return false;
        }
        let mut same = self.clone();
        same.update_integrals(profile);
        let alike = |a: &[f64], b: &[f64]| {
            let size = a.iter().chain(b).fold(0.0f64, |most, value| most.max(value.abs()));
            a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-6 * size)
        };
        alike(&same.whole, &self.whole)
            && alike(&same.worn_load, &self.worn_load)
            && alike(&same.square, &self.square)
    }

    /// Place of the moving mesh whose state the nodes hold.
    pub(crate) fn mesh(&self) -> Option<MeshPlace> {
        self.mesh
    }

    /// Worn depth at the nodes, m.
    pub(crate) fn depth(&self) -> &[f64] {
        &self.depth
    }

    /// Worn depth at a radius, m.
    pub(crate) fn depth_at(&self, r: f64) -> f64 {
        if r >= self.x[self.last()] {
            0.0
        } else {
            transform::descent_at(&self.x, &self.worn_image, r).max(0.0)
        }
    }

    /// ∫ 2πr w dr, m³: from the image where a mesh has left it, up to its edge; else from the depths, since on nodes that
    /// reach far beyond the wear the image's integral is a difference of large numbers.
    pub(crate) fn worn_volume(&self) -> f64 {
        if self.mesh.is_none() {
            return self.volume(&self.depth);
        }
        let cells = self.x.windows(2).zip(self.worn_image.windows(2));
        let end = self.x[self.last()];
        cells
            .map(|(x, h)| {
                let (inner, outer) = depth_volume(x[0], x[1], end);
                inner * h[0] + outer * h[1]
            })
            .sum()
    }

    pub(crate) fn x(&self) -> &[f64] {
        &self.x
    }

    pub(crate) fn worn_image(&self) -> &[f64] {
        &self.worn_image
    }

    pub(crate) fn last(&self) -> usize {
        self.x.len() - 1
    }

    /// Cell that holds x, or `None` behind the last node.
    fn cell(&self, x: f64) -> Option<usize> {
        let above = self.x.partition_point(|&node| node <= x);
        (above < self.x.len()).then(|| above - 1)
    }

    /// Radius between two others at which the whole image takes a value, where a cell between nodes holds it and it rises there:
    /// Newton's method, kept inside the cell by bisection, from the line in X between the nodes, which for a sphere is the
    /// image itself.
    pub(crate) fn radius_of_image(&self, profile: &Profile, image: f64, low: f64, high: f64) -> Option<f64> {
        let start = self.x.partition_point(|x| *x <= low);
        let end = self.x.partition_point(|x| *x < high);
        if self.whole.len() != self.x.len() || start == 0 || start > end {
            return None;
        }
        let above = start + self.whole[start..end].partition_point(|g| *g <= image);
        let (x1, g1) = (*self.x.get(above)?, self.whole[above]);
        let j = above - 1;
        let (x0, g0, slope) = (self.x[j], self.whole[j], self.slope(j));
        // written so that it also refuses what is no number
        if !(g0 <= image && image <= g1 && g0 < g1) {
            return None;
        }
        let mut x = (x0 * x0 + (image - g0) / (g1 - g0) * (x1 - x0) * (x1 + x0)).sqrt().clamp(x0, x1);
        let (mut least, mut most) = (x0, x1);
        for _ in 0..MOST_ITERATIONS {
            let excess = profile.image(x) + self.worn_image[j] + slope * (x - x0) * (x + x0) - image;
            // where the image is flat, rounding ends the search before the last digits of x
            if excess.abs() <= 2.0 * f64::EPSILON * image.abs() {
                break;
            }
            if excess > 0.0 {
                most = x;
            } else {
                least = x;
            }
            let newton = x - excess / (profile.image_slope(x) + 2.0 * x * slope);
            let next = if newton > least && newton < most { newton } else { 0.5 * (least + most) };
            let change = (next - x).abs();
            x = next;
            if change <= 2.0 * f64::EPSILON * x {
                break;
            }
        }
        Some(x.max(low).min(high))
    }

    /// Worn parts (h, ∫₀ˣ ξ h' dξ) at radius x.
    pub(crate) fn worn_part(&self, x: f64) -> (f64, f64) {
        self.worn_part_in(self.cell(x), x)
    }

    /// These and ∫₀ˣ g² dξ of the worn image, m³.
    pub(crate) fn parts(&self, profile: &Profile, x: f64) -> (f64, f64, f64) {
        let cell = self.cell(x);
        let (image, load) = self.worn_part_in(cell, x);
        let start = cell.unwrap_or(self.last());
        (image, load, self.square[start] + self.square_between(profile, cell, self.x[start], x))
    }

    /// Worn parts at a radius in a given cell, or behind the last node.
    fn worn_part_in(&self, cell: Option<usize>, x: f64) -> (f64, f64) {
        match cell {
            Some(j) => {
                let (x0, slope) = (self.x[j], self.slope(j));
                let image = self.worn_image[j] + slope * (x - x0) * (x + x0);
                let load = self.worn_load[j] + 2.0 / 3.0 * slope * (x - x0) * (x * x + x * x0 + x0 * x0);
                (image, load)
            }
            None => {
                let (end, ratio) = (self.last(), self.x[self.last()] / x);
                let h = self.worn_image[end];
                (h * ratio * ratio, self.worn_load[end] - 2.0 * h * self.x[end] * (1.0 - ratio))
            }
        }
    }

    /// Image of the wear at x by Steffen's monotone cubic in x²: of higher order than
    /// the line where the image is smooth, without overshoot at a jump. For taking it over to other nodes.
    pub(crate) fn smooth_image(&self, x: f64) -> f64 {
        let Some(j) = self.cell(x) else { return self.worn_part(x).0 };
        let (x0, width) = (self.x[j], (self.x[j + 1] - self.x[j]) * (self.x[j + 1] + self.x[j]));
        let slope = |k: usize| {
            let secant = self.slope(k);
            if k == 0 {
                return secant;
            }
            let width = |k: usize| (self.x[k + 1] - self.x[k]) * (self.x[k + 1] + self.x[k]);
            steffen_slope((width(k - 1), self.slope(k - 1)), (width(k), secant))
        };
        let (h0, h1, secant) = (self.worn_image[j], self.worn_image[j + 1], self.slope(j));
        let start = slope(j);
        let end = if j + 1 < self.last() { slope(j + 1) } else { secant };
        let t = ((x - x0) * (x + x0) / width).clamp(0.0, 1.0);
        let (a, b) = (start * width - (h1 - h0), (h1 - h0) - end * width);
        (1.0 - t) * h0 + t * h1 + t * (1.0 - t) * (a * (1.0 - t) + b * t)
    }

    /// Slope h'(x).
    pub(crate) fn worn_slope(&self, x: f64) -> f64 {
        match self.cell(x) {
            Some(j) => 2.0 * x * self.slope(j),
            None => -2.0 * self.worn_image[self.last()] * (self.x[self.last()] / x).powi(2) / x,
        }
    }

    /// dh/dX in cell j.
    fn slope(&self, j: usize) -> f64 {
        let (x0, x1) = (self.x[j], self.x[j + 1]);
        (self.worn_image[j + 1] - self.worn_image[j]) / ((x1 - x0) * (x1 + x0))
    }

    /// ∫ g² between two radii of one cell, by three-point Gauss.
    fn square_between(&self, profile: &Profile, cell: Option<usize>, x0: f64, x1: f64) -> f64 {
        let (middle, half) = (0.5 * (x0 + x1), 0.5 * (x1 - x0));
        let g2 = |x: f64| (profile.image(x) + self.worn_part_in(cell, x).0).powi(2);
        let node = half * 0.6f64.sqrt();
        half * (5.0 / 9.0 * (g2(middle - node) + g2(middle + node)) + 8.0 / 9.0 * g2(middle))
    }

    /// Takes new image values with the depths they belong to, and brings the integrals up to date.
    pub(crate) fn set_worn(&mut self, worn_image: Vec<f64>, depth: Vec<f64>, profile: &Profile) {
        self.worn_image = worn_image;
        self.depth = depth;
        self.leave_mesh();
        self.update_integrals(profile);
    }

    fn update_integrals(&mut self, profile: &Profile) {
        self.whole.clear();
        self.whole.extend(self.x.iter().zip(&self.worn_image).map(|(x, h)| profile.image(*x) + h));
        self.worn_load.clear();
        self.square.clear();
        let mut load = 0.0;
        for j in 0..self.x.len() {
            self.worn_load.push(load);
            if j < self.last() {
                let (x0, x1) = (self.x[j], self.x[j + 1]);
                load += 2.0 / 3.0 * self.slope(j) * (x1 - x0) * (x1 * x1 + x1 * x0 + x0 * x0);
            }
        }
        // after the loads, of which the parts at a radius are made
        let mut square = 0.0;
        for j in 0..self.x.len() {
            self.square.push(square);
            if j < self.last() {
                square += self.square_between(profile, Some(j), self.x[j], self.x[j + 1]);
            }
        }
    }

    /// Adapts the nodes to a contact of radius `a` whose slip has reached inward to `front`: extends them beyond a,
    /// halves cells of the slipping annulus that are too wide, puts a node at the front. h does not change by that.
    pub(crate) fn adapt(&mut self, profile: &Profile, a: f64, front: f64) {
        let before = self.x.len();
        self.extend_beyond(a, profile.outer_radius());
        if self.wants_node_at(front, a) {
            self.insert(front);
        }
        let start = if front < a { front } else { 0.0 };
        self.refine_between(start, a, 1.5 * a / self.resolution as f64);
        if self.x.len() != before {
            self.update_integrals(profile);
        }
    }

    /// These nodes, for a contact of radius `a`, without those that a line (in x²) between others meets within `share` of the
    /// largest image, as long as no cell becomes wider than an even one; `None` where that would spare less than a
    /// fifth of them. What a front needed where it no longer stands makes an update stiff.
    ///
    /// A mesh that has moved with the contact edge leaves narrow cells there, too. In its outer half none stays narrower than half an
    /// even one: an implicit update takes the contact edge for one that stays in its cell or goes on to the next, and across
    /// many narrow ones it overshoots.
    pub(crate) fn thinned(&self, share: f64, a: f64, profile: &Profile) -> Option<Self> {
        let width = |anchor: usize, end: usize| self.x[end] - self.x[anchor];
        let (outer_half, least) = self.remains.or(self.remains_of_mesh()).unwrap_or((f64::INFINITY, 0.0));
        let narrow = |anchor: usize, end: usize| self.x[anchor] >= outer_half && width(anchor, end) < least;
        let may_be = |anchor: usize, end: usize| {
            width(anchor, end) <= 0.75 * self.x[anchor].max(a) / self.resolution as f64
        };
        let kept = thin_unless(&self.x, &self.worn_image, share, narrow, may_be);
        if kept.len() * 5 > self.x.len() * 4 {
            return None;
        }
        let pick = |field: &[f64]| kept.iter().map(|&k| field[k]).collect::<Vec<f64>>();
        let (x, worn_image, depth) = (pick(&self.x), pick(&self.worn_image), pick(&self.depth));
        let mut nodes = Self::holding(x, worn_image, depth, self.resolution, None);
        nodes.update_integrals(profile);
        Some(nodes)
    }

    /// The mesh does not carry the surface any more.
    fn leave_mesh(&mut self) {
        self.remains = self.remains_of_mesh().or(self.remains);
        self.mesh = None;
    }

    /// Middle of the mesh and the width that its cells outside that should have on a surface at rest: an even one of
    /// its own, or half an even one of the contact unless that would leave less than sixteen.
    fn remains_of_mesh(&self) -> Option<(f64, f64)> {
        let mesh = self.mesh?;
        let (inner, edge) = (self.x[mesh.first], self.x[mesh.first + mesh.cells]);
        let (span, even) = (edge - inner, edge / self.resolution as f64);
        Some((0.5 * (inner + edge), (span / mesh.cells as f64).max((0.5 * even).min(span / 16.0))))
    }

    /// Appends nodes until enough lie beyond `a` (or the body ends). Cells grow by a fiftieth each, up to 1/resolution of
    /// their radius.
    fn extend_beyond(&mut self, a: f64, outer: f64) {
        while self.x[self.last().saturating_sub(SPARE)] <= a && self.x[self.last()] < outer {
            let end = self.x[self.last()];
            let even = end / self.resolution as f64;
            let width = (1.02 * (end - self.x[self.last() - 1])).min(even);
            self.x.push((end + width).min(outer));
            self.worn_image.push(0.0);
            self.depth.push(0.0);
            self.worn_load.push(f64::NAN);
            if self.worn_image.iter().any(|h| *h != 0.0) {
                let last = self.last();
                self.worn_image[last] = transform::ascend_last(&self.x, &self.worn_image, 0.0);
            }
        }
    }

    /// Halves the cells between two radii until none is wider than `widest`.
    fn refine_between(&mut self, start: f64, end: f64, widest: f64) {
        let mut j = self.cell(start).unwrap_or(self.last());
        while j < self.last() && self.x[j] < end {
            if self.x[j + 1] - self.x[j] > widest {
                self.insert(0.5 * (self.x[j] + self.x[j + 1]));
            } else {
                j += 1;
            }
        }
    }

    /// A front wants a node of its own unless the cell around it is already finer than half an even cell.
    fn wants_node_at(&self, front: f64, a: f64) -> bool {
        let Some(j) = self.cell(front) else { return false };
        let width = self.x[j + 1] - self.x[j];
        let off = (front - self.x[j]).min(self.x[j + 1] - front);
        front > 0.0 && off > 1e-9 * a && width > 0.5 * a / self.resolution as f64
    }

    /// Puts a node at `front` and a fan of nodes outside it whose distances fall by four to 4⁻⁸ of a cell.
    fn refine_at(&mut self, front: f64) {
        let Some(j) = self.cell(front) else { return };
        let width = self.x[j + 1] - front;
        if front <= 0.0 || width <= 0.0 {
            return;
        }
        self.insert(front);
        for level in 1..=8 {
            self.insert(front + width * 0.25f64.powi(level));
        }
    }

    /// Inserts a node where the image keeps its value.
    fn insert(&mut self, x: f64) {
        let Some(j) = self.cell(x) else { return };
        if x <= self.x[j] {
            return;
        }
        self.leave_mesh();
        let h = self.worn_part(x).0;
        let depth = if self.depth.iter().all(|w| *w == 0.0) { 0.0 } else { self.depth_at(x) };
        self.x.insert(j + 1, x);
        self.worn_image.insert(j + 1, h);
        self.depth.insert(j + 1, depth);
        // keeps worn_part usable for the next insertion; update_integrals follows
        self.worn_load.insert(j + 1, f64::NAN);
    }

    /// ∫ 2πr w dr of a field given at the nodes, linear in r² between them (m³ for a depth in m): what is added to it node by
    /// node adds up.
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
}
