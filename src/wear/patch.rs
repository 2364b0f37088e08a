//! The slipping region of a contact while it wears under a steady motion, on a mesh that moves with the contact edge.
//!
//! One cycle of amplitude U₀ at constant load wears ∂w/∂N = 4 κ p s with κ = kμ/σ₀, the pressure p of q = d − g and the
//! slip s = descent of σ = max(U₀ − m q, 0), m = μE*/G*. Here w̃ is the depth that belongs to the image inside the
//! region alone, h·1[x ≥ c]: what lies inside the stick radius c has no part in the rate of wear, and the depth at
//! the contact edge a is zero, so that w̃(a) = −w_in(a), minus the depth there that belongs to the image inside. (Where the
//! body is worn further out already, its wear so far counts as its shape, and w̃ is what comes on top.) The nodes move with
//! a² like X = c² + L φ; at them dw̃/dN = R + (∂w̃/∂X) φ dA/dN with A = a². All fields stay smooth in the mesh coordinate, at
//! the moving edge too.

mod direct;
mod linear;
mod multigrid;

use super::Constants;
use super::mesh::{Region, UnitMesh};
use crate::error::Error;
use crate::parameters::NormalControl;
use crate::profile::Profile;
use crate::quadrature::GAUSS;
use crate::surface::{Contact, Surface};
use crate::transform::dot;
use std::f64::consts::FRAC_2_PI;
use std::sync::Arc;

/// How near to the end of the body, relative, a contact edge counts as standing there. A worn rim carries next to nothing, and
/// would come and go at every step.
pub(crate) const RIM: f64 = 1e-4;

/// Largest share by which depths may grow for a volume to be met: what is off by more is no error of a mesh.
const MOST_GROWTH: f64 = 0.5;

pub(super) use linear::Linear;

/// What wears the surface: a motion that repeats, at constant load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Motion {
    /// Which normal quantity is held.
    pub(crate) control: NormalControl,
    /// F_N/(2E*) in m² or the indentation depth in m.
    pub(crate) value: f64,
    pub(crate) sliding: Sliding,
}

/// How the body moves.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub(crate) enum Sliding {
    /// Cycles between ±U₀ (m); wear is counted in cycles.
    Cycles(f64),
    /// On and on in one direction, all springs slipping; wear is counted in metres of path.
    Onward,
}

impl Sliding {
    /// Slip σ = reach − ratio·m q, of which `strokes` make a unit.
    fn law(self) -> (f64, f64, f64) {
        match self {
            Self::Cycles(amplitude) => (amplitude, 1.0, 4.0),
            Self::Onward => (1.0, 0.0, 1.0),
        }
    }

    /// Largest q at which a spring slips, over 1/m.
    pub(crate) fn amplitude(self) -> f64 {
        match self {
            Self::Cycles(amplitude) => amplitude,
            Self::Onward => f64::INFINITY,
        }
    }
}

/// Wear inside the stick radius, which does not change while the region wears.
#[derive(Debug, Clone, Default)]
pub(crate) struct Frozen {
    /// Radii 0 … c, m; none on a disc.
    pub(crate) x: Vec<f64>,
    /// Image of the wear, m.
    pub(crate) image: Vec<f64>,
    /// Depth, m.
    pub(crate) depth: Vec<f64>,
}

impl Frozen {
    /// Points x² and weights W with which the image alone brings the depth (2/π) ∫ h dx/√(r² − x²) = Σ W/√(r² − x²)
    /// outside, by three-point Gauss in each worn cell.
    fn sources(&self) -> Vec<(f64, f64)> {
        let mut sources = Vec::new();
        for (x, h) in self.x.windows(2).zip(self.image.windows(2)).filter(|(_, h)| h[0] != 0.0 || h[1] != 0.0)
        {
            let (middle, half) = (0.5 * (x[0] + x[1]), 0.5 * (x[1] - x[0]));
            for (node, weight) in GAUSS {
                let x_node = middle + half * node;
                let share = (x_node - x[0]) * (x_node + x[0]) / ((x[1] - x[0]) * (x[1] + x[0]));
                let image = h[0] + share * (h[1] - h[0]);
                sources.push((x_node * x_node, FRAC_2_PI * half * weight * image));
            }
        }
        sources
    }

