//! Transient histories: straight lines in (load, displacement), and the wear that they bring.

use super::FrettingContact;
use super::line::{Line, Point};
use crate::error::Error;
use crate::friction::{Path, Row};
use crate::parameters::USUAL_TOLERANCE;
use crate::range;
use crate::surface::Contact;
use crate::wear;
use nalgebra::Vector2;
use std::mem::{replace, take};

/// Most pieces into which wear may split a line, and most updates in place of one call for a steady
/// motion. A contact that would need more is refused.
pub(crate) const MOST_PIECES: u32 = 4096;

/// Transient motion.
impl FrettingContact {
    /// Walks the straight line from the present state to (`normal`, `displacement`): force in N or
    /// indentation depth in m, by `normal_control`, and displacement in m, that of the drive where
    /// there is a rig stiffness.
    ///
    /// How the caller splits a line does not matter: without wear to rounding, with wear to the set
    /// tolerance.
    ///
    /// # Errors
    /// [`Error::Input`] for numbers that are not finite; [`Error::NonMonotoneImage`],
    /// [`Error::BeyondTable`] where the profile cannot carry the load; [`Error::BeyondNumbers`] for
    /// a contact too large to be computed.
    pub fn advance_to(&mut self, normal: f64, displacement: f64) -> Result<(), Error> {
        self.advance_to_planar(normal, [displacement, self.drive_displacement_y()])
    }

    /// Walks the straight line from the present state to (`normal`, `displacement`), displacement
    /// along x and y in m, those of the drive where there is a rig stiffness. [`Self::advance_to`]
    /// is the same with y as it is.
    ///
    /// # Errors
    /// As [`Self::advance_to`].
    pub fn advance_to_planar(&mut self, normal: f64, displacement: [f64; 2]) -> Result<(), Error> {
        if self.is_running_in() {
            return self.run_in_to(normal, displacement.into());
        }
        self.advance_at_constant_friction(normal, displacement.into())
    }

    /// [`Self::advance_to_planar`] at the present coefficient of friction.
    #[inline]
    pub(super) fn advance_at_constant_friction(
        &mut self,
        normal: f64,
        place: Vector2<f64>,
    ) -> Result<(), Error> {
        let value = self.checked(normal, place.x)?;
        self.advance_by_value(value, place)
    }

    /// The same for a value of the control, m² of load or m, that is checked, as x is.
    #[inline]
    pub(super) fn advance_by_value(&mut self, value: f64, place: Vector2<f64>) -> Result<(), Error> {
        let has_rig = self.model.compliance > 0.0;
        let now = self.drive_place();
        let is_still =
            place == now || has_rig && self.ahead_of_drive(place, &self.state.contact) == Vector2::zeros();
        let is_direct = !has_rig && self.is_on_line(place);
        if value == self.state.contact.control && is_still || is_direct && self.slides_to(value, place.x) {
            self.state.counters.steps += 1;
            return Ok(());
        }
        let from = if is_still { place } else { now };
        self.walk_to(&Line::new((self.state.contact.control, from), (value, place)), is_direct)
    }

    /// Walks a line that takes more than slip of the outer springs.
    fn walk_to(&mut self, line: &Line, is_direct: bool) -> Result<(), Error> {
        let (value, place) = line.to;
        let walked = if is_direct && self.pieces(line) == 1 {
            self.walk(value, place, true)
        } else {
            range::input(range::Y, place.y)?;
            // a load that the profile cannot carry is refused with the caller's number, not with
            // that of a piece: before a body wears on the way, else where a piece is refused
            if self.state.wear.is_some() {
                self.contact_for(value)?;
            }
            self.transaction(|this| this.walk_line(line))
                .map_err(|error| self.solve_contact(value).err().unwrap_or(error))
        };
        walked.map_err(|error| self.error_of_step(error, place.x))?;
        self.state.counters.steps += 1;
        Ok(())
    }

