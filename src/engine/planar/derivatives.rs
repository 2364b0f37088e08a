//! Derivatives for masters, of a contact that moves in both tangential directions.
//!
//! Springs that stick go along with the body. Those at their bound b along **n** = u/b slip along
//! it and turn: ∂u/∂U = 1 − **n n**, ∂u/∂d = m **n**, and friction takes b (**n**·dU − m dd). Where
//! the motion relaxes them, the load has fallen so fast that they slip nevertheless.

use crate::engine::readout::ASIDE;
use crate::engine::{FrettingContact, Gradient};
use crate::friction::{PlanarRow, Row};
use nalgebra::Vector2;

/// Share of full slip, and of the load, over which the stiffness is differenced.
const STEP: f64 = 1e-4;

/// By how much of its length a way goes aside: springs deflected up to 84° from the motion go on
/// slipping.
const ASIDE_OF_WAY: f64 = 0.1;

/// Derivatives where there is motion along y.
impl FrettingContact {
    /// Of the radius at which the springs that stick reach their bound: with r = b − |u| and its
    /// slope r' there, dc = (K **n**·dU − m dd)/r'.
    pub(in crate::engine) fn stick_gradient_in_plane(&self) -> Option<Gradient> {
        let standing = self.standing()?;
        let Some((fall, pull)) = standing.front_slope() else {
            return Some(Gradient::default());
        };
        let stick = standing.stick_radius();
        let per_room = 1.0 / (fall * self.surface.image_slope(stick * (1.0 - ASIDE)));
        let (by_depth, by_place) = self.bound_gradient(stick);
        let gradient = self.gradient(-by_depth * per_room, (pull - by_place) * per_room);
        Some(gradient.times(self.model.axes.size))
    }

    /// By differences ahead: straight on, and between two ways that go on aside; straight back
    /// where the slip zone is one that the motion relaxes. A load that rises at rest would let all
    /// springs stick, so that it falls.
    pub(in crate::engine) fn stiffness_gradient_in_plane(&self) -> Option<Gradient> {
        let Row::Plane(row) = &self.state.row else { return None };
        let front = self.standing()?.front_slope();
        let relaxed = front.is_some_and(|(_, pull)| pull.dot(&self.state.direction) < 0.0);
        let place = self.state.place;
        let ahead = if relaxed { -self.state.direction } else { self.state.direction };
        let stiffness = |control: f64, moved: Vector2<f64>| {
            let to = if control == self.state.contact.control {
                self.state.contact
            } else {
                self.solve_contact(control).ok()?
            };
            let end = place + moved;
            let path = self.path_to(to, end);
            let (row, _) = row.walk(&path, PlanarRow::default(), None);
            let tangent = self.standing_at(end, &row, &to).tangent();
            Some(2.0 * self.model.constants.tangential_modulus * ahead.dot(&(tangent.stiffness * ahead)))
        };
        let control = self.state.contact.control;
        let now = stiffness(control, Vector2::zeros())?;
        let fall = STEP * control.abs();
        let by_control = (now - stiffness(control - fall, Vector2::zeros())?) / fall;
        let length = STEP * self.model.bound_slope * self.state.contact.depth.abs();
        let (way, aside) = (length * ahead, ASIDE_OF_WAY * length * Vector2::new(-ahead.y, ahead.x));
        let along = (stiffness(control, way)? - now) / length;
        let across = (stiffness(control, way + aside)? - stiffness(control, way - aside)?)
            / (2.0 * ASIDE_OF_WAY * length);
        let scale = if self.model.constants.force_control { 1.0 / self.force_scale() } else { 1.0 };
        let gradient = Gradient {
            normal: by_control * scale,
            displacement: along * ahead.x - across * ahead.y,
            displacement_y: along * ahead.y + across * ahead.x,
            ..Gradient::default()
        };
        Some(self.behind_the_rig(gradient))
    }

    /// dw = (k/σ₀) **τ**·d**s** at the deepest point, or before any wear where it is largest along
    /// the present direction.
    pub(in crate::engine) fn wear_depth_gradient_in_plane(&self) -> Option<Gradient> {
        let standing = self.standing()?;
        let per_work = if self.state.wear.is_some() { self.model.constants.wear_per_work } else { 0.0 };
        let rates = |r: f64| {
            let traction = self.traction_at(r);
            let [x, y, depth] = standing.surface_slip(r).map(|slip| {
                let rate = per_work * traction.dot(&slip);
                if rate.is_finite() { rate } else { 0.0 }
            });
            (depth, Vector2::new(x, y))
        };
        let along = |rates: &(f64, Vector2<f64>)| rates.1.dot(&self.state.direction).abs();
        let (by_depth, by_place) = match self.deepest() {
            Some(r) => rates(r),
            None => {
                self.reached_radii().into_iter().map(rates).max_by(|a, b| along(a).total_cmp(&along(b)))?
            }
        };
        Some(self.gradient(by_depth, by_place))
    }
}
