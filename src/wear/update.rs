//! The linearly implicit profile update.

use super::edge::{Edge, pressure_nodes};
use super::system::System;
use super::{Constants, SlipFields, krylov};
use crate::error::Error;
use crate::parameters::NormalControl;
use crate::surface::{Contact, NodeTransforms, Nodes, Surface};
use crate::transform::dot;

/// The result of an update.
#[derive(Debug, Clone)]
pub(crate) struct Update {
    /// Worn depth at all nodes, m ≥ 0.
    pub(crate) depth: Vec<f64>,
    /// Linear systems solved on the way.
    pub(crate) systems: u64,
    /// Iterations that these took, each with two transforms.
    pub(crate) iterations: u64,
    /// Whether the depths solve the equations of the update: what is left is little of what wears
    /// at the pressure of before, and no more than the indentation depth (root mean square).
    pub(crate) followed: bool,
}

/// Most Newton iterations of a part of an update. The pressure is linear in the wear as long as the
/// contact edge stays in its cell.
const MOST_NEWTON: u64 = 8;

/// What an iteration leaves of the residual, the next one takes up.
const REDUCTION: f64 = 1e-2;

/// Residual, as a share of the first, at which an update is done: far below the error of one
/// implicit step.
const ACCURACY: f64 = 1e-4;

/// Residual at which it may be left: where the contact edge goes to and fro between two nodes, it
/// falls no further. The next part takes up what is left of one.
const LEFT: f64 = 0.1;

/// Least part in which an update is made, where its residual does not fall that far in one.
const LEAST_PART: f64 = 1.0 / 256.0;

/// Share of a Newton step along the one before, at and above which the secant through both is not
/// used: it would make the step more than four times as long. Found by trial: with 0.5 about as
/// many loads are refused of a flat that wears beyond all measure.
const ALIKE: f64 = 0.75;

/// Most iterations of a linear system.
const MOST_KRYLOV: usize = 200;

/// Worn depth that slip brings, with the pressure and the contact edge taken at the end of the
/// update.
///
/// Solves Δw = (k/σ₀) A + κ B (p(h + Δh) − p(h)) by Newton's method. The edge moves along with the
/// wear: were it held, a whole update's wear would end at it like a square root, and its image
/// would have a logarithmic dip there. Where it moves so far that the iteration loses it, the
/// update is made in parts, halved until they are followed.
///
/// # Errors
/// Those of the normal contact; [`Error::NotFinite`] if the system cannot be solved.
pub(crate) fn worn_depth(
    surface: &Surface,
    transforms: &NodeTransforms,
    fields: &SlipFields,
    control: NormalControl,
    constants: &Constants,
) -> Result<Update, Error> {
    let mut update = Update { depth: Vec::new(), systems: 0, iterations: 0, followed: true };
    let Some(nodes) = surface.worn() else { return Ok(update) };
    let count = nodes.x().len();
    update.depth = vec![0.0; count];
    let Some(first) = fields.slip_path.iter().position(|s| *s > 0.0) else { return Ok(update) };
    let present = fields.contact;
    let profile = surface.profile();
    let unworn = nodes.x().iter().map(|&x| profile.image(x)).collect();
    let mut solver = Solver {
        surface,
        nodes,
        transforms,
        control,
        constants,
        first,
        present,
        unworn,
        reference: Vec::new(),
    };
    (solver.reference, _) = solver.pressure(&present, nodes.worn_image(), &[]);
    let whole: Vec<f64> = fields.work_per_area.iter().map(|work| constants.wear_per_work * work).collect();
    let (mut done, mut part) = (0.0, 1.0);
    let mut left = vec![0.0; count];
    while done < 1.0 {
        let trial = solver.part(&fields.scaled(part), &left, &mut update)?;
        if trial.residual > LEFT && part > LEAST_PART {
            part *= 0.5;
            continue;
        }
        (update.depth, left) = (trial.depth, trial.left);
        done += part;
    }
    let size = fields.contact.depth * fields.contact.depth * count as f64;
    let left = dot(&left, &left);
    update.followed = left <= LEFT * LEFT * dot(&whole, &whole) && left <= size;
    for (w, path) in update.depth.iter_mut().zip(&fields.slip_path) {
        *w = if *path > 0.0 { w.max(0.0) } else { 0.0 };
    }
    Ok(update)
}

/// Everything an update solves with that does not change in it.
struct Solver<'a> {
    surface: &'a Surface,
    nodes: &'a Nodes,
    transforms: &'a NodeTransforms,
    control: NormalControl,
    constants: &'a Constants,
    /// First node that slips.
    first: usize,
    /// The contact in which the history was gathered.
    present: Contact,
    /// Unworn image at the nodes, m.
    unworn: Vec<f64>,
    /// Pressure with which the history was gathered, Pa.
    reference: Vec<f64>,
}

/// Depths at all nodes, and what they are still short of, m.
struct Trial {
    depth: Vec<f64>,
    left: Vec<f64>,
    /// Its size as a share of the first.
    residual: f64,
}

/// Changes of the depths, m.
struct Step {
    newton: Vec<f64>,
    taken: Vec<f64>,
}

