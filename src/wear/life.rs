//! The life of a contact under a steady motion: many cycles at constant load, on one mesh after the
//! other as the front moves.

use super::Constants;
use super::course::Course;
use super::mesh::UnitMesh;
use super::patch::{Motion, Outside, Patch, Rate, State, edge_not_found};
use super::remesh::{check_end_of_body, mesh_slip_zone, parts};
use crate::counters::Counters;
use crate::error::Error;
use crate::surface::{MeshPlace, Nodes, Surface};
use std::sync::Arc;

/// Share of the tolerance that leaving out nodes may take of the largest image.
pub(crate) const THINNING: f64 = 0.05;

/// Most corrections of the volume: the second takes what the first leaves by the difference between
/// the integrals of mesh and nodes.
const CORRECTIONS: usize = 2;

/// How near to the work, relative, the volume has to be, as a share of the tolerance. Each
/// correction makes the nodes again, a third of the time of a short update.
const MET: f64 = 1e-3;

/// How finely to integrate.
#[derive(Debug, Clone, Copy)]
pub(crate) struct IntegrationSettings {
    /// Cells across the slipping region that the nodes give; the mesh of an annulus has five
    /// eighths of them.
    pub(crate) cells: usize,
    /// Largest error of the image in a step, over the largest image that may wear.
    pub(crate) tolerance: f64,
    /// Cycles of the last step, where it went on from here; 0 at first.
    pub(crate) last_step: f64,
}

/// What a number of cycles has left.
#[derive(Debug, Clone)]
pub(crate) struct Life {
    pub(crate) surface: Surface,
    /// Worn volume by the work of the springs, m³.
    pub(crate) volume: f64,
    /// What the worn profile missed of it before it was scaled to it, m³.
    pub(crate) defect: f64,
    /// Cycles that the next step should span.
    pub(crate) next_step: f64,
    /// The tables last used: kept, they spare the next call making them.
    pub(crate) mesh: Option<Arc<UnitMesh>>,
}

/// How much of a motion wears the surface.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Amount {
    /// Cycles, or metres where it slides onward.
    pub(crate) cycles: f64,
    /// Volume worn so far, m³: that of the profile, and what has found no place on it yet.
    pub(crate) worn: f64,
    /// Whether the motion is what has been gathered since the last update: a small part of a life.
    pub(crate) is_update: bool,
}

/// Wears a surface by an amount of a motion.
///
/// # Errors
/// Those of the normal contact; [`Error::TooMuchWear`] where the cycles need too many steps;
/// [`Error::NotFinite`] where the contact edge is lost.
pub(crate) fn integrate(
    surface: &Surface,
    motion: &Motion,
    amount: &Amount,
    constants: &Constants,
    settings: &IntegrationSettings,
    counters: &mut Counters,
) -> Result<Life, Error> {
    let mut life = Life {
        surface: surface.clone(),
        volume: 0.0,
        defect: 0.0,
        next_step: settings.last_step,
        mesh: None,
    };
    let mut course = Course::new(motion, amount, settings);
    // of the surface, m³, where it is known
    let mut worn_volume = None;
    let mut outside = None;
    while course.left > 0.0 {
        counters.contact_solutions += 1;
        let contact = life.surface.contact(motion.control, motion.value, 2.0 * constants.normal_modulus)?;
        let outside = match &outside {
            Some(outside) => outside,
            None => {
                let found = carried_outside(surface, contact.radius, amount.is_update);
                &*outside.insert(found.ok_or_else(|| edge_not_found(motion))?)
            }
        };
        let body = (&life.surface, outside);
        let known = (worn_volume, amount.is_update || worn_volume.is_some());
        let Some(start) = mesh_slip_zone(body, &contact, motion, constants, settings, known)? else { break };
        let end = course.follow(&life.surface, start, counters)?;
        if end.patch.is_at_end_of_body(&end.rate) {
            check_end_of_body(&life.surface, motion, constants)?;
        }
        life.next_step = course.step;
        life.mesh = Some(end.patch.mesh.clone());
        life.volume += end.volume;
        let on_mesh = end.patch.volume(&end.rate);
        let nodes = if course.left > 0.0 {
            exported_nodes(&end.patch, &end.state, &end.rate, settings)
        } else {
            let target = amount.worn + life.volume;
            let (nodes, [defect, missing]) =
                left_at_the_end(&end.patch, (end.state, end.rate), settings, target);
            // it has not carried what other loads have left
            if end.patch.outside.is_some() && missing > settings.tolerance * target {
                return Err(edge_not_found(motion));
            }
            life.defect += defect;
            nodes
        };
        if !(life.volume.is_finite() && life.defect.is_finite() && on_mesh.is_finite()) {
            return Err(edge_not_found(motion));
        }
        worn_volume = Some(on_mesh);
        life.surface.set_worn(Some(nodes));
    }
    // between two meshes nobody asks what lies beyond
    if let (Some(nodes), Some(outside), true) = (life.surface.worn(), outside, life.mesh.is_some()) {
        let mut nodes = nodes.clone();
        outside.append_to(&mut nodes);
        nodes.extend_beyond_mesh(life.surface.profile());
        life.surface.set_worn(Some(nodes));
    }
    Ok(life)
}

