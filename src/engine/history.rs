//! Transient histories: straight lines in (load, displacement), and the wear that they bring.

use super::FrettingContact;
use super::line::Line;
use crate::error::Error;
use crate::friction::{Path, Springs};
use crate::surface::Contact;
use crate::wear;
use nalgebra::Vector2;

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
        if self.runs_in() {
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
        let (value, _) = self.checked(normal, place.x)?;
        self.advance_by_value(value, place)
    }

    /// The same for a value of the control, m² of load or m, that is checked, as x is.
    #[inline]
    pub(super) fn advance_by_value(&mut self, value: f64, place: Vector2<f64>) -> Result<(), Error> {
        if self.state.planar.is_some() || place.y != self.drive_displacement_y() {
            return self.advance_in_plane(value, place);
        }
        let displacement = place.x;
        if self.model.compliance > 0.0 {
            return self.advance_drive(value, displacement);
        }
        let stands = value == self.state.contact.control && displacement == self.state.displacement;
        if stands || self.slides_to(value, displacement) {
            self.state.counters.steps += 1;
            return Ok(());
        }
        self.walk_to(value, displacement)
    }

    /// Walks a line that takes more than slip of the outer springs.
    fn walk_to(&mut self, value: f64, displacement: f64) -> Result<(), Error> {
        let line =
            Line { from: (self.state.contact.control, self.state.displacement), to: (value, displacement) };
        let walked = if self.pieces(&line) == 1 {
            self.walk(value, displacement, 1)
        } else {
            // a load that the profile cannot carry is refused with the caller's number, not with
            // that of a piece: before a body wears on the way, else where a piece is refused
            if self.state.wear.is_some() {
                self.solve_contact(value)?;
            }
            self.transaction(|this| this.walk_line(&line))
                .map_err(|error| self.solve_contact(value).err().unwrap_or(error))
        };
        walked.map_err(|error| self.error_of_step(error, displacement))?;
        self.state.counters.steps += 1;
        Ok(())
    }

    /// An error with the step that the caller asked for in the place of a piece of it.
    pub(super) fn error_of_step(&self, error: Error, displacement: f64) -> Error {
        match error {
            // cycles have a finite amplitude: this was a slide
            Error::TooMuchWear { amplitude: f64::INFINITY, .. } | Error::WearOutrun { .. } => {
                Error::WearOutrun { from: self.state.displacement, displacement }
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
                let (value, displacement) =
                    if self.state.wear.is_some() { part.at(k, pieces) } else { part.at_root(k, pieces) };
                self.walk(value, displacement, 1)?;
            }
        }
        Ok(())
    }

    /// Pieces that the change of load along a line asks for.
    fn pieces(&self, line: &Line) -> u32 {
        match (&self.state.wear, self.model.constants.force_control) {
            (Some(_), _) => self.even_pieces(line),
            (None, true) => self.pieces_by(line, f64::sqrt, self.model.tuning.root_share),
            // the bound changes evenly: all is exact
            (None, false) => 1,
        }
    }

    /// Pieces over which the load changes by the same little.
    pub(super) fn even_pieces(&self, line: &Line) -> u32 {
        self.pieces_by(line, |load| load, self.model.tuning.load_share)
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

    /// Walks one piece, after the profile has followed where that is due. `splits` > 0 allows wear
    /// to split it.
    pub(super) fn walk(&mut self, value: f64, displacement: f64, splits: u32) -> Result<(), Error> {
        if let Some(onset) = self.onset_of_long_slide(value, displacement) {
            return self.transaction(|this| {
                this.walk(value, onset, splits)?;
                this.bounded(|this| this.slide_on(displacement))
            });
        }
        if !self.update_is_due(self.direction_to(displacement)) {
            return self.walk_on(value, displacement, splits);
        }
        self.transaction(|this| {
            this.bounded(|this| {
                this.update_before(value)?;
                this.walk_on(value, displacement, splits)
            })
        })
    }

    /// Sign of the way to a displacement.
    pub(super) fn direction_to(&self, displacement: f64) -> f64 {
        let way = displacement - self.state.displacement;
        if way == 0.0 { 0.0 } else { 1f64.copysign(way) }
    }

    /// Ratio of a volume (m³) worn in one stroke to what may wear before the profile follows, where
    /// it exceeds that.
    pub(super) fn exceeds_limit(&self, volume: f64, contact: &Contact, stick_radius: f64) -> Option<f64> {
        let tolerance =
            if stick_radius > 0.0 { self.model.tuning.stroke } else { 1.0 } * self.model.parameters.tolerance;
        wear::exceeds_limit(volume, tolerance, &self.surface, contact, stick_radius)
    }

    fn walk_on(&mut self, value: f64, displacement: f64, splits: u32) -> Result<(), Error> {
        let to =
            if value == self.state.contact.control { self.state.contact } else { self.solve_contact(value)? };
        let spare = std::mem::take(&mut self.memory.get().springs);
        let mut slips = self.take_slips();
        let path = self.path_to(to, displacement);
        let (springs, half_work) = self.state.springs.walk(&path, spare, slips.as_mut());
        let work = 2.0 * self.model.constants.tangential_modulus * half_work;
        self.state.counters.spring_walks += 1;
        self.state.counters.contact_solutions += u64::from(value != self.state.contact.control);
        self.keep_slips(slips);
        if self.state.wear.is_none() || work <= 0.0 {
            self.arrive(to, displacement, springs, work);
            return Ok(());
        }
        let inner = springs.stick_radius(&to, self.model.bound_slope, displacement);
        let volume = self.model.constants.wear_per_work * work;
        let mut ratio = self.exceeds_limit(volume, &to, inner);
        if ratio.is_some_and(|ratio| ratio > f64::from(MOST_PIECES)) {
            if self.exceeds_wear_capacity(work, &to) {
                if self.defer_if_little(work, 1.0) {
                    self.arrive(to, displacement, springs, work);
                    return Ok(());
                }
                if splits == 0 {
                    return Err(Error::WearOutrun { from: self.state.displacement, displacement });
                }
            }
            ratio = self.exceeds_limit(volume, &self.larger_contact(&to), inner);
        }
        if let Some(ratio) = ratio.filter(|_| splits > 0) {
            let pieces = ratio.ceil().min(f64::from(MOST_PIECES)) as u32;
            let line = Line {
                from: (self.state.contact.control, self.state.displacement),
                to: (value, displacement),
            };
            return self.transaction(|this| {
                (1..=pieces).try_for_each(|k| {
                    let (value, displacement) = line.at(k, pieces);
                    this.walk(value, displacement, splits - 1)
                })?;
                this.bounded(Self::absorb_backlog)
            });
        }
        self.gather(work, &to, Vector2::new(self.direction_to(displacement), 0.0));
        self.arrive(to, displacement, springs, work);
        self.set_limit();
        Ok(())
    }

    /// The present contact or another one, whichever is loaded more.
    pub(super) fn larger_contact(&self, other: &Contact) -> Contact {
        if self.state.contact.load > other.load { self.state.contact } else { *other }
    }

    /// Whether the wear of so much work (J) on the way to a contact is beyond all that the larger
    /// of both could follow: under a load that falls to next to nothing slip is over before the
    /// contact is small.
    pub(super) fn exceeds_wear_capacity(&self, work: f64, to: &Contact) -> bool {
        let volume = self.model.constants.wear_per_work * work;
        let ratio = self.exceeds_limit(volume, &self.larger_contact(to), 0.0);
        ratio.is_some_and(|ratio| ratio > f64::from(MOST_PIECES))
    }

    /// The path from the present state to a contact and displacement.
    pub(super) fn path_to(&self, to: Contact, displacement: f64) -> Path<'_> {
        Path {
            surface: &self.surface,
            control: self.model.parameters.normal_control,
            bound_slope: self.model.bound_slope,
            start_slope: self.model.start_slope,
            from: self.state.contact,
            to,
            start: self.state.displacement,
            end: displacement,
            sampling: 1.0 / self.model.parameters.resolution as f64,
        }
    }

    /// Takes over the state at the end of a path.
    pub(super) fn arrive(&mut self, to: Contact, displacement: f64, mut springs: Springs, work: f64) {
        let direction = self.direction_to(displacement);
        if self.state.contact.is_open() || (direction != 0.0 && direction != self.state.direction) {
            self.begin_stroke();
            self.bound_knots(&mut springs);
        }
        self.memory.get().springs = std::mem::replace(&mut self.state.springs, springs);
        if direction != 0.0 {
            self.state.direction = direction;
        }
        self.state.contact = to;
        self.state.displacement = displacement;
        self.state.reach = self.state.reach.max(to.radius);
        self.add_work(work);
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
