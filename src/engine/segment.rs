//! Segments: stretches of a history in which slip goes one way, gathered until the profile has to follow.

use super::FrettingContact;
use crate::error::Error;
use crate::surface::Contact;
use crate::wear::{self, Edge, Segment, Sliding, Steady};

impl FrettingContact {
    /// Adds a path to the segment: springs that touch along it, and its work.
    pub(super) fn extend_segment(&mut self, to: &Contact, displacement: f64, work: f64) {
        let from = self.contact;
        if from.is_open() && to.is_open() {
            // in the air only the place changes from which a segment will begin
            if let Some(wear) = &mut self.wear {
                wear.segment.start = displacement;
            }
            return;
        }
        let touched = (to.radius != from.radius).then(|| {
            let path = self.path_to(*to, displacement);
            self.wear.as_ref().map(|wear| wear.segment.unslipped.touched(&path))
        });
        if to.is_open() && work > 0.0 && self.wear.as_ref().is_some_and(|wear| wear.pending.is_empty()) {
            // the last slip before the bodies part, with the pressure that it began with
            let limit = self.constants.friction_coefficient * self.normal_reaction();
            let path = if limit > 0.0 { work / limit } else { (displacement - self.displacement).abs() };
            self.spread(Steady { sliding: Sliding::Onward, amount: path, work, repeated: false });
        } else if let (true, Some(wear)) = (to.is_open(), &mut self.wear) {
            wear.pending.add_work(work);
        }
        let Some(wear) = &mut self.wear else { return };
        if let Some(Some(unslipped)) = touched {
            wear.segment.unslipped = unslipped;
        }
        wear.segment.contact.get_or_insert(if from.is_open() { *to } else { from });
        if !to.is_open() {
            wear.segment.work += work;
        }
    }

