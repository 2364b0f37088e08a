//! Wear of motion in the plane: dw = (k/σ₀) **τ**·d**s**, the product of the vectors.
//!
//! Within a *segment* every spring slips nearly one way, so that one pair of transforms for each direction serves however many
//! steps it had: traction of the deflections with which the springs slipped in the mean, slip of what they slipped in all. How nearly is told by the
//! springs themselves, whose work is known: where what mean and whole make of it falls short by [`TURNED`], the segment ends. At most as much may
//! wear before the profile follows as in any history; springs that slip then go on along their bound, in their direction.

use super::PlanarEnd;
use crate::engine::FrettingContact;
use crate::engine::history::{STROKE, load_has_moved};
use crate::error::Error;
use crate::friction::{PlanarRow, Resting, Standing, Vector, difference};
use crate::surface::Contact;
use crate::wear::{self, Edge, Segment};

/// Share of the work of a segment that may be lost in its means: φ²/12 for springs that turn evenly by φ, so 20°.
const TURNED: f64 = 0.01;

/// Most halvings of one piece of a line for the sake of its turning and its wear.
const MOST_HALVINGS: u32 = 9;

/// Ratio of what one line wears to what may wear between two updates at which it is refused without being tried.
const MOST_WEAR: f64 = 1e4;

/// Share of what may wear between two updates that may be left pending when the nodes change.
const LITTLE: f64 = 0.1;

/// An annulus that slips is taken to begin at this share of the contact radius at the most: what little wears in a thin one need not be
/// followed at once.
const WIDE: f64 = 0.9;

impl FrettingContact {
    /// Walks one piece with wear.
    pub(super) fn wear_in_plane(&mut self, value: f64, place: Vector) -> Result<(), Error> {
        if self.turns_back(place) {
            self.bounded(Self::turn_in_plane)?;
        }
        self.wear_in_parts(value, place, MOST_HALVINGS)
    }

    /// Whether the body goes back: springs that slip come off their bound, and hold what they had.
    fn turns_back(&self, place: Vector) -> bool {
        let ([x, y], way) = (self.direction_in_plane(), difference(place, self.place()));
        x * way[0] + y * way[1] < 0.0
    }

    /// Where the body goes back all springs that have slipped are at their bound, so that the profile can follow with them; if the next stroke,
    /// taken to be like the last, would wear too much, it does so now.
    fn turn_in_plane(&mut self) -> Result<(), Error> {
        let last = self.wear.as_ref().map_or(0.0, |wear| wear.segment.work);
        self.gather_in_plane()?;
        if self.constants.wear_per_work * (self.pending_work() + last) > self.limit_in_plane() {
            self.update_profile()?;
        }
        Ok(())
    }

    /// Whether all springs that have slipped since the last update are at their bound. An update lets others slip against them.
    fn follows_everywhere(&self) -> bool {
        let (Some(wear), Some(planar)) = (&self.wear, &self.planar) else { return true };
        let x = |i: usize| self.surface.worn().and_then(|nodes| nodes.x().get(i).copied());
        // the front may have moved on by a cell or two
        let pending =
            wear.pending.slip_path.iter().position(|path| *path > 0.0).and_then(|first| x(first + 2));
        let innermost = pending.unwrap_or(f64::INFINITY).min(planar.row.innermost_slip(2));
        self.stick_radius() <= innermost
    }

