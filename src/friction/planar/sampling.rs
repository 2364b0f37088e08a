//! Where the row is sampled: fixed radii, the nodes of a worn profile, and the contact edge.
//!
//! The fixed radii stay as the contact grows and shrinks, so that the springs stay the same. Others
//! are chosen where the contact radius has doubled or halved. They are even, but closer together
//! towards the contact edge, where springs slip first: in cycles of a twentieth of full slip they
//! do so on 3 % of the radius. The nodes of a worn profile are springs of their own: wear
//! asks for their slip, and one between a spring that sticks and one that slips would let wear leak
//! across the front.

use super::reading::Standing;
use super::spring::{along, norm};
use super::{PlanarKnot, PlanarRow};
use crate::friction::{NEARLY, Path, Springs};
use crate::surface::{Contact, Place, Surface};
use nalgebra::Vector2;

/// Even samples from the axis to the contact edge that are asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Samples(pub(crate) usize);

/// Outer part of the radius in which samples are twice as many. In cycles of a ball of 0.01, 0.05,
/// 0.1 and 0.2 of full slip the work of even samples is 140, 5.4, 1.7 and 0.4 % too high; it is 7,
/// 1.4, 0.7 and 0.3 % now. With a quarter it would be 0.8, 0.7, 0.03 and 0.2 %, and a step on an
/// orbit would take 4.5 instead of 3.6 µs.
const GRADED: f64 = 0.125;

/// Rise of the unworn image over a cell, over that of a cone over an even one of two samples, above
/// which the cell is halved. Spheres and r^4 rise less; next to the rim of a flat the image of a
/// narrow ring would rise from 0 to its largest value within one cell. Half of it and twice change
/// the median error of V of 40 orbits of such rings from 0.65 to 0.69 and 0.72 %.
const STEEP: f64 = 2.0;

/// Share of their distance at which two samples are one.
const SAME: f64 = 1e-6;

/// How a row comes to rest on a surface that has worn under it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Resting<'a> {
    pub(crate) surface: &'a Surface,
    /// The contact of before and the new one.
    pub(crate) contacts: (&'a Contact, &'a Contact),
    /// m = μE*/G*.
    pub(crate) bound_slope: f64,
    pub(crate) displacement: Vector2<f64>,
    pub(crate) samples: Samples,
}

impl Samples {
    /// Width of a cell of two samples over the contact radius.
    pub(in crate::friction) fn cell(self) -> f64 {
        2.0 / self.0 as f64
    }

    /// The distance of even samples for a contact radius, where it is another than at present.
    fn respaced(self, present: f64, radius: f64) -> Option<f64> {
        let (ratio, wanted) = (radius / present, self.0 as f64);
        (!(0.5 * wanted..=2.0 * wanted).contains(&ratio)).then_some(radius / wanted)
    }

    /// Radius of sample k over the distance of even ones. Those of the outer part come closer
    /// together towards the contact edge for which they were chosen. Beyond it they are even.
    fn radius(self, k: f64) -> f64 {
        let (edge, graded) = (self.0 as f64, GRADED * self.0 as f64);
        let left = edge + graded - k;
        if left >= 2.0 * graded {
            k
        } else if left > 0.0 {
            edge - left * left / (4.0 * graded)
        } else {
            k - graded
        }
    }

    /// The inverse of [`Self::radius`].
    fn number(self, radius: f64) -> f64 {
        let (edge, graded) = (self.0 as f64, GRADED * self.0 as f64);
        let left = edge - radius;
        if left >= graded {
            radius
        } else if left > 0.0 {
            edge + graded - 2.0 * (graded * left).sqrt()
        } else {
            radius + graded
        }
    }

