//! Cyclic loading: many displacement cycles at constant load in a few steps.
//!
//! Under constant load a steady cycle of amplitude U₀ wears ∂w/∂N = 4 κ p(r) s(r) with κ = kμ/σ₀
//! and s the descent of U₀ − min(U₀, b(x)), exact for a frozen profile. [`crate::wear::integrate`]
//! integrates that; sliding on in one direction is the same with s = 1 per metre. Both serve the
//! transient histories too, wherever these are nothing else.

use super::FrettingContact;
use crate::error::Error;
use crate::friction::{Path, Row, Springs};
use crate::range;
use crate::surface::{Contact, MeshPlace, Nodes, Surface};
use crate::wear::{Amount, IntegrationSettings, Motion, Part, RepeatedMotion, Rig, Sliding, integrate};
use nalgebra::Vector2;

/// Many cycles in one call.
impl FrettingContact {
    /// Runs `cycles` (≥ 0, need not be whole) displacement cycles between ±`amplitude` (m) along x
    /// at a constant force (N) or indentation depth (m). The amplitude is the drive's where there
    /// is a rig stiffness. Afterwards the body stands at its own, and [`Self::tangential_force`] is
    /// the amplitude of T.
    ///
    /// # Errors
    /// As [`Self::advance_to`]; [`Error::Input`] also for a negative amplitude or number of cycles;
    /// [`Error::TooMuchWear`] where one call asks for more wear than can be followed;
    /// [`Error::WearOutrun`] where more of it than the tolerance finds no place on the profile.
    pub fn advance_cycles(&mut self, normal: f64, amplitude: f64, cycles: f64) -> Result<(), Error> {
        for (name, value, most) in
            [("displacement_amplitude", amplitude, range::MOST_INPUT), ("cycles", cycles, range::MOST_CYCLES)]
        {
            if !(0.0..=most).contains(&value) {
                let requirement = "it has to be finite and not negative, at most 1e60 m and 1e30 cycles";
                return Err(Error::Input { name, value, requirement });
            }
        }
        if self.is_running_in() {
            return self.run_in_over(normal, amplitude, cycles);
        }
        self.advance_equal_cycles(normal, amplitude, (cycles, Part::Call))
    }

    /// [`Self::advance_cycles`] at the present coefficient of friction, in a part of a history.
    pub(super) fn advance_equal_cycles(
        &mut self,
        normal: f64,
        amplitude: f64,
        (cycles, part): (f64, Part),
    ) -> Result<(), Error> {
        let value = self.checked(normal, 0.0)?;
        let run = self.transaction(|this| {
            this.placed(|this| this.run_cycles_on_coating(value, amplitude, (cycles, part)))
        });
        run.map_err(|error| self.error_of_step(error, amplitude))?;
        self.state.counters.steps += 1;
        Ok(())
    }

    pub(super) fn run_cycles(
        &mut self,
        value: f64,
        amplitude: f64,
        (cycles, part): (f64, Part),
    ) -> Result<(), Error> {
        self.absorb_backlog()?;
        if self.state.row.is_plane() {
            self.state.row = Row::default();
        }
        self.state.contact = self.contact_at(value)?;
        self.state.reach = self.state.reach.max(self.state.contact.radius);
        let amplitude = if self.state.wear.is_none() {
            let own = self.own_amplitude(amplitude);
            let contact = self.state.contact;
            let (springs, work) = self.quarter(&contact, own);
            self.state.work += 4.0 * cycles * work;
            self.state.row = Row::Line(springs);
            own
        } else {
            self.wear_cycles(value, amplitude, (cycles, part))?
        };
        let Contact { depth, radius, load, .. } = self.state.contact;
        range::contact(radius, depth, load, self.normal_reaction())?;
        self.state.place.x = amplitude;
        self.state.direction = Vector2::new(1.0, 0.0);
        self.begin_quarter();
        Ok(())
    }

