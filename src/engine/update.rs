//! The profile brought up to date with what is pending, and the contact and the springs on it.

use super::FrettingContact;
use crate::error::Error;
use crate::friction::Springs;
use crate::surface::{FrontWay, Nodes, Surface};
use crate::wear::{self, Pending, Segment, Steady};

/// Most by which the depth of an update is scaled up to the volume that its work wears.
const MOST_SCALE: f64 = 1.5;

impl FrettingContact {
    /// Makes the nodes at the first slip; later adapts them to the contact and the front, after what is pending has
    /// been worn off on the old ones.
    pub(super) fn prepare_nodes(&mut self) -> Result<(), Error> {
        let front = self.stick_radius();
        if self.new_nodes(front, self.contact.radius).is_none() {
            return Ok(());
        }
        self.update_under_segment()?;
        // the update may have moved the nodes, too
        if let Some(nodes) = self.new_nodes(front, self.contact.radius) {
            self.move_to_nodes(nodes);
        }
        Ok(())
    }

    /// Nodes for a contact whose slip reaches inward to a front; `None` where those of the surface do.
    pub(super) fn new_nodes(&self, front: f64, radius: f64) -> Option<Nodes> {
        let profile = self.surface.profile();
        let Some(nodes) = self.surface.worn() else {
            return Some(Nodes::around(profile, self.parameters.resolution, radius.max(self.reach), front));
        };
        let mut adapted = nodes.clone();
        let way = if self.planar.is_some() { FrontWay::Creeps } else { FrontWay::Returns };
        adapted.adapt(profile, radius, (front, way));
        (adapted.x().len() != nodes.x().len()).then_some(adapted)
    }

    /// Takes over nodes that add to those of the surface without changing its shape: springs and what is pending go along.
    pub(super) fn move_to_nodes(&mut self, nodes: Nodes) {
        let old = self.surface.clone();
        self.surface.set_worn(Some(nodes));
        self.springs = self.springs.moved_to(&old, &self.surface);
        self.keep_springs_within();
        let standing = (self.bound_slope, self.place());
        if let Some(planar) = &mut self.planar {
            planar.row = planar.row.on_nodes(&self.surface, &self.contact, standing);
        }
        if let Some(wear) = &mut self.wear {
            wear.segment.unslipped = wear.segment.unslipped.moved_to(&old, &self.surface);
            if let (Some(before), Some(now)) = (old.worn(), self.surface.worn()) {
                wear.pending.moved_to(before.x(), now.x());
                wear.pending.owe((before.worn_volume() - now.worn_volume()) / self.constants.wear_per_work);
            }
        }
    }

    /// Takes springs on new nodes back to their bound; friction has taken what they lose.
    fn keep_springs_within(&mut self) {
        let energy = self.springs.energy_integral(self.displacement);
        if !self.springs.keep_within(&self.contact, self.constants.bound_slope(), self.displacement) {
            return;
        }
        let lost = energy - self.springs.energy_integral(self.displacement);
        self.lose_to_friction(self.constants.tangential_modulus * lost);
    }

    /// Counts energy (J) that springs have lost where nothing moved outside: friction has taken it. Where it has worn is not known.
    pub(super) fn lose_to_friction(&mut self, energy: f64) {
        let work = energy.max(0.0);
        self.work += work;
        if let Some(wear) = &mut self.wear {
            wear.pending.unplaced += work;
        }
    }

    /// Takes what is pending off the profile while a segment is going on.
    pub(super) fn update_under_segment(&mut self) -> Result<(), Error> {
        let segment = self.wear.as_mut().map(|wear| std::mem::take(&mut wear.segment));
        let old = self.surface.clone();
        self.update_profile()?;
        if let (Some(wear), Some(segment)) = (&mut self.wear, segment) {
            let unslipped = segment.unslipped.moved_to(&old, &self.surface);
            wear.segment = Segment { unslipped, ..segment };
        }
        Ok(())
    }

    /// Takes what is pending off the profile and lets the contact settle at the present load and displacement.
    pub(super) fn update_profile(&mut self) -> Result<(), Error> {
        let old = self.surface.clone();
        let zone = self.springs.slip_zone(&self.contact, self.constants.bound_slope(), self.displacement);
        let steady = self.take_pending_steady();
        let lived = match steady {
            None => false,
            Some(steady) => self.live_through(steady)?,
        };
        if !lived && !self.update_surface()? {
            return Ok(());
        }
        self.rest_on_new_surface(&old, zone)?;
        self.start_segment();
        Ok(())
    }

    pub(super) fn take_pending_steady(&mut self) -> Option<Steady> {
        self.wear.as_mut().and_then(|wear| wear.pending.steady.take())
    }

