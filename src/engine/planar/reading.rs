//! What can be read from a contact that moves in both tangential directions.

use crate::engine::FrettingContact;
use crate::friction::{PlanarRow, Row, Standing};
use crate::surface::Contact;
use nalgebra::Vector2;

/// Motion in both tangential directions.
impl FrettingContact {
    /// Tangential displacement of the body along y, m.
    pub fn displacement_y(&self) -> f64 {
        self.state.place.y
    }

    /// Tangential force along y that the moving body exerts on the substrate, N. With that along x
    /// it has at most the length μF_N.
    pub fn tangential_force_y(&self) -> f64 {
        self.force().y
    }

    /// Tangential traction along y at radius r, Pa.
    pub fn shear_traction_y_at(&self, r: f64) -> f64 {
        self.traction_at(r).y
    }

    /// The row where it stands.
    pub(in crate::engine) fn standing(&self) -> Option<Standing<'_>> {
        let Row::Plane(row) = &self.state.row else { return None };
        Some(self.standing_at(self.state.place, row, &self.state.contact))
    }

    /// A row in another contact and place.
    pub(in crate::engine) fn standing_at<'a>(
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
}
