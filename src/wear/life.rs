//! The life of a contact under a steady motion: many cycles at constant load, under error control.

use super::Constants;
use super::mesh::{Region, UnitMesh};
use super::patch::{FRONT_CELLS, Front, Frozen, Motion, Patch, RIM, Rate, State, lost};
use super::rosenbrock;
use crate::engine::Counters;
use crate::error::Error;
use crate::surface::{Contact, MeshPlace, Nodes, Surface};
use std::sync::Arc;

/// Most steps of one call: a whole life takes some fifty.
const MOST_STEPS: u32 = 1000;

/// Most steps, at the usual tolerance of 1e-3, of what is but a small part of a life, which takes one or two, and on a body
/// already worn where the mesh does not carry it. The method is of third order: a thousandth of the tolerance takes ten times as
/// many.
const MOST_STEPS_OF_AN_UPDATE: f64 = 60.0;

/// And as many times that at the most, however tight the tolerance: no call may go on for ever.
const MOST_TIGHTER: f64 = 100.0;

/// Share of the tolerance that leaving out nodes may take of the largest image.
pub(crate) const THINNING: f64 = 0.05;

/// Gross slip by no more than this share hardly moves the axis, where a needle stays that the cells of a disc do not see: they would
/// leave out a whole cell, a fifth of the volume. It is taken for partial slip with a front next to the axis.
const JUST_ALL: f64 = 1e-4;

/// Radius of that front, and the least of any, relative to the contact radius.
const LEAST_FRONT: f64 = 1e-4;

/// Width of a slipping annulus, relative to the contact radius, below which it wears nothing worth a mesh.
const THINNEST: f64 = 1e-5;

// The next five say when a mesh is laid over a worn surface. Half of each and twice leave every scene of the stability report with the
// same outcome; beyond them, updates on nodes at rest do the same, only slower.

/// Wear outside the contact, relative to the deepest, that the mesh may take for none: what an update of a profile that wears very
/// fast leaves there by an inexact contact edge.
const FAINT: f64 = 1e-2;

/// How far the contact edge may move where a mesh is laid over a surface at rest, on which it is known to a cell: in cells of an even
/// mesh over the contact.
const EDGE_CELLS: f64 = 1.0;

/// And in shares of the slipping region.
const EDGE_SHARE: f64 = 0.2;

/// Share of the worn volume that laying a mesh may miss: its depths are then raised to it.
const MISSING: f64 = 0.05;

/// And of what the mesh carries of it; in a thin annulus, whose image may be below 0, a small part of the whole is more than that.
const MISSING_OF_OWN: f64 = 0.09;

/// Most corrections of the volume: the second takes what the first leaves by the difference between the integrals of mesh and nodes.
const CORRECTIONS: usize = 2;

/// How near to the work, relative, the volume has to be, as a share of the tolerance. Each correction makes the nodes anew, a third of
/// the time of a short update.
const MET: f64 = 1e-3;

/// How finely to integrate.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Fineness {
    /// Cells of the mesh.
    pub(crate) cells: usize,
    /// Largest error of the image in a step, over the indentation depth.
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
    /// The tables last used: whoever keeps them spares the next call making them.
    pub(crate) mesh: Option<Arc<UnitMesh>>,
}

/// How much of a motion wears the surface.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Amount {
    /// Cycles, or metres where it slides onward.
    pub(crate) cycles: f64,
    /// Volume worn so far, m³: that of the profile, and what has found no place on it yet.
    pub(crate) worn: f64,
    /// Volume that the motion wears, m³, where the springs on the surface of before have told it already.
    pub(crate) known: Option<f64>,
}