    /// Takes what is pending of unsteady motion off the surface; says whether there was any.
    pub(super) fn update_surface(&mut self) -> Result<bool, Error> {
        self.thin_nodes();
        let Some((worn_image, depth)) = self.pending_image()? else { return Ok(false) };
        let Some(mut nodes) = self.surface.worn().cloned() else { return Ok(false) };
        nodes.set_worn(worn_image, depth, self.surface.profile());
        self.surface.set_worn(Some(nodes));
        self.counters.descent_transforms += 1;
        self.counters.profile_updates += 1;
        if let Some(wear) = &mut self.wear {
            let Pending { clipped, unplaced, .. } = wear.pending;
            wear.pending = Pending { clipped, unplaced, ..Pending::default() };
        }
        Ok(true)
    }

    /// Leaves out nodes that the profile no longer needs, before an update, after which the contact is found anew.
    fn thin_nodes(&mut self) {
        let (Some(wear), Some(nodes)) = (&mut self.wear, self.surface.worn()) else { return };
        let Some(contact) = wear.pending.contact else { return };
        let volume = nodes.worn_volume();
        let mut left = nodes.mesh().map(|_| {
            let (transforms, made) = wear.transforms.get(nodes);
            self.counters.transform_tables += u64::from(made);
            self.counters.descent_transforms += 1;
            nodes.without_mesh(transforms.descend(nodes.worn_image()))
        });
        let present = left.as_ref().unwrap_or(nodes);
        if let Some(spread) = present.spread_at_rim(contact.depth, self.surface.profile()) {
            wear.pending.moved_to(present.x(), spread.x());
            left = Some(spread);
        }
        let share = wear::THINNING * self.parameters.tolerance;
        let present = left.as_ref().unwrap_or(nodes);
        if let Some(thinned) = present.thinned(share, contact.radius, self.surface.profile()) {
            wear.pending.moved_to(present.x(), thinned.x());
            left = Some(thinned);
        }
        if let Some(left) = left {
            wear.pending.owe((volume - left.worn_volume()) / self.constants.wear_per_work);
            self.surface.set_worn(Some(left));
        }
    }

    /// Contact and springs on a surface that has worn at the present load and displacement, where the springs of a zone
    /// (its inner radius and side) slipped.
    fn rest_on_new_surface(&mut self, old: &Surface, zone: (f64, f64)) -> Result<(), Error> {
        let to = self.contact_at(self.contact.control)?;
        if self.planar.is_some() {
            self.rest_in_plane(to);
            return Ok(());
        }
        let moved = self.springs.moved_to(old, &self.surface);
        let path = self.path_to(to, self.displacement);
        let (mut springs, _) = moved.walk(&path, Springs::default());
        // it wore while these springs slipped: in truth they have followed their bound, up or down, all the time
        if zone.1 != 0.0 && !to.is_open() {
            springs.follow_bound(zone, &to, self.constants.bound_slope(), self.displacement);
        }
        let energy = |row: &Springs| row.energy_integral(self.displacement);
        let lost = self.constants.tangential_modulus * (energy(&self.springs) - energy(&springs));
        self.springs = springs;
        self.contact = to;
        self.reach = self.reach.max(to.radius);
        self.lose_to_friction(lost);
        Ok(())
    }

    /// Image of the wear and depth at the nodes with what is pending taken off; `None` if nothing is.
    fn pending_image(&mut self) -> Result<Option<Worn>, Error> {
        let (Some(wear), Some(nodes)) = (&mut self.wear, self.surface.worn()) else { return Ok(None) };
        if wear.pending.is_empty() {
            return Ok(None);
        }
        let (transforms, made) = wear.transforms.get(nodes);
        self.counters.transform_tables += u64::from(made);
        let update = wear::worn_depth(
            &self.surface,
            &transforms,
            &wear.pending,
            self.parameters.normal_control,
            &self.constants,
        )?;
        self.counters.descent_transforms += update.iterations;
        self.counters.pressure_transforms += update.iterations;
        if !update.followed {
            return Err(Error::WearOutrun { from: wear.segment.start, displacement: self.displacement });
        }
        let mut depth = update.depth;
        let mut change = transforms.ascend(&depth);
        // what the springs dissipated is exact for the frozen profile: the update keeps its shape and takes that volume
        let volume = nodes.volume(&depth);
        let target = self.constants.wear_per_work * wear.pending.work;
        let scale = if volume > 0.0 { (target / volume).min(MOST_SCALE) } else { 0.0 };
        wear.pending.unplaced += (target - scale * volume) / self.constants.wear_per_work;
        depth.iter_mut().chain(&mut change).for_each(|value| *value *= scale);
        let sum = |old: &[f64], new: &[f64]| old.iter().zip(new).map(|(old, new)| old + new).collect();
        Ok(Some((sum(nodes.worn_image(), &change), sum(nodes.depth(), &depth))))
    }
}

/// Image of the wear and depth at the nodes, m.
type Worn = (Vec<f64>, Vec<f64>);
