//! A spring in series with the contact: what holds the body, and what a measured displacement
//! contains of it. It is as stiff along y as along x.
//!
//! The drive stands at **D**, the body at **U**, and both carry the same force,
//!
//! k_rig (**D** − **U**) = **T**(**U**),
//!
//! where **T** is that at the end of a straight way of the body. Trials of such ways find **U**
//! ([`equilibrium`]).
//!
//! At constant load a line of the drive is one way of the body, as long as it moves along x alone.
//! In the plane, springs that slip let the body give way sideways, so that it goes along a curve
//! while the drive goes straight, and where the load changes, **T** at the end depends on how body
//! and load went there. The drive's line is divided into pieces in which the body, halfway, is near
//! the chord: with the curvature κ of its path it is off by h²κ/8 in a piece of length h. The
//! curvature follows from the chords of two pieces, in the first one from the tangents at both
//! ends. The tangents serve there only: at the end of a chord the outer springs point along it, so
//! that they turn by more than the path. Between two ends of the line the body need not be nearer
//! to equilibrium than to the chord, since the next piece makes up for it.
//!
//! Nothing is kept: **D** follows from **U** and **T**. What an update of the worn profile changes
//! in **T** is made up for by going on, never back.

mod cycles;
mod equilibrium;

use super::history::MOST_PIECES;
use super::line::Line;
use super::{FrettingContact, Gradient};
use crate::error::Error;
use crate::friction::norm;
use crate::surface::Contact;
use equilibrium::{Trial, solved};
use nalgebra::{Matrix2, Vector2};

/// Ratio of two loads from which on the body may be late or early on a straight way. With 2 the
/// friction work of punches that are lifted off is 9 % off. At every change of load an orbit behind
/// a rig takes 72 walks a step, more than the 50 that its test allows.
const MUCH: f64 = 1.5;

/// How far from equilibrium counts as none, relative to the lengths that are compared.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// Share of a piece by which a line may be longer than its pieces.
const ROUNDED: f64 = 1e-6;

/// A piece of the drive's line, from where the body stands.
struct Piece {
    /// Load (N, or a depth in m) and place of the drive (m) at its end.
    value: f64,
    drive: Vector2<f64>,
    to: Contact,
    /// Its share of the line.
    share: f64,
    /// Way of the drive along it, m.
    way: Vector2<f64>,
    /// How far the drive is ahead of the line at its start, m.
    behind: Vector2<f64>,
    /// How far the body may be from the chord halfway, m.
    near: f64,
    /// How far from equilibrium the body may be at its end, m.
    within: f64,
    divisible: bool,
}

/// The way of the body that has been found for a piece.
struct Found {
    trial: Trial,
    /// By how much the drive goes on with the body.
    slope: Matrix2<f64>,
    /// How far from the chord the body is halfway, m.
    bent: f64,
    /// Whether there is no equilibrium at the end.
    missed: bool,
}

/// The piece before, by which the next one is guessed.
#[derive(Debug, Clone, Copy)]
struct Former {
    /// Way of the body per share of the line.
    rate: Vector2<f64>,
    /// Change of the rate per share of the line.
    curvature: Vector2<f64>,
    share: f64,
    slope: Matrix2<f64>,
}

impl Former {
    fn new(before: Option<Self>, way: Vector2<f64>, share: f64, slope: Matrix2<f64>) -> Self {
        let rate = way / share;
        let curvature =
            before.map_or(Vector2::zeros(), |before| 2.0 * (rate - before.rate) / (share + before.share));
        Self { rate, curvature, share, slope }
    }

    /// Way of the body in the next piece.
    fn way_on(&self, share: f64) -> Vector2<f64> {
        share * (self.rate + 0.5 * (share + self.share) * self.curvature)
    }

    /// How far from the chord a body on a parabola is halfway.
    fn bend(&self, way: Vector2<f64>, share: f64) -> Vector2<f64> {
        share * share / (4.0 * (share + self.share)) * (way / share - self.rate)
    }
}

/// What tells how the path of the body bends.
enum Ahead {
    Former(Former),
    /// Ways of a piece in the directions at its start and its end.
    Tangents([Vector2<f64>; 2]),
}

impl Ahead {
    /// How far from the chord the body is halfway, sideways, or at all where it may be late or
    /// early.
    fn bend(&self, way: Vector2<f64>, share: f64, late: bool) -> f64 {
        let aside = |off: Vector2<f64>| {
            let length = norm(way);
            if late || length == 0.0 { norm(off) } else { (way.perp(&off) / length).abs() }
        };
        match self {
            Self::Former(former) => aside(former.bend(way, share)),
            Self::Tangents(ways) => (aside(ways[0] - way) + aside(ways[1] - way)) / 8.0,
        }
    }
}

