//! A straight line between two states of load and displacement, along which a row is walked.

use super::Samples;
use crate::parameters::NormalControl;
use crate::surface::{Contact, Place, Surface};
use nalgebra::Vector2;

/// A straight line between two states of load and displacement.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Path<'a> {
    pub(crate) surface: &'a Surface,
    pub(crate) control: NormalControl,
    /// m = μE*/G* at the end.
    pub(crate) bound_slope: f64,
    /// m at the start.
    pub(crate) start_slope: f64,
    /// G*_y/G*_x, by which `start` and `end` are multiplied along y.
    pub(crate) stiffness_ratio: f64,
    pub(crate) from: Contact,
    pub(crate) to: Contact,
    pub(crate) start: Vector2<f64>,
    pub(crate) end: Vector2<f64>,
    pub(crate) samples: Samples,
}

impl Path<'_> {
    /// Share of the line after which the spring at a place comes into or leaves contact.
    #[inline(always)]
    pub(super) fn share_at_touch(&self, place: &Place) -> f64 {
        let level = match self.control {
            NormalControl::Force => place.load,
            NormalControl::Indentation => place.image,
        };
        let span = self.to.control - self.from.control;
        if span == 0.0 { 1.0 } else { ((level - self.from.control) / span).clamp(0.0, 1.0) }
    }

    /// Displacement at that instant: at the end to the bit, however long the way.
    #[inline(always)]
    pub(super) fn displacement_at_touch(&self, place: &Place) -> Vector2<f64> {
        let share = self.share_at_touch(place);
        if share == 1.0 { self.end } else { self.start + share * self.motion() }
    }

    pub(super) fn motion(&self) -> Vector2<f64> {
        self.end - self.start
    }
}
