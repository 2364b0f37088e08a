//! What can be read from a contact that moves in both tangential directions.

use crate::engine::FrettingContact;
use crate::friction::{PlanarRow, Standing};
use crate::range::LEAST_RISE;
use crate::surface::Contact;
use crate::transform;
use nalgebra::Vector2;
use std::f64::consts::PI;

/// Motion in both tangential directions.
impl FrettingContact {
    /// Tangential displacement of the body along y, m.
    pub fn displacement_y(&self) -> f64 {
        self.state.displacement_y
    }

    /// Tangential force along y that the moving body exerts on the substrate, N. With that along x
    /// it has at most the length μF_N.
    pub fn tangential_force_y(&self) -> f64 {
        self.force_in_plane().map_or(0.0, |force| force.y)
    }

    /// Tangential traction along y at radius r, Pa.
    pub fn shear_traction_y_at(&self, r: f64) -> f64 {
        self.traction_in_plane(r).map_or(0.0, |traction| traction.y)
    }

    /// Both components of the force, N, where the body has moved along y.
    #[inline]
    pub(in crate::engine) fn force_in_plane(&self) -> Option<Vector2<f64>> {
        self.state.planar.as_deref().map(|planar| self.force_of(&planar.row))
    }

    fn force_of(&self, row: &PlanarRow) -> Vector2<f64> {
        let integral = row.deflection_integral(self.model.axes.for_springs(self.place()));
        let force = 2.0 * self.model.constants.tangential_modulus * integral;
        let limit = self.friction_limit();
        let size = force.x.hypot(force.y);
        // of a size that is rounding, too
        if size > limit { force / size * limit } else { force }
    }

    /// The row where it stands.
    pub(in crate::engine) fn standing(&self) -> Option<Standing<'_>> {
        let planar = self.state.planar.as_ref()?;
        Some(self.standing_at(self.place(), &planar.row, &self.state.contact))
    }

    /// A row in another contact and place.
    pub(super) fn standing_at<'a>(
        &'a self,
        place: Vector2<f64>,
        row: &'a PlanarRow,
        contact: &'a Contact,
    ) -> Standing<'a> {
        Standing {
            row,
            surface: &self.surface,
            contact,
            bound_slope: self.model.bound_slope,
            stiffness_ratio: self.model.axes.stiffness_ratio,
            displacement: self.model.axes.for_springs(place),
        }
    }

    /// Direction of the last movement, a unit vector.
    pub(in crate::engine) fn direction_in_plane(&self) -> Vector2<f64> {
        self.state.planar.as_ref().map_or(Vector2::new(1.0, 0.0), |planar| planar.direction)
    }

    /// ∂T/∂U for going on in the direction of the last movement, along it, N/m.
    pub(in crate::engine) fn stiffness_in_plane(&self) -> Option<f64> {
        self.state.planar.as_ref()?;
        let ahead = self.direction_in_plane();
        Some(ahead.dot(&(self.tangent().stiffness * ahead)))
    }

    /// Tangential traction at radius r, Pa: τ = −(G*/π) Σ (Δu/Δg) ∫ g' dx/√(x² − r²) by components.
    pub(in crate::engine) fn traction_in_plane(&self, r: f64) -> Option<Vector2<f64>> {
        let knots = self.state.planar.as_ref()?.row.knots();
        let (a, r) = (self.state.contact.radius, self.model.axes.inner(r));
        if r >= a {
            return Some(Vector2::zeros());
        }
        let slopes = self.slopes(a);
        let r = self.off_the_apex(&slopes, r);
        let mut sum = Vector2::zeros();
        let first = knots.partition_point(|knot| knot.place.x <= r);
        let mut inner_integral = slopes.integral(r, knots.get(first.max(1) - 1)?.place.x.max(r));
        for pair in knots.get(first.max(1) - 1..).unwrap_or_default().windows(2) {
            let rise = pair[1].place.image - pair[0].place.image;
            let integral = slopes.integral(r, pair[1].place.x);
            if rise > LEAST_RISE {
                sum += (pair[1].origin - pair[0].origin) / rise * (integral - inner_integral);
            }
            inner_integral = integral;
        }
        if let Some(edge) = knots.last()
            && a >= self.surface.profile().outer_radius()
        {
            sum += (self.model.axes.for_springs(self.place()) - edge.origin) / transform::leg(a, r);
        }
        Some(sum.map(|part| self.model.axes.stress(self.model.constants.tangential_modulus / PI * part)))
    }

    /// Elastic energy of the springs, J.
    pub(in crate::engine) fn stored_energy(&self) -> f64 {
        let integral = match &self.state.planar {
            Some(planar) => {
                let place = self.model.axes.for_springs(self.place());
                planar.row.energy_integral(place, self.model.axes.stiffness_ratio)
            }
            None => self.state.springs.energy_integral(self.state.displacement),
        };
        self.model.constants.tangential_modulus * integral
    }
}
