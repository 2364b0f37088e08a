//! Whether a saved state that may come from anywhere is one that a contact could be in.

use super::Snapshot;
use crate::engine::state::WearState;
use crate::engine::{FrettingContact, ROUNDING};
use crate::friction::Row;
use crate::range;
use crate::surface::{Contact, Place, Surface};
use crate::wear::Sliding;
use nalgebra::Vector2;

/// How far what follows from other parts of a state may differ from them, relative: machines differ
/// in the last digits of their elementary functions.
pub(crate) const CLOSE: f64 = 1e-6;

/// Most knots of a row for each cell of the resolution, far beyond what histories leave.
const MOST_KNOTS: usize = 1000;

/// Finite and not below 0.
fn amount(value: f64) -> bool {
    value >= 0.0 && value.is_finite()
}

/// A unit vector, or 0.
fn is_direction(vector: Vector2<f64>) -> bool {
    vector == Vector2::zeros() || close(vector.x.hypot(vector.y), 1.0)
}

fn close(a: f64, b: f64) -> bool {
    near(a, b, a.abs().max(b.abs()))
}

/// Near to each other on a scale. What has overflowed in both is the same.
fn near(a: f64, b: f64, scale: f64) -> bool {
    a == b || ((a - b).is_finite() && (a - b).abs() <= CLOSE * scale)
}

fn is_motion(sliding: Sliding) -> bool {
    match sliding {
        Sliding::Onward => true,
        Sliding::Cycles(amplitude) => amount(amplitude),
    }
}

/// A contact by itself: its numbers, not whether the surface is in it.
fn is_contact(contact: &Contact) -> bool {
    contact.control.is_finite() && contact.depth.is_finite() && amount(contact.radius) && amount(contact.load)
}

/// Whether a place lies on the surface, except for rounding: also of its radius, for behind a front
/// the image rises in a cell that may be as narrow as 1e-12 of that.
fn is_placed(place: &Place, surface: &Surface, outermost: &Place) -> bool {
    let Place { x, image, load, square } = *place;
    let on = surface.place(x);
    let beside = [1.0 - ROUNDING, 1.0 + ROUNDING].map(|factor| surface.image(factor * x));
    // `clamp` would panic at what is no number
    let nearest = image.max(beside[0].min(beside[1])).min(beside[0].max(beside[1]));
    amount(x)
        && x <= outermost.x * (1.0 + CLOSE)
        && (near(on.image, image, outermost.image) || near(nearest, image, outermost.image))
        && near(on.load, load, outermost.load)
        && near(on.square, square, outermost.square)
}

