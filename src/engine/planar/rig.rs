//! A spring in series with a contact that moves in both tangential directions. The spring is as
//! stiff along y as along x.
//!
//! Body and drive carry the same force, k_rig (**D** − **U**) = **T**(**U**), where **T** is that
//! at the end of a straight way of the body. `balance` finds **U** over trial walks by Broyden's
//! method.
//!
//! Springs that slip let the body give way sideways, so that it goes along a curve while the drive
//! goes straight. The drive's line is divided into pieces in which the body, halfway, is near the
//! chord: with the curvature κ of its path it is off by h²κ/8 in a piece of length h. The curvature
//! follows from the chords of two pieces, in the first one from the tangents at both ends. The
//! tangents serve there only: at the end of a chord the outer springs point along it, so that
//! they turn by more than the path. Between two ends of the line the body need not be nearer to
//! equilibrium than to the chord, since the next piece makes up for it.
//!
//! Nothing is kept: **D** follows from **U** and **T**. What an update of the worn profile changes
//! in **T** is made up for by going on, never back.

use crate::engine::history::{End, MOST_PIECES};
use crate::engine::line::Line;
use crate::engine::rig::MOST_WALKS;
use crate::engine::{FrettingContact, Gradient};
use crate::error::Error;
use crate::friction::Row;
use crate::surface::Contact;
use nalgebra::{Matrix2, Vector2};
use std::mem::replace;

/// How far from the solution of an iteration, an equilibrium or a coefficient, counts as none,
/// relative to the numbers that are compared.
pub(in crate::engine) const BALANCED: f64 = 1e-13;

/// Share of a piece by which a line may be longer than its pieces.
const ROUNDED: f64 = 1e-6;

/// What the matrix takes to a vector; `None` where it is singular.
fn solved(of: &Matrix2<f64>, right: Vector2<f64>) -> Option<Vector2<f64>> {
    let adjugate = Matrix2::new(of.m22, -of.m12, -of.m21, of.m11);
    let solution = adjugate * right / of.determinant();
    solution.iter().all(|part| part.is_finite()).then_some(solution)
}

fn size(vector: Vector2<f64>) -> f64 {
    vector.x.hypot(vector.y)
}

/// A straight way of the body that has been tried.
struct Trial {
    place: Vector2<f64>,
    end: End,
    /// How far the drive has to go on, m.
    off: Vector2<f64>,
    /// Whether it is the last one that has been tried, whose slip is kept.
    is_last: bool,
}

/// The piece before, by which the next one is guessed.
#[derive(Debug, Clone, Copy)]
struct Former {
    /// Way of the body per share of the line.
    rate: Vector2<f64>,
    /// Change of the rate per share of the line.
    curvature: Vector2<f64>,
    piece: f64,
    /// By how much the drive goes on with the body.
    slope: Matrix2<f64>,
}

impl Former {
    fn new(before: Option<Self>, way: Vector2<f64>, piece: f64, slope: Matrix2<f64>) -> Self {
        let rate = way / piece;
        let curvature =
            before.map_or(Vector2::zeros(), |before| 2.0 * (rate - before.rate) / (piece + before.piece));
        Self { rate, curvature, piece, slope }
    }

    /// Way of the body in the next piece.
    fn way_on(&self, piece: f64) -> Vector2<f64> {
        piece * (self.rate + 0.5 * (piece + self.piece) * self.curvature)
    }

    /// How far from the chord a body on a parabola is halfway.
    fn bend(&self, way: Vector2<f64>, piece: f64) -> Vector2<f64> {
        piece * piece / (4.0 * (piece + self.piece)) * (way / piece - self.rate)
    }
}

/// What tells how the path of the body bends.
enum Ahead {
    Former(Former),
    /// Ways of a piece in the directions at its start and its end.
    Tangents([Vector2<f64>; 2]),
}

/// How the body goes on: S d**U** = d**D** − **p** dd.
#[derive(Debug, Clone, Copy)]
struct Going {
    /// S = 1 + K/k_rig with the contact's stiffness K.
    slope: Matrix2<f64>,
    /// **p** = ∂**T**/∂d/k_rig.
    by_depth: Vector2<f64>,
}

impl Going {
    /// As nothing holds the body.
    const FREE: Self = Self { slope: Matrix2::new(1.0, 0.0, 0.0, 1.0), by_depth: Vector2::new(0.0, 0.0) };

