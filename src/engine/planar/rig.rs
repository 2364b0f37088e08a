//! A spring in series with a contact that moves in both tangential directions. The spring is as
//! stiff along y as along x.
//!
//! Body and drive carry the same force, k_rig (**D** − **U**) = **T**(**U**), where **T** is that
//! at the end of a straight way of the body. `balance` finds **U** over trial walks by Broyden's
//! method from the contact's own stiffness.
//!
//! Springs that slip let the body give way sideways, so that it goes along a curve while the drive
//! goes straight. A piece of the drive's line is halved until the body, halfway, is near the chord;
//! where all is on one line it is one piece.
//!
//! Nothing is kept: **D** follows from **U** and **T**. What an update of the worn profile changes
//! in **T** is made up for by going on, never back.

use crate::engine::{FrettingContact, Gradient};
use crate::error::Error;
use crate::friction::{PlanarRow, Standing, Vector, difference};
use crate::surface::Contact;
use std::mem::take;

/// How far the body may be from the chord halfway, over the displacement of full slip.
const BENT: f64 = 3e-4;

/// Most halvings of one piece for that sake.
const MOST_HALVINGS: u32 = 8;

/// Most trial walks for one equilibrium; 3 to 8 are usual.
const MOST_WALKS: u32 = 60;

/// How far from equilibrium counts as none, over the lengths that are compared.
const BALANCED: f64 = 1e-13;

/// What of them may be noise in the distance from a chord.
const ROUNDING: f64 = 1e-12;

/// How far from equilibrium counts as none after wear, which changes the force.
const NEARLY: f64 = 1e-9;

/// Most ways that make up for wear in one piece.
const MOST_MORE: u32 = 4;

/// A symmetric or nearly symmetric 2 × 2 matrix.
type Matrix = [Vector; 2];

fn times(matrix: &Matrix, vector: Vector) -> Vector {
    matrix.map(|row| row[0] * vector[0] + row[1] * vector[1])
}

/// What the matrix takes to a vector; `None` where it is singular.
fn solved(matrix: &Matrix, right: Vector) -> Option<Vector> {
    let [[a, b], [c, d]] = *matrix;
    let determinant = a * d - b * c;
    let solution = [(d * right[0] - b * right[1]) / determinant, (a * right[1] - c * right[0]) / determinant];
    solution.iter().all(|part| part.is_finite()).then_some(solution)
}

fn size(vector: Vector) -> f64 {
    vector[0].hypot(vector[1])
}

fn plus(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1]]
}

fn middle(a: Vector, b: Vector) -> Vector {
    [0, 1].map(|k| a[k] + 0.5 * (b[k] - a[k]))
}

/// Distance of a point from the line through two others.
fn distance(point: Vector, (from, to): (Vector, Vector)) -> f64 {
    let (way, aside) = (difference(to, from), difference(point, from));
    let length = size(way);
    if length > 0.0 { (way[0] * aside[1] - way[1] * aside[0]).abs() / length } else { size(aside) }
}

impl FrettingContact {
    /// Displacement of the drive along y: U_y + T_y/k_rig, m. It is [`Self::displacement_y`] where
    /// the rig is rigid.
    pub fn drive_displacement_y(&self) -> f64 {
        if self.model.compliance == 0.0 {
            return self.state.displacement_y;
        }
        self.state.displacement_y + self.model.compliance * self.tangential_force_y()
    }

    /// Where the drive stands, m.
    pub(in crate::engine) fn drive_place(&self) -> Vector {
        [self.drive_displacement(), self.drive_displacement_y()]
    }

    /// Follows one piece of the drive's line.
    pub(super) fn follow_drive(&mut self, value: f64, drive: Vector) -> Result<(), Error> {
        if value <= self.touch_control() {
            // what holds the body holds no force then
            return self.walk_in_plane(value, drive);
        }
        if self.state.planar.is_none() {
            self.enter_plane()?;
        }
        let place = self.balance(value, drive)?;
        self.follow_to(value, (drive, place), MOST_HALVINGS)
    }

    /// The same where the body is known to come to a place.
    fn follow_to(
        &mut self,
        value: f64,
        (drive, place): (Vector, Vector),
        halvings: u32,
    ) -> Result<(), Error> {
        let (from, here) = (self.drive_place(), self.place());
        let halfway = 0.5 * (self.state.contact.control + value);
        if halvings > 0 && halfway > self.touch_control() && drive != from {
            let half = middle(from, drive);
            let between = self.balance(halfway, half)?;
            let near = BENT * self.model.bound_slope * self.state.contact.depth.abs()
                + ROUNDING * self.scale_of(drive, &self.state.contact);
            if distance(between, (here, place)) > near {
                self.follow_to(halfway, (half, between), halvings - 1)?;
                let place = self.balance(value, drive)?;
                return self.follow_to(value, (drive, place), halvings - 1);
            }
        }
        let updates = self.state.counters.profile_updates;
        self.walk_in_plane(value, place)?;
        for _ in 0..MOST_MORE {
            if self.state.counters.profile_updates == updates || self.state.planar.is_none() {
                break;
            }
            let off = difference(drive, self.drive_place());
            let [x, y] = self.direction_in_plane();
            if off[0] * x + off[1] * y <= NEARLY * self.scale_of(drive, &self.state.contact) {
                break;
            }
            let place = self.balance(value, drive)?;
            self.walk_in_plane(value, place)?;
        }
        Ok(())
    }

