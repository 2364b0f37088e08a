//! Where the springs stood when the present stroke began: how far each has slipped since.
//!
//! A stroke is the motion from one reversal to the next. Slip moves the origin of a spring, the
//! displacement at which it would be relaxed. So the slip of a spring in the stroke is the change
//! of its origin, and only the origins at the last reversal have to be kept. In one dimension
//! under constant load that is the length of the slip path: s(x) = |ΔU| − |Δu|, for a first stroke
//! |U| − m (d − g). The slip of the surface is its Abel transform,
//! (2/π) ∫ s dx/√(r² − x²) from 0 to r.

use super::FrettingContact;
use crate::friction::Row;
use crate::parameters::Parameters;
use crate::quadrature::GAUSS_3;
use crate::surface::Surface;
use nalgebra::Vector2;
use serde::{Deserialize, Serialize};
use std::f64::consts::{FRAC_2_PI, FRAC_PI_2};
use std::mem::{swap, take};

/// Longest panel of the quadrature over the angle θ, x = r sin θ. The three-point rule on it is
/// exact to 1e-10 for the image of a smooth body.
const PANEL: f64 = 0.1;

/// Over the tolerance, the share of [`Springs::coarsen`](crate::friction::Springs::coarsen) for
/// rows of more than two knots a cell: over a thousand reversals T is at most 2e-5 μF_N off at the
/// tolerance 1e-3.
const SHARE: f64 = 3e-2;

/// The springs at the beginning of a stroke.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct StrokeStart {
    /// Radii with the origins of their springs, m; none where all were relaxed or out of contact.
    pub(super) origins: Vec<(f64, Vector2<f64>)>,
    /// Displacement, m.
    place: Vector2<f64>,
    /// Indentation depth, m.
    depth: f64,
}

impl StrokeStart {
    /// Takes over another one, in memory that is there already.
    pub(super) fn copy_from(&mut self, other: &Self) {
        let mut origins = take(&mut self.origins);
        origins.clone_from(&other.origins);
        *self = Self { origins, ..*other };
    }

    /// Numbers that springs can have, at most so many.
    pub(super) fn is_sound(&self, most: usize) -> bool {
        let finite = |vector: &Vector2<f64>| vector.iter().all(|value| value.is_finite());
        self.origins.len() <= most
            && self.depth.is_finite()
            && finite(&self.place)
            && self.origins.iter().all(|(x, origin)| (0.0..f64::INFINITY).contains(x) && finite(origin))
            && self.origins.windows(2).all(|pair| pair[0].0 <= pair[1].0)
    }
}

/// Slip of the present stroke.
impl FrettingContact {
    /// A stroke begins where the body stands.
    pub(super) fn begin_stroke(&mut self) {
        let mut row = take(&mut self.state.row);
        self.bound_knots(&mut row);
        self.state.row = row;
        let place = self.model.axes.for_springs(self.state.place);
        self.next_stroke(place);
        let mut origins = take(&mut self.state.stroke.origins);
        origins.extend(self.origins());
        self.state.stroke.origins = origins;
    }

    /// Radii with the present origins of their springs.
    fn origins(&self) -> impl Iterator<Item = (f64, Vector2<f64>)> {
        let y = self.model.axes.for_springs(self.state.place).y;
        self.state.row.origins(y).map(|(place, origin)| (place.x, origin))
    }

    /// Leaves out small kinks of a line's row of many knots. Each reversal leaves one where the
    /// next is weaker or friction has changed: thousands while a vibration dies down or friction
    /// runs in.
    pub(super) fn bound_knots(&self, row: &mut Row) {
        let Parameters { resolution, tolerance, .. } = *self.model.parameters;
        if let Row::Line(springs) = row
            && springs.knots().len() > 2 * resolution
        {
            springs.coarsen(&self.state.contact, self.model.bound_slope, SHARE * tolerance);
        }
    }

    /// Steady cycles are given by their first quarter, from relaxed springs at displacement 0.
    pub(super) fn begin_quarter(&mut self) {
        self.next_stroke(self.model.axes.for_springs(Vector2::new(0.0, self.state.place.y)));
    }

