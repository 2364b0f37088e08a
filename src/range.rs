//! The sizes that are computed with, all far beyond anything built. Within them no product of those
//! that the formulas take overflows: the largest, 4 μ F_N U₀ cycles k/σ₀, stays below 10³⁰⁰. What
//! is smaller than all of them underflows to 0, which is right.
//!
//! | | from | to | for comparison |
//! | --- | --- | --- | --- |
//! | lengths of the body, m | 1e-30 | 1e30 | Planck length 2e-35, visible universe 9e26 |
//! | moduli, hardness, Pa | 1e-30 | 1e30 | softest gels 1, crust of a neutron star 1e29 |
//! | friction | 0 | 1e9 | rubber 4 |
//! | wear coefficient | 0 | 1e30 | cutting 0.1 |
//! | energy of running in, J | 0 | 1e30 | output of the sun in an hour 1e30 |
//! | inputs, N and m; cycles of a call | | 1e60; 1e30 | |
//! | contact radius; depth; load/(2E*); force | | 1e60 m; 1e90 m; 1e120 m²; 1e120 N | |

use crate::error::Error;
use std::ops::RangeInclusive;

/// Name of the displacement along y in messages.
pub(crate) const Y: &str = "tangential_displacement_y";
/// Lengths of a body, m.
pub(crate) const LENGTH: RangeInclusive<f64> = 1e-30..=1e30;
/// Moduli and hardness, Pa.
pub(crate) const STRESS: RangeInclusive<f64> = 1e-30..=1e30;
/// Slope of a cone, rad; its upper bound π/2 is excluded.
pub(crate) const LEAST_SLOPE: f64 = 1e-30;
/// Coefficient of a power law, whose size means nothing without its exponent.
pub(crate) const COEFFICIENT: RangeInclusive<f64> = 1e-300..=1e300;
/// Coefficient of friction.
pub(crate) const FRICTION: RangeInclusive<f64> = 0.0..=1e9;
/// Energy over which friction runs in, J.
pub(crate) const RUNNING_IN: RangeInclusive<f64> = 0.0..=1e30;
/// Wear coefficient.
pub(crate) const WEAR: RangeInclusive<f64> = 0.0..=1e30;
/// Tolerance of the wear integration; with a thousandth of it a step took 8 s.
pub(crate) const TOLERANCE: RangeInclusive<f64> = 1e-7..=0.1;
/// Loads, depths and displacements that are given, N and m.
pub(crate) const MOST_INPUT: f64 = 1e60;
/// Cycles of one call.
pub(crate) const MOST_CYCLES: f64 = 1e30;

/// An image that rises by less, m, is flat: displacements of [`MOST_INPUT`] over it would be no
/// number.
pub(crate) const LEAST_RISE: f64 = 1e-240;

/// Least radius of a contact, m: of smaller ones the squares, in which meshes are made, would be 0.
pub(crate) const LEAST_RADIUS: f64 = 1e-120;

const MOST_RADIUS: f64 = 1e60;
const MOST_DEPTH: f64 = 1e90;
const MOST_LOAD: f64 = 1e120;
const MOST_FORCE: f64 = 1e120;

/// A parameter in its range.
///
/// # Errors
/// [`Error::Parameter`] outside of it, and for what is no number.
pub(crate) fn parameter(
    name: &'static str,
    value: f64,
    range: &RangeInclusive<f64>,
    requirement: &'static str,
) -> Result<(), Error> {
    if range.contains(&value) { Ok(()) } else { Err(Error::Parameter { name, value, requirement }) }
}

/// An input in its range, of either sign.
///
/// # Errors
/// [`Error::Input`] outside of it, and for what is no number.
pub(crate) fn input(name: &'static str, value: f64) -> Result<(), Error> {
    if value.abs() <= MOST_INPUT {
        return Ok(());
    }
    Err(Error::Input {
        name,
        value,
        requirement: "an input has to be a finite number of 1e60 at most, in N and m",
    })
}

/// A contact whose radius (m), depth (m), load/(2E*) (m²) and force (N) are in their ranges.
///
/// # Errors
/// [`Error::BeyondNumbers`] with the first that is not.
pub(crate) fn contact(radius: f64, depth: f64, load: f64, force: f64) -> Result<(), Error> {
    // so that what is no number is refused, too
    let within = |value: f64, most: f64| value.abs() <= most;
    if within(radius, MOST_RADIUS)
        && within(depth, MOST_DEPTH)
        && within(load, MOST_LOAD)
        && within(force, MOST_FORCE)
    {
        return Ok(());
    }
    let (what, value, most) = [
        ("contact radius, m", radius, MOST_RADIUS),
        ("indentation depth, m", depth, MOST_DEPTH),
        ("load integral, m2", load, MOST_LOAD),
        ("normal force, N", force, MOST_FORCE),
    ]
    .into_iter()
    .find(|(_, value, most)| !within(*value, *most))
    .expect("one of them is not in its range");
    Err(Error::BeyondNumbers { what, value, most })
}
