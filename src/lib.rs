//! Fretting contact of a body of revolution on an elastic half-space: force, slip, pressure and
//! wear, fast enough for the inside of a machine model's time loop.
//!
//! # Model
//! The method of dimensionality reduction (MDR) maps the contact exactly onto a row of independent
//! springs along one line x, pressed by a one-dimensional image g(x) of the profile f(r). Friction
//! acts on each spring by Coulomb's law; wear follows Reye, Archard and Khrushchov: worn volume =
//! (k/σ₀) × work of friction, at each radius.
//!
//! | symbol | meaning | unit | where |
//! | --- | --- | --- | --- |
//! | f(r), g(x) | profile and its 1-D image | m | [`profile`] |
//! | E*, G* | effective moduli | Pa | [`material`] |
//! | d, a, F_N | indentation depth, contact radius, normal force | m, m, N | [`FrettingContact`] |
//! | U, T | tangential displacement and force | m, N | |
//! | u(x), b(x) | spring deflection and its friction bound μE*(d − g)/G* | m | |
//! | c | stick radius | m | |
//! | p, τ | normal pressure and tangential traction | Pa | |
//! | w, W | worn depth, work of friction | m, J | |
//! | μ, k, σ₀ | coefficient of friction, wear coefficient, hardness | 1, 1, Pa | [`Parameters`] |
//!
//! T has the sign of the displacement that causes it: it is the force that the moving body exerts
//! on the substrate.
//!
//! # Source
//! A. V. Dimaki, A. I. Dmitriev, Y. S. Chai, V. L. Popov, *Rapid simulation procedure for fretting
//! wear on the basis of the method of dimensionality reduction*, Int. J. Solids Struct. 51 (2014);
//! V. L. Popov, M. Heß, *Method of Dimensionality Reduction in Contact Mechanics and Friction*,
//! Springer (2015). Equation numbers in these pages are those of the former.
//!
//! # Limits of validity
//! Bodies of revolution, or elliptic contacts without wear ([`ellipse`]); half-spaces, small
//! slopes; one contact disc; elastic similarity (other
//! pairs are computed as if they were similar, [`material::Pair::similarity_defect`] gives the
//! deviation); no debris, no temperature, no rate effects.

mod counters;
pub mod ellipse;
pub mod engine;
pub mod error;
#[cfg(feature = "fmi2")]
pub mod fmi2;
mod friction;
pub mod interface;
pub mod material;
mod number;
pub mod parameters;
pub mod problems;
pub mod profile;
mod quadrature;
mod range;
pub mod reference;
mod roots;
mod surface;
pub mod transform;
mod wear;

pub use ellipse::HertzianEllipse;
pub use engine::{Counters, FrettingContact, Gradient, SlipState, Snapshot};
pub use error::Error;
pub use interface::{Interface, InterfaceSnapshot, Summit};
pub use material::{Elastic, Pair};
pub use parameters::{NormalControl, Parameters};
pub use profile::{LengthUnit, Profile, ProfileTable};

/// The README, so that its Rust example is compiled and run with the tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
