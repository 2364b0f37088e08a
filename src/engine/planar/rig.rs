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

use crate::engine::history::MOST_PIECES;
use crate::engine::rig::MOST_WALKS;
use crate::engine::{FrettingContact, Gradient};
use crate::error::Error;
use crate::friction::Row;
use crate::surface::Contact;
use nalgebra::{Matrix2, Vector2};
use std::mem::take;

/// How far from the solution of an iteration, an equilibrium or a coefficient, counts as none,
/// relative to the numbers that are compared.
pub(in crate::engine) const BALANCED: f64 = 1e-13;

/// What the matrix takes to a vector; `None` where it is singular.
fn solved(of: &Matrix2<f64>, right: Vector2<f64>) -> Option<Vector2<f64>> {
    let adjugate = Matrix2::new(of.m22, -of.m12, -of.m21, of.m11);
    let solution = adjugate * right / of.determinant();
    solution.iter().all(|part| part.is_finite()).then_some(solution)
}

fn size(vector: Vector2<f64>) -> f64 {
    vector.x.hypot(vector.y)
}

/// Distance of a point from the line through two others.
fn distance(point: Vector2<f64>, (from, to): (Vector2<f64>, Vector2<f64>)) -> f64 {
    let (way, aside) = (to - from, point - from);
    let length = size(way);
    if length > 0.0 { way.perp(&aside).abs() / length } else { size(aside) }
}

/// Where the body is in balance with the drive, or a guess of it.
#[derive(Debug, Clone, Copy)]
struct Equilibrium {
    place: Vector2<f64>,
    /// By how much the drive goes on with the body, where it is known.
    slope: Option<Matrix2<f64>>,
}

impl Equilibrium {
    fn near(place: Vector2<f64>) -> Self {
        Self { place, slope: None }
    }
}

impl FrettingContact {
    /// Displacement of the drive along y: U_y + T_y/k_rig, m. It is [`Self::displacement_y`] where
    /// the rig is rigid.
    #[inline]
    pub fn drive_displacement_y(&self) -> f64 {
        if self.model.compliance == 0.0 {
            return self.state.place.y;
        }
        self.state.place.y + self.model.compliance * self.tangential_force_y()
    }

    /// Where the drive stands, m.
    #[inline]
    pub(in crate::engine) fn drive_place(&self) -> Vector2<f64> {
        Vector2::new(self.drive_displacement(), self.drive_displacement_y())
    }

    /// Follows one piece of the drive's line.
    pub(in crate::engine) fn follow_drive(&mut self, value: f64, drive: Vector2<f64>) -> Result<(), Error> {
        if self.state.contact.is_open() && value <= self.touch_control() {
            return self.walk(value, drive, 0);
        }
        self.enter_plane()?;
        let found = self.balance(value, drive, Equilibrium::near(self.state.place))?;
        self.follow_to(value, drive, found, MOST_PIECES.ilog2())
    }

    /// The same where it is known how the body comes to a place.
    fn follow_to(
        &mut self,
        value: f64,
        drive: Vector2<f64>,
        found: Equilibrium,
        halvings: u32,
    ) -> Result<(), Error> {
        let (from, here) = (self.drive_place(), self.state.place);
        let halfway = 0.5 * (self.state.contact.control + value);
        let load_stays = value == self.state.contact.control;
        if halvings > 0 && halfway > self.touch_control() && !(load_stays && drive == from) {
            let half = from + 0.5 * (drive - from);
            let near = self.straight_within(value)? + BALANCED * self.scale_of(drive, &self.state.contact);
            let middle = Equilibrium::near(0.5 * (here + found.place));
            let between = self.balance_nearly(halfway, half, middle, 0.1 * near)?;
            let bent = if self.load_changes_much(value) {
                size(between.place - middle.place)
            } else {
                distance(between.place, (here, found.place))
            };
            if bent > near {
                // each half bends by a quarter of it
                let halvings = if bent > 4.0 * near { halvings - 1 } else { 0 };
                let between = self.balance(halfway, half, between)?;
                self.follow_to(halfway, half, between, halvings)?;
                let found = self.balance(value, drive, Equilibrium::near(found.place))?;
                return self.follow_to(value, drive, found, halvings);
            }
        }
        let updates = self.state.counters.profile_updates;
        self.walk(value, found.place, MOST_PIECES.ilog2())?;
        let off = drive - self.drive_place();
        if self.state.counters.profile_updates == updates
            || !self.state.row.is_plane()
            || off.dot(&self.state.direction) <= 0.0
        {
            return Ok(());
        }
        // the wear has changed the force; the body does not go back for that, within the accuracy
        // of an equilibrium, since a reversal would let all springs stick
        let found = self.balance(value, drive, Equilibrium::near(self.state.place))?;
        let goes_on = (found.place - self.state.place).dot(&self.state.direction) > 0.0;
        if goes_on { self.walk(value, found.place, MOST_PIECES.ilog2()) } else { Ok(()) }
    }

