//! Likely mistakes: values that are allowed and seldom meant, such as a modulus in the wrong unit.
//!
//! Each row of [`TABLE`] reaches the logger at most once per instance, with the status fmi2Warning.
//! The function that finds it still returns fmi2OK, since some masters stop at anything else.

use super::enumerations::Loading;
use super::settings::{Inputs, Settings};
use crate::engine::FrettingContact;
use crate::number::short;
use crate::parameters::NormalControl;
use crate::profile::Profile;

/// Displacements of full slip that a step seldom moves.
const FAR: f64 = 100.0;

/// When a row is looked at.
#[derive(Clone, Copy, PartialEq)]
enum Moment {
    /// At the end of the initialization.
    Start,
    /// When the bodies touch for the first time.
    FirstContact,
    /// After each step.
    Step,
    /// At fmi2Terminate.
    End,
}

/// What the conditions are about.
struct Scene<'a> {
    settings: &'a Settings,
    inputs: &'a Inputs,
    contact: &'a FrettingContact,
    run: &'a Run,
}

/// A row: when it is looked at, and the message where its condition holds.
type Row = (Moment, fn(&Scene) -> Option<String>);

const TABLE: [Row; 12] = [
    (Moment::Start, |scene| {
        let Settings { youngs_modulus_1, youngs_modulus_2, .. } = *scene.settings;
        let moduli = [("youngs_modulus_1", youngs_modulus_1), ("youngs_modulus_2", youngs_modulus_2)];
        let (name, value) = moduli.into_iter().find(|(_, value)| *value < 1e6)?;
        Some(format!(
            "{name} = {value} Pa is below 1 MPa, softer than rubber: check the unit, which is Pa and not GPa",
            value = short(value)
        ))
    }),
    (Moment::Start, |scene| {
        let Settings { ref profile_file, .. } = *scene.settings;
        let is_table = matches!(scene.contact.parameters().profile, Profile::Table(_));
        (!is_table && !profile_file.is_empty()).then(|| {
            let name = profile_file.to_string_lossy();
            format!(
                "profile_file = \"{name}\" has no effect: set profile = table, or leave profile_file empty"
            )
        })
    }),
    (Moment::Start, |scene| {
        let Settings { friction_coefficient_final: last, running_in_energy, .. } = *scene.settings;
        (running_in_energy == 0.0 && last != Settings::default().friction_coefficient_final).then(|| {
            format!("friction_coefficient_final = {last} has no effect: set running_in_energy, in J")
        })
    }),
    (Moment::FirstContact, |scene| {
        let extents = scene.extents();
        let (name, a, of, radius) =
            extents.into_iter().flatten().find(|(_, a, _, radius)| *a > 0.1 * radius)?;
        Some(format!(
            "{name} = {a:.3e} m is above a tenth of {of} = {radius} m, up to which the bodies count as half-spaces: \
             check {of}, load and Young's moduli",
            radius = short(radius)
        ))
    }),
    (Moment::FirstContact, |scene| {
        let (pressure, hardness) = (scene.pressure(), scene.settings.hardness);
        (pressure > hardness).then(|| {
            format!(
                "the pressure at the first contact, {pressure:.3e} Pa, is above hardness = {hardness} Pa, where bodies yield and the \
                 model does not: check hardness (in Pa), load and profile", hardness = short(hardness))
        })
    }),
    (Moment::FirstContact, |scene| {
        let Profile::Table(table) = &scene.contact.parameters().profile else { return None };
        let (a, third) = (scene.contact.contact_radius(), table.points().get(2)?.0);
        (a < third).then(|| {
            format!(
                "contact_radius = {a:.3e} m is within the first three points of the profile table, which end at r = {third} m: check the \
                 unit of profile_file, or give more points near the axis", third = short(third))
        })
    }),
    (Moment::FirstContact, |scene| {
        let (rig, contact) = (scene.settings.rig_stiffness, scene.contact.tangential_stiffness());
        (rig < 1e-3 * contact).then(|| {
            format!(
                "rig_stiffness = {rig} N/m is below a thousandth of the contact's own, {contact:.3e} N/m, so that the drive hardly moves the \
                 contact: check the unit, which is N/m", rig = short(rig))
        })
    }),
    (Moment::Step, |scene| {
        let (moved, full_slip) = (scene.run.moved, scene.full_slip());
        let transient = scene.settings.loading() == Loading::Transient;
        (moved > FAR * full_slip && full_slip > 0.0 && transient && scene.contact.contact_radius() > 0.0).then(
            || {
                format!(
                    "a step has moved the contact by {moved:.3e} m, more than {FAR} times the displacement of full slip, {full_slip:.3e} m: \
                     check the unit of tangential_displacement, which is m, or take shorter steps"
                )
            },
        )
    }),
    (Moment::Step, |scene| {
        let ([from, _], [to, _]) = (scene.run.start, scene.inputs.place());
        (scene.settings.loading() == Loading::Cyclic && scene.run.start != scene.inputs.place()).then(|| {
            format!(
                "loading = cyclic, and tangential_displacement has moved from {from} m to {to} m without effect: set \
                 displacement_amplitude and frequency, or loading = transient", from = short(from), to = short(to))
        })
    }),
    (Moment::Step, |scene| {
        let (amplitude, usual) = (scene.inputs.displacement_amplitude, Inputs::AMPLITUDE);
        // an input that is not connected is 0 in some tools
        let given = amplitude != usual && amplitude != 0.0;
        (scene.settings.loading() == Loading::Transient && given).then(|| {
            format!(
                "loading = transient, and displacement_amplitude = {amplitude} m has no effect: set tangential_displacement, or \
                 loading = cyclic", amplitude = short(amplitude))
        })
    }),
    (Moment::Step, |scene| {
        let angle = scene.inputs.rotation;
        (angle != 0.0 && scene.settings.contacts_file.is_empty()).then(|| {
            format!(
                "rotation = {angle} rad has no effect: a single contact lies on the axis of rotation; set contacts_file for a joint of \
                 many, or leave rotation at 0", angle = short(angle))
        })
    }),
    (Moment::End, |scene| {
        let Run { touched, has_moved, largest_normal, .. } = *scene.run;
        let (name, unit) = match scene.settings.normal_control() {
            NormalControl::Force => ("normal_force", "N"),
            NormalControl::Indentation => ("indentation", "m"),
        };
        (!touched && has_moved).then(|| {
            format!(
                "the bodies have moved and never touched, since {name} was never above {largest_normal} {unit}: check that {name} is \
                 connected and positive in compression", largest_normal = short(largest_normal))
        })
    }),
];