    /// Image at the outermost node, m.
    fn edge_image(&self) -> f64 {
        self.image.last().copied().unwrap_or(0.0)
    }

    /// Without the nodes that the line (in x²) between those which stay meets within a share of the largest image.
    pub(crate) fn thinned(&self, share: f64) -> Self {
        let kept = crate::surface::kept_nodes(&self.x, &self.image, share, true);
        let pick = |field: &[f64]| kept.iter().map(|&k| field[k]).collect();
        Self { x: pick(&self.x), image: pick(&self.image), depth: pick(&self.depth) }
    }

    /// ∫ h dx, m².
    fn width_integral(&self) -> f64 {
        let mut sum = 0.0;
        for (x, h) in self.x.windows(2).zip(self.image.windows(2)) {
            let outer = crate::surface::outer_weight(x[0], x[1]);
            sum += (x[1] - x[0]) * ((1.0 - outer) * h[0] + outer * h[1]);
        }
        sum
    }
}

/// The region: the body, its mesh, and the law.
#[derive(Debug, Clone)]
pub(crate) struct Patch {
    /// The body without the wear that the mesh carries and that of `inside`.
    pub(crate) body: Surface,
    pub(crate) mesh: Arc<UnitMesh>,
    /// Stick radius c, m; 0 on a disc.
    pub(crate) inner_radius: f64,
    pub(crate) inside: Frozen,
    pub(crate) motion: Motion,
    /// Whether the contact ends at the end of the body, so that its edge stays there.
    pub(crate) rim: bool,
    /// Slip of a spring that is free of load, m per stroke.
    reach: f64,
    bound_slope: f64,
    /// 4κE*: wear per cycle = factor · (p/E*) · s.
    factor: f64,
    inside_width: f64,
    sources: Vec<(f64, f64)>,
}

/// Depths w̃ at the nodes, m, and the square of the contact radius, m².
#[derive(Debug, Clone)]
pub(crate) struct State {
    pub(crate) depth: Vec<f64>,
    pub(crate) area: f64,
}

/// Everything that follows from a state.
#[derive(Debug, Clone)]
pub(crate) struct Rate {
    /// dw̃/dN at the moving nodes, m.
    pub(crate) growth: Vec<f64>,
    /// z of the state.
    pub(crate) image: Vec<f64>,
    pub(crate) area: f64,
    pub(crate) indentation: f64,
    /// σ at the nodes, m.
    pub(crate) slip: Vec<f64>,
    radius: Vec<f64>,
    /// b: z = b·h.
    scale: Vec<f64>,
    pressure: Vec<f64>,
    surface_slip: Vec<f64>,
    /// φ ∂w̃/∂X.
    drift: Vec<f64>,
    /// dA/dN, m².
    area_rate: f64,
    /// Worn volume per cycle by the work of the springs, m³.
    pub(crate) volume_rate: f64,
    /// Ratio by which the product of p and s is scaled to the work of the springs.
    pub(crate) share: f64,
}

/// Sensitivity of the condition that fixes the contact edge.
#[derive(Debug)]
struct EdgeCondition {
    /// To the depths at the nodes.
    depth: Vec<f64>,
    /// To A, at fixed depths inside.
    area: f64,
}

impl Patch {
    /// A region from `inner_radius` (0 on a disc) to the contact edge.
    pub(crate) fn new(
        (body, inside): (Surface, Frozen),
        mesh: Arc<UnitMesh>,
        inner_radius: f64,
        motion: Motion,
        rim: bool,
        constants: &Constants,
    ) -> Self {
        let kappa = constants.wear_per_work * constants.friction_coefficient;
        let (reach, ratio, strokes) = motion.sliding.law();
        Self {
            body,
            mesh,
            inner_radius,
            inside_width: inside.width_integral(),
            sources: inside.sources(),
            inside,
            motion,
            rim,
            reach,
            bound_slope: ratio * constants.bound_slope(),
            factor: strokes * kappa * constants.normal_modulus,
        }
    }