    /// Size of the lengths that are compared in an equilibrium, m.
    fn scale_of(&self, drive: Vector2<f64>, to: &Contact) -> f64 {
        let limit = self.model.constants.friction_coefficient * to.load * self.force_scale();
        size(drive) + size(self.state.place) + self.model.compliance * limit
    }

    /// Place of the body that balances the drive after a straight way to it and to another load,
    /// looked for from a first guess.
    fn balance(&mut self, value: f64, drive: Vector2<f64>, guess: Equilibrium) -> Result<Equilibrium, Error> {
        self.balance_nearly(value, drive, guess, 0.0)
    }

    /// The same up to a distance from equilibrium, m, where that is more than rounding.
    fn balance_nearly(
        &mut self,
        value: f64,
        drive: Vector2<f64>,
        guess: Equilibrium,
        distance: f64,
    ) -> Result<Equilibrium, Error> {
        let to =
            if value == self.state.contact.control { self.state.contact } else { self.contact_at(value)? };
        if to.is_open() {
            return Ok(Equilibrium::near(drive));
        }
        let least = distance.max(BALANCED * self.scale_of(drive, &to));
        let mut spare = take(&mut self.memory.get().row);
        let ahead = drive - self.drive_place();
        let Equilibrium { mut place, slope } = guess;
        let mut off = drive - self.drive_after(place, &to, &mut spare);
        let mut slope = slope.unwrap_or_else(|| self.slope_after(place, &to, ahead, &spare));
        let mut walks = 1;
        while size(off) > least && walks < MOST_WALKS {
            let Some(step) = solved(&slope, off) else { break };
            let mut share = 1.0;
            let next = loop {
                let next = place + share * step;
                let left = drive - self.drive_after(next, &to, &mut spare);
                walks += 1;
                if size(left) < size(off) {
                    // the fresh tangent where the trial had to be cut, else by the secant
                    slope = if share < 1.0 {
                        self.slope_after(next, &to, ahead, &spare)
                    } else {
                        secant(slope, next - place, off - left)
                    };
                    off = left;
                    break Some(next);
                }
                if walks >= MOST_WALKS {
                    break None;
                }
                share *= 0.5;
            };
            let Some(next) = next.filter(|next| *next != place) else { break };
            place = next;
        }
        self.state.counters.spring_walks += u64::from(walks);
        self.memory.get().row = spare;
        Ok(Equilibrium { place, slope: Some(slope) })
    }

    /// Where the drive stands after a straight way of the body, **U** + **T**/k_rig, m, and the row
    /// then.
    fn drive_after(&self, place: Vector2<f64>, to: &Contact, row: &mut Row) -> Vector2<f64> {
        let path = self.path_to(*to, place);
        *row = self.state.row.walk(&path, take(row), None).0;
        let force = row.deflection_integral(path.end);
        place + self.compliance_of_row() * force
    }

    /// By how much the drive goes on with the body after that way, where it is `ahead` of the
    /// present: 1 + K/k_rig with the contact's stiffness K.
    fn slope_after(&self, place: Vector2<f64>, to: &Contact, ahead: Vector2<f64>, row: &Row) -> Matrix2<f64> {
        let Row::Plane(row) = row else { return Matrix2::identity() };
        let tangent = self.standing_at(place, row, to).tangent(ahead);
        Matrix2::identity() + self.compliance_of_row() * tangent.stiffness
    }

    /// Displacement of the rig over the integral of the springs' deflection, 1/m.
    fn compliance_of_row(&self) -> f64 {
        self.model.compliance * 2.0 * self.model.constants.tangential_modulus
    }

    /// The derivatives of a quantity by the drive where those by the body are given: d**U** = (1 +
    /// K/k_rig)⁻¹ (d**D** − ∂**T**/∂n dn/k_rig).
    pub(in crate::engine) fn behind_the_rig(&self, of: Gradient) -> Gradient {
        if self.model.compliance == 0.0 {
            return of;
        }
        let tangent = self.tangent_running_in();
        let matrix = Matrix2::identity() + self.model.compliance * tangent.stiffness;
        let right = Vector2::new(of.displacement, of.displacement_y);
        let by_place = solved(&matrix.transpose(), right).unwrap_or_default();
        let by_normal = self.model.compliance * tangent.by_depth * self.depth_per_normal();
        Gradient {
            normal: of.normal - by_place.x * by_normal.x - by_place.y * by_normal.y,
            displacement: by_place.x,
            displacement_y: by_place.y,
            ..of
        }
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