/// Wears a surface by an amount of a motion.
///
/// # Errors
/// Those of the normal contact; [`Error::TooMuchWear`] where the cycles need too many steps; [`Error::NotFinite`] where the
/// contact edge is lost.
pub(crate) fn live(
    surface: &Surface,
    motion: &Motion,
    amount: &Amount,
    constants: &Constants,
    fineness: &Fineness,
    counters: &mut Counters,
) -> Result<Life, Error> {
    let mut life = Life {
        surface: surface.clone(),
        volume: 0.0,
        defect: 0.0,
        next_step: fineness.last_step,
        mesh: None,
    };
    let cycles = amount.cycles;
    let mut left = cycles;
    let mut steps = 0;
    let tighter = (1e-3 / fineness.tolerance).cbrt().clamp(1.0, MOST_TIGHTER);
    let most_of_an_update = (MOST_STEPS_OF_AN_UPDATE * tighter) as u32;
    while left > 0.0 {
        counters.contact_solutions += 1;
        let contact = life.surface.contact(motion.control, motion.value, 2.0 * constants.normal_modulus)?;
        let Some((patch, mut state)) = over(&life.surface, &contact, motion, constants, fineness)? else {
            break;
        };
        let mut rate = patch.rate(&state.depth, state.area).ok_or_else(|| lost(motion))?;
        let mut volume = 0.0;
        let mut step =
            if life.next_step > 0.0 { life.next_step } else { first_step(&patch, &rate, fineness) };
        // a front that has just been looked for is off by the error of laying the mesh: one step is always made
        let mut fresh = true;
        while left > 0.0 && (fresh || patch.front(&rate) == Front::Kept) {
            let carried = patch.body.worn().is_none() && amount.known.is_none();
            if steps >= if carried { MOST_STEPS } else { most_of_an_update } {
                let amplitude = motion.sliding.amplitude();
                return Err(Error::TooMuchWear { cycles, left, amplitude, steps });
            }
            steps += 1;
            let length = step.min(left);
            let trial = rosenbrock::step(&patch, &state, &rate, length, counters);
            let error = trial.as_ref().map_or(f64::INFINITY, |trial| trial.error);
            let ratio = error / (fineness.tolerance * rate.indentation.abs());
            let factor = if ratio.is_finite() { (0.8 * ratio.cbrt().recip()).clamp(0.2, 4.0) } else { 0.2 };
            match trial {
                Some(trial) if ratio <= 1.0 => {
                    (state, rate) = (trial.state, trial.rate);
                    volume += trial.volume;
                    fresh = false;
                    counters.profile_updates += 1;
                    left -= length;
                    // a step cut short says nothing about a longer one, unless it was all but too long
                    step = if length == step || factor < 1.0 { length * factor } else { step };
                }
                _ => {
                    counters.rejected_steps += 1;
                    step = length * factor.min(0.8);
                }
            }
        }
        life.next_step = step;
        life.mesh = Some(patch.mesh.clone());
        life.volume += volume;
        if let (true, Some(known)) = (left <= 0.0, amount.known) {
            life.volume = known;
        }
        let nodes = if left > 0.0 {
            left_behind(&patch, &state, &rate, fineness.tolerance)
        } else {
            let target = amount.worn + life.volume;
            let (nodes, defect) = left_at_the_end(&patch, (state, rate), fineness.tolerance, target);
            life.defect += defect;
            nodes
        };
        let on_profile = nodes.worn_volume();
        if !(life.volume.is_finite() && life.defect.is_finite() && on_profile.is_finite()) {
            return Err(lost(motion));
        }
        // on cells that do not follow the body at its edge the depths may carry a tenth of the work's volume
        if let Some(body) = patch.body.worn()
            && (on_profile - body.worn_volume() - volume).abs() > MISSING * volume
        {
            return Err(lost(motion));
        }
        life.surface.set_worn(Some(nodes));
    }
    Ok(life)
}

/// A first step that changes the image by about the size to which the method's error stays within the tolerance.
fn first_step(patch: &Patch, rate: &Rate, fineness: &Fineness) -> f64 {
    let change = patch.largest_image(&rate.growth, rate);
    0.1 * fineness.tolerance.cbrt() * rate.indentation.abs() / change
}

/// The slipping region of a contact, with the state that its surface gives it; `None` where nothing slips.
fn over(
    surface: &Surface,
    contact: &Contact,
    motion: &Motion,
    constants: &Constants,
    fineness: &Fineness,
) -> Result<Option<(Patch, State)>, Error> {
    if contact.is_open() || motion.sliding.amplitude() == 0.0 {
        return Ok(None);
    }
    let a = contact.radius;
    let reach = motion.sliding.amplitude() / constants.bound_slope();
    let room = contact.depth - surface.image(0.0);
    let (region, front) = if reach >= room * (1.0 + JUST_ALL)
        || (reach >= room && surface.profile().flat_radius() > 0.0)
    {
        (Region::Disc, 0.0)
    } else {
        let front = if reach < room { surface.radius_of_image(contact.depth - reach, 0.0, a) } else { 0.0 };
        (Region::Annulus, front.max(LEAST_FRONT * a))
    };
    if front >= a * (1.0 - THINNEST) {
        return Ok(None);
    }
    let mesh = UnitMesh::shared(region, fineness.cells);
    let outer = surface.profile().outer_radius();
    let rim = a >= outer * (1.0 - RIM);
    let a = if rim { outer } else { a };
    let start =
        |body: Surface, inside: Frozen, front: f64, area: f64, images: &dyn Fn(&[f64]) -> Vec<f64>| {
            let patch = Patch::new((body, inside), mesh.clone(), front, *motion, rim, constants);
            let depth = patch.depths(&images(&patch.radii(area)), area);
            let area = patch.rate(&depth, area)?.area;
            Some((patch, State { depth, area }))
        };
    if let Some(nodes) = surface.worn() {
        // the mesh goes on where it was left
        if let Some(place) = nodes.mesh().filter(|place| fits(nodes, place, &mesh, front)) {
            let (first, end) = (place.first, place.first + place.cells);
            let (front, edge) = (nodes.x()[first], nodes.x()[end]);
            let images = |_: &[f64]| nodes.worn_image()[first..=end].to_vec();
            let kept = start(
                surface.unworn(),
                inside(surface, front, fineness.tolerance),
                front,
                edge * edge,
                &images,
            );
            if let Some((patch, state)) = kept
                && rim == (edge == outer)
                && (state.area - edge * edge).abs() <= 1e-4 * patch.span(state.area)
            {
                return Ok(Some((patch, state)));
            }
        }
        // it is laid anew where it can carry all the wear there is, else the wear so far is left to the body
        let beyond = nodes.x().partition_point(|x| *x <= a);
        let deepest = nodes.depth().iter().fold(0.0, |most: f64, w| most.max(*w));
        if nodes.depth()[beyond..].iter().all(|w| *w <= FAINT * deepest) {
            let images = |x: &[f64]| x.iter().map(|x| nodes.smooth_image(*x)).collect();
            let laid =
                start(surface.unworn(), inside(surface, front, fineness.tolerance), front, a * a, &images);
            let volume = nodes.worn_volume();
            if let Some((patch, state)) = laid
                && patch.rate(&state.depth, state.area).is_some_and(|rate| {
                    let missing = (patch.volume(&rate) - volume).abs();
                    let off = (state.area - a * a).abs();
                    missing <= (MISSING * volume).min(MISSING_OF_OWN * patch.own_volume(&rate))
                        && off
                            <= (EDGE_CELLS * 2.0 * a * a / mesh.cells as f64)
                                .min(EDGE_SHARE * patch.span(a * a))
                })
            {
                return Ok(Some((patch, state)));
            }
        }
    }
    let zero = |x: &[f64]| vec![0.0; x.len()];
    let inside = if front > 0.0 && surface.worn().is_none() {
        inside(surface, front, fineness.tolerance)
    } else {
        Frozen::default()
    };
    start(surface.clone(), inside, front, a * a, &zero).map(Some).ok_or_else(|| lost(motion))
}

