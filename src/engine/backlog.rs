//! Slip gathered in the backlog, and worn off where the profile has to follow.

use super::FrettingContact;
use crate::error::Error;
use crate::friction::Springs;
use crate::surface::{Contact, FrontWay, Nodes, Surface};
use crate::wear::{self, NodeTransforms, Operator, RepeatedMotion, Sliding, SlipAtDepth, SlipPiece, WearBacklog};
use std::sync::Arc;

/// How much more than the limit between two updates may wear where an update can wait for the next reversal: at constant load,
/// whose strokes make one law however many they are.
pub(super) const STROKE: f64 = 20.0;

/// The same where no motion repeats.
pub(super) const SINGLE_STROKE: f64 = 5.0;

/// Largest share of new work by which reported work may stay behind, where the profile has worn less than the springs' work said.
const MOST_TAKEN: f64 = 0.5;

/// Most of the wear at hand by which it is scaled to make the volume of the profile that of the work.
const MOST_RESIDUAL: f64 = 0.25;

/// How near two amplitudes are that are taken for one, relative.
const SAME_AMPLITUDE: f64 = 1e-3;

impl FrettingContact {
    /// Adds the slip of a line to another contact and displacement to the backlog.
    pub(super) fn gather(&mut self, work: f64, to: &Contact, direction: f64) {
        let (modulus, bound_slope, tip) =
            (2.0 * self.constants.tangential_modulus, self.bound_slope, self.surface.tip());
        let from = self.contact;
        let Some(wear) = &mut self.wear else { return };
        if work > 0.0 && !wear.slips.is_empty() {
            wear.backlog.record(&wear.slips, work / (modulus * bound_slope), (&from, to), tip);
            wear.backlog.add_work(work, direction);
        }
        wear.slips.clear();
    }

    /// Counts friction work (J). What the profile has worn less than the springs' work said is taken off first.
    pub(super) fn count_work(&mut self, work: f64) {
        let taken = match &mut self.wear {
            Some(wear) if wear.excess > 0.0 => {
                let taken = wear.excess.min(MOST_TAKEN * work);
                wear.excess -= taken;
                taken
            }
            _ => 0.0,
        };
        self.work += work - taken;
    }

    /// Whether the profile has to follow before the body turns to a direction.
    pub(super) fn turns_to_update(&self, direction: f64) -> bool {
        let Some(wear) = &self.wear else { return false };
        direction != 0.0
            && direction != self.direction
            && self.constants.wear_per_work * wear.backlog.work > wear.limit
    }

    /// Whether the profile has to follow at the end of a line in a contact that does more work (J), amid a stroke as well.
    pub(super) fn needs_update(&self, to: &Contact, work: f64, stick_radius: f64) -> bool {
        let Some(wear) = &self.wear else { return false };
        let volume = self.constants.wear_per_work * (wear.backlog.work + work);
        if wear.limit == 0.0 || volume <= wear.limit {
            return false;
        }
        // at constant load an update can wait for the reversal, which leaves strokes whole
        volume > self.stroke_limit() * wear.limit || !wear.backlog.is_at(to.depth) || stick_radius == 0.0
    }

    /// How much more than the limit may wear before an update that waits for a reversal.
    pub(super) fn stroke_limit(&self) -> f64 {
        match self.wear.as_ref().and_then(|wear| wear.expected) {
            Some(Sliding::Cycles(_)) => STROKE,
            _ if self.surface.worn().is_none() => STROKE,
            _ => SINGLE_STROKE,
        }
    }

    /// Work (J) that a slide may do before an update may be due.
    pub(super) fn work_to_update(&self) -> f64 {
        self.wear.as_ref().map_or(f64::MAX, |wear| wear.limit / self.constants.wear_per_work - wear.backlog.work)
    }

    /// Finds how much may wear before the profile follows, where that is not known yet.
    pub(super) fn set_limit(&mut self) {
        if self.wear.as_ref().is_some_and(|wear| wear.limit == 0.0) {
            let limit = self.update_limit();
            if let Some(wear) = &mut self.wear {
                wear.limit = limit;
            }
        }
    }

