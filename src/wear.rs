//! Wear by the Reye–Archard–Khrushchov law (paper, eq. (18)): dw = (k/σ₀) τ ds at each radius.
//!
//! Where the motion is steady at constant load, cycles or sliding onward, it wears by a law of time, which [`live`] integrates on a
//! mesh of its own. For any other history the profile stays frozen for a while and only two fields per node are gathered, one monotone
//! stretch of the history (a *segment*) at a time: the dissipated work per area A = ∫ τ ds and the slip path B = ∫ |ds|.
//! Within a segment slip goes one way, so s telescopes and one pair of transforms serves however many steps it had.
//!
//! Then the profile is brought up to date, linearly implicitly: pressure falls where material goes, so with the
//! pressure of the *new* profile, p + ∂p/∂h Δh, the worn depth Δw = descent(Δh) obeys
//!
//! (S + κ E* B P) Δh = (k/σ₀) A, κ = kμ/σ₀,
//!
//! with S the descent transform, P = −∂p/∂(E* h) the pressure transform. An explicit update would have to remove less
//! than about (4/π)(p/E*) Δr at a time, which the fine cells at a stick front make hopeless. S is lower triangular:
//! nodes that have not slipped get Δh = 0 exactly, whatever happens outside.
//!
//! `backlog` and `absorb` are the wear core that is to replace all of this. The engine does not use it yet: see
//! docs/decisions/wear_backlog.md.

#[cfg(test)]
mod absorb;
#[cfg(test)]
mod backlog;
mod krylov;
mod laying;
mod life;
mod mesh;
mod node_transforms;
mod patch;
mod planar;
mod rosenbrock;
mod system;
mod update;

pub(crate) use life::{Amount, Fineness, THINNING, live};
pub(crate) use mesh::{Region, UnitMesh, depth_volume};
pub(crate) use node_transforms::{NodeTransforms, TransformCache};
pub(crate) use patch::{Motion, Rig, Sliding};
pub(crate) use update::{Edge, pressure_nodes, worn_depth};

use crate::friction::Springs;
use crate::surface::{Contact, Nodes, Surface};
use std::f64::consts::PI;

/// Largest share of work at hand of which the wear without a place may go along with it.
pub(crate) const PLACED_WITH: f64 = 0.25;

/// Constants that the update needs.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Constants {
    /// E*, Pa.
    pub(crate) normal_modulus: f64,
    /// G*, Pa.
    pub(crate) tangential_modulus: f64,
    /// μ.
    pub(crate) friction_coefficient: f64,
    /// k/σ₀, m³/J.
    pub(crate) wear_per_work: f64,
    /// Whether the load, not the depth, is held while the profile changes.
    pub(crate) force_control: bool,
}

impl Constants {
    /// m = μE*/G*, slope of the friction bound.
    pub(crate) fn bound_slope(&self) -> f64 {
        self.friction_coefficient * self.normal_modulus / self.tangential_modulus
    }
}

/// Steady motion that has passed on the present surface at the present load.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub(crate) struct Steady {
    pub(crate) sliding: Sliding,
    /// Cycles or metres, as its kind has it.
    pub(crate) amount: f64,
    /// Its work, J.
    pub(crate) work: f64,
    /// Whether it has been seen twice. A single stroke from anywhere to anywhere looks like half a cycle.
    pub(crate) repeated: bool,
}

/// What slip has done to the surface since the profile was last updated.
#[derive(Debug, Clone, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub(crate) struct Pending {
    /// Work of friction per area at each node, J/m².
    pub(crate) work_per_area: Vec<f64>,
    /// Length of the slip path at each node, m.
    pub(crate) slip_path: Vec<f64>,
    /// Work of friction of the same history, from the springs, J.
    pub(crate) work: f64,
    /// Work whose wear has found no place on the profile yet, J; below 0 where the profile has worn by more.
    pub(crate) unplaced: f64,
    /// Work per area whose sign would have healed the surface, integrated, J.
    pub(crate) clipped: f64,
    /// Instead of all these: steady motion at the present load.
    pub(crate) steady: Option<Steady>,
    /// The largest contact that has slipped: the one whose pressure the wear relieves.
    pub(crate) contact: Option<Contact>,
}

impl Pending {
    pub(crate) fn is_empty(&self) -> bool {
        self.work == 0.0 && self.steady.is_none()
    }

