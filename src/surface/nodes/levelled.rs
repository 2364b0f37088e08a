//! Where wear has levelled the body.
//!
//! The image of the wear is linear in X between the nodes, that of the body is exact. Where wear
//! has levelled the body both nearly cancel, and each cell would keep a small copy of the body: the
//! apex of a cone, whose slope is larger than that of a body worn flat, or the bend of an r⁴,
//! higher than the overlap that carries the load. So the slope that a pressure takes is that of
//! lines there. The image itself is one of lines where that goes on from the axis, as after gross
//! slip; where a core has stuck, springs and meshes need the exact shape beside it.

use super::Nodes;
use crate::profile::Profile;

/// Share of the change of slope of the body that wear has to cancel to have levelled it. With a
/// quarter and three quarters the pressures of bodies worn flat are the same to 2e-3 of their mean.
const LEVELLED: f64 = 0.5;

/// Change of slope of the body, relative to the slope, that is rounding: a table of a ball has
/// none.
const STRAIGHT: f64 = 1e-9;

impl Nodes {
    /// Whether the body, of which the images at the nodes are given (m), is levelled in each cell;
    /// `None` where it has no bend.
    pub(in crate::surface) fn levelled(&self, unworn: &[f64]) -> Vec<Option<bool>> {
        let (body, wear): (Vec<f64>, Vec<f64>) =
            (0..self.last()).map(|j| (self.secant(unworn, j), self.slope(j))).unzip();
        let is_worn = |j: usize| self.depth[j] > 0.0 || self.depth[j + 1] > 0.0;
        (0..self.last()).map(|j| is_levelled(&body, &wear, j).map(|level| level && is_worn(j))).collect()
    }

    /// Number of cells from the axis on in which it is, or has no bend; 0 where none is, where the
    /// axis has not worn, and for a ball, which is linear in X.
    pub(super) fn levelled_from_axis(&self, profile: &Profile) -> usize {
        let is_ball = matches!(profile, Profile::Parabola { .. } | Profile::Ellipse { .. });
        if is_ball || self.depth[0] == 0.0 {
            return 0;
        }
        let cells = self.levelled(&profile.images(&self.x));
        let from_axis = cells.iter().take_while(|level| **level != Some(false)).count();
        cells[..from_axis].iter().rposition(|level| *level == Some(true)).map_or(0, |last| last + 1)
    }
}

/// As judged from a cell and those beside it. Given are the slopes of both in X over the cells.
fn is_levelled(body: &[f64], wear: &[f64], cell: usize) -> Option<bool> {
    let (mut against, mut own) = (0.0, 0.0);
    for k in cell.saturating_sub(1).max(1)..(cell + 3).min(body.len()) {
        let bend = body[k] - body[k - 1];
        if bend.abs() > STRAIGHT * body[k].abs() {
            against -= (wear[k] - wear[k - 1]) * bend;
            own += bend * bend;
        }
    }
    (own > 0.0).then_some(against > LEVELLED * own)
}

/// ∫ ξ g' dξ over a cell of a body that is linear in X there, m².
pub(super) fn load_of_line(profile: &Profile, (x0, x1): (f64, f64)) -> f64 {
    let rise = profile.image(x1) - profile.image(x0);
    2.0 / 3.0 * rise / (x1 + x0) * (x1 * x1 + x1 * x0 + x0 * x0)
}
