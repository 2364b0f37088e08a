//! Elastic constants of the two bodies and their combination.
//!
//! Effective moduli (paper, eqs. (4), (5)):
//!
//! 1/E* = (1 − ν₁²)/E₁ + (1 − ν₂²)/E₂, 1/G* = (2 − ν₁)/(4 G₁) + (2 − ν₂)/(4 G₂), with Gᵢ = Eᵢ / (2
//! (1 + νᵢ)).
//!
//! Normal and tangential contact decouple when the bodies are *elastically similar*, (1 − 2ν₁)/G₁ =
//! (1 − 2ν₂)/G₂ (eq. (6)); [`Pair::similarity_defect`] says by how much a pair misses that.

use crate::error::Error;
use crate::range;
use serde::{Deserialize, Serialize};

/// Young's modulus and Poisson ratio of one body.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Elastic {
    /// Young's modulus E, Pa, in [1e-30, 1e30].
    pub youngs_modulus: f64,
    /// Poisson ratio ν, in (−1, 0.5].
    pub poisson_ratio: f64,
}

impl Elastic {
    /// Steel: E = 210 GPa, ν = 0.3.
    pub const STEEL: Self = Self { youngs_modulus: 210e9, poisson_ratio: 0.3 };

    /// Shear modulus G = E / (2 (1 + ν)), Pa.
    pub fn shear_modulus(&self) -> f64 {
        self.youngs_modulus / (2.0 * (1.0 + self.poisson_ratio))
    }
}

/// Body 1 (the worn one) on body 2.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Pair {
    /// The worn, moving body.
    pub body_1: Elastic,
    /// The counter body, a half-space.
    pub body_2: Elastic,
}

impl Pair {
    /// Effective normal modulus E*, Pa.
    pub fn normal_modulus(&self) -> f64 {
        let compliance = |b: &Elastic| (1.0 - b.poisson_ratio * b.poisson_ratio) / b.youngs_modulus;
        1.0 / (compliance(&self.body_1) + compliance(&self.body_2))
    }

    /// Effective shear modulus G*, Pa.
    pub fn tangential_modulus(&self) -> f64 {
        let compliance = |b: &Elastic| (2.0 - b.poisson_ratio) / (4.0 * b.shear_modulus());
        1.0 / (compliance(&self.body_1) + compliance(&self.body_2))
    }

    /// Relative miss of elastic similarity: |c₁ − c₂| / max(|c₁|, |c₂|) with cᵢ = (1 − 2νᵢ)/Gᵢ; 0
    /// when similar.
    pub fn similarity_defect(&self) -> f64 {
        let c = |b: &Elastic| (1.0 - 2.0 * b.poisson_ratio) / b.shear_modulus();
        let (c1, c2) = (c(&self.body_1), c(&self.body_2));
        let scale = c1.abs().max(c2.abs());
        if scale == 0.0 { 0.0 } else { (c1 - c2).abs() / scale }
    }

    /// Checks both bodies.
    ///
    /// # Errors
    /// [`Error::Parameter`] for the first constant outside its range.
    pub fn validate(&self) -> Result<(), Error> {
        let bodies = [
            (&self.body_1, "youngs_modulus_1", "poisson_ratio_1"),
            (&self.body_2, "youngs_modulus_2", "poisson_ratio_2"),
        ];
        for (body, modulus, ratio) in bodies {
            let requirement = "a Young's modulus lies in 1e-30 to 1e30 Pa";
            range::parameter(modulus, body.youngs_modulus, &range::STRESS, requirement)?;
            if !(body.poisson_ratio > -1.0 && body.poisson_ratio <= 0.5) {
                return Err(Error::Parameter {
                    name: ratio,
                    value: body.poisson_ratio,
                    requirement: "a Poisson ratio lies in (-1, 0.5]",
                });
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steel_on_steel_gives_the_tabulated_moduli() {
        let pair = Pair { body_1: Elastic::STEEL, body_2: Elastic::STEEL };
        assert!((pair.normal_modulus() / 115.385e9 - 1.0).abs() < 5e-6);
        assert!((pair.tangential_modulus() / 95.0226e9 - 1.0).abs() < 5e-7);
        assert_eq!(pair.similarity_defect(), 0.0);
    }

    #[test]
    fn steel_on_aluminium_is_not_similar_and_says_by_how_much() {
        let aluminium = Elastic { youngs_modulus: 70e9, poisson_ratio: 0.33 };
        let pair = Pair { body_1: Elastic::STEEL, body_2: aluminium };
        // c1 = 0.4·2·1.3/210, c2 = 0.34·2·1.33/70 (1/GPa)
        let (c1, c2) = (0.4 * 2.6 / 210.0, 0.34 * 2.66 / 70.0);
        assert!((pair.similarity_defect() - (1.0 - c1 / c2)).abs() < 1e-12);
    }

    #[test]
    fn constants_outside_their_range_are_named() {
        let with =
            |e, nu| Pair { body_1: Elastic { youngs_modulus: e, poisson_ratio: nu }, body_2: Elastic::STEEL };
        for (e, nu, name) in [
            (0.0, 0.3, "youngs_modulus_1"),
            (-1.0, 0.3, "youngs_modulus_1"),
            (f64::NAN, 0.3, "youngs_modulus_1"),
            (f64::INFINITY, 0.3, "youngs_modulus_1"),
            (1e9, -1.0, "poisson_ratio_1"),
            (1e9, 0.51, "poisson_ratio_1"),
            (1e9, f64::NAN, "poisson_ratio_1"),
        ] {
            match with(e, nu).validate() {
                Err(Error::Parameter { name: n, .. }) => assert_eq!(n, name),
                other => panic!("{e}, {nu}: {other:?}"),
            }
        }
        assert!(with(1e9, 0.5).validate().is_ok());
    }
}