    /// Adds one stretch of slip in a contact: traction at the nodes inside and slip at all. The work per area takes the
    /// volume of `work`, which the springs know better, but is scaled by `most_share` at the most: where much was
    /// clipped, the little that is left must not take all of the work. Returns the work by which the two differed, J.
    pub(crate) fn add(
        &mut self,
        nodes: &Nodes,
        contact: &Contact,
        (traction, slip): (&[f64], &[f64]),
        work: f64,
        most_share: f64,
    ) -> f64 {
        let product: Vec<f64> =
            (0..slip.len()).map(|i| traction.get(i).map_or(0.0, |traction| traction * slip[i])).collect();
        let one_way = slip.iter().all(|s| *s >= 0.0) || slip.iter().all(|s| *s <= 0.0);
        let path: Vec<f64> = slip.iter().map(|s| s.abs()).collect();
        self.add_product(nodes, contact, (&product, &path, one_way), (work, most_share))
    }

    /// [`Self::add`] with the product of traction and slip, the length of the slip, and whether all slips one way.
    fn add_product(
        &mut self,
        nodes: &Nodes,
        contact: &Contact,
        (product, path, one_way): (&[f64], &[f64], bool),
        (work, most_share): (f64, f64),
    ) -> f64 {
        if self.contact.is_none_or(|largest| largest.radius < contact.radius) {
            self.contact = Some(*contact);
        }
        let count = nodes.x().len();
        for field in [&mut self.work_per_area, &mut self.slip_path] {
            field.resize(count, 0.0);
        }
        // where all slips one way, a negative product is a pressure that overshoots: the update needs to know by how much, or
        // it would drive it on; the depth that it gives is clipped in the end
        let healing: Vec<f64> = product.iter().map(|p| if one_way { 0.0 } else { (-p).max(0.0) }).collect();
        self.clipped += nodes.volume(&healing);
        let gain: Vec<f64> = product.iter().zip(&healing).map(|(p, h)| p + h).collect();
        let found = nodes.integral_to_edge(&gain, contact.radius);
        let placed = work + self.take_unplaced(work);
        let share = if found > 0.0 { (placed / found).clamp(1.0 / most_share, most_share) } else { 0.0 };
        for i in 0..count {
            let gain = share * gain[i];
            self.work_per_area[i] += gain;
            self.slip_path[i] += path[i];
        }
        self.work += placed;
        (found - work).abs()
    }

    /// Adds work whose slip was a jump where in truth it was gradual: it is spread like what is pending.
    pub(crate) fn add_work(&mut self, work: f64) {
        if let Some(steady) = &mut self.steady {
            steady.work += work;
        } else if self.work > 0.0 {
            let clipped = self.clipped;
            *self = self.scaled(1.0 + work / self.work);
            self.clipped = clipped;
        } else {
            self.unplaced += work;
        }
    }

    /// As much of the work without a place as may go along with some more of it: much of it at one place would dig a groove there.
    pub(crate) fn take_unplaced(&mut self, work: f64) -> f64 {
        let most = PLACED_WITH * work.abs();
        let taken = self.unplaced.max(-most).min(most);
        self.unplaced -= taken;
        taken
    }

    /// Work whose wear a change of the nodes has lost, or below 0 found: depths are told at the nodes, and their volume from there.
    pub(crate) fn owe(&mut self, work: f64) {
        let present = self.work + self.steady.map_or(0.0, |steady| steady.work);
        if work.abs() <= PLACED_WITH * present {
            self.add_work(work);
        } else if work.is_finite() {
            self.unplaced += work;
        }
    }

    /// The same distribution on nodes that include those of before. An added node takes the smaller value of its
    /// neighbours, so that nothing enters a sticking region.
    pub(crate) fn moved_to(&mut self, old: &[f64], new: &[f64]) {
        for field in [&mut self.work_per_area, &mut self.slip_path] {
            let at = |i: usize| field.get(i).copied().unwrap_or(0.0);
            *field = new
                .iter()
                .map(|x| {
                    let above = old.partition_point(|node| node < x);
                    if old.get(above) == Some(x) { at(above) } else { at(above).min(at(above.max(1) - 1)) }
                })
                .collect();
        }
    }

    /// The same distribution with its work times `factor`.
    pub(crate) fn scaled(&self, factor: f64) -> Self {
        Self {
            work_per_area: self.work_per_area.iter().map(|a| a * factor).collect(),
            slip_path: self.slip_path.iter().map(|s| s * factor).collect(),
            work: self.work * factor,
            ..self.clone()
        }
    }
}

