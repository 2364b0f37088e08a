//! A profile given by points (r, f), for instance from a profilometer.
//!
//! The image is taken piecewise linear in x² between the radii of the points, such that the profile
//! it belongs to passes through every point (the inverse Abel transform of [`crate::transform`],
//! solved node by node). The points of a sphere so give the image of that sphere exactly, and
//! everything else follows in closed form on each piece.
//!
//! For n points the image costs n²/2 weights once (2 ms for 400 points), a height or a pressure
//! O(n) operations, and whatever else is asked of it O(log n).

use super::text::{self, LengthUnit, Points};
use crate::error::Error;
use crate::number::short;
use crate::range;
use crate::transform::{abel_last, inverse_at, pressure_weight};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;
use std::sync::Arc;

/// A tabulated profile with its one-dimensional image. Copies share their data.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(try_from = "Vec<(f64, f64)>", into = "Vec<(f64, f64)>")]
pub struct ProfileTable(Arc<Data>);

/// Largest coordinate, m.
const MOST: f64 = *range::LENGTH.end();

#[derive(Debug)]
struct Data {
    points: Vec<(f64, f64)>,
    radii: Vec<f64>,
    /// Image at the radii, m.
    image: Vec<f64>,
    /// ∫₀ ξ g' dξ up to each point, m².
    load: Vec<f64>,
    /// ∫₀ g² dξ up to each point, m³.
    square: Vec<f64>,
    /// Largest image up to each point, m.
    highest: Vec<f64>,
    /// Smallest image and load integral from each point on, m and m².
    lowest: Vec<f64>,
    lightest: Vec<f64>,
    monotone_up_to: f64,
    /// f(0) of the file, m.
    subtracted: f64,
}

impl ProfileTable {
    /// Fewest accepted points.
    pub const LEAST_POINTS: usize = 3;

    /// Most points: with these, the image takes some four seconds.
    pub const MOST_POINTS: usize = 20_000;

    /// Builds the table from points (r, f), m, with r rising strictly from 0.
    ///
    /// # Errors
    /// [`Error::ProfileTable`] that says which point is wrong and why.
    pub fn new(points: Vec<(f64, f64)>) -> Result<Self, Error> {
        Self::at_places(points, |i| format!("point {}", i + 1))
    }

    /// Reads two columns r and f in m. See [`Self::parse_in`].
    ///
    /// # Errors
    /// [`Error::ProfileTable`] that quotes the line.
    pub fn parse(text: &str) -> Result<Self, Error> {
        Self::parse_in(text, LengthUnit::M)
    }

    /// Reads two columns r and f, separated by blanks, tabs, commas or semicolons; `#` starts a
    /// comment.
    ///
    /// A byte-order mark, one header line of words, and falling r are accepted. With tabs or
    /// semicolons a comma is a decimal comma. A height on the axis, f(0), is subtracted from all
    /// heights: see [`Self::subtracted_height`].
    ///
    /// # Errors
    /// [`Error::ProfileTable`] that quotes the line.
    pub fn parse_in(text: &str, unit: LengthUnit) -> Result<Self, Error> {
        let Points { mut points, places } = text::read(text, unit)?;
        let height = points.first().map_or(0.0, |&(_, f)| f);
        if height.is_finite() {
            points.iter_mut().for_each(|(_, f)| *f -= height);
        }
        let table = Self::at_places(points, |i| places.get(i).cloned().unwrap_or_default())?;
        let mut data = Arc::into_inner(table.0).expect("it has not been shared");
        data.subtracted = height;
        Ok(Self(Arc::new(data)))
    }

