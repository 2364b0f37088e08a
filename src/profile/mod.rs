//! Unworn profiles f(r) and their one-dimensional MDR images g(x).
//!
//! Every analytic profile offers, in closed form, what the contact needs (paper, eqs. (1),
//! (9)–(12)):
//!
//! | method | quantity | unit |
//! | --- | --- | --- |
//! | [`Profile::height`] | f(r) | m |
//! | [`Profile::image`] | g(x) = f(0) + x ∫₀ˣ f'(r) dr/√(x² − r²) | m |
//! | [`Profile::image_slope`] | g'(x) | 1 |
//! | [`Profile::load_integral`] | φ(x) = ∫₀ˣ ξ g'(ξ) dξ, so that F_N = 2E* φ(a) | m² |
//! | [`Profile::square_integral`] | Q(x) = ∫₀ˣ g² dξ, for the work of friction | m³ |
//! | [`Profile::pressure_integral`] | J(r, a) = ∫ᵣᵃ g'(x) dx/√(x² − r²), so that p = E* J/π | 1 |
//!
//! Sources: Hertz (parabola), Love (cone), Galin/Sneddon and Popov & Heß, *Method of Dimensionality
//! Reduction in Contact Mechanics and Friction* (power law, truncated shapes).

mod rounded;
mod table;
mod text;

pub use table::ProfileTable;
pub use text::LengthUnit;
pub(crate) use text::{SECOND_HEADER, are_words, fields, lines, shorten};

use crate::ellipse::HertzianEllipse;
use crate::error::Error;
use crate::quadrature;
use crate::range;
use crate::transform::leg;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::f64::consts::{PI, SQRT_2};
use std::sync::atomic::{AtomicU64, Ordering};

/// Shape of the unworn body 1, a body of revolution, as height above its tip.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Profile {
    /// f = r²/(2R): a sphere.
    Parabola {
        /// Radius of curvature R, m.
        radius: f64,
    },
    /// f = r tan θ.
    Cone {
        /// Slope angle θ between the flank and the plane, rad, in [1e-30, π/2).
        slope: f64,
    },
    /// f = A rⁿ.
    PowerLaw {
        /// Exponent n, from 0.1 to 100.
        exponent: f64,
        /// Coefficient A, m^(1−n).
        coefficient: f64,
    },
    /// A sphere whose tip has been cut off flat: f = 0 for r < b, (r² − b²)/(2R) beyond.
    BluntedSphere {
        /// Radius of curvature R, m.
        radius: f64,
        /// Radius b of the flat tip, m.
        flat_radius: f64,
    },
    /// A flat tip with a rounded edge: f = 0 for r < b, (r − b)²/(2R) beyond.
    RoundedPunch {
        /// Radius of curvature R of the edge, m.
        radius: f64,
        /// Radius b of the flat tip, m.
        flat_radius: f64,
    },
    /// A flat-ended cylinder: f = 0 for r < b, nothing beyond.
    FlatPunch {
        /// Radius b, m.
        flat_radius: f64,
    },
    /// Tabulated heights.
    Table(ProfileTable),
    /// No body of revolution: f = x²/(2 R_x) + y²/(2 R_y), whose contact is an ellipse. What the
    /// methods below give is that of the equivalent sphere, see [`crate::ellipse`]. Without wear.
    Ellipse {
        /// Relative radius of curvature R_x of both bodies in the plane xz, m: 1/R = 1/R₁ + 1/R₂.
        radius_x: f64,
        /// That in the plane yz, R_y, m. The longer axis of the contact lies along the larger
        /// radius.
        radius_y: f64,
    },
}

/// Keeps the last value of a function that is slow to compute: all places of a contact ask for the
/// same one. Threads share it, since memory of each thread stays behind when Windows unloads the
/// library. `pair` holds the bits of value XOR argument: a value and a pair of different calls do
/// not give the argument.
struct LastValue {
    value: AtomicU64,
    pair: AtomicU64,
}

impl LastValue {
    const fn new() -> Self {
        Self { value: AtomicU64::new(0), pair: AtomicU64::new(f64::NAN.to_bits()) }
    }

    fn of(&self, argument: f64, f: impl Fn(f64) -> f64) -> f64 {
        let value = self.value.load(Ordering::Relaxed);
        if self.pair.load(Ordering::Relaxed) ^ value == argument.to_bits() {
            return f64::from_bits(value);
        }
        let value = f(argument);
        self.value.store(value.to_bits(), Ordering::Relaxed);
        self.pair.store(value.to_bits() ^ argument.to_bits(), Ordering::Relaxed);
        value
    }
}

