//! Motion in both tangential directions.
//!
//! As long as the body does not move along y while it is in contact, all is as in one dimension, at
//! the cost of an empty field. The first motion along y takes the row of knots
//! over into one of vectors ([`PlanarRow`]), which serves from then on until the bodies part. Slip
//! is gathered in the backlog as on a line, by its length: traction and slip are taken for parallel
//! at each radius. Where steady cycles are asked for, they are along x, from rest, whatever was
//! before.

mod reading;

mod derivatives;
mod rig;

pub(super) use rig::BALANCED;

use super::FrettingContact;
use super::history::MOST_PIECES;
use super::line::Line;
use crate::error::Error;
use crate::friction::{PlanarPath, PlanarRow, Resting, Samples, SlipPiece, Springs};
use crate::range;
use crate::surface::Contact;
use nalgebra::Vector2;
use serde::{Deserialize, Serialize};
use std::mem::{replace, take};

/// Name of the displacement along y in messages.
pub(super) const Y: &str = "tangential_displacement_y";

/// What a contact has besides once it has moved along y.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Planar {
    pub(super) row: PlanarRow,
    /// Direction of the last movement, a unit vector.
    pub(super) direction: Vector2<f64>,
}

impl Planar {
    /// Takes over another one, in memory that is there already.
    pub(super) fn copy_from(&mut self, other: &Self) {
        self.row.copy_from(&other.row);
        self.direction = other.direction;
    }
}

impl FrettingContact {
    /// [`Self::advance_by_value`] where the body has moved or moves along y.
    pub(super) fn advance_in_plane(&mut self, value: f64, displacement: Vector2<f64>) -> Result<(), Error> {
        range::input(Y, displacement.y)?;
        if value == self.state.contact.control && displacement == self.drive_place() {
            self.state.counters.steps += 1;
            return Ok(());
        }
        let line = Line { from: (self.state.contact.control, 0.0), to: (value, 1.0) };
        if !(self.state.contact.is_open() && value <= self.touch_control()) {
            // a load that the profile cannot carry is refused with the caller's number, not with
            // that of a piece
            self.solve_contact(value)?;
        }
        self.transaction(|this| this.walk_line_in_plane(&line, displacement))
            .map_err(|error| self.error_of_step(error, displacement.x))?;
        self.state.counters.steps += 1;
        Ok(())
    }

    /// Walks a line of (load, share of the way) to a place, that of the drive where there is a rig
    /// stiffness, in pieces, cut where the bodies touch or part.
    fn walk_line_in_plane(&mut self, line: &Line, to: Vector2<f64>) -> Result<(), Error> {
        let from = self.drive_place();
        for part in line.split_at(self.touch_control()).iter().flatten() {
            let pieces = self.even_pieces(part);
            for k in 1..=pieces {
                let (value, share) = part.at(k, pieces);
                let place = if share == 1.0 { to } else { from + share * (to - from) };
                if self.model.compliance == 0.0 {
                    self.walk_in_plane(value, place)?;
                } else {
                    self.follow_drive(value, place)?;
                }
            }
        }
        Ok(())
    }

    /// Displacement along x and y, m.
    pub(super) fn place(&self) -> Vector2<f64> {
        Vector2::new(self.state.displacement, self.state.displacement_y)
    }

    /// Walks one piece of a line.
    fn walk_in_plane(&mut self, value: f64, place: Vector2<f64>) -> Result<(), Error> {
        if self.state.contact.is_open() && value <= self.touch_control() {
            self.walk(value, place.x, 1)?;
            self.state.displacement_y = place.y;
            return Ok(());
        }
        self.slip_in_plane(value, place, MOST_PIECES.ilog2())
    }

    /// Whether the way to a place goes back.
    fn turns_in_plane(&self, place: Vector2<f64>) -> bool {
        self.direction_in_plane().dot(&(place - self.place())) < 0.0
    }

    /// Takes the row of knots, if there is one, over into one of vectors, after what the line so
    /// far has worn has been taken off.
    fn enter_plane(&mut self) -> Result<(), Error> {
        if self.state.planar.is_some() {
            return Ok(());
        }
        self.absorb_backlog()?;
        if self.state.direction == 0.0 {
            self.begin_stroke();
        }
        let y = self.model.axes.for_springs(self.place()).y;
        let row = PlanarRow::of_line(&self.state.springs, &self.surface, y, self.samples());
        self.state.springs = Springs::default();
        let direction = Vector2::new(if self.state.direction < 0.0 { -1.0 } else { 1.0 }, 0.0);
        self.state.planar = Some(Box::new(Planar { row, direction }));
        Ok(())
    }

    /// Samples across the contact.
    pub(super) fn samples(&self) -> Samples {
        Samples(self.model.tuning.samples_per_cell * self.model.parameters.resolution)
    }

