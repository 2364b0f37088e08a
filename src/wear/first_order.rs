//! The wear of a backlog to first order: under the pressure of the profile as it is, without the
//! relief that the wear itself brings.

use super::backlog::{SlipAtDepth, WearBacklog};
use super::edge::{Edge, pressure_nodes_into};
use crate::parameters::NormalControl;
use crate::surface::{Contact, NodeTransforms, Surface};
use std::ops::Range;

/// The wear of the slip under one depth.
#[derive(Debug, Default)]
struct LevelWear {
    bin: i32,
    /// Σ ∫ e dx of the slip in the law, m².
    slip: f64,
    law: SlipAtDepth,
    contact: Option<Contact>,
    /// Pressure at the nodes inside the contact, over E*, from one of them on.
    pressure: Vec<f64>,
    first: usize,
    /// Slip path (m) at the nodes that have slipped inside the contact.
    path: Vec<f64>,
    slipped: Range<usize>,
    is_stale: bool,
}

/// Σ p s over the depths of a backlog. What has not changed between two readings is kept.
#[derive(Debug, Default)]
pub(crate) struct FirstOrderWear {
    levels: Vec<LevelWear>,
    /// Levels whose memory is free.
    spare: Vec<LevelWear>,
    /// Image at the nodes, m.
    images: Vec<f64>,
    values: Vec<f64>,
    buffer: Vec<f64>,
}

impl FirstOrderWear {
    /// Forgets the slip.
    pub(crate) fn clear(&mut self) {
        self.spare.append(&mut self.levels);
    }

    /// Takes the slip of a backlog, which has only grown since the last call. Returns the image (m)
    /// of the innermost spring that has slipped.
    pub(crate) fn read(&mut self, backlog: &WearBacklog) -> f64 {
        let mut front = f64::INFINITY;
        for (k, (level, hinges)) in backlog.levels().enumerate() {
            if self.levels.get(k).is_none_or(|known| known.bin != level.bin) {
                let mut new = self.spare.pop().unwrap_or_default();
                (new.bin, new.slip, new.contact, new.is_stale) = (level.bin, 0.0, None, true);
                self.levels.insert(k, new);
            }
            let known = &mut self.levels[k];
            if known.slip != level.slip {
                (known.slip, known.is_stale) = (level.slip, true);
                backlog.law_into((level, hinges), &mut known.law);
            }
            front = front.min(known.law.front());
        }
        front
    }

    /// The largest of the depths under which springs have slipped, m.
    pub(crate) fn deepest(&self) -> f64 {
        self.levels.iter().map(|level| level.law.depth).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Counts the images of another surface from now on.
    pub(crate) fn set_surface(&mut self, surface: &Surface) {
        self.images.clear();
        let x = surface.worn().map_or(&[][..], |nodes| nodes.x());
        self.images.extend(x.iter().map(|x| surface.image(*x)));
        self.levels.iter_mut().for_each(|level| (level.contact, level.is_stale) = (None, true));
    }

    /// Writes Σ p s / E* (m) at the nodes of the surface. `present` is the contact of a backlog
    /// under one depth. Depths at which the profile carries no contact are left out.
    pub(crate) fn sum(
        &mut self,
        (surface, transforms): (&Surface, &NodeTransforms),
        present: Option<&Contact>,
        sum: &mut Vec<f64>,
    ) {
        sum.clear();
        sum.resize(self.images.len(), 0.0);
        let Some(nodes) = surface.worn() else { return };
        for level in &mut self.levels {
            let depth = level.law.depth;
            let contact = match (present, level.contact) {
                (Some(present), _) => Some(*present),
                (None, Some(known)) if known.control == depth => Some(known),
                _ => surface.contact(NormalControl::Indentation, depth, 1.0).ok(),
            };
            let Some(contact) = contact.filter(|contact| !contact.is_open()) else { continue };
            let is_moved = level.contact != Some(contact);
            if is_moved || level.is_stale {
                let edge = Edge::new(nodes, &[], &contact, surface.profile().outer_radius());
                let inside = &self.images[..=edge.last];
                self.values.clear();
                // springs out of contact have gone along with the body, as those at the edge have
                self.values.extend(level.law.along(inside.iter().map(|g| g.min(contact.depth))));
                let axis = self.values[0];
                let front = self.values.iter().position(|slip| *slip != axis).unwrap_or(inside.len());
                level.path.clear();
                level.path.resize(front, axis);
                transforms.inverse_abel_at(
                    front..inside.len(),
                    &self.values,
                    &mut level.path,
                    &mut self.buffer,
                );
                level.slipped = if axis > 0.0 { 0 } else { front }..inside.len();
                if is_moved || level.slipped.start < level.first {
                    level.first = level.slipped.start;
                    self.values.clear();
                    self.values.extend(inside.iter().map(|g| (contact.depth - g).max(0.0)));
                    let memory = (&mut level.pressure, &mut self.buffer);
                    let nodes = (nodes.x(), level.first);
                    pressure_nodes_into(transforms, nodes, (&mut self.values, &edge), memory);
                }
                (level.contact, level.is_stale) = (Some(contact), false);
            }
            let fields = level.pressure.iter().zip(&level.path);
            for (sum, (pressure, path)) in
                sum.iter_mut().zip(fields).take(level.slipped.end).skip(level.slipped.start)
            {
                *sum += pressure * path.max(0.0);
            }
        }
        // nothing heals where a pressure overshoots
        sum.iter_mut().for_each(|sum| *sum = sum.max(0.0));
    }
}
