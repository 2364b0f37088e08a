//! Derivatives for masters, of a contact that moves in both tangential directions.
//!
//! Springs that stick go along with the body. Those at their bound b along **n** = u/b that the
//! present direction pulls on (**n**·**t** > 0) slip along it and turn: ∂u/∂U = 1 − **n n**, ∂u/∂d
//! = m **n**, and friction takes b (**n**·dU − m dd).

use crate::engine::{FrettingContact, Gradient};
use crate::friction::Standing;
use nalgebra::Vector2;

/// Share of full slip, and of the load, over which the stiffness is differenced.
const STEP: f64 = 1e-4;

/// Derivatives where there is motion along y.
impl FrettingContact {
    /// Gradient from derivatives with respect to depth and displacement.
    fn gradient_in_plane(&self, by_depth: f64, by_place: Vector2<f64>) -> Gradient {
        let [displacement, displacement_y] = by_place.into();
        let normal = by_depth * self.depth_per_normal();
        let gradient = Gradient { normal, displacement, displacement_y, ..Gradient::default() };
        self.behind_the_rig_in_plane(gradient).times(1.0)
    }

    /// ∂T_y/∂U_y while nothing slips along y, N/m.
    fn sticking_stiffness_y(&self) -> f64 {
        2.0 * self.model.constants.tangential_modulus
            * self.model.axes.stiffness_ratio
            * self.state.contact.radius
    }

    /// Of [`Self::tangential_force_y`].
    pub fn tangential_force_y_gradient(&self) -> Gradient {
        if let Some(gradient) = self.force_gradient_in_plane(1) {
            return gradient;
        }
        let stiffness = self.sticking_stiffness_y();
        Gradient {
            displacement_y: stiffness / (1.0 + self.model.compliance * stiffness),
            ..Gradient::default()
        }
    }

    /// Of [`Self::displacement_y`].
    pub fn displacement_y_gradient(&self) -> Gradient {
        if self.state.planar.is_some() {
            return self.gradient_in_plane(0.0, Vector2::new(0.0, 1.0));
        }
        let stiffness = self.sticking_stiffness_y();
        Gradient { displacement_y: 1.0 / (1.0 + self.model.compliance * stiffness), ..Gradient::default() }
    }

    /// Of the displacement along x.
    pub(in crate::engine) fn displacement_gradient_in_plane(&self) -> Option<Gradient> {
        self.state.planar.is_some().then(|| self.gradient_in_plane(0.0, Vector2::new(1.0, 0.0)))
    }

    /// Of one component of the force.
    pub(in crate::engine) fn force_gradient_in_plane(&self, component: usize) -> Option<Gradient> {
        let tangent = self.tangent_in_plane()?;
        Some(
            self.gradient_in_plane(tangent.by_depth[component], tangent.stiffness.row(component).transpose()),
        )
    }

    pub(in crate::engine) fn work_gradient_in_plane(&self) -> Option<Gradient> {
        let tangent = self.tangent_in_plane()?;
        Some(self.gradient_in_plane(tangent.work_by_depth, tangent.work))
    }

    /// Of the radius at which the springs that stick reach their bound: with r = b − |u| and its
    /// slope r' there, dc = (K **n**·dU − m dd)/r'.
    pub(in crate::engine) fn stick_gradient_in_plane(&self) -> Option<Gradient> {
        let standing = self.standing()?;
        let Some((fall, pull)) = standing.front_slope(self.direction_in_plane()) else {
            return Some(Gradient::default());
        };
        let per_room = 1.0 / (fall * self.surface.image_slope(standing.stick_radius() * (1.0 - 1e-9)));
        let gradient = self.gradient_in_plane(-self.model.bound_slope * per_room, pull * per_room);
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
            let standing = Standing {
                row: &row,
                surface: &self.surface,
                contact: &to,
                bound_slope: self.model.bound_slope,
                stiffness_ratio: self.model.axes.stiffness_ratio,
                displacement: self.model.axes.for_springs(end),
            };
            let along = ahead.dot(&(standing.tangent(ahead).stiffness * ahead));
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
        Some(self.behind_the_rig_in_plane(gradient).times(1.0))
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
        Some(self.gradient_in_plane(by_depth, by_place))
    }
}