    fn wear_in_parts(&mut self, value: f64, place: Vector, halvings: u32) -> Result<(), Error> {
        let parts_ways = value <= self.touch_control();
        if parts_ways {
            // the springs take what they have slipped along when they leave
            self.bounded(Self::close_in_plane)?;
        } else if self.planar.is_none() {
            // the part before has worn the body free
            self.enter_plane()?;
        }
        let end = self.try_in_plane(value, place)?;
        let (to, row) = (&end.to, &end.row);
        let reached = Standing {
            row,
            surface: &self.surface,
            contact: to,
            bound_slope: self.bound_slope,
            displacement: place,
        };
        let volume = self.constants.wear_per_work * end.work;
        let ratio = if end.work > 0.0 {
            self.exceeds_limit(volume, to, reached.stick_radius().min(WIDE * to.radius))
        } else {
            None
        };
        if ratio.is_some_and(|ratio| ratio > MOST_WEAR) && self.outwears(end.work) {
            return Err(Error::WearOutrun { from: self.displacement, displacement: place[0] });
        }
        let turns = end.one_way < 1.0 - TURNED;
        if halvings > 0 && end.work > 0.0 && (turns || ratio.is_some()) {
            let middle = [0, 1].map(|k| 0.5 * (self.place()[k] + place[k]));
            let between = 0.5 * (self.contact.control + value);
            if middle != place && middle != self.place() {
                self.wear_in_parts(between, middle, halvings - 1)?;
                return self.wear_in_parts(value, place, halvings - 1);
            }
        }
        if halvings == 0 && self.outwears(end.work) {
            return Err(Error::WearOutrun { from: self.displacement, displacement: place[0] });
        }
        let worn = self.wear.as_ref().map_or(0.0, |wear| wear.segment.work);
        if worn > 0.0 && end.row.one_way() < 1.0 - TURNED {
            self.bounded(Self::close_in_plane)?;
            return self.wear_in_parts(value, place, halvings);
        }
        self.extend_in_plane(&end);
        self.arrive_in_plane(end, place);
        if self.contact.is_open() {
            self.start_segment();
            return Ok(());
        }
        let Some(wear) = &self.wear else { return Ok(()) };
        let start = wear.segment.contact.unwrap_or(self.contact);
        let volume = self.constants.wear_per_work * (self.pending_work() + wear.segment.work);
        if load_has_moved(&start, &self.contact) || self.is_due(volume) {
            self.bounded(Self::close_in_plane)
        } else {
            Ok(())
        }
    }

    /// Volume that may wear before the profile is updated, m³.
    fn limit_in_plane(&self) -> f64 {
        let wide = wear::update_limit(
            self.parameters.tolerance,
            &self.surface,
            &self.contact,
            WIDE * self.contact.radius,
        );
        self.update_limit().max(wide)
    }

    /// Whether the profile has to follow a volume (m³) here.
    fn is_due(&self, volume: f64) -> bool {
        let limit = self.limit_in_plane();
        volume > limit && (volume > STROKE * limit || self.follows_everywhere())
    }

    /// Adds a piece to the segment.
    fn extend_in_plane(&mut self, end: &PlanarEnd) {
        let from = self.contact;
        let Some(wear) = &mut self.wear else { return };
        wear.segment.contact.get_or_insert(if from.is_open() { end.to } else { from });
        if end.to.is_open() {
            wear.pending.add_work(end.work);
        } else {
            wear.segment.work += end.work;
        }
    }

    /// Starts a segment where the body stands.
    pub(in crate::engine) fn start_segment_in_plane(&mut self, contact: Option<Contact>) {
        let place = self.place();
        if let (Some(planar), Some(wear)) = (&mut self.planar, &mut self.wear) {
            planar.segment_start = place;
            planar.row.count_slip(true);
            wear.segment = Segment { contact, start: place[0], ..Segment::default() };
        }
    }

    /// Closes the segment and brings the profile up to date.
    pub(in crate::engine) fn settle_in_plane(&mut self) -> Result<(), Error> {
        self.gather_in_plane()?;
        self.update_profile()
    }

    /// Closes the segment, and brings the profile up to date where enough has worn.
    fn close_in_plane(&mut self) -> Result<(), Error> {
        self.gather_in_plane()?;
        if self.is_due(self.constants.wear_per_work * self.pending_work()) {
            self.update_profile()
        } else {
            Ok(())
        }
    }

