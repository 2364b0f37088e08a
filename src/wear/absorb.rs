//! The backlog worn off: its slip law applied to the profile by a stiff integrator, on nodes at
//! rest.
//!
//! Over 0 ≤ τ ≤ 1 the worn depth grows by ∂w/∂τ = κ Σ_b p(r; d_b) D[E_b(g)](r), κ = kμ/σ₀, with the
//! pressure under each depth of the backlog and the slip path that springs have under it, both on
//! the profile as it is at τ. D is the Abel transform from springs to surface. Under force control
//! the depths follow the loads that they had at the start, and a spring keeps its slip path by its
//! overlap d_b − g.

use super::backlog::SlipAtDepth;
use super::update::Edge;
use super::{Constants, rosenbrock};
use crate::engine::Counters;
use crate::error::Error;
use crate::profile::Profile;
use crate::quadrature::GAUSS;
use crate::surface::{Nodes, outer_weight};
use crate::transform::{self, dot};
use nalgebra::{DMatrix, DVector};

/// Steps of one backlog at the most.
const MOST_STEPS: u32 = 1000;

/// Share of the tolerance that one step may err by.
const STEP_SHARE: f64 = 0.2;

/// Share of the depth by which the last node inside a contact is pressed at least.
const EDGE: f64 = 1e-12;

/// Both transforms of a set of nodes, as triangles of weights.
#[derive(Debug)]
pub(crate) struct Operator {
    /// Row i: weights of the values 0..=i in D at node i.
    descent: Vec<Vec<f64>>,
    /// Row i: weights of the rises g_{j+1} − g_j, j ≥ i, in p/E* at node i, 1/m.
    pressure: Vec<Vec<f64>>,
}

impl Operator {
    pub(crate) fn new(x: &[f64]) -> Self {
        let count = x.len();
        let descent = (0..count).map(|i| {
            let mut row = vec![0.0; i + 1];
            row[0] = 1.0;
            transform::descent_row(&x[..=i], x[i], |j, weight| {
                row[j] -= weight;
                row[j + 1] += weight;
            });
            row
        });
        let pressure = (0..count)
            .map(|i| (i..count - 1).map(|j| transform::pressure_weight(x[j], x[j + 1], x[i])).collect());
        Self { descent: descent.collect(), pressure: pressure.collect() }
    }

    fn descend(&self, values: &[f64]) -> Vec<f64> {
        self.descent.iter().map(|row| dot(row, &values[..row.len()])).collect()
    }

    /// The values of which D makes `target`.
    fn ascend(&self, target: &[f64]) -> Vec<f64> {
        let mut values = vec![0.0; target.len()];
        for (i, row) in self.descent.iter().enumerate() {
            values[i] = (target[i] - dot(&row[..i], &values[..i])) / row[i];
        }
        values
    }
}

/// The profile after a backlog.
#[derive(Debug)]
pub(crate) struct Absorbed {
    /// Image of the wear and worn depth at the nodes, m.
    pub(crate) worn: (Vec<f64>, Vec<f64>),
    /// Volume that wore, m³.
    pub(crate) volume: f64,
    /// Volume that would have healed, m³, where a pressure overshoots.
    pub(crate) clipped: f64,
}

/// One depth of the backlog on the profile at some τ.
struct Level {
    depth: f64,
    edge: Edge,
    /// d − g at the last node inside, m.
    overlap: f64,
}

struct Problem<'a> {
    nodes: &'a Nodes,
    x: &'a [f64],
    unworn: Vec<f64>,
    operator: &'a Operator,
    law: &'a [SlipAtDepth],
    /// Loads over 2E* of the levels at the start, m², under force control.
    loads: Option<Vec<f64>>,
    /// κE* times the factor that makes the first rate that of the springs' work.
    factor: f64,
}

/// Rate at one state, with what its Jacobian needs.
struct Rate<'a> {
    growth: Vec<f64>,
    levels: Vec<(Level, &'a SlipAtDepth)>,
    /// Per level: pressure over E*, slip and its derivative by g of the spring at each node.
    pressure: Vec<Vec<f64>>,
    slip: Vec<Vec<f64>>,
    softening: Vec<Vec<f64>>,
}

impl<'a> Problem<'a> {
    /// ∫ g dx up to each node, for g linear in x² between nodes, m².
    fn integrals(&self, image: &[f64]) -> Vec<f64> {
        let mut sum = 0.0;
        let mut integrals = vec![0.0];
        for (x, g) in self.x.windows(2).zip(image.windows(2)) {
            let outer = outer_weight(x[0], x[1]);
            sum += (x[1] - x[0]) * ((1.0 - outer) * g[0] + outer * g[1]);
            integrals.push(sum);
        }
        integrals
    }

