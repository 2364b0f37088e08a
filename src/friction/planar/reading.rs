//! What the row says of the present state.

use super::spring::norm;
use super::{PlanarKnot, PlanarRow};
use crate::friction::NEARLY;
use crate::friction::interval::Interval;
use crate::surface::{Contact, Place, Surface};
use nalgebra::{Matrix2, Vector2};
use std::f64::consts::FRAC_2_PI;

impl PlanarRow {
    /// ∫ u dx from the axis to the edge, m².
    pub(crate) fn deflection_integral(&self, displacement: Vector2<f64>) -> Vector2<f64> {
        let mut sum = Vector2::zeros();
        for pair in self.knots.windows(2) {
            let interval = Interval::between(&pair[0].place, &pair[1].place);
            let (inner, outer) = (displacement - pair[0].origin, displacement - pair[1].origin);
            sum += inner.zip_map(&outer, |inner, outer| interval.linear(inner, outer));
        }
        sum
    }

    /// ∫ (u_x² + u_y²/ρ) dx from the axis to the edge, m³, with the stiffness ratio ρ: the elastic
    /// energy of the row over G*_x.
    pub(crate) fn energy_integral(&self, displacement: Vector2<f64>, stiffness_ratio: f64) -> f64 {
        let mut sum = 0.0;
        for pair in self.knots.windows(2) {
            let interval = Interval::between(&pair[0].place, &pair[1].place);
            for k in 0..2 {
                let u = (displacement[k] - pair[0].origin[k], displacement[k] - pair[1].origin[k]);
                let part = interval.product(u, u);
                sum += if k == 1 { part / stiffness_ratio } else { part };
            }
        }
        sum
    }
}

/// A row where it stands.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Standing<'a> {
    pub(crate) row: &'a PlanarRow,
    pub(crate) surface: &'a Surface,
    pub(crate) contact: &'a Contact,
    /// m = μE*/G*.
    pub(crate) bound_slope: f64,
    /// G*_y/G*_x, by which `displacement` is multiplied along y.
    pub(crate) stiffness_ratio: f64,
    pub(crate) displacement: Vector2<f64>,
}