/// Behind a rig.
impl FrettingContact {
    /// Displacement of the drive: U + T/k_rig, m. It is [`Self::displacement`] where the rig is
    /// rigid. Where an update of the worn profile has changed T at the end of a step, it is a
    /// little off what was asked for; the next step makes up for it.
    #[inline]
    pub fn drive_displacement(&self) -> f64 {
        self.drive_place().x
    }

    /// Displacement of the drive along y: U_y + T_y/k_rig, m. It is [`Self::displacement_y`] where
    /// the rig is rigid.
    #[inline]
    pub fn drive_displacement_y(&self) -> f64 {
        self.drive_place().y
    }

    /// Where the drive stands, m.
    #[inline]
    pub(super) fn drive_place(&self) -> Vector2<f64> {
        if self.model.compliance == 0.0 { self.state.place } else { self.place_of_drive() }
    }

    // inlined, it makes a step without a rig a sixth slower
    #[inline(never)]
    fn place_of_drive(&self) -> Vector2<f64> {
        self.state.place + self.model.compliance * self.force()
    }

    /// Follows a line of the drive on which the bodies touch, while friction runs in. No piece
    /// takes more than a given share.
    pub(super) fn follow_drive(
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
            let share = next - done;
            let divisible = share > least && trials < MOST_PIECES;
            trials += 1;
            self.run_in_along(running_in, line.of_whole(next));
            if self.update_on_the_way(line.at_share(next))? {
                former = None;
            }
            let piece = self.piece(line, (done, next), divisible)?;
            let (found, here) = (self.find_way(&piece, former), self.state.place);
            let factor = 0.9 * (piece.near / found.bent).sqrt();
            if divisible && (found.missed || found.bent > piece.near) {
                self.memory.get().row = found.trial.end.row;
                if !found.missed {
                    length = share * factor.clamp(0.1, 0.7);
                } else if former.take().is_none() {
                    length = 0.25 * share;
                }
                continue;
            }
            let (place, slope) = (found.trial.place, found.slope);
            let updated = self.take_way(found.trial, piece.value)?;
            self.keep_bound_slope_after(running_in);
            former = if updated { None } else { Some(Former::new(former, place - here, share, slope)) };
            if updated && next == 1.0 {
                self.go_on(piece.value, piece.drive)?;
            }
            length =
                if trials < MOST_PIECES { (share * factor.clamp(0.2, 4.0)).clamp(least, most) } else { most };
            done = next;
        }
        Ok(())
    }

    /// Lets the profile follow where that is due before the body goes on to a load and a place of
    /// the drive; says whether it has.
    fn update_on_the_way(&mut self, (value, drive): (f64, Vector2<f64>)) -> Result<bool, Error> {
        self.enter_plane_for(drive)?;
        let due = self.update_is_due(self.state.place + self.ahead_of_drive(drive, &self.state.contact), 0.0);
        if due {
            self.update_before(value)?;
            // the body may have worn free
            self.enter_plane_for(drive)?;
        }
        Ok(due)
    }

    /// [`Self::enter_plane`], where the drive moves along y.
    fn enter_plane_for(&mut self, drive: Vector2<f64>) -> Result<(), Error> {
        if drive.y == self.state.place.y { Ok(()) } else { self.enter_plane() }
    }

    /// The piece between two shares of a line.
    fn piece(&self, line: &Line, (done, next): (f64, f64), divisible: bool) -> Result<Piece, Error> {
        let (value, drive) = line.at_share(next);
        let to = self.contact_for(value)?;
        let near = self.straight_within(value)? + self.rounding_of((drive, self.state.place), &to);
        Ok(Piece {
            value,
            drive,
            to,
            share: next - done,
            way: (next - done) * (line.to.1 - line.from.1),
            behind: line.at_share(done).1 - self.drive_place(),
            near,
            within: if next == 1.0 { 0.0 } else { near },
            divisible,
        })
    }

    /// Finds the way of the body in a piece.
    fn find_way(&mut self, piece: &Piece, former: Option<Former>) -> Found {
        let (here, to) = (self.state.place, (piece.to, piece.drive));
        let late = self.load_changes_much(piece.value);
        let (mut trial, mut slope, ahead) = match former {
            Some(former) => {
                let behind = solved(&former.slope, piece.behind).unwrap_or_default();
                let trial = self.try_drive(to, here + former.way_on(piece.share) + behind);
                (trial, former.slope, Ahead::Former(former))
            }
            None => {
                let (trial, slope, ways) = self.try_tangent(piece);
                (trial, slope, Ahead::Tangents(ways))
            }
        };
        let bent = |place: Vector2<f64>| ahead.bend(place - here, piece.share, late);
        let first = solved(&slope, trial.off).unwrap_or_default();
        let guess = bent(trial.place + first);
        if piece.divisible && guess > piece.near {
            return Found { trial, slope, bent: guess, missed: false };
        }
        self.balance(&mut trial, &mut slope, to, piece.within);
        let missed = norm(trial.off) > piece.near || !trial.end.work.is_finite();
        let bent = bent(trial.place);
        Found { trial, slope, bent, missed }
    }

    /// Tries the way in the present direction of the body. Returns the slope there, and the ways in
    /// the directions at both ends, the last one for the way of the drive.
    fn try_tangent(&mut self, piece: &Piece) -> (Trial, Matrix2<f64>, [Vector2<f64>; 2]) {
        let change = piece.value - self.state.contact.control;
        let [first, last] =
            [&self.state.contact, &piece.to].map(|contact| change * self.depth_per_control(contact));
        let ahead = self.ahead_of_drive(piece.drive, &piece.to);
        let straight = self.going_from(ahead, first).with(ahead, first);
        let straight = if change == 0.0 { self.farther(straight, piece) } else { straight };
        let trial = self.try_drive((piece.to, piece.drive), self.state.place + straight);
        if piece.to.is_open() {
            return (trial, Matrix2::identity(), [straight; 2]);
        }
        let end = self.going_in((trial.place, &trial.end.row, &piece.to), straight, last);
        let onward = end.with(piece.way, last);
        (trial, end.slope, [straight, onward])
    }

    /// The way into gross slip under an unchanged load, in which friction holds the rig by its
    /// limit, where that is farther than another one. As a concave function of the way, the force
    /// lets neither pass the balance on a line.
    fn farther(&self, straight: Vector2<f64>, piece: &Piece) -> Vector2<f64> {
        let away = piece.drive - self.state.place;
        let left = norm(away) - self.model.compliance * self.friction_limit();
        if left > norm(straight) { away * (left / norm(away)) } else { straight }
    }

    /// Takes the way that has been tried, and says whether the profile was updated on it.
    fn take_way(&mut self, trial: Trial, value: f64) -> Result<bool, Error> {
        let updates = self.state.counters.profile_updates;
        // a long slide is integrated, not divided
        if trial.is_last && self.onset_of_long_slide(value, trial.place).is_none() {
            self.settle(trial.end, (value, trial.place), true)?;
        } else {
            self.memory.get().row = trial.end.row;
            self.walk(value, trial.place, true)?;
        }
        Ok(self.state.counters.profile_updates != updates)
    }

    /// Makes up for what wear has changed in the force. The body does not go back for that, within
    /// the accuracy of an equilibrium, since a reversal would let all springs stick; its direction
    /// stays that of the way before.
    fn go_on(&mut self, value: f64, drive: Vector2<f64>) -> Result<(), Error> {
        let (to, direction) = (self.state.contact, self.state.direction);
        let off = self.ahead_of_drive(drive, &to);
        if off.dot(&direction) <= 0.0 {
            return Ok(());
        }
        let mut going = self.going_from(off, 0.0);
        let mut trial = self.try_drive((to, drive), self.state.place + going.with(off, 0.0));
        self.balance(&mut trial, &mut going.slope, (to, drive), 0.0);
        self.memory.get().row = trial.end.row;
        if (trial.place - self.state.place).dot(&direction) > 0.0 {
            self.walk(value, trial.place, true)?;
            self.state.direction = direction;
        }
        Ok(())
    }

    /// Whether a load (N, or a depth in m) differs much from the present one.
    fn load_changes_much(&self, value: f64) -> bool {
        let [now, then] = [self.state.contact.control, value].map(|value| value - self.touch_control());
        MUCH * now.min(then) < now.max(then)
    }

    /// How far the body may be from the middle of a straight way to a load (N, or a depth in m), m.
    fn straight_within(&self, value: f64) -> Result<f64, Error> {
        let depth = self.state.contact.depth.abs();
        let deeper = if self.load_changes_much(value) { self.solve_contact(value)?.depth.abs() } else { 0.0 };
        Ok(self.model.tuning.bent * self.model.bound_slope * depth.max(deeper))
    }

    /// By how much the depth changes with the control.
    fn depth_per_control(&self, contact: &Contact) -> f64 {
        match (self.model.constants.force_control, contact.is_open()) {
            (_, true) => 0.0,
            (true, false) => 1.0 / contact.radius,
            (false, false) => 1.0,
        }
    }

    /// The derivatives of a quantity by the drive where those by the body are given: d**U** = (1 +
    /// K/k_rig)⁻¹ (d**D** − ∂**T**/∂n dn/k_rig).
    pub(super) fn behind_the_rig(&self, of: Gradient) -> Gradient {
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
