//! The worn profile between the nodes: image, slope, integrals and depth at any radius.

use super::Nodes;
use crate::profile::Profile;
use crate::surface::Place;
use crate::transform;

/// Most iterations in the search for a radius; bisection alone would need 60.
const MOST_ITERATIONS: usize = 100;

/// Slope at the node between two cells, each given by its width and secant, of a cubic that is
/// monotone where the data are (Steffen, Astron. Astrophys. 239 (1990), 443).
fn steffen_slope((h0, before): (f64, f64), (h1, after): (f64, f64)) -> f64 {
    let mean = (before * h1 + after * h0) / (h0 + h1);
    (before.signum() + after.signum()) * before.abs().min(after.abs()).min(0.5 * mean.abs())
}

/// A line in X over a cell: the image of the wear, or that of the whole profile where the wear has
/// levelled it.
#[derive(Debug, Clone, Copy)]
struct CellLine {
    /// Radii of the nodes, m.
    ends: (f64, f64),
    /// Of the inner node: the image, m, and the load integral, m².
    image: f64,
    load: f64,
    /// Change of the image with X.
    slope: f64,
    is_levelled: bool,
}

impl CellLine {
    fn image_at(&self, x: f64) -> f64 {
        self.image + self.slope * (x - self.ends.0) * (x + self.ends.0)
    }

    fn load_at(&self, x: f64) -> f64 {
        let x0 = self.ends.0;
        self.load + 2.0 / 3.0 * self.slope * (x - x0) * (x * x + x * x0 + x0 * x0)
    }

    /// Image of the whole profile, m.
    fn whole_image(&self, profile: &Profile, x: f64) -> f64 {
        if self.is_levelled { self.image_at(x) } else { profile.image(x) + self.image_at(x) }
    }

    /// Its load integral, m².
    fn whole_load(&self, profile: &Profile, x: f64) -> f64 {
        if self.is_levelled { self.load_at(x) } else { profile.load_integral(x) + self.load_at(x) }
    }

    /// Its slope.
    fn whole_slope(&self, profile: &Profile, x: f64) -> f64 {
        let slope = 2.0 * x * self.slope;
        if self.is_levelled { slope } else { profile.image_slope(x) + slope }
    }
}

/// A cubic in X along a cell.
struct Cubic {
    start: f64,
    width: f64,
    value: f64,
    rise: f64,
    /// How much more it rises than the line at its start, and less at its end, over the cell.
    bends: (f64, f64),
}

impl Cubic {
    fn value_and_slope(&self, square: f64) -> (f64, f64) {
        let t = ((square - self.start) / self.width).clamp(0.0, 1.0);
        let ((a, b), s) = (self.bends, 1.0 - t);
        let value = self.value + t * self.rise + t * s * (a * s + b * t);
        (value, (self.rise + a * s * (1.0 - 3.0 * t) + b * t * (2.0 - 3.0 * t)) / self.width)
    }
}

impl Nodes {
    /// Worn depth at a radius, m.
    pub(crate) fn depth_at(&self, r: f64) -> f64 {
        let last = self.last();
        if r < self.x[last] {
            transform::inverse_at(&self.x, &self.worn_image, r).max(0.0)
        } else if r == self.x[last] {
            // a punch has its rim there
            self.depth[last]
        } else {
            0.0
        }
    }

    /// A field at radius r by the line in r² between the nodes; 0 behind them and where it is
    /// empty.
    pub(crate) fn line(&self, field: &[f64], r: f64) -> f64 {
        let j = self.cell(r).unwrap_or(self.last());
        let Some(inner) = field.get(j) else { return 0.0 };
        let Some(outer) = field.get(j + 1) else { return if r == self.x[j] { *inner } else { 0.0 } };
        let (x0, x1) = (self.x[j], self.x[j + 1]);
        let share = (r - x0) * (r + x0) / ((x1 - x0) * (x1 + x0));
        (1.0 - share) * inner + share * outer
    }