impl Snapshot {
    /// The first thing that is wrong with this state for a contact with `target`'s parameters.
    pub(super) fn problem(&self, target: &FrettingContact) -> Option<&'static str> {
        let resolution = target.model.parameters.resolution;
        let most = MOST_KNOTS * resolution;
        let numbers = amount(self.state.reach)
            && self.state.place.iter().all(|part| part.is_finite())
            && is_direction(self.state.direction)
            && amount(self.state.work)
            && self.state.former.volumes.iter().all(|volume| amount(*volume))
            && amount(self.state.former.work)
            && self.state.former.work <= self.state.work;
        if !(numbers
            && self.state.reach >= self.state.contact.radius
            && self.state.reach <= target.surface.profile().outer_radius()
            && range::contact(self.state.reach, 0.0, 0.0, 0.0).is_ok())
        {
            return Some("displacement, direction, work or reach are out of range");
        }
        if !self.state.stroke.is_sound(most) {
            return Some("the springs at the last reversal are out of order");
        }
        if !self.state.coating.is_sound() {
            return Some("the cycles at which the coating wore through are out of range");
        }
        if !is_contact(&self.state.contact) {
            return Some("the contact is no contact");
        }
        let mut surface = target.surface.unworn();
        if let Some(nodes) = &self.nodes {
            let checked = nodes.checked(surface.profile(), resolution);
            if self.state.wear.is_none() || checked.is_none() {
                return Some("the worn profile is not one");
            }
            surface.set_worn(checked);
        }
        let mut outermost = surface.place(self.state.reach);
        let Contact { depth, load, .. } = self.state.contact;
        outermost.image = outermost.image.abs().max(depth.abs());
        outermost.load = outermost.load.abs().max(load);
        outermost.square = outermost.square.abs().max(depth * depth * self.state.reach);
        if !self.has_springs_on(&surface, &outermost, most) {
            return Some("springs are out of order or off the profile");
        }
        if !self.rests_on(&surface, target) {
            return Some("the contact is not that of the profile under its load");
        }
        if !self.obeys_friction(target) {
            return Some("springs reach beyond their friction bound or the contact");
        }
        match &self.state.wear {
            Some(wear) if !wear.is_sound(self.state.reach) => Some("what is still to wear is out of range"),
            _ => None,
        }
    }

    /// Whether the saved contact is the one that its load makes. The radius may be uncertain where
    /// wear has left the image flat up to the edge, and both radius and depth where the load is
    /// next to none.
    fn rests_on(&self, surface: &Surface, target: &FrettingContact) -> bool {
        let saved = &self.state.contact;
        let (control, scale) = (target.model.parameters.normal_control, target.force_scale());
        // before the first load the depth is that of first touch
        let Ok(contact) = surface.contact(control, saved.control, scale) else { return false };
        // the search for a depth next to none ends in the rounding of this
        let least_depth = CLOSE * surface.place(self.state.reach).image.abs();
        let scale = contact.depth.abs().max(saved.depth.abs()).max(least_depth);
        contact.is_open() == saved.is_open()
            && near(contact.depth, saved.depth, scale)
            && close(contact.load, saved.load)
            && (contact.radius - saved.radius).abs() <= 1e-2 * contact.radius + CLOSE * self.state.reach
    }

    /// Whether the springs go from the axis outward. They lie on the surface, but for rounding, on
    /// the scale of its values at the outermost radius that counts.
    fn has_springs_on(&self, surface: &Surface, outermost: &Place, most: usize) -> bool {
        let springs: Vec<_> = self.state.row.origins(0.0).collect();
        let placed = |(place, origin): &(&Place, Vector2<f64>)| {
            origin.iter().all(|part| part.is_finite()) && is_placed(place, surface, outermost)
        };
        let is_row = match &self.state.row {
            Row::Line(_) => true,
            Row::Plane(row) => {
                let has_moved = self.state.direction != Vector2::zeros();
                row.is_spaced() && has_moved && !self.state.contact.is_open()
            }
        };
        is_row
            && springs.len() <= most
            && springs.windows(2).all(|pair| pair[0].0.x <= pair[1].0.x)
            && springs.first().is_none_or(|(place, _)| place.x == 0.0)
            && springs.iter().all(placed)
    }

    /// Whether the springs reach to the edge of the contact, and none is beyond its bound.
    fn obeys_friction(&self, target: &FrettingContact) -> bool {
        let Contact { depth, radius, .. } = self.state.contact;
        let here = target.model.axes.for_springs(self.state.place);
        let mut springs = self.state.row.origins(here.y);
        if self.state.contact.is_open() {
            return springs.next().is_none();
        }
        let slope = target.bound_slope_after(self.state.work);
        let aside = if self.state.row.is_plane() { here.y.abs() } else { 0.0 };
        let slack = CLOSE * (slope * depth.abs() + here.x.abs() + aside);
        let mut edge = f64::NAN;
        let within = springs.all(|(place, origin)| {
            edge = place.x;
            let bound = slope * (depth - place.image).max(0.0);
            let [x, y] = (here - origin).into();
            place.x <= radius * (1.0 + CLOSE) && x.hypot(y) <= bound + slack
        });
        within && close(edge, radius)
    }
}

impl WearState {
    /// Whether these are numbers of a contact that was no larger than a radius, m.
    fn is_sound(&self, reach: f64) -> bool {
        self.backlog.is_sound()
            && self.backlog.radius <= reach
            && self.slip_direction.iter().all(|value| value.is_finite())
            && self.deferred_work.is_finite()
            && amount(self.surplus)
            && [self.limit, self.defect, self.clipped].iter().all(|value| amount(*value))
            && self.next_step.is_none_or(|(sliding, step)| is_motion(sliding) && amount(step))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slip_has_a_finite_direction_in_a_contact_no_larger_than_the_largest() {
        let mut wear = WearState::default();
        wear.backlog.radius = 1.0;
        assert!(wear.is_sound(1.0) && !wear.is_sound(0.99));
        for value in [f64::NAN, f64::INFINITY] {
            for slip_direction in [Vector2::new(value, 0.0), Vector2::new(0.0, value)] {
                assert!(!WearState { slip_direction, ..wear.clone() }.is_sound(1.0), "{slip_direction}");
            }
        }
    }

    #[test]
    fn what_has_overflowed_is_close_to_itself_alone() {
        assert!(close(1.0, 1.0 + 0.1 * CLOSE) && close(f64::INFINITY, f64::INFINITY));
        for other in [1.0, 0.0, f64::MAX, f64::NEG_INFINITY, f64::NAN] {
            assert!(!close(f64::INFINITY, other) && !close(other, f64::INFINITY), "{other}");
        }
    }
}