static POWER_FACTOR: LastValue = LastValue::new();
static TANGENT: LastValue = LastValue::new();

/// κₙ = √π Γ(n/2 + 1)/Γ((n + 1)/2), the factor between A rⁿ and its image.
fn power_factor(n: f64) -> f64 {
    let factor = |n| PI.sqrt() * (libm::lgamma(n / 2.0 + 1.0) - libm::lgamma((n + 1.0) / 2.0)).exp();
    POWER_FACTOR.of(n, factor)
}

/// Slope g' of the image of a cone of a slope (rad): κ₁ tan θ = π/2 tan θ.
fn cone_slope(slope: f64) -> f64 {
    PI / 2.0 * TANGENT.of(slope, f64::tan)
}

/// Load integral of an image that goes like xⁿ, m².
fn load_of_power(n: f64, x: f64, image: f64) -> f64 {
    n / (n + 1.0) * x * image
}

/// And its square integral, m³.
fn square_of_power(n: f64, x: f64, image: f64) -> f64 {
    image * image * x / (2.0 * n + 1.0)
}

impl Profile {
    /// Checks the dimensions.
    ///
    /// # Errors
    /// [`Error::Parameter`] with the name and value of the first dimension outside its range.
    pub fn validate(&self) -> Result<(), Error> {
        let length = |name, value: f64| {
            range::parameter(name, value, &range::LENGTH, "for this profile it lies in 1e-30 to 1e30 m")
        };
        match *self {
            Self::Parabola { radius } => length("radius", radius),
            Self::Cone { slope } if (range::LEAST_SLOPE..PI / 2.0).contains(&slope) => Ok(()),
            Self::Cone { slope } => Err(Error::Parameter {
                name: "cone_slope",
                value: slope,
                requirement: "the slope angle lies in [1e-30, pi/2) rad",
            }),
            Self::PowerLaw { exponent, .. } if !(0.1..=100.0).contains(&exponent) => Err(Error::Parameter {
                name: "exponent",
                value: exponent,
                requirement: "the exponent of a power law lies in 0.1 to 100",
            }),
            Self::PowerLaw { coefficient, .. } => {
                let requirement = "the coefficient of a power law lies in 1e-300 to 1e300";
                range::parameter("coefficient", coefficient, &range::COEFFICIENT, requirement)
            }
            Self::BluntedSphere { radius, flat_radius } | Self::RoundedPunch { radius, flat_radius } => {
                length("radius", radius)?;
                length("flat_radius", flat_radius)
            }
            Self::FlatPunch { flat_radius } => length("flat_radius", flat_radius),
            Self::Table(_) => Ok(()),
            Self::Ellipse { .. } => self.ellipse().map(|_| ()),
        }
    }

    /// The ellipse of bodies that are no bodies of revolution.
    ///
    /// # Errors
    /// [`Error::Parameter`] for radii outside their range.
    pub fn ellipse(&self) -> Result<Option<HertzianEllipse>, Error> {
        match *self {
            Self::Ellipse { radius_x, radius_y } => HertzianEllipse::new(radius_x, radius_y).map(Some),
            _ => Ok(None),
        }
    }

