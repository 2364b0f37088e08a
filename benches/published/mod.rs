//! The procedure of Dimaki et al. 2014 as published: a uniform grid, all transforms at every time
//! step, explicit.
//!
//! A time step is a small displacement of the body. It (1) transforms the profile into its image by
//! eq. (1), (2) solves the contact, eqs. (10), (11), moves every spring by eq. (13) and transforms
//! their state by eqs. (16), (17), (3) takes off what eq. (18) says. Many steps make a cycle, and
//! one cycle stands for many: the wear coefficient is scaled so that the life asked for is over
//! after [`Settings::cycles`].
//!
//! It is written to be as good as that can be, since something is measured against it:
//! - the transforms are matrices made once, and of each only the part is used that is not
//!   multiplied by zero;
//! - singular kernels are integrated exactly over each cell ([`grid`]);
//! - the unworn profile keeps its closed image, so that only the wear is discretised;
//! - the state starts on the steady loop, at +U₀, so that no cycle is a special one;
//! - eq. (18) takes the traction at the end of a step, where all springs that slipped are at their
//!   bound: for a profile that does not change this makes the work independent of the number of
//!   steps;
//! - [`Settings::fewest_cycles`] takes the longest time step that is stable.
//!
//! The paper does not describe the "regularized algorithm" that it integrates with.
//! [`Scheme::Staggered`] is what one writes down first, and its stick edge wanders; the paper's own
//! figures do not show that, so [`Scheme::Causal`], whose edge stays, is the one to compare with.
#![allow(dead_code, reason = "the benchmark and the test use a part each")]

mod grid;
mod rows;

pub(crate) use grid::{Grid, Scheme};

use fretting_contact::NormalControl;
use fretting_contact::problems::Problem;
use fretting_contact::reference::Shape;
use std::f64::consts::PI;

/// How finely to compute.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Settings {
    /// What is sampled where.
    pub(crate) scheme: Scheme,
    /// Grid points per a₀.
    pub(crate) points: usize,
    /// Even displacement increments per cycle, an even number.
    pub(crate) increments: usize,
    /// Cycles in which the whole life passes.
    pub(crate) cycles: usize,
}

impl Settings {
    /// With the fewest cycles that are stable for a `life` in Ñ, found as the paper says by looking
    /// for the longest time step.
    ///
    /// Its size: a dent as narrow as a cell Δ lowers the pressure by some (π/4)E*/Δ times its
    /// depth, and the slip of the next increment, up to 4U₀/m, must not more than make up for it: κ
    /// E* U₀ ≤ mΔ/π, or N₀ ≥ π² a₀² d₀ E*/(F_N m Δ) cycles. Six tenths of these are stable (the
    /// surface slips by less than the body moves), three tenths are not: measured for m of 2 to 20,
    /// parabola and cone, either control.
    pub(crate) fn fewest_cycles(
        problem: &Problem,
        life: f64,
        scheme: Scheme,
        points: usize,
        increments: usize,
    ) -> Self {
        let normal = problem.start.normal;
        let seed = 0.6 * PI * PI * points as f64 * normal.radius() * normal.depth() * normal.modulus()
            / (normal.force() * increments as f64);
        Self { scheme, points, increments, cycles: (life * seed).ceil().max(1.0) as usize }
    }
}

/// A contact on the way through its life.
#[derive(Debug, Clone)]
pub(crate) struct Published {
    grid: Grid,
    settings: Settings,
    problem: Problem,
    /// g₀ at the springs, m.
    unworn: Vec<f64>,
    /// g at the springs, m.
    image: Vec<f64>,
    /// Worn depth at the radii, m.
    worn: Vec<f64>,
    /// Radii from this one on are worn.
    first_worn: usize,
    /// u, m.
    springs: Vec<f64>,
    /// Slip of the springs in this increment, m.
    slip: Vec<f64>,
    /// d, m.
    depth: f64,
    /// Springs below this one touch.
    edge: usize,
    /// Increments done.
    steps: usize,
}