    fn level(&self, image: &[f64], depth: f64) -> Option<Level> {
        // a node at the very edge carries nothing, and its share of the pressure is infinite times
        // nothing
        let least = depth - EDGE * (depth - image[0]).abs();
        let last = image.iter().rposition(|g| *g < least)?;
        let overlap = depth - image[last];
        if last + 1 == image.len() {
            let edge = Edge { last, radius: self.x[last], jump: true };
            return Some(Level { depth, edge, overlap });
        }
        let (x0, x1) = (self.x[last], self.x[last + 1]);
        let share = overlap / (image[last + 1] - image[last]);
        let radius = (x0 * x0 + share * (x1 - x0) * (x1 + x0)).sqrt();
        Some(Level { depth, edge: Edge { last, radius, jump: false }, overlap })
    }

    /// ∫ (d − g) dx over the contact, m².
    fn load(&self, level: &Level, integrals: &[f64]) -> f64 {
        let Edge { last, radius, .. } = level.edge;
        let inner = level.depth * self.x[last] - integrals[last];
        let rest = radius - self.x[last];
        inner
            + if rest > 0.0 { rest * (1.0 - outer_weight(self.x[last], radius)) * level.overlap } else { 0.0 }
    }

    fn level_at_load(&self, image: &[f64], integrals: &[f64], load: f64, depth: f64) -> Option<Level> {
        let mut level = self.level(image, depth);
        for _ in 0..50 {
            let depth = match &level {
                None => 1.01 * depth.abs() + image[0],
                Some(level) => {
                    level.depth + (load - self.load(level, integrals)) / level.edge.radius.max(1e-300)
                }
            };
            let done = level.as_ref().is_some_and(|level| (depth - level.depth).abs() <= 1e-15 * depth.abs());
            level = self.level(image, depth);
            if done {
                break;
            }
        }
        level
    }

    fn rate(&self, worn: &[f64]) -> Option<Rate<'a>> {
        let count = self.x.len();
        let image: Vec<f64> = self.unworn.iter().zip(worn).map(|(g, h)| g + h).collect();
        let mut rate = Rate {
            growth: vec![0.0; count],
            levels: Vec::new(),
            pressure: Vec::new(),
            slip: Vec::new(),
            softening: Vec::new(),
        };
        let integrals = if self.loads.is_some() { self.integrals(&image) } else { Vec::new() };
        for (b, law) in self.law.iter().enumerate() {
            let level = match &self.loads {
                None => self.level(&image, law.depth),
                Some(loads) => self.level_at_load(&image, &integrals, loads[b], law.depth),
            };
            // a body held in depth may wear free
            let Some(level) = level else { continue };
            let shift = level.depth - law.depth;
            let last = level.edge.last;
            let (path, softening): (Vec<f64>, Vec<f64>) =
                image[..=last].iter().map(|g| law.at(g - shift)).unzip();
            let rises: Vec<f64> = image[..=last].windows(2).map(|g| g[1] - g[0]).collect();
            let mut pressure = Vec::with_capacity(last + 1);
            let mut slip = Vec::with_capacity(last + 1);
            for i in 0..=last {
                let p = dot(&self.operator.pressure[i][..last - i], &rises[i..])
                    + level.overlap * level.edge.weight(self.x, i);
                let s = dot(&self.operator.descent[i], &path[..=i]);
                rate.growth[i] += self.factor * p * s;
                pressure.push(p);
                slip.push(s);
            }
            rate.levels.push((level, law));
            rate.pressure.push(pressure);
            rate.slip.push(slip);
            rate.softening.push(softening);
        }
        // the product at the nodes has the work of the springs but for its quadrature
        let work: f64 = rate.levels.iter().map(|(level, law)| self.work(&image, level, law)).sum();
        let found = self.nodes.volume(&rate.growth);
        if found > 0.0 {
            let share = self.factor * work / found;
            rate.growth.iter_mut().for_each(|growth| *growth *= share);
        }
        rate.growth.iter().all(|g| g.is_finite()).then_some(rate)
    }

    /// 2 ∫ (d − g) E dx of a level, m³: the work of its springs over μE*, by Gauss in each cell.
    fn work(&self, image: &[f64], level: &Level, law: &SlipAtDepth) -> f64 {
        let shift = level.depth - law.depth;
        let cell = |x0: f64, x1: f64, (g0, g1): (f64, f64)| -> f64 {
            let (middle, half) = (0.5 * (x0 + x1), 0.5 * (x1 - x0));
            let at = |(node, weight): &(f64, f64)| {
                let x = middle + half * node;
                let image = g0 + (g1 - g0) * (x - x0) * (x + x0) / ((x1 - x0) * (x1 + x0));
                weight * (level.depth - image) * law.at(image - shift).0
            };
            2.0 * half * GAUSS.iter().map(at).sum::<f64>()
        };
        let last = level.edge.last;
        let inside: f64 = (0..last)
            .filter(|&j| law.at(image[j + 1] - shift).0 > 0.0)
            .map(|j| cell(self.x[j], self.x[j + 1], (image[j], image[j + 1])))
            .sum();
        let edge = level.edge.radius;
        inside + if edge > self.x[last] { cell(self.x[last], edge, (image[last], level.depth)) } else { 0.0 }
    }

    /// D − γτJ in the image of the wear, from node `first` on.
    fn matrix(&self, rate: &Rate, gamma_step: f64, first: usize) -> DMatrix<f64> {
        let size = self.x.len() - first;
        let c = gamma_step * self.factor;
        let mut matrix = vec![0.0; size * size];
        let mut slip = vec![0.0; self.x.len()];
        let mut softening = vec![0.0; self.x.len()];
        for (i, row) in (first..self.x.len()).zip(matrix.chunks_exact_mut(size)) {
            // Σ p dE/dg at the nodes inside, and Σ s of the levels whose contact goes on behind
            // each node outside
            slip.fill(0.0);
            softening.fill(0.0);
            for (b, (level, _)) in rate.levels.iter().enumerate() {
                let last = level.edge.last;
                if i > last {
                    continue;
                }
                let (p, s) = (c * rate.pressure[b][i], c * rate.slip[b][i]);
                slip[last] += s;
                row[last - first] += s * level.edge.response(self.x, i);
                for (sum, soft) in softening[first..=i].iter_mut().zip(&rate.softening[b][first..=i]) {
                    *sum += p * soft;
                }
            }
            for ((entry, weight), soft) in
                row.iter_mut().zip(&self.operator.descent[i][first..]).zip(&softening[first..])
            {
                *entry += weight * (1.0 - soft);
            }
            let weights = &self.operator.pressure[i];
            let mut behind: f64 = slip[i..].iter().sum();
            for j in i..self.x.len() - 1 {
                behind -= slip[j];
                if behind == 0.0 {
                    break;
                }
                let relief = behind * weights[j - i];
                row[j - first] += relief;
                row[j + 1 - first] -= relief;
            }
        }
        DMatrix::from_row_slice(size, size, &matrix)
    }
}

