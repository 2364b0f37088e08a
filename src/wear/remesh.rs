//! A new mesh on the slipping region of a surface.

use super::Constants;
use super::mesh::UnitMesh;
use super::patch::{FRONT_CELLS, Frozen, Motion, Outside, Patch, RIM, Rate, State, edge_not_found};
use super::settings::{IntegrationSettings, thinning, tolerance_in_space};
use crate::error::Error;
use crate::parameters::NormalControl;
use crate::profile::Profile;
use crate::surface::Region;
use crate::surface::{Contact, MeshPlace, Nodes, Surface};
use std::f64::consts::PI;

/// Gross slip by no more than this share hardly moves the axis, where a needle stays that the cells
/// of a disc do not see: they would leave out a whole cell, a fifth of the volume. It is taken for
/// partial slip with a front next to the axis.
const JUST_ALL: f64 = 1e-4;

/// Radius of that front, and the least of any, relative to the contact radius. The image of an
/// annulus is carried as z in proportion to 1/x, which is singular at the axis: where slip just
/// reaches it, worn volumes are off by 6e-4 (cone).
const LEAST_FRONT: f64 = 1e-3;

/// The same where the axis has worn. An annulus has to carry the image inside its front by 1/x:
/// with a front at 1e-3 of the radius the axis of a ball came out 11 % too deep, and a body that
/// had worn far lost its friction. With half of the value it is up to 2 % too deep.
const LEAST_CORE: f64 = 2e-2;

/// Image of the wear at the axis, over the overlap there, from which on it has worn. Half of it and
/// twice serve as well.
const WORN_AXIS: f64 = 0.1;

/// Cells of the coarsest mesh of an annulus: with 16, worn volumes on the way are off by 0.3 to
/// 0.6 %.
const FEWEST_CELLS: usize = 24;

/// Width of a slipping annulus, relative to the contact radius, below which it wears nothing worth
/// a mesh.
pub(crate) const THINNEST: f64 = 1e-5;

// The next two say when a mesh is made on a worn surface. Beyond them, updates on nodes at rest
// do the same, only slower.

/// How far the contact edge may move where a mesh is made on a surface at rest, on which it is
/// known to a cell: in cells of an even mesh over the slipping region.
const EDGE_CELLS: f64 = 1.0;

/// Share of the worn volume, and of that within the slipping region, that a new mesh may miss: its
/// depths are then raised to it. Where next to nothing has worn in the region it may miss the
/// tolerance of all that can. A mesh whose own volume is below zero, since the depth that belongs
/// to the image inside is larger, is refused, but for what it may miss: the image of one went to
/// -27 µm at its front. In gross slip under a force it is a share of the overlap, which carries the
/// force however much has worn: a mesh that missed 2 % of the volume had the edge 2 % further out,
/// and springs at its rim lost contact.
const MISSING: f64 = 0.05;

/// Volume that a mesh made on a profile of other loads may put elsewhere, over the volume that the
/// motion is about to wear and over the tolerance in space. Within a cell it has a line where there
/// is a wall, as at a former front: few cycles of a large amplitude among many of a small one then
/// leave the wall worn off, and the many wear again what they had worn. A third and three times as
/// much changed V of such blocks by up to 2.5 %.
const MISPLACED: f64 = 300.0;

/// The same for cycles of several amplitudes, where that is more, over all that has worn. A third
/// and three times serve as well; with a tenth unequal strokes in fast wear go to nodes at rest,
/// and without a bound the depth that a stroke leaves at a former front is 2.6 % off.
const MISPLACED_OF_WORN: f64 = 1e-2;

