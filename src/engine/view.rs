//! The worn profile as it is read between two updates: that of the last update, and on top of it
//! the wear of the backlog.

use super::FrettingContact;
use super::backlog::MOST_SCALE;
use crate::surface::{Contact, NodeTransforms, Nodes, Slopes, Surface};
use crate::wear::FirstOrderWear;
use std::cell::RefCell;
use std::sync::Arc;

/// What the last reading computed. All of it follows from the state of the contact, so a copy of a
/// contact begins without it.
#[derive(Debug, Default)]
pub(super) struct View {
    reading: RefCell<Option<Box<Reading>>>,
    slopes: RefCell<Option<Arc<Slopes>>>,
}

impl Clone for View {
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl View {
    /// Drops the slip read so far. To be called where the backlog does not just grow.
    pub(super) fn forget(&mut self) {
        if let Some(reading) = self.reading.get_mut() {
            reading.forget();
        }
    }
}

#[derive(Debug, Default)]
struct Reading {
    /// The surface of the last update.
    base: Option<Surface>,
    /// The same with nodes for the slip since then, and their transforms.
    surface: Option<Surface>,
    transforms: Option<Arc<NodeTransforms>>,
    /// Those that were made here last, kept for their memory.
    own_transforms: Option<Arc<NodeTransforms>>,
    /// Radii from which and up to which these nodes serve, m, where they do.
    span: Option<(f64, f64)>,
    /// Memory for nodes.
    nodes: Nodes,
    wear: FirstOrderWear,
    /// Depth by which the backlog has worn the nodes, m.
    depth: Vec<f64>,
    /// Work of the backlog and deferred work, J, and the contact, for which that is.
    computed_for: Option<(f64, f64, Contact)>,
}

impl Reading {
    fn forget(&mut self) {
        self.wear.clear();
        self.computed_for = None;
    }
}

impl FrettingContact {
    /// Reads the nodes of the profile and the depth (m) that the backlog adds at them, which is
    /// empty where there is no backlog. `None` where nothing has worn.
    pub(super) fn view<T>(&self, read: impl FnOnce(&Nodes, &[f64]) -> T) -> Option<T> {
        let wear = self.state.wear.as_ref()?;
        if wear.backlog.is_empty() {
            return self.surface.worn().map(|nodes| read(nodes, &[]));
        }
        let mut reading = self.view.reading.borrow_mut();
        let reading = reading.get_or_insert_default();
        let now = (wear.backlog.work, wear.deferred_work, self.state.contact);
        let same_base = reading.base.as_ref().is_some_and(|base| base.is_worn_as(&self.surface));
        if !same_base || reading.computed_for != Some(now) {
            if !same_base {
                reading.forget();
                (reading.base, reading.span) = (Some(self.surface.clone()), None);
            }
            self.compute(reading);
            reading.computed_for = Some(now);
        }
        let nodes = reading.surface.as_ref()?.worn()?;
        Some(read(nodes, &reading.depth))
    }

    /// The slope of the image at the last update up to a radius, m: many fields ask for one.
    pub(super) fn slopes(&self, end: f64) -> Arc<Slopes> {
        let mut known = self.view.slopes.borrow_mut();
        match &*known {
            Some(slopes) if slopes.serve(&self.surface, end) => slopes.clone(),
            _ => known.insert(Arc::new(Slopes::new(&self.surface, end))).clone(),
        }
    }

    fn compute(&self, reading: &mut Reading) {
        let Some(wear) = &self.state.wear else { return };
        let front = reading.wear.read(&wear.backlog);
        let span = self.span_of_slip(front, wear.backlog.radius);
        if reading.span != Some(span) {
            self.set_nodes(span, reading);
        }
        let (Some(surface), Some(transforms)) = (&reading.surface, &reading.transforms) else { return };
        let at_present = !self.state.contact.is_open() && wear.backlog.is_at(self.state.contact.depth);
        let present = at_present.then_some(&self.state.contact);
        let per_sum = self.model.constants.wear_per_work
            * self.model.constants.friction_coefficient
            * self.model.constants.normal_modulus;
        reading.wear.sum((surface, transforms), present, per_sum, &mut reading.depth);
        // as an update does: the shape of the wear, and the volume of the work
        let volume = per_sum * surface.worn().map_or(0.0, |nodes| nodes.volume(&reading.depth));
        let work = wear.backlog.work + wear.deferred_share(self.model.tuning.placed_with * wear.backlog.work);
        let scale = (self.model.constants.wear_per_work * work / volume).min(MOST_SCALE);
        let factor = if volume > 0.0 { per_sum * scale } else { 0.0 };
        reading.depth.iter_mut().for_each(|depth| *depth *= factor);
    }

    /// Radii (m) from and up to which nodes serve slip that has reached inward to an image (m) in
    /// contacts up to a radius (m). The first is a node or, on an unworn body, the end of a zone
    /// whose width is a power of two, so that nodes serve many steps.
    fn span_of_slip(&self, front: f64, radius: f64) -> (f64, f64) {
        let inner = self.radius_of_front(front, radius);
        match self.surface.worn() {
            Some(nodes) => (nodes.node_within_wear(inner), radius.max(nodes.served_radius())),
            None => {
                let outer = radius.max(self.state.reach);
                let share = (1.0 - inner / outer).clamp(f64::EPSILON, 1.0);
                (outer * (1.0 - share.log2().ceil().exp2()), outer)
            }
        }
    }

    /// Sets the present surface with nodes over a span of radii, and their transforms.
    fn set_nodes(&self, span: (f64, f64), reading: &mut Reading) {
        let (profile, nodes) = (self.surface.profile(), &mut reading.nodes);
        match self.surface.worn() {
            None => *nodes = Nodes::around(profile, self.model.parameters.resolution, span.1, span.0),
            Some(worn) => {
                nodes.copy_from(worn);
                nodes.leave_far();
                nodes.cover(profile, span);
            }
        }
        let is_new = reading.span.replace(span).is_none();
        let surface = reading.surface.get_or_insert_with(|| self.surface.unworn());
        if surface.worn().is_none_or(|worn| worn.x() != nodes.x()) {
            reading.transforms = self.memory.transforms_of(nodes);
            if reading.transforms.is_none() {
                match reading.own_transforms.as_mut().and_then(Arc::get_mut) {
                    Some(own) => own.renew(nodes.x()),
                    None => reading.own_transforms = Some(Arc::new(NodeTransforms::new(nodes.x()))),
                }
                reading.transforms.clone_from(&reading.own_transforms);
            }
        } else if !is_new {
            return;
        }
        surface.swap_worn(nodes);
        reading.wear.set_surface(surface);
    }
}
