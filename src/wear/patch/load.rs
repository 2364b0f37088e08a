//! The load as the integral of the overlap of body and counterface at the nodes of the mesh.
//!
//! The image h of the wear is known at the nodes alone, and ∫ h dx has the error of what is
//! interpolated between them. Where a body has worn far, its image g and that of its wear nearly
//! cancel. With the exact ∫ g dx the error of ∫ h dx would not cancel, and the overlap d − g − h
//! would be wrong by as much, since it has to carry the load. So all three parts of it are summed
//! over the nodes, with the weights of the work. In gross slip no cycle then works more than
//! friction along its path; where only a small core next to the axis sticks, it carries the right
//! load.

use super::Patch;

/// By how much the sums over the nodes exceed what is known in closed form, near one contact
/// radius.
#[derive(Debug, Clone, Copy)]
pub(super) struct Excess {
    /// Square of that radius, m².
    radius_squared: f64,
    /// ∫ g dx of the body, m², and its slope in the square of the radius.
    image: (f64, f64),
    /// ∫ dx, m, and its slope.
    length: (f64, f64),
}

impl Excess {
    fn at(&self, (value, slope): (f64, f64), radius_squared: f64) -> (f64, f64) {
        (value + slope * (radius_squared - self.radius_squared), slope)
    }
}

impl Patch {
    /// Contact radius as the nodes have it, m, and its slope in the square of the radius.
    pub(super) fn length(&self, radius_squared: f64, excess: Option<Excess>) -> (f64, f64) {
        let a = radius_squared.sqrt();
        let (more, slope) = excess.map_or((0.0, 0.0), |excess| excess.at(excess.length, radius_squared));
        (a + more, 0.5 / a + slope)
    }

    /// Load integral ∫ (g(a) − g) dx of the body, m², and its slope in the square of the radius.
    pub(super) fn body_load(&self, radius_squared: f64, excess: Option<Excess>) -> (f64, f64) {
        let a = radius_squared.sqrt();
        let (edge, steepness) = (self.body.image(a), 0.5 * self.body.image_slope(a) / a);
        let exact = (self.body.load(a), a * steepness);
        excess.map_or(exact, |excess| {
            let (image, image_slope) = excess.at(excess.image, radius_squared);
            let (length, length_slope) = excess.at(excess.length, radius_squared);
            (
                exact.0 + length * edge - image,
                exact.1 + length * steepness + length_slope * edge - image_slope,
            )
        })
    }

    /// The excess near the square of a radius, m².
    pub(super) fn excess(&self, radius_squared: f64) -> Excess {
        let (a, c, span) = (radius_squared.sqrt(), self.inner_radius, self.span(radius_squared));
        let radii = self.radii(radius_squared);
        let (scales, images) = (self.scales(span, &radii), self.body.images(&radii));
        let integral = |x: f64, g: f64| x * g - self.body.load(x);
        let (inner, outer) = (integral(c, images[0]), integral(a, images[self.cells()]));
        let mut length = (c - a, -0.5 / a);
        let mut image = (inner - outer, -0.5 * images[self.cells()] / a);
        for ((x, g), (width, scale)) in radii.iter().zip(&images).zip(self.mesh.width.iter().zip(&scales)) {
            let weight = span.sqrt() * width * scale;
            // x² − c² grows in proportion to L
            let moving = if *x > c { 1.0 - (c / x).powi(2) } else { 0.0 };
            let growing = if c > 0.0 { 2.0 - moving } else { 1.0 };
            let bend = if moving > 0.0 { moving * x * self.body.image_slope(*x) } else { 0.0 };
            length.0 += weight;
            length.1 += 0.5 * weight / span * growing;
            image.0 += weight * g;
            image.1 += 0.5 * weight / span * (growing * g + bend);
        }
        Excess { radius_squared, image, length }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parameters::NormalControl;
    use crate::profile::Profile;
    use crate::surface::{Region, Surface};
    use crate::wear::Constants;
    use crate::wear::mesh::UnitMesh;
    use crate::wear::patch::{Frozen, Motion, Outside, Sliding};

    const SQUARE: f64 = 4e-8;

    fn patch(profile: Profile, cells: usize, inner_radius: f64) -> Patch {
        let constants = Constants {
            normal_modulus: 115e9,
            tangential_modulus: 95e9,
            friction_coefficient: 0.6,
            wear_per_work: 1e-13,
            force_control: true,
        };
        let motion = Motion {
            control: NormalControl::Force,
            value: 1e-9,
            sliding: Sliding::Onward,
            mixture: None,
            rig: None,
        };
        let region = if inner_radius > 0.0 { Region::Annulus } else { Region::Disc };
        let places = (inner_radius, Frozen::default(), Outside::default());
        let mesh = UnitMesh::shared(region, false, cells);
        Patch::new(Surface::new(profile), mesh, places, motion, false, &constants)
    }

    /// Load integral of the body at nodes, over a g(a), less the exact one; its slope is checked.
    fn off(profile: &Profile, cells: usize, inner_radius: f64) -> f64 {
        let patch = patch(profile.clone(), cells, inner_radius);
        let loads = |share: f64| {
            let square = share * SQUARE;
            let (load, exact) =
                (patch.body_load(square, Some(patch.excess(square))), patch.body_load(square, None));
            (load.0 - exact.0, load.1 - exact.1)
        };
        let [(here, slope), (inner, _), (outer, _)] = [1.0, 1.0 - 1e-4, 1.0 + 1e-4].map(loads);
        let whole = SQUARE.sqrt() * profile.image(SQUARE.sqrt());
        let differences = (outer - inner) / (2e-4 * SQUARE);
        let allowed = 1e-9 * whole / SQUARE;
        assert!(
            (slope - differences).abs() < allowed + 1e-6 * slope.abs(),
            "{profile:?}: {slope:e} {differences:e}"
        );
        here / whole
    }

    /// Lines in x² are exact for a ball. Of x⁴ they miss a share 1/n² of the integral, and of a
    /// cone log(n)/n².
    #[test]
    fn on_a_disc_the_load_of_a_body_is_that_of_lines() {
        assert!(off(&Profile::Parabola { radius: 0.01 }, 32, 0.0).abs() < 1e-13);
        let bodies = [Profile::Cone { slope: 0.02 }, Profile::PowerLaw { exponent: 4.0, coefficient: 1e9 }];
        for (profile, sign) in bodies.iter().zip([1.0, -1.0]) {
            let (coarse, fine) = (sign * off(profile, 32, 0.0), sign * off(profile, 64, 0.0));
            assert!(fine > 1e-6 && coarse < 1e-2, "{profile:?}: {coarse:e} {fine:e}");
            let order = f64::log2(coarse / fine);
            assert!((1.7..2.1).contains(&order), "{profile:?}: {order}, {coarse:e} {fine:e}");
        }
    }

    /// On an annulus the trapezoidal rule is nearly exact for an overlap, which ends at zero; also
    /// with a front next to the axis.
    #[test]
    fn on_an_annulus_the_load_of_a_body_is_nearly_exact() {
        for share in [1e-3, 0.02, 0.1, 0.4, 0.9] {
            for profile in [Profile::Parabola { radius: 0.01 }, Profile::Cone { slope: 0.02 }] {
                let error = off(&profile, 36, share * SQUARE.sqrt());
                println!("{profile:?}, c = {share} a: {error:e}");
                assert!(error.abs() < 5e-6, "{profile:?}, c = {share} a: {error:e}");
            }
        }
    }
}
