//! Friction and wear that change during a life: another lubricant, a coating that has worn through.

use super::FrettingContact;
use super::history::End;
use super::running_in::BALANCED;
use crate::error::Error;
use crate::friction::SlipPiece;
use crate::parameters::Parameters;
use nalgebra::Vector2;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// What has worn by former coefficients of wear.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct FormerWear {
    /// Volume worn off each body, m³.
    pub(super) volumes: [f64; 2],
    /// Work of friction by which it wore, J.
    pub(super) work: f64,
    /// Whether a part of the depth has worn by another ratio of depth to work than the present one.
    pub(super) mixed: bool,
}

/// Other coefficients during a life.
impl FrettingContact {
    /// Goes on with other coefficients of friction and wear. What has passed is worn off by the old
    /// ones. Springs beyond their new bound slip back to it where the body stands, and friction
    /// takes the energy that they lose, as in a gradual change.
    ///
    /// # Errors
    /// [`Error::Parameter`] for a coefficient out of its range, or that would switch friction or
    /// wear on or off; those of [`Self::advance_to`].
    pub fn retune(&mut self, friction_coefficient: f64, wear_coefficient: f64) -> Result<(), Error> {
        self.retune_bodies(friction_coefficient, [wear_coefficient, self.model.parameters.wear_coefficient_2])
    }

    /// [`Self::retune`] with the wear coefficients of body 1 and body 2. The volumes that the
    /// bodies have lost so far stay; the new ratio counts for what follows.
    ///
    /// # Errors
    /// As [`Self::retune`].
    pub fn retune_bodies(
        &mut self,
        friction_coefficient: f64,
        wear_coefficients: [f64; 2],
    ) -> Result<(), Error> {
        let old = &self.model.parameters;
        let [wear_coefficient, wear_coefficient_2] = wear_coefficients;
        let new =
            Parameters { friction_coefficient, wear_coefficient, wear_coefficient_2, ..(**old).clone() };
        new.validate()?;
        for (name, before, value) in [
            ("friction_coefficient", old.friction_coefficient, friction_coefficient),
            ("wear_coefficient", old.wear_coefficient, wear_coefficient),
            ("wear_coefficient_2", old.wear_coefficient_2, wear_coefficient_2),
        ] {
            if (before == 0.0) != (value == 0.0) {
                let requirement = "friction and wear are switched on or off by a new contact only";
                return Err(Error::Parameter { name, value, requirement });
            }
        }
        if new == **old {
            return Ok(());
        }
        let wear_per_work = new.wear_per_work();
        self.transaction(|this| {
            this.absorb_backlog()?;
            let former_wear_per_work = this.model.constants.wear_per_work;
            let mixed = this.state.former.mixed
                || (former_wear_per_work != wear_per_work && this.wear_volume() > 0.0);
            this.state.former = FormerWear { volumes: this.wear_volumes(), work: this.state.work, mixed };
            let model = Arc::make_mut(&mut this.model);
            model.parameters = Arc::new(new);
            model.constants.wear_per_work = wear_per_work;
            if let Some(wear) = &mut this.state.wear {
                // a volume, kept as the work that wears it
                wear.deferred_work *= former_wear_per_work / wear_per_work;
                wear.surplus *= former_wear_per_work / wear_per_work;
                wear.next_step = None;
            }
            this.set_friction(this.model.parameters.friction_coefficient_after(this.state.work));
            // from the bound of before, which the springs keep to, however small the new one is;
            // their slip runs friction in further
            *this = this.run_in_part((0.0, false), BALANCED, |next| {
                next.slip_back();
                Ok(())
            })?;
            this.keep_bound_slope();
            this.state.counters.spring_walks += 1;
            Ok(())
        })
    }

    /// Springs beyond a bound that has become another slip back to it where the body stands. That
    /// bound was larger until then than the present one, with which the backlog is worn off: the
    /// slip is taken larger instead.
    fn slip_back(&mut self) {
        let (contact, bound_slope) = (self.state.contact, self.model.bound_slope);
        let End { row, work, .. } = self.try_walk(contact, self.state.place);
        self.state.row = row;
        if work <= 0.0 {
            return;
        }
        let half_work = work / (2.0 * self.model.constants.tangential_modulus);
        let slips = &mut self.memory.get().slips;
        let overlap = |piece: &SlipPiece| (contact.depth - piece.image.0) * piece.integral - piece.moment;
        let factor = half_work / (bound_slope * slips.iter().map(overlap).sum::<f64>());
        slips.iter_mut().for_each(|piece| *piece = piece.times(factor));
        self.gather(work, &contact, Vector2::zeros());
        self.add_work(work);
        self.set_limit();
    }
}