    /// An error with the step that the caller asked for in the place of a piece of it.
    pub(super) fn error_of_step(&self, error: Error, displacement: f64) -> Error {
        match error {
            // cycles have a finite amplitude: this was a slide
            Error::TooMuchWear { amplitude: f64::INFINITY, .. } | Error::WearOutrun { .. } => {
                Error::WearOutrun { from: self.state.place.x, displacement }
            }
            other => other,
        }
    }

    /// Walks a line in pieces, cut where the bodies touch or part. It goes to a place of the drive
    /// where there is a rig stiffness.
    pub(super) fn walk_line(&mut self, line: &Line) -> Result<(), Error> {
        let running_in = self.running_in_of_line();
        for part in line.split_at(self.touch_control()).iter().flatten() {
            let pieces = self.pieces(part);
            let touches = !(self.state.contact.is_open() && part.to.0 <= self.touch_control());
            if self.model.compliance > 0.0 && touches {
                self.follow_drive(part, 1.0 / f64::from(pieces), running_in)?;
                continue;
            }
            let is_even = self.divides_evenly(part);
            for k in 1..=pieces {
                let share =
                    if is_even { f64::from(k) / f64::from(pieces) } else { part.root_share(k, pieces) };
                self.walk_piece(part.at_share(share), (running_in, part.of_whole(share)), true)?;
            }
        }
        Ok(())
    }

    /// [`Self::walk`] for a piece that ends at a share of a line along which friction may run in.
    fn walk_piece(
        &mut self,
        (value, place): Point,
        (running_in, share): (Option<(f64, f64)>, f64),
        divisible: bool,
    ) -> Result<(), Error> {
        self.run_in_along(running_in, share);
        self.walk(value, place, divisible)?;
        self.keep_bound_slope_after(running_in);
        Ok(())
    }

    /// Whether the body has moved along x alone, and does so on the way to a place.
    pub(super) fn is_on_line(&self, place: Vector2<f64>) -> bool {
        !self.state.row.is_plane() && place.y == self.state.place.y
    }

    /// Whether a line is divided at even changes of the load, and not of its root.
    fn divides_evenly(&self, line: &Line) -> bool {
        self.state.wear.is_some() || self.model.compliance > 0.0 || !self.is_on_line(line.to.1)
    }

    /// Pieces that the change of load along a line asks for.
    fn pieces(&self, line: &Line) -> u32 {
        if self.divides_evenly(line) {
            self.pieces_by(line, |load| load, self.model.tuning.load_share)
        } else if self.model.constants.force_control {
            self.pieces_by(line, f64::sqrt, self.model.tuning.root_share)
        } else {
            // the bound changes evenly: all is exact
            1
        }
    }

    /// Pieces over which a measure of the load changes by at most a share of the larger one.
    fn pieces_by(&self, line: &Line, measure: impl Fn(f64) -> f64, share: f64) -> u32 {
        if line.from.0 == line.to.0 {
            return 1;
        }
        let touch = self.touch_control();
        let (from, to) = ((line.from.0 - touch).max(0.0), (line.to.0 - touch).max(0.0));
        let rising_in_place = line.from.1 == line.to.1 && to >= from;
        // of the two measures the load itself changes by the larger share
        if (to - from).abs() <= share * to.max(from) || rising_in_place {
            return 1;
        }
        let (from, to) = (measure(from), measure(to));
        // divided by the share last: a part of the smallest numbers may be 0
        ((to - from).abs() / to.max(from) / share).ceil().max(1.0) as u32
    }

    /// Walks one straight way, after the profile has followed where that is due. A divisible one is
    /// divided where it wears much.
    pub(super) fn walk(&mut self, value: f64, place: Vector2<f64>, divisible: bool) -> Result<(), Error> {
        if let Some(onset) = self.onset_of_long_slide(value, place) {
            return self.transaction(|this| {
                this.walk(value, onset, divisible)?;
                this.bounded(|this| this.slide_on(place.x))
            });
        }
        if !self.update_is_due(place, 0.0) {
            return self.walk_on(value, place, divisible);
        }
        self.transaction(|this| {
            this.update_before(value)?;
            this.bounded(|this| this.walk_on(value, place, divisible))
        })
    }

