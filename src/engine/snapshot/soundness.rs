//! Whether a saved state that may come from anywhere is one that a contact could be in.

use super::{Snapshot, WearSnapshot};
use crate::engine::FrettingContact;
use crate::friction::{Knot, SavedKnot, Springs};
use crate::surface::{Contact, Surface};
use crate::wear::Sliding;

/// How far what follows from other parts of a state may differ from them, relative: machines differ in the last digits of
/// their elementary functions.
const CLOSE: f64 = 1e-6;

/// Most knots of a row for each cell of the resolution, far beyond what histories leave.
const MOST_KNOTS: usize = 1000;

/// Finite and not below 0.
fn amount(value: f64) -> bool {
    value >= 0.0 && value.is_finite()
}

/// −1, 0 or 1.
fn is_sign(value: f64) -> bool {
    value == 0.0 || value.abs() == 1.0
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= CLOSE * a.abs().max(b.abs())
}

fn is_motion(sliding: Sliding) -> bool {
    match sliding {
        Sliding::Onward => true,
        Sliding::Cycles(amplitude) => amount(amplitude),
    }
}

/// A contact by itself: its numbers, not whether the surface is in it.
pub(in crate::engine) fn is_contact(contact: &Contact) -> bool {
    contact.control.is_finite() && contact.depth.is_finite() && amount(contact.radius) && amount(contact.load)
}

/// Knots from the axis outward, to the edge of the contact or, of a segment's start, as far as they reach.
fn is_row(row: &[SavedKnot], surface: &Surface, scale: f64, most: usize) -> bool {
    let rises = row.windows(2).all(|pair| pair[0].0 <= pair[1].0);
    let placed = |(x, image, origin): &SavedKnot| {
        amount(*x) && origin.is_finite() && (surface.image(*x) - image).abs() <= CLOSE * scale
    };
    row.len() <= most && rises && row.iter().all(placed) && row.first().is_none_or(|(x, ..)| *x == 0.0)
}

impl Snapshot {
    /// The first thing that is wrong with this state for a contact with `target`'s parameters.
    pub(super) fn problem(&self, target: &FrettingContact) -> Option<&'static str> {
        let resolution = target.parameters.resolution;
        let most = MOST_KNOTS * resolution;
        let numbers = self.displacement.is_finite() && is_sign(self.direction) && amount(self.work);
        if !(numbers && amount(self.reach) && self.reach >= self.contact.radius) {
            return Some("displacement, work or reach are out of range");
        }
        if !is_contact(&self.contact) {
            return Some("the contact is no contact");
        }
        let mut surface = target.surface.unworn();
        if let Some(nodes) = &self.nodes {
            if self.wear.is_none() || !nodes.is_sound(surface.profile(), resolution) {
                return Some("the worn profile is not one");
            }
            surface.set_worn(Some(nodes.clone()));
        }
        // images are compared on the scale of the largest that is of use
        let scale = surface.image(self.reach).abs().max(self.contact.depth.abs());
        if !is_row(&self.springs, &surface, scale, most) {
            return Some("springs are out of order or off the profile");
        }
        if !self.rests_on(&surface, target) {
            return Some("the contact is not that of the profile under its load");
        }
        if !self.obeys_friction(&surface, target) {
            return Some("springs reach beyond their friction bound or the contact");
        }
        let node_count = self.nodes.as_ref().map_or(0, |nodes| nodes.x().len());
        match &self.wear {
            Some(wear)
                if !wear.is_sound(node_count) || !is_row(&wear.segment_springs, &surface, scale, most) =>
            {
                Some("what is still to wear is out of range")
            }
            _ => None,
        }
    }

    /// Whether the saved contact is the one that its load makes. The radius may be uncertain where wear has left the image
    /// flat up to the edge.
    fn rests_on(&self, surface: &Surface, target: &FrettingContact) -> bool {
        let saved = &self.contact;
        let (control, scale) = (target.parameters.normal_control, target.force_scale());
        // before the first load the depth is that of first touch
        let Ok(contact) = surface.contact(control, saved.control, scale) else { return false };
        contact.is_open() == saved.is_open()
            && close(contact.depth, saved.depth)
            && close(contact.load, saved.load)
            && (contact.radius - saved.radius).abs() <= 1e-2 * contact.radius
    }

    fn obeys_friction(&self, surface: &Surface, target: &FrettingContact) -> bool {
        let Contact { depth, radius, .. } = self.contact;
        if self.contact.is_open() {
            return self.springs.is_empty();
        }
        let slope = target.bound_slope;
        let slack = CLOSE * (slope * depth.abs() + self.displacement.abs());
        let springs = Springs::from_saved(surface, &self.springs);
        let within = |knot: &Knot| {
            let bound = slope * (depth - knot.place.image).max(0.0);
            knot.place.x <= radius * (1.0 + CLOSE) && (self.displacement - knot.origin).abs() <= bound + slack
        };
        let reaches = self.springs.last().is_some_and(|(x, ..)| close(*x, radius));
        reaches && springs.knots().iter().all(within)
    }
}

impl WearSnapshot {
    fn is_sound(&self, node_count: usize) -> bool {
        let Self { pending, segment_contact, rhythm, next_step, .. } = self;
        let fields = [&pending.work_per_area, &pending.slip_path];
        let sized = |field: &&Vec<f64>| field.len() <= node_count && field.iter().all(|value| amount(*value));
        let steady = pending
            .steady
            .is_none_or(|steady| is_motion(steady.sliding) && amount(steady.amount) && amount(steady.work));
        let contacts = [segment_contact, &pending.contact];
        fields.iter().all(sized)
            && steady
            && [pending.work, pending.unplaced, pending.clipped, self.segment_work, self.transform_defect]
                .iter()
                .all(|value| amount(*value))
            && contacts.into_iter().flatten().all(is_contact)
            && self.segment_start.is_finite()
            && is_sign(self.segment_sliding)
            && rhythm.as_ref().is_none_or(|rhythm| rhythm.is_sound())
            && next_step.is_none_or(|(sliding, step)| is_motion(sliding) && amount(step))
    }
}