const ALL: u16 = (1 << TABLE.len()) - 1;

/// The rows of a moment, a bit each.
const fn rows_of(moment: Moment) -> u16 {
    let (mut rows, mut k) = (0, 0);
    while k < TABLE.len() {
        if TABLE[k].0 as u8 == moment as u8 {
            rows |= 1 << k;
        }
        k += 1;
    }
    rows
}

impl Scene<'_> {
    /// Sizes of the contact and the radii of curvature of the body in the same plane, m, with their
    /// names, where it has one.
    fn extents(&self) -> [Option<(&'static str, f64, &'static str, f64)>; 2] {
        match self.contact.parameters().profile {
            Profile::Parabola { radius }
            | Profile::BluntedSphere { radius, .. }
            | Profile::RoundedPunch { radius, .. } => {
                [Some(("contact_radius", self.contact.contact_radius(), "radius", radius)), None]
            }
            Profile::Ellipse { radius_x, radius_y } => {
                let [a, b] = self.contact.contact_semi_axes();
                let along_x = ("contact_semi_axis_x", a, "radius_x", radius_x);
                [Some(along_x), Some(("contact_semi_axis_y", b, "radius_y", radius_y))]
            }
            _ => [None, None],
        }
    }

    /// Largest pressure, Pa; the mean one under profiles whose pressure is infinite at an apex or a
    /// rim.
    fn pressure(&self) -> f64 {
        match &self.contact.parameters().profile {
            Profile::Cone { .. } | Profile::BluntedSphere { .. } | Profile::FlatPunch { .. } => {
                self.mean_pressure()
            }
            Profile::PowerLaw { exponent, .. } if *exponent <= 1.0 => self.mean_pressure(),
            _ => self.contact.max_pressure(),
        }
    }

    /// Displacement of full slip μ d E*/G* on the unworn body, m.
    fn full_slip(&self) -> f64 {
        self.contact.friction_coefficient_now() * self.run.modulus_ratio * self.contact.indentation_depth()
    }

    fn mean_pressure(&self) -> f64 {
        self.contact.normal_reaction() / (std::f64::consts::PI * self.contact.contact_radius().powi(2))
    }
}

/// What has to be remembered of a run.
#[derive(Clone, Copy)]
struct Run {
    /// Tangential displacements at its start, m.
    start: [f64; 2],
    /// Displacements of the contact after the last step, m; no numbers where that is not known.
    place: [f64; 2],
    /// Way of the contact in the last step, m.
    moved: f64,
    /// Way beyond which a step is looked at, over the indentation depth.
    far: f64,
    /// The inputs that the run of a single contact does not use, when they were last looked at.
    idle: [f64; 3],
    /// E*/G*.
    modulus_ratio: f64,
    loading: Loading,
    touched: bool,
    has_moved: bool,
    /// Largest force (N) or indentation depth (m) while the bodies have not touched.
    largest_normal: f64,
}

/// The warnings of one instance.
pub(super) struct Warnings {
    /// The rows that have not been sent, a bit each.
    unsent: u16,
    /// Whether it has been said that a field has no numbers.
    unknown_field: bool,
    run: Run,
}