    /// Calls `sink` with each sample radius behind `from` up to `to`, which is the last one.
    ///
    /// `spacing` is the distance of even samples.
    fn each_radius(self, surface: &Surface, spacing: f64, (from, to): (f64, f64), mut sink: impl FnMut(f64)) {
        let nodes = surface.worn().map_or(&[][..], |nodes| nodes.x());
        let mut nodes = nodes.iter().copied().filter(|&x| x > from && x < to).peekable();
        // a spacing that is lost to underflow leaves the edge alone
        let most = if spacing > 0.0 { self.number(to / spacing) } else { 0.0 };
        let mut k = if spacing > 0.0 { self.number(from / spacing).floor() } else { 1.0 };
        let mut sample = |fixed: f64| {
            if fixed <= from * (1.0 + SAME) || fixed >= to - SAME * spacing {
                return;
            }
            while let Some(node) = nodes.next_if(|node| *node < fixed - SAME * spacing) {
                sink(node);
            }
            if nodes.peek().is_none_or(|node| *node > fixed + SAME * spacing) {
                sink(fixed);
            }
        };
        let place = |x: f64| (x, surface.profile().image(x));
        let edge = place(spacing * self.0 as f64).1;
        let mut inner = place(self.radius(k) * spacing);
        while k < most {
            k += 1.0;
            let outer = place(self.radius(k) * spacing);
            halve(&place, (inner, outer), STEEP * self.cell() * outer.1.max(edge), &mut sample);
            sample(outer.0);
            inner = outer;
        }
        nodes.for_each(&mut sink);
        sink(to);
    }
}

/// Calls `sink` with the radii that halve a cell, given by radius and image at its ends (m), until
/// the image rises by no more than `most` over any part.
fn halve(
    place: &impl Fn(f64) -> (f64, f64),
    (inner, outer): ((f64, f64), (f64, f64)),
    most: f64,
    sink: &mut impl FnMut(f64),
) {
    let x = 0.5 * (inner.0 + outer.0);
    if outer.1 - inner.1 > most && inner.0 < x && x < outer.0 {
        let middle = place(x);
        halve(place, (inner, middle), most, sink);
        sink(x);
        halve(place, (middle, outer), most, sink);
    }
}

/// The spring at a place behind sample j.
pub(super) fn interpolated(row: &PlanarRow, j: usize, place: Place) -> PlanarKnot {
    let (p, q) = (&row.knots[j], &row.knots[(j + 1).min(row.knots.len() - 1)]);
    let rise = q.place.image - p.place.image;
    let share = if rise > 0.0 {
        (place.image - p.place.image) / rise
    } else {
        (place.x - p.place.x) / (q.place.x - p.place.x)
    };
    // of one place twice, either will do
    let share = if share.is_nan() { 0.0 } else { share.clamp(0.0, 1.0) };
    PlanarKnot { place, origin: p.origin + share * (q.origin - p.origin) }
}

impl PlanarRow {
    /// The row of a body that has moved along x alone so far and stands at `y` (m) across.
    pub(crate) fn of_line(springs: &Springs, surface: &Surface, y: f64, samples: Samples) -> Self {
        let Some(edge) = springs.knots().last().map(|knot| knot.place.x) else {
            // nothing touches: a sample would be one that has never been placed
            return Self::default();
        };
        let spacing = edge / samples.0 as f64;
        let mut radii: Vec<f64> = springs.knots().iter().map(|knot| knot.place.x).collect();
        radii.dedup();
        let mut fixed = Vec::new();
        samples.each_radius(surface, spacing, (0.0, edge), |x| fixed.push(x));
        fixed.retain(|x| {
            let above = radii.partition_point(|knot| knot < x);
            let near = |knot: Option<&f64>| knot.is_some_and(|knot| (knot - x).abs() <= SAME * spacing);
            !near(radii.get(above)) && !near(radii.get(above.max(1) - 1))
        });
        radii.extend(fixed);
        radii.sort_by(f64::total_cmp);
        let origins = springs.origins_at(surface, &radii);
        let knot = |(x, origin): (&f64, f64)| PlanarKnot {
            place: surface.place(*x),
            origin: Vector2::new(origin, y),
        };
        Self { spacing, knots: radii.iter().zip(origins).map(knot).collect() }
    }

    /// The same springs at other radii, up to a contact radius, on the surface on which they lie
    /// or, where that `is_another`, on one whose nodes may be others or lie elsewhere.
    fn resampled(
        &self,
        (surface, is_another): (&Surface, bool),
        (samples, spacing): (Samples, f64),
        radius: f64,
    ) -> Self {
        let Some(first) = self.knots.first() else { return Self::default() };
        let mut row = Self { spacing, knots: Vec::new() };
        let place = surface.place(0.0);
        row.knots.push(PlanarKnot { place, ..*first });
        let mut j = 0;
        samples.each_radius(surface, spacing, (0.0, radius), |x| {
            while j + 1 < self.knots.len() && self.knots[j + 1].place.x <= x {
                j += 1;
            }
            let place = surface.place(x);
            let image = if is_another { self.former_image(j, x) } else { place.image };
            let knot = interpolated(self, j, Place { image, ..place });
            row.knots.push(PlanarKnot { place, ..knot });
        });
        row
    }

