//! The life of a contact under a steady motion: many cycles at constant load, under error control.

use super::Constants;
use super::mesh::UnitMesh;
use super::patch::{Front, Linear, Motion, Outside, Patch, Rate, State, edge_not_found};
use super::remesh::{check_end_of_body, mesh_slip_zone, parts};
use super::rosenbrock;
use crate::counters::Counters;
use crate::error::Error;
use crate::surface::{MeshPlace, Nodes, Surface};
use std::sync::Arc;

/// Most steps of one call at the usual tolerance of 1e-3: a whole life takes some fifty.
const MOST_STEPS: f64 = 500.0;

/// And behind a rig: where a front hovers, stretches of constant amplitude come sooner to an end.
const MOST_STEPS_BEHIND_A_RIG: f64 = 250.0;

/// And of what is but a small part of a life, which takes one or two. The method is of third order:
/// a thousandth of the tolerance takes ten times as many.
const MOST_STEPS_OF_AN_UPDATE: f64 = 60.0;

/// And at most as many times that, however tight the tolerance: no call may go on for ever.
const MOST_TIGHTER: f64 = 100.0;

/// Most rejected steps of a mesh over wear that other loads have left outside; most have five.
const MOST_REJECTED: u32 = 15;

/// Share of the tolerance that leaving out nodes may take of the largest image.
pub(crate) const THINNING: f64 = 0.05;

/// Most corrections of the volume: the second takes what the first leaves by the difference between
/// the integrals of mesh and nodes.
const CORRECTIONS: usize = 2;

/// How near to the work, relative, the volume has to be, as a share of the tolerance. Each
/// correction makes the nodes again, a third of the time of a short update.
const MET: f64 = 1e-3;

/// Length of the next step as a share of that which should have an error of the tolerance. With
/// 0.6, a life takes 5 to 12 % more systems; with 0.8 at most 3 % fewer, since twice as many steps
/// are rejected.
const SAFETY: f64 = 0.7;

/// Least factor between two steps.
const LEAST_FACTOR: f64 = 0.2;

/// Least error of a step, over the tolerance, that tells a trend.
const LEAST_ERROR: f64 = 1e-2;

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
    let cycles = amount.cycles;
    let mut left = cycles;
    let mut steps = 0;
    let tighter = (1e-3 / settings.tolerance).cbrt().clamp(1.0, MOST_TIGHTER);
    let most = match (amount.is_update, motion.rig) {
        (true, _) => MOST_STEPS_OF_AN_UPDATE,
        (false, Some(_)) => MOST_STEPS_BEHIND_A_RIG,
        (false, None) => MOST_STEPS,
    };
    let most = (most * tighter) as u32;
    // of the surface, m³, where it is known
    let mut worn_volume = None;
    let (mut previous, mut system) = (None, None::<Linear>);
    let mut outside = None;
    while left > 0.0 {
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
        let found = mesh_slip_zone(body, &contact, motion, constants, settings, known)?;
        let Some((patch, mut state, mut rate)) = found else { break };
        // by the work, and what the profile has lost in steps of which that tells nothing
        let (mut volume, mut lost) = (0.0, 0.0);
        let mut step =
            if life.next_step > 0.0 { life.next_step } else { first_step(&patch, &rate, settings) };
        // a front that has just been looked for is off by the error of a new mesh: one step is
        // always made
        let (mut fresh, mut rejected) = (true, 0);
        while left > 0.0 && (fresh || patch.front(&rate) == Front::Kept) {
            if steps >= most {
                let amplitude = motion.sliding.amplitude();
                return Err(Error::TooMuchWear { cycles, left, amplitude, steps });
            }
            steps += 1;
            let length = step.min(left);
            let gamma_step = rosenbrock::GAMMA * length;
            let kept = system.take().filter(|system: &Linear| system.serves(&patch, gamma_step));
            let is_new = kept.is_none();
            let linear = kept.or_else(|| Linear::new(&patch, (&state.depth, &rate), gamma_step, counters));
            let trial = linear
                .as_ref()
                .and_then(|linear| rosenbrock::step(&patch, &state, &rate, length, linear, counters));
            // in the first step the rates change most
            system = linear.filter(|_| is_new && !amount.is_update && previous.is_some());
            let error = trial.as_ref().map_or(f64::INFINITY, |trial| trial.error);
            let ratio = error / (settings.tolerance * patch.most_worn(&rate));
            let factor = step_factor((length, ratio), previous);
            match trial {
                Some(trial) if ratio <= 1.0 => {
                    previous = Some((length, ratio));
                    (state, rate) = (trial.state, trial.rate);
                    match trial.volume {
                        Ok(worked) => volume += worked,
                        Err(of_profile) => lost += of_profile,
                    }
                    fresh = false;
                    if patch.recedes(&rate) {
                        return Err(edge_not_found(motion));
                    }
                    let edge = state.radius_squared.sqrt();
                    if life.surface.reaches_falling_image(edge) {
                        let mut worn = life.surface.clone();
                        worn.set_worn(Some(exported_nodes(&patch, &state, &rate, settings)));
                        worn.check_one_disc(edge)?;
                    }
                    counters.profile_updates += 1;
                    left -= length;
                    // a step cut short says nothing about a longer one, unless it was all but too
                    // long
                    step = if length == step || factor < 1.0 { length * factor } else { step };
                }
                _ => {
                    counters.rejected_steps += 1;
                    rejected += 1;
                    // the edge is held where the wear outside is steep: updates bring it across
                    if patch.outside.is_some() && rejected > MOST_REJECTED {
                        return Err(edge_not_found(motion));
                    }
                    step = length * factor.min(0.8);
                }
            }
        }
        if patch.is_at_end_of_body(&rate) {
            check_end_of_body(&life.surface, motion, constants)?;
        }
        life.next_step = step;
        life.mesh = Some(patch.mesh.clone());
        life.volume += volume + lost.max(0.0);
        let on_mesh = patch.volume(&rate);
        let nodes = if left > 0.0 {
            exported_nodes(&patch, &state, &rate, settings)
        } else {
            let target = amount.worn + life.volume;
            let (nodes, [defect, missing]) = left_at_the_end(&patch, (state, rate), settings, target);
            // it has not carried what other loads have left
            if patch.outside.is_some() && missing > settings.tolerance * target {
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

/// By what the step should change after one of some length and error (over the tolerance), for an
/// error of third order. Where the error rises as time goes on, it is taken to go on rising
/// (Gustafsson, ACM Trans. Math. Softw. 20, 1994, 496; with the bounds of RADAU5 by Hairer and
/// Wanner): without that, one step in four of a life was rejected.
fn step_factor((length, error): (f64, f64), previous: Option<(f64, f64)>) -> f64 {
    if !error.is_finite() {
        return LEAST_FACTOR;
    }
    let factor = SAFETY * error.cbrt().recip();
    let ahead = previous.filter(|_| error <= 1.0).map_or(factor, |(before, last): (f64, f64)| {
        factor * length / before * (last.max(LEAST_ERROR) / error).cbrt()
    });
    factor.min(ahead).clamp(LEAST_FACTOR, 4.0)
}

/// A first step that changes the image by about the size to which the method's error stays within
/// the tolerance.
fn first_step(patch: &Patch, rate: &Rate, settings: &IntegrationSettings) -> f64 {
    let change = patch.largest_image(0, &patch.mesh.abel(&rate.growth), rate);
    0.1 * settings.tolerance.cbrt() * patch.most_worn(rate) / change
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
fn exported_nodes(patch: &Patch, state: &State, rate: &Rate, settings: &IntegrationSettings) -> Nodes {
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