impl Default for Warnings {
    fn default() -> Self {
        let run = Run {
            start: [0.0; 2],
            place: [f64::NAN; 2],
            moved: 0.0,
            far: 0.0,
            idle: [0.0; 3],
            modulus_ratio: 0.0,
            loading: Loading::Transient,
            touched: false,
            has_moved: false,
            largest_normal: f64::NEG_INFINITY,
        };
        Self { unsent: ALL, unknown_field: false, run }
    }
}

impl Warnings {
    /// Whether it has still to be said that a field has no numbers.
    pub(super) fn take_unknown_field(&mut self) -> bool {
        !std::mem::replace(&mut self.unknown_field, true)
    }

    fn begin(&mut self, contact: &FrettingContact, settings: &Settings, inputs: &Inputs) {
        let materials = &contact.parameters().materials;
        let modulus_ratio = materials.normal_modulus() / contact.tangential_moduli()[0];
        let (loading, start) = (settings.loading(), inputs.place());
        let far = match loading {
            Loading::Transient => FAR * settings.friction_coefficient * modulus_ratio,
            Loading::Cyclic => f64::INFINITY,
        };
        let place = [contact.displacement(), contact.displacement_y()];
        self.run = Run { start, place, loading, modulus_ratio, far, ..Self::default().run };
    }

    /// A saved state has been taken, in the run that it belongs to or as the beginning of one.
    pub(super) fn resume(&mut self, contact: &FrettingContact, settings: &Settings, inputs: &Inputs) {
        if self.run.modulus_ratio == 0.0 {
            self.begin(contact, settings, inputs);
        }
        self.run.place = [f64::NAN; 2];
        self.run.touched |= contact.contact_radius() > 0.0;
    }

    /// The messages of the end of the initialization.
    pub(super) fn at_start(
        &mut self,
        contact: &FrettingContact,
        settings: &Settings,
        inputs: &Inputs,
    ) -> Vec<String> {
        self.begin(contact, settings, inputs);
        let messages = self.due(rows_of(Moment::Start), contact, settings, inputs);
        messages.into_iter().chain(self.after_step(contact, settings, inputs)).collect()
    }

    /// Whether a step may be one with messages: a few comparisons, which is all that a sensible run
    /// pays.
    #[inline]
    pub(super) fn has_to_look(&mut self, contact: &FrettingContact, inputs: &Inputs) -> bool {
        let run = &mut self.run;
        let (x, y) = (contact.displacement(), contact.displacement_y());
        run.moved = (x - run.place[0]).abs();
        run.place[0] = x;
        // y by itself: a load of both places at once waits for the step's store of x
        if y != run.place[1] {
            run.moved += (y - run.place[1]).abs();
            run.place[1] = y;
        }
        let [first, second] = match run.loading {
            Loading::Transient => [inputs.displacement_amplitude, 0.0],
            Loading::Cyclic => inputs.place(),
        };
        let idle = [first, second, inputs.rotation];
        let changed = idle != run.idle;
        run.idle = idle;
        !run.touched | changed | (run.moved > run.far * contact.indentation_depth())
    }

    /// The messages of a step that has to be looked at.
    #[cold]
    pub(super) fn after_step(
        &mut self,
        contact: &FrettingContact,
        settings: &Settings,
        inputs: &Inputs,
    ) -> Vec<String> {
        let mut rows = rows_of(Moment::Step);
        if !self.run.touched {
            rows |= self.before_contact(contact, settings, inputs);
        }
        self.due(rows, contact, settings, inputs)
    }

    /// The rows of the first contact, where it is now.
    fn before_contact(&mut self, contact: &FrettingContact, settings: &Settings, inputs: &Inputs) -> u16 {
        let run = &mut self.run;
        if contact.contact_radius() > 0.0 {
            run.touched = true;
            return rows_of(Moment::FirstContact);
        }
        run.largest_normal = run.largest_normal.max(inputs.normal(settings.normal_control()));
        run.has_moved |= match settings.loading() {
            Loading::Transient => inputs.place() != run.start,
            Loading::Cyclic => inputs.displacement_amplitude * inputs.frequency > 0.0,
        };
        0
    }

    /// The messages of fmi2Terminate.
    pub(super) fn at_end(
        &mut self,
        contact: &FrettingContact,
        settings: &Settings,
        inputs: &Inputs,
    ) -> Vec<String> {
        self.due(rows_of(Moment::End), contact, settings, inputs)
    }

    /// The messages of some rows that have not been sent.
    fn due(
        &mut self,
        rows: u16,
        contact: &FrettingContact,
        settings: &Settings,
        inputs: &Inputs,
    ) -> Vec<String> {
        let mut messages = Vec::new();
        let mut left = self.unsent & rows;
        while left != 0 {
            let row = left.trailing_zeros() as usize;
            left &= left - 1;
            let scene = Scene { settings, inputs, contact, run: &self.run };
            if let Some(message) = TABLE[row].1(&scene) {
                self.unsent &= !(1 << row);
                messages.push(message);
            }
        }
        messages
    }
}