impl Standing<'_> {
    /// K **n**: what a displacement adds to |u|, and κ = **n**·K **n**, with K = diag(1, ρ).
    fn stiffness_along(&self, n: Vector2<f64>) -> (Vector2<f64>, f64) {
        (Vector2::new(n.x, self.stiffness_ratio * n.y), 1.0 + (self.stiffness_ratio - 1.0) * n.y * n.y)
    }

    fn bound(&self, knot: &PlanarKnot) -> f64 {
        self.bound_slope * (self.contact.depth - knot.place.image).max(0.0)
    }

    pub(super) fn deflection(&self, knot: &PlanarKnot) -> Vector2<f64> {
        self.displacement - knot.origin
    }

    /// Whether a spring is at its bound; that at the very edge is.
    pub(super) fn at_bound(&self, knot: &PlanarKnot) -> bool {
        let rounding = 8.0 * f64::EPSILON * norm(self.displacement);
        let bound = self.bound(knot);
        bound <= NEARLY * self.bound_slope * self.contact.depth.abs() + rounding
            || norm(self.deflection(knot)) >= bound * (1.0 - NEARLY) - rounding
    }

    /// Place of the front between sample j, which sticks, and the next, which slips: where the
    /// springs that stick would reach their bound if they went on as from the sample before, linear
    /// in g.
    fn front(&self, j: usize) -> Place {
        let knots = &self.row.knots;
        let (here, next) = (&knots[j], &knots[j + 1]);
        let Some(before) = j.checked_sub(1).map(|i| &knots[i]).filter(|knot| !self.at_bound(knot)) else {
            return here.place;
        };
        let margin = |knot: &PlanarKnot| self.bound(knot) - norm(self.deflection(knot));
        let fall = margin(before) - margin(here);
        let rise = here.place.image - before.place.image;
        let image = here.place.image + margin(here) / fall * rise;
        if !(fall > 0.0 && rise > 0.0 && image < next.place.image) {
            return if fall > 0.0 && rise > 0.0 { next.place } else { here.place };
        }
        self.surface.place_of_image(image, here.place.x, next.place.x)
    }

    /// Inner edge of the outer zone in which all springs are at their bound: the stick radius, m.
    pub(crate) fn stick_radius(&self) -> f64 {
        let knots = &self.row.knots;
        let Some(last) = knots.iter().rposition(|knot| !self.at_bound(knot)) else { return 0.0 };
        if last + 1 >= knots.len() {
            return self.contact.radius;
        }
        let relaxed = NEARLY * self.bound_slope * self.contact.depth.abs();
        // with nothing but the edge at its bound, and no deflection beside it
        if last + 2 == knots.len() && norm(self.deflection(&knots[last])) <= relaxed {
            return self.contact.radius;
        }
        self.front(last).x
    }

    /// At the stick radius: fall of b − |u| per image inside it, and ∂|u|/∂**U** = K **n**, **n** =
    /// u/|u|; `None` where no front moves, as in gross slip.
    pub(crate) fn front_slope(&self) -> Option<(f64, Vector2<f64>)> {
        let knots = &self.row.knots;
        let last =
            knots.iter().rposition(|knot| !self.at_bound(knot)).filter(|last| last + 1 < knots.len())?;
        let (before, here) = (&knots[last.checked_sub(1)?], &knots[last]);
        let margin = |knot: &PlanarKnot| self.bound(knot) - norm(self.deflection(knot));
        let rise = here.place.image - before.place.image;
        let fall = (margin(before) - margin(here)) / rise;
        let u = self.deflection(here);
        let size = norm(u);
        (fall > 0.0 && fall.is_finite() && size > 0.0).then(|| (-fall, self.stiffness_along(u / size).0))
    }

    /// How the surface slips at radius r by displacement along x and y and by depth: s = (2/π) ∫ e
    /// dx/√(r² − x²) from 0 to r; on the axis that of the spring there.
    pub(crate) fn surface_slip(&self, r: f64) -> [Vector2<f64>; 3] {
        let mut slip = [Vector2::zeros(); 3];
        let of_spring = |knot: &PlanarKnot| {
            let u = self.deflection(knot);
            let size = norm(u);
            if !self.at_bound(knot) || size == 0.0 {
                return [Vector2::zeros(); 3];
            }
            let n = u / size;
            let (along, square) = self.stiffness_along(n);
            [along.x / square, along.y / square, -self.bound_slope / square].map(|rate| n * rate)
        };
        if r == 0.0 {
            return self.row.knots.first().map_or(slip, of_spring);
        }
        for pair in self.row.knots.windows(2) {
            let (x0, x1) = (pair[0].place.x, pair[1].place.x.min(r));
            if x0 >= r {
                break;
            }
            let weight = FRAC_2_PI * ((x1 / r).asin() - (x0 / r).asin());
            let (inner, outer) = (of_spring(&pair[0]), of_spring(&pair[1]));
            for k in 0..3 {
                slip[k] += (inner[k] + outer[k]) * (0.5 * weight);
            }
        }
        slip
    }

    /// Tangents of half the row with all springs that are at their bound slipping, those that the
    /// motion relaxes as well: a load that falls keeps them there.
    pub(crate) fn tangent(&self) -> Tangent {
        self.tangent_where(|_| true)
    }

    /// Tangents of half the row for going on in a direction while the depth changes: springs at
    /// their bound on which the motion grows faster than the bound follow it.
    pub(crate) fn tangent_ahead(&self, ahead: Vector2<f64>, deeper: f64) -> Tangent {
        self.tangent_where(|pull| pull.dot(&ahead) > self.bound_slope * deeper)
    }

    /// Tangents of half the row with those springs at their bound slipping whose ∂|u|/∂**U** is as
    /// asked for.
    fn tangent_where(&self, slips: impl Fn(Vector2<f64>) -> bool) -> Tangent {
        let part = |knot: &PlanarKnot| {
            let u = self.deflection(knot);
            let size = norm(u);
            let n = u / size;
            let (along, square) = self.stiffness_along(n);
            (self.at_bound(knot) && size > 0.0 && slips(along)).then(|| {
                // K − K**n** K**n**/κ, without the difference
                let share = self.stiffness_ratio / square;
                let (bound, m) = (self.bound(knot) / square, self.bound_slope / square);
                let across = Vector2::new(n.y, -n.x);
                Tangent {
                    stiffness: share * (across * across.transpose()),
                    by_depth: m * along,
                    work: bound * along,
                    work_by_depth: -m * self.bound(knot),
                    bound_square: bound * self.bound(knot),
                }
            })
        };
        let stiffness = Matrix2::from_diagonal(&Vector2::new(1.0, self.stiffness_ratio));
        let stuck = Tangent { stiffness, ..Tangent::default() };
        let mut sum = Tangent::default();
        let knots = &self.row.knots;
        let mut inner = knots.first().and_then(part);
        for j in 1..knots.len() {
            let (p, q) = (&knots[j - 1].place, &knots[j].place);
            let outer =
                if j + 1 == knots.len() && self.bound(&knots[j]) == 0.0 { inner } else { part(&knots[j]) };
            match (inner, outer) {
                (None, Some(slips)) => {
                    let front = self.front(j - 1);
                    sum.add(p, &front, (&stuck, &stuck));
                    sum.add(&front, q, (&slips, &slips));
                }
                (a, b) => sum.add(p, q, (&a.unwrap_or(stuck), &b.unwrap_or(stuck))),
            }
            inner = outer;
        }
        sum
    }
}

