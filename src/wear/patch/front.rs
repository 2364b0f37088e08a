//! Where the springs first slip.

use super::{Patch, RIM, Rate};
use crate::surface::Region;

/// Cells at the inner edge within which a front may stand; beyond, a new mesh is made. Where the
/// front is pinned decides the profile there, and a front inside the mesh is only as sharp as the
/// cell that it stands in: with a twelfth of the cells its error did not fall with the tolerance,
/// and on fine meshes their uneven steps took ten times the work.
pub(crate) const FRONT_CELLS: usize = 2;

/// Largest error of the image in gross slip under a force, over the mean overlap and the tolerance.
const MOST_OVERLAPS: f64 = 30.0;

/// Where the springs first slip at the end of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Front {
    /// Where the mesh has it.
    Kept,
    /// Elsewhere: a new mesh has to be made.
    Moved,
}

impl Patch {
    /// Looks whether the front has left the inner edge of the mesh.
    pub(crate) fn front(&self, rate: &Rate) -> Front {
        let bound = |i: usize| {
            let h = if i == 0 && self.mesh.first() == 1 {
                self.inside.edge_image()
            } else {
                rate.image[i] / rate.scale[i]
            };
            self.bound_slope * (rate.indentation - self.body.image(rate.radius[i]) - h)
        };
        let small = 1e-6 * rate.free_slip;
        // a punch's worn rim may leave contact, and a contact may grow to the rim
        let edge = if self.rim {
            bound(self.cells()) < -1e-3 * self.bound_slope * rate.indentation.abs()
        } else {
            self.is_at_end_of_body(rate)
        };
        let moved = match self.mesh.region {
            Region::Annulus => rate.free_slip > bound(0) + small || rate.slip[FRONT_CELLS] == 0.0,
            Region::Disc => rate.free_slip < bound(0) - small,
        };
        if moved || edge { Front::Moved } else { Front::Kept }
    }

    /// Largest image that may wear, m: the overlap at the front, at most the indentation depth.
    pub(crate) fn most_worn(&self, rate: &Rate) -> f64 {
        rate.indentation.abs().min(rate.free_slip / self.bound_slope)
    }

    /// Image, m, of which the error of a step may be a share of the tolerance: what may wear. Where
    /// all slips under a force, the overlap may be far less than that, and has to carry the force.
    pub(crate) fn scale_of_error(&self, rate: &Rate) -> f64 {
        let worn = self.most_worn(rate);
        if self.is_force() && self.mesh.region == Region::Disc {
            worn.min(MOST_OVERLAPS * self.motion.value / rate.radius_squared.sqrt())
        } else {
            worn
        }
    }

    /// Whether the overlap of what slips is on average less than a share of that at the front: all
    /// has worn off that the motion can wear. Where all slips under a force, that does not happen.
    pub(crate) fn is_worn_free(&self, rate: &Rate, share: f64) -> bool {
        if self.is_force() && self.mesh.region == Region::Disc {
            return false;
        }
        let (a, root) = (rate.radius_squared.sqrt(), self.span(rate.radius_squared).sqrt());
        let carries = |i: usize| {
            let bound = if rate.slip[i] > 0.0 { self.bound_slope * rate.overlap[i].max(0.0) } else { 0.0 };
            root * self.mesh.width[i] * rate.scale[i] * bound
        };
        let least = share * self.bound_slope * self.most_worn(rate) * (a - self.inner_radius);
        (0..=self.cells()).map(carries).sum::<f64>() < least
    }

    /// Whether the contact edge has come to the end of the body.
    pub(crate) fn is_at_end_of_body(&self, rate: &Rate) -> bool {
        rate.radius_squared.sqrt() >= self.body.profile().outer_radius() * (1.0 - RIM)
    }

    /// Last node before the front; 0 where the first slips, or all do. A front may move so slowly
    /// that a node next to it comes and goes, in cells of a millionth of the region. Its error is
    /// no reason for a shorter step.
    pub(crate) fn sticking(&self, rate: &Rate) -> usize {
        if self.mesh.region == Region::Disc {
            return 0;
        }
        rate.slip[1..=FRONT_CELLS].iter().take_while(|slip| **slip == 0.0).count()
    }

    /// Lets the image at the nodes next to the front not fall below what it was: there it never
    /// does, and an error of the integration, however small, would let the front creep. Returns
    /// whether anything had to be corrected.
    pub(crate) fn hold_front(&self, depth: &mut [f64], before: &Rate, after: &Rate) -> bool {
        if self.mesh.region == Region::Disc {
            return false;
        }
        let mut image = after.image[..=FRONT_CELLS].to_vec();
        let mut corrected = false;
        for i in 1..=FRONT_CELLS {
            let least = before.image[i] / before.scale[i] * after.scale[i];
            if image[i] < least {
                image[i] = least;
                corrected = true;
            }
        }
        if corrected {
            image.resize(self.cells() + 1, 0.0);
            let held = self.mesh.inverse_abel(&image);
            depth[1..=FRONT_CELLS].copy_from_slice(&held[1..=FRONT_CELLS]);
        }
        corrected
    }
}