/// The slipping region of a contact, with the state that its surface gives it and the rate of that;
/// `None` where nothing slips. The worn volume, m³, may be known; some cycles or metres are `left`.
///
/// Where the surface `is_smooth`, within a life and from part to part of one, its nodes are samples
/// of a smooth profile; else they are one of lines. Taken for samples, a profile that other loads
/// have worn is too deep behind its front: of 160 calls whose loads differ by 0.4 % in turn V was
/// 2.6 % low.
pub(super) fn mesh_slip_zone(
    (surface, outside): (&Surface, &Outside),
    contact: &Contact,
    motion: &Motion,
    constants: &Constants,
    settings: &IntegrationSettings,
    (volume, is_smooth, left): (Option<f64>, bool, f64),
) -> Result<Option<(Patch, State, Rate)>, Error> {
    let motion = &motion.on(surface, contact, constants.bound_slope());
    if contact.is_open() || motion.sliding.amplitude() == 0.0 {
        return Ok(None);
    }
    let a = contact.radius;
    let free_slip = motion.sliding.amplitude() / constants.bound_slope();
    let overlap = contact.depth - surface.image(0.0);
    let front =
        if free_slip < overlap { surface.radius_of_image(contact.depth - free_slip, 0.0, a) } else { 0.0 };
    let is_flat = surface.profile().flat_radius() > 0.0;
    let axis_has_worn = surface.worn_image(0.0) > WORN_AXIS * overlap;
    let all_slips = free_slip >= overlap * (1.0 + JUST_ALL)
        || is_flat && free_slip >= overlap
        || axis_has_worn && front < LEAST_CORE * a;
    let (region, front) =
        if all_slips { (Region::Disc, 0.0) } else { (Region::Annulus, front.max(LEAST_FRONT * a)) };
    if front >= a * (1.0 - THINNEST) {
        return Ok(None);
    }
    let mesh = UnitMesh::shared(region, surface.profile().is_sharp(), mesh_cells(region, settings.cells));
    let outer = surface.profile().outer_radius();
    let rim = a >= outer * (1.0 - RIM);
    if rim {
        check_end_of_body(surface, motion, constants)?;
    }
    let a = if rim { outer } else { a };
    let start = |front: f64, radius_squared: f64, images: &dyn Fn(&[f64]) -> Vec<f64>| {
        let inside = inside(surface, front, thinning(settings.tolerance, settings.cells));
        let places = (front, inside, outside.clone());
        let patch = Patch::new(surface.unworn(), mesh.clone(), places, motion.clone(), rim, constants);
        let depth = patch.depths(&images(&patch.radii(radius_squared)), radius_squared);
        let rate = patch.rate(&depth, radius_squared)?;
        let radius_squared = rate.radius_squared;
        Some((patch, State { depth, radius_squared }, rate))
    };
    let Some(nodes) = surface.worn() else {
        let made = start(front, a * a, &|x| vec![0.0; x.len()]);
        return made.map(Some).ok_or_else(|| edge_not_found(motion));
    };
    // the mesh goes on where it was left
    if let Some(place) = nodes.mesh().filter(|place| fits(nodes, place, &mesh, (front, settings.cells))) {
        let (first, end) = (place.first, place.first + place.cells);
        let (front, edge) = (nodes.x()[first], nodes.x()[end]);
        let images = |_: &[f64]| {
            nodes.worn_image()[first..=end].iter().copied().step_by(place.cells / mesh.cells).collect()
        };
        if let Some((patch, state, rate)) = start(front, edge * edge, &images)
            && rim == (edge == outer)
            && (state.radius_squared - edge * edge).abs() <= 1e-4 * patch.span(state.radius_squared)
        {
            return Ok(Some((patch, state, rate)));
        }
    }
    // it is made again where it can carry all the wear there is
    let image = |x: &f64| if is_smooth { nodes.smooth_image(*x) } else { surface.worn_image(*x) };
    let may_wear = PI * (a * a - front * front) * free_slip;
    // parts of one motion go on as they have begun
    let is_one_motion = is_smooth && (volume.is_some() || motion.mixture.is_none());
    let volume = volume.or(outside.whole_volume()).unwrap_or_else(|| nodes.worn_volume());
    let is_held = region == Region::Disc && motion.control == NormalControl::Force;
    let held = if is_held { volume.min(PI * a * contact.load) } else { volume };
    start(front, a * a, &|x| x.iter().map(image).collect())
        .filter(|(patch, state, rate)| {
            let own = patch.own_volume(rate);
            let most = (MISSING * own).max(settings.tolerance * may_wear).min(MISSING * held);
            let to_wear = rate.volume_rate * left;
            let may_misplace = MISPLACED * tolerance_in_space(settings.tolerance, settings.cells) * to_wear;
            let of_worn = if motion.mixture.is_some() { MISPLACED_OF_WORN * volume } else { 0.0 };
            let is_in_place = |patch| misplaced(surface, nodes, patch, a) <= may_misplace.max(of_worn);
            own >= -most
                && (is_one_motion || is_in_place(patch))
                && (patch.volume(rate) - volume).abs() <= most
                && (state.radius_squared - a * a).abs()
                    <= EDGE_CELLS * 2.0 * patch.span(a * a) / settings.cells as f64
        })
        .map(Some)
        .ok_or_else(|| edge_not_found(motion))
}