    /// Volume that may wear before the profile follows, m³.
    pub(super) fn update_limit(&self) -> f64 {
        let inner = self.stick_radius().min(0.9 * self.contact.radius);
        wear::update_limit(self.parameters.tolerance, &self.surface, &self.contact, inner)
    }

    /// [`Self::absorb_backlog`] where the history is read or ends here: amid a stroke of cycles seen before, what has worn is a part of
    /// them, as it will be at the reversal.
    pub(super) fn close_backlog(&mut self) -> Result<(), Error> {
        self.absorb(true)
    }

    /// Wears the backlog off and lets the contact settle at the present load and displacement.
    ///
    /// # Errors
    /// [`Error::WearOutrun`] where the integrator cannot follow; those of the normal contact.
    pub(super) fn absorb_backlog(&mut self) -> Result<(), Error> {
        self.absorb(false)
    }

    fn absorb(&mut self, ends: bool) -> Result<(), Error> {
        let Some(wear) = &mut self.wear else { return Ok(()) };
        if wear.backlog.is_empty() {
            return Ok(());
        }
        let backlog = std::mem::take(&mut wear.backlog);
        let law = backlog.law();
        let old = self.surface.clone();
        let zone = self.springs.slip_zone(&self.contact, self.bound_slope, self.displacement);
        let stick = zone.0;
        let whole = self.repeated_motion(&law).filter(|motion| self.is_followed(motion));
        if let Some(motion) = whole.or_else(|| if ends { self.part_of_cycles(&backlog) } else { None }) {
            let drive = match motion.sliding {
                Sliding::Cycles(own) => self.drive_amplitude(own),
                Sliding::Onward => 0.0,
            };
            match self.wear_by(self.contact.control, (motion.sliding, None), motion.amount, Some(backlog.work)) {
                Ok(_) => {
                    self.rest_on_worn(&old, zone, None)?;
                    if let (Sliding::Cycles(amplitude), true) = (motion.sliding, whole.is_some()) {
                        let own = self.own_amplitude(drive);
                        self.displacement += self.direction * (own - amplitude);
                        self.rest_at_reversal(own, stick);
                    }
                    self.expect(Some(motion));
                    self.balance_work();
                    return Ok(());
                }
                Err(Error::TooMuchWear { .. } | Error::NotFinite { .. }) => {}
                Err(other) => return Err(other),
            }
        }
        let repeated = self.repeated_motion(&law);
        self.absorb_law(&law, backlog.work, backlog.radius)?;
        self.rest_on_worn(&old, zone, backlog.start.as_ref())?;
        self.expect(repeated);
        self.balance_work();
        Ok(())
    }

    /// The motion that the whole backlog is, where it is one that repeats at the present load.
    fn repeated_motion(&self, law: &[SlipAtDepth]) -> Option<RepeatedMotion> {
        let [law] = law else { return None };
        let here = (law.depth - self.contact.depth).abs() <= 1e-9 * self.contact.depth.abs();
        if !here || self.contact.is_open() || self.planar.is_some() {
            return None;
        }
        law.repeated_motion(self.bound_slope, self.surface.tip())
    }

    /// Whether a motion is worth a moving mesh: on the unworn body, or where it has been seen before. A single stroke from anywhere to
    /// anywhere looks like half a cycle.
    fn is_followed(&self, motion: &RepeatedMotion) -> bool {
        let Some(nodes) = self.surface.worn() else { return true };
        match (motion.sliding, self.wear.as_ref().and_then(|wear| wear.expected)) {
            (Sliding::Onward, _) => nodes.mesh().is_some(),
            (Sliding::Cycles(a), Some(Sliding::Cycles(b))) => (a - b).abs() <= SAME_AMPLITUDE * b,
            _ => false,
        }
    }

