//! The wear of a backlog as it is read between two updates: under the pressure of the profile as it
//! is, and relieved where that changes within a short way.

use super::backlog::{SlipAtDepth, WearBacklog};
use super::edge::{Edge, pressure_nodes_into};
use crate::parameters::NormalControl;
use crate::surface::{Contact, NodeTransforms, Nodes, Surface};
use std::ops::Range;

/// The wear of the slip under one depth.
#[derive(Debug, Default)]
struct LevelWear {
    bin: i32,
    /// Σ ∫ e dx of the slip in the law, m².
    slip: f64,
    law: SlipAtDepth,
    contact: Option<Contact>,
    /// Whether that is the contact of the state, which was not found on the nodes of a reading.
    is_present: bool,
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
    /// Length of the slip path at the nodes, m.
    path: Vec<f64>,
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

    /// Counts the images of another surface from now on.
    pub(crate) fn set_surface(&mut self, surface: &Surface) {
        self.images.clear();
        let x = surface.worn().map_or(&[][..], |nodes| nodes.x());
        self.images.extend(x.iter().map(|x| surface.image(*x)));
        self.levels.iter_mut().for_each(|level| (level.contact, level.is_stale) = (None, true));
    }

    /// Writes Σ p s / E* (m) at the nodes of the surface, relieved with the stiffness κE* of a slip
    /// path. `present` is the contact of a backlog under one depth. Depths at which the profile
    /// carries no contact are left out.
    pub(crate) fn sum(
        &mut self,
        (surface, transforms): (&Surface, &NodeTransforms),
        present: Option<&Contact>,
        stiffness: f64,
        sum: &mut Vec<f64>,
    ) {
        for field in [&mut *sum, &mut self.path] {
            field.clear();
            field.resize(self.images.len(), 0.0);
        }
        let Some(nodes) = surface.worn() else { return };
        for level in &mut self.levels {
            let depth = level.law.depth;
            let contact = match (present, level.contact) {
                (Some(present), _) => Some(*present),
                (None, Some(known)) if known.control == depth && !level.is_present => Some(known),
                _ => surface.contact(NormalControl::Indentation, depth, 1.0).ok(),
            };
            let Some(contact) = contact.filter(|contact| !contact.is_open()) else { continue };
            level.is_present = present.is_some();
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
            for i in level.slipped.clone() {
                let path = level.path[i].max(0.0);
                sum[i] += level.pressure[i] * path;
                self.path[i] += path;
            }
        }
        // nothing heals where a pressure overshoots
        sum.iter_mut().for_each(|sum| *sum = sum.max(0.0));
        self.relieve(nodes, stiffness, nodes.reach_rim(surface.profile()), sum);
    }

    /// Takes a field at the nodes to its mean over rings of twice the width κE* B, B being the
    /// longest slip path up to there: wear of the wave number k relieves the pressure that brings
    /// it by 1/(1 + κE* B k). Without that a wall of the image or a sharp rim, where the pressure
    /// is infinite, would read a depth of many times that after an update. No ring is wider than
    /// the way to either end of what slips, but at the axis and at the rim of a body that ends
    /// there.
    fn relieve(&mut self, nodes: &Nodes, stiffness: f64, has_rim: bool, field: &mut [f64]) {
        let (x, last) = (nodes.x(), nodes.last());
        let slips = |path: &f64| *path > 0.0;
        let Some(first) = self.path.iter().position(slips) else { return };
        let end = self.path.iter().rposition(slips).unwrap_or(last);
        // the field is linear in x²: its integral up to each node, and up to any radius
        let area = |a: f64, b: f64| (b - a) * (b + a);
        let (before, values) = (&mut self.buffer, &mut self.values);
        before.clear();
        before.extend_from_slice(field);
        values.clear();
        values.push(0.0);
        for j in 0..last {
            values.push(values[j] + 0.5 * area(x[j], x[j + 1]) * (field[j] + field[j + 1]));
        }
        let integral = |r: f64, j: &mut usize| {
            while x[*j] > r {
                *j -= 1;
            }
            while *j + 1 < last && x[*j + 1] < r {
                *j += 1;
            }
            let (start, next) = (before[*j], before[*j + 1]);
            let part = area(x[*j], r);
            values[*j] + part * (start + 0.5 * part / area(x[*j], x[*j + 1]) * (next - start))
        };
        let (mut inner_cell, mut outer_cell, mut longest) = (0, 0, 0.0f64);
        for i in first..=end {
            let to_front = if first > 0 { x[i] - x[first] } else { f64::INFINITY };
            let to_edge = if has_rim && end == last { f64::INFINITY } else { x[end] - x[i] };
            longest = longest.max(self.path[i]);
            let half = (stiffness * longest).min(to_front).min(to_edge);
            let (inner, outer) = ((x[i] - half).max(0.0), (x[i] + half).min(x[last]));
            if outer > inner {
                let integrals = [integral(inner, &mut inner_cell), integral(outer, &mut outer_cell)];
                field[i] = (integrals[1] - integrals[0]) / area(inner, outer);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A field at nodes that have all slipped alike, relieved over a width of their own.
    fn relieved(x: &[f64], field: impl Fn(f64) -> f64, width: f64) -> Vec<f64> {
        let count = x.len();
        let nodes = Nodes::holding((x.to_vec(), vec![0.0; count], vec![0.0; count]), 64, None);
        let mut wear = FirstOrderWear { path: vec![width; count], ..FirstOrderWear::default() };
        let mut field: Vec<f64> = x.iter().map(|x| field(*x)).collect();
        wear.relieve(&nodes, 1.0, true, &mut field);
        field
    }

    /// Cells that shrink by a quarter each towards the end of a unit radius.
    fn graded() -> Vec<f64> {
        let mut x: Vec<f64> = (0..100).map(|k| 0.01 * f64::from(k)).collect();
        x.extend((0..60).map(|k| 1.0 - 0.01 * 0.75f64.powi(k + 1)));
        x.push(1.0);
        x
    }

    #[test]
    fn a_singular_rim_comes_to_its_mean_over_what_wear_relieves() {
        for width in [1e-2, 1e-3, 1e-4] {
            let singular = |x: f64| 1.0 / (1.0 - x).max(1e-9).sqrt();
            let most = relieved(&graded(), singular, width).into_iter().fold(0.0, f64::max);
            // the mean of 1/√δ from 0 to the width
            assert!((most * width.sqrt() / 2.0 - 1.0).abs() < 0.02, "{width:e}: {most:e}");
        }
    }

    #[test]
    fn what_is_smooth_stays_and_a_spike_keeps_its_volume() {
        let x = graded();
        let smooth = relieved(&x, |x| 1.0 + x * x, 1e-3);
        assert!(x.iter().zip(&smooth).all(|(x, w)| (w / (1.0 + x * x) - 1.0).abs() < 2e-3));
        // one node of a hundred, over half of a cell on either side
        let spike = |at: f64| move |x: f64| if (x - at).abs() < 1e-9 { 1.0 } else { 0.0 };
        let spread = relieved(&x, spike(0.5), 0.05);
        let volume = |field: &[f64]| -> f64 {
            let cells = x.windows(2).zip(field.windows(2));
            cells.map(|(x, w)| 0.5 * (x[1] * x[1] - x[0] * x[0]) * (w[0] + w[1])).sum()
        };
        let whole: Vec<f64> = x.iter().map(|x| spike(0.5)(*x)).collect();
        assert!((spread[50] - 0.1).abs() < 5e-3, "{}", spread[50]);
        assert!((volume(&spread) / volume(&whole) - 1.0).abs() < 1e-2, "{:e}", volume(&spread));
    }
}