    /// Image at a radius behind sample j on the surface on which the row lay, as evenly as it rises
    /// over narrow cells.
    fn former_image(&self, j: usize, x: f64) -> f64 {
        let (p, q) = (&self.knots[j].place, &self.knots[(j + 1).min(self.knots.len() - 1)].place);
        let width = q.x - p.x;
        let share = if width > 0.0 { ((x - p.x) / width).clamp(0.0, 1.0) } else { 0.0 };
        p.image + share * (q.image - p.image)
    }

    /// Takes samples that were not there before to their bound, where the image of a rough profile
    /// falls between their neighbours'.
    fn keep_within(&mut self, contact: &Contact, (bound_slope, displacement): (f64, Vector2<f64>)) {
        for knot in &mut self.knots {
            let bound = bound_slope * (contact.depth - knot.place.image).max(0.0);
            let u = displacement - knot.origin;
            if norm(u) > bound * (1.0 + NEARLY) {
                knot.origin = displacement - along(u, bound);
            }
        }
    }

    /// Springs that touch along a path take their places before it is walked.
    pub(super) fn touch(&mut self, path: &Path) {
        let radius = path.to.radius;
        if let Some(spacing) = path.samples.respaced(self.spacing, radius) {
            let edge = self.knots.last().map(|knot| knot.place.x);
            self.spacing = spacing;
            if let Some(edge) = edge {
                *self = self.resampled((path.surface, false), (path.samples, spacing), edge);
            }
        }
        // the edge of before has no deflection, and the samples beyond it tell when they touched
        self.knots.pop();
        let from = match self.knots.last() {
            Some(knot) => knot.place.x,
            None => {
                self.knots.push(path.touching(0.0));
                0.0
            }
        };
        let knots = &mut self.knots;
        path.samples
            .each_radius(path.surface, self.spacing, (from, radius), |x| knots.push(path.touching(x)));
    }

    /// Keeps the samples as close as asked for after the contact has shrunk.
    pub(super) fn tidy(&mut self, path: &Path) {
        let radius = path.to.radius;
        if radius < path.from.radius
            && radius > 0.0
            && let Some(spacing) = path.samples.respaced(self.spacing, radius)
        {
            *self = self.resampled((path.surface, false), (path.samples, spacing), radius);
            self.keep_within(&path.to, (path.bound_slope, path.end));
        }
    }

    /// The row on a surface that has worn while nothing moved. Springs that slipped have followed
    /// their bound, up or down, all the time; others slip back to theirs where it has fallen below
    /// them.
    pub(crate) fn rested(&self, resting: &Resting) -> Self {
        let (old, new) = resting.contacts;
        let spacing = resting.samples.respaced(self.spacing, new.radius).unwrap_or(self.spacing);
        let Resting { surface, bound_slope, displacement, .. } = *resting;
        // wear, after which this is called, knows bodies of revolution only
        let stiffness_ratio = 1.0;
        let before =
            Standing { row: self, surface, contact: old, bound_slope, stiffness_ratio, displacement };
        let slides = |j: usize| self.knots.get(j).is_none_or(|knot| before.at_bound(knot));
        let mut row = self.resampled((surface, true), (resting.samples, spacing), new.radius);
        let old_edge = self.knots.last().map_or(0.0, |knot| knot.place.x);
        let (mut j, mut last) = (0, Vector2::zeros());
        for knot in &mut row.knots {
            let x = knot.place.x;
            while j + 1 < self.knots.len() && self.knots[j + 1].place.x <= x {
                j += 1;
            }
            // a sample of its own between two of which one sticks keeps what it holds
            let slipped = slides(j) && (self.knots[j].place.x == x || slides(j + 1));
            let bound = bound_slope * (new.depth - knot.place.image).max(0.0);
            let deflection = if x >= old_edge { last } else { displacement - knot.origin };
            let size = norm(deflection);
            if size > 0.0 && (slipped || size > bound) {
                knot.origin = displacement - along(deflection, bound);
            } else if x >= old_edge {
                knot.origin = displacement;
            }
            if slipped && size > 0.0 {
                last = deflection;
            }
        }
        row
    }
}