    /// The path from the present state to a contact and a place.
    fn planar_path(&self, to: Contact, place: Vector2<f64>) -> PlanarPath<'_> {
        PlanarPath {
            surface: &self.surface,
            control: self.model.parameters.normal_control,
            bound_slope: self.model.bound_slope,
            start_slope: self.model.start_slope,
            from: self.state.contact,
            to,
            stiffness_ratio: self.model.axes.stiffness_ratio,
            start: self.model.axes.for_springs(self.place()),
            end: self.model.axes.for_springs(place),
            samples: self.samples(),
        }
    }

    /// [`PlanarRow::walk`] of the present row, or of one that begins with the path.
    fn walked_in_plane(
        &self,
        path: &PlanarPath,
        spare: PlanarRow,
        slips: Option<&mut Vec<SlipPiece>>,
    ) -> (PlanarRow, f64) {
        match &self.state.planar {
            Some(planar) => planar.row.walk(path, spare, slips),
            None => PlanarRow::default().walk(path, spare, slips),
        }
    }

    /// Contact, row and work of friction (J) at the end of a piece.
    fn try_in_plane(&mut self, value: f64, place: Vector2<f64>) -> Result<PlanarEnd, Error> {
        let to =
            if value == self.state.contact.control { self.state.contact } else { self.contact_at(value)? };
        let spare = take(&mut self.memory.get().planar);
        let mut slips = self.take_slips();
        let path = self.planar_path(to, place);
        let (row, half_work) = self.walked_in_plane(&path, spare, slips.as_mut());
        self.keep_slips(slips);
        self.state.counters.spring_walks += 1;
        let work = 2.0 * self.model.constants.tangential_modulus * half_work;
        if !work.is_finite() {
            let normal = if self.model.constants.force_control { value * self.force_scale() } else { value };
            return Err(Error::NotFinite { what: "the work of friction", normal, displacement: place.x });
        }
        Ok(PlanarEnd { to, row, work })
    }

    /// Walks one piece, after the profile has followed where that is due; where it wears more than
    /// the profile can take at once, in halves.
    fn slip_in_plane(&mut self, value: f64, place: Vector2<f64>, halvings: u32) -> Result<(), Error> {
        self.enter_plane()?;
        if self.update_is_due(0.0) {
            self.update_before(value)?;
            // the body may have worn free
            self.enter_plane()?;
        }
        let end = self.try_in_plane(value, place)?;
        if self.state.wear.is_some() && end.work > 0.0 {
            let volume = self.model.constants.wear_per_work * end.work;
            if self.exceeds_wear_capacity(end.work, &end.to) {
                if self.defer_if_little(end.work, 1.0) {
                    self.arrive_in_plane(end, place);
                    return Ok(());
                }
                return Err(Error::WearOutrun { from: self.state.displacement, displacement: place.x });
            }
            let larger = self.larger_contact(&end.to);
            let far = self.exceeds_limit(volume, &larger, self.model.widest_stick(&larger)).is_some();
            let middle = 0.5 * (self.place() + place);
            if far && halvings > 0 && middle != place && middle != self.place() {
                let between = 0.5 * (self.state.contact.control + value);
                self.slip_in_plane(between, middle, halvings - 1)?;
                return self.slip_in_plane(value, place, halvings - 1);
            }
            let moved = place - self.place();
            self.gather(end.work, &end.to, moved.try_normalize(0.0).unwrap_or_default());
            self.arrive_in_plane(end, place);
            self.set_limit();
            return Ok(());
        }
        self.arrive_in_plane(end, place);
        Ok(())
    }

    /// Contact and springs on a surface that has worn where the body stands.
    pub(super) fn rest_in_plane(&mut self, to: Contact) {
        let (displacement, samples) = (self.place(), self.samples());
        let Some(planar) = &mut self.state.planar else { return };
        planar.row = planar.row.rested(&Resting {
            surface: &self.surface,
            contacts: (&self.state.contact, &to),
            bound_slope: self.model.bound_slope,
            displacement,
            samples,
        });
        self.state.contact = to;
        self.state.reach = self.state.reach.max(to.radius);
        if to.is_open() {
            self.state.planar = None;
        }
    }

    /// Springs beyond a bound that has become another slip back to it where the body stands.
    /// Returns the work of friction over 2G*, m³.
    pub(super) fn slip_back_in_plane(&mut self) -> f64 {
        let mut slips = self.take_slips();
        let path = self.planar_path(self.state.contact, self.place());
        let (row, half_work) = self.walked_in_plane(&path, PlanarRow::default(), slips.as_mut());
        self.keep_slips(slips);
        if let Some(planar) = &mut self.state.planar {
            planar.row = row;
        }
        half_work
    }

    /// Takes over the state at the end of a piece. Where the bodies have parted, the next contact
    /// begins on a line.
    fn arrive_in_plane(&mut self, end: PlanarEnd, place: Vector2<f64>) {
        let moved = place - self.place();
        let length = moved.x.hypot(moved.y);
        if self.state.contact.is_open() || self.turns_in_plane(place) {
            self.begin_stroke();
        }
        if let Some(planar) = &mut self.state.planar {
            self.memory.get().planar = replace(&mut planar.row, end.row);
            if length > 0.0 {
                planar.direction = moved / length;
            }
        }
        if moved.x != 0.0 {
            self.state.direction = moved.x.signum();
        }
        self.state.contact = end.to;
        self.add_work(end.work);
        [self.state.displacement, self.state.displacement_y] = place.into();
        self.state.reach = self.state.reach.max(end.to.radius);
        if end.to.is_open() {
            self.state.planar = None;
        }
    }
}

/// The end of a piece of a line in the plane.
struct PlanarEnd {
    to: Contact,
    row: PlanarRow,
    /// J.
    work: f64,
}