    /// At a reversal: closes the segment and updates the profile if the next segment, taken to be like this one, would
    /// wear too much. Here all slipping springs are at their bound on one side; an update between two reversals would
    /// let the inner ones, which still hold the last direction, slip against the outer ones.
    pub(super) fn turn(&mut self) -> Result<(), Error> {
        let last = self.wear.as_ref().map_or(0.0, |wear| wear.segment.work);
        if self.is_beyond_the_profile(last) {
            if let Some(wear) = &mut self.wear {
                wear.pending.add_work(last);
            }
            self.start_segment();
            return Ok(());
        }
        let limit = self.update_limit();
        let candidate = self.steady_segment();
        match candidate {
            Some(steady) if self.is_steady(&steady) => self.add_steady(steady)?,
            // it may be the first of many
            Some(_) => self.close_segment()?,
            None => {
                self.set_rhythm(None);
                self.close_segment()?;
            }
        }
        if self.constants.wear_per_work * (self.pending_work() + last) > limit {
            let followed =
                self.wear.as_ref().is_some_and(|wear| wear.pending.steady.is_some_and(|s| s.repeated));
            let stick =
                self.springs.stick_radius(&self.contact, self.constants.bound_slope(), self.displacement);
            let drive = match candidate {
                Some(Steady { sliding: Sliding::Cycles(own), .. }) if followed => self.drive_amplitude(own),
                _ => 0.0,
            };
            self.update_profile()?;
            match candidate {
                Some(Steady { sliding: Sliding::Cycles(amplitude), .. }) if followed => {
                    let own = self.own_amplitude(drive);
                    self.displacement += self.direction * (own - amplitude);
                    self.rest_at_reversal(own, stick);
                }
                Some(Steady { sliding: Sliding::Cycles(amplitude), .. }) => {
                    self.expect_cycles(amplitude);
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// Closes the segment and brings the profile up to date.
    pub(super) fn settle(&mut self) -> Result<(), Error> {
        if self.planar.is_some() {
            return self.settle_in_plane();
        }
        let begun = match self.begun_half_cycle() {
            None => self.steady_segment(),
            begun => begun,
        };
        match begun {
            Some(steady) if self.is_steady(&steady) => self.add_steady(steady)?,
            _ => self.close_segment()?,
        }
        self.update_profile()
    }

    /// Turns the slip since the segment's start into work per area and slip path at the nodes.
    pub(super) fn close_segment(&mut self) -> Result<(), Error> {
        let Some(wear) = &self.wear else { return Ok(()) };
        if wear.segment.work > 0.0 {
            match wear.pending.steady {
                Some(steady) if !steady.repeated => {
                    self.take_pending_steady();
                    self.spread(steady);
                }
                Some(_) => self.update_under_segment()?,
                None => {}
            }
            self.prepare_nodes()?;
            let (Some(wear), Some(nodes)) = (&mut self.wear, self.surface.worn()) else { return Ok(()) };
            let mut edge = Edge::new(nodes, &self.contact, self.surface.profile().outer_radius());
            let start = wear.segment.contact.unwrap_or(self.contact);
            if start.radius > self.contact.radius {
                edge = Edge::new(nodes, &start, self.surface.profile().outer_radius());
            }
            let (deflection, slip) = wear::segment_fields(
                &self.surface,
                nodes,
                &wear.segment,
                (&self.springs, &self.contact, self.displacement),
                &self.constants,
            );
            if slip.iter().any(|s| *s != 0.0) {
                let (transforms, made) = wear.transforms.get(nodes);
                let mut traction = wear::pressure_nodes(&transforms, nodes.x(), &deflection, &edge);
                traction.iter_mut().for_each(|t| *t *= self.constants.tangential_modulus);
                let surface_slip = transforms.descend(&slip);
                let largest = if start.radius > self.contact.radius { start } else { self.contact };
                wear.transform_defect +=
                    wear.pending.add(nodes, &largest, (&traction, &surface_slip), wear.segment.work, 1.25);
                self.counters.transform_tables += u64::from(made);
                self.counters.pressure_transforms += 1;
                self.counters.descent_transforms += 1;
            } else {
                wear.pending.add_work(wear.segment.work);
            }
        }
        self.start_segment();
        Ok(())
    }

    pub(super) fn start_segment(&mut self) {
        if self.wear.is_none() {
            return;
        }
        let contact = (!self.contact.is_open()).then_some(self.contact);
        if self.planar.is_some() {
            return self.start_segment_in_plane(contact);
        }
        let (inner, side) =
            self.springs.slip_zone(&self.contact, self.constants.bound_slope(), self.displacement);
        let sliding = if inner == 0.0 { side } else { 0.0 };
        if let Some(wear) = &mut self.wear {
            let mut unslipped = std::mem::take(&mut wear.segment.unslipped);
            unslipped.copy_from(&self.springs);
            wear.segment = Segment { unslipped, contact, start: self.displacement, sliding, work: 0.0 };
        }
    }

    /// Work whose wear is still to be taken off, J.
    pub(super) fn pending_work(&self) -> f64 {
        let Some(wear) = &self.wear else { return 0.0 };
        wear.pending.work + wear.pending.steady.map_or(0.0, |steady| steady.work)
    }

    /// Volume that may wear before the profile is updated, m³.
    pub(super) fn update_limit(&self) -> f64 {
        let mut inner = self.stick_radius();
        if let (Some(wear), Some(nodes)) = (&self.wear, self.surface.worn())
            && let Some(first) = wear.pending.slip_path.iter().position(|s| *s > 0.0)
        {
            inner = inner.min(nodes.x()[first]);
        }
        wear::update_limit(self.parameters.tolerance, &self.surface, &self.contact, inner)
    }

    /// Whether the wear of so little work (J), with that which has found no place yet, is lost in the rounding of the profile.
    pub(super) fn is_beyond_the_profile(&self, work: f64) -> bool {
        let unplaced = self.wear.as_ref().map_or(0.0, |wear| wear.pending.unplaced);
        let disc = wear::annulus(&self.contact, 0.0);
        self.constants.wear_per_work * (work + unplaced) <= f64::EPSILON * disc * self.contact.depth.abs()
    }
}
