//! Slip gathered in the backlog, and worn off where the profile has to follow.

use super::FrettingContact;
use crate::error::Error;
use crate::friction::{Resting, Row, SlipPiece};
use crate::parameters::{Parameters, USUAL_TOLERANCE};
use crate::surface::{Contact, FrontMotion, Nodes, ROUNDING, Surface};
use crate::wear::{self, Part, RepeatedMotion, SAME, Sliding, SlipAtDepth, SlipFields, Update};
use nalgebra::Vector2;
use std::f64::consts::PI;
use std::mem::{replace, take};

/// Most by which the depth of an update is scaled up to the volume that its work wears.
pub(super) const MOST_SCALE: f64 = 1.5;

/// Largest depth under which a law slips, m.
fn deepest_of(law: &[SlipAtDepth]) -> f64 {
    law.iter().map(|law| law.depth).fold(0.0, f64::max)
}

impl FrettingContact {
    /// Memory for the slip of a line, where it is wanted for wear.
    pub(super) fn take_slips(&mut self) -> Option<Vec<SlipPiece>> {
        self.state.wear.as_ref()?;
        let mut slips = take(&mut self.memory.get().slips);
        slips.clear();
        Some(slips)
    }

    /// Keeps the slip of a line, to be gathered if the line is taken.
    pub(super) fn keep_slips(&mut self, slips: Option<Vec<SlipPiece>>) {
        if let Some(slips) = slips {
            self.memory.get().slips = slips;
        }
    }

    /// Adds the slip of a line to another contact to the backlog. The body has moved by some way,
    /// m.
    pub(super) fn gather(&mut self, work: f64, to: &Contact, moved: Vector2<f64>) {
        let direction = moved.try_normalize(0.0).unwrap_or_default();
        let (modulus, bound_slope, tip) =
            (2.0 * self.model.constants.tangential_modulus, self.model.bound_slope, self.surface.tip());
        let (from, in_plane) = (self.state.contact, self.state.row.is_plane());
        let Some(wear) = &mut self.state.wear else { return };
        if work > 0.0 && direction != Vector2::zeros() {
            if wear.backlog.is_empty() {
                wear.begins_at_reversal = wear.slip_direction.dot(&direction) < 0.0;
            }
            wear.slip_direction = direction;
        }
        if work > 0.0 {
            let pieces = &self.memory.get().slips;
            let overlap_moment = work / (modulus * bound_slope);
            wear.backlog.record(pieces, (work, overlap_moment), (&from, to), (tip, in_plane));
        }
        self.memory.get().slips.clear();
    }

    /// Whether the profile has to follow before the body goes on to a place and does some more
    /// work, J. That is asked before a motion, not after it: so T at the end of a step does not
    /// jump where a master tries another end.
    pub(super) fn update_is_due(&self, place: Vector2<f64>, work: f64) -> bool {
        let Some(wear) = &self.state.wear else { return false };
        let density = wear.backlog.work_density + wear::per_disc(work, &self.state.contact);
        let share = self.model.constants.wear_per_work * density;
        if wear.limit == 0.0 {
            return false;
        }
        if share <= wear.limit {
            return self.turns(place) && self.exceeds_limit_of_zone(share) || self.exceeds_limit_now(share);
        }
        // while the load hardly changes an update can wait for the reversal, which leaves strokes
        // whole
        let depth = self.state.contact.depth;
        let near = self.model.tuning.load_share * (depth - self.surface.tip());
        // a whole stroke waits at a tight tolerance, too: parts of it may be worn on nodes at rest
        let is_stroke = wear.begins_at_reversal && wear.backlog.is_at(depth);
        let looser = (USUAL_TOLERANCE / self.model.parameters.tolerance).max(1.0);
        let stroke = self.model.tuning.stroke * if is_stroke { looser } else { 1.0 };
        self.turns(place)
            || self.state.row.is_plane()
            || share > stroke * wear.limit
            || !wear.backlog.is_near(depth, near)
            || self.stick_radius() == 0.0
    }