    fn cells(&self) -> usize {
        self.mesh.cells
    }

    /// One past the last node whose depth is unknown: at a moving edge it is given.
    pub(crate) fn end(&self) -> usize {
        if self.rim { self.cells() + 1 } else { self.cells() }
    }

    fn is_force(&self) -> bool {
        self.motion.control == NormalControl::Force
    }

    /// L = a² − c², m².
    pub(crate) fn span(&self, area: f64) -> f64 {
        area - self.inner_radius * self.inner_radius
    }

    pub(crate) fn radii(&self, area: f64) -> Vec<f64> {
        let (c2, span) = (self.inner_radius * self.inner_radius, self.span(area));
        let mut x: Vec<f64> = self.mesh.share.iter().map(|phi| (c2 + span * phi).sqrt()).collect();
        x[0] = self.inner_radius;
        x
    }

    /// b = z/h at a radius.
    fn scale(&self, span: f64, x: f64) -> f64 {
        match self.mesh.region {
            Region::Annulus => span.sqrt() / x,
            Region::Disc => 1.0,
        }
    }

    /// z at the inner edge of an annulus, which is given.
    fn inner_image(&self, span: f64) -> f64 {
        match self.mesh.region {
            Region::Annulus => self.scale(span, self.inner_radius) * self.inside.edge_image(),
            Region::Disc => 0.0,
        }
    }

    /// w̃ at the contact edge.
    pub(crate) fn edge_depth(&self, a: f64) -> f64 {
        -self.depth_from_inside(a)
    }

    /// Depth (m) at a radius outside the front that belongs to the image inside it.
    pub(crate) fn depth_from_inside(&self, r: f64) -> f64 {
        self.sources.iter().map(|(x2, weight)| weight / (r * r - x2).sqrt()).sum()
    }

    /// Residual of the condition for the edge: g(a) − d, or what the load lacks, from Σ edge·w̃ and Σ mean·w̃ over the
    /// nodes before the last.
    fn edge_residual(&self, area: f64, sums: (f64, f64)) -> f64 {
        let (a, span, end) = (area.sqrt(), self.span(area), self.cells());
        if a > self.body.profile().outer_radius() {
            return f64::INFINITY;
        }
        let (depth, inner) = (self.edge_depth(a), self.inner_image(span));
        let mesh = &self.mesh;
        let z = sums.0 + mesh.edge_image.depth[end] * depth + mesh.edge_image.inner * inner;
        let h = z / self.scale(span, a);
        if !self.is_force() {
            return self.body.image(a) + h - self.motion.value;
        }
        let mean = sums.1 + mesh.mean_image.depth[end] * depth + mesh.mean_image.inner * inner;
        self.body.load(a) + a * h - self.inside_width - span.sqrt() * mean - self.motion.value
    }

    fn edge_sums(&self, depth: &[f64]) -> (f64, f64) {
        let end = self.cells();
        (
            dot(&self.mesh.edge_image.depth[..end], &depth[..end]),
            dot(&self.mesh.mean_image.depth[..end], &depth[..end]),
        )
    }

    /// Slope of the residual in A, by a central difference, or from inside next to the end of the body.
    fn edge_slope(&self, area: f64, sums: (f64, f64)) -> f64 {
        let step = 1e-5 * self.span(area);
        let outer = if self.is_inside(area + step) { step } else { 0.0 };
        let rise = self.edge_residual(area + outer, sums) - self.edge_residual(area - step, sums);
        rise / (outer + step)
    }

    fn is_inside(&self, area: f64) -> bool {
        area.sqrt() <= self.body.profile().outer_radius()
    }