    /// A stroke begins with relaxed springs. [`Self::undo_stroke`] takes that back.
    fn next_stroke(&mut self, place: Vector2<f64>) {
        self.undo_stroke();
        let stroke = &mut self.state.stroke;
        (stroke.place, stroke.depth) = (place, self.state.contact.depth);
        stroke.origins.clear();
    }

    /// Goes on with the stroke before the present one. Only the last beginning can be undone.
    pub(super) fn undo_stroke(&mut self) {
        swap(&mut self.state.stroke, &mut self.memory.get().stroke);
    }

    /// Slip of the surface at radius r since the present stroke began, m: from one reversal to the
    /// next, so that at a reversal it is that of the whole stroke. After
    /// [`Self::advance_cycles`] it is the amplitude of the slip, from the middle of a stroke to its
    /// end. 0 outside the contact.
    ///
    /// It is the distance between the places at which the springs are relaxed, at the reversal and
    /// now. Springs that came into contact during the stroke are taken to have touched along a
    /// straight line of depth and displacement.
    pub fn slip_amplitude_at(&self, r: f64) -> f64 {
        let r = self.model.axes.inner(r);
        if self.state.contact.is_open() || r > self.state.contact.radius {
            return 0.0;
        }
        let now: Vec<_> = self.origins().collect();
        let start = &self.state.stroke;
        let nodes = self.surface.worn().map_or(&[][..], |nodes| nodes.x());
        let kinks = now.iter().chain(&start.origins).map(|knot| knot.0).chain(nodes.iter().copied());
        let mut angles: Vec<f64> =
            kinks.filter(|x| *x > 0.0 && *x < r).map(|x| (x / r).asin()).chain([0.0, FRAC_PI_2]).collect();
        angles.sort_by(f64::total_cmp);
        let (now, start) = (Origins::new(&self.surface, &now), Origins::new(&self.surface, &start.origins));
        let slip = |x: f64| {
            let image = self.surface.image(x);
            let (end, begin) =
                (now.at(x, image), start.at(x, image).unwrap_or_else(|| self.touched_at(image)));
            end.map_or(Vector2::zeros(), |end| end - begin)
        };
        let mut sum = Vector2::zeros();
        for pair in angles.windows(2) {
            let panels = ((pair[1] - pair[0]) / PANEL).ceil();
            for k in 0..panels as u32 {
                let half = 0.5 * (pair[1] - pair[0]) / panels;
                let middle = pair[0] + f64::from(2 * k + 1) * half;
                for (node, weight) in GAUSS_3 {
                    sum += weight * half * slip(r * (middle + half * node).sin());
                }
            }
        }
        FRAC_2_PI * sum.x.hypot(sum.y / self.model.axes.stiffness_ratio)
    }

    /// Origin of a spring that was not in contact when the stroke began, or of a relaxed one.
    fn touched_at(&self, image: f64) -> Vector2<f64> {
        let start = &self.state.stroke;
        let (place, rise) =
            (self.model.axes.for_springs(self.state.place), self.state.contact.depth - start.depth);
        let share = if rise > 0.0 { ((image - start.depth) / rise).clamp(0.0, 1.0) } else { 0.0 };
        start.place + share * (place - start.place)
    }
}

/// Origins of springs, linear in the image between them.
struct Origins<'a> {
    origins: &'a [(f64, Vector2<f64>)],
    images: Vec<f64>,
}

impl<'a> Origins<'a> {
    fn new(surface: &Surface, origins: &'a [(f64, Vector2<f64>)]) -> Self {
        Self { origins, images: origins.iter().map(|(x, _)| surface.image(*x)).collect() }
    }

    /// Origin of the spring at x, m; `None` beyond the last one.
    fn at(&self, x: f64, image: f64) -> Option<Vector2<f64>> {
        let outer = self.origins.partition_point(|(knot, _)| *knot < x);
        let (end, last) = *self.origins.get(outer)?;
        let Some(inner) = outer.checked_sub(1) else { return Some(last) };
        let (begin, first) = self.origins[inner];
        let rise = self.images[outer] - self.images[inner];
        let share = if rise > 0.0 {
            ((image - self.images[inner]) / rise).clamp(0.0, 1.0)
        } else {
            (x - begin) / (end - begin)
        };
        Some(first + share * (last - first))
    }
}