    /// Turns the slip since the segment's start into work per area and slip path at the nodes.
    fn gather_in_plane(&mut self) -> Result<(), Error> {
        let Some(wear) = &self.wear else { return Ok(()) };
        let (work, start) = (wear.segment.work, wear.segment.contact.unwrap_or(self.contact));
        if work == 0.0 {
            return Ok(());
        }
        self.prepare_nodes_in_plane()?;
        let place = self.place();
        let outer = self.surface.profile().outer_radius();
        let (Some(wear), Some(planar), Some(nodes)) = (&mut self.wear, &self.planar, self.surface.worn())
        else {
            return Ok(());
        };
        let largest = if start.radius > self.contact.radius { start } else { self.contact };
        let edge = Edge::new(nodes, &largest, outer);
        if planar.row.has_slipped() {
            let moved = difference(place, planar.segment_start);
            let fields = planar.row.fields(nodes.x(), place, moved);
            let (transforms, made) = wear.transforms.get(nodes);
            let traction = fields.deflection.map(|deflection| {
                let mut traction = wear::pressure_nodes(&transforms, nodes.x(), &deflection, &edge);
                traction.iter_mut().for_each(|t| *t *= self.constants.tangential_modulus);
                traction
            });
            let slip = fields.slip.map(|slip| transforms.descend(&slip));
            wear.transform_defect += wear.pending.add_in_plane(nodes, &largest, (&traction, &slip), work);
            self.counters.transform_tables += u64::from(made);
            self.counters.pressure_transforms += 2;
            self.counters.descent_transforms += 2;
        } else {
            wear.pending.add_work(work);
        }
        self.start_segment();
        Ok(())
    }

    /// Makes the nodes at the first slip; later adapts them to the contact and the front, after what is pending has been worn off.
    fn prepare_nodes_in_plane(&mut self) -> Result<(), Error> {
        let front = self.stick_radius();
        let radius = self.contact.radius;
        if self.new_nodes(front, radius).is_none() {
            return Ok(());
        }
        let (Some(wear), Some(planar)) = (&mut self.wear, &self.planar) else { return Ok(()) };
        let (row, start) = (planar.row.clone(), planar.segment_start);
        let segment = std::mem::take(&mut wear.segment);
        if self.constants.wear_per_work * self.pending_work() > LITTLE * self.limit_in_plane() {
            self.update_profile()?;
        }
        // the update may have moved the nodes, too
        if let Some(nodes) = self.new_nodes(front, radius) {
            self.move_to_nodes(nodes);
        }
        // and nodes beyond the last change where the wear ends
        let to = self.contact_at(self.contact.control)?;
        if to != self.contact {
            self.rest_in_plane(to);
        }
        if let (Some(wear), Some(planar)) = (&mut self.wear, &mut self.planar) {
            planar.row.count_slip_of(&row);
            planar.segment_start = start;
            wear.segment = segment;
        }
        Ok(())
    }

    /// Contact and springs on a surface that has worn where the body stands.
    pub(in crate::engine) fn rest_in_plane(&mut self, to: Contact) {
        let stored = self.stored_energy();
        let (displacement, samples) = (self.place(), self.samples());
        let Some(planar) = &mut self.planar else { return };
        planar.row = planar.row.rested(&Resting {
            surface: &self.surface,
            contacts: (&self.contact, &to),
            bound_slope: self.bound_slope,
            displacement,
            samples,
        });
        self.contact = to;
        self.reach = self.reach.max(to.radius);
        self.lose_to_friction(stored - self.stored_energy());
        if to.is_open() {
            self.planar = None;
        }
    }

    /// Springs beyond a bound that has become another slip back to it where the body stands. Returns the energy that they lose, J.
    pub(in crate::engine) fn slip_back_in_plane(&mut self) -> f64 {
        let stored = self.stored_energy();
        let path = self.planar_path(self.contact, self.place());
        let Some(planar) = &self.planar else { return 0.0 };
        let (row, _) = planar.row.walk(&path, PlanarRow::default());
        if let Some(planar) = &mut self.planar {
            planar.row = row;
        }
        (stored - self.stored_energy()).max(0.0)
    }
}
