//! Motion in both tangential directions.
//!
//! As long as the body does not move along y while it is in contact, all is as in one dimension.
//! The first motion along y takes the row of knots over into one of vectors
//! ([`PlanarRow`]), which serves from then on until the bodies part. Slip is gathered in the
//! backlog as on a line, by its length: traction and slip are taken for parallel at each radius.
//! Where steady cycles are asked for, they are along x, from rest, whatever was before.

mod reading;

mod derivatives;

use super::FrettingContact;
use crate::error::Error;
use crate::friction::{PlanarRow, Row};
use nalgebra::Vector2;

impl FrettingContact {
    /// Takes the row of knots, if there is one, over into one of vectors, after what the line so
    /// far has worn has been taken off.
    pub(super) fn enter_plane(&mut self) -> Result<(), Error> {
        if self.state.row.is_plane() {
            return Ok(());
        }
        self.absorb_backlog()?;
        if self.state.direction == Vector2::zeros() {
            self.begin_stroke();
            self.state.direction.x = 1.0;
        }
        let y = self.model.axes.for_springs(self.state.place).y;
        if let Row::Line(springs) = &self.state.row {
            let row = PlanarRow::of_line(springs, &self.surface, y, self.model.samples());
            self.state.row = Row::Plane(Box::new(row));
        }
        Ok(())
    }
}