    /// Whether some wear, over the disc, exceeds the limit of motion in the plane as it is now. An
    /// orbit that begins in gross slip goes on in a ring that never wears as much as all can.
    fn exceeds_limit_now(&self, share: f64) -> bool {
        self.state.row.is_plane() && share > wear::per_disc(self.update_limit(), &self.state.contact)
    }

    /// Whether some wear, over the disc, is much of what can wear where the strokes of the backlog
    /// have slipped: `limit` knows no thinner zone than `least_width`.
    fn exceeds_limit_of_zone(&self, share: f64) -> bool {
        let (Some(wear), contact) = (&self.state.wear, &self.state.contact) else { return false };
        let front = wear.backlog.front();
        if front <= self.surface.image(self.widest_stick(contact, 0.0)) {
            return false;
        }
        let inner = self.radius_of_front(front, contact.radius);
        if inner >= contact.radius * (1.0 - wear::THINNEST) {
            return false;
        }
        let limit = wear::limit_of_zone(self.model.parameters.tolerance, &self.surface, contact, inner);
        share > wear::per_disc(limit, contact)
    }

    /// Work (J) that a slide may do before an update may be due.
    pub(super) fn work_to_update(&self) -> f64 {
        self.state.wear.as_ref().map_or(f64::MAX, |wear| {
            let left = wear.limit / self.model.constants.wear_per_work - wear.backlog.work_density;
            left * wear::disc(&self.state.contact)
        })
    }

    /// Work (J) that may wait for the next update, from one to the next.
    pub(super) fn work_per_update(&self) -> f64 {
        let wears = self.state.wear.is_some();
        if wears { self.update_limit() / self.model.constants.wear_per_work } else { f64::MAX }
    }

    /// Finds how much may wear before the profile follows, where that is not known yet.
    pub(super) fn set_limit(&mut self) {
        if self.state.wear.as_ref().is_some_and(|wear| wear.limit == 0.0) {
            self.renew_limit();
        }
    }

    /// Finds how much may wear on the present profile before it follows.
    fn renew_limit(&mut self) {
        let limit = wear::per_disc(self.update_limit(), &self.state.contact);
        if let Some(wear) = &mut self.state.wear {
            wear.limit = limit;
        }
    }

    /// Volume that may wear before the profile follows, m³.
    pub(super) fn update_limit(&self) -> f64 {
        let stick = self.stick_radius();
        // not on a line: a stroke goes on in gross slip with the limit that was found while all
        // stuck, and that of a narrow ring would ask for an update at every turn
        let slips = if self.state.row.is_plane() { stick } else { 0.0 };
        let inner = stick.min(self.widest_stick(&self.state.contact, slips));
        wear::update_limit(self.model.parameters.tolerance, &self.surface, &self.state.contact, inner)
    }

    /// Largest stick radius (m) by which wear is planned where springs slip outside an inner radius
    /// (m): of a thinner annulus little wears. Around a flat that sticks the width counts from the
    /// rim of the flat.
    pub(super) fn widest_stick(&self, contact: &Contact, inner: f64) -> f64 {
        let flat = self.surface.profile().flat_radius();
        let flat = if flat <= inner * (1.0 + ROUNDING) && flat < contact.radius { flat } else { 0.0 };
        flat + (1.0 - self.model.tuning.least_width) * (contact.radius - flat)
    }