    /// The first quarter of a cycle from rest: springs at +amplitude and the work (J), a fourth of
    /// a steady cycle's.
    pub(super) fn quarter(&mut self, contact: &Contact, amplitude: f64) -> (Springs, f64) {
        let path = Path {
            start_slope: self.model.bound_slope,
            from: Contact { control: self.touch_control(), radius: 0.0, ..*contact },
            start: Vector2::zeros(),
            ..self.path_to(*contact, Vector2::zeros())
        };
        let (rest, _) = Springs::default().walk(&path, Springs::default(), None);
        let (springs, half_work) = rest.walk(
            &Path { from: *contact, end: Vector2::new(amplitude, 0.0), ..path },
            Springs::default(),
            None,
        );
        self.state.counters.spring_walks += 2;
        (springs, 2.0 * self.model.constants.tangential_modulus * half_work)
    }

    /// Returns the amplitude of the contact itself at the end, m.
    fn wear_cycles(&mut self, value: f64, amplitude: f64, (cycles, part): (f64, Part)) -> Result<f64, Error> {
        let own = if self.model.compliance == 0.0 {
            self.wear_steadily(value, (Sliding::Cycles(amplitude), part), cycles)?;
            amplitude
        } else {
            self.wear_driven_cycles(value, amplitude, (cycles, part))?
        };
        let contact = self.state.contact;
        let (springs, _) = self.quarter(&contact, own);
        self.state.row = Row::Line(springs);
        self.state.reach = self.state.reach.max(self.state.contact.radius);
        Ok(own)
    }

    /// Wears the surface on the moving mesh by a motion at constant load, which is some part of a
    /// history; returns the work (J), or `None` where the mesh cannot follow. With the amplitude of
    /// a drive (m), at constant force, the sliding is that at the start.
    ///
    /// # Errors
    /// Those of the normal contact.
    pub(super) fn wear_by(
        &mut self,
        value: f64,
        RepeatedMotion { sliding, mixture, amount }: RepeatedMotion,
        drive: Option<f64>,
        part: Part,
    ) -> Result<Option<f64>, Error> {
        let compliance = 2.0 * self.model.constants.tangential_modulus * self.model.compliance;
        let rig = drive.map(|amplitude| Rig { amplitude, compliance });
        let control = self.model.parameters.normal_control;
        let motion = Motion { control, value, sliding, mixture, rig };
        let last = self.state.wear.as_ref().and_then(|wear| wear.next_step);
        // a call on what one of the same motion has left
        let is_at = |mesh: MeshPlace| mesh.contact.value_of(control) == value;
        let goes_on = last.is_some_and(|(before, _)| before == sliding)
            && self.surface.worn().and_then(Nodes::mesh).is_some_and(is_at);
        let part = if part == Part::Call && goes_on { Part::Stretch } else { part };
        let last_step = match (last, sliding) {
            (Some((Sliding::Cycles(_), step)), Sliding::Cycles(_))
            | (Some((Sliding::Onward, step)), Sliding::Onward) => step,
            _ => 0.0,
        };
        let settings = IntegrationSettings {
            cells: self.model.parameters.resolution,
            tolerance: self.model.parameters.tolerance,
            last_step,
        };
        let per_work = self.model.constants.wear_per_work;
        let on_profile = |surface: &Surface| surface.worn().map_or(0.0, Nodes::worn_volume);
        let deferred_work = self.state.wear.as_ref().map_or(0.0, |wear| wear.deferred_work);
        let worn = on_profile(&self.surface) + per_work * deferred_work;
        let amount = Amount { cycles: amount, worn, part };
        let integrated = integrate(
            &self.surface,
            &motion,
            &amount,
            &self.model.constants,
            &settings,
            &mut self.state.counters,
        );
        let life = match integrated {
            Err(Error::TooMuchWear { .. } | Error::NotFinite { .. }) => return Ok(None),
            integrated => integrated?,
        };
        let Some(wear) = &mut self.state.wear else { return Ok(None) };
        wear.deferred_work = (worn + life.volume - on_profile(&life.surface)) / per_work;
        wear.next_step = Some((sliding, life.next_step));
        self.mesh = life.mesh.or(self.mesh.take());
        wear.defect += life.defect / per_work;
        self.surface = life.surface;
        self.look_at_coating();
        Ok(Some(life.volume / per_work))
    }
}
