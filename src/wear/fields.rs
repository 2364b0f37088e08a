//! A slip law as fields at the nodes of a surface.

use super::edge::{Edge, pressure_nodes};
use super::{Constants, SlipAtDepth};
use crate::error::Error;
use crate::parameters::NormalControl;
use crate::surface::{Contact, NodeTransforms, Nodes, Surface};

/// What slip has done to a surface since its profile was last updated.
#[derive(Debug, Clone)]
pub(crate) struct SlipFields {
    /// Work of friction per area at each node, J/m².
    pub(crate) work_per_area: Vec<f64>,
    /// Length of the slip path at each node, m.
    pub(crate) slip_path: Vec<f64>,
    /// The largest contact that has slipped: the one whose pressure the wear relieves.
    pub(crate) contact: Contact,
    /// Work left out since its sign would heal the surface, J.
    pub(crate) clipped: f64,
    /// Difference between the work at the nodes and that of the springs, J.
    pub(crate) defect: f64,
    /// Transforms of either kind.
    pub(crate) transforms: u64,
}

impl SlipFields {
    /// Fields of a slip law whose springs did friction work, J: A = Σ μ p(r; d_b) s_b and B = Σ s_b
    /// with s_b = D\[E_b\], over the depths d_b of the law. The work at the nodes is scaled to that
    /// of the springs, which is exact; it is 0 where what slips has worn free.
    ///
    /// # Errors
    /// Those of the normal contact.
    pub(crate) fn of_law(
        (surface, nodes): (&Surface, &Nodes),
        transforms: &NodeTransforms,
        (law, work): (&[SlipAtDepth], f64),
        constants: &Constants,
    ) -> Result<Self, Error> {
        let images: Vec<f64> = nodes.x().iter().map(|x| surface.image(*x)).collect();
        let (mut fields, mut found) = (Self::none(nodes.x().len()), 0.0);
        for law in law {
            let contact = surface.contact(NormalControl::Indentation, law.depth, 1.0)?;
            if contact.is_open() {
                continue;
            }
            // of a body that ends at its rim all have one radius
            if contact.depth > fields.contact.depth || fields.contact.is_open() {
                fields.contact = contact;
            }
            found += fields.add(surface, nodes, transforms, (law, &images, &contact), constants);
        }
        if constants.force_control {
            fields.contact.control = fields.contact.load;
        }
        let share = if found > 0.0 { work / found } else { 0.0 };
        fields.work_per_area.iter_mut().for_each(|gain| *gain *= share);
        fields.defect = (found - work).abs();
        Ok(fields)
    }

    /// Whether anything slips.
    pub(crate) fn slip(&self) -> bool {
        self.slip_path.iter().any(|path| *path > 0.0)
    }

    /// Whether anything slips that is not free.
    pub(crate) fn wear(&self) -> bool {
        self.slip() && self.work_per_area.iter().any(|work| *work > 0.0)
    }

    pub(crate) fn none(count: usize) -> Self {
        let contact = Contact { control: 0.0, depth: 0.0, radius: 0.0, load: 0.0 };
        let (work_per_area, slip_path) = (vec![0.0; count], vec![0.0; count]);
        Self { work_per_area, slip_path, contact, clipped: 0.0, defect: 0.0, transforms: 0 }
    }

    /// Adds the slip under one depth. Returns its work, J.
    fn add(
        &mut self,
        surface: &Surface,
        nodes: &Nodes,
        transforms: &NodeTransforms,
        (law, images, contact): (&SlipAtDepth, &[f64], &Contact),
        constants: &Constants,
    ) -> f64 {
        let edge = Edge::new(nodes, &[], contact, surface.profile().outer_radius());
        let load: Vec<f64> =
            images.iter().map(|g| constants.normal_modulus * (contact.depth - g).max(0.0)).collect();
        let pressure = pressure_nodes(transforms, nodes.x(), &load, &edge);
        // springs out of contact have gone along with the body, as those at the edge have
        let slip: Vec<f64> = law.along(images.iter().map(|g| g.min(contact.depth))).collect();
        let path = transforms.inverse_abel(&slip);
        self.transforms += 1;
        let (mut gain, mut healing) = (vec![0.0; path.len()], vec![0.0; path.len()]);
        for (i, path) in path.iter().enumerate() {
            let work = constants.friction_coefficient * pressure.get(i).copied().unwrap_or(0.0) * path;
            // a pressure that overshoots stays: an update that did not know of it would drive it on
            if *path >= 0.0 {
                gain[i] = work
            } else {
                healing[i] = work.abs()
            }
            self.slip_path[i] += path.max(0.0);
        }
        for (sum, gain) in self.work_per_area.iter_mut().zip(&gain) {
            *sum += gain;
        }
        self.clipped += nodes.volume(&healing);
        nodes.integral_to_edge(&gain, contact.radius)
    }

    /// The same distribution with its slip times `factor`.
    pub(super) fn scaled(&self, factor: f64) -> Self {
        let scaled = |field: &[f64]| field.iter().map(|value| value * factor).collect();
        Self { work_per_area: scaled(&self.work_per_area), slip_path: scaled(&self.slip_path), ..*self }
    }
}
