//! Where nodes are: around a contact, from a moving mesh, joined, refined and thinned.

use super::thinning::{NEARLY, both_met_by_lines, thinned_while};
use super::{Integrals, MeshPlace, Nodes};
use crate::profile::Profile;
use crate::transform;

/// Nodes kept ready outside the contact, into which it may grow within one update.
const SPARE: usize = 6;

/// How far wide cells reach beyond the others, over their radius. Where the load rises on a worn
/// body the contact grows into them at once; beyond, the image is taken to fall with x².
const FAR: f64 = 2.0;

/// Least and most width of those cells, over that of an even one. With lines in the widest the
/// image is off by 2e-3 of itself.
const WIDTHS: (f64, f64) = (0.1, 3.0);

/// By how much each of them is wider than the one before, between these.
const WIDER: f64 = 1.3;

/// Least width of a cell at which a surface at rest is worn, over the contact radius. A front that
/// hardly moves leaves walls of the image between nodes far closer to each other, and where all
/// slips later, the pressure at such a wall is all but singular: an update then overshoots, or ends
/// too early. Of loads in blocks that leave such a wall V was up to 30 % off. Ten times as much
/// serve as well, a tenth on 64 cells only.
const LEAST_CELL: f64 = 1e-5;

/// Largest width of a cell outside the contact over its distance from that. A core that has stuck
/// is one cell: where a smaller contact wears in it, the line to its end was no image of that, and
/// V in gross slip went 3.5 % beyond the final one. Half of it and twice serve as well.
const GAP: f64 = 0.25;

/// Largest width of a cell in the slipping region over that of one next to it. A former front has
/// fine cells outside it only. Slip of a larger amplitude wears the wall of the image there from
/// inside as well, and after the next cycles of the smaller one V was up to 11 % too large. Now it
/// is within 2.4 %; with half of the value also, with twice within 2.8 %.
const GRADING: f64 = 4.0;

/// Least distance of nodes from a kink of the body over the radius to which wear has rounded it.
/// With a fifth of the value and four times as much the median error of the depths read there is
/// the same within a quarter.
const OF_ROUNDED: f64 = 0.25;

/// How the front of slip goes on its way, and with it what an update needs there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum FrontMotion {
    /// With every stroke it comes in again: a node, unless the cell there is finer than half an
    /// even one.
    Returns,
    /// As the body goes round, or in cycles of one amplitude, it stays or creeps outward before the
    /// worn image that rises steeply behind it. Where a cell flattens that rise it creeps too far,
    /// and V of orbits is up to 1.4 % off: a fan, unless the cell is finer than a fortieth. With a
    /// tenth and three nodes V differs by 0.02 to 0.1 % from that.
    Creeps,
}

impl FrontMotion {
    /// Width of the cell at the front, in even ones, that will do.
    fn fine(self) -> f64 {
        match self {
            Self::Returns => 0.5,
            Self::Creeps => 0.025,
        }
    }

    /// Nodes of the fan.
    fn levels(self) -> usize {
        match self {
            Self::Returns => 0,
            Self::Creeps => 5,
        }
    }
}

/// Widths that fall by four from one, m.
fn shrinking(width: f64) -> impl Iterator<Item = f64> {
    (1..).map(move |level| width * 0.25f64.powi(level))
}

impl Nodes {
    /// Unworn nodes for a contact of radius `a` whose slip reaches inward to `front`. All cells go
    /// to the slipping annulus (where nothing slips there is no wear to resolve), with nodes at the
    /// rim of a flat tip and at the front, and cells that shrink towards the front from outside and
    /// towards that rim from inside.
    pub(crate) fn around(profile: &Profile, resolution: usize, a: f64, front: f64) -> Self {
        let mut nodes = Self {
            x: vec![0.0, a],
            worn_image: vec![0.0; 2],
            depth: vec![0.0; 2],
            integrals: vec![Integrals::default(); 2],
            levelled: 0,
            resolution,
            mesh: None,
            remains: None,
        };
        let flat = profile.flat_radius();
        let start = if front < a { front } else { 0.0 };
        for k in 0..resolution {
            nodes.insert(start + (a - start) * k as f64 / resolution as f64, profile);
        }
        nodes.insert(flat, profile);
        nodes.refine_at_kink(profile, (start, a));
        nodes.refine_at(front, 8, profile);
        // where the contact ends just beyond the rim of a flat tip, the pressure there is all but
        // singular until the rim has worn
        let width = (a - start) / resolution as f64;
        let gaps = shrinking(width).take(8).take_while(|gap| *gap > a - flat);
        gaps.for_each(|gap| nodes.insert(flat - gap, profile));
        nodes.extend_beyond(a, profile.outer_radius());
        nodes.update_integrals(profile);
        nodes
    }

