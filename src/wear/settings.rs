//! How much of a motion is to be integrated, and how finely.

/// Share of the tolerance that leaving out nodes may take of the largest image.
pub(crate) const THINNING: f64 = 0.05;

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