    /// Wears the backlog off and lets the contact settle at the present load and displacement.
    ///
    /// # Errors
    /// [`Error::WearOutrun`] where the integrator cannot follow; those of the normal contact.
    pub(crate) fn absorb_backlog(&mut self) -> Result<(), Error> {
        let Some(wear) = &mut self.state.wear else { return Ok(()) };
        if wear.backlog.is_empty() {
            return Ok(());
        }
        let backlog = take(&mut wear.backlog);
        self.view.forget();
        let law = backlog.law();
        let uncounted = self.uncounted(&law, backlog.radius);
        let old = self.surface.clone();
        let at_one_load = !self.state.row.is_plane()
            && !self.state.contact.is_open()
            && backlog.is_at(self.state.contact.depth);
        let mut zone = self.slip_zone();
        let only = law.first().filter(|_| at_one_load && law.len() == 1);
        // a stroke about another place than that where the springs are relaxed may bring the core
        // to its bound, too: it has not slipped
        if let Some(law) = only {
            zone.0 = zone.0.max(self.radius_of_front(law.front(), backlog.radius));
        }
        let motion = only.and_then(|law| law.motion(self.model.bound_slope));
        if let Some(motion) = motion.filter(|motion| self.is_followed(motion)) {
            // a first quarter is worn as one of steady cycles
            let is_quarter = motion.mixture.is_none()
                && matches!(motion.sliding, Sliding::Cycles(_))
                && (motion.amount - 0.25).abs() <= 0.25 * SAME;
            if self.absorb_motion(motion, backlog.work)? {
                return self.rest_on_worn(&old, zone, if is_quarter { &[] } else { &uncounted });
            }
        }
        let way = if self.state.row.is_plane() { FrontMotion::Creeps } else { FrontMotion::Returns };
        // what slips has worn free: the springs' work on it is an error of the nodes
        if !self.absorb_law((&law, way), backlog.work, backlog.radius)? {
            self.surface.extend_far();
            self.correct_work(-backlog.work);
        }
        self.rest_on_worn(&old, zone, &uncounted)
    }

    /// Radii (m) from which on springs that follow their bound lose a share of their energy to
    /// friction that the wear of a law does not count; its contacts go up to a radius, m.
    fn uncounted(&self, law: &[SlipAtDepth], radius: f64) -> Vec<(f64, f64)> {
        if self.state.row.is_plane() {
            let turned = self.state.wear.as_ref().is_some_and(|wear| wear.begins_at_reversal);
            return vec![(0.0, if turned { 0.0 } else { 1.0 })];
        }
        let shares = wear::uncounted_shares(law, self.model.bound_slope);
        shares.iter().map(|(image, share)| (self.radius_of_front(*image, radius), *share)).collect()
    }

    /// Wears a motion off on the moving mesh, in place of the springs' work on the profile before,
    /// J; says whether that could follow.
    fn absorb_motion(&mut self, motion: RepeatedMotion, work: f64) -> Result<bool, Error> {
        let control = self.state.contact.control;
        // as much of it as does that work: friction that runs in was another before
        let amount = if self.runs_in() { work / self.work_of_one(&motion) } else { motion.amount };
        let worn_by = self.wear_by(control, RepeatedMotion { amount, ..motion }, None, Part::Update)?;
        if let Some(worn_by) = worn_by {
            self.correct_work(worn_by - work);
        }
        Ok(worn_by.is_some())
    }

    /// Work (J) of one cycle or metre of a motion on the present profile.
    fn work_of_one(&mut self, motion: &RepeatedMotion) -> f64 {
        let Some(mixture) = &motion.mixture else { return self.unit_work(motion.sliding).0 };
        let work = |(share, amplitude): &(f64, f64)| share * self.unit_work(Sliding::Cycles(*amplitude)).0;
        mixture.iter().map(work).sum()
    }

    /// Defers the wear of work (J) to a later update; below 0 where the profile has worn too much.
    pub(super) fn defer(&mut self, work: f64) {
        if let Some(wear) = &mut self.state.wear {
            wear.deferred_work += work;
        }
    }

    /// Wears the backlog off before a motion to a load. A profile that cannot follow under the
    /// present one may do so under less, as at the end of a table: then the wear is deferred.
    ///
    /// # Errors
    /// As [`Self::absorb_backlog`], where the load does not fall.
    pub(super) fn update_before(&mut self, value: f64) -> Result<(), Error> {
        let updated = self.transaction(|this| this.bounded(Self::absorb_backlog));
        if updated.is_ok() || value >= self.state.contact.control {
            return updated;
        }
        self.view.forget();
        let work = self.state.wear.as_mut().map_or(0.0, |wear| take(&mut wear.backlog).work);
        self.defer(work);
        Ok(())
    }