/// Volume (m³) of wear that a smooth image between the nodes of a mesh has elsewhere than the nodes
/// of a surface, in a contact of some radius, m.
fn misplaced(surface: &Surface, nodes: &Nodes, patch: &Patch, radius: f64) -> f64 {
    let x = patch.radii(radius * radius);
    let (front, edge, zeros) = (x[0], x[x.len() - 1], vec![0.0; x.len()]);
    let images = x.iter().map(|x| surface.worn_image(*x)).collect();
    let mesh = Nodes::holding((x, images, zeros), 0, None);
    let (mut volume, mut last) = (0.0, (front, 0.0));
    let inside = |(x, _): &(&f64, &f64)| front < **x && **x < edge;
    for (x, image) in nodes.x().iter().zip(nodes.worn_image()).filter(inside) {
        let off = x * (mesh.smooth_image(*x) - image).abs();
        volume += PI * (x - last.0) * (off + last.1);
        last = (*x, off);
    }
    volume
}

/// A contact may grow to the end of a punch, but not to that of a table: what lies beyond its last
/// point is not known.
pub(super) fn check_end_of_body(
    surface: &Surface,
    motion: &Motion,
    constants: &Constants,
) -> Result<(), Error> {
    let Profile::Table(table) = surface.profile() else { return Ok(()) };
    let (quantity, value) = match motion.control {
        NormalControl::Force => ("normal_force", 2.0 * constants.normal_modulus * motion.value),
        NormalControl::Indentation => ("indentation", motion.value),
    };
    Err(Error::BeyondTable { quantity, value, radius: table.outer_radius() })
}

/// Cells of the mesh at a resolution: five eighths where they carry parabolas. With half, a life
/// takes two thirds of the time, and V on the way is off by 3.3e-4 (cone, held) and 5.8e-4 (cone,
/// at constant force) instead of 2.9e-4 and 4.7e-4.
fn mesh_cells(region: Region, resolution: usize) -> usize {
    match region {
        Region::Annulus => (5 * resolution / 8).max(FEWEST_CELLS),
        Region::Disc => resolution,
    }
}

/// Parts of a cell that become cells of the nodes, which take lines where the mesh has parabolas.
pub(super) fn parts(cells: usize, resolution: usize) -> usize {
    if cells < resolution { 2 } else { 1 }
}

/// Whether a mesh among the nodes is the one for this region, front and resolution.
fn fits(nodes: &Nodes, place: &MeshPlace, mesh: &UnitMesh, (front, resolution): (f64, usize)) -> bool {
    let x = &nodes.x()[place.first..];
    let parts = parts(mesh.cells, resolution);
    place.region == mesh.region
        && place.cells == parts * mesh.cells
        && front >= x[0] * (1.0 - 1e-7)
        && front <= x[parts * FRONT_CELLS]
}

/// What lies inside the front: the surface's nodes up to there, without those that a line through
/// others replaces within a share of the largest image.
fn inside(surface: &Surface, front: f64, share: f64) -> Frozen {
    if front == 0.0 {
        return Frozen::default();
    }
    let mut all = Frozen { x: vec![0.0], image: vec![surface.worn_image(0.0)], depth: vec![0.0] };
    if let Some(nodes) = surface.worn() {
        all.depth[0] = nodes.depth()[0];
        for (i, &x) in nodes.x().iter().enumerate().skip(1) {
            if x < front * (1.0 - 1e-12) {
                all.x.push(x);
                all.image.push(nodes.worn_image()[i]);
                all.depth.push(nodes.depth()[i]);
            }
        }
    }
    // next to a node the image may be so steep that a rounding of the front would show, and let it
    // creep
    let node = surface.worn().and_then(|nodes| nodes.at(front, 1e-11));
    let (image, depth) = node.unwrap_or_else(|| {
        (surface.worn_image(front), surface.worn().map_or(0.0, |nodes| nodes.depth_at(front)))
    });
    all.x.push(front);
    all.image.push(image);
    all.depth.push(depth);
    // the moving mesh has narrow cells next to its front, with an error of some 1e-3 of the image;
    // crowded nodes elsewhere may belong to a steep step that other loads have worn
    let mesh_start = surface.worn().and_then(|nodes| Some(nodes.x()[nodes.mesh()?.first]));
    all.thinned(share, mesh_start.unwrap_or(f64::INFINITY))
}
