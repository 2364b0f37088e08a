//! Closed forms of the model, and two brute-force checks, independent of the engine.
//!
//! Tests, benchmarks and reports measure the engine against this module, so it shares no code with
//! it: plain functions of `f64`, arguments in SI units, no state except in the rows of springs.
//! Inputs are trusted; a violated precondition panics.
//!
//! | symbol | meaning | unit |
//! | --- | --- | --- |
//! | f(r), g(x) | profile and its one-dimensional image | m |
//! | E*, G* | effective normal and tangential modulus | Pa |
//! | d, a, F_N | indentation depth, contact radius, normal force | m, m, N |
//! | q(x) = E* (d − g) | line force of the image | N/m |
//! | p(r), τ(r) | pressure and shear traction | Pa |
//! | U, T | tangential displacement and force | m, N |
//! | μ, c, u_max = μ d E*/G* | friction coefficient, stick radius, displacement at which all slips | 1, m, m |
//! | k, σ₀ | wear coefficient and hardness of the worn body | 1, Pa |
//!
//! | file | content | sources |
//! | --- | --- | --- |
//! | [`shape`] | profiles and images | Sneddon 1965; Popov and Heß, *Method of Dimensionality Reduction* |
//! | [`normal`] | d, a, F_N, p for each profile | Hertz 1882; Sneddon 1965 |
//! | [`tangential`] | T(U), stick radius, traction, slip, loop work | Cattaneo 1938; Mindlin 1949; Jäger 1995; Ciavarella 1998 |
//! | [`ellipse`] | the contact ellipse and its two tangential moduli | Hertz 1882; Cattaneo 1938; Johnson 1985 |
//! | [`wear`] | final state at constant depth, gross slip, seed cycles | Popov 2014; Dimaki et al. 2014 |
//! | [`wear_tables`] | histories without a closed form, as data | Dimaki et al. 2014 for the scenes |
//! | [`springs`] | the image as a row of springs, stepped | Dimaki et al. 2014, eq. (13) |
//! | [`anisotropic_springs`] | springs that are stiffer along one axis, in the plane | Coulomb's law |
//! | [`wearing_springs`] | the same row with wear, explicitly stepped | Dimaki et al. 2014, eqs. (12)–(18) |
//! | [`quadrature`], [`root`] | what the formulas need where no antiderivative exists | Takahasi and Mori 1974 |

pub mod anisotropic_springs;
pub mod ellipse;
pub mod normal;
pub mod quadrature;
pub mod root;
pub mod shape;
pub mod springs;
pub mod tangential;
pub mod wear;
pub mod wear_tables;
pub mod wearing_springs;

pub use anisotropic_springs::AnisotropicRow;
pub use ellipse::EllipticContact;
pub use normal::NormalContact;
pub use shape::Shape;
pub use springs::PlainSpringRow;
pub use tangential::{MonomialContact, TangentialContact};
pub use wear::ConstantDepthEnd;
pub use wearing_springs::{PlanarWearingRow, WearingRow};
