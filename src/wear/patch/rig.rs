//! The amplitude of the body itself in cycles of a drive, told from the state.
//!
//! Body and drive carry the same force, D − U₀ = (2G*/k_rig) ∫ min(U₀, m q) dx, and the integral of q outside the front follows from
//! the load alone, without quadrature: ∫ q dx over all of the contact is F_N/(2E*), and inside the image does not change.

use super::{FRONT_CELLS, Motion, Patch, Rate, Sliding, State};
use crate::surface::{Contact, Surface, outer_weight};
use crate::wear::mesh::Region;

/// Most passes of Newton's method, which on lines between the nodes ends by itself.
const MOST_PASSES: u32 = 50;

/// Share of a step over which the front's speed is told.
const PART: f64 = 0.1;

/// Square of the inner edge, over the width of the region in squares, at which an advancing front is as good as at the axis.
const AXIS: f64 = 1e-3;

/// By how much U₀ may be beyond what holds the springs at the inner edge at the end of a step, relative.
pub(super) const FAR: f64 = 2e-3;

/// How far the inner edge may go in a step, over the width of the region in squares.
const MOST_ADVANCE: f64 = 0.1;

/// A region whose inner edge goes along with the front for a step.
pub(crate) struct Steered {
    pub(crate) patch: Patch,
    pub(crate) rate: Rate,
    /// Speed of the inner edge's square at the end, m² per cycle; it changes evenly.
    end: f64,
    /// Speed of the front at the start.
    pub(crate) pace: f64,
    /// What that makes of the growth, from the start to the end, m per cycle.
    pub(crate) change: Vec<f64>,
}

impl Steered {
    /// The region after a share of the step.
    pub(crate) fn after(&self, share: f64, cycles: f64) -> Patch {
        let start = self.patch.speed;
        let mut patch = self.patch.moved(cycles * share * (start + 0.5 * share * (self.end - start)));
        patch.speed = start + share * (self.end - start);
        patch
    }

    /// The region at the end, still.
    pub(crate) fn at_end(&self, cycles: f64) -> Patch {
        Patch { speed: 0.0, ..self.after(1.0, cycles) }
    }
}

impl Motion {
    /// The same with the amplitude that a drive has on a surface.
    pub(crate) fn on(&self, surface: &Surface, contact: &Contact, bound_slope: f64) -> Self {
        let Some(rig) = self.rig.filter(|_| !contact.is_open()) else { return *self };
        let mut amplitude = (rig.amplitude - rig.compliance * bound_slope * contact.load).max(0.0);
        for _ in 0..MOST_PASSES {
            let level = contact.depth - amplitude / bound_slope;
            let stick = if level <= surface.image(0.0) {
                0.0
            } else {
                surface.radius_of_image(level, 0.0, contact.radius)
            };
            let place = surface.place(stick);
            let outside = contact.load - place.load - stick * (contact.depth - place.image);
            let force = amplitude * stick + bound_slope * outside;
            let pull = rig.amplitude - amplitude - rig.compliance * force;
            let next = amplitude + pull / (1.0 + rig.compliance * stick);
            let moves = next > amplitude * (1.0 + 1e-14);
            if !moves {
                break;
            }
            amplitude = next;
        }
        Self { sliding: Sliding::Cycles(amplitude), ..*self }
    }
}

impl Patch {
    /// U₀ (m) and where the springs first slip (m): where a rig yields they follow from the room d − g at the nodes, else from the motion.
    pub(super) fn amplitude(
        &self,
        (a, span): (f64, f64),
        (x, room): (&[f64], &[f64]),
        (indentation, image): (f64, &[f64]),
    ) -> (f64, f64) {
        let Some(rig) = self.motion.rig else { return (self.reach, self.inner_radius) };
        let inside = self.inner_radius * indentation - self.inside_image;
        let outside = self.bound_slope * (self.load((a, span), indentation, image) - inside);
        let mut stick = self.inner_radius;
        // as if all slipped from the inner edge on: too little, and Newton's method goes on from there without passing the solution
        let mut amplitude = (rig.amplitude - rig.compliance * outside) / (1.0 + rig.compliance * stick);
        for _ in 0..MOST_PASSES {
            let (front, beyond) = self.sticking_on_mesh(x, room, amplitude);
            stick = front;
            let force = amplitude * self.inner_radius + outside - beyond;
            let pull = rig.amplitude - amplitude - rig.compliance * force;
            let next = amplitude + pull / (1.0 + rig.compliance * stick);
            let moves = next > amplitude * (1.0 + 1e-14);
            if !moves {
                break;
            }
            amplitude = next;
        }
        (amplitude.max(0.0), stick)
    }

    /// Where the springs first slip on the mesh (m), and ∫ (m q − U₀) dx over what sticks on it, m².
    fn sticking_on_mesh(&self, x: &[f64], room: &[f64], amplitude: f64) -> (f64, f64) {
        let over = |i: usize| self.bound_slope * room[i] - amplitude;
        let mut sum = 0.0;
        for j in 0..self.cells() {
            let (ends, hold) = ((x[j], x[j + 1]), (over(j), over(j + 1)));
            if hold.0 <= 0.0 {
                return (ends.0, sum);
            }
            if hold.1 < 0.0 {
                let share = hold.0 / (hold.0 - hold.1);
                let front = (ends.0 * ends.0 + share * (ends.1 - ends.0) * (ends.1 + ends.0)).sqrt();
                return (front, sum + (front - ends.0) * (1.0 - outer_weight(ends.0, front)) * hold.0);
            }
            let outer = outer_weight(ends.0, ends.1);
            sum += (ends.1 - ends.0) * ((1.0 - outer) * hold.0 + outer * hold.1);
        }
        (x[self.cells()], sum)
    }