    /// Amid a stroke of cycles that have been seen before: as much of them as its work is.
    fn part_of_cycles(&mut self, backlog: &WearBacklog) -> Option<RepeatedMotion> {
        let Some(Sliding::Cycles(amplitude)) = self.wear.as_ref()?.expected else { return None };
        if self.planar.is_some() || self.contact.is_open() || !backlog.is_at(self.contact.depth) {
            return None;
        }
        let contact = self.contact;
        let (springs, quarter) = self.quarter(&contact, amplitude);
        let front = springs.stick_radius(&contact, self.bound_slope, amplitude);
        let here = self.stick_radius();
        let amount = backlog.work / (4.0 * quarter);
        (amount.is_finite() && here >= front * (1.0 - SAME_AMPLITUDE))
            .then_some(RepeatedMotion { sliding: Sliding::Cycles(amplitude), amount })
    }

    fn expect(&mut self, motion: Option<RepeatedMotion>) {
        if let Some(wear) = &mut self.wear {
            wear.expected = motion.map(|motion| motion.sliding);
        }
    }

    /// Wears a slip law off on nodes at rest, which is that of friction work (J) of the springs. `radius` is the largest of its contacts.
    pub(super) fn absorb_law(&mut self, law: &[SlipAtDepth], work: f64, radius: f64) -> Result<(), Error> {
        let mut nodes = self.nodes_at_rest(law, radius);
        let (constants, tolerance) = (self.constants, self.parameters.tolerance);
        let Some(wear) = &mut self.wear else { return Ok(()) };
        let operator = match &wear.operator {
            Some((x, operator)) if *x == nodes.x() => operator.clone(),
            _ => {
                let operator = Arc::new(Operator::new(nodes.x()));
                wear.operator = Some((nodes.x().to_vec(), operator.clone()));
                self.counters.transform_tables += 1;
                operator
            }
        };
        let profile = self.surface.profile();
        let volume = constants.wear_per_work * work;
        // what laying nodes has changed, the wear at hand makes good, but for no more than a part of itself
        let residual = (wear.volume - nodes.worn_volume()).clamp(-MOST_RESIDUAL * volume, MOST_RESIDUAL * volume);
        let share = volume / (volume + residual);
        let volume = volume + residual;
        let at = (self.contact.control, self.displacement);
        let absorbed =
            wear::absorb((&nodes, profile), &operator, law, volume, (&constants, tolerance), &mut self.counters)
                .map_err(|error| match error {
                    Error::WearOutrun { .. } => Error::WearOutrun { from: at.1, displacement: at.1 },
                    Error::NotFinite { what, .. } => Error::NotFinite { what, normal: at.0, displacement: at.1 },
                    other => other,
                })?;
        wear.volume += share * absorbed.volume;
        wear.defect += (absorbed.volume - volume).abs() / constants.wear_per_work;
        wear.clipped += absorbed.clipped / constants.wear_per_work;
        if !(absorbed.volume.is_finite() && nodes.volume(&absorbed.worn.1).is_finite()) {
            return Err(Error::NotFinite { what: "the worn depth", normal: at.0, displacement: at.1 });
        }
        nodes.set_worn(absorbed.worn.0, absorbed.worn.1, profile);
        self.surface.set_worn(Some(nodes));
        Ok(())
    }

    /// Nodes at rest for a slip law whose largest contact has a radius (m): fine at its innermost front.
    fn nodes_at_rest(&self, law: &[SlipAtDepth], radius: f64) -> Nodes {
        let profile = self.surface.profile();
        let front = law.iter().map(SlipAtDepth::front).fold(f64::INFINITY, f64::min);
        let inner = if front <= self.surface.tip() {
            0.0
        } else if front < self.surface.image(radius) {
            self.surface.radius_of_image(front, 0.0, radius)
        } else {
            radius
        };
        let Some(nodes) = self.surface.worn() else {
            return Nodes::around(profile, self.parameters.resolution, radius.max(self.reach), inner);
        };
        let mut left = match nodes.mesh() {
            None => nodes.clone(),
            Some(_) => nodes.without_mesh(NodeTransforms::new(nodes.x()).descend(nodes.worn_image())),
        };
        if let Some(few) = left.few(profile) {
            left = few;
        }
        let deepest = law.iter().map(|law| law.depth).fold(0.0, f64::max);
        if let Some(spread) = left.spread_at_rim(deepest, profile) {
            left = spread;
        }
        if let Some(thinned) = left.thinned(wear::THINNING * self.parameters.tolerance, radius, profile) {
            left = thinned;
        }
        let way = if self.planar.is_some() { FrontWay::Creeps } else { FrontWay::Returns };
        left.adapt(profile, radius, (inner, way));
        left
    }

