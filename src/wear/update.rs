//! The linearly implicit profile update and the pressure at the nodes.

use super::{Constants, Pending};
use crate::error::Error;
use crate::parameters::NormalControl;
use crate::surface::{Contact, Nodes, Surface, outer_weight};
use crate::transform::{Tables, dot, leg};
use nalgebra::{DMatrix, DVector};
use std::f64::consts::{FRAC_1_PI, FRAC_2_PI};

/// What lies between the last node inside the contact and the contact edge.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Edge {
    /// Index of the last node with x < a (x ≤ a where the body ends there).
    pub(crate) last: usize,
    /// Contact radius a, m.
    pub(crate) radius: f64,
    /// Whether the load line jumps to zero at the last node (a body that ends there) instead of falling to zero at a.
    pub(crate) jump: bool,
}

impl Edge {
    pub(crate) fn new(nodes: &Nodes, contact: &Contact, outer_radius: f64) -> Self {
        let jump = contact.radius >= outer_radius;
        let inside = nodes.x().partition_point(|&x| x < contact.radius || (jump && x <= contact.radius));
        Self { last: inside.max(1) - 1, radius: contact.radius, jump }
    }

    /// Weight of the load at the last node in the pressure at node i, 1/m, from the piece behind that node.
    fn weight(&self, x: &[f64], i: usize) -> f64 {
        let (r, end) = (x[i], x[self.last]);
        if !self.jump {
            return FRAC_2_PI / (leg(self.radius, r) + leg(end, r));
        }
        if i < self.last {
            FRAC_1_PI / leg(end, r)
        } else {
            // the edge node stands for the outer half of its cell (in Z): mean of 1/√(b² − r²) over that
            let inner = x[i - 1];
            let half = 0.5 * (end - inner) * (end + inner);
            FRAC_2_PI / half.sqrt()
        }
    }

    /// The same for a change of load there, which also moves the edge: q ≈ γ (a² − x²) keeps its slope.
    fn response(&self, x: &[f64], i: usize) -> f64 {
        let weight = self.weight(x, i);
        if self.jump {
            return weight;
        }
        let (r, end) = (x[i], x[self.last]);
        let reach = leg(self.radius, r);
        let area = (self.radius - end) * (self.radius + end);
        if reach > 0.0 { weight * (1.0 - area / (2.0 * reach * (reach + leg(end, r)))) } else { weight }
    }
}

/// Transform of a load line given at the nodes up to the edge: p or τ at the nodes 0..=last.
pub(crate) fn pressure_nodes(tables: &Tables, x: &[f64], load: &[f64], edge: &Edge) -> Vec<f64> {
    let k = edge.last;
    let drops: Vec<f64> = load[..=k].windows(2).map(|w| w[0] - w[1]).collect();
    (0..=k)
        .map(|i| dot(&tables.pressure_weights(i)[..k - i], &drops[i..]) + load[k] * edge.weight(x, i))
        .collect()
}

/// The result of an update.
#[derive(Debug, Clone)]
pub(crate) struct Update {
    /// Worn depth at all nodes, m ≥ 0.
    pub(crate) depth: Vec<f64>,
    /// Linear systems factorised on the way.
    pub(crate) factorisations: u64,
}

/// Most Newton iterations of an update. The pressure is linear in the wear, so that one suffices as long as the
/// contact edge stays in its cell.
const MOST_ITERATIONS: u64 = 4;

