//! Nodes of the surface that a moving mesh leaves.

use super::patch::{Patch, Rate, State};
use super::remesh::parts;
use super::settings::IntegrationSettings;
use crate::surface::{MeshPlace, Nodes};

/// Most corrections of the volume: the second takes what the first leaves by the difference between
/// the integrals of mesh and nodes.
const CORRECTIONS: usize = 2;

/// How near to the work, relative, the volume has to be, as a share of the tolerance. Each
/// correction makes the nodes again, a third of the time of a short update.
const MET: f64 = 1e-3;

/// Nodes that a patch leaves where the worn volume is known to be `target` (m³), and by how much
/// the patch and the nodes miss that. The depths follow the motion of the mesh, which keeps the
/// volume to second order in the cells; the work of the springs is exact.
pub(super) fn left_at_the_end(
    patch: &Patch,
    (mut state, mut rate): (State, Rate),
    settings: &IntegrationSettings,
    target: f64,
) -> (Nodes, [f64; 2]) {
    let mut nodes = all_nodes(patch, (&state, &rate), settings);
    let mut missing = target - nodes.worn_volume();
    let defect = missing.abs();
    for _ in 0..CORRECTIONS {
        if missing.abs() <= MET * settings.tolerance * target {
            break;
        }
        let Some(grown) = patch.with_volume(&state, &rate, missing) else { break };
        (state, rate) = grown;
        nodes = all_nodes(patch, (&state, &rate), settings);
        missing = target - nodes.worn_volume();
    }
    (nodes, [defect, missing.abs()])
}

/// Nodes of the surface that a patch leaves, with the wear outside the contact.
pub(super) fn all_nodes(
    patch: &Patch,
    (state, rate): (&State, &Rate),
    settings: &IntegrationSettings,
) -> Nodes {
    let mut nodes = exported_nodes(patch, state, rate, settings);
    patch.outside.append_to(&mut nodes);
    nodes
}

/// Nodes of the surface that a patch leaves: those of the mesh, on an annulus with one between any
/// two where that many are asked for. Their integrals are still to be made.
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
    Nodes::holding((x, image, depth), settings.cells, Some(place))
}