    /// Contact and springs on a surface that has worn at the present load and displacement, where the springs of a zone (its inner
    /// radius and side) slipped. Springs keep their place. `start` are those at the start of the backlog, if the body has not turned
    /// since.
    fn rest_on_worn(
        &mut self,
        old: &Surface,
        zone: (f64, f64),
        start: Option<&Springs>,
    ) -> Result<(), Error> {
        let to = self.contact_at(self.contact.control)?;
        if self.planar.is_some() {
            self.rest_in_plane(to);
            return Ok(());
        }
        let moved = self.springs.moved_to(old, &self.surface);
        let path = self.path_to(to, self.displacement);
        let (mut springs, _) = moved.walk(&path, Springs::default(), None);
        if zone.1 != 0.0 && !to.is_open() {
            springs.follow_bound(zone, &to, self.bound_slope, self.displacement);
        }
        let unknown = start.map(|start| self.unknown_slip(old, (start, &springs), &to)).unwrap_or_default();
        springs.simplify(&to, self.bound_slope);
        (self.springs, self.contact) = (springs, to);
        self.reach = self.reach.max(to.radius);
        let (direction, row) = (self.direction, self.springs.clone());
        let Some(wear) = &mut self.wear else { return Ok(()) };
        (wear.backlog.start, wear.backlog.direction) = (Some(row), direction);
        let overlap: f64 = unknown.iter().map(|piece| piece.overlap_moment(to.depth)).sum();
        let work = 2.0 * self.constants.tangential_modulus * self.bound_slope * overlap;
        if work > 0.0 {
            wear.slips = unknown;
            self.gather(work, &to, direction);
            self.count_work(work);
        }
        Ok(())
    }

    /// Slip that the law of a backlog does not know, where the body went one way: that of springs which follow their bound as it falls.
    /// The law takes each spring for one that has had its overlap d − g from the start. In truth it went from where it was at the
    /// `start` to where it is now. Between full strokes the two are the same.
    fn unknown_slip(&self, old: &Surface, (start, now): (&Springs, &Springs), to: &Contact) -> Vec<SlipPiece> {
        let Some(nodes) = self.surface.worn() else { return Vec::new() };
        let edge = |row: &Springs| row.knots().last().map_or(0.0, |knot| knot.place.x);
        let most = edge(start).min(edge(now)).min(edge(&self.springs));
        let radii = &nodes.x()[..nodes.x().partition_point(|x| *x < most)];
        let rise = to.depth - self.contact.depth;
        let (before, end) = (start.origins_at(old, radii), self.springs.origins_at(old, radii));
        let after = now.origins_at(&self.surface, radii);
        let mut points: Vec<(f64, f64, f64)> = Vec::with_capacity(radii.len());
        for (i, &x) in radii.iter().enumerate() {
            let moved = end[i] - before[i];
            let image = self.surface.image(x);
            let unknown = if moved == 0.0 {
                0.0
            } else {
                let relabelled = self.springs.origin_of_image(image - rise) - start.origin_of_image(image - rise);
                moved.signum() * (after[i] - before[i] - 0.5 * (moved + relabelled))
            };
            points.push((x, image, unknown));
        }
        let slips = |pair: &&[(f64, f64, f64)]| pair[0].2 != 0.0 || pair[1].2 != 0.0;
        points.windows(2).filter(slips).map(|pair| SlipPiece::between(pair[0], pair[1])).collect()
    }

    /// The reported work where the profile has followed: what it has worn, over k/σ₀. It never falls; what it should is kept as excess.
    pub(super) fn balance_work(&mut self) {
        let limit = self.update_limit();
        let per_work = self.constants.wear_per_work;
        let Some(wear) = &mut self.wear else { return };
        let exact = self.former.work + (wear.volume - self.former.volume) / per_work + wear.backlog.work;
        let reported = exact.max(self.work_before);
        wear.excess = reported - exact;
        wear.limit = limit;
        self.work = reported;
    }
}