impl Step {
    /// The step after this one by the secant through both (Anderson, J. ACM 12 (1965), 547, with
    /// one step of memory): the derivative errs at the contact edge only, so that one Newton step
    /// after the other errs in the same direction. `None` where they are too much [`ALIKE`].
    fn secant(&self, newton: &[f64]) -> Option<Vec<f64>> {
        if dot(newton, &self.newton) >= ALIKE * dot(&self.newton, &self.newton) {
            return None;
        }
        let change: Vec<f64> = newton.iter().zip(&self.newton).map(|(now, last)| now - last).collect();
        let share = dot(newton, &change) / dot(&change, &change);
        let both = self.taken.iter().zip(&change);
        Some(newton.iter().zip(both).map(|(now, (taken, change))| now - share * (taken + change)).collect())
    }
}

impl Solver<'_> {
    fn pressure(&self, contact: &Contact, worn: &[f64], more: &[f64]) -> (Vec<f64>, Edge) {
        let edge = Edge::new(self.nodes, more, contact, self.surface.profile().outer_radius());
        let load: Vec<f64> = (0..=edge.last)
            .map(|i| self.constants.normal_modulus * (contact.depth - self.unworn[i] - worn[i]).max(0.0))
            .collect();
        (pressure_nodes(self.transforms, self.nodes.x(), &load, &edge), edge)
    }

    /// Pressure and contact edge with more worn depth; `None` where what slips carries nothing any
    /// more.
    fn reached(&self, depth: &[f64]) -> Result<Option<(Vec<f64>, Edge)>, Error> {
        let worn = self.surface.worn_further((depth, &self.transforms.abel(depth)), 1.0);
        let contact = if depth.iter().all(|w| *w == 0.0) {
            self.present
        } else {
            worn.contact(self.control, self.present.control, 2.0 * self.constants.normal_modulus)?
        };
        let image = worn.worn().map_or(&[][..], Nodes::worn_image);
        let (pressure, edge) = self.pressure(&contact, image, depth);
        Ok((!contact.is_open() && self.first <= edge.last).then_some((pressure, edge)))
    }

    /// Wears a part of the history, and what is `left` of those before, on top of the depths so
    /// far: the best iterate of Newton's method.
    fn part(&self, part: &SlipFields, left: &[f64], update: &mut Update) -> Result<Trial, Error> {
        let Constants { wear_per_work, friction_coefficient, .. } = *self.constants;
        let mut depth = update.depth.clone();
        let before: Vec<f64> = depth.iter().zip(left).map(|(depth, left)| depth + left).collect();
        let mut best = Trial { depth: depth.clone(), left: left.to_vec(), residual: f64::INFINITY };
        let (mut start, mut last_step) = (0.0, None::<Step>);
        let first = self.first;
        for iteration in 0..=MOST_NEWTON {
            let reached = self.reached(&depth)?;
            // what each node is short of: the pressure is that at the end, 0 out of contact
            let pressure = reached.as_ref().map_or(&[][..], |(pressure, _)| pressure);
            let mut newton = vec![0.0; depth.len()];
            for i in first..depth.len() {
                let at = |pressure: &[f64]| pressure.get(i).copied().unwrap_or(0.0);
                let relief = part.slip_path[i] * (at(pressure) - at(&self.reference));
                let gain = part.work_per_area[i] + friction_coefficient * relief;
                newton[i] = before[i] + wear_per_work * gain - depth[i];
            }
            let last =
                reached.as_ref().map_or(self.reference.len().max(first + 1) - 1, |(_, edge)| edge.last);
            let residual = &newton[first..=last];
            let size = dot(residual, residual).sqrt();
            if iteration == 0 {
                start = size;
            }
            let share = if start > 0.0 { size / start } else { 0.0 };
            if share <= best.residual {
                let mut left = vec![0.0; depth.len()];
                left[first..=last].copy_from_slice(residual);
                best = Trial { depth: depth.clone(), left, residual: share };
            }
            if share <= ACCURACY || iteration == MOST_NEWTON {
                break;
            }
            if let Some((_, edge)) = reached {
                let correction = self.correction(part, residual, edge, update)?;
                newton[first..=last].copy_from_slice(&correction);
            }
            let step =
                last_step.as_ref().and_then(|last| last.secant(&newton)).unwrap_or_else(|| newton.clone());
            depth.iter_mut().zip(&step).for_each(|(depth, step)| *depth += step);
            last_step = Some(Step { newton, taken: step });
        }
        Ok(best)
    }

    /// Depths (m) that make up for a residual, at the nodes from the first that slips to an edge.
    fn correction(
        &self,
        part: &SlipFields,
        residual: &[f64],
        edge: Edge,
        update: &mut Update,
    ) -> Result<Vec<f64>, Error> {
        let system = System::new(self.nodes.x(), self.transforms, part, self.first, edge, self.constants);
        let levels = system.levels();
        let solved =
            krylov::solve(|x| system.apply(x), |r| levels.relax(r), residual, (REDUCTION, MOST_KRYLOV));
        let finite = solved.filter(|(correction, _)| correction.iter().all(|w| w.is_finite()));
        let normal = self.present.control;
        let (correction, iterations) =
            finite.ok_or(Error::NotFinite { what: "the worn depth", normal, displacement: 0.0 })?;
        update.systems += 1;
        update.iterations += iterations;
        Ok(correction)
    }
}

#[cfg(test)]
mod tests;