    /// Image and depth (m) of the node at a radius, within a share of that; `None` where there is
    /// none.
    pub(crate) fn at(&self, radius: f64, share: f64) -> Option<(f64, f64)> {
        let near = self.x.partition_point(|x| *x < radius * (1.0 - share));
        let found = self.x.get(near).is_some_and(|x| *x <= radius * (1.0 + share));
        found.then(|| (self.worn_image[near], self.depth[near]))
    }

    /// Cell that holds x, or `None` behind the last node.
    pub(crate) fn cell(&self, x: f64) -> Option<usize> {
        let above = self.x.partition_point(|&node| node <= x);
        (above < self.x.len()).then(|| above - 1)
    }

    /// Radius between two others at which the whole image takes a value, with the cell that holds
    /// it, where the image rises there between two nodes.
    pub(crate) fn radius_of_image(
        &self,
        profile: &Profile,
        image: f64,
        (low, high): (f64, f64),
    ) -> Option<(f64, usize)> {
        let at = |j: usize| (j, self.whole(profile, j));
        let (mut inner, mut outer) = (at(0), at(self.last()));
        while outer.0 - inner.0 > 1 {
            let middle = at(inner.0.midpoint(outer.0));
            *(if middle.1 <= image { &mut inner } else { &mut outer }) = middle;
        }
        let x = self.radius_in_cell(profile, image, inner.0, (inner.1, outer.1))?;
        (low <= x && x <= high).then_some((x, inner.0))
    }

    /// The outermost radius at which the whole image takes a value, with the cell that holds it,
    /// where that is one between two nodes.
    pub(crate) fn outermost_radius_of_image(&self, profile: &Profile, image: f64) -> Option<(f64, usize)> {
        let mut outer = None;
        for j in (0..=self.last()).rev() {
            let inner = self.whole(profile, j);
            if inner <= image {
                return Some((self.radius_in_cell(profile, image, j, (inner, outer?))?, j));
            }
            outer = Some(inner);
        }
        None
    }

    /// Radius in a cell, of whose ends the whole images are given, at which the whole image takes a
    /// value; `None` where it does not rise through that.
    fn radius_in_cell(&self, profile: &Profile, image: f64, j: usize, ends: (f64, f64)) -> Option<f64> {
        self.root_in_cell(profile, j, ends, image, |x, line| {
            (line.whole_image(profile, x), line.whole_slope(profile, x))
        })
    }

    /// The outermost radius at which the load integral of the whole profile takes a value (m²),
    /// where a cell between two nodes holds it.
    pub(crate) fn radius_at_load(&self, profile: &Profile, load: f64) -> Option<f64> {
        let up_to = |j: usize| profile.load_integral(self.x[j]) + self.integrals[j].worn_load;
        // beyond a last node of less load the integral falls at first, and rises to it further out
        let j = (0..=self.last()).rev().find(|j| up_to(*j) <= load).filter(|j| *j < self.last())?;
        self.root_in_cell(profile, j, (up_to(j), up_to(j + 1)), load, |x, line| {
            (line.whole_load(profile, x), x * line.whole_slope(profile, x))
        })
    }

    /// Radius in a cell at which a quantity takes a value; `None` where it does not rise from one
    /// end to the other through that. Newton's method, kept inside the cell by bisection, from the
    /// line in X between the ends, which for the image of a sphere is that itself.
    #[inline]
    fn root_in_cell(
        &self,
        profile: &Profile,
        j: usize,
        (q0, q1): (f64, f64),
        value: f64,
        quantity_and_slope: impl Fn(f64, &CellLine) -> (f64, f64),
    ) -> Option<f64> {
        // written so that it also refuses what is no number
        if !(q0 <= value && value <= q1 && q0 < q1) {
            return None;
        }
        let line = self.cell_line(profile, j);
        let (mut least, mut most) = line.ends;
        let share = (value - q0) / (q1 - q0);
        let mut x = (least * least + share * (most - least) * (most + least)).sqrt().clamp(least, most);
        for _ in 0..MOST_ITERATIONS {
            let (quantity, slope) = quantity_and_slope(x, &line);
            let excess = quantity - value;
            // where the quantity is flat, rounding ends the search before the last digits of x
            if excess.abs() <= 2.0 * f64::EPSILON * value.abs() {
                break;
            }
            let newton = x - excess / slope;
            // where it is steep, the rounding of x ends it first
            if (newton - x).abs() <= 2.0 * f64::EPSILON * x {
                x = newton.clamp(line.ends.0, line.ends.1);
                break;
            }
            if excess > 0.0 {
                most = x;
            } else {
                least = x;
            }
            x = if newton > least && newton < most { newton } else { 0.5 * (least + most) };
        }
        Some(x)
    }