    /// A that satisfies the condition for the edge, by Newton's method from a guess, else by bisection.
    fn solve_area(&self, depth: &[f64], guess: f64) -> Option<f64> {
        if self.rim {
            return Some(guess);
        }
        let sums = self.edge_sums(depth);
        let mut area = guess;
        for _ in 0..8 {
            let change = -self.edge_residual(area, sums) / self.edge_slope(area, sums);
            if !(change.is_finite() && change.abs() <= 0.5 * self.span(area)) {
                break;
            }
            area += change;
            if change.abs() <= 1e-13 * area {
                return Some(area);
            }
        }
        self.bisect_area(guess, sums)
    }

    /// The residual rises with A: a bracket around a guess, then halves.
    fn bisect_area(&self, guess: f64, sums: (f64, f64)) -> Option<f64> {
        let inner = self.inner_radius * self.inner_radius;
        let span = self.span(guess);
        let (mut low, mut high) = (inner + 0.99 * span, inner + 1.01 * span);
        for _ in 0..60 {
            let ends = (self.edge_residual(low, sums), self.edge_residual(high, sums));
            if ends.0 <= 0.0 && ends.1 >= 0.0 {
                break;
            }
            if ends.0 > 0.0 {
                low = inner + 0.5 * (low - inner);
            }
            if ends.1 < 0.0 {
                high = inner + 1.5 * (high - inner);
            }
        }
        if !(self.edge_residual(low, sums) <= 0.0 && self.edge_residual(high, sums) >= 0.0) {
            return None;
        }
        while high - low > 1e-13 * high {
            let middle = 0.5 * (low + high);
            if self.edge_residual(middle, sums) > 0.0 { high = middle } else { low = middle }
        }
        Some(high)
    }

    /// The rate of wear at given depths inside the region; `None` where no contact edge can be found.
    pub(crate) fn rate(&self, depth: &[f64], guess: f64) -> Option<Rate> {
        let area = self.solve_area(depth, guess)?;
        let rate = self.rate_at(depth, area);
        rate.area_rate.is_finite().then_some(rate)
    }

    /// The same at a given contact edge.
    fn rate_at(&self, depth: &[f64], area: f64) -> Rate {
        let (mesh, n) = (&*self.mesh, self.cells());
        let (a, span) = (area.sqrt(), self.span(area));
        let radius = self.radii(area);
        let scale: Vec<f64> = radius.iter().map(|x| self.scale(span, *x)).collect();
        let mut depth = depth.to_vec();
        if !self.rim {
            depth[n] = self.edge_depth(a);
        }
        let mut image = vec![0.0; n + 1];
        image[0] = self.inner_image(span);
        mesh.ascend(&depth, &mut image);
        let whole: Vec<f64> = (0..=n).map(|i| self.body.image(radius[i]) + image[i] / scale[i]).collect();
        let indentation = if !self.is_force() {
            self.motion.value
        } else if self.rim {
            let worn = self.inside_width + span.sqrt() * dot(&mesh.width, &image);
            self.body.image(a) + (self.motion.value - self.body.load(a) + worn) / a
        } else {
            whole[n]
        };
        let mut room: Vec<f64> = whole.iter().map(|g| indentation - g).collect();
        if !self.rim {
            room[n] = 0.0;
        }
        let mut slip: Vec<f64> = room.iter().map(|q| (self.reach - self.bound_slope * q).max(0.0)).collect();
        if mesh.first() == 1 {
            slip[0] = 0.0;
        }
        let mut pressure = vec![0.0; n + 1];
        mesh.pressure(&room, self.rim, &mut pressure);
        pressure.iter_mut().for_each(|p| *p /= span.sqrt());
        let scaled: Vec<f64> = slip.iter().zip(&scale).map(|(s, b)| s * b).collect();
        let mut surface_slip = vec![0.0; n + 1];
        mesh.descend(&scaled, &mut surface_slip);
        let mut growth: Vec<f64> = (0..=n).map(|i| self.factor * pressure[i] * surface_slip[i]).collect();
        if !self.rim {
            growth[n] = 0.0;
        }
        let volume_rate = self.volume_rate(&radius, &room, &slip);
        let share = volume_rate / (span * dot(&mesh.volume.depth, &growth));
        let share = if share.is_finite() { share.clamp(0.8, 1.25) } else { 1.0 };
        growth.iter_mut().for_each(|rate| *rate *= share);
        let mut drift = vec![0.0; n + 1];
        let mut area_rate = 0.0;
        if !self.rim {
            for i in 1..n {
                drift[i] = mesh.drift_of(&depth, i) / span;
            }
            let condition = self.edge_condition(&depth, area, scale[n]);
            area_rate = -dot(&condition.depth, &growth) / (condition.area + dot(&condition.depth, &drift));
            for i in 0..n {
                growth[i] += drift[i] * area_rate;
            }
        }
        Rate {
            growth,
            image,
            area,
            indentation,
            slip,
            radius,
            scale,
            pressure,
            surface_slip,
            drift,
            area_rate,
            volume_rate,
            share,
        }
    }