    /// Counts work of friction, J.
    pub(super) fn add_work(&mut self, work: f64) {
        let mut counted = work;
        if let Some(wear) = &mut self.state.wear
            && wear.surplus > 0.0
        {
            let taken = wear.surplus.min(work);
            wear.surplus -= taken;
            counted -= taken;
        }
        self.state.work += counted;
    }

    /// Corrects the friction work by what the wear of a backlog has changed in it, or counts that
    /// of cycles, J. What is counted never falls: a surplus is taken from what follows.
    pub(super) fn correct_work(&mut self, change: f64) {
        let Some(wear) = &mut self.state.wear else { return };
        wear.surplus -= change;
        if wear.surplus < 0.0 {
            self.state.work -= wear.surplus;
            wear.surplus = 0.0;
        }
    }

    /// Counts energy (J) that springs have lost where nothing moved outside: friction has taken it.
    /// Where it has worn is not known.
    pub(super) fn lose_to_friction(&mut self, energy: f64) {
        let work = energy.max(0.0);
        self.state.work += work;
        self.defer(work);
    }

    /// Whether a motion is worth a moving mesh. A slide is on the unworn body and on the mesh that
    /// is there.
    fn is_followed(&self, motion: &RepeatedMotion) -> bool {
        let has_mesh = self.surface.worn().is_none_or(|nodes| nodes.mesh().is_some());
        has_mesh || motion.sliding != Sliding::Onward
    }

    /// Displacement from rest at which all springs slip, m.
    pub(super) fn full_slip(&self) -> f64 {
        self.model.bound_slope * (self.state.contact.depth - self.surface.tip())
    }

    /// Wears a slip law off on nodes at rest, which is that of friction work (J) of the springs.
    /// `radius` is the largest of its contacts, m. Wear that finds no place there is deferred.
    /// Returns false, and wears nothing, where what slips has worn free.
    ///
    /// # Errors
    /// [`Error::WearOutrun`] where one update cannot follow; those of the normal contact.
    pub(super) fn absorb_law(
        &mut self,
        (law, way): (&[SlipAtDepth], FrontMotion),
        work: f64,
        radius: f64,
    ) -> Result<bool, Error> {
        let per_work = self.model.constants.wear_per_work;
        let before = self.surface.worn().map_or(0.0, Nodes::worn_volume);
        let nodes = self.nodes_at_rest(law, per_work * work, radius, way);
        let lost = (before - nodes.worn_volume()) / per_work;
        if lost.is_finite() {
            self.defer(lost);
        }
        self.surface.set_worn(Some(nodes));
        let Some(wear) = &self.state.wear else { return Ok(true) };
        let taken = wear.deferred_share(self.model.tuning.placed_with * work.abs());
        let work = work + taken;
        let (fields, update) = self.update_within_nodes(law, work)?;
        let Some(update) = update else {
            let slips = fields.slip();
            if !slips {
                self.surface.extend_far();
                self.defer(work - taken);
            }
            return Ok(!slips);
        };
        if !update.followed {
            return Err(Error::WearOutrun { from: self.state.place.x, displacement: self.state.place.x });
        }
        let (Some(wear), Some(nodes)) = (&mut self.state.wear, self.surface.worn()) else { return Ok(true) };
        let (transforms, _) = self.memory.get().transforms.get(nodes);
        wear.deferred_work -= taken;
        wear.clipped += fields.clipped;
        wear.defect += fields.defect;
        // what the springs dissipated is exact for the frozen profile: the update keeps its shape
        // and takes that volume. Where the pressure falls by much, that work is too large, and the
        // update alone knows how far it falls
        let change = (&update.depth[..], &transforms.abel(&update.depth)[..]);
        let (volume, frozen) = (nodes.volume(&update.depth), per_work * work);
        let scale_to = |target: f64| if volume > 0.0 { (target / volume).min(MOST_SCALE) } else { 0.0 };
        let full = scale_to(frozen);
        let grown: Vec<f64> = change.1.iter().map(|h| full * h).collect();
        let control = self.model.parameters.normal_control;
        let fall = wear::change_of_mean_work(&self.surface, law, &grown, control);
        let by_springs = (1.0 - fall.abs()).max(0.0).powi(2);
        let by_update = (1.0 - by_springs) * volume.max(0.0).min(frozen);
        let target = by_springs * frozen * (1.0 + fall) + by_update;
        let scale = scale_to(target);
        wear.deferred_work += (target - scale * volume) / per_work;
        self.surface = self.surface.worn_further(change, scale);
        self.surface.extend_far();
        self.correct_work(target / per_work - work);
        self.state.counters.descent_transforms += 1;
        self.state.counters.profile_updates += 1;
        self.look_at_coating();
        Ok(true)
    }