/// Relative excess over its bound from which a spring slips: a front that stands on a grid point is
/// a tie to rounding.
const TIE: f64 = 1e-9;
/// Points beyond the contact for which the image is kept up to date: the edge moves by less than
/// one in a time step.
const MARGIN: usize = 8;

impl Published {
    /// The unworn contact of `problem`, whose wear is scaled to pass a `life` (Ñ) in the cycles of
    /// `settings`; the grid ends at `reach`·a₀, which the contact must not.
    pub(crate) fn new(problem: &Problem, life: f64, reach: f64, settings: Settings) -> Self {
        assert!(settings.increments.is_multiple_of(2), "half a cycle is a whole number of increments");
        let problem = problem.clone().with_seed_cycles(settings.cycles as f64 / life);
        let shape: Shape = problem.start.normal.shape();
        let count = (reach * settings.points as f64).ceil() as usize + MARGIN;
        let grid = Grid::new(settings.scheme, problem.contact_radius() / settings.points as f64, count);
        let unworn: Vec<f64> = grid.springs.iter().map(|&x| shape.image(x)).collect();
        let mut this = Self {
            image: unworn.clone(),
            worn: vec![0.0; count],
            first_worn: count,
            springs: vec![0.0; count],
            slip: vec![0.0; count],
            depth: problem.depth(),
            edge: count - MARGIN,
            steps: 0,
            unworn,
            grid,
            settings,
            problem,
        };
        this.press();
        // +U₀ on the steady loop is the state after the first quarter; that quarter wears nothing
        // here
        this.move_springs(this.problem.amplitude);
        this
    }

    /// The whole life.
    pub(crate) fn run(&mut self) {
        for _ in 0..self.settings.cycles {
            self.cycle();
        }
    }

    /// One cycle from +U₀ back to +U₀.
    pub(crate) fn cycle(&mut self) {
        let half = self.settings.increments / 2;
        let step = 2.0 * self.problem.amplitude / half as f64;
        for increment in 0..2 * half {
            self.step(if increment < half { -step } else { step });
        }
    }

    /// One time step: the body moves by `displacement`, m.
    fn step(&mut self, displacement: f64) {
        self.transform_profile();
        self.press();
        let first = self.move_springs(displacement);
        self.wear(first);
        self.steps += 1;
    }

    /// Eq. (1), where the wear has changed it and the contact might see it.
    fn transform_profile(&mut self) {
        let until = (self.edge + MARGIN).min(self.image.len());
        for i in self.first_worn..until {
            self.image[i] = self.unworn[i] + self.grid.image.dot(i, &self.worn, self.first_worn, i + 1);
        }
    }

    /// Eqs. (10), (11): depth and edge of the contact.
    fn press(&mut self) {
        if self.problem.parameters.normal_control == NormalControl::Force {
            self.find_depth();
        }
        let until = (self.edge + MARGIN).min(self.image.len());
        self.edge = (0..until).rev().find(|&i| self.image[i] < self.depth).map_or(0, |i| i + 1);
        assert!(
            self.edge + 1 < self.image.len(),
            "the contact has outgrown the grid: give it a larger reach"
        );
    }

    /// The depth that carries the load, by Newton's method: the force is a piecewise quadratic
    /// function of it.
    fn find_depth(&mut self) {
        for _ in 0..50 {
            let (force, slope) = self.force();
            let change = (self.problem.normal - force) / slope;
            self.depth += change;
            if change.abs() <= 1e-12 * self.depth {
                break;
            }
        }
    }

    /// F_N = 2E* ∫ (d − g) dx, N, by the trapezium rule with the last cell cut where g = d, and
    /// ∂F_N/∂d, N/m.
    fn force(&self) -> (f64, f64) {
        let until = (self.edge + MARGIN).min(self.image.len());
        let (mut sum, mut length) = (0.0, 0.0);
        let mut inner = self.depth - self.image[0];
        for image in &self.image[1..until] {
            let outer = self.depth - image;
            if inner > 0.0 && outer > 0.0 {
                sum += 0.5 * (inner + outer);
                length += 1.0;
            } else if inner > 0.0 || outer > 0.0 {
                let touching = inner.max(outer);
                let share = touching / (inner - outer).abs();
                sum += 0.5 * touching * share;
                length += share;
            }
            inner = outer;
        }
        let scale = 2.0 * self.problem.start.normal.modulus() * self.grid.spacing;
        (scale * sum, scale * length)
    }