/// Start of a segment: the spring row without the slip that happens in it.
#[derive(Debug, Clone, Default)]
pub(crate) struct Segment {
    /// Row at the start, extended by the springs that touched since.
    pub(crate) unslipped: Springs,
    /// Contact at the start.
    pub(crate) contact: Option<Contact>,
    /// Displacement at the start, m.
    pub(crate) start: f64,
    /// Direction in which all springs slipped at the start, 0 if some stuck.
    pub(crate) sliding: f64,
    /// Work of friction in the segment, J.
    pub(crate) work: f64,
}

/// Mean traction of the springs over a segment (as spring deflection, m) and their slip (m), at all nodes. Springs out
/// of contact move with the body: there the slip is that of the free surfaces.
pub(crate) fn segment_fields(
    surface: &Surface,
    nodes: &Nodes,
    segment: &Segment,
    (springs, contact, displacement): (&Springs, &Contact, f64),
    constants: &Constants,
) -> (Vec<f64>, Vec<f64>) {
    let radii = nodes.x();
    let count = radii.len();
    let before = segment.unslipped.origins_at(surface, radii);
    let after = springs.origins_at(surface, radii);
    let start = segment.contact.unwrap_or(*contact);
    let bound_slope = constants.bound_slope();
    let rounding = 16.0 * f64::EPSILON * (displacement.abs() + bound_slope * contact.depth.abs());
    let mut deflection = Vec::with_capacity(count);
    let mut slip = Vec::with_capacity(count);
    for (i, &x) in radii.iter().enumerate() {
        let moved = after[i] - before[i];
        if moved.abs() <= rounding {
            slip.push(0.0);
            deflection.push(if x < contact.radius { displacement - after[i] } else { 0.0 });
        } else {
            let image = surface.image(x);
            let bound =
                |c: &Contact| if c.is_open() { 0.0 } else { bound_slope * (c.depth - image).max(0.0) };
            slip.push(moved);
            deflection.push(moved.signum() * 0.5 * (bound(&start) + bound(contact)));
        }
    }
    (deflection, slip)
}

/// Largest worn volume between two profile updates, m³: a share of what the slipping annulus still has to lose. The
/// scale is at least a tenth of the depth, as the contact nears its final state.
pub(crate) fn update_limit(tolerance: f64, surface: &Surface, contact: &Contact, stick_radius: f64) -> f64 {
    let room = room(surface, contact, stick_radius);
    tolerance * annulus(contact, stick_radius) * room.max(0.1 * contact.depth.abs())
}

/// Ratio of a worn volume (m³) to a share of what the slipping annulus has to lose, however little that is, down to a part of
/// `tolerance` of the depth.
pub(crate) fn share_of_room(
    volume: f64,
    (share, tolerance): (f64, f64),
    surface: &Surface,
    contact: &Contact,
    stick_radius: f64,
) -> f64 {
    let least = tolerance * contact.depth.abs();
    volume / (share * annulus(contact, stick_radius) * room(surface, contact, stick_radius).max(least))
}

/// Twice the mean approach d − g of the slipping annulus, m; 0 where there is none.
fn room(surface: &Surface, contact: &Contact, stick_radius: f64) -> f64 {
    let width = (contact.radius - stick_radius).max(0.0);
    if width == 0.0 {
        return 0.0;
    }
    let inner = surface.place(stick_radius);
    2.0 * (contact.load - inner.load - stick_radius * (contact.depth - inner.image)) / width
}

/// Ratio of a worn volume to [`update_limit`] where it exceeds that.
pub(crate) fn exceeds_limit(
    volume: f64,
    tolerance: f64,
    surface: &Surface,
    contact: &Contact,
    stick_radius: f64,
) -> Option<f64> {
    // most steps wear far less than the least value of the limit, which costs nothing to compute
    if volume <= 0.1 * tolerance * annulus(contact, stick_radius) * contact.depth.abs() {
        return None;
    }
    let limit = update_limit(tolerance, surface, contact, stick_radius);
    // of a contact so small that the limit is lost to underflow, any wear is infinitely much
    let slips = stick_radius < contact.radius && contact.depth > 0.0;
    (volume > limit && (limit > 0.0 || slips)).then(|| volume / limit)
}

/// Area of the slipping annulus, m².
pub(crate) fn annulus(contact: &Contact, stick_radius: f64) -> f64 {
    PI * (contact.radius - stick_radius).max(0.0) * (contact.radius + stick_radius)
}

#[cfg(test)]
mod tests;