    /// The line of a cell.
    #[inline(always)]
    fn cell_line(&self, profile: &Profile, j: usize) -> CellLine {
        let (ends, is_levelled) = ((self.x[j], self.x[j + 1]), j < self.levelled);
        let (image, load) = (self.worn_image[j], self.integrals[j].worn_load);
        if !is_levelled {
            return CellLine { ends, image, load, slope: self.slope(j), is_levelled };
        }
        let image = self.whole(profile, j);
        let slope = (self.whole(profile, j + 1) - image) / ((ends.1 - ends.0) * (ends.1 + ends.0));
        CellLine { ends, image, load: profile.load_integral(ends.0) + load, slope, is_levelled }
    }

    /// What wear has changed in the image at a radius, m.
    pub(crate) fn worn_image_at(&self, profile: &Profile, x: f64) -> f64 {
        let Some(j) = self.cell(x) else { return self.far_part(x).0 };
        let line = self.cell_line(profile, j);
        if line.is_levelled { line.image_at(x) - profile.image(x) } else { line.image_at(x) }
    }

    /// Image h (m) and load integral (m²) of the wear behind the last node.
    fn far_part(&self, x: f64) -> (f64, f64) {
        let (end, ratio) = (self.last(), self.x[self.last()] / x);
        let h = self.worn_image[end];
        (h * ratio * ratio, self.integrals[end].worn_load - 2.0 * h * self.x[end] * (1.0 - ratio))
    }

    /// All image values at a radius in a given cell, or behind the last node.
    pub(crate) fn place_in(&self, profile: &Profile, cell: Option<usize>, x: f64) -> Place {
        let (body_image, body_load, body_square) = profile.image_and_integrals(x);
        let (image, load) = match cell.map(|j| self.cell_line(profile, j)) {
            Some(line) if line.is_levelled => (line.image_at(x), line.load_at(x)),
            Some(line) => (body_image + line.image_at(x), body_load + line.load_at(x)),
            None => {
                let (image, load) = self.far_part(x);
                (body_image + image, body_load + load)
            }
        };
        let start = cell.unwrap_or(self.last());
        let worn_square = self.integrals[start].worn_square + self.worn_square_in_cell(profile, cell, x);
        Place { x, image, load, square: body_square + worn_square }
    }

    /// Image (m) and load integral (m²) of the whole profile at a radius in a given cell, or behind
    /// the last node.
    #[inline(always)]
    pub(crate) fn image_and_load_in(&self, profile: &Profile, cell: Option<usize>, x: f64) -> (f64, f64) {
        match cell {
            Some(j) => {
                let line = self.cell_line(profile, j);
                (line.whole_image(profile, x), line.whole_load(profile, x))
            }
            None => {
                let (image, load) = self.far_part(x);
                (profile.image(x) + image, profile.load_integral(x) + load)
            }
        }
    }

    /// Image of the whole profile at a radius, m.
    pub(crate) fn image_at(&self, profile: &Profile, x: f64) -> f64 {
        match self.cell(x) {
            Some(j) => self.cell_line(profile, j).whole_image(profile, x),
            None => profile.image(x) + self.far_part(x).0,
        }
    }