/// Worn depth that a pending history brings, with the pressure and the contact edge taken at the end of the update.
///
/// Solves Δw = (k/σ₀) A + κ B (p(h + Δh) − p(h)) by Newton's method. The edge moves along with the wear: were it held, a
/// whole update's wear would end at it like a square root, and its image would have a logarithmic dip there.
///
/// # Errors
/// Those of the normal contact; [`Error::NotFinite`] if the system cannot be solved.
pub(crate) fn worn_depth(
    surface: &Surface,
    tables: &Tables,
    pending: &Pending,
    control: NormalControl,
    constants: &Constants,
    tolerance: f64,
) -> Result<Update, Error> {
    let mut update = Update { depth: Vec::new(), factorisations: 0 };
    let Some(nodes) = surface.worn() else { return Ok(update) };
    update.depth = vec![0.0; nodes.x().len()];
    // nodes may have been added outside since the history was gathered: nothing has slipped there
    let mut pending = pending.clone();
    pending.work_per_area.resize(nodes.x().len(), 0.0);
    pending.slip_path.resize(nodes.x().len(), 0.0);
    let pending = &pending;
    let Some(first) = pending.slip_path.iter().position(|s| *s > 0.0) else { return Ok(update) };
    let Some(present) = &pending.contact else { return Ok(update) };
    let profile = surface.profile();
    let unworn: Vec<f64> = nodes.x().iter().map(|&x| profile.image(x)).collect();
    let pressure = |contact: &Contact, worn: &[f64]| {
        let edge = Edge::new(nodes, contact, profile.outer_radius());
        let load: Vec<f64> = (0..=edge.last)
            .map(|i| constants.normal_modulus * (contact.depth - unworn[i] - worn[i]).max(0.0))
            .collect();
        (pressure_nodes(tables, nodes.x(), &load, &edge), edge)
    };
    let (reference, _) = pressure(present, nodes.worn_image());
    let kappa = constants.wear_per_work * constants.friction_coefficient;
    let mut trial = surface.clone();
    let mut contact = *present;
    let mut change = vec![0.0; nodes.x().len()];
    while update.factorisations < MOST_ITERATIONS {
        let worn: Vec<f64> = nodes.worn_image().iter().zip(&change).map(|(h, dh)| h + dh).collect();
        let (now, edge) = pressure(&contact, &worn);
        // a trial that wears so much that the contact opens has no pressure to go on with
        if contact.is_open() || first > edge.last {
            break;
        }
        let residual = DVector::from_fn(edge.last + 1 - first, |row, _| {
            let i = first + row;
            let before = reference.get(i).copied().unwrap_or(0.0);
            constants.wear_per_work * pending.work_per_area[i]
                + kappa * pending.slip_path[i] * (now[i] - before)
                - update.depth[i]
        });
        let (matrix, descent) = system(nodes.x(), tables, pending, first, &edge, constants);
        let Some(correction) = matrix.lu().solve(&residual) else { return Err(not_finite(present)) };
        update.factorisations += 1;
        let worn_off = descent * &correction;
        if worn_off.iter().any(|w| !w.is_finite()) {
            return Err(not_finite(present));
        }
        for (row, w) in worn_off.iter().enumerate() {
            update.depth[first + row] += w;
        }
        for i in edge.last + 1..update.depth.len() {
            update.depth[i] = constants.wear_per_work * pending.work_per_area[i];
        }
        change = tables.ascend(&update.depth);
        let mut moved = nodes.clone();
        let image = nodes.worn_image().iter().zip(&change).map(|(h, dh)| h + dh).collect();
        moved.set_worn(image, nodes.depth().to_vec(), profile);
        trial.set_worn(Some(moved));
        contact = trial.contact(control, present.control, 2.0 * constants.normal_modulus)?;
        let next = Edge::new(nodes, &contact, profile.outer_radius());
        if next.last == edge.last || correction.amax() <= 0.1 * tolerance * present.depth.abs() {
            break;
        }
    }
    for (w, path) in update.depth.iter_mut().zip(&pending.slip_path) {
        *w = if *path > 0.0 { w.max(0.0) } else { 0.0 };
    }
    Ok(update)
}

fn not_finite(contact: &Contact) -> Error {
    Error::NotFinite { what: "the worn depth", normal: contact.control, displacement: 0.0 }
}

/// The matrix S + κ E* B P over the nodes `first` to the edge, and S.
fn system(
    x: &[f64],
    tables: &Tables,
    pending: &Pending,
    first: usize,
    edge: &Edge,
    constants: &Constants,
) -> (DMatrix<f64>, DMatrix<f64>) {
    let last = edge.last;
    let size = last + 1 - first;
    let kappa = constants.wear_per_work * constants.friction_coefficient * constants.normal_modulus;
    let mut descent = DMatrix::zeros(size, size);
    let mut matrix = DMatrix::zeros(size, size);
    let widths = depth_weights(x, edge);
    for row in 0..size {
        let i = first + row;
        let weights = tables.descent_weights(i);
        for column in 0..=row {
            let j = first + column;
            let inner = if j == 0 { 1.0 } else { weights[j - 1] };
            descent[(row, column)] = inner - weights.get(j).copied().unwrap_or(0.0);
        }
        let stiffness = kappa * pending.slip_path[i];
        if stiffness == 0.0 {
            continue;
        }
        let row_weights = tables.pressure_weights(i);
        let mut uniform = 0.0;
        for j in i..=last {
            let outer = if j < last { row_weights[j - i] } else { edge.response(x, i) };
            let inner = if j > i { row_weights[j - 1 - i] } else { 0.0 };
            matrix[(row, j - first)] = stiffness * (outer - inner);
            uniform += outer - inner;
        }
        if constants.force_control {
            // the body sinks by the mean of Δh over the contact
            for column in 0..size {
                matrix[(row, column)] -= stiffness * uniform * widths[first + column];
            }
        }
    }
    matrix += &descent;
    (matrix, descent)
}

/// Weights of the nodes in (1/a) ∫₀ᵃ h dx.
fn depth_weights(x: &[f64], edge: &Edge) -> Vec<f64> {
    let mut weights = vec![0.0; edge.last + 1];
    for j in 0..edge.last {
        let (width, outer) = (x[j + 1] - x[j], outer_weight(x[j], x[j + 1]));
        weights[j] += (1.0 - outer) * width / edge.radius;
        weights[j + 1] += outer * width / edge.radius;
    }
    weights[edge.last] += (edge.radius - x[edge.last]) / edge.radius;
    weights
}