    fn edge_condition(&self, depth: &[f64], area: f64, edge_scale: f64) -> EdgeCondition {
        let (n, span, a) = (self.cells(), self.span(area), area.sqrt());
        let mut row: Vec<f64> = if self.is_force() {
            let edge = self.mesh.edge_image.depth.iter().zip(&self.mesh.mean_image.depth);
            edge.map(|(edge, mean)| a * edge / edge_scale - span.sqrt() * mean).collect()
        } else {
            self.mesh.edge_image.depth.iter().map(|edge| edge / edge_scale).collect()
        };
        row[n] = 0.0;
        EdgeCondition { depth: row, area: self.edge_slope(area, self.edge_sums(depth)) }
    }

    /// (k/σ₀) times the work of the springs in a cycle, m³: 2π ∫ p s r dr = 2 ∫ q σ dx.
    fn volume_rate(&self, x: &[f64], room: &[f64], slip: &[f64]) -> f64 {
        // a table is linear in x² between its points
        let curved = !matches!(
            self.body.profile(),
            Profile::Parabola { .. } | Profile::FlatPunch { .. } | Profile::Table(_)
        );
        let mut work = 0.0;
        for j in 0..self.cells() {
            let (ends, room, slip) = ((x[j], x[j + 1]), (room[j], room[j + 1]), (slip[j], slip[j + 1]));
            work += product_integral(ends, room, slip);
            if curved && slip.1 > 0.0 {
                work += self.work_of_curvature(ends, room, slip);
            }
        }
        2.0 * self.factor * work
    }

    /// What ∫ q σ dx over a slipping cell differs by where the body's own image is not linear in x², as q and σ are taken to be. On
    /// the cone at Ñ = 2.5 V is 0.20 % too large on 64 cells with it and 0.29 % without.
    fn work_of_curvature(&self, (x0, x1): (f64, f64), room: (f64, f64), slip: (f64, f64)) -> f64 {
        let profile = self.body.profile();
        let image = (profile.image(x0), profile.image(x1));
        let (middle, half) = (0.5 * (x0 + x1), 0.5 * (x1 - x0));
        let mut work = 0.0;
        for (node, weight) in GAUSS {
            let x = middle + half * node;
            let share = (x - x0) * (x + x0) / ((x1 - x0) * (x1 + x0));
            let line = |ends: (f64, f64)| ends.0 + share * (ends.1 - ends.0);
            let more_room = line(image) - profile.image(x);
            let slip = line(slip) - self.bound_slope * (line(room) + more_room);
            work += half * weight * more_room * slip;
        }
        work
    }

    /// Largest image (m) that belongs to a change of the depths.
    pub(crate) fn largest_image(&self, change: &[f64], rate: &Rate) -> f64 {
        let n = self.cells();
        let (mut depth, mut z) = (change.to_vec(), vec![0.0; n + 1]);
        if !self.rim {
            depth[n] = 0.0;
        }
        self.mesh.ascend(&depth, &mut z);
        (self.mesh.first()..=n).fold(0.0, |most: f64, i| most.max((z[i] / rate.scale[i]).abs()))
    }

