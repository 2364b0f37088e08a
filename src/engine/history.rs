//! Transient histories: straight lines in (load, displacement), and the wear that they bring.

use super::FrettingContact;
use crate::error::Error;
use crate::friction::{Path, Springs};
use crate::surface::{Contact, Nodes, Surface};
use crate::wear::{self, Edge, Pending, Segment, Sliding, Steady};

/// Largest change of load, relative to the larger one, over which the friction work of a spring takes the mean of its
/// bound and one pair of transforms serves; the error is of second order in it.
const LOAD_SHARE: f64 = 0.05;

/// How much more than the limit between two updates may wear in one stroke before the profile follows within it. At a
/// reversal an update is far more exact, since the stroke can be told for half a cycle there.
pub(super) const STROKE: f64 = 20.0;

/// Most by which the depth of an update is scaled up to the volume that its work wears.
const MOST_SCALE: f64 = 1.5;

/// Most pieces into which wear may split a line.
const MOST_PIECES: f64 = 512.0;

impl FrettingContact {
    /// Walks the straight line from the present state to (`normal`, `displacement`): force in N or indentation depth
    /// in m, by `normal_control`, and displacement in m, that of the drive where there is a rig stiffness.
    ///
    /// How the caller splits a line does not matter: without wear to rounding, with wear to the set tolerance.
    ///
    /// # Errors
    /// [`Error::Input`] for numbers that are not finite; [`Error::NonMonotoneImage`], [`Error::BeyondTable`] where the
    /// profile cannot carry the load; [`Error::NotFinite`] where double precision ends.
    pub fn advance_to(&mut self, normal: f64, displacement: f64) -> Result<(), Error> {
        let (value, displacement) = self.checked(normal, displacement)?;
        if self.compliance > 0.0 {
            return self.advance_drive(value, displacement);
        }
        if value == self.contact.control && displacement == self.displacement {
            self.counters.steps += 1;
            return Ok(());
        }
        if self.slides_to(value, displacement) {
            self.counters.steps += 1;
            return Ok(());
        }
        let line = Line { from: (self.contact.control, self.displacement), to: (value, displacement) };
        let walked = if self.pieces(&line) == 1 {
            self.walk(value, displacement, 1)
        } else {
            // a load that the profile cannot carry is refused with the caller's number, not with that of a piece
            self.solve_contact(value)?;
            self.transaction(|this| this.walk_line(&line))
        };
        walked.map_err(|error| self.told_of_step(error, displacement))?;
        self.counters.steps += 1;
        Ok(())
    }

    /// An error with the step that the caller asked for in the place of a piece of it.
    pub(super) fn told_of_step(&self, error: Error, displacement: f64) -> Error {
        match error {
            // cycles have a finite amplitude: this was a slide
            Error::TooMuchWear { amplitude: f64::INFINITY, .. } | Error::WearOutrun { .. } => {
                Error::WearOutrun { from: self.displacement, displacement }
            }
            other => other,
        }
    }

    /// Walks a line in pieces, cut where the bodies touch or part.
    fn walk_line(&mut self, line: &Line) -> Result<(), Error> {
        let touch = self.touch_control();
        let parts = line.split_at(touch);
        for part in parts.iter().flatten() {
            let pieces = self.pieces(part);
            for k in 1..=pieces {
                let (value, displacement) = part.at(k, pieces);
                self.walk(value, displacement, 1)?;
            }
        }
        Ok(())
    }

    /// Pieces that the change of load along a line asks for.
    pub(super) fn pieces(&self, line: &Line) -> u32 {
        if line.from.0 == line.to.0 {
            return 1;
        }
        let touch = self.touch_control();
        let (low, high) = ((line.from.0 - touch).max(0.0), (line.to.0 - touch).max(0.0));
        let rising_in_place = line.from.1 == line.to.1 && high >= low;
        if low == high || rising_in_place {
            return 1;
        }
        // a share at the most, divided last: a part of the smallest numbers may be none
        ((high - low).abs() / high.max(low) / LOAD_SHARE).ceil().max(1.0) as u32
    }

