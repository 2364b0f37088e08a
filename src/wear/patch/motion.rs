//! What wears a surface: a motion that repeats, at constant load.

use crate::parameters::NormalControl;
use std::sync::Arc;

/// What wears the surface: a motion that repeats, at constant load.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Motion {
    /// Which normal quantity is held.
    pub(crate) control: NormalControl,
    /// F_N/(2E*) in m² or the indentation depth in m.
    pub(crate) value: f64,
    pub(crate) sliding: Sliding,
    /// What `sliding` is made of, where that is not cycles of one amplitude.
    pub(crate) mixture: Option<Mixture>,
    /// What drives cycles, where it is no rigid rig: their amplitude is then that on the surface at
    /// the start.
    pub(crate) rig: Option<Rig>,
}

/// Cycles of several amplitudes, none of which is larger than that of the motion: the share of each
/// and its amplitude, m. Shares may be below 0 and have any sum.
pub(crate) type Mixture = Arc<[(f64, f64)]>;

/// A drive with a spring between it and the body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Rig {
    /// Amplitude of the drive, m.
    pub(crate) amplitude: f64,
    /// 2G*/k_rig, 1/m: by so much times ∫ min(U₀, m q) dx the body stays behind the drive.
    pub(crate) compliance: f64,
}

/// How the body moves.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub(crate) enum Sliding {
    /// Cycles between ±U₀ (m); wear is counted in cycles.
    Cycles(f64),
    /// On and on in one direction, all springs slipping; wear is counted in metres of path.
    Onward,
}

impl Sliding {
    /// Slip σ = U − ratio·m q, of which `strokes` make a unit.
    pub(super) fn law(self) -> (f64, f64, f64) {
        match self {
            Self::Cycles(amplitude) => (amplitude, 1.0, 4.0),
            Self::Onward => (1.0, 0.0, 1.0),
        }
    }

    /// Largest q at which a spring slips, over 1/m.
    pub(crate) fn amplitude(self) -> f64 {
        match self {
            Self::Cycles(amplitude) => amplitude,
            Self::Onward => f64::INFINITY,
        }
    }
}