    /// The equivalent sphere of an [`Self::Ellipse`]; any other shape itself.
    fn of_revolution(&self) -> Cow<'_, Self> {
        match self.ellipse() {
            Ok(None) => Cow::Borrowed(self),
            Ok(Some(ellipse)) => Cow::Owned(Self::Parabola { radius: ellipse.equivalent_radius() }),
            Err(_) => Cow::Owned(Self::Parabola { radius: f64::NAN }),
        }
    }

    /// The geometrically similar profile f(r) = k f₀(r/k): all its lengths are `factor` = k times
    /// those of this one. Angles and exponents stay.
    ///
    /// # Errors
    /// As [`Self::validate`] where a length leaves its range.
    pub fn scaled(&self, factor: f64) -> Result<Self, Error> {
        let scaled = match self {
            Self::Parabola { radius } => Self::Parabola { radius: factor * radius },
            Self::Cone { slope } => Self::Cone { slope: *slope },
            Self::PowerLaw { exponent, coefficient } => {
                Self::PowerLaw { exponent: *exponent, coefficient: coefficient * factor.powf(1.0 - exponent) }
            }
            Self::BluntedSphere { radius, flat_radius } => {
                Self::BluntedSphere { radius: factor * radius, flat_radius: factor * flat_radius }
            }
            Self::RoundedPunch { radius, flat_radius } => {
                Self::RoundedPunch { radius: factor * radius, flat_radius: factor * flat_radius }
            }
            Self::FlatPunch { flat_radius } => Self::FlatPunch { flat_radius: factor * flat_radius },
            Self::Ellipse { radius_x, radius_y } => {
                Self::Ellipse { radius_x: factor * radius_x, radius_y: factor * radius_y }
            }
            Self::Table(table) => {
                let points = table.points().iter().map(|&(r, f)| (factor * r, factor * f)).collect();
                Self::Table(ProfileTable::new(points)?)
            }
        };
        scaled.validate()?;
        Ok(scaled)
    }

    /// Radius b of the flat tip, m; 0 where there is none.
    pub fn flat_radius(&self) -> f64 {
        match *self {
            Self::BluntedSphere { flat_radius, .. }
            | Self::RoundedPunch { flat_radius, .. }
            | Self::FlatPunch { flat_radius } => flat_radius,
            _ => 0.0,
        }
    }

    /// Whether the curvature at the axis is infinite.
    pub(crate) fn is_sharp(&self) -> bool {
        match self {
            Self::Cone { .. } => true,
            Self::PowerLaw { exponent, .. } => *exponent < 2.0,
            _ => false,
        }
    }

    /// Radius at which the slope of the body or its curvature jumps, m: until it has worn, the
    /// pressure there is infinite or has an infinite slope. A spike has none that wear could round.
    pub(crate) fn kink(&self) -> Option<f64> {
        match self {
            Self::BluntedSphere { flat_radius, .. } => Some(*flat_radius),
            Self::PowerLaw { exponent, .. } if *exponent < 1.0 => None,
            _ => self.is_sharp().then_some(0.0),
        }
    }

    /// Radius at which the body ends or is no longer known, m; infinite for the others.
    pub fn outer_radius(&self) -> f64 {
        match self {
            Self::FlatPunch { flat_radius } => *flat_radius,
            Self::Table(table) => table.outer_radius(),
            _ => f64::INFINITY,
        }
    }

    /// Height f(r), m, at r ≥ 0.
    pub fn height(&self, r: f64) -> f64 {
        match self {
            Self::Parabola { radius } => r * r / (2.0 * radius),
            Self::Cone { slope } => r * slope.tan(),
            Self::PowerLaw { exponent, coefficient } => coefficient * r.powf(*exponent),
            Self::BluntedSphere { radius, flat_radius } => {
                let s = leg(r, *flat_radius);
                s * s / (2.0 * radius)
            }
            Self::RoundedPunch { radius, flat_radius } => (r - flat_radius).max(0.0).powi(2) / (2.0 * radius),
            Self::FlatPunch { flat_radius } => {
                if r <= *flat_radius {
                    0.0
                } else {
                    f64::INFINITY
                }
            }
            Self::Table(table) => table.height(r),
            Self::Ellipse { .. } => self.of_revolution().height(r),
        }
    }

    /// Images at several radii, m.
    pub(crate) fn images(&self, radii: &[f64]) -> Vec<f64> {
        match self {
            // the usual bodies without asking which they are at each radius
            Self::Parabola { radius } => radii.iter().map(|x| x * x / radius).collect(),
            Self::Cone { .. } => {
                let slope = self.image_slope(0.0);
                radii.iter().map(|x| slope * x).collect()
            }
            _ => radii.iter().map(|x| self.image(*x)).collect(),
        }
    }

    /// Image g(x), m, at x ≥ 0.
    pub fn image(&self, x: f64) -> f64 {
        match self {
            Self::Parabola { radius } => x * x / radius,
            Self::Cone { slope } => cone_slope(*slope) * x,
            Self::PowerLaw { exponent, coefficient } => {
                power_factor(*exponent) * coefficient * x.powf(*exponent)
            }
            Self::BluntedSphere { radius, flat_radius } => x / radius * leg(x, *flat_radius),
            Self::RoundedPunch { radius, flat_radius } => rounded::image(x, *radius, *flat_radius),
            Self::FlatPunch { flat_radius } => {
                if x <= *flat_radius {
                    0.0
                } else {
                    f64::INFINITY
                }
            }
            Self::Table(table) => table.image(x),
            Self::Ellipse { .. } => self.of_revolution().image(x),
        }
    }

    /// Slope g'(x) of the image at x ≥ 0.
    pub fn image_slope(&self, x: f64) -> f64 {
        match self {
            Self::Parabola { radius } => 2.0 * x / radius,
            Self::Cone { slope } => cone_slope(*slope),
            Self::PowerLaw { exponent: n, coefficient } => {
                n * power_factor(*n) * coefficient * x.powf(n - 1.0)
            }
            Self::BluntedSphere { radius, flat_radius: b } => {
                if x > *b {
                    (2.0 * x * x - b * b) / (radius * leg(x, *b))
                } else {
                    0.0
                }
            }
            Self::RoundedPunch { radius, flat_radius } => rounded::image_slope(x, *radius, *flat_radius),
            Self::FlatPunch { .. } => 0.0,
            Self::Table(table) => table.image_slope(x),
            Self::Ellipse { .. } => self.of_revolution().image_slope(x),
        }
    }

    /// Load integral φ(x) = ∫₀ˣ ξ g'(ξ) dξ = x g(x) − ∫₀ˣ g dξ, m².
    pub fn load_integral(&self, x: f64) -> f64 {
        match self {
            Self::Parabola { radius } => 2.0 / 3.0 * x * (x * x / radius),
            Self::Cone { .. } => load_of_power(1.0, x, self.image(x)),
            Self::PowerLaw { exponent, .. } => load_of_power(*exponent, x, self.image(x)),
            Self::BluntedSphere { radius, flat_radius: b } => {
                (2.0 * x * x + b * b) * leg(x, *b) / (3.0 * radius)
            }
            Self::RoundedPunch { radius, flat_radius } => rounded::load_integral(x, *radius, *flat_radius),
            Self::FlatPunch { .. } => 0.0,
            Self::Table(table) => table.load_integral(x),
            Self::Ellipse { .. } => self.of_revolution().load_integral(x),
        }
    }

    /// Square integral Q(x) = ∫₀ˣ g² dξ, m³.
    pub fn square_integral(&self, x: f64) -> f64 {
        match self {
            Self::Parabola { .. } => 0.2 * x * self.image(x).powi(2),
            Self::Cone { .. } => square_of_power(1.0, x, self.image(x)),
            Self::PowerLaw { exponent, .. } => square_of_power(*exponent, x, self.image(x)),
            Self::BluntedSphere { radius, flat_radius: b } => {
                // ∫ξ²(ξ² − b²) from b to x, written in s = √(x² − b²) and δ = x − b so that nothing
                // cancels near b
                let delta = (x - b).max(0.0);
                let polynomial = b.powi(3) + delta * (5.0 / 3.0 * b * b + delta * (b + delta / 5.0));
                delta * delta * polynomial / (radius * radius)
            }
            Self::RoundedPunch { radius, flat_radius } => rounded::square_integral(x, *radius, *flat_radius),
            Self::FlatPunch { .. } => 0.0,
            Self::Table(table) => table.square_integral(x),
            Self::Ellipse { .. } => self.of_revolution().square_integral(x),
        }
    }

    /// Image, load integral and square integral at one radius, at the price of one.
    #[inline]
    pub(crate) fn image_and_integrals(&self, x: f64) -> (f64, f64, f64) {
        if let Self::Parabola { radius } = self {
            let image = x * x / radius;
            return (image, 2.0 / 3.0 * x * image, 0.2 * x * (image * image));
        }
        self.other_image_and_integrals(x)
    }

    fn other_image_and_integrals(&self, x: f64) -> (f64, f64, f64) {
        let of_power = |n: f64| {
            let image = self.image(x);
            (image, load_of_power(n, x, image), square_of_power(n, x, image))
        };
        match self {
            Self::Cone { .. } => of_power(1.0),
            Self::PowerLaw { exponent, .. } => of_power(*exponent),
            Self::RoundedPunch { radius, flat_radius } => {
                rounded::image_and_integrals(x, *radius, *flat_radius)
            }
            _ => (self.image(x), self.load_integral(x), self.square_integral(x)),
        }
    }

    /// Pressure integral J(r, a) = ∫ᵣᵃ g'(x) dx/√(x² − r²) for 0 ≤ r ≤ a; the pressure under the
    /// smooth part of the unworn profile is p = E* J/π. Infinite at the apex of a cone and at the
    /// rim of a blunted sphere's flat.
    pub fn pressure_integral(&self, r: f64, a: f64) -> f64 {
        self.pressure_integral_between(r, (r, a))
    }

    /// The part of [`Self::pressure_integral`] between two radii that are r or more. It is no
    /// difference of two integrals, so that it keeps its digits over a short interval, and on the
    /// axis.
    pub(crate) fn pressure_integral_between(&self, r: f64, (from, to): (f64, f64)) -> f64 {
        if from >= to {
            return 0.0;
        }
        let ends = || {
            let (near, far) = (leg(from, r), leg(to, r));
            // the difference of both, without loss of digits
            (near, far, (to - from) * ((to + from) / (near + far)))
        };
        // ∫ dx/√(x² − r²) = ln (x + √(x² − r²))
        let logarithm = || {
            let (near, _, rise) = ends();
            ((to - from + rise) / (from + near)).ln_1p()
        };
        match self {
            Self::Parabola { radius } => 2.0 / radius * ends().2,
            Self::Cone { slope } => cone_slope(*slope) * logarithm(),
            Self::PowerLaw { exponent: n, .. } => {
                let end = logarithm();
                // from the axis, and from so near to it that the quotient is lost
                if end.is_infinite() {
                    return if *n > 1.0 { n / (n - 1.0) * self.image(to) / to } else { f64::INFINITY };
                }
                let start = from + ends().0;
                let integral = quadrature::of_slow(0.0, end, |u| {
                    let sum = start * u.exp();
                    (0.5 * (sum + r * (r / sum)) / to).powf(n - 1.0)
                });
                self.image_slope(to) * integral
            }
            Self::BluntedSphere { flat_radius: b, .. } | Self::RoundedPunch { flat_radius: b, .. } => {
                let (inner, from) = (r.max(*b), from.max(*b));
                if from >= to {
                    return 0.0;
                }
                if r == *b && from == *b && matches!(self, Self::BluntedSphere { .. }) {
                    return f64::INFINITY;
                }
                // x² = inner² + (δ sinh u)² with δ² = |r² − b²|: both square roots of the integrand
                // become smooth
                let delta = leg(r.max(*b), r.min(*b)).max(1e-12 * b);
                let [start, end] = [from, to].map(|x| (leg(x, inner) / delta).asinh());
                quadrature::of_slow(start, end, |u| {
                    let x = inner.hypot(delta * u.sinh());
                    if x > *b { self.image_slope(x) * leg(x, *b) / x } else { self.rim_limit() }
                })
            }
            Self::FlatPunch { .. } => 0.0,
            Self::Table(table) => table.pressure_integral(r, (from, to)),
            Self::Ellipse { .. } => self.of_revolution().pressure_integral_between(r, (from, to)),
        }
    }

    /// Limit of g'(x) √(x² − b²)/x as x falls to the rim b of the flat.
    fn rim_limit(&self) -> f64 {
        match self {
            Self::BluntedSphere { radius, flat_radius } => flat_radius / radius,
            _ => 0.0,
        }
    }

    /// Contact radius at which the image of a smooth unworn profile reaches the indentation depth
    /// `depth`, m, or `None` where only iteration finds it.
    #[inline]
    pub(crate) fn radius_at_depth(&self, depth: f64) -> Option<f64> {
        if let Self::Parabola { radius } = self {
            return Some((radius * depth).sqrt());
        }
        self.radius_of_other_at_depth(depth)
    }

    fn radius_of_other_at_depth(&self, depth: f64) -> Option<f64> {
        match self {
            Self::Cone { slope } => Some(depth / cone_slope(*slope)),
            Self::PowerLaw { exponent, coefficient } => {
                Some((depth / (power_factor(*exponent) * coefficient)).powf(1.0 / exponent))
            }
            Self::BluntedSphere { radius, flat_radius: b } => {
                // x²(x² − b²) = (R d)²
                let half = b * b / 2.0;
                Some((half + half.hypot(radius * depth)).sqrt())
            }
            Self::RoundedPunch { radius, flat_radius } => {
                Some(rounded::radius_at_depth(depth, *radius, *flat_radius))
            }
            Self::Table(table) => table.radius_at_depth(depth),
            _ => None,
        }
    }

    /// Contact radius at which the load integral of a smooth unworn profile is `load`, m, or
    /// `None`.
    pub(crate) fn radius_at_load(&self, load: f64) -> Option<f64> {
        match self {
            Self::Parabola { radius } => Some((1.5 * radius * load).cbrt()),
            Self::Cone { slope } => Some((load / (0.5 * cone_slope(*slope))).sqrt()),
            Self::PowerLaw { exponent: n, coefficient } => {
                Some((load * (n + 1.0) / (n * power_factor(*n) * coefficient)).powf(1.0 / (n + 1.0)))
            }
            Self::BluntedSphere { radius, flat_radius: b } => {
                // 2v³ + 3b²v = 3Rφ for the leg v of x and b
                let third = (1.5 * SQRT_2 * radius * load / (b * b * b)).asinh() / 3.0;
                Some(b.hypot(SQRT_2 * b * third.sinh()))
            }
            Self::RoundedPunch { radius, flat_radius } => {
                Some(rounded::radius_at_load(load, *radius, *flat_radius))
            }
            Self::Table(table) => table.radius_at_load(load),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests;