    /// Walks one piece, after closing the segment where the motion turns. `splits` > 0 allows wear to split it further.
    pub(super) fn walk(&mut self, value: f64, displacement: f64, splits: u32) -> Result<(), Error> {
        if let Some(onset) = self.onset_of_long_slide(value, displacement) {
            return self.transaction(|this| {
                this.walk(value, onset, splits)?;
                this.bounded(|this| this.slide_on(displacement))
            });
        }
        let turns = || {
            displacement != self.displacement && (displacement - self.displacement).signum() != self.direction
                || value <= self.touch_control()
        };
        if self.stays_apart(value) {
            self.walk_on(value, displacement, splits)
        } else if self.wear.is_some() && turns() {
            if let Some(steady) = self.half_cycle_in_rhythm() {
                let limit = self.update_limit();
                let walk_on = |this: &mut Self| this.walk_on(value, displacement, splits);
                if let Some(result) = self.turn_in_rhythm(steady, limit, walk_on) {
                    return result;
                }
            }
            self.transaction(|this| {
                this.bounded(|this| {
                    this.turn()?;
                    this.walk_on(value, displacement, splits)
                })
            })
        } else if self.is_worn_out() {
            self.transaction(|this| {
                this.bounded(|this| {
                    this.settle()?;
                    this.walk_on(value, displacement, splits)
                })
            })
        } else {
            self.walk_on(value, displacement, splits)
        }
    }

    /// Whether the bodies are apart and stay so, after the last segment has been closed: there is nothing to turn.
    fn stays_apart(&self, value: f64) -> bool {
        self.contact.is_open()
            && value <= self.touch_control()
            && self.wear.as_ref().is_some_and(|wear| wear.segment.contact.is_none())
    }

    /// Whether the segment has worn so much that the profile has to follow before the motion goes on. It is done then,
    /// not at the end of the step before, so that a contact that slides is seen sliding.
    fn is_worn_out(&self) -> bool {
        let Some(wear) = &self.wear else { return false };
        if wear.segment.work == 0.0 || self.contact.is_open() || self.keeps_calm(&self.contact, 0.0) {
            return false;
        }
        let inner = self.springs.stick_radius(&self.contact, self.constants.bound_slope(), self.displacement);
        self.exceeds_limit(self.constants.wear_per_work * wear.segment.work, &self.contact, inner).is_some()
    }

    /// Ratio of a volume (m³) worn in one stroke to what may wear before the profile follows, where it exceeds that.
    pub(super) fn exceeds_limit(&self, volume: f64, contact: &Contact, stick_radius: f64) -> Option<f64> {
        let tolerance = if stick_radius > 0.0 { STROKE } else { 1.0 } * self.parameters.tolerance;
        wear::exceeds_limit(volume, tolerance, &self.surface, contact, stick_radius)
    }