    /// Size of the lengths that are compared in an equilibrium, m.
    fn scale_of(&self, drive: Vector, to: &Contact) -> f64 {
        let limit = self.model.constants.friction_coefficient * to.load * self.force_scale();
        size(drive) + size(self.place()) + self.model.compliance * limit
    }

    /// Place of the body that balances the drive after a straight way to it and to another load.
    fn balance(&mut self, value: f64, drive: Vector) -> Result<Vector, Error> {
        let to =
            if value == self.state.contact.control { self.state.contact } else { self.contact_at(value)? };
        if to.is_open() {
            return Ok(drive);
        }
        let least = BALANCED * self.scale_of(drive, &to);
        let mut spare = take(&mut self.memory.planar);
        let mut place = self.place();
        let (mut off, mut slope) = self.pull_in_plane((drive, place), &to, &mut spare);
        let mut walks = 1;
        while size(off) > least && walks < MOST_WALKS {
            let Some(step) = solved(&slope, off) else { break };
            let mut share = 1.0;
            let next = loop {
                let next = plus(place, step.map(|part| share * part));
                let (left, fresh) = self.pull_in_plane((drive, next), &to, &mut spare);
                walks += 1;
                if size(left) < size(off) {
                    let moved = difference(next, place);
                    // the fresh tangent where the trial had to be cut, else by the secant
                    slope = if share < 1.0 { fresh } else { secant(slope, moved, difference(off, left)) };
                    off = left;
                    break Some(next);
                }
                if walks >= MOST_WALKS {
                    break None;
                }
                (share, slope) = (0.5 * share, fresh);
            };
            let Some(next) = next.filter(|next| *next != place) else { break };
            place = next;
        }
        self.state.counters.spring_walks += u64::from(walks);
        self.memory.planar = spare;
        Ok(place)
    }

    /// How far the drive is ahead of equilibrium after a straight way of the body, **D** − **U** −
    /// **T**/k_rig, m, and by how much that falls with **U**: 1 + K/k_rig with the contact's
    /// stiffness K.
    fn pull_in_plane(
        &self,
        (drive, place): (Vector, Vector),
        to: &Contact,
        spare: &mut PlanarRow,
    ) -> (Vector, Matrix) {
        let path = self.planar_path(*to, place);
        let (row, _) = self.walked_in_plane(&path, take(spare), None);
        let modulus = self.model.compliance * 2.0 * self.model.constants.tangential_modulus;
        let springs_at = self.model.axes.for_springs(place);
        let force = row.deflection_integral(springs_at);
        let ahead = difference(drive, self.drive_place());
        let standing = Standing {
            row: &row,
            surface: &self.surface,
            contact: to,
            bound_slope: self.model.bound_slope,
            stiffness_ratio: self.model.axes.stiffness_ratio,
            displacement: springs_at,
        };
        let stiffness = standing.tangent(ahead).stiffness;
        let off = [0, 1].map(|k| drive[k] - place[k] - modulus * force[k]);
        *spare = row;
        (off, one_and(modulus, stiffness))
    }

    /// The derivatives of a quantity by the drive where those by the body are given: d**U** = (1 +
    /// K/k_rig)⁻¹ (d**D** − ∂**T**/∂n dn/k_rig).
    pub(super) fn behind_the_rig_in_plane(&self, of: Gradient) -> Gradient {
        let Some(tangent) = self.tangent_in_plane().filter(|_| self.model.compliance > 0.0) else {
            return of;
        };
        let matrix = one_and(self.model.compliance, tangent.stiffness);
        let transposed = [[matrix[0][0], matrix[1][0]], [matrix[0][1], matrix[1][1]]];
        let by_place = solved(&transposed, [of.displacement, of.displacement_y]).unwrap_or_default();
        let by_normal = tangent.by_depth.map(|part| self.model.compliance * part * self.depth_per_normal());
        Gradient {
            normal: of.normal - by_place[0] * by_normal[0] - by_place[1] * by_normal[1],
            displacement: by_place[0],
            displacement_y: by_place[1],
            ..of
        }
    }
}

/// 1 + factor · K.
fn one_and(factor: f64, stiffness: Matrix) -> Matrix {
    let [[xx, xy], [yx, yy]] = stiffness;
    [[1.0 + factor * xx, factor * xy], [factor * yx, 1.0 + factor * yy]]
}

/// Broyden's update: the matrix next to the given one that takes a way to its change.
fn secant(matrix: Matrix, way: Vector, change: Vector) -> Matrix {
    let square = way[0] * way[0] + way[1] * way[1];
    let missing = difference(change, times(&matrix, way));
    if square == 0.0 {
        return matrix;
    }
    [0, 1].map(|i| [0, 1].map(|j| matrix[i][j] + missing[i] * way[j] / square))
}