/// Whether a mesh among the nodes is one for this region and front.
fn fits(nodes: &Nodes, place: &MeshPlace, mesh: &UnitMesh, front: f64) -> bool {
    let x = &nodes.x()[place.first..];
    place.region == mesh.region
        && place.cells == mesh.cells
        && front >= x[0] * (1.0 - 1e-7)
        && front <= x[FRONT_CELLS]
}

/// What lies inside the front: the surface's nodes up to there, without those that a line through others replaces.
fn inside(surface: &Surface, front: f64, tolerance: f64) -> Frozen {
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
    // next to a node the image may be so steep that a rounding of the front would show, and let it creep
    let node = surface.worn().and_then(|nodes| nodes.at(front, 1e-11));
    let (image, depth) = node.unwrap_or_else(|| {
        (surface.worn_image(front), surface.worn().map_or(0.0, |nodes| nodes.depth_at(front)))
    });
    all.x.push(front);
    all.image.push(image);
    all.depth.push(depth);
    all.thinned(THINNING * tolerance)
}

/// Nodes that a patch leaves where the worn volume is known to be `target` (m³), and by how much the patch missed that. The depths
/// follow the motion of the mesh, which keeps the volume to second order in the cells; the work of the springs is exact.
fn left_at_the_end(
    patch: &Patch,
    (mut state, mut rate): (State, Rate),
    tolerance: f64,
    target: f64,
) -> (Nodes, f64) {
    let mut nodes = left_behind(patch, &state, &rate, tolerance);
    let mut missing = target - nodes.worn_volume();
    let defect = missing.abs();
    // what a mesh over a worn body carries may be less than what is missing
    let most = if patch.body.worn().is_some() { MISSING * patch.own_volume(&rate) } else { f64::INFINITY };
    for _ in 0..CORRECTIONS {
        if missing.abs() <= MET * tolerance * target {
            break;
        }
        // `clamp` would panic at a volume that is no number
        let volume = missing.signum() * missing.abs().min(most.abs());
        let Some(grown) = patch.with_volume(&state, &rate, volume) else { break };
        (state, rate) = grown;
        nodes = left_behind(patch, &state, &rate, tolerance);
        missing = target - nodes.worn_volume();
    }
    (nodes, defect)
}

/// Nodes of the surface that a patch leaves.
fn left_behind(patch: &Patch, state: &State, rate: &Rate, tolerance: f64) -> Nodes {
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
    for (i, r) in patch.radii(rate.area).into_iter().enumerate() {
        x.push(r);
        depth.push(if i == patch.end() {
            0.0
        } else if i == 0 && first > 0 {
            inner_depth
        } else {
            (state.depth[i] + patch.depth_from_inside(r)).max(0.0)
        });
    }
    image.extend(patch.worn_image(rate));
    let (cells, region) = (patch.mesh.cells, patch.mesh.region);
    let place = MeshPlace { region, cells, first, contact: patch.contact(rate) };
    let nodes = Nodes::assembled(patch.body.profile(), cells, (x, image, depth), place);
    match patch.body.worn() {
        None => nodes,
        Some(base) => base.with(&nodes, THINNING * tolerance, patch.body.profile()),
    }
}