    /// Appends the nodes of another surface that lie beyond these, with nodes between where the
    /// next is far: the image bends where nothing has worn, too. There the depth is that of the
    /// other surface. Its image has in addition the image of the change of depth inside, which is
    /// smooth. Where nodes crowd, as at a former front, the image that belongs to the depths at the
    /// nodes would be off by a hundred times as much as these.
    pub(crate) fn append_worn(&mut self, outside: &Self) {
        let end = self.last();
        let first = 1.5 * self.x[end] - 0.5 * self.x[end - 1];
        let beyond = outside.x.partition_point(|x| *x <= first);
        let mut change = self.change_from(outside);
        for &x in outside.x.iter().take(outside.close_nodes()).skip(beyond) {
            loop {
                let (end, width) = (self.x[self.last()], self.next_width(2.0));
                if x - end <= 1.5 * width {
                    break;
                }
                self.append_changed(end + width, outside, &mut change);
            }
            self.append_changed(x, outside, &mut change);
        }
    }

    /// Radii (m) of the nodes of both surfaces up to the end, and the difference of the images
    /// there, m.
    fn change_from(&self, other: &Self) -> (Vec<f64>, Vec<f64>) {
        let end = self.x[self.last()];
        let mut x: Vec<f64> = self.x.iter().chain(other.x.iter().filter(|x| **x < end)).copied().collect();
        x.sort_by(f64::total_cmp);
        x.dedup();
        let change = |x: &f64| self.line(&self.worn_image, *x) - other.line(&other.worn_image, *x);
        let change = x.iter().map(change).collect();
        (x, change)
    }

    /// Appends a node where the depth is that of another surface, here and to the change of the
    /// image.
    fn append_changed(&mut self, x: f64, other: &Self, (radii, change): &mut (Vec<f64>, Vec<f64>)) {
        radii.push(x);
        change.push(0.0);
        let last = change.len() - 1;
        change[last] = transform::abel_last(radii, change, 0.0);
        self.x.push(x);
        self.worn_image.push(other.line(&other.worn_image, x) + change[last]);
        self.depth.push(other.line(&other.depth, x));
        self.integrals.push(Integrals::UNKNOWN);
    }

    /// Appends unworn nodes until enough lie beyond a moving mesh.
    pub(crate) fn extend_beyond_mesh(&mut self, profile: &Profile) {
        if let Some(mesh) = self.mesh() {
            self.extend_beyond(self.x[mesh.first + mesh.cells], profile.outer_radius());
        }
        self.extend_far(profile);
    }

    /// Nodes of some radii, image of the wear and depth, m, with the place among them of the moving
    /// mesh that leaves them; the integrals are still to be made.
    pub(crate) fn holding(
        (x, worn_image, depth): (Vec<f64>, Vec<f64>, Vec<f64>),
        resolution: usize,
        mesh: Option<MeshPlace>,
    ) -> Self {
        let integrals = vec![Integrals::UNKNOWN; x.len()];
        let mesh = mesh.map(Box::new);
        Self { x, worn_image, depth, integrals, levelled: 0, resolution, mesh, remains: None }
    }

    /// Some nodes of more: of their radii, images and depths, m, those that are kept.
    pub(super) fn of_kept(kept: &[usize], fields: [&[f64]; 3], resolution: usize, profile: &Profile) -> Self {
        let [x, worn_image, depth] = fields.map(|field| kept.iter().map(|&k| field[k]).collect());
        let mut nodes = Self::holding((x, worn_image, depth), resolution, None);
        nodes.update_integrals(profile);
        nodes
    }

    /// Adapts the nodes to a contact of radius `a` whose slip has reached inward to `front`:
    /// extends them beyond a, halves cells of the slipping annulus that are too wide, puts nodes at
    /// the front. The image does not change by that.
    pub(crate) fn adapt(&mut self, profile: &Profile, a: f64, (front, way): (f64, FrontMotion)) {
        let before = self.x.len();
        self.extend_beyond(a, profile.outer_radius());
        let node = self.x.iter().copied().find(|x| (x - front).abs() <= 1e-9 * a);
        let front = node.unwrap_or(front);
        if self.is_coarse_at(front, way, a) && (node.is_none() || way.levels() > 0) {
            self.refine_at(front, way.levels(), profile);
        }
        let start = if front < a { front } else { 0.0 };
        self.refine_between(start, a, 1.5 * a / self.resolution as f64, profile);
        self.refine_at_kink(profile, (start, a));
        if self.x.len() != before {
            self.update_integrals(profile);
        }
    }