    /// Whether the way to a place goes back, or is the first one.
    pub(super) fn turns(&self, place: Vector2<f64>) -> bool {
        let moved = place - self.state.place;
        if self.state.direction == Vector2::zeros() {
            moved != Vector2::zeros()
        } else {
            self.state.direction.dot(&moved) < 0.0
        }
    }

    /// Ratio of a volume (m³) worn in one stroke to what may wear before the profile follows, where
    /// it exceeds that.
    pub(super) fn exceeds_limit(&self, volume: f64, contact: &Contact, stick_radius: f64) -> Option<f64> {
        let tolerance =
            if stick_radius > 0.0 { self.model.tuning.stroke } else { 1.0 } * self.model.parameters.tolerance;
        wear::exceeds_limit(volume, tolerance, &self.surface, contact, stick_radius)
    }

    fn walk_on(&mut self, value: f64, place: Vector2<f64>, divisible: bool) -> Result<(), Error> {
        let stays_open = self.state.contact.is_open() && value <= self.touch_control();
        if place.y != self.state.place.y && !stays_open {
            self.enter_plane()?;
        }
        let to = self.contact_for(value)?;
        let end = self.try_walk(to, place);
        self.settle(end, (value, place), divisible)?;
        self.state.counters.spring_walks += 1;
        Ok(())
    }

    /// The contact at the end of a straight way.
    pub(super) fn contact_for(&self, value: f64) -> Result<Contact, Error> {
        if value == self.state.contact.control { Ok(self.state.contact) } else { self.solve_contact(value) }
    }

    /// Takes over the end of a straight way whose slip is the last that was kept.
    pub(super) fn settle(
        &mut self,
        End { to, row, work }: End,
        (value, place): (f64, Vector2<f64>),
        divisible: bool,
    ) -> Result<(), Error> {
        if !work.is_finite() {
            let normal = if self.model.constants.force_control { value * self.force_scale() } else { value };
            return Err(Error::NotFinite { what: "the work of friction", normal, displacement: place.x });
        }
        self.state.counters.contact_solutions += u64::from(value != self.state.contact.control);
        if self.state.wear.is_none() || work <= 0.0 {
            self.arrive(to, place, row, work);
            return Ok(());
        }
        let volume = self.model.constants.wear_per_work * work;
        let inner = if row.is_plane() {
            let slips = self.innermost_slip(to.radius);
            self.widest_stick(&to, slips)
        } else {
            row.slip_zone(&to, self.model.bound_slope, place.x).0
        };
        let mut ratio = self.exceeds_limit(volume, &to, inner);
        if ratio.is_some() && self.exceeds_wear_capacity(work, &to) {
            if self.defer_if_little(work, 1.0) {
                self.arrive(to, place, row, work);
                return Ok(());
            }
            return Err(Error::WearOutrun { from: self.state.place.x, displacement: place.x });
        }
        if ratio.is_some_and(|ratio| ratio > f64::from(MOST_PIECES)) {
            ratio = self.exceeds_limit(volume, &self.larger_contact(&to), inner);
        }
        if let Some(ratio) = ratio.filter(|_| divisible) {
            let pieces = ratio.ceil().min(f64::from(MOST_PIECES)) as u32;
            let line = Line::new((self.state.contact.control, self.state.place), (value, place));
            let running_in = self.running_in_of_line();
            return self.transaction(|this| {
                (1..=pieces).try_for_each(|k| {
                    let share = f64::from(k) / f64::from(pieces);
                    this.walk_piece(line.at_share(share), (running_in, share), false)
                })?;
                this.bounded(Self::absorb_backlog)
            });
        }
        self.gather(work, &to, place - self.state.place);
        self.arrive(to, place, row, work);
        self.set_limit();
        Ok(())
    }

    /// Radius (m), within a contact of some radius, outside which the springs of a line have
    /// slipped.
    fn innermost_slip(&mut self, radius: f64) -> f64 {
        let tip = self.surface.tip();
        match self.memory.get().slips.first() {
            Some(piece) if piece.slip.0 == 0.0 || piece.image.0 > tip => {
                let front = piece.image.0;
                self.radius_of_front(front, radius)
            }
            _ => 0.0,
        }
    }

