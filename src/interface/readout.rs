//! What can be read from an interface: sums over its contacts, and single contacts.

use super::Interface;
use crate::counters::Counters;
use crate::engine::{FrettingContact, Gradient, SlipState};
use crate::parameters::NormalControl;

impl Interface {
    /// Displacement of the body along x, m; in cyclic loading its amplitude.
    pub fn displacement(&self) -> f64 {
        self.pose.displacement[0]
    }

    /// Displacement of the body along y, m.
    pub fn displacement_y(&self) -> f64 {
        self.pose.displacement[1]
    }

    /// Rotation of the body about the normal, rad.
    pub fn rotation(&self) -> f64 {
        self.pose.rotation
    }

    /// Common approach d, m; under force control of separated bodies, that of first touch.
    pub fn indentation_depth(&self) -> f64 {
        self.pose.approach
    }

    /// Sum of a quantity over the contacts that have touched, in the order of the table.
    pub fn sum(&self, of: impl Fn(&FrettingContact) -> f64) -> f64 {
        self.members.touched().map(|(_, contact)| of(contact)).sum()
    }

    /// Tangential force along x that the moving body exerts, N.
    pub fn tangential_force(&self) -> f64 {
        self.sum(FrettingContact::tangential_force)
    }

    /// Tangential force along y that the moving body exerts, N.
    pub fn tangential_force_y(&self) -> f64 {
        self.sum(FrettingContact::tangential_force_y)
    }

    /// Moment about the normal through the origin that the tangential forces of the moving body
    /// exert, N m.
    pub fn moment(&self) -> f64 {
        let of = |(index, contact): (usize, &FrettingContact)| {
            let summit = &self.summits()[index];
            summit.x * contact.tangential_force_y() - summit.y * contact.tangential_force()
        };
        self.members.touched().map(of).sum()
    }

    /// Normal force, N.
    pub fn normal_reaction(&self) -> f64 {
        self.sum(FrettingContact::normal_reaction)
    }

    /// Work of friction so far, J.
    pub fn dissipated_energy(&self) -> f64 {
        self.sum(FrettingContact::dissipated_energy)
    }

    /// Worn volume so far, m³: [`FrettingContact::wear_volume`].
    pub fn wear_volume(&self) -> f64 {
        self.sum(FrettingContact::wear_volume)
    }

    /// Volume of the worn profiles, m³: the same by another route,
    /// [`FrettingContact::profile_volume`].
    pub fn profile_volume(&self) -> f64 {
        self.sum(FrettingContact::profile_volume)
    }

    /// Mean of a quantity over the contacts by their normal forces; of separated bodies that of
    /// [`Self::deepest_contact`].
    pub fn mean_by_load(&self, of: impl Fn(&FrettingContact) -> f64) -> f64 {
        let total = self.normal_reaction();
        if total > 0.0 {
            self.sum(|contact| of(contact) * contact.normal_reaction()) / total
        } else {
            self.read_deepest(of)
        }
    }

    /// Coefficient of friction at the present: Σ μᵢ Fᵢ/Σ Fᵢ, the ratio of the tangential to the
    /// normal force in sliding; of separated bodies that of [`Self::deepest_contact`].
    /// [`FrettingContact::friction_coefficient_now`] of [`Self::contact`] is that of one contact.
    pub fn friction_coefficient_now(&self) -> f64 {
        if self.parameters.running_in_energy == 0.0 {
            return self.parameters.friction_coefficient;
        }
        self.mean_by_load(FrettingContact::friction_coefficient_now)
    }

    /// ∂F_N/∂d, N/m.
    pub fn normal_stiffness(&self) -> f64 {
        self.sum(FrettingContact::normal_stiffness)
    }

    /// ∂T/∂U of the body for going on, N/m: the sum of [`FrettingContact::tangential_stiffness`].
    pub fn tangential_stiffness(&self) -> f64 {
        self.sum(FrettingContact::tangential_stiffness)
    }

    /// Number of contacts that touch.
    pub fn contacts_in_touch(&self) -> usize {
        self.members.touched().filter(|(_, contact)| contact.contact_radius() > 0.0).count()
    }

    /// Index from 0 of the contact that is worn deepest: by the last update of its profile and
    /// roughly what has worn since. Without wear that with the most friction work, before any
    /// work that with the largest force, and of separated bodies the first to touch.
    pub fn deepest_contact(&self) -> usize {
        let largest = |of: fn(&FrettingContact) -> f64| {
            let values = self.members.touched().map(|(index, contact)| (index, of(contact)));
            // the first of equal ones
            let largest = values.fold((0, 0.0), |most, next| if next.1 > most.1 { next } else { most });
            (largest.1 > 0.0).then_some(largest.0)
        };
        largest(FrettingContact::wear_depth_by_work)
            .or_else(|| largest(FrettingContact::dissipated_energy))
            .or_else(|| largest(FrettingContact::normal_reaction))
            .unwrap_or(self.members.first())
    }

