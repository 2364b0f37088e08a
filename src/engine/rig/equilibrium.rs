//! The place of a body that balances its drive, found over trial walks by Broyden's method.

use super::ROUNDING;
use crate::engine::FrettingContact;
use crate::engine::history::End;
use crate::friction::{Row, norm};
use crate::surface::Contact;
use nalgebra::{Matrix2, Vector2};
use std::mem::replace;

/// Most walks for one equilibrium. A few are usual; a bisection in their place would take 52.
const MOST_WALKS: u32 = 100;

/// What the matrix takes to a vector; `None` where it is singular.
pub(super) fn solved(of: &Matrix2<f64>, right: Vector2<f64>) -> Option<Vector2<f64>> {
    let adjugate = Matrix2::new(of.m22, -of.m12, -of.m21, of.m11);
    let solution = adjugate * right / of.determinant();
    solution.iter().all(|part| part.is_finite()).then_some(solution)
}

/// A straight way of the body that has been tried.
pub(super) struct Trial {
    pub(super) place: Vector2<f64>,
    pub(super) end: End,
    /// How far the drive has to go on, m; 0 where that is rounding.
    pub(super) off: Vector2<f64>,
    /// Whether it is the last one that has been tried, whose slip is kept.
    pub(super) is_last: bool,
}

/// How the body goes on: S d**U** = d**D** − **p** dd.
#[derive(Debug, Clone, Copy)]
pub(super) struct Going {
    /// S = 1 + K/k_rig with the contact's stiffness K.
    pub(super) slope: Matrix2<f64>,
    /// **p** = ∂**T**/∂d/k_rig.
    by_depth: Vector2<f64>,
}

impl Going {
    pub(super) fn with(&self, drive: Vector2<f64>, depth: f64) -> Vector2<f64> {
        solved(&self.slope, drive - depth * self.by_depth).unwrap_or(drive)
    }
}

impl FrettingContact {
    /// How far a place of the drive is ahead of where it stands, m; 0 where that is rounding.
    pub(in crate::engine) fn ahead_of_drive(&self, drive: Vector2<f64>, to: &Contact) -> Vector2<f64> {
        let ahead = drive - self.drive_place();
        if norm(ahead) < self.rounding_of((drive, self.state.place), to) { Vector2::zeros() } else { ahead }
    }

    /// What counts as none beside the places of drive and body and the stretch of the rig, m.
    pub(super) fn rounding_of(&self, (drive, place): (Vector2<f64>, Vector2<f64>), to: &Contact) -> f64 {
        let limit = self.model.constants.friction_coefficient * to.load * self.force_scale();
        ROUNDING * (norm(drive) + norm(place) + self.model.compliance * limit)
    }

    /// How the body goes on from where it stands, while the drive goes ahead and the depth changes.
    pub(super) fn going_from(&self, ahead: Vector2<f64>, deeper: f64) -> Going {
        let going =
            |ahead| self.going_in((self.state.place, &self.state.row, &self.state.contact), ahead, deeper);
        // which springs slip under a load that changes depends on the way of the body
        let first = going(ahead);
        if deeper == 0.0 { first } else { going(first.with(ahead, deeper)) }
    }

    pub(super) fn going_in(
        &self,
        (place, row, contact): (Vector2<f64>, &Row, &Contact),
        way: Vector2<f64>,
        deeper: f64,
    ) -> Going {
        let (stiffness, by_depth) = match row {
            Row::Plane(row) => {
                let tangent = self.standing_at(place, row, contact).tangent_ahead(way, deeper);
                (tangent.stiffness, tangent.by_depth)
            }
            Row::Line(springs) => {
                let bound_slope = self.model.bound_slope;
                let (inner, side) = springs.slip_zone(contact, bound_slope, place.x);
                // a zone on the side that the motion leaves comes off its bound
                let stick = if side * way.x > bound_slope * deeper { inner } else { contact.radius };
                let by_depth = bound_slope * side * (contact.radius - stick);
                // along y it does not move
                (Matrix2::from_diagonal_element(stick), Vector2::new(by_depth, 0.0))
            }
        };
        let compliance = self.compliance_of_row();
        Going { slope: Matrix2::identity() + compliance * stiffness, by_depth: compliance * by_depth }
    }

    /// Tries a straight way to another load and place.
    pub(super) fn try_drive(&mut self, (to, drive): (Contact, Vector2<f64>), place: Vector2<f64>) -> Trial {
        // nothing holds a body that has parted from the other
        let place = if to.is_open() { drive } else { place };
        let end = self.try_walk(to, place);
        self.state.counters.spring_walks += 1;
        let force = end.row.deflection_integral(self.model.axes.for_springs(place));
        let off = drive - place - self.compliance_of_row() * force;
        let off = if norm(off) <= self.rounding_of((drive, place), &to) { Vector2::zeros() } else { off };
        Trial { place, end, off, is_last: true }
    }

    /// Improves a trial, by Broyden's method from a slope, until the drive is within a distance (m)
    /// of the balance.
    pub(super) fn balance(
        &mut self,
        trial: &mut Trial,
        slope: &mut Matrix2<f64>,
        (to, drive): (Contact, Vector2<f64>),
        within: f64,
    ) {
        let rounding = 4.0 * f64::EPSILON * (norm(trial.place) + norm(self.state.place));
        let mut walks = 0;
        while norm(trial.off) > within && walks < MOST_WALKS {
            let Some(step) = solved(slope, trial.off) else { break };
            let mut share = 1.0;
            let next = loop {
                let next = self.try_drive((to, drive), trial.place + share * step);
                walks += 1;
                if norm(next.off) < norm(trial.off) {
                    break Some(next);
                }
                self.memory.get().row = next.end.row;
                share *= 0.5;
                let far = share * norm(step) > rounding && walks < MOST_WALKS;
                if !far {
                    break None;
                }
            };
            let Some(next) = next else {
                trial.is_last = false;
                break;
            };
            *slope = if share < 1.0 {
                self.going_in((next.place, &next.end.row, &to), drive - self.drive_place(), 0.0).slope
            } else {
                secant(*slope, next.place - trial.place, trial.off - next.off)
            };
            self.memory.get().row = replace(trial, next).end.row;
        }
    }

    /// Displacement of the rig over the integral of the springs' deflection, 1/m.
    fn compliance_of_row(&self) -> f64 {
        self.model.compliance * 2.0 * self.model.constants.tangential_modulus
    }
}

/// Broyden's update: the matrix next to the given one that takes a way to its change.
fn secant(matrix: Matrix2<f64>, way: Vector2<f64>, change: Vector2<f64>) -> Matrix2<f64> {
    let square = way.dot(&way);
    let missing = change - matrix * way;
    if square == 0.0 {
        return matrix;
    }
    matrix + missing * way.transpose() / square
}