    /// Eq. (13). Returns the first spring that slips.
    fn move_springs(&mut self, displacement: f64) -> usize {
        let ratio = self.problem.start.slip_ratio();
        let mut first = self.edge;
        for i in 0..self.edge {
            let bound = ratio * (self.depth - self.image[i]).max(0.0);
            let held = self.springs[i] + displacement;
            if held.abs() <= bound * (1.0 + TIE) {
                self.springs[i] = held;
                self.slip[i] = 0.0;
            } else {
                let slid = bound.copysign(held);
                self.slip[i] = held - slid;
                self.springs[i] = slid;
                first = first.min(i);
            }
        }
        // outside, the surface stays where it is
        self.springs[self.edge..].fill(0.0);
        self.slip[self.edge..].fill(displacement);
        first
    }

    /// Eqs. (16), (17), (18), where springs from `first` on have slipped.
    fn wear(&mut self, first: usize) {
        // staggered, the radius before a spring sees half a cell of it
        let inner = if self.grid.scheme == Scheme::Staggered { first.saturating_sub(1) } else { first };
        let per_work = self.problem.parameters.wear_per_work() * self.problem.start.modulus;
        let mut changed = false;
        for j in inner..self.edge {
            let slip = self.grid.inverse.dot(j, &self.slip, first, j + 2);
            let traction = self.grid.traction.dot(j, &self.springs, j, self.edge);
            // wear never heals
            let worn = (per_work * traction * slip).max(0.0);
            self.worn[j] += worn;
            changed |= worn > 0.0;
        }
        if changed {
            self.first_worn = self.first_worn.min(inner);
        }
    }

    /// Indentation depth, m.
    pub(crate) fn depth(&self) -> f64 {
        self.depth
    }

    /// Worn depth at radius r, m.
    pub(crate) fn worn_depth_at(&self, r: f64) -> f64 {
        self.grid.at(&self.worn, r)
    }

    /// Worn volume, m³.
    pub(crate) fn wear_volume(&self) -> f64 {
        self.grid.volume(&self.worn)
    }

    /// Normal force 2E* ∫ (d − g) dx, N.
    pub(crate) fn normal_force(&self) -> f64 {
        self.force().0
    }

    /// Tangential force 2G* ∫ u dx, N.
    pub(crate) fn tangential_force(&self) -> f64 {
        let sum: f64 = self.springs[1..self.edge].iter().sum();
        2.0 * self.problem.start.modulus * self.grid.spacing * (sum + 0.5 * self.springs[0])
    }

    /// Pressure at the radii by eq. (12): (r, p), m and Pa.
    pub(crate) fn pressure(&self) -> Vec<(f64, f64)> {
        let load: Vec<f64> = self.image.iter().map(|g| (self.depth - g).max(0.0)).collect();
        let modulus = self.problem.start.normal.modulus();
        let at = |j: usize| modulus * self.grid.traction.dot(j, &load, j, self.edge);
        (0..self.edge).map(|j| (self.grid.radii[j], at(j))).collect()
    }

    /// Where the first spring slips, m: between it and the last that sticks, by the bound's linear
    /// course.
    pub(crate) fn stick_radius(&self) -> f64 {
        let ratio = self.problem.start.slip_ratio();
        let amplitude = self.problem.amplitude;
        let free = |i: usize| amplitude - ratio * (self.depth - self.image[i]);
        let Some(first) = (0..self.edge).find(|&i| free(i) > TIE * amplitude) else {
            return self.edge as f64 * self.grid.spacing;
        };
        if first == 0 {
            return 0.0;
        }
        let (inner, outer) = (free(first - 1), free(first));
        self.grid.spacing * (first as f64 - outer / (outer - inner))
    }

    /// Time steps so far.
    pub(crate) fn steps(&self) -> usize {
        self.steps
    }
}