    /// What a slip law of some work (J) does on the nodes of the surface, and the update that it
    /// brings, unless nothing slips or what slips is free. Where a contact grows beyond the nodes,
    /// there are more, if the update can be solved on them: wear that ended at the last one would
    /// leave a step there.
    fn update_within_nodes(
        &mut self,
        law: &[SlipAtDepth],
        work: f64,
    ) -> Result<(SlipFields, Option<Update>), Error> {
        let (constants, control) = (self.model.constants, self.model.parameters.normal_control);
        let mut before: Option<(Surface, SlipFields, Update)> = None;
        loop {
            let fields = self.fields_of_law(law, work)?;
            let Some(nodes) = self.surface.worn().filter(|_| fields.wear()) else {
                return Ok((fields, None));
            };
            let (transforms, _) = self.memory.get().transforms.get(nodes);
            let update = wear::worn_depth(&self.surface, &transforms, &fields, control, &constants)?;
            let counters = &mut self.state.counters;
            counters.pressure_transforms += update.iterations;
            counters.descent_transforms += update.iterations;
            let outgrown = update.followed && update.depth[nodes.last()] > 0.0;
            let reach = (fields.contact.radius, self.surface.profile());
            let more = outgrown.then(|| nodes.reaching_further(reach)).flatten();
            if let Some((surface, fields, update)) = before.filter(|_| !update.followed) {
                self.surface = surface;
                return Ok((fields, Some(update)));
            }
            let Some(more) = more else { return Ok((fields, Some(update))) };
            before = Some((self.surface.clone(), fields, update));
            self.surface.set_worn(Some(more));
        }
    }

    /// What a slip law of some work (J) does on the nodes of the surface.
    fn fields_of_law(&mut self, law: &[SlipAtDepth], work: f64) -> Result<SlipFields, Error> {
        let Some(nodes) = self.surface.worn() else { return Ok(SlipFields::none(0)) };
        let (transforms, made) = self.memory.get().transforms.get(nodes);
        let constants = &self.model.constants;
        let fields = SlipFields::of_law((&self.surface, nodes), &transforms, (law, work), constants)?;
        let counters = &mut self.state.counters;
        counters.transform_tables += u64::from(made);
        counters.pressure_transforms += fields.transforms;
        counters.descent_transforms += fields.transforms;
        Ok(fields)
    }

    /// Radius up to which springs stuck (m) while others slipped in contacts up to a radius (m),
    /// from the image (m) of the innermost that slipped.
    pub(super) fn radius_of_front(&self, front: f64, radius: f64) -> f64 {
        let (tip, edge) = (self.surface.tip(), self.surface.image(radius));
        if front < tip - ROUNDING * (edge - tip) {
            0.0
        } else if front < edge {
            // all of a flat sticks where its edge does
            self.surface.radius_of_image(front.max(tip), 0.0, radius)
        } else {
            radius
        }
    }

    /// Radius (m) up to which springs stuck in all of a law, in contacts up to a radius (m).
    fn innermost_front(&self, law: &[SlipAtDepth], radius: f64) -> f64 {
        self.radius_of_front(law.iter().map(SlipAtDepth::front).fold(f64::INFINITY, f64::min), radius)
    }