impl<'a> Problem<'a> {
    fn new(
        (nodes, profile): (&'a Nodes, &Profile),
        operator: &'a Operator,
        law: &'a [SlipAtDepth],
        constants: &Constants,
    ) -> Option<Self> {
        let x = nodes.x();
        let mut problem = Self {
            nodes,
            x,
            unworn: x.iter().map(|x| profile.image(*x)).collect(),
            operator,
            law,
            loads: None,
            factor: constants.wear_per_work * constants.friction_coefficient * constants.normal_modulus,
        };
        if constants.force_control {
            let image: Vec<f64> = problem.unworn.iter().zip(nodes.worn_image()).map(|(g, h)| g + h).collect();
            let integrals = problem.integrals(&image);
            let load = |law: &SlipAtDepth| {
                problem.level(&image, law.depth).map(|level| problem.load(&level, &integrals))
            };
            problem.loads = Some(law.iter().map(load).collect::<Option<Vec<f64>>>()?);
        }
        Some(problem)
    }

    /// The rate at the start, scaled to the volume that the springs' work wears, m³. `None` where
    /// nothing of it is on the nodes.
    fn first_rate(&mut self, volume: f64) -> Option<Option<Rate<'a>>> {
        let mut rate = self.rate(self.nodes.worn_image())?;
        let found = self.nodes.volume(&rate.growth);
        if found <= 0.0 {
            return Some(None);
        }
        let share = volume / found;
        self.factor *= share;
        rate.growth.iter_mut().for_each(|growth| *growth *= share);
        Some(Some(rate))
    }
}