    /// Reads something of [`Self::deepest_contact`], which may not have touched yet.
    pub fn read_deepest<T>(&self, read: impl FnOnce(&FrettingContact) -> T) -> T {
        let index = self.deepest_contact();
        match self.members.get(index) {
            Some(contact) => read(contact),
            None => read(&self.members.untouched(index, &self.pose)),
        }
    }

    /// Deepest worn point, m: that of [`Self::deepest_contact`]. Another contact may be deeper by a
    /// part of what one update wears.
    pub fn wear_depth(&self) -> f64 {
        self.read_deepest(FrettingContact::wear_depth)
    }

    /// Separated, stick or gross slip where all contacts that touch agree, else partial slip.
    pub fn slip_state(&self) -> SlipState {
        let states = self.members.touched().map(|(_, contact)| contact.slip_state());
        let mut states = states.filter(|state| *state != SlipState::Separated);
        let Some(first) = states.next() else { return SlipState::Separated };
        if states.all(|state| state == first) { first } else { SlipState::PartialSlip }
    }

    /// Work counted so far, of all contacts.
    pub fn counters(&self) -> Counters {
        self.members.touched().fold(Counters::default(), |sum, (_, contact)| sum.plus(contact.counters()))
    }

    /// Sum of a gradient over the contacts that have touched, with respect to the inputs of the
    /// interface: under force control all depths follow the force, ∂d/∂F_N = 1/Σ ∂Fᵢ/∂d.
    pub fn total_gradient(&self, of: impl Fn(&FrettingContact) -> Gradient) -> Gradient {
        let all = self.members.touched().map(|(index, contact)| (index, of(contact)));
        self.chained(all)
    }

    /// Gradient of something of [`Self::deepest_contact`].
    pub fn deepest_gradient(&self, of: impl Fn(&FrettingContact) -> Gradient) -> Gradient {
        let index = self.deepest_contact();
        self.chained(self.members.get(index).map(|contact| (index, of(contact))).into_iter())
    }

    /// Of [`Self::moment`].
    pub fn moment_gradient(&self) -> Gradient {
        let of = |(index, contact): (usize, &FrettingContact)| {
            let summit = &self.summits()[index];
            let along_y = contact.tangential_force_y_gradient().times(summit.x);
            (index, along_y.plus(&contact.tangential_force_gradient().times(-summit.y)))
        };
        self.chained(self.members.touched().map(of))
    }

    /// Of [`Self::friction_coefficient_now`].
    pub fn friction_coefficient_gradient(&self) -> Gradient {
        let total = self.normal_reaction();
        if self.parameters.running_in_energy == 0.0 || total <= 0.0 {
            return Gradient::default();
        }
        let mean = self.friction_coefficient_now();
        let of = |contact: &FrettingContact| {
            let share = contact.normal_reaction() / total;
            let excess = (contact.friction_coefficient_now() - mean) / total;
            let by_work = contact.friction_coefficient_gradient().times(share);
            by_work.plus(&contact.normal_reaction_gradient().times(excess))
        };
        self.total_gradient(of)
    }

    /// Of [`Self::indentation_depth`].
    pub fn indentation_depth_gradient(&self) -> Gradient {
        Gradient { normal: self.approach_per_normal(), ..Gradient::default() }
    }

    /// ∂d/∂(prescribed normal quantity).
    fn approach_per_normal(&self) -> f64 {
        if self.parameters.normal_control == NormalControl::Indentation {
            return 1.0;
        }
        let stiffness = self.normal_stiffness();
        if stiffness > 0.0 { 1.0 / stiffness } else { 0.0 }
    }

    /// Sum of gradients with respect to depth and displacement of single contacts, with respect to
    /// the inputs of the interface.
    fn chained(&self, gradients: impl Iterator<Item = (usize, Gradient)>) -> Gradient {
        let sum = gradients.fold(Gradient::default(), |sum, (index, gradient)| {
            let summit = &self.summits()[index];
            let rotation = gradient.displacement_y * summit.x - gradient.displacement * summit.y;
            sum.plus(&Gradient { rotation, ..gradient })
        });
        Gradient { normal: sum.normal * self.approach_per_normal(), ..sum }
    }
}
