//! A profile given by points (r, f), for instance from a profilometer.
//!
//! The image is taken piecewise linear in x² between the radii of the points, such that the profile it belongs to
//! passes through every point (the descent transform of [`crate::transform`], solved node by node). The points of a
//! sphere so give the image of that sphere exactly, and everything else follows in closed form on each piece.

use crate::error::Error;
use crate::transform::{self, leg};
use serde::{Deserialize, Serialize};

/// A tabulated profile with its one-dimensional image.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Vec<(f64, f64)>", into = "Vec<(f64, f64)>")]
pub struct ProfileTable {
    points: Vec<(f64, f64)>,
    radii: Vec<f64>,
    image: Vec<f64>,
    load: Vec<f64>,
    square: Vec<f64>,
    monotone_up_to: f64,
}

impl ProfileTable {
    /// Fewest accepted points.
    pub const LEAST_POINTS: usize = 3;

    /// Builds the table from points (r, f), m, with r rising strictly from 0.
    ///
    /// # Errors
    /// [`Error::ProfileTable`] that says which point is wrong and why.
    pub fn new(points: Vec<(f64, f64)>) -> Result<Self, Error> {
        Self::at_places(points, |i| format!("point {}", i + 1))
    }

    /// Reads two columns r and f in m, separated by blanks, tabs, commas or semicolons; `#` starts a comment.
    ///
    /// # Errors
    /// [`Error::ProfileTable`] that names the line.
    pub fn parse(text: &str) -> Result<Self, Error> {
        let mut points = Vec::new();
        let mut lines = Vec::new();
        for (index, line) in text.lines().enumerate() {
            let content = line.split('#').next().unwrap_or_default();
            let fields: Vec<&str> = content
                .split(|c: char| c.is_whitespace() || c == ',' || c == ';')
                .filter(|f| !f.is_empty())
                .collect();
            let problem = match fields[..] {
                [] => continue,
                [r, f] => match (r.parse::<f64>(), f.parse::<f64>()) {
                    (Ok(r), Ok(f)) => {
                        points.push((r, f));
                        lines.push(index + 1);
                        continue;
                    }
                    (Err(_), _) => format!("`{}` is not a number: give r in m", shorten(r)),
                    (_, Err(_)) => format!("`{}` is not a number: give f in m", shorten(f)),
                },
                _ => format!("{} column(s) where two are needed: r and f, in m", fields.len()),
            };
            return Err(Error::ProfileTable { place: format!("line {}", index + 1), problem });
        }
        Self::at_places(points, |i| format!("line {}", lines.get(i).copied().unwrap_or_default()))
    }

    fn at_places(points: Vec<(f64, f64)>, place: impl Fn(usize) -> String) -> Result<Self, Error> {
        let refuse = |i: usize, problem: String| Err(Error::ProfileTable { place: place(i), problem });
        if points.len() < Self::LEAST_POINTS {
            let problem =
                format!("{} point(s) where at least {} are needed", points.len(), Self::LEAST_POINTS);
            return Err(Error::ProfileTable { place: "the whole table".into(), problem });
        }
        for (i, &(r, f)) in points.iter().enumerate() {
            if !r.is_finite() || !f.is_finite() {
                return refuse(i, format!("r = {r}, f = {f}: both have to be finite"));
            }
            if i == 0 && r != 0.0 {
                return refuse(i, format!("r = {r:e} m: the first point has to lie on the axis, r = 0"));
            }
            if i > 0 && r == points[i - 1].0 {
                return refuse(i, format!("r = {r:e} m occurs twice: keep one of the two points"));
            }
            if i > 0 && r < points[i - 1].0 {
                let before = points[i - 1].0;
                return refuse(i, format!("r = {r:e} m after r = {before:e} m: sort the points by rising r"));
            }
        }
        let radii: Vec<f64> = points.iter().map(|p| p.0).collect();
        let image = image_through(&points, &radii);
        if let Some(i) = image.iter().position(|g| !g.is_finite()) {
            return refuse(i, "the 1-D image overflows here: check the units, r and f are in m".into());
        }
        let monotone_up_to = image.windows(2).position(|g| g[1] < g[0]).map_or(f64::INFINITY, |i| radii[i]);
        let (mut load, mut square) = (vec![0.0], vec![0.0]);
        for j in 0..radii.len() - 1 {
            let piece = Piece { x0: radii[j], x1: radii[j + 1], g0: image[j], g1: image[j + 1] };
            load.push(load[j] + piece.load(radii[j + 1]));
            square.push(square[j] + piece.square(radii[j + 1]));
        }
        Ok(Self { points, radii, image, load, square, monotone_up_to })
    }