/// Wears the slip law of a backlog off, of which the springs say that it wears a `volume` (m³) on
/// the profile at the start.
///
/// # Errors
/// [`Error::WearOutrun`] where too many steps are needed; [`Error::NotFinite`] where the contact edge is lost.
pub(crate) fn absorb(
    (nodes, profile): (&Nodes, &Profile),
    operator: &Operator,
    law: &[SlipAtDepth],
    volume: f64,
    (constants, tolerance): (&Constants, f64),
    counters: &mut Counters,
) -> Result<Absorbed, Error> {
    let mut worn = nodes.worn_image().to_vec();
    let mut depth = nodes.depth().to_vec();
    let lost = || Error::NotFinite { what: "the worn depth", normal: law[0].depth, displacement: 0.0 };
    let mut problem = Problem::new((nodes, profile), operator, law, constants).ok_or_else(lost)?;
    let Some(mut rate) = problem.first_rate(volume).ok_or_else(lost)? else {
        return Ok(Absorbed { worn: (worn, depth), volume: 0.0, clipped: 0.0 });
    };
    let first = rate.growth.iter().position(|growth| *growth != 0.0).unwrap_or(0);
    let scale = law.iter().map(|law| law.depth).fold(0.0, f64::max).abs();
    let (mut done, mut step, mut steps) = (0.0, 1.0f64, 0);
    let before = nodes.volume(&depth);
    while done < 1.0 {
        if steps == MOST_STEPS {
            return Err(Error::WearOutrun { from: 0.0, displacement: 0.0 });
        }
        steps += 1;
        let length = step.min(1.0 - done);
        let trial = advance(&problem, (&worn, &depth), &rate, length, first);
        counters.factorisations += 1;
        let ratio = trial.as_ref().map_or(f64::INFINITY, |trial| trial.2 / (STEP_SHARE * tolerance * scale));
        let factor = if ratio.is_finite() { (0.8 * ratio.cbrt().recip()).clamp(0.2, 4.0) } else { 0.2 };
        match trial {
            Some((next, next_depth, _, next_rate)) if ratio <= 1.0 => {
                (worn, depth, rate) = (next, next_depth, next_rate);
                done += length;
                step = length * factor;
            }
            _ => {
                counters.rejected_steps += 1;
                step = length * factor.min(0.8);
            }
        }
    }
    counters.profile_updates += 1;
    let healed: Vec<f64> = nodes.depth().iter().zip(&depth).map(|(old, new)| (old - new).max(0.0)).collect();
    let mut clipped = 0.0;
    if healed.iter().any(|healed| *healed > 0.0) {
        clipped = nodes.volume(&healed);
        depth.iter_mut().zip(&healed).for_each(|(depth, healed)| *depth += healed);
        worn = operator.ascend(&depth);
    }
    let volume = nodes.volume(&depth) - before;
    Ok(Absorbed { worn: (worn, depth), volume, clipped })
}

type Trial<'a> = (Vec<f64>, Vec<f64>, f64, Rate<'a>);

/// One step of the stiff integrator: image and depth at its end, and the largest error of the
/// image, m.
fn advance<'a>(
    problem: &Problem<'a>,
    (worn, depth): (&[f64], &[f64]),
    rate: &Rate,
    length: f64,
    first: usize,
) -> Option<Trial<'a>> {
    use rosenbrock::{ALPHA, COUPLING, EMBEDDED, GAMMA, WEIGHTS};
    let count = worn.len();
    let lu = problem.matrix(rate, GAMMA * length, first).lu();
    // increments of image and depth
    let mut increments: Vec<(Vec<f64>, Vec<f64>)> = Vec::with_capacity(4);
    for stage in 0..4 {
        let mut right = if stage == 0 {
            rate.growth.clone()
        } else {
            let mut image = worn.to_vec();
            for (alpha, increment) in ALPHA[stage].iter().zip(&increments) {
                add(&mut image, length * alpha, &increment.0);
            }
            problem.rate(&image)?.growth
        };
        for (coupling, increment) in COUPLING[stage].iter().zip(&increments) {
            add(&mut right, coupling / GAMMA, &increment.1);
        }
        let mut solution = DVector::from_column_slice(&right[first..]);
        if !lu.solve_mut(&mut solution) {
            return None;
        }
        let mut image = vec![0.0; count];
        image[first..].copy_from_slice(solution.as_slice());
        let mut depth = problem.operator.descend(&image);
        for (coupling, increment) in COUPLING[stage].iter().zip(&increments) {
            add(&mut image, -coupling / GAMMA, &increment.0);
            add(&mut depth, -coupling / GAMMA, &increment.1);
        }
        increments.push((image, depth));
    }
    let (mut image, mut depth, mut error) = (worn.to_vec(), depth.to_vec(), vec![0.0; count]);
    for (stage, increment) in increments.iter().enumerate() {
        add(&mut image, length * WEIGHTS[stage], &increment.0);
        add(&mut depth, length * WEIGHTS[stage], &increment.1);
        add(&mut error, length * (WEIGHTS[stage] - EMBEDDED[stage]), &increment.0);
    }
    let rate = problem.rate(&image)?;
    let inside = rate.levels.iter().map(|(level, _)| level.edge.last + 1).max().unwrap_or(0);
    let largest = error[..inside].iter().fold(0.0f64, |most, e| if e.abs() <= most { most } else { e.abs() });
    Some((image, depth, largest, rate))
}

fn add(sum: &mut [f64], factor: f64, term: &[f64]) {
    if factor != 0.0 {
        for (s, t) in sum.iter_mut().zip(term) {
            *s += factor * t;
        }
    }
}

#[cfg(test)]
mod tests;
