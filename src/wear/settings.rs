//! How much of a motion is to be integrated, and how finely.

/// Share of the tolerance that leaving out nodes may take of the largest image.
const THINNING: f64 = 0.05;

/// Least tolerance in space, times the square of the number of cells: a line in X over one of n
/// even cells misses 0.25/n² of an image that goes like X². Of a short life at a tolerance of 1e-6,
/// which takes 3.2 s, half of the value and twice change V by 2e-4 on the way and 2e-5 at the end;
/// it then takes 4.0 and 2.5 s. V of 145 random programmes of blocks is as near to a fine run with
/// a quarter and four times of it (1e-5 and 1e-6; 90 % within 1.1e-3 with 32 cells, 3e-4 with 64);
/// without it two of them are refused at 1e-6.
const OF_CELLS: f64 = 0.2;

/// A tolerance, but at least what lines over a number of cells can meet.
pub(crate) fn tolerance_in_space(tolerance: f64, cells: usize) -> f64 {
    tolerance.max(OF_CELLS / (cells as f64).powi(2))
}

/// Share of the largest image that leaving out nodes may take.
pub(crate) fn thinning(tolerance: f64, cells: usize) -> f64 {
    THINNING * tolerance_in_space(tolerance, cells)
}

/// How finely to integrate.
#[derive(Debug, Clone, Copy)]
pub(crate) struct IntegrationSettings {
    /// Cells across the slipping region that the nodes give; the mesh of an annulus has five
    /// eighths of them.
    pub(crate) cells: usize,
    /// Largest error of the image in a step, over the largest image that may wear.
    pub(crate) tolerance: f64,
    /// Cycles of the last step, where it went on from here; 0 at first.
    pub(crate) last_step: f64,
}

/// Which part of a history an amount is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Part {
    /// A call, on whatever other loads have left.
    Call,
    /// A stretch of a call, on what the one before has left.
    Stretch,
    /// What has been gathered since the last update, a small part of a life.
    Update,
}

/// How much of a motion wears the surface.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Amount {
    /// Cycles, or metres where it slides onward.
    pub(crate) cycles: f64,
    /// Volume worn so far, m³: that of the profile, and what has found no place on it yet.
    pub(crate) worn: f64,
    pub(crate) part: Part,
}