    fn at_places(points: Vec<(f64, f64)>, place: impl Fn(usize) -> String) -> Result<Self, Error> {
        let refuse = |i: usize, problem: String| Err(Error::ProfileTable { place: place(i), problem });
        if points.len() < Self::LEAST_POINTS {
            let problem =
                format!("{} point(s) where at least {} are needed", points.len(), Self::LEAST_POINTS);
            return Err(Error::ProfileTable { place: "the whole table".into(), problem });
        }
        if points.len() > Self::MOST_POINTS {
            let problem = format!(
                "{} points where at most {} are taken: keep one of every {}, or let `cargo fmu profile` make a \
                 table of 401 points",
                points.len(),
                Self::MOST_POINTS,
                points.len().div_ceil(Self::MOST_POINTS)
            );
            return Err(Error::ProfileTable { place: "the whole table".into(), problem });
        }
        for (i, &(r, f)) in points.iter().enumerate() {
            if !(r.abs() <= MOST && f.abs() <= MOST) {
                return refuse(i, format!("r = {r}, f = {f}: both have to be finite, 1e30 m at most"));
            }
            if i == 0 && r != 0.0 {
                return refuse(
                    i,
                    format!(
                        "r = {} m: the first point has to lie on the axis, r = 0; a scan over both sides \
                     becomes a table by `cargo fmu profile`",
                        short(r)
                    ),
                );
            }
            if i > 0 && r == points[i - 1].0 {
                return refuse(i, format!("r = {} m occurs twice: keep one of the two points", short(r)));
            }
            if i > 0 && r < points[i - 1].0 {
                let before = points[i - 1].0;
                return refuse(
                    i,
                    format!("r = {} m after r = {} m: sort the points by rising r", short(r), short(before)),
                );
            }
            if i > 0 && r < *range::LENGTH.start() {
                return refuse(
                    i,
                    format!("r = {} m: a radius that is not 0 has to be 1e-30 m at least", short(r)),
                );
            }
        }
        let tip = points[0].1;
        if let Some(i) = points.iter().position(|&(_, f)| f < tip)
            && points.iter().all(|&(_, f)| f <= tip)
        {
            return refuse(
                i,
                "the heights fall outward: f is the height above the tip and has to rise; change the sign of all f"
                    .into(),
            );
        }
        let (radii, heights): (Vec<f64>, Vec<f64>) = points.iter().copied().unzip();
        let image = image_through(&radii, &heights);
        let g = &image;
        let monotone_up_to = g.windows(2).position(|g| g[1] < g[0]).map_or(f64::INFINITY, |i| radii[i]);
        let (mut load, mut square) = (vec![0.0], vec![0.0]);
        for j in 0..radii.len() - 1 {
            let piece = Piece { x0: radii[j], x1: radii[j + 1], g0: g[j], g1: g[j + 1] };
            load.push(load[j] + piece.load(radii[j + 1]));
            square.push(square[j] + piece.square(radii[j + 1]));
        }
        let highest = running(g.iter().copied(), f64::max);
        let mut lowest = running(g.iter().rev().copied(), f64::min);
        let mut lightest = running(load.iter().rev().copied(), f64::min);
        lowest.reverse();
        lightest.reverse();
        let data = Data {
            points,
            radii,
            image,
            load,
            square,
            highest,
            lowest,
            lightest,
            monotone_up_to,
            subtracted: 0.0,
        };
        Ok(Self(Arc::new(data)))
    }

    /// The points (r, f), m.
    pub fn points(&self) -> &[(f64, f64)] {
        &self.0.points
    }

    /// Largest radius up to which the image does not fall, m; infinite where it never does.
    pub fn monotone_up_to(&self) -> f64 {
        self.0.monotone_up_to
    }

    /// Largest depth by which the image lies below an earlier value of its own, m; 0 where it never
    /// falls.
    pub fn largest_fall(&self) -> f64 {
        let pairs = self.0.highest.iter().zip(&self.0.image);
        pairs.map(|(highest, g)| highest - g).fold(0.0, f64::max)
    }

    /// Roughness, m: root mean square deviation of the points from the line in r² through both
    /// neighbours. On evenly spaced points independent noise is √(2/3) times that; a sphere has
    /// none.
    pub fn roughness(&self) -> f64 {
        let deviation = |three: &[(f64, f64)]| {
            let [(r0, f0), (r1, f1), (r2, f2)] = *three else { return 0.0 };
            let share = (r1 - r0) * (r1 + r0) / ((r2 - r0) * (r2 + r0));
            (f1 - f0 - share * (f2 - f0)).powi(2)
        };
        let windows = self.0.points.windows(3);
        let count = windows.len().max(1) as f64;
        (windows.map(deviation).sum::<f64>() / count).sqrt()
    }

    /// f(0) of the file that was read, m, which has been subtracted from all heights; 0 for points
    /// that were not read from a text.
    pub fn subtracted_height(&self) -> f64 {
        self.0.subtracted
    }

    /// Radius of the last point, m.
    pub fn outer_radius(&self) -> f64 {
        self.0.radii[self.0.radii.len() - 1]
    }

    /// Radii of the points, m.
    pub(crate) fn radii(&self) -> &[f64] {
        &self.0.radii
    }

    /// Piece j, between the points j and j + 1.
    fn nth(&self, j: usize) -> Piece {
        let (radii, image) = (&self.0.radii, &self.0.image);
        Piece { x0: radii[j], x1: radii[j + 1], g0: image[j], g1: image[j + 1] }
    }

    /// Index and data of the piece that holds x; the last piece is continued beyond the table.
    fn piece(&self, x: f64) -> (usize, Piece) {
        let radii = &self.0.radii;
        let j = radii.partition_point(|&r| r <= x).clamp(1, radii.len() - 1) - 1;
        (j, self.nth(j))
    }

    /// Height f(r) of the profile, m; beyond the last radius that at the last.
    pub(super) fn height(&self, r: f64) -> f64 {
        inverse_at(&self.0.radii, &self.0.image, r.min(self.outer_radius()))
    }

    pub(super) fn image(&self, x: f64) -> f64 {
        self.piece(x).1.image(x)
    }

    pub(super) fn image_slope(&self, x: f64) -> f64 {
        2.0 * x * self.piece(x).1.slope()
    }

    pub(super) fn load_integral(&self, x: f64) -> f64 {
        let (j, piece) = self.piece(x);
        self.0.load[j] + piece.load(x)
    }

    pub(super) fn square_integral(&self, x: f64) -> f64 {
        let (j, piece) = self.piece(x);
        self.0.square[j] + piece.square(x)
    }

