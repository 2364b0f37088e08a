//! The slope of the image as pressure and traction take it: ∫ g' dx/√(x² − r²).
//!
//! Where wear has levelled the body the image of both is one line in each cell, elsewhere that of
//! the body is exact and that of the wear a line.

use super::{Nodes, Surface};
use crate::transform::pressure_weight;
use std::f64::consts::PI;

/// The slope of an image up to a radius.
#[derive(Debug)]
pub(crate) struct Slopes {
    surface: Surface,
    end: f64,
    /// None where nothing has worn.
    cells: Vec<Cell>,
}

/// A stretch of radii, m.
#[derive(Debug)]
struct Cell {
    start: f64,
    end: f64,
    /// dh/dX, or of the whole image, 1/m.
    slope: f64,
    is_levelled: bool,
}

impl Slopes {
    /// Those of a surface up to a radius, m.
    pub(crate) fn new(surface: &Surface, end: f64) -> Self {
        let cells = surface.worn().map_or_else(Vec::new, |nodes| cells_of(surface, nodes, end));
        Self { surface: surface.clone(), end, cells }
    }

    /// Whether they are those of a surface of this profile up to a radius, m.
    pub(crate) fn serve(&self, surface: &Surface, end: f64) -> bool {
        self.surface.is_worn_as(surface) && (surface.worn().is_none() || self.end == end)
    }

    /// ∫ g' dx/√(x² − r²) from r to a radius within them.
    pub(crate) fn integral(&self, r: f64, end: f64) -> f64 {
        self.integral_between(r, (r, end))
    }

    /// The part of [`Self::integral`] between two radii that are r or more.
    pub(crate) fn integral_between(&self, r: f64, (from, to): (f64, f64)) -> f64 {
        let of_body = |from: f64, to: f64| self.surface.profile().pressure_integral_between(r, (from, to));
        if self.surface.worn().is_none() {
            return of_body(from, to);
        }
        let first = self.cells.partition_point(|cell| cell.end <= from);
        let inside = self.cells[first..].iter().take_while(|cell| cell.start < to);
        let mut sum = 0.0;
        // of the body, where it counts by itself from a radius on
        let mut exact_from = None;
        for cell in inside {
            let (start, end) = (cell.start.max(from), cell.end.min(to));
            sum += PI * cell.slope * (end - start) * (end + start) * pressure_weight(start, end, r);
            match (cell.is_levelled, exact_from) {
                (false, None) => exact_from = Some(start),
                (true, Some(from)) => {
                    sum += of_body(from, start);
                    exact_from = None;
                }
                _ => {}
            }
        }
        sum + exact_from.map_or(0.0, |from| of_body(from, to))
    }
}

/// The cells of a worn surface up to a radius, m.
fn cells_of(surface: &Surface, nodes: &Nodes, end: f64) -> Vec<Cell> {
    let x = nodes.x();
    let inside = x.partition_point(|x| *x < end).min(nodes.last());
    let unworn = surface.profile().images(x);
    let levelled = nodes.levelled(&unworn);
    let cell = |j: usize| {
        let is_levelled = levelled[j] == Some(true);
        let body = if is_levelled { nodes.secant(&unworn, j) } else { 0.0 };
        let slope = body + nodes.slope(j);
        Cell { start: x[j], end: x[j + 1].min(end), slope, is_levelled }
    };
    let mut cells: Vec<Cell> = (0..inside).map(cell).collect();
    let start = x[nodes.last()];
    if start < end {
        let fall = surface.worn_image(end) - nodes.worn_image()[nodes.last()];
        let slope = fall / ((end - start) * (end + start));
        cells.push(Cell { start, end, slope, is_levelled: false });
    }
    cells
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::profile::Profile;
    use crate::transform::leg;

    const EDGE: f64 = 2e-4;

    /// A cone of which wear has taken a share of what it has beyond a ball of the same height.
    fn worn(share: f64, cells: u32) -> (Surface, f64) {
        let profile = Profile::Cone { slope: 0.02 };
        let steepness = profile.image(EDGE) / EDGE.powi(2);
        let x: Vec<f64> = (0..=cells).map(|k| 1.1 * EDGE * f64::from(k) / f64::from(cells)).collect();
        let image = x.iter().map(|x| share * (steepness * x * x - profile.image(*x))).collect();
        let depth = vec![1e-9; x.len()];
        let mut nodes = Nodes::holding((x, image, depth), 64, None);
        nodes.update_integrals(&profile);
        let mut surface = Surface::new(profile);
        surface.set_worn(Some(nodes));
        (surface, steepness)
    }

    /// Worn to a ball, the cone has the slope of a ball: at the axis and between the nodes, too.
    #[test]
    fn a_body_that_is_levelled_keeps_none_of_its_shape() {
        let (surface, steepness) = worn(1.0, 16);
        for k in 0..100 {
            let r = EDGE * f64::from(k) / 100.0;
            let (found, ball) =
                (Slopes::new(&surface, EDGE).integral(r, EDGE), 2.0 * steepness * leg(EDGE, r));
            assert!((found / ball - 1.0).abs() < 1e-12, "{r:e}: {found:e} {ball:e}");
        }
    }

    /// Where little has worn, the slope is that of the body and of lines, of second order in the
    /// cells beside the apex.
    #[test]
    fn a_body_that_has_hardly_worn_keeps_its_shape() {
        let r = 0.37 * EDGE;
        let error = |cells: u32| {
            let share = 1e-2;
            let (surface, steepness) = worn(share, cells);
            let cone = surface.profile().pressure_integral(r, EDGE);
            let exact = (1.0 - share) * cone + share * 2.0 * steepness * leg(EDGE, r);
            assert!(Slopes::new(&surface, EDGE).integral(0.0, EDGE).is_infinite(), "the apex is sharp");
            (Slopes::new(&surface, EDGE).integral(r, EDGE) / exact - 1.0).abs()
        };
        let (coarse, fine) = (error(16), error(256));
        assert!(coarse < 1e-3 && fine < coarse / 8.0, "{coarse:e} {fine:e}");
    }

    /// One of an unworn body serves any contact of it, one of a worn body the contact that it was
    /// made for: also where that was open.
    #[test]
    fn a_slope_serves_no_other_contact_of_a_worn_body() {
        let (surface, _) = worn(1.0, 16);
        for end in [0.0, 0.5 * EDGE] {
            let slopes = Slopes::new(&surface, end);
            assert!(slopes.serve(&surface, end) && !slopes.serve(&surface, EDGE), "{end}");
        }
        let unworn = surface.unworn();
        let slopes = Slopes::new(&unworn, 0.0);
        assert!(slopes.serve(&unworn, EDGE) && !slopes.serve(&surface, 0.0));
    }

    /// Up to a smaller radius it is that of a smaller contact, whichever cells are levelled.
    #[test]
    fn an_integral_does_not_depend_on_what_lies_beyond() {
        for share in [0.0, 0.3, 0.49, 0.51, 1.0] {
            let (surface, _) = worn(share, 20);
            let slopes = Slopes::new(&surface, EDGE);
            let (r, middle) = (0.2 * EDGE, 0.63 * EDGE);
            let shorter = Slopes::new(&surface, middle).integral(r, middle);
            assert!((slopes.integral(r, middle) / shorter - 1.0).abs() < 1e-13, "{share}");
        }
    }
}