    /// Row and work of friction (J) at the end of a straight way.
    pub(super) fn try_walk(&mut self, to: Contact, place: Vector2<f64>) -> End {
        let spare = take(&mut self.memory.get().row);
        let mut slips = self.take_slips();
        let path = self.path_to(to, place);
        let (row, half_work) = self.state.row.walk(&path, spare, slips.as_mut());
        self.keep_slips(slips);
        End { to, row, work: 2.0 * self.model.constants.tangential_modulus * half_work }
    }

    /// The present contact or another one, whichever is loaded more.
    pub(super) fn larger_contact(&self, other: &Contact) -> Contact {
        if self.state.contact.load > other.load { self.state.contact } else { *other }
    }

    /// Whether the wear of so much work (J) on the way to a contact is beyond all that the larger
    /// of both could follow, at the usual tolerance or a wider one: under a load that falls to next
    /// to nothing slip is over before the contact is small.
    pub(super) fn exceeds_wear_capacity(&self, work: f64, to: &Contact) -> bool {
        let volume = self.model.constants.wear_per_work * work;
        let tolerance = self.model.parameters.tolerance.max(USUAL_TOLERANCE);
        wear::exceeds_limit(volume, tolerance, &self.surface, &self.larger_contact(to), 0.0)
            .is_some_and(|ratio| ratio > f64::from(MOST_PIECES))
    }

    /// The path from the present state to a contact and a place.
    pub(super) fn path_to(&self, to: Contact, place: Vector2<f64>) -> Path<'_> {
        let axes = &self.model.axes;
        Path {
            surface: &self.surface,
            control: self.model.parameters.normal_control,
            bound_slope: self.model.bound_slope,
            start_slope: self.model.start_slope,
            stiffness_ratio: axes.stiffness_ratio,
            from: self.state.contact,
            to,
            start: axes.for_springs(self.state.place),
            end: axes.for_springs(place),
            samples: self.model.samples(),
        }
    }

    /// Takes over the state at the end of a path. Where the bodies have parted, the next contact
    /// begins on a line.
    pub(super) fn arrive(&mut self, to: Contact, place: Vector2<f64>, mut row: Row, work: f64) {
        if self.state.contact.is_open() || self.turns(place) {
            self.begin_stroke();
            self.bound_knots(&mut row);
        }
        self.memory.get().row = replace(&mut self.state.row, row);
        self.face(place);
        self.state.place = place;
        self.add_work(work);
        self.take_contact(to);
    }

    /// Takes the direction of the way to a place for that of the last movement, on a line that of
    /// its part along x.
    pub(super) fn face(&mut self, place: Vector2<f64>) {
        let moved = place - self.state.place;
        let moved = if self.state.row.is_plane() { moved } else { Vector2::new(moved.x, 0.0) };
        if let Some(direction) = moved.try_normalize(0.0) {
            self.state.direction = direction;
        }
    }

    /// A place on the line along x on which the body stands.
    pub(super) fn place_at(&self, displacement: f64) -> Vector2<f64> {
        Vector2::new(displacement, self.state.place.y)
    }

    /// Takes over a contact in which the springs are.
    pub(super) fn take_contact(&mut self, to: Contact) {
        self.state.contact = to;
        self.state.reach = self.state.reach.max(to.radius);
        if to.is_open() && self.state.row.is_plane() {
            self.state.row = Row::default();
            let along = Vector2::new(self.state.direction.x, 0.0);
            self.state.direction = along.try_normalize(0.0).unwrap_or_default();
        }
    }

    /// Contact of the present surface at another value of the control.
    pub(super) fn contact_at(&mut self, value: f64) -> Result<Contact, Error> {
        self.state.counters.contact_solutions += 1;
        self.solve_contact(value)
    }

    pub(super) fn solve_contact(&self, value: f64) -> Result<Contact, Error> {
        self.surface.contact(self.model.parameters.normal_control, value, self.force_scale())
    }
}

/// The end of a straight way.
pub(super) struct End {
    to: Contact,
    pub(super) row: Row,
    /// J.
    pub(super) work: f64,
}