    /// Largest contact radius (m) beyond which enough nodes lie for the contact to grow into as it
    /// wears.
    pub(crate) fn served_radius(&self) -> f64 {
        self.x[(self.close_nodes() - 1).saturating_sub(SPARE)]
    }

    /// Appends wide cells, for a contact that grows at once: not where the wear goes up to the last
    /// node, as on a ring next to the rim of a flat, for it would end in the first of them.
    pub(crate) fn extend_far(&mut self, profile: &Profile) {
        let is_within = self.depth[self.last()] == 0.0;
        let far = (FAR * self.x[self.last()]).min(profile.outer_radius());
        while is_within && self.x[self.last()] < far {
            self.append(self.next_far(self.last()).min(far));
        }
        // they are kept from update to update
        self.x.shrink_to_fit();
        self.worn_image.shrink_to_fit();
        self.depth.shrink_to_fit();
        self.integrals.shrink_to_fit();
        self.update_integrals(profile);
    }

    /// Leaves out the wide cells: wear has no place there.
    pub(crate) fn leave_far(&mut self) {
        let nodes = self.close_nodes();
        self.x.truncate(nodes);
        self.worn_image.truncate(nodes);
        self.depth.truncate(nodes);
        self.integrals.truncate(nodes);
    }

    /// Number of nodes before the wide cells, which are known by their widths.
    fn close_nodes(&self) -> usize {
        let is_far = |end: &usize| {
            let (x, next) = (self.x[*end], self.next_far(*end - 1));
            self.depth[*end] == 0.0 && (x == next || x < next && *end == self.last())
        };
        let far = (2..self.x.len()).rev().take_while(is_far).count();
        // a close cell at the end may be narrower than a wide one as well
        self.x.len() - if far > 1 { far } else { 0 }
    }

    /// The last node (m) neither beyond a radius nor beyond the first worn node.
    pub(crate) fn node_within_wear(&self, radius: f64) -> f64 {
        let worn = self.depth.iter().position(|depth| *depth > 0.0).unwrap_or(self.last());
        let inside = self.x.partition_point(|x| *x <= radius);
        self.x[worn.min(inside.saturating_sub(1))]
    }

    /// Extends the nodes to an outer radius and halves cells between an inner one and that which
    /// are too wide. The image does not change by that.
    pub(crate) fn cover(&mut self, profile: &Profile, (inner, outer): (f64, f64)) {
        let before = self.x.len();
        if outer > self.x[self.last()] {
            self.extend_beyond(outer, profile.outer_radius());
        }
        self.refine_between(inner, outer, 1.5 * outer / self.resolution as f64, profile);
        self.refine_at_kink(profile, (inner, outer));
        if self.x.len() != before {
            self.update_integrals(profile);
        }
    }

    /// These nodes, for a contact of radius `a`, without those whose image a line (in x²) between
    /// others meets within `share` of the largest, and whose depth, as long as no cell becomes
    /// wider than an even one; `None` where that would spare less than a fifth of them, and none is
    /// too close to the next. What a front needed where it no longer stands makes an update stiff.
    ///
    /// A mesh that has moved with the contact edge leaves narrow cells there, too. In its outer
    /// half those go that are narrower than `crossed` (m) and than half an even one: an implicit
    /// update takes the contact edge for one that stays in its cell or goes on to the next, and
    /// across many narrow ones it overshoots. At a rim the edge does not move, and wide cells would
    /// miss how steeply it has worn. Outside the contact those stay that hold the wall of a former
    /// front, which lines do not nearly meet.
    pub(crate) fn thinned(&self, share: f64, a: f64, crossed: f64, profile: &Profile) -> Option<Self> {
        let has_rim = self.reach_rim(profile);
        let remains = self.remains.or(self.remains_of_mesh()).filter(|_| !has_rim);
        let (outer_half, least) = remains.unwrap_or((f64::INFINITY, 0.0));
        let least = least.min(crossed);
        let least_cell = if has_rim { 0.0 } else { LEAST_CELL * a };
        let width = |anchor: usize, end: usize| self.x[end] - self.x[anchor];
        let is_close = |anchor: usize, end: usize| width(anchor, end) < least_cell;
        let met = |share| both_met_by_lines(&self.x, &self.worn_image, &self.depth, share);
        let (meets, meets_nearly) = (met(share), met(NEARLY * share));
        let kept = thinned_while(&self.x, &self.worn_image, |anchor, end| {
            let is_narrow = self.x[anchor] >= outer_half
                && width(anchor, end) < least
                && (self.x[end] <= a || meets_nearly(anchor, end + 1));
            let widest = 0.75 * self.x[anchor].max(a) / self.resolution as f64;
            is_narrow || is_close(anchor, end) || (width(anchor, end + 1) <= widest && meets(anchor, end + 1))
        });
        let spares_few = kept.len() * 5 > self.x.len() * 4;
        if spares_few && !(1..self.x.len()).any(|end| is_close(end - 1, end)) {
            return None;
        }
        Some(Self::of_kept(&kept, [&self.x, &self.worn_image, &self.depth], self.resolution, profile))
    }