    fn walk_on(&mut self, value: f64, displacement: f64, splits: u32) -> Result<(), Error> {
        let to = if value == self.contact.control { self.contact } else { self.solve_contact(value)? };
        let spare = std::mem::take(&mut self.spare);
        let path = self.path_to(to, displacement);
        let (springs, half_work) = self.springs.walk(&path, spare);
        let work = 2.0 * self.constants.tangential_modulus * half_work;
        let force = to.load * self.force_scale();
        let pressure = if to.is_open() { 0.0 } else { force / to.radius / to.radius };
        if !(pressure.is_finite()
            && work.is_finite()
            && to.depth.is_finite()
            && to.radius.is_finite()
            && force.is_finite())
        {
            let normal = if self.constants.force_control { value * self.force_scale() } else { value };
            return Err(Error::NotFinite { what: "the state of the contact", normal, displacement });
        }
        self.counters.spring_walks += 1;
        self.counters.contact_solutions += u64::from(value != self.contact.control);
        let Some(wear) = &self.wear else {
            self.arrive(to, displacement, springs, work);
            return Ok(());
        };
        let limit = || {
            let inner = springs.stick_radius(&to, self.constants.bound_slope(), displacement);
            self.exceeds_limit(self.constants.wear_per_work * work, &to, inner)
        };
        if work > 0.0
            && !self.keeps_calm(&to, work)
            && let Some(ratio) = limit()
            && (splits > 0 || (ratio > MOST_PIECES && self.outwears(work)))
        {
            if splits == 0 {
                return Err(Error::WearOutrun { from: self.displacement, displacement });
            }
            let pieces = ratio.ceil().min(MOST_PIECES) as u32;
            let line = Line { from: (self.contact.control, self.displacement), to: (value, displacement) };
            return self.transaction(|this| {
                (1..=pieces).try_for_each(|k| {
                    let (value, displacement) = line.at(k, pieces);
                    this.walk(value, displacement, splits - 1)
                })?;
                // the last piece is worn off later: a profile that cannot follow it is refused now
                this.look()
            });
        }
        let start = wear.segment.contact.unwrap_or(to);
        let load_moved = (to.load - start.load).abs() > LOAD_SHARE * to.load.max(start.load);
        if load_moved && !to.is_open() {
            self.transaction(|this| {
                this.extend_segment(&to, displacement, work);
                this.arrive(to, displacement, springs, work);
                this.close_segment()
            })
        } else {
            self.extend_segment(&to, displacement, work);
            self.arrive(to, displacement, springs, work);
            Ok(())
        }
    }

    /// Whether the wear of so much work (J) within a piece of a step is beyond all that the contact could follow.
    fn outwears(&self, work: f64) -> bool {
        let ratio = self.exceeds_limit(self.constants.wear_per_work * work, &self.contact, 0.0);
        ratio.is_some_and(|ratio| ratio > MOST_PIECES)
    }