    fn with(&self, drive: Vector2<f64>, depth: f64) -> Vector2<f64> {
        solved(&self.slope, drive - depth * self.by_depth).unwrap_or(drive)
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

    /// Follows a line of the drive on which the bodies touch, while friction runs in. No piece
    /// takes more than a given share.
    pub(in crate::engine) fn follow_drive(
        &mut self,
        line: &Line,
        most: f64,
        running_in: Option<(f64, f64)>,
    ) -> Result<(), Error> {
        let least = most / f64::from(MOST_PIECES);
        let (mut done, mut length, mut trials) = (0.0, most, 0);
        let mut former: Option<Former> = None;
        while done < 1.0 {
            // the pieces that are left are even
            let left = ((1.0 - done) / length - ROUNDED).ceil();
            let next = if left > 1.0 { done + (1.0 - done) / left } else { 1.0 };
            let piece = next - done;
            let divisible = piece > least && trials < MOST_PIECES;
            trials += 1;
            let (value, drive) = line.at_share(next);
            self.run_in_along(running_in, line.of_whole(next));
            self.enter_plane()?;
            if self.update_is_due(self.state.place) {
                self.update_before(value)?;
                // the body may have worn free
                self.enter_plane()?;
                former = None;
            }
            let to = self.contact_for(value)?;
            let (here, rounding) = (self.state.place, BALANCED * self.scale_of(drive, &to));
            let near = self.straight_within(value)? + rounding;
            let (mut trial, mut slope, ahead) = match former {
                Some(former) => {
                    let behind =
                        solved(&former.slope, line.at_share(done).1 - self.drive_place()).unwrap_or_default();
                    let trial = self.try_drive((to, drive), here + former.way_on(piece) + behind);
                    (trial, former.slope, Ahead::Former(former))
                }
                None => {
                    let way = piece * (line.to.1 - line.from.1);
                    let (trial, slope, ways) = self.try_tangent((to, drive), value, way);
                    (trial, slope, Ahead::Tangents(ways))
                }
            };
            let much = self.load_changes_much(value);
            let bent = |place: Vector2<f64>| {
                let way = place - here;
                let aside = |off: Vector2<f64>| {
                    let length = size(way);
                    if much || length == 0.0 { size(off) } else { (way.perp(&off) / length).abs() }
                };
                match &ahead {
                    Ahead::Former(former) => aside(former.bend(way, piece)),
                    Ahead::Tangents(ways) => (aside(ways[0] - way) + aside(ways[1] - way)) / 8.0,
                }
            };
            let first = solved(&slope, trial.off).unwrap_or_default();
            let mut found = bent(trial.place + first);
            let mut missed = false;
            let within = if next == 1.0 { rounding } else { near };
            if found <= near || !divisible {
                self.balance(&mut trial, &mut slope, (to, drive), within);
                if size(trial.off) > near && former.is_none() {
                    // a body that sticks as the load rises may slip at the first guess
                    self.memory.get().row = trial.end.row;
                    trial = self.try_drive((to, drive), here);
                    let off = trial.off;
                    slope = self.going_in((here, &trial.end.row, &to), off, 0.0).slope;
                    self.balance(&mut trial, &mut slope, (to, drive), within);
                }
                found = bent(trial.place);
                missed = size(trial.off) > near || !trial.end.work.is_finite();
            }
            let factor = 0.9 * (near / found).sqrt();
            if divisible && (missed || found > near) {
                self.memory.get().row = trial.end.row;
                if !missed {
                    length = piece * factor.clamp(0.1, 0.7);
                } else if former.take().is_none() {
                    length = 0.25 * piece;
                }
                continue;
            }
            let (place, updates) = (trial.place, self.state.counters.profile_updates);
            if trial.is_last {
                self.settle(trial.end, (value, place), MOST_PIECES.ilog2())?;
            } else {
                self.memory.get().row = trial.end.row;
                self.walk(value, place, MOST_PIECES.ilog2())?;
            }
            self.keep_bound_slope_after(running_in);
            former = Some(Former::new(former, place - here, piece, slope));
            if self.state.counters.profile_updates != updates {
                former = None;
                if next == 1.0 {
                    self.go_on(value, drive)?;
                }
            }
            length =
                if trials < MOST_PIECES { (piece * factor.clamp(0.2, 4.0)).clamp(least, most) } else { most };
            done = next;
        }
        Ok(())
    }

    /// Tries the way in the present direction of the body. Returns the slope there, and the ways in
    /// the directions at both ends, the last one for a line of the drive.
    fn try_tangent(
        &mut self,
        (to, drive): (Contact, Vector2<f64>),
        value: f64,
        line: Vector2<f64>,
    ) -> (Trial, Matrix2<f64>, [Vector2<f64>; 2]) {
        let change = value - self.state.contact.control;
        let [first, last] =
            [&self.state.contact, &to].map(|contact| change * self.depth_per_control(contact));
        let ahead = drive - self.drive_place();
        let straight = self.going_from(ahead, first).with(ahead, first);
        let trial = self.try_drive((to, drive), self.state.place + straight);
        if to.is_open() {
            return (trial, Matrix2::identity(), [straight; 2]);
        }
        let end = self.going_in((trial.place, &trial.end.row, &to), straight, last);
        let onward = end.with(line, last);
        (trial, end.slope, [straight, onward])
    }

    /// Makes up for what wear has changed in the force. The body does not go back for that, within
    /// the accuracy of an equilibrium, since a reversal would let all springs stick.
    fn go_on(&mut self, value: f64, drive: Vector2<f64>) -> Result<(), Error> {
        let off = drive - self.drive_place();
        if !self.state.row.is_plane() || off.dot(&self.state.direction) <= 0.0 {
            return Ok(());
        }
        let to = self.state.contact;
        let mut going = self.going_from(off, 0.0);
        let mut trial = self.try_drive((to, drive), self.state.place + going.with(off, 0.0));
        self.balance(&mut trial, &mut going.slope, (to, drive), BALANCED * self.scale_of(drive, &to));
        self.memory.get().row = trial.end.row;
        let goes_on = (trial.place - self.state.place).dot(&self.state.direction) > 0.0;
        if goes_on { self.walk(value, trial.place, MOST_PIECES.ilog2()) } else { Ok(()) }
    }

    /// By how much the depth changes with the control.
    fn depth_per_control(&self, contact: &Contact) -> f64 {
        match (self.model.constants.force_control, contact.is_open()) {
            (_, true) => 0.0,
            (true, false) => 1.0 / contact.radius,
            (false, false) => 1.0,
        }
    }

    /// How the body goes on from where it stands, while the drive goes ahead and the depth changes.
    fn going_from(&self, ahead: Vector2<f64>, deeper: f64) -> Going {
        let going =
            |ahead| self.going_in((self.state.place, &self.state.row, &self.state.contact), ahead, deeper);
        // which springs slip under a load that changes depends on the way of the body
        let first = going(ahead);
        if deeper == 0.0 { first } else { going(first.with(ahead, deeper)) }
    }

    fn going_in(
        &self,
        (place, row, contact): (Vector2<f64>, &Row, &Contact),
        way: Vector2<f64>,
        deeper: f64,
    ) -> Going {
        let Row::Plane(row) = row else { return Going::FREE };
        let tangent = self.standing_at(place, row, contact).tangent(way, deeper);
        let compliance = self.compliance_of_row();
        Going {
            slope: Matrix2::identity() + compliance * tangent.stiffness,
            by_depth: compliance * tangent.by_depth,
        }
    }

    /// Size of the lengths that are compared in an equilibrium, m.
    fn scale_of(&self, drive: Vector2<f64>, to: &Contact) -> f64 {
        let limit = self.model.constants.friction_coefficient * to.load * self.force_scale();
        size(drive) + size(self.state.place) + self.model.compliance * limit
    }

    /// Tries a straight way to another load and place.
    fn try_drive(&mut self, (to, drive): (Contact, Vector2<f64>), place: Vector2<f64>) -> Trial {
        // nothing holds a body that has parted from the other
        let place = if to.is_open() { drive } else { place };
        let end = self.try_walk(to, place);
        self.state.counters.spring_walks += 1;
        let force = end.row.deflection_integral(self.model.axes.for_springs(place));
        let off = drive - place - self.compliance_of_row() * force;
        Trial { place, end, off, is_last: true }
    }

    /// Improves a trial, by Broyden's method from a slope, until the drive is within a distance (m)
    /// of the balance.
    fn balance(
        &mut self,
        trial: &mut Trial,
        slope: &mut Matrix2<f64>,
        (to, drive): (Contact, Vector2<f64>),
        within: f64,
    ) {
        let rounding = 4.0 * f64::EPSILON * (size(trial.place) + size(self.state.place));
        let mut walks = 0;
        while size(trial.off) > within {
            let Some(step) = solved(slope, trial.off) else { break };
            let mut share = 1.0;
            let next = loop {
                let next = self.try_drive((to, drive), trial.place + share * step);
                walks += 1;
                if size(next.off) < size(trial.off) {
                    break Some(next);
                }
                self.memory.get().row = next.end.row;
                share *= 0.5;
                let far = share * size(step) > rounding && walks < MOST_WALKS;
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