    /// Nodes at rest for a slip law that wears a volume (m³) and whose largest contact has a radius
    /// (m): fine at its innermost front, as its way asks for.
    fn nodes_at_rest(&mut self, law: &[SlipAtDepth], volume: f64, radius: f64, way: FrontMotion) -> Nodes {
        let profile = self.surface.profile();
        let inner = self.innermost_front(law, radius);
        let Some(nodes) = self.surface.worn() else {
            return Nodes::around(
                profile,
                self.model.parameters.resolution,
                radius.max(self.state.reach),
                inner,
            );
        };
        let mut left = nodes.clone();
        left.leave_far();
        if left.mesh().is_some() {
            let (transforms, made) = self.memory.get().transforms.get(&left);
            self.state.counters.transform_tables += u64::from(made);
            self.state.counters.descent_transforms += 1;
            left = left.without_mesh(transforms.inverse_abel(left.worn_image()));
        }
        let deepest = deepest_of(law);
        if let Some(spread) = left.spread_at_rim(deepest, inner, profile) {
            left = spread;
        }
        let Parameters { tolerance, resolution, .. } = *self.model.parameters;
        let share = wear::thinning(tolerance, resolution);
        let crossed = self.model.tuning.way_of_edge * volume / (PI * radius * deepest);
        if let Some(thinned) = left.thinned(share, radius, crossed, profile) {
            left = thinned;
        }
        left.adapt(profile, radius, (inner, way));
        left
    }

    /// Contact and springs on a surface that has worn at the present load and displacement, where
    /// the springs of a zone (its inner radius and side) slipped: in truth they have followed their
    /// bound, up or down, all the time. Others keep their place. What the springs have lost is work
    /// of friction, of which shares from some radii (m) on are `uncounted`.
    fn rest_on_worn(
        &mut self,
        old: &Surface,
        zone: (f64, f64),
        uncounted: &[(f64, f64)],
    ) -> Result<(), Error> {
        let to = self.contact_at(self.state.contact.control)?;
        let shares = |surface: &Surface| -> Vec<_> {
            uncounted.iter().map(|(x, share)| (surface.place(*x), *share)).collect()
        };
        let stored = self.energy_of(&shares(old));
        if let Row::Line(springs) = &self.state.row {
            self.state.row = Row::Line(springs.moved_to(old, &self.surface));
        }
        self.rest_in(to, zone);
        self.renew_limit();
        self.lose_to_friction(stored - self.energy_of(&shares(&self.surface)));
        Ok(())
    }

    /// A larger depth, m, to which the wear of other contacts has pressed this one: in truth that
    /// came little by little, and the springs that slip have followed their bound.
    ///
    /// # Errors
    /// Those of the normal contact.
    pub(super) fn sink_to(&mut self, depth: f64) -> Result<(), Error> {
        let to = self.contact_at(depth)?;
        let zone = self.slip_zone();
        self.rest_in(to, zone);
        Ok(())
    }

    /// The springs in another contact at the present displacement, where those of a zone have
    /// followed their bound; in the plane all that slipped have.
    fn rest_in(&mut self, to: Contact, zone: (f64, f64)) {
        let (slope, place) = (self.model.bound_slope, self.state.place);
        let spare = take(&mut self.memory.get().row);
        let row = match &self.state.row {
            Row::Plane(row) => Row::Plane(Box::new(row.rested(&Resting {
                surface: &self.surface,
                contacts: (&self.state.contact, &to),
                bound_slope: slope,
                displacement: place,
                samples: self.model.samples(),
            }))),
            Row::Line(springs) => {
                let (mut springs, _) = springs.walk(&self.path_to(to, place), spare.into_line(), None);
                if zone.1 != 0.0 && !to.is_open() {
                    springs.follow_bound(zone, &to, slope, place.x);
                }
                springs.simplify(&to, slope);
                Row::Line(springs)
            }
        };
        self.memory.get().row = replace(&mut self.state.row, row);
        self.take_contact(to);
    }
}