/// Derivatives of integrals over half the row, by displacement and depth.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Tangent {
    /// ∂(∫u dx)/∂U, m.
    pub(crate) stiffness: Matrix2<f64>,
    /// ∂(∫u dx)/∂d, m.
    pub(crate) by_depth: Vector2<f64>,
    /// ∂(∫∫|u||de| dx)/∂U, m².
    pub(crate) work: Vector2<f64>,
    /// The same by depth, m².
    pub(crate) work_by_depth: f64,
    /// ∫ b²/κ dx of the bound of the springs that slip, m³, κ their stiffness along the slip.
    pub(crate) bound_square: f64,
}

impl Tangent {
    /// This times a factor.
    pub(crate) fn scaled(&self, factor: f64) -> Self {
        Self {
            stiffness: factor * self.stiffness,
            by_depth: factor * self.by_depth,
            work: factor * self.work,
            work_by_depth: factor * self.work_by_depth,
            bound_square: factor * self.bound_square,
        }
    }

    /// The same while all bounds grow with the work of friction W, by db/b = ρ dW (ρ in 1/J, this
    /// scaled to forces and work). With w = ∫b **n** dx per displacement, a growth of the bounds by
    /// dρ adds w dρ to the force and takes ∫b² dx dρ off the work. Where that exceeds the work, so
    /// that springs snap, there are no derivatives, and these are at constant bounds.
    pub(crate) fn running_in(self, growth: f64) -> Self {
        let divisor = 1.0 + growth * self.bound_square;
        if divisor <= 0.0 {
            return self;
        }
        let share = growth / divisor;
        Self {
            stiffness: self.stiffness + share * self.work * self.work.transpose(),
            by_depth: self.by_depth + share * self.work_by_depth * self.work,
            work: self.work / divisor,
            work_by_depth: self.work_by_depth / divisor,
            ..self
        }
    }

    /// Adds an interval on which the parts are linear in g.
    fn add(&mut self, p: &Place, q: &Place, (inner, outer): (&Self, &Self)) {
        let interval = Interval::between(p, q);
        let linear = |inner, outer| interval.linear(inner, outer);
        self.stiffness += inner.stiffness.zip_map(&outer.stiffness, linear);
        self.by_depth += inner.by_depth.zip_map(&outer.by_depth, linear);
        self.work += inner.work.zip_map(&outer.work, linear);
        self.work_by_depth += linear(inner.work_by_depth, outer.work_by_depth);
        self.bound_square += linear(inner.bound_square, outer.bound_square);
    }
}