    /// The contact of a state.
    pub(crate) fn contact(&self, rate: &Rate) -> Contact {
        let radius = rate.area.sqrt();
        let load = if self.is_force() {
            self.motion.value
        } else {
            let span = self.span(rate.area);
            let worn = self.inside_width + span.sqrt() * dot(&self.mesh.width, &rate.image);
            // F_N/(2E*) = a d − ∫ g dx, of which the body's part is a g(a) − φ(a)
            let body = radius * self.body.image(radius) - self.body.load(radius);
            (radius * rate.indentation - body - worn).max(0.0)
        };
        Contact { control: self.motion.value, depth: rate.indentation, radius, load }
    }

    /// Depths w̃ that belong to images given at the nodes, m.
    pub(crate) fn depths(&self, images: &[f64], area: f64) -> Vec<f64> {
        let (n, span) = (self.cells(), self.span(area));
        let radii = self.radii(area);
        let mut z: Vec<f64> = images.iter().zip(&radii).map(|(h, x)| h * self.scale(span, *x)).collect();
        if self.mesh.first() == 1 {
            z[0] = self.inner_image(span);
        }
        let mut depth = vec![0.0; n + 1];
        self.mesh.descend(&z, &mut depth);
        if !self.rim {
            // the depth at the edge is known: the error of taking the image over must not all go to the last cell
            let error = self.edge_depth(area.sqrt()) - depth[n];
            depth.iter_mut().zip(&self.mesh.share).for_each(|(w, share)| *w += error * share);
        }
        depth
    }

    /// Worn volume that the mesh and the frozen part carry, m³.
    pub(crate) fn volume(&self, rate: &Rate) -> f64 {
        let inside: f64 =
            self.sources.iter().map(|(x2, weight)| weight * (rate.area - x2).max(0.0).sqrt()).sum();
        // 4 ∫ h √(a² − x²) dx, of which the weights hold (2/π) ∫ h dx
        self.own_volume(rate) + 2.0 * std::f64::consts::PI * inside
    }

    /// Worn volume that the mesh alone carries, m³.
    pub(crate) fn own_volume(&self, rate: &Rate) -> f64 {
        let mut z = rate.image.clone();
        z.iter_mut().for_each(|z| *z *= self.span(rate.area));
        dot(&self.mesh.volume_of_image, &z)
    }

    /// Worn depth outside the front at the nodes, m.
    fn depth_outside(&self, state: &State, rate: &Rate) -> Vec<f64> {
        let (first, end) = (self.mesh.first(), self.end());
        let depth = |i: usize| state.depth[i] + self.depth_from_inside(rate.radius[i]);
        (0..=self.cells()).map(|i| if i >= first && i < end { depth(i) } else { 0.0 }).collect()
    }

    /// The state that carries a little more volume (m³) outside the front, and its rate. The depths grow by the share α φ + β φ²,
    /// which leaves the contact edge where it is, and leaves the image smooth at both edges; one that is not takes many steps to
    /// recover from on narrow cells. `None` where that is no small change.
    pub(crate) fn with_volume(&self, state: &State, rate: &Rate, volume: f64) -> Option<(State, Rate)> {
        let rising = |depth: &[f64]| -> Vec<f64> {
            depth.iter().zip(&self.mesh.share).map(|(depth, phi)| depth * phi).collect()
        };
        let first = rising(&self.depth_outside(state, rate));
        let second = rising(&first);
        let volume_of = |depth: &[f64]| self.span(rate.area) * dot(&self.mesh.volume.depth, depth);
        let (alpha, beta) = if self.rim {
            (volume / volume_of(&first), 0.0)
        } else {
            let condition = self.edge_condition(&state.depth, rate.area, rate.scale[self.cells()]);
            let change = |depth: &[f64]| dot(&condition.depth, depth);
            let determinant = volume_of(&first) * change(&second) - volume_of(&second) * change(&first);
            (volume * change(&second) / determinant, -volume * change(&first) / determinant)
        };
        if !(alpha.abs() < MOST_GROWTH && beta.abs() < MOST_GROWTH) {
            return None;
        }
        let grown = |((depth, first), second): ((&f64, &f64), &f64)| depth + alpha * first + beta * second;
        let depth: Vec<f64> = state.depth.iter().zip(&first).zip(&second).map(grown).collect();
        let rate = self.rate(&depth, rate.area)?;
        Some((State { depth, area: rate.area }, rate))
    }

