//! The load integral of the body, from its image at the nodes of the mesh.
//!
//! On a disc the image h of the wear is linear in x² between the nodes, and ∫ h dx has the error of
//! that. Where a body has worn far, its image g and that of its wear nearly cancel. With the exact
//! ∫ g dx the error of ∫ h dx would not cancel, and the overlap d − g − h would be wrong by as
//! much, since it has to carry the load. So ∫ g dx is taken from the nodes, too. Then the load is
//! the integral of the overlap, and no cycle works more than friction along its path. On an
//! annulus, where the image is a parabola in each cell, it makes no difference.

use super::Patch;
use crate::surface::Region;
use crate::transform::dot;

/// By how much ∫ g dx of the body from the nodes exceeds the exact one, near one contact radius.
#[derive(Debug, Clone, Copy)]
pub(super) struct Excess {
    /// Square of that radius, m².
    radius_squared: f64,
    /// m².
    value: f64,
    /// Slope in the square of the radius.
    slope: f64,
}

impl Patch {
    /// Load integral a g(a) − ∫ g dx of the body, m², and its slope in the square of the radius.
    pub(super) fn body_load(&self, radius_squared: f64, excess: Option<Excess>) -> (f64, f64) {
        let a = radius_squared.sqrt();
        let (load, slope) = (self.body.load(a), 0.5 * self.body.image_slope(a));
        excess.map_or((load, slope), |excess| {
            let more = excess.value + excess.slope * (radius_squared - excess.radius_squared);
            (load - more, slope - excess.slope)
        })
    }

    /// The excess near the square of a radius, m²; `None` where the exact integral serves.
    pub(super) fn excess(&self, radius_squared: f64) -> Option<Excess> {
        if !self.is_force() || self.mesh.region == Region::Annulus {
            return None;
        }
        let a = radius_squared.sqrt();
        let radii = self.radii(radius_squared);
        let images = self.body.images(&radii);
        let steepness: Vec<f64> = radii.iter().map(|x| x * self.body.image_slope(*x)).collect();
        let edge = images[self.cells()];
        let (width, growth) = (a * dot(&self.mesh.width, &images), a * dot(&self.mesh.width, &steepness));
        // all radii are in proportion to a
        let slope = (width + growth - a * edge) / (2.0 * radius_squared);
        Some(Excess { radius_squared, value: width - (a * edge - self.body.load(a)), slope })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parameters::NormalControl;
    use crate::profile::Profile;
    use crate::surface::Surface;
    use crate::wear::Constants;
    use crate::wear::mesh::UnitMesh;
    use crate::wear::patch::{Frozen, Motion, Outside, Sliding};

    const SQUARE: f64 = 4e-8;

    fn disc(profile: Profile, cells: usize) -> Patch {
        let constants = Constants {
            normal_modulus: 115e9,
            tangential_modulus: 95e9,
            friction_coefficient: 0.6,
            wear_per_work: 1e-13,
            force_control: true,
        };
        let motion =
            Motion { control: NormalControl::Force, value: 1e-9, sliding: Sliding::Onward, rig: None };
        let places = (0.0, Frozen::default(), Outside::default());
        let mesh = UnitMesh::shared(Region::Disc, cells);
        Patch::new(Surface::new(profile), mesh, places, motion, false, &constants)
    }

    /// Lines in x² are exact for a ball. Of x⁴ they miss a share 1/n² of the integral, and of a
    /// cone log(n)/n².
    #[test]
    fn the_excess_is_that_of_lines_and_its_slope_is_its_own() {
        let share = |profile: &Profile, cells: usize| {
            let patch = disc(profile.clone(), cells);
            let [excess, inner, outer] = [1.0, 1.0 - 1e-4, 1.0 + 1e-4]
                .map(|share| patch.excess(share * SQUARE).expect("a force on a disc"));
            let slope = (outer.value - inner.value) / (2e-4 * SQUARE);
            let width = SQUARE.sqrt() * profile.image(SQUARE.sqrt());
            let rounding = 1e-10 * width / SQUARE;
            assert!((excess.slope - slope).abs() < 1e-6 * slope.abs() + rounding, "{profile:?}");
            excess.value / width
        };
        assert!(share(&Profile::Parabola { radius: 0.01 }, 32).abs() < 1e-13);
        let bodies = [Profile::Cone { slope: 0.02 }, Profile::PowerLaw { exponent: 4.0, coefficient: 1e9 }];
        for (profile, sign) in bodies.iter().zip([-1.0, 1.0]) {
            let (coarse, fine) = (sign * share(profile, 32), sign * share(profile, 64));
            assert!(fine > 1e-6 && coarse < 1e-2, "{profile:?}: {coarse:e} {fine:e}");
            let order = (coarse / fine).log2();
            assert!((1.7..2.1).contains(&order), "{profile:?}: {order}, {coarse:e} {fine:e}");
        }
    }
}