    /// How U₀ follows a change: by one minus the first it is less than m times that of the depth, where the load is held, and by the
    /// second times ∫ δh dx/√L, where the depth is.
    pub(super) fn follow(&self, rate: &Rate) -> (f64, f64) {
        let Some(rig) = self.motion.rig else { return (1.0, 0.0) };
        let own = 1.0 / (1.0 + rig.compliance * rate.stick);
        if self.is_force() { (own, 0.0) } else { (1.0, own * rig.compliance * self.span(rate.area).sqrt()) }
    }

    /// By how much U₀ is beyond what holds the springs at the inner edge, m.
    fn excess(&self, rate: &Rate) -> f64 {
        let image = self.body.image(self.inner_radius) + self.inside.edge_image();
        rate.reach - self.bound_slope * (rate.indentation - image)
    }

    /// The same over how much that may be: next to the inner edge, inside, springs slip unseen.
    pub(crate) fn beyond(&self, rate: &Rate) -> f64 {
        if self.motion.rig.is_none() || self.mesh.region == Region::Disc {
            return 0.0;
        }
        self.excess(rate) / (FAR * rate.reach)
    }

    /// Whether the inner edge may go along with an advancing front: where nothing is worn inside.
    pub(crate) fn can_advance(&self) -> bool {
        self.motion.rig.is_some()
            && self.mesh.region == Region::Annulus
            && !self.rim
            && self.body.worn().is_none()
            && self.inside.image.iter().chain(&self.inside.depth).all(|value| *value == 0.0)
    }

    /// Whether an advancing front has come so near to the axis that a disc takes fewer steps.
    pub(crate) fn is_at_axis(&self, rate: &Rate) -> bool {
        self.can_advance()
            && self.inner_radius * self.inner_radius < 1.001 * AXIS * self.span(rate.area)
            && self.excess(rate) > -1e-6 * rate.reach
    }

    /// The same with the inner edge's square (m²) further out by so much.
    pub(crate) fn moved(&self, by: f64) -> Self {
        let mut moved = self.clone();
        moved.inner_radius = (self.inner_radius * self.inner_radius + by).sqrt();
        if let Some(edge) = moved.inside.x.last_mut() {
            *edge = moved.inner_radius;
        }
        let inner = moved.body.place(moved.inner_radius);
        moved.inside_image = moved.inner_radius * inner.image - inner.load + moved.inside_width;
        moved
    }

    /// The square of where the front of a body stands that wears no further, and how that changes over the next so many cycles, m² and
    /// m² per cycle.
    pub(crate) fn front_of(
        &self,
        body: &Surface,
        (state, rate): (&State, &Rate),
        cycles: f64,
    ) -> Option<(f64, f64)> {
        let part = PART * cycles;
        let depth: Vec<f64> =
            state.depth.iter().zip(&rate.growth).map(|(w, growth)| w + part * growth).collect();
        let ahead = self.rate(&depth, rate.area)?;
        let square = |rate: &Rate| {
            let level = rate.indentation - rate.reach / self.bound_slope;
            if level <= body.image(0.0) {
                return 0.0;
            }
            body.radius_of_image(level, 0.0, rate.area.sqrt()).powi(2)
        };
        Some((square(rate), (square(&ahead) - square(rate)) / part))
    }

    /// The same with the inner edge following a front that advances, over the next so many cycles. `before`: how fast it was so many
    /// cycles before.
    pub(crate) fn steered(
        &self,
        (state, rate): (&State, &Rate),
        cycles: f64,
        before: Option<(f64, f64)>,
    ) -> Option<Steered> {
        if !self.can_advance() {
            return None;
        }
        let (square, span) = (self.inner_radius * self.inner_radius, self.span(rate.area));
        let (front, pace) = self.front_of(&self.body, (state, rate), cycles)?;
        let later = before.map_or(pace, |(slow, since)| pace + (pace - slow) * cycles / since);
        let later = if pace < 0.0 { later.clamp(2.0 * pace, 0.3 * pace) } else { pace };
        let behind = (front - square) / cycles;
        let least = (AXIS * span).max(square - MOST_ADVANCE * span);
        let (mut start, mut end) = (pace + behind, later + behind);
        if square + 0.5 * cycles * (start + end) < least {
            start = (least - square) / cycles;
            end = start;
        }
        if 0.5 * cycles * (start + end) >= -1e-10 * square {
            return None;
        }
        let mut patch = self.clone();
        patch.speed = start;
        let rate_then = patch.rate(&state.depth, state.area)?;
        patch.speed = end;
        let growth = patch.rate_at(&state.depth, rate_then.area).growth;
        patch.speed = start;
        let change = growth.iter().zip(&rate_then.growth).map(|(end, start)| end - start).collect();
        Some(Steered { patch, rate: rate_then, end, pace, change })
    }

    /// The same, all sticking at first from the inner edge to a radius (m).
    pub(crate) fn leading(mut self, front: f64, area: f64) -> Self {
        let share = (front * front - self.inner_radius * self.inner_radius) / self.span(area);
        let lead = self.mesh.share.partition_point(|phi| *phi < share);
        self.lead = lead.min(self.cells() / 2).min(self.cells().saturating_sub(FRONT_CELLS));
        self
    }
}
