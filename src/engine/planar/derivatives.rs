//! Derivatives for masters, of a contact that moves in both tangential directions.
//!
//! Springs that stick go along with the body. Those at their bound b along **n** = u/b that the
//! present direction pulls on (**n**·**t** > 0) slip along it and turn: ∂u/∂U = 1 − **n n**, ∂u/∂d
//! = m **n**, and friction takes b (**n**·dU − m dd).

use crate::engine::readout::ASIDE;
use crate::engine::{FrettingContact, Gradient};
use nalgebra::Vector2;

/// Share of full slip, and of the load, over which the stiffness is differenced.
const STEP: f64 = 1e-4;

/// Derivatives where there is motion along y.
impl FrettingContact {
    /// Of the radius at which the springs that stick reach their bound: with r = b − |u| and its
    /// slope r' there, dc = (K **n**·dU − m dd)/r'.
    pub(in crate::engine) fn stick_gradient_in_plane(&self) -> Option<Gradient> {
        let standing = self.standing()?;
        let Some((fall, pull)) = standing.front_slope(self.direction_in_plane()) else {
            return Some(Gradient::default());
        };
        let per_room = 1.0 / (fall * self.surface.image_slope(standing.stick_radius() * (1.0 - ASIDE)));
        let gradient = self.gradient(-self.model.bound_slope * per_room, pull * per_room);
        Some(gradient.times(self.model.axes.size))
    }

    /// By differences ahead, along each direction the way that the motion goes.
    pub(in crate::engine) fn stiffness_gradient_in_plane(&self) -> Option<Gradient> {
        let (place, ahead) = (self.place(), self.direction_in_plane());
        let now = self.stiffness_in_plane()?;
        let planar = self.state.planar.as_ref()?;
        let change = |control: f64, moved: Vector2<f64>, step: f64| {
            let to = if control == self.state.contact.control {
                self.state.contact
            } else {
                self.solve_contact(control).ok()?
            };
            let end = place + moved;
            let path = self.planar_path(to, end);
            let (row, _) = planar.row.walk(&path, super::PlanarRow::default(), None);
            let tangent = self.standing_at(end, &row, &to).tangent(ahead);
            let along = ahead.dot(&(tangent.stiffness * ahead));
            let stiffness = 2.0 * self.model.constants.tangential_modulus * along;
            Some((stiffness - now) / step)
        };
        let length = STEP * self.model.bound_slope * self.state.contact.depth.abs();
        let way = |k: usize| if ahead[k] < 0.0 { -length } else { length };
        let control = self.state.contact.control;
        let step = STEP * control.abs();
        let scale = if self.model.constants.force_control { 1.0 / self.force_scale() } else { 1.0 };
        let gradient = Gradient {
            normal: change(control + step, Vector2::zeros(), step)? * scale,
            displacement: change(control, Vector2::new(way(0), 0.0), way(0))?,
            displacement_y: change(control, Vector2::new(0.0, way(1)), way(1))?,
            ..Gradient::default()
        };
        Some(self.behind_the_rig(gradient))
    }

    /// dw = (k/σ₀) **τ**·d**s** at the deepest point, or before any wear where it is largest in the
    /// present direction.
    pub(in crate::engine) fn wear_depth_gradient_in_plane(&self) -> Option<Gradient> {
        let (standing, ahead) = (self.standing()?, self.direction_in_plane());
        let per_work = if self.state.wear.is_some() { self.model.constants.wear_per_work } else { 0.0 };
        let rates = |r: f64| {
            let traction = self.traction_in_plane(r).unwrap_or_default();
            let [x, y, depth] = standing.surface_slip(r, ahead).map(|slip| {
                let rate = per_work * traction.dot(&slip);
                if rate.is_finite() { rate } else { 0.0 }
            });
            (depth, Vector2::new(x, y))
        };
        let along = |rates: &(f64, Vector2<f64>)| rates.1.dot(&ahead);
        let (by_depth, by_place) = match self.deepest() {
            Some(r) => rates(r),
            None => {
                self.reached_radii().into_iter().map(rates).max_by(|a, b| along(a).total_cmp(&along(b)))?
            }
        };
        Some(self.gradient(by_depth, by_place))
    }
}