    /// Image of the wear at the nodes, m.
    pub(crate) fn worn_image(&self, rate: &Rate) -> Vec<f64> {
        let mut h: Vec<f64> = rate.image.iter().zip(&rate.scale).map(|(z, b)| z / b).collect();
        if self.mesh.first() == 1 {
            h[0] = self.inside.edge_image();
        }
        h
    }
}

/// ∫ f g dx over a cell for two functions linear in x².
fn product_integral((x0, x1): (f64, f64), f: (f64, f64), g: (f64, f64)) -> f64 {
    // moments of s = (X − X₀)/ΔX over the cell, which is exact and free of cancellation in t = (x − x₀)/Δx
    let (width, sum) = (x1 - x0, x1 + x0);
    let (p, q) = (2.0 * x0 / sum, width / sum);
    let first = p / 2.0 + q / 3.0;
    let second = p * p / 3.0 + p * q / 2.0 + q * q / 5.0;
    let (df, dg) = (f.1 - f.0, g.1 - g.0);
    width * (f.0 * g.0 + (f.0 * dg + df * g.0) * first + df * dg * second)
}

impl Patch {
    /// Lets the image at the nodes next to the front not fall below what it was: there it never does, and an error of the
    /// integration, however small, would let the front creep. Returns whether anything had to be mended.
    pub(crate) fn hold_front(&self, depth: &mut [f64], before: &Rate, after: &Rate) -> bool {
        if self.mesh.region == Region::Disc {
            return false;
        }
        let last = FRONT_CELLS;
        let mut image = after.image[..=last].to_vec();
        let mut mended = false;
        for i in 1..=last {
            let least = before.image[i] / before.scale[i] * after.scale[i];
            if image[i] < least {
                image[i] = least;
                mended = true;
            }
        }
        if mended {
            image.resize(self.cells() + 1, 0.0);
            let mut held = vec![0.0; self.cells() + 1];
            self.mesh.descend(&image, &mut held);
            depth[1..=last].copy_from_slice(&held[1..=last]);
        }
        mended
    }
}

/// Cells at the inner edge within which a front may stand; beyond, the mesh is laid anew. Where the front is pinned decides the
/// profile there, and a front amid the mesh is only as sharp as the cell that it stands in: with a twelfth of the cells its
/// error did not fall with the tolerance, and on fine meshes their uneven steps took ten times the work.
pub(crate) const FRONT_CELLS: usize = 2;

/// Where the springs first slip at the end of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Front {
    /// Where the mesh has it.
    Kept,
    /// Elsewhere: the mesh has to be laid anew.
    Moved,
}

impl Patch {
    /// Looks whether the front has left the inner edge of the mesh.
    pub(crate) fn front(&self, rate: &Rate) -> Front {
        let bound = |i: usize| {
            let h = if i == 0 && self.mesh.first() == 1 {
                self.inside.edge_image()
            } else {
                rate.image[i] / rate.scale[i]
            };
            self.bound_slope * (rate.indentation - self.body.image(rate.radius[i]) - h)
        };
        let small = 1e-6 * self.reach;
        // a punch's worn rim may leave contact, and a contact may grow to the rim
        let edge = if self.rim {
            bound(self.cells()) < -1e-3 * self.bound_slope * rate.indentation.abs()
        } else {
            rate.area.sqrt() >= self.body.profile().outer_radius() * (1.0 - RIM)
        };
        let moved = match self.mesh.region {
            Region::Annulus => self.reach > bound(0) + small || rate.slip[FRONT_CELLS] == 0.0,
            Region::Disc => self.reach < bound(0) - small,
        };
        if moved || edge { Front::Moved } else { Front::Kept }
    }
}

/// The error of a patch that cannot go on.
pub(crate) fn lost(motion: &Motion) -> Error {
    Error::NotFinite {
        what: "the contact edge of the worn profile",
        normal: motion.value,
        displacement: motion.sliding.amplitude(),
    }
}