    /// The points (r, f), m.
    pub fn points(&self) -> &[(f64, f64)] {
        &self.points
    }

    /// Largest radius up to which the image does not fall, m; infinite where it never does.
    pub fn monotone_up_to(&self) -> f64 {
        self.monotone_up_to
    }

    /// Radius of the last point, m.
    pub fn outer_radius(&self) -> f64 {
        self.radii[self.radii.len() - 1]
    }

    /// Radii of the points, m.
    pub(crate) fn radii(&self) -> &[f64] {
        &self.radii
    }

    /// Index and data of the piece that holds x; the last piece is continued beyond the table.
    fn piece(&self, x: f64) -> (usize, Piece) {
        let j = self.radii.partition_point(|&r| r <= x).clamp(1, self.radii.len() - 1) - 1;
        let piece =
            Piece { x0: self.radii[j], x1: self.radii[j + 1], g0: self.image[j], g1: self.image[j + 1] };
        (j, piece)
    }

    pub(super) fn height(&self, r: f64) -> f64 {
        transform::descent_at(&self.radii, &self.image, r.min(self.outer_radius()))
    }

    pub(super) fn image(&self, x: f64) -> f64 {
        self.piece(x).1.image(x)
    }

    pub(super) fn image_slope(&self, x: f64) -> f64 {
        2.0 * x * self.piece(x).1.slope()
    }

    pub(super) fn load_integral(&self, x: f64) -> f64 {
        let (j, piece) = self.piece(x);
        self.load[j] + piece.load(x)
    }

    pub(super) fn square_integral(&self, x: f64) -> f64 {
        let (j, piece) = self.piece(x);
        self.square[j] + piece.square(x)
    }

    pub(super) fn pressure_integral(&self, r: f64, a: f64) -> f64 {
        let (last, _) = self.piece(a);
        let mut sum = 0.0;
        for j in (0..=last).rev() {
            let (x0, x1) = (self.radii[j].max(r), self.radii[j + 1].min(a));
            if x1 <= r {
                break;
            }
            let slope = (self.image[j + 1] - self.image[j])
                / ((self.radii[j + 1] - self.radii[j]) * (self.radii[j + 1] + self.radii[j]));
            sum += 2.0 * slope * (leg(x1, r) - leg(x0, r));
        }
        sum
    }
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

    /// ∫ from x0 to x of g² dξ, in δ = ξ − x0, where X − x0² = δ (2 x0 + δ).
    fn square(&self, x: f64) -> f64 {
        let (d, c, s) = (x - self.x0, 2.0 * self.x0, self.slope());
        let linear = d * d * (c / 2.0 + d / 3.0);
        let quadratic = d * d * d * (c * c / 3.0 + d * (c / 2.0 + d / 5.0));
        self.g0 * self.g0 * d + 2.0 * self.g0 * s * linear + s * s * quadratic
    }
}

/// Image values at the radii of the points such that the profile passes through every point.
fn image_through(points: &[(f64, f64)], radii: &[f64]) -> Vec<f64> {
    let mut image = vec![points[0].1];
    for i in 1..points.len() {
        image.push(0.0);
        image[i] = transform::ascend_last(&radii[..=i], &image, points[i].1);
    }
    image
}

/// The start of a field for a message.
fn shorten(field: &str) -> String {
    let start: String = field.chars().take(24).collect();
    if start.len() < field.len() { format!("{start}…") } else { start }
}

impl TryFrom<Vec<(f64, f64)>> for ProfileTable {
    type Error = Error;

    fn try_from(points: Vec<(f64, f64)>) -> Result<Self, Error> {
        Self::new(points)
    }
}

impl From<ProfileTable> for Vec<(f64, f64)> {
    fn from(table: ProfileTable) -> Self {
        table.points
    }
}
