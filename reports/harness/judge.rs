//! Judges a contact by what has to hold in every state, and keeps the worst it saw.

use fretting_contact::{Error, FrettingContact};
use std::f64::consts::PI;

/// |T| − μF_N allowed, in μF_N: rounding.
pub(crate) const COULOMB: f64 = 1e-12;
/// T of a first push against its closed form, relative. Springs are kept to 4ε of the largest
/// bound, which a front within √(4ε) = 3e-8 of full slip does not exceed; without it T is off by a
/// fourth of that.
pub(crate) const CLOSED: f64 = 1e-8;
/// Largest result of splitting a line, in μF_N and in the worn volume: without wear, and with it in
/// tolerances.
pub(crate) const SPLIT_WITHOUT_WEAR: f64 = 1e-9;
/// See [`SPLIT_WITHOUT_WEAR`].
pub(crate) const SPLIT_IN_TOLERANCES: f64 = 10.0;

/// An invariant, what was seen of it, and what is allowed.
#[derive(Debug, Clone)]
pub(crate) struct Finding {
    pub(crate) invariant: &'static str,
    pub(crate) seen: f64,
    pub(crate) allowed: f64,
}

impl Finding {
    /// Broken also by what is not a number.
    pub(crate) fn broken(&self) -> bool {
        !matches!(self.seen.partial_cmp(&self.allowed), Some(o) if o.is_le())
    }

    /// What was seen, in what is allowed; infinite where nothing is.
    pub(crate) fn share(&self) -> f64 {
        match (self.broken(), self.allowed > 0.0) {
            (false, true) => self.seen / self.allowed,
            (false, false) => 0.0,
            (true, true) if self.seen.is_finite() => self.seen / self.allowed,
            (true, _) => f64::INFINITY,
        }
    }
}

/// The worst of a scene so far.
#[derive(Debug, Clone, Default)]
pub(crate) struct Judge {
    /// The worst of each invariant.
    findings: Vec<Finding>,
    /// States that were judged.
    pub(crate) states: u64,
    work: f64,
    volume: f64,
    /// Largest πa²d so far, m³.
    size: f64,
}

impl Judge {
    /// Notes an invariant; keeps of each what came nearest to its bound, or farthest beyond it.
    pub(crate) fn note(&mut self, invariant: &'static str, seen: f64, allowed: f64) {
        let finding = Finding { invariant, seen, allowed };
        match self.findings.iter_mut().find(|kept| kept.invariant == invariant) {
            None => self.findings.push(finding),
            Some(kept) if finding.share() > kept.share() => *kept = finding,
            Some(_) => {}
        }
    }

    /// The worst of each invariant, in the order in which they were judged.
    pub(crate) fn findings(&self) -> &[Finding] {
        &self.findings
    }

    /// The worst of all.
    pub(crate) fn worst(&self) -> Option<&Finding> {
        self.findings.iter().reduce(|worst, other| if other.share() > worst.share() { other } else { worst })
    }

    /// Another contact: its work starts at 0.
    pub(crate) fn reset_work(&mut self) {
        (self.work, self.volume) = (0.0, 0.0);
    }

    /// A call, then its state. A refusal has to leave the contact as it was.
    pub(crate) fn step(
        &mut self,
        contact: &mut FrettingContact,
        call: impl FnOnce(&mut FrettingContact) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let before = signature(contact);
        let outcome = call(contact);
        match outcome {
            Ok(()) => self.state(contact),
            Err(_) => {
                let changed = before.iter().zip(signature(contact)).any(|(a, b)| a.to_bits() != b.to_bits());
                self.note("a refusal changes nothing", f64::from(u8::from(changed)), 0.0);
            }
        }
        outcome
    }

    /// Everything that has to hold of one state.
    pub(crate) fn state(&mut self, contact: &FrettingContact) {
        self.states += 1;
        let numbers = signature(contact);
        let [force, normal, depth, radius, stick, work, volume, profile, force_y] = numbers;
        let force = force.hypot(force_y);
        let others = [contact.wear_depth(), contact.tangential_stiffness(), contact.normal_stiffness()];
        let infinite = numbers.iter().chain(&others).filter(|x| !x.is_finite()).count();
        self.note("finite", infinite as f64, 0.0);
        let limit = contact.friction_coefficient_now() * normal;
        self.note("|T| <= mu F_N", if force > limit { force / limit - 1.0 } else { 0.0 }, COULOMB);
        self.note("stick radius <= contact radius", (stick - radius).max(0.0), 0.0);
        self.note("work never decreases", (self.work - work).max(0.0), 0.0);
        self.note("wear never decreases", (self.volume - volume).max(0.0), 0.0);
        (self.work, self.volume) = (work, volume);
        self.size = self.size.max(PI * radius * radius * depth);
        if volume > 0.0 {
            // the tolerance holds for the image in depths d: over the disc that is a volume, and a
            // life's volume keeps it, too
            let off = (profile - volume).abs() / (volume + self.size);
            // by lines in the cells, which no tolerance makes finer
            self.note("profile volume = (k/s0) work", off, contact.parameters().tolerance.max(1e-5));
        }
        // NaN counts as healed
        let healed = contact
            .probe_radii()
            .map(|r| contact.worn_depth_at(r))
            .iter()
            .filter(|w| w.is_nan() || **w < 0.0)
            .count();
        self.note("profile never below the unworn one", healed as f64, 0.0);
    }

    /// The same way in one step and in many ends in the same state.
    pub(crate) fn split(&mut self, one: &FrettingContact, many: &FrettingContact) {
        let parameters = one.parameters();
        let limit = one.friction_coefficient_now() * one.normal_reaction().max(many.normal_reaction());
        let tolerance = if one.wear_volume() > 0.0 {
            SPLIT_IN_TOLERANCES * parameters.tolerance
        } else {
            SPLIT_WITHOUT_WEAR
        };
        if limit > 0.0 {
            let along_y = one.tangential_force_y() - many.tangential_force_y();
            let off = (one.tangential_force() - many.tangential_force()).hypot(along_y) / limit;
            self.note("T independent of splitting", off, tolerance);
        }
        if one.wear_volume() > 0.0 {
            let off = (many.wear_volume() / one.wear_volume() - 1.0).abs();
            self.note("worn volume independent of splitting", off, tolerance);
        }
    }
}

fn signature(contact: &FrettingContact) -> [f64; 9] {
    [
        contact.tangential_force(),
        contact.normal_reaction(),
        contact.indentation_depth(),
        contact.contact_radius(),
        contact.stick_radius(),
        contact.dissipated_energy(),
        contact.wear_volume(),
        contact.profile_volume(),
        contact.tangential_force_y(),
    ]
}