    /// Its slope.
    pub(crate) fn slope_at(&self, profile: &Profile, x: f64) -> f64 {
        match self.cell(x) {
            Some(j) => self.cell_line(profile, j).whole_slope(profile, x),
            None => {
                let last = self.x[self.last()];
                profile.image_slope(x) - 2.0 * self.worn_image[self.last()] * (last / x).powi(2) / x
            }
        }
    }

    /// Image of the wear at x by a monotone cubic in x²: of higher order than the line where the
    /// image is smooth, without overshoot at a jump. For taking it over to other nodes.
    pub(crate) fn smooth_image(&self, x: f64) -> f64 {
        match self.cell(x) {
            Some(j) => self.cubic(&self.worn_image, j).value_and_slope(x * x).0,
            None => self.far_part(x).0,
        }
    }

    /// Worn depth at a square of a radius by such a cubic, m, and its slope in that, 1/m; 0 behind
    /// the last node.
    pub(crate) fn smooth_depth(&self, square: f64) -> (f64, f64) {
        let cell = self.cell(square.sqrt());
        cell.map_or((0.0, 0.0), |j| self.cubic(&self.depth, j).value_and_slope(square))
    }

    /// Steffen's cubic of a field in a cell.
    fn cubic(&self, field: &[f64], j: usize) -> Cubic {
        let width = |k: usize| (self.x[k + 1] - self.x[k]) * (self.x[k + 1] + self.x[k]);
        let cell = |k: usize| (width(k), (field[k + 1] - field[k]) / width(k));
        let at = |k: usize| {
            if k == 0 || k == self.last() { cell(j).1 } else { steffen_slope(cell(k - 1), cell(k)) }
        };
        let (width, secant) = cell(j);
        let bends = (width * (at(j) - secant), width * (secant - at(j + 1)));
        Cubic { start: self.x[j] * self.x[j], width, value: field[j], rise: width * secant, bends }
    }

    /// dh/dX in cell j.
    pub(in crate::surface) fn slope(&self, j: usize) -> f64 {
        self.secant(&self.worn_image, j)
    }

    /// Slope in X of values at the nodes over cell j.
    pub(in crate::surface) fn secant(&self, values: &[f64], j: usize) -> f64 {
        let (x0, x1) = (self.x[j], self.x[j + 1]);
        (values[j + 1] - values[j]) / ((x1 - x0) * (x1 + x0))
    }

    /// Image g of the whole profile at a node, m.
    pub(super) fn whole(&self, profile: &Profile, j: usize) -> f64 {
        profile.image(self.x[j]) + self.worn_image[j]
    }

    /// ∫ g² of the whole profile less that of the body, m³, from the inner node of a cell, or from
    /// the last node, to a radius behind it, by four-point Lobatto. A core that has not worn may be
    /// one wide cell: what the body has there is exact.
    pub(super) fn worn_square_in_cell(&self, profile: &Profile, cell: Option<usize>, x: f64) -> f64 {
        let start = self.x[cell.unwrap_or(self.last())];
        let line = cell.map(|j| self.cell_line(profile, j));
        if line.is_some_and(|line| !line.is_levelled && line.image == 0.0 && line.slope == 0.0) {
            return 0.0;
        }
        let is_levelled = line.is_some_and(|line| line.is_levelled);
        let integrand = |x: f64| {
            let image = line.map_or_else(|| self.far_part(x).0, |line| line.image_at(x));
            image * if is_levelled { image } else { 2.0 * profile.image(x) + image }
        };
        let (middle, half) = (0.5 * (x + start), 0.5 * (x - start));
        let node = half * 0.2f64.sqrt();
        let [ends, inside] =
            [(start, x), (middle - node, middle + node)].map(|(a, b)| integrand(a) + integrand(b));
        let body =
            if is_levelled { profile.square_integral(x) - profile.square_integral(start) } else { 0.0 };
        half / 6.0 * (ends + 5.0 * inside) - body
    }
}