    /// The path from the present state to a contact and displacement.
    pub(super) fn path_to(&self, to: Contact, displacement: f64) -> Path<'_> {
        Path {
            surface: &self.surface,
            control: self.parameters.normal_control,
            bound_slope: self.constants.bound_slope(),
            from: self.contact,
            to,
            start: self.displacement,
            end: displacement,
            sampling: 1.0 / self.parameters.resolution as f64,
        }
    }

    /// Adds a path to the segment: springs that touch along it, and its work.
    fn extend_segment(&mut self, to: &Contact, displacement: f64, work: f64) {
        let from = self.contact;
        if from.is_open() && to.is_open() {
            // in the air only the place changes from which a segment will begin
            if let Some(wear) = &mut self.wear {
                wear.segment.start = displacement;
            }
            return;
        }
        let touched = (to.radius != from.radius).then(|| {
            let path = self.path_to(*to, displacement);
            self.wear.as_ref().map(|wear| wear.segment.unslipped.touched(&path))
        });
        if to.is_open() && work > 0.0 && self.wear.as_ref().is_some_and(|wear| wear.pending.is_empty()) {
            // the last slip before the bodies part, with the pressure that it began with
            let limit = self.constants.friction_coefficient * self.normal_reaction();
            let path = if limit > 0.0 { work / limit } else { (displacement - self.displacement).abs() };
            self.spread(Steady { sliding: Sliding::Onward, amount: path, work, repeated: false });
        } else if let (true, Some(wear)) = (to.is_open(), &mut self.wear) {
            wear.pending.add_work(work);
        }
        let Some(wear) = &mut self.wear else { return };
        if let Some(Some(unslipped)) = touched {
            wear.segment.unslipped = unslipped;
        }
        wear.segment.contact.get_or_insert(if from.is_open() { *to } else { from });
        if !to.is_open() {
            wear.segment.work += work;
        }
    }

    /// Takes over the state at the end of a path.
    pub(super) fn arrive(&mut self, to: Contact, displacement: f64, springs: Springs, work: f64) {
        // asked first, since taking moves the whole of it
        if self.view.get().is_some() {
            self.view.take();
        }
        self.spare = std::mem::replace(&mut self.springs, springs);
        if displacement != self.displacement {
            self.direction = (displacement - self.displacement).signum();
        }
        self.contact = to;
        self.displacement = displacement;
        self.reach = self.reach.max(to.radius);
        self.work += work;
    }

    /// At a reversal: closes the segment and updates the profile if the next segment, taken to be like this one, would
    /// wear too much. Here all slipping springs are at their bound on one side; an update between two reversals would
    /// let the inner ones, which still hold the last direction, slip against the outer ones.
    fn turn(&mut self) -> Result<(), Error> {
        let last = self.wear.as_ref().map_or(0.0, |wear| wear.segment.work);
        if self.is_beyond_the_profile(last) {
            if let Some(wear) = &mut self.wear {
                wear.pending.add_work(last);
            }
            self.start_segment();
            return Ok(());
        }
        let limit = self.update_limit();
        let candidate = self.steady_segment();
        match candidate {
            Some(steady) if self.is_steady(&steady) => self.add_steady(steady)?,
            // it may be the first of many
            Some(_) => self.close_segment()?,
            None => {
                self.set_rhythm(None);
                self.close_segment()?;
            }
        }
        if self.constants.wear_per_work * (self.pending_work() + last) > limit {
            let followed =
                self.wear.as_ref().is_some_and(|wear| wear.pending.steady.is_some_and(|s| s.repeated));
            let stick =
                self.springs.stick_radius(&self.contact, self.constants.bound_slope(), self.displacement);
            let drive = match candidate {
                Some(Steady { sliding: Sliding::Cycles(own), .. }) if followed => self.drive_amplitude(own),
                _ => 0.0,
            };
            self.update_profile()?;
            match candidate {
                Some(Steady { sliding: Sliding::Cycles(amplitude), .. }) if followed => {
                    let own = self.own_amplitude(drive);
                    self.displacement += self.direction * (own - amplitude);
                    self.rest_at_reversal(own, stick);
                }
                Some(Steady { sliding: Sliding::Cycles(amplitude), .. }) => {
                    self.expect_cycles(amplitude);
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// Whether the wear of so little work (J), with that which has found no place yet, is lost in the rounding of the profile.
    fn is_beyond_the_profile(&self, work: f64) -> bool {
        let unplaced = self.wear.as_ref().map_or(0.0, |wear| wear.pending.unplaced);
        let disc = wear::annulus(&self.contact, 0.0);
        self.constants.wear_per_work * (work + unplaced) <= f64::EPSILON * disc * self.contact.depth.abs()
    }

    /// Work whose wear is still to be taken off, J.
    fn pending_work(&self) -> f64 {
        let Some(wear) = &self.wear else { return 0.0 };
        wear.pending.work + wear.pending.steady.map_or(0.0, |steady| steady.work)
    }

    fn take_pending_steady(&mut self) -> Option<Steady> {
        self.wear.as_mut().and_then(|wear| wear.pending.steady.take())
    }

    /// Volume that may wear before the profile is updated, m³.
    fn update_limit(&self) -> f64 {
        let mut inner =
            self.springs.stick_radius(&self.contact, self.constants.bound_slope(), self.displacement);
        if let (Some(wear), Some(nodes)) = (&self.wear, self.surface.worn())
            && let Some(first) = wear.pending.slip_path.iter().position(|s| *s > 0.0)
        {
            inner = inner.min(nodes.x()[first]);
        }
        wear::update_limit(self.parameters.tolerance, &self.surface, &self.contact, inner)
    }

    /// Closes the segment and brings the profile up to date.
    pub(super) fn settle(&mut self) -> Result<(), Error> {
        let begun = match self.begun_half_cycle() {
            None => self.steady_segment(),
            begun => begun,
        };
        match begun {
            Some(steady) if self.is_steady(&steady) => self.add_steady(steady)?,
            _ => self.close_segment()?,
        }
        self.update_profile()
    }

    /// Turns the slip since the segment's start into work per area and slip path at the nodes.
    pub(super) fn close_segment(&mut self) -> Result<(), Error> {
        let Some(wear) = &self.wear else { return Ok(()) };
        if wear.segment.work > 0.0 {
            match wear.pending.steady {
                Some(steady) if !steady.repeated => {
                    self.take_pending_steady();
                    self.spread(steady);
                }
                Some(_) => self.update_under_segment()?,
                None => {}
            }
            self.prepare_nodes()?;
            let (Some(wear), Some(nodes)) = (&mut self.wear, self.surface.worn()) else { return Ok(()) };
            let mut edge = Edge::new(nodes, &self.contact, self.surface.profile().outer_radius());
            let start = wear.segment.contact.unwrap_or(self.contact);
            if start.radius > self.contact.radius {
                edge = Edge::new(nodes, &start, self.surface.profile().outer_radius());
            }
            let (deflection, slip) = wear::segment_fields(
                &self.surface,
                nodes,
                &wear.segment,
                (&self.springs, &self.contact, self.displacement),
                &self.constants,
            );
            if slip.iter().any(|s| *s != 0.0) {
                let (transforms, made) = wear.transforms.get(nodes);
                let mut traction = wear::pressure_nodes(&transforms, nodes.x(), &deflection, &edge);
                traction.iter_mut().for_each(|t| *t *= self.constants.tangential_modulus);
                let surface_slip = transforms.descend(&slip);
                let largest = if start.radius > self.contact.radius { start } else { self.contact };
                wear.transform_defect +=
                    wear.pending.add(nodes, &largest, (&traction, &surface_slip), wear.segment.work, 1.25);
                self.counters.transform_tables += u64::from(made);
                self.counters.pressure_transforms += 1;
                self.counters.descent_transforms += 1;
            } else {
                wear.pending.add_work(wear.segment.work);
            }
        }
        self.start_segment();
        Ok(())
    }

    pub(super) fn start_segment(&mut self) {
        if self.wear.is_none() {
            return;
        }
        let contact = (!self.contact.is_open()).then_some(self.contact);
        let (inner, side) =
            self.springs.slip_zone(&self.contact, self.constants.bound_slope(), self.displacement);
        let sliding = if inner == 0.0 { side } else { 0.0 };
        if let Some(wear) = &mut self.wear {
            let mut unslipped = std::mem::take(&mut wear.segment.unslipped);
            unslipped.copy_from(&self.springs);
            wear.segment = Segment { unslipped, contact, start: self.displacement, sliding, work: 0.0 };
        }
    }

    /// Makes the nodes at the first slip; later adapts them to the contact and the front, after what is pending has
    /// been worn off on the old ones.
    fn prepare_nodes(&mut self) -> Result<(), Error> {
        let front = self.springs.stick_radius(&self.contact, self.constants.bound_slope(), self.displacement);
        let profile = self.surface.profile();
        let adapted = match self.surface.worn() {
            None => {
                Nodes::around(profile, self.parameters.resolution, self.contact.radius.max(self.reach), front)
            }
            Some(nodes) => {
                let mut adapted = nodes.clone();
                adapted.adapt(profile, self.contact.radius, front);
                if adapted.x().len() == nodes.x().len() {
                    return Ok(());
                }
                adapted
            }
        };
        self.update_under_segment()?;
        // the update may have moved the nodes, too
        let adapted = match self.surface.worn() {
            None => adapted,
            Some(nodes) => {
                let mut again = nodes.clone();
                again.adapt(self.surface.profile(), self.contact.radius, front);
                again
            }
        };
        self.move_to_nodes(adapted);
        Ok(())
    }

    /// Takes over nodes that add to those of the surface without changing its shape: springs and what is pending go along.
    pub(super) fn move_to_nodes(&mut self, nodes: Nodes) {
        let old = self.surface.clone();
        self.surface.set_worn(Some(nodes));
        self.springs = self.springs.moved_to(&old, &self.surface);
        if let Some(wear) = &mut self.wear {
            wear.segment.unslipped = wear.segment.unslipped.moved_to(&old, &self.surface);
            if let (Some(before), Some(now)) = (old.worn(), self.surface.worn()) {
                wear.pending.moved_to(before.x(), now.x());
                wear.pending.owe((before.worn_volume() - now.worn_volume()) / self.constants.wear_per_work);
            }
        }
    }

    /// Takes what is pending off the profile while a segment is going on.
    pub(super) fn update_under_segment(&mut self) -> Result<(), Error> {
        let segment = self.wear.as_mut().map(|wear| std::mem::take(&mut wear.segment));
        let old = self.surface.clone();
        self.update_profile()?;
        if let (Some(wear), Some(segment)) = (&mut self.wear, segment) {
            let unslipped = segment.unslipped.moved_to(&old, &self.surface);
            wear.segment = Segment { unslipped, ..segment };
        }
        Ok(())
    }

    /// Takes what is pending off the profile and lets the contact settle at the present load and displacement.
    pub(super) fn update_profile(&mut self) -> Result<(), Error> {
        let old = self.surface.clone();
        let zone = self.springs.slip_zone(&self.contact, self.constants.bound_slope(), self.displacement);
        let steady = self.take_pending_steady();
        let lived = match steady {
            None => false,
            Some(steady) => self.live_through(steady)?,
        };
        if !lived && !self.update_surface()? {
            return Ok(());
        }
        self.rest_on_new_surface(&old, zone)?;
        self.start_segment();
        Ok(())
    }

    /// Takes what is pending of unsteady motion off the surface; says whether there was any.
    pub(super) fn update_surface(&mut self) -> Result<bool, Error> {
        self.thin_nodes();
        let Some((worn_image, depth)) = self.pending_image()? else { return Ok(false) };
        let Some(mut nodes) = self.surface.worn().cloned() else { return Ok(false) };
        nodes.set_worn(worn_image, depth, self.surface.profile());
        self.surface.set_worn(Some(nodes));
        self.counters.descent_transforms += 1;
        self.counters.profile_updates += 1;
        if let Some(wear) = &mut self.wear {
            let Pending { clipped, unplaced, .. } = wear.pending;
            wear.pending = Pending { clipped, unplaced, ..Pending::default() };
        }
        Ok(true)
    }

    /// Leaves out nodes that the profile no longer needs, before an update, after which the contact is found anew.
    fn thin_nodes(&mut self) {
        let (Some(wear), Some(nodes)) = (&mut self.wear, self.surface.worn()) else { return };
        let Some(contact) = wear.pending.contact else { return };
        let share = wear::THINNING * self.parameters.tolerance;
        if let Some(thinned) = nodes.thinned(share, contact.radius, self.surface.profile()) {
            wear.pending.moved_to(nodes.x(), thinned.x());
            wear.pending.owe((nodes.worn_volume() - thinned.worn_volume()) / self.constants.wear_per_work);
            self.surface.set_worn(Some(thinned));
        } else {
            // of a mesh the volume is told from the image, after the update from the depths
            let told_anew = nodes.volume(nodes.depth());
            wear.pending.owe((nodes.worn_volume() - told_anew) / self.constants.wear_per_work);
        }
    }

    /// Contact and springs on a surface that has worn at the present load and displacement, where the springs of a zone
    /// (its inner radius and side) slipped.
    fn rest_on_new_surface(&mut self, old: &Surface, zone: (f64, f64)) -> Result<(), Error> {
        let to = self.contact_at(self.contact.control)?;
        let moved = self.springs.moved_to(old, &self.surface);
        let path = self.path_to(to, self.displacement);
        let (mut springs, _) = moved.walk(&path, Springs::default());
        // it wore while these springs slipped: in truth they have followed their bound, up or down, all the time
        if zone.1 != 0.0 && !to.is_open() {
            springs.follow_bound(zone, &to, self.constants.bound_slope(), self.displacement);
        }
        // nothing moved outside, so that friction has taken what the springs have lost
        let energy = |row: &Springs| row.energy_integral(self.displacement);
        let lost = self.constants.tangential_modulus * (energy(&self.springs) - energy(&springs));
        let work = lost.max(0.0);
        self.springs = springs;
        self.contact = to;
        self.reach = self.reach.max(to.radius);
        self.work += work;
        if let Some(wear) = &mut self.wear {
            wear.pending.unplaced += work;
        }
        Ok(())
    }

    /// Image of the wear and depth at the nodes with what is pending taken off; `None` if nothing is.
    fn pending_image(&mut self) -> Result<Option<Worn>, Error> {
        let (Some(wear), Some(nodes)) = (&mut self.wear, self.surface.worn()) else { return Ok(None) };
        if wear.pending.is_empty() {
            return Ok(None);
        }
        let (transforms, made) = wear.transforms.get(nodes);
        self.counters.transform_tables += u64::from(made);
        let update = wear::worn_depth(
            &self.surface,
            &transforms,
            &wear.pending,
            self.parameters.normal_control,
            &self.constants,
        )?;
        self.counters.descent_transforms += update.iterations;
        self.counters.pressure_transforms += update.iterations;
        if !update.followed {
            return Err(Error::WearOutrun { from: wear.segment.start, displacement: self.displacement });
        }
        let mut depth = update.depth;
        let mut change = transforms.ascend(&depth);
        // what the springs dissipated is exact for the frozen profile: the update keeps its shape and takes that volume
        let volume = nodes.volume(&depth);
        let target = self.constants.wear_per_work * wear.pending.work;
        let scale = if volume > 0.0 { (target / volume).min(MOST_SCALE) } else { 0.0 };
        wear.pending.unplaced += (target - scale * volume) / self.constants.wear_per_work;
        depth.iter_mut().chain(&mut change).for_each(|value| *value *= scale);
        let sum = |old: &[f64], new: &[f64]| old.iter().zip(new).map(|(old, new)| old + new).collect();
        Ok(Some((sum(nodes.worn_image(), &change), sum(nodes.depth(), &depth))))
    }

    /// Contact of the present surface at another value of the control.
    pub(super) fn contact_at(&mut self, value: f64) -> Result<Contact, Error> {
        self.counters.contact_solutions += 1;
        self.solve_contact(value)
    }

    pub(super) fn solve_contact(&self, value: f64) -> Result<Contact, Error> {
        self.surface.contact(self.parameters.normal_control, value, self.force_scale())
    }
}

/// Image of the wear and depth at the nodes, m.
type Worn = (Vec<f64>, Vec<f64>);

/// A straight line in (control, displacement).
pub(super) struct Line {
    pub(super) from: (f64, f64),
    pub(super) to: (f64, f64),
}

impl Line {
    /// Point k of n; the last is the end to the bit.
    pub(super) fn at(&self, k: u32, n: u32) -> (f64, f64) {
        if k == n {
            return self.to;
        }
        let share = f64::from(k) / f64::from(n);
        let mix = |a: f64, b: f64| if a == b { a } else { a + share * (b - a) };
        (mix(self.from.0, self.to.0), mix(self.from.1, self.to.1))
    }

    /// The line in two where the control crosses `level`, else whole.
    pub(super) fn split_at(&self, level: f64) -> [Option<Line>; 2] {
        let (c0, c1) = (self.from.0 - level, self.to.0 - level);
        if c0 * c1 >= 0.0 {
            return [Some(Line { from: self.from, to: self.to }), None];
        }
        let share = c0 / (c0 - c1);
        let middle = (level, self.from.1 + share * (self.to.1 - self.from.1));
        [Some(Line { from: self.from, to: middle }), Some(Line { from: middle, to: self.to })]
    }
}