/// The wear outside a contact of some radius (m) that a mesh carries; `None` where it cannot: up to
/// the rim of a body that ends there it is no smooth profile. For a small part of a life it would
/// not pay, which is an update.
fn carried_outside(surface: &Surface, radius: f64, is_update: bool) -> Option<Outside> {
    let Some(nodes) = surface.worn().filter(|nodes| Outside::is_left_on(nodes, radius)) else {
        return Some(Outside::default());
    };
    let reaches_rim = nodes.depth()[nodes.last()] > 0.0;
    (!is_update && !reaches_rim).then(|| Outside::of(nodes, radius))
}

/// Nodes that a patch leaves where the worn volume is known to be `target` (m³), and by how much
/// the patch and the nodes miss that. The depths follow the motion of the mesh, which keeps the
/// volume to second order in the cells; the work of the springs is exact.
fn left_at_the_end(
    patch: &Patch,
    (mut state, mut rate): (State, Rate),
    settings: &IntegrationSettings,
    target: f64,
) -> (Nodes, [f64; 2]) {
    let all_nodes = |state: &State, rate: &Rate| {
        let mut nodes = exported_nodes(patch, state, rate, settings);
        patch.outside.append_to(&mut nodes);
        nodes
    };
    let mut nodes = all_nodes(&state, &rate);
    let mut missing = target - nodes.worn_volume();
    let defect = missing.abs();
    for _ in 0..CORRECTIONS {
        if missing.abs() <= MET * settings.tolerance * target {
            break;
        }
        let Some(grown) = patch.with_volume(&state, &rate, missing) else { break };
        (state, rate) = grown;
        nodes = all_nodes(&state, &rate);
        missing = target - nodes.worn_volume();
    }
    (nodes, [defect, missing.abs()])
}

/// Nodes of the surface that a patch leaves: those of the mesh, on an annulus with one between any
/// two where that many are asked for.
pub(super) fn exported_nodes(
    patch: &Patch,
    state: &State,
    rate: &Rate,
    settings: &IntegrationSettings,
) -> Nodes {
    let (mut x, mut image, mut depth) =
        (patch.inside.x.clone(), patch.inside.image.clone(), patch.inside.depth.clone());
    // the inner edge is a node of both
    x.pop();
    image.pop();
    let inner_depth = depth.pop().unwrap_or(0.0);
    if x.is_empty() && patch.inner_radius > 0.0 {
        x.push(0.0);
        image.push(0.0);
        depth.push(0.0);
    }
    let first = x.len();
    let parts = parts(patch.mesh.cells, settings.cells);
    let radii = patch.radii_of(&patch.mesh.shares(parts), rate.radius_squared);
    let cells = radii.len() - 1;
    let mut outside = patch.depth_outside(state, rate);
    if first > 0 {
        outside[0] = inner_depth;
    }
    depth.extend(patch.mesh.depths(parts, &outside).into_iter().map(|w| w.max(0.0)));
    image.extend(patch.worn_image(rate, parts, &radii));
    x.extend(radii);
    let place = MeshPlace { region: patch.mesh.region, cells, first, contact: patch.contact(rate) };
    let mut nodes = Nodes::holding((x, image, depth), settings.cells, Some(place));
    // a life makes them at its end: before, only the balance with a rig asks for them
    if patch.motion.rig.is_some() {
        nodes.update_integrals(patch.body.profile());
    }
    nodes
}
