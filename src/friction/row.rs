//! The springs under a contact, in the form that their history asks for.

use super::{Knot, Path, PlanarRow, SlipPiece, Springs};
use crate::surface::{Contact, Place};
use nalgebra::Vector2;
use serde::{Deserialize, Serialize};
use std::mem::take;

/// The springs under a contact.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Row {
    /// Of a body that has not moved along y since it touched: exact between a few knots.
    Line(Springs),
    /// Of any other: samples.
    Plane(Box<PlanarRow>),
}

impl Default for Row {
    fn default() -> Self {
        Self::Line(Springs::default())
    }
}

impl Row {
    pub(crate) fn is_plane(&self) -> bool {
        matches!(self, Self::Plane(_))
    }

    /// Its springs on a line, or none.
    pub(crate) fn into_line(self) -> Springs {
        if let Self::Line(springs) = self { springs } else { Springs::default() }
    }

    /// The same, where they are.
    pub(crate) fn on_line(&self) -> &[Knot] {
        if let Self::Line(springs) = self { springs.knots() } else { &[] }
    }

    /// Becomes a copy of another row, in memory that is there already.
    pub(crate) fn copy_from(&mut self, other: &Self) {
        match (self, other) {
            (Self::Line(own), Self::Line(other)) => own.copy_from(other),
            (Self::Plane(own), Self::Plane(other)) => own.copy_from(other),
            (own, other) => *own = other.clone(),
        }
    }

    /// [`Springs::take_smaller`] of two rows of a line.
    pub(crate) fn take_smaller(&mut self, spare: &mut Self) {
        if let (Self::Line(own), Self::Line(spare)) = (self, spare) {
            own.take_smaller(spare);
        }
    }

    /// Radii and places with the displacements at which the springs there would be relaxed, m;
    /// those of a line at `y`.
    pub(crate) fn origins(&self, y: f64) -> impl Iterator<Item = (&Place, Vector2<f64>)> {
        let plane = if let Self::Plane(row) = self { row.knots() } else { &[] };
        let of_line = self.on_line().iter().map(move |knot| (&knot.place, Vector2::new(knot.origin, y)));
        of_line.chain(plane.iter().map(|knot| (&knot.place, knot.origin)))
    }

    /// Walks a path. Returns the new row and ∫ |u| |de| dx, the work of friction over 2G*, m³ (half
    /// the row). `spare` is a row no longer needed whose memory is used again. Where `slips` are
    /// asked for, they are put there.
    #[inline]
    pub(crate) fn walk(&self, path: &Path, spare: Self, slips: Option<&mut Vec<SlipPiece>>) -> (Self, f64) {
        match self {
            Self::Line(springs) => {
                let (springs, half_work) = springs.walk(path, spare.into_line(), slips);
                (Self::Line(springs), half_work)
            }
            Self::Plane(row) => {
                let mut next = if let Self::Plane(spare) = spare { spare } else { Box::default() };
                let half_work;
                (*next, half_work) = row.walk(path, take(&mut *next), slips);
                (Self::Plane(next), half_work)
            }
        }
    }

    /// ∫ u dx from the axis to the edge, m².
    #[inline]
    pub(crate) fn deflection_integral(&self, displacement: Vector2<f64>) -> Vector2<f64> {
        match self {
            Self::Line(springs) => Vector2::new(springs.deflection_integral(displacement.x), 0.0),
            Self::Plane(row) => row.deflection_integral(displacement),
        }
    }

    /// ∫ (u_x² + u_y²/ρ) dx from the axis to the edge, m³, with the stiffness ratio ρ: the elastic
    /// energy of the row over G*_x.
    pub(crate) fn energy_integral(&self, displacement: Vector2<f64>, stiffness_ratio: f64) -> f64 {
        match self {
            Self::Line(springs) => springs.energy_integral(displacement.x),
            Self::Plane(row) => row.energy_integral(displacement, stiffness_ratio),
        }
    }

    /// The same of shares of the springs, each from a place on; in the plane of the last share.
    pub(crate) fn energy_integral_of(
        &self,
        (displacement, stiffness_ratio): (Vector2<f64>, f64),
        shares: &[(Place, f64)],
    ) -> f64 {
        match self {
            Self::Line(springs) => springs.energy_integral_of(displacement.x, shares),
            Self::Plane(row) => {
                let share = shares.last().map_or(0.0, |(_, share)| *share);
                share * row.energy_integral(displacement, stiffness_ratio)
            }
        }
    }

    /// On a line the inner edge (m) of the outer zone in which all springs are at their bound on
    /// one side, and that side; the side is 0 in full stick and in the plane.
    #[inline]
    pub(crate) fn slip_zone(&self, contact: &Contact, bound_slope: f64, displacement: f64) -> (f64, f64) {
        match self {
            Self::Line(springs) => springs.slip_zone(contact, bound_slope, displacement),
            Self::Plane(_) => (contact.radius, 0.0),
        }
    }
}