    /// The mesh does not carry the surface any more.
    pub(super) fn leave_mesh(&mut self) {
        self.remains = self.remains_of_mesh().or(self.remains);
        self.mesh = None;
    }

    /// Middle of the mesh and the width that its cells outside that need not go below on a surface
    /// at rest: an even one of its own, or half an even one of the contact unless that would leave
    /// less than sixteen.
    fn remains_of_mesh(&self) -> Option<(f64, f64)> {
        let mesh = self.mesh()?;
        let (inner, edge) = (self.x[mesh.first], self.x[mesh.first + mesh.cells]);
        let (span, even) = (edge - inner, edge / self.resolution as f64);
        Some((0.5 * (inner + edge), (span / mesh.cells as f64).max((0.5 * even).min(span / 16.0))))
    }

    /// Appends nodes until enough lie beyond `a` (or the body ends). Cells grow by a fiftieth each,
    /// up to 1/resolution of their radius.
    fn extend_beyond(&mut self, a: f64, outer: f64) {
        self.extend_growing(1.02, (a, outer));
    }

    /// The same in cells that grow by a factor.
    fn extend_growing(&mut self, factor: f64, (a, outer): (f64, f64)) {
        while self.served_radius() <= a && self.x[self.last()] < outer {
            let end = self.x[self.last()] + self.next_width(factor);
            self.append(end.min(outer));
        }
    }

    /// These nodes and more at their end, in cells that grow fast; `None` where they end far beyond
    /// a contact radius (m), or the body does.
    pub(crate) fn reaching_further(&self, (radius, profile): (f64, &Profile)) -> Option<Self> {
        let last = self.last();
        let far = (FAR * radius).min(profile.outer_radius());
        (self.x[last] < far).then(|| {
            let mut more = self.clone();
            more.leave_mesh();
            // as many as lie ready outside a contact
            more.extend_growing(2.0, (self.x[last - 1], far));
            more.update_integrals(profile);
            more
        })
    }

    /// Width of a cell beyond the last, m: by a factor wider, up to an even one.
    fn next_width(&self, factor: f64) -> f64 {
        let (end, before) = (self.x[self.last()], self.x[self.last() - 1]);
        (factor * (end - before)).min(end / self.resolution as f64)
    }

    /// Where a wide cell ends that begins at a node, m.
    fn next_far(&self, node: usize) -> f64 {
        let (end, before) = (self.x[node], self.x[node - 1]);
        let even = end / self.resolution as f64;
        end + (WIDER * (end - before)).clamp(WIDTHS.0 * even, WIDTHS.1 * even)
    }

    /// Appends a node where nothing has worn.
    fn append(&mut self, x: f64) {
        self.x.push(x);
        self.worn_image.push(0.0);
        self.depth.push(0.0);
        self.integrals.push(Integrals::UNKNOWN);
        if self.worn_image.iter().any(|h| *h != 0.0) {
            let last = self.last();
            self.worn_image[last] = transform::abel_last(&self.x, &self.worn_image, 0.0);
        }
    }

    /// Halves the cells between two radii until none is wider than `widest`, and those beyond until
    /// none is wider than that and a share of its distance; then grades them.
    fn refine_between(&mut self, start: f64, end: f64, widest: f64, profile: &Profile) {
        let mut j = self.cell(start).unwrap_or(self.last());
        while j < self.last() {
            if self.x[j + 1] - self.x[j] > widest.max(GAP * (self.x[j] - end)) {
                self.halve(j, profile);
            } else {
                j += 1;
            }
        }
        self.grade((start, end), profile);
    }