    /// Between two radii that are r or more; nothing beyond the last point.
    pub(super) fn pressure_integral(&self, r: f64, (from, to): (f64, f64)) -> f64 {
        let last = self.0.radii.len() - 1;
        let pieces = (self.piece(from).0..last).map(|j| self.nth(j)).take_while(|piece| piece.x0 < to);
        pieces.map(|piece| piece.pressure(r, (from, to))).sum()
    }

    /// The radius at which the image takes the value `depth`, where there is one only.
    pub(super) fn radius_at_depth(&self, depth: f64) -> Option<f64> {
        let j = outermost_below(&self.0.lowest, depth)?;
        if self.0.highest[j] > depth {
            return None;
        }
        let Piece { x0, x1, g0, g1 } = self.nth(j);
        let (inner, share) = (x0 / x1, (depth - g0) / (g1 - g0));
        Some(x1 * (inner * inner + share * (1.0 - inner) * (1.0 + inner)).sqrt())
    }

    /// Outermost radius at which the load integral takes the value `load`, where there is one
    /// inside the table.
    pub(super) fn radius_at_load(&self, load: f64) -> Option<f64> {
        let j = outermost_below(&self.0.lightest, load)?;
        let piece = self.nth(j);
        // linear in x³
        let (inner, share) = ((piece.x0 / piece.x1).powi(3), (load - self.0.load[j]) / piece.load(piece.x1));
        Some(piece.x1 * (inner + share * (1.0 - inner)).cbrt())
    }
}

/// The image (m) at the radii (m) whose profile has the given heights (m) there. It holds NaN or
/// infinities where squares of radii are too small to differ.
fn image_through(radii: &[f64], heights: &[f64]) -> Vec<f64> {
    // from the height on the axis: a flat tip has no image, to the last digit
    let mut image = Vec::with_capacity(radii.len());
    image.push(0.0);
    for i in 1..radii.len() {
        image.push(abel_last(&radii[..=i], &image, heights[i] - heights[0]));
    }
    image.iter_mut().for_each(|g| *g += heights[0]);
    image
}

/// Last point whose value, and none further out, is above `value`, if it is not the last of all:
/// `lowest` holds the smallest of the values from each point on.
fn outermost_below(lowest: &[f64], value: f64) -> Option<usize> {
    let above = lowest.partition_point(|&low| low <= value);
    (above > 0 && above < lowest.len()).then(|| above - 1)
}

/// The running maximum or minimum.
fn running(values: impl Iterator<Item = f64>, choose: impl Fn(f64, f64) -> f64) -> Vec<f64> {
    values
        .scan(None, |so_far, value| {
            let chosen = so_far.map_or(value, |before| choose(before, value));
            *so_far = Some(chosen);
            Some(chosen)
        })
        .collect()
}

/// One piece of the image, linear in X = x²: g = g0 + σ (X − x0²).
struct Piece {
    x0: f64,
    x1: f64,
    g0: f64,
    g1: f64,
}

impl Piece {
    /// σ = dg/dX.
    fn slope(&self) -> f64 {
        (self.g1 - self.g0) / ((self.x1 - self.x0) * (self.x1 + self.x0))
    }

    fn image(&self, x: f64) -> f64 {
        self.g0 + self.slope() * (x - self.x0) * (x + self.x0)
    }

    /// ∫ from x0 to x of ξ g' dξ.
    fn load(&self, x: f64) -> f64 {
        let delta = x - self.x0;
        2.0 / 3.0 * self.slope() * delta * (x * x + x * self.x0 + self.x0 * self.x0)
    }

    /// ∫ g' dξ/√(ξ² − r²) over what lies between two radii.
    fn pressure(&self, r: f64, (from, to): (f64, f64)) -> f64 {
        let (x0, x1) = (self.x0.max(from), self.x1.min(to));
        if x1 <= x0 {
            return 0.0;
        }
        PI * self.slope() * (x1 - x0) * (x1 + x0) * pressure_weight(x0, x1, r)
    }

    /// ∫ from x0 to x of g² dξ, in δ = ξ − x0, where X − x0² = δ (2 x0 + δ).
    fn square(&self, x: f64) -> f64 {
        let (d, c, s) = (x - self.x0, 2.0 * self.x0, self.slope());
        let linear = d * d * (c / 2.0 + d / 3.0);
        let quadratic = d * d * d * (c * c / 3.0 + d * (c / 2.0 + d / 5.0));
        self.g0 * self.g0 * d + 2.0 * self.g0 * s * linear + s * s * quadratic
    }
}

impl PartialEq for ProfileTable {
    /// All else follows from the points.
    fn eq(&self, other: &Self) -> bool {
        self.points() == other.points()
    }
}

impl TryFrom<Vec<(f64, f64)>> for ProfileTable {
    type Error = Error;

    fn try_from(points: Vec<(f64, f64)>) -> Result<Self, Error> {
        Self::new(points)
    }
}

impl From<ProfileTable> for Vec<(f64, f64)> {
    fn from(table: ProfileTable) -> Self {
        table.0.points.clone()
    }
}
