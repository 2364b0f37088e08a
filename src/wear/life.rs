//! The life of a contact under a steady motion: many cycles at constant load, on one mesh after the
//! other as the front moves.

use super::Constants;
use super::course::Course;
use super::export::{all_nodes, exported_nodes, left_at_the_end};
use super::mesh::UnitMesh;
use super::patch::{Motion, Outside, edge_not_found};
use super::remesh::{check_end_of_body, mesh_slip_zone};
use super::settings::{Amount, IntegrationSettings, Part};
use crate::counters::Counters;
use crate::error::Error;
use crate::surface::{Region, Surface};
use std::sync::Arc;

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
                let found = carried_outside(surface, contact.radius);
                &*outside.insert(found.ok_or_else(|| edge_not_found(motion))?)
            }
        };
        let body = (&life.surface, outside);
        let is_smooth = worn_volume.is_some()
            || match amount.part {
                Part::Call => false,
                // a stretch that a mesh could not follow has left lines, too
                Part::Stretch => life.surface.worn().is_some_and(|nodes| nodes.mesh().is_some()),
                // with lines the profile of strokes in gross slip is 6 % off
                Part::Update => true,
            };
        let known = (worn_volume, is_smooth, course.left);
        let Some(start) = mesh_slip_zone(body, &contact, motion, constants, settings, known)? else { break };
        if life.mesh.is_none() && course.is_at_end(&start.0, &start.2) {
            break;
        }
        let end = course.follow(&life.surface, start, counters)?;
        if end.patch.is_at_end_of_body(&end.rate) {
            check_end_of_body(&life.surface, motion, constants)?;
        }
        life.next_step = course.step;
        life.mesh = Some(end.patch.mesh.clone());
        life.volume += end.volume;
        let on_mesh = end.patch.volume(&end.rate);
        let nodes = if course.left > 0.0 {
            let mut nodes = exported_nodes(&end.patch, &end.state, &end.rate, settings);
            // the end of the life makes them for all: on the way only the balance with a rig asks
            // for integrals, and a disc for its depth or load
            if motion.rig.is_some() || end.patch.mesh.region == Region::Disc {
                nodes.update_integrals(life.surface.profile());
            }
            nodes
        } else if end.is_worn_free {
            // the profile is the final one: what it lacks has worn
            let nodes = all_nodes(&end.patch, (&end.state, &end.rate), settings);
            life.volume = (nodes.worn_volume() - amount.worn).max(0.0);
            nodes
        } else {
            let target = amount.worn + life.volume;
            let (nodes, [defect, missing]) =
                left_at_the_end(&end.patch, (end.state, end.rate), settings, target);
            // it has not carried what other loads have left
            if missing > settings.tolerance * target {
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
/// the rim of a body that ends there it is no smooth profile.
fn carried_outside(surface: &Surface, radius: f64) -> Option<Outside> {
    let Some(nodes) = surface.worn().filter(|nodes| Outside::is_left_on(nodes, radius)) else {
        return Some(Outside::default());
    };
    let reaches_rim = nodes.depth()[nodes.last()] > 0.0;
    (!reaches_rim).then(|| Outside::of(nodes))
}