    /// Splits cells between two radii until none is far wider than one next to it. Those that are
    /// finer than a creeping front needs count as that wide.
    fn grade(&mut self, (start, end): (f64, f64), profile: &Profile) {
        let least = FrontMotion::Creeps.fine() * end / self.resolution as f64;
        let mut j = self.cell(start).unwrap_or(self.last());
        while j < self.last() && self.x[j] < end {
            let width = |j: usize| self.x[j + 1] - self.x[j];
            let inner = if j > 0 { width(j - 1) } else { f64::INFINITY };
            let outer = if j + 1 < self.last() { width(j + 1) } else { f64::INFINITY };
            let graded = GRADING * inner.min(outer).max(least);
            // no sliver is left over
            if width(j) > 1.5 * graded {
                let x = if inner < outer { self.x[j] + graded } else { self.x[j + 1] - graded };
                self.insert_in(j, (x, self.line(&self.depth, x)), profile);
                j = j.saturating_sub(1);
            } else {
                j += 1;
            }
        }
    }

    /// Whether the cell at a front, or outside it, is wider than will do.
    fn is_coarse_at(&self, front: f64, way: FrontMotion, a: f64) -> bool {
        let Some(j) = self.cell(front) else { return false };
        front > 0.0 && self.x[j + 1] - self.x[j] > way.fine() * a / self.resolution as f64
    }

    /// Puts a node at `front` and a fan of nodes outside it whose distances fall by four at each
    /// level from a cell's.
    fn refine_at(&mut self, front: f64, levels: usize, profile: &Profile) {
        let Some(j) = self.cell(front) else { return };
        let width = self.x[j + 1] - front;
        if front <= 0.0 || width <= 0.0 {
            return;
        }
        self.insert(front, profile);
        shrinking(width).take(levels).for_each(|gap| self.insert(front + gap, profile));
    }

    /// Puts nodes around a kink of the body between two radii, at distances that fall by four from
    /// an even cell on: there wear is as deep as its cells are fine, until it has rounded the kink.
    /// With even cells the wear depth of cones came out up to 57 % too small in early life.
    fn refine_at_kink(&mut self, profile: &Profile, (start, end): (f64, f64)) {
        let Some(kink) = profile.kink().filter(|kink| (start..end).contains(kink)) else { return };
        // wear of w rounds the kink over some a w/d
        let rounded = self.depth_at(kink) / profile.image(end);
        let least = end * (OF_ROUNDED * rounded).max(LEAST_CELL);
        let even = end / self.resolution as f64;
        let gaps: Vec<f64> = shrinking(even).take_while(|gap| *gap > least).collect();
        // where wear has levelled the body there is no kink left
        let is_coarse =
            |j: usize| j >= self.levelled && gaps.last().is_some_and(|gap| self.x[j + 1] - kink > 2.0 * gap);
        if self.cell(kink).is_some_and(is_coarse) {
            self.insert(kink, profile);
            for gap in gaps {
                self.insert((kink - gap).max(0.0), profile);
                self.insert(kink + gap, profile);
            }
        }
    }

    /// Inserts a node where the image of the whole profile keeps its value.
    fn insert(&mut self, x: f64, profile: &Profile) {
        let Some(j) = self.cell(x) else { return };
        if x <= self.x[j] {
            return;
        }
        let depth = if self.depth.iter().all(|w| *w == 0.0) { 0.0 } else { self.depth_at(x) };
        self.insert_in(j, (x, depth), profile);
    }

    /// Halves a cell. Its depth stays a line: what its image alone would make of it is other than
    /// what updates have put there, and volume would be lost.
    fn halve(&mut self, j: usize, profile: &Profile) {
        let x = 0.5 * (self.x[j] + self.x[j + 1]);
        self.insert_in(j, (x, self.line(&self.depth, x)), profile);
    }

    /// Inserts a node with a depth, m, in a cell.
    fn insert_in(&mut self, j: usize, (x, depth): (f64, f64), profile: &Profile) {
        self.leave_mesh();
        let h = self.worn_image_at(profile, x);
        self.x.insert(j + 1, x);
        self.worn_image.insert(j + 1, h);
        self.depth.insert(j + 1, depth);
        // keeps the image usable for the next insertion; update_integrals follows
        self.integrals.insert(j + 1, Integrals::UNKNOWN);
        self.levelled += usize::from(j < self.levelled);
    }
}
