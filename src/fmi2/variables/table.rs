//! The rows. The table is made by the compiler: a library that is loaded and unloaded many times
//! leaves nothing behind.

use super::{Access, DataType, Direction, Output, PROBES, Range, UNITS, Unit, Variable, WearThrough, Whole};
use crate::engine::{FrettingContact, Gradient, SlipState};
use crate::fmi2::enumerations::{Enumeration, LENGTH_UNIT, LOADING, NORMAL_CONTROL, PROFILE, SLIP_STATE};
use crate::fmi2::settings::{Inputs, Settings};
use crate::interface::{Interface, Summit};
use crate::parameters::Parameters;
use crate::range;
use std::ffi::CString;
use std::ops::Bound;

/// What the normal contact at the start follows from.
const NORMAL: &[&str] = &[
    "normal_force",
    "indentation",
    "profile",
    "radius",
    "cone_slope",
    "exponent",
    "coefficient",
    "flat_radius",
    "profile_file",
    "profile_unit",
    "radius_x",
    "radius_y",
    "contacts_file",
    "youngs_modulus_1",
    "poisson_ratio_1",
    "youngs_modulus_2",
    "poisson_ratio_2",
    "normal_control",
    "resolution",
];

/// What the state of the springs at the start follows from: without friction nothing sticks.
const FRICTION: &[&str] = &[
    "normal_force",
    "indentation",
    "profile",
    "radius",
    "cone_slope",
    "exponent",
    "coefficient",
    "flat_radius",
    "profile_file",
    "profile_unit",
    "radius_x",
    "radius_y",
    "contacts_file",
    "youngs_modulus_1",
    "poisson_ratio_1",
    "youngs_modulus_2",
    "poisson_ratio_2",
    "friction_coefficient",
    "normal_control",
    "resolution",
];

/// A field: its rows at all probe radii. The description is that before the number of the probe and
/// that behind it.
macro_rules! at_every_probe {
    ($name:literal, $unit:literal, $read:expr, $before:literal, $behind:literal) => {
        at_every_probe!(
            $name, $unit, $read, $before, $behind;
            1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26 27 28 29 30 31 32
            33 34 35 36 37 38 39 40 41 42 43 44 45 46 47 48 49 50 51 52 53 54 55 56 57 58 59 60 61 62 63 64
        )
    };
    ($name:literal, $unit:literal, $read:expr, $before:literal, $behind:literal; $($number:literal)*) => {
        [$(field(concat!($name, "[", $number, "]"), $unit, $number - 1, $read)
            .about(concat!($before, $number, $behind, ", computed when read"))),*]
    };
}

/// All rows. Later variables are at the end, so that existing value references do not change.
pub(super) static TABLE: [Variable; COUNT] = {
    let parts = [
        &inputs() as &[Variable],
        &outputs(),
        &parameters(),
        &at_every_probe!("radius_probe", "m", |_, r| r, "Radius of probe ", ""),
        &at_every_probe!(
            "worn_depth",
            "m",
            FrettingContact::worn_depth_at,
            "Depth of the wear at radius_probe[",
            "], the sum of both bodies"
        ),
        &at_every_probe!(
            "pressure",
            "Pa",
            FrettingContact::pressure_at,
            "Contact pressure at radius_probe[",
            "]"
        ),
        &at_every_probe!(
            "shear_traction",
            "Pa",
            FrettingContact::shear_traction_at,
            "Tangential traction along tangential_displacement at radius_probe[",
            "]"
        ),
        &at_every_probe!(
            "image",
            "m",
            FrettingContact::image_at,
            "One-dimensional image of the profile at radius_probe[",
            "]"
        ),
        &rig(),
        &second_direction(),
        &profile_unit(),
        &slip_state_value(),
        &second_body(),
        &coating(),
        &at_every_probe!(
            "profile_height",
            "m",
            FrettingContact::profile_height_at,
            "Height of the worn profile at radius_probe[",
            "], of both bodies together"
        ),
        &at_every_probe!(
            "slip_amplitude",
            "m",
            FrettingContact::slip_amplitude_at,
            "Slip since the last reversal at radius_probe[",
            "]; in cyclic loading its amplitude"
        ),
        &at_every_probe!(
            "energy_density",
            "J/m2",
            |contact, r| contact.energy_density_at(r).unwrap_or(f64::NAN),
            "Friction work per area so far at radius_probe[",
            "]; not a number without wear or after a change of a wear coefficient"
        ),
        &probes(),
        &running_in(),
        &ellipse(),
        &interface(),
    ];
    let mut table = [parts[0][0]; COUNT];
    let (mut part, mut row) = (0, 0);
    while part < parts.len() {
        let mut k = 0;
        while k < parts[part].len() {
            table[row] = parts[part][k];
            (k, row) = (k + 1, row + 1);
        }
        part += 1;
    }
    assert!(row == COUNT);
    table
};

const FIELDS: usize = 8;

const COUNT: usize = inputs().len()
    + outputs().len()
    + parameters().len()
    + FIELDS * PROBES
    + rig().len()
    + second_direction().len()
    + profile_unit().len()
    + slip_state_value().len()
    + second_body().len()
    + coating().len()
    + probes().len()
    + running_in().len()
    + ellipse().len()
    + interface().len();

const fn inputs() -> [Variable; 5] {
    [
        input("normal_force", "N", 100.0, Range::FINITE, |i| &mut i.normal_force).about(
            "Normal force, used when normal_control = force; the bodies are apart where it is not positive",
        ),
        input("indentation", "m", 1e-6, Range::FINITE, |i| &mut i.indentation)
            .about("Indentation depth of the unworn tip, used when normal_control = indentation"),
        input("tangential_displacement", "m", 1e-6, Range::FINITE, |i| &mut i.tangential_displacement)
            .about("Tangential displacement of body 1, used when loading = transient"),
        input("displacement_amplitude", "m", 1e-6, Range::NOT_NEGATIVE, |i| &mut i.displacement_amplitude)
            .about("Amplitude of the tangential displacement, used when loading = cyclic"),
        input("frequency", "Hz", 1.0, Range::NOT_NEGATIVE, |i| &mut i.frequency)
            .about("Cycles per unit of time, used when loading = cyclic; a step h makes frequency*h cycles"),
    ]
}

const fn outputs() -> [Variable; 12] {
    type C = FrettingContact;
    let (volume, depth, work) = (
        summed(grows(C::wear_volume, C::wear_volume_gradient, C::wear_volume_per_cycle)),
        Output { never_falls: true, ..grows(C::wear_depth, C::wear_depth_gradient, C::wear_depth_per_cycle) },
        summed(grows(C::dissipated_energy, C::dissipated_energy_gradient, C::work_per_cycle)),
    );
    let force = summed(follows(C::tangential_force, C::tangential_force_gradient));
    let reaction = summed(follows(C::normal_reaction, C::normal_reaction_gradient));
    let indentation = own(
        follows(C::indentation_depth, C::indentation_depth_gradient),
        Interface::indentation_depth,
        Interface::indentation_depth_gradient,
    );
    let radius = follows(C::contact_radius, C::contact_radius_gradient);
    let stick = follows(C::stick_radius, C::stick_radius_gradient);
    let pressure = follows(C::max_pressure, C::max_pressure_gradient);
    let tangential = summed(follows(C::tangential_stiffness, C::tangential_stiffness_gradient));
    let normal = summed(follows(C::normal_stiffness, C::normal_stiffness_gradient));
    [
        output("tangential_force", "N", 10.0, Range::FINITE, &[], force)
            .about("Tangential force that body 1 exerts on body 2; in cyclic loading its amplitude"),
        output("wear_volume", "m3", 1e-15, Range::NOT_NEGATIVE, &[], volume)
            .about("Volume worn off both bodies, accumulated"),
        output("wear_depth", "m", 1e-6, Range::NOT_NEGATIVE, &[], depth)
            .about("Deepest point of the wear, the sum of both bodies, accumulated"),
        output("dissipated_energy", "J", 1e-6, Range::NOT_NEGATIVE, &[], work)
            .about("Work of friction, accumulated"),
        output("normal_reaction", "N", 100.0, Range::NOT_NEGATIVE, NORMAL, reaction)
            .about("Normal force that the contact carries"),
        output("indentation_depth", "m", 1e-6, Range::FINITE, NORMAL, indentation)
            .about("Indentation depth of the unworn tip"),
        output("contact_radius", "m", 1e-4, Range::NOT_NEGATIVE, NORMAL, radius).about(
            "Radius of the contact; of an ellipse sqrt(semi-axis x * semi-axis y), the circle of its area",
        ),
        output("stick_radius", "m", 1e-4, Range::NOT_NEGATIVE, FRICTION, stick)
            .about("Radius of the sticking part: 0 in gross slip, contact_radius in full stick"),
        output("max_pressure", "Pa", 1e9, Range::NOT_NEGATIVE, NORMAL, pressure)
            .about("Highest contact pressure"),
        output("tangential_stiffness", "N/m", 1e7, Range::FINITE, FRICTION, tangential).about(
            "Change of tangential_force with the displacement, at the present state in the present direction",
        ),
        output("normal_stiffness", "N/m", 1e7, Range::FINITE, NORMAL, normal)
            .about("Change of normal_reaction with the indentation depth"),
        slip("slip_state", FRICTION, FrettingContact::slip_state).about("Which part of the contact slips"),
    ]
}

/// An output that follows the inputs.
const fn follows(read: fn(&FrettingContact) -> f64, gradient: fn(&FrettingContact) -> Gradient) -> Output {
    Output {
        whole: Whole::Deepest,
        read,
        gradient,
        per_cycle: None,
        starts_anywhere: None,
        never_falls: false,
    }
}

/// An output that is the sum over the contacts of an interface.
const fn summed(output: Output) -> Output {
    Output { whole: Whole::Sum, ..output }
}

/// An output that an interface has itself.
const fn own(output: Output, read: fn(&Interface) -> f64, gradient: fn(&Interface) -> Gradient) -> Output {
    Output { whole: Whole::Own { read, gradient }, ..output }
}

/// An output that also grows with the cycles of cyclic loading.
const fn grows(
    read: fn(&FrettingContact) -> f64,
    gradient: fn(&FrettingContact) -> Gradient,
    per_cycle: fn(&FrettingContact, f64) -> f64,
) -> Output {
    Output { per_cycle: Some(per_cycle), ..follows(read, gradient) }
}

const fn parameters() -> [Variable; 18] {
    let poisson = Range { low: Bound::Excluded(-1.0), high: Bound::Included(0.5) };
    let slope = Range {
        low: Bound::Included(range::LEAST_SLOPE),
        high: Bound::Excluded(std::f64::consts::FRAC_PI_2),
    };
    let exponent = Range { low: Bound::Included(0.1), high: Bound::Included(100.0) };
    let (length, stress) = (Range::of(&range::LENGTH), Range::of(&range::STRESS));
    let (coefficient, friction) = (Range::of(&range::COEFFICIENT), Range::of(&range::FRICTION));
    let (wear, tolerance) = (Range::of(&range::WEAR), Range::of(&range::TOLERANCE));
    let resolution = Parameters::RESOLUTION_RANGE;
    [
        choice("profile", &PROFILE, |s| &mut s.profile).about("Shape of the unworn body 1"),
        real("radius", "m", length, |s| &mut s.radius)
            .shown_in("mm")
            .about("Radius of curvature of parabola, blunted_sphere and rounded_punch"),
        real("cone_slope", "rad", slope, |s| &mut s.cone_slope)
            .about("Angle between the flank of the cone and the plane"),
        real("exponent", "1", exponent, |s| &mut s.exponent).about("Exponent n of power_law, f = coefficient r^n"),
        unitless("coefficient", coefficient, |s| &mut s.coefficient)
            .about("Coefficient of power_law, in m^(1-exponent); its unit depends on the exponent, so none is declared"),
        real("flat_radius", "m", length, |s| &mut s.flat_radius)
            .shown_in("mm")
            .about("Radius of the flat tip of blunted_sphere, rounded_punch and flat_punch"),
        text("profile_file", |s| &mut s.profile_file).about(
            "File with the points of profile = table, two columns r and f in profile_unit; a relative name is looked for in the \
             FMU's resources, then in the working directory",
        ),
        real("youngs_modulus_1", "Pa", stress, |s| &mut s.youngs_modulus_1)
            .shown_in("GPa")
            .about("Young's modulus of body 1, which moves"),
        real("poisson_ratio_1", "1", poisson, |s| &mut s.poisson_ratio_1).about("Poisson ratio of body 1"),
        real("youngs_modulus_2", "Pa", stress, |s| &mut s.youngs_modulus_2)
            .shown_in("GPa")
            .about("Young's modulus of body 2, the counter body"),
        real("poisson_ratio_2", "1", poisson, |s| &mut s.poisson_ratio_2).about("Poisson ratio of body 2"),
        tunable("friction_coefficient", "1", friction, |s| &mut s.friction_coefficient)
            .about("Coefficient of friction; a change counts from the next step; 0 at the start cannot be changed"),
        tunable("wear_coefficient", "1", wear, |s| &mut s.wear_coefficient).about(
            "Wear coefficient k of body 1: a friction work W wears the volume W*wear_coefficient/hardness off it; a change \
             counts from the next step, 0: body 1 does not wear, and cannot be changed",
        ),
        real("hardness", "Pa", stress, |s| &mut s.hardness)
            .shown_in("GPa").about("Hardness of body 1"),
        choice("normal_control", &NORMAL_CONTROL, |s| &mut s.normal_control)
            .about("Normal quantity that is prescribed"),
        choice("loading", &LOADING, |s| &mut s.loading).about("What the tangential inputs mean"),
        integer("resolution", resolution.0 as i32, resolution.1 as i32, |s| &mut s.resolution)
            .about("Cells across the contact; the default suits most users"),
        real("tolerance", "1", tolerance, |s| &mut s.tolerance)
            .about("Relative tolerance of the wear integration"),
    ]
}

/// A spring in series with the contact.
const fn rig() -> [Variable; 2] {
    let least = Bound::Included(Parameters::LEAST_RIG_STIFFNESS);
    let stiffness = Range { low: least, high: Bound::Included(f64::INFINITY) };
    const ALONG_X: Gradient = Gradient { normal: 0.0, displacement: 1.0, displacement_y: 0.0, rotation: 0.0 };
    let own = Output {
        starts_anywhere: Some(Direction::X),
        ..own(
            follows(FrettingContact::displacement, FrettingContact::displacement_gradient),
            Interface::displacement,
            |_| ALONG_X,
        )
    };
    [
        real("rig_stiffness", "N/m", stiffness, |s| &mut s.rig_stiffness).about(
            "Stiffness in series with the contact: tangential_displacement and displacement_amplitude are those of the drive behind it; none from 1e60 on",
        ),
        output("contact_displacement", "m", 1e-6, Range::FINITE, &["tangential_displacement", "loading"], own).about(
            "Tangential displacement of body 1 in the contact, without the stretch of the rig; in cyclic loading its amplitude",
        )
        .independent_of(&["rotation"]),
    ]
}

/// The unit of the table of points.
const fn profile_unit() -> [Variable; 1] {
    [choice("profile_unit", &LENGTH_UNIT, |s| &mut s.profile_unit)
        .about("Unit of both columns of profile_file")]
}

/// The state of slip for importers that read only variables of the type Real.
const fn slip_state_value() -> [Variable; 1] {
    let range = Range { low: Bound::Included(1.0), high: Bound::Included(SLIP_STATE.items.len() as f64) };
    let data_type = DataType::Real { unit: Some(unit_named("1")), nominal: None, range };
    [variable("slip_state_value", data_type, Access::SlipNumber(FrettingContact::slip_state))
        .about("slip_state as a Real: 1 separated, 2 stick, 3 partial_slip, 4 gross_slip")]
}

/// Wear of body 2, and what either body has lost.
const fn second_body() -> [Variable; 4] {
    type C = FrettingContact;
    let volume_1 = summed(grows(
        |c: &C| c.wear_volumes()[0],
        |c: &C| c.wear_volumes_gradient()[0],
        |c: &C, amplitude| c.wear_volumes_per_cycle(amplitude)[0],
    ));
    let volume_2 = summed(grows(
        |c: &C| c.wear_volumes()[1],
        |c: &C| c.wear_volumes_gradient()[1],
        |c: &C, amplitude| c.wear_volumes_per_cycle(amplitude)[1],
    ));
    let hardness = Range { low: Bound::Included(0.0), high: Bound::Included(*range::STRESS.end()) };
    [
        tunable("wear_coefficient_2", "1", Range::of(&range::WEAR), |s| &mut s.wear_coefficient_2).about(
            "Wear coefficient of body 2: a friction work W wears the volume W*wear_coefficient_2/hardness_2 off it; a \
             change counts from the next step, 0: body 2 does not wear, and cannot be changed",
        ),
        real("hardness_2", "Pa", hardness, |s| &mut s.hardness_2)
            .shown_in("GPa")
            .about("Hardness of body 2, needed where wear_coefficient_2 > 0"),
        output("wear_volume_1", "m3", 1e-15, Range::NOT_NEGATIVE, &[], volume_1)
            .about("Volume worn off body 1, accumulated"),
        output("wear_volume_2", "m3", 1e-15, Range::NOT_NEGATIVE, &[], volume_2)
            .about("Volume worn off body 2, accumulated"),
    ]
}

/// A coating and its end.
const fn coating() -> [Variable; 4] {
    let thickness = Range { low: Bound::Included(0.0), high: Bound::Included(*range::LENGTH.end()) };
    [
        real("coating_thickness", "m", thickness, |s| &mut s.coating_thickness)
            .about("Thickness of a coating, the wear_depth at which worn_through becomes true; 0: none"),
        variable("worn_through", DataType::Boolean, Access::WornThrough)
            .about("Whether wear_depth has reached coating_thickness; false without a coating"),
        event("worn_through_time", "s", WearThrough::Time).about(
            "Time at which worn_through became true, 0 before: in cyclic loading that of the cycle, in transient loading \
             the end of the step in which it was found",
        ),
        event("cycles_to_wear_through", "1", WearThrough::Cycles).about(
            "Cycles of cyclic loading since the start at which worn_through became true, 0 before, within tolerance",
        )
        .independent_of(&["tangential_displacement", "tangential_displacement_y", "rotation"]),
    ]
}

/// A number that belongs to the wear-through.
const fn event(name: &'static str, unit: &str, which: WearThrough) -> Variable {
    let data_type = DataType::Real { unit: Some(unit_named(unit)), nominal: None, range: Range::FINITE };
    variable(name, data_type, Access::WearThrough(which))
}

/// Friction that runs in.
const fn running_in() -> [Variable; 3] {
    type C = FrettingContact;
    let now = Output {
        whole: Whole::Friction,
        ..grows(
            C::friction_coefficient_now,
            C::friction_coefficient_gradient,
            C::friction_coefficient_per_cycle,
        )
    };
    let friction = Range::of(&range::FRICTION);
    let energy = Range { low: Bound::Included(0.0), high: Bound::Included(*range::RUNNING_IN.end()) };
    [
        real("friction_coefficient_final", "1", friction, |s| &mut s.friction_coefficient_final).about(
            "Coefficient of friction after running in, used when running_in_energy > 0",
        ),
        real("running_in_energy", "J", energy, |s| &mut s.running_in_energy).about(
            "Friction runs in from friction_coefficient to friction_coefficient_final like 1 - exp(-W/running_in_energy), \
             W = dissipated_energy; 0: constant friction",
        ),
        output("friction_coefficient_now", "1", 1.0, Range::NOT_NEGATIVE, &["friction_coefficient"], now)
            .about("Coefficient of friction at the present; of several contacts the mean by their normal forces"),
    ]
}

/// Where the fields are given.
const fn probes() -> [Variable; 1] {
    let radius = Range { low: Bound::Included(0.0), high: Bound::Included(*range::LENGTH.end()) };
    [real("probe_radius_max", "m", radius, |s| &mut s.probe_radius_max).about(
        "Outermost radius_probe, so that fields of two times have the same radii; at most the end of the body; 0: the \
         probes follow the contact",
    )]
}

/// A contact that is no circle.
const fn ellipse() -> [Variable; 4] {
    type C = FrettingContact;
    let length = Range::of(&range::LENGTH);
    let along_x = follows(|c| C::contact_semi_axes(c)[0], |c| C::contact_semi_axes_gradient(c)[0]);
    let along_y = follows(|c| C::contact_semi_axes(c)[1], |c| C::contact_semi_axes_gradient(c)[1]);
    [
        real("radius_x", "m", length, |s| &mut s.radius_x).shown_in("mm").about(
            "Relative radius of curvature in the plane xz of profile = ellipse, 1/radius_x = 1/R1 + 1/R2; the longer semi-axis lies along \
             the larger radius",
        ),
        real("radius_y", "m", length, |s| &mut s.radius_y)
            .shown_in("mm")
            .about("As radius_x, in the plane yz; the two differ by a factor of 1e6 at most"),
        output("contact_semi_axis_x", "m", 1e-4, Range::NOT_NEGATIVE, NORMAL, along_x)
            .about("Semi-axis of the contact along tangential_displacement; contact_radius unless profile = ellipse"),
        output("contact_semi_axis_y", "m", 1e-4, Range::NOT_NEGATIVE, NORMAL, along_y)
            .about("Semi-axis of the contact along tangential_displacement_y; contact_radius unless profile = ellipse"),
    ]
}

/// The other tangential direction.
const fn second_direction() -> [Variable; 3] {
    const ALONG_Y: Gradient = Gradient { normal: 0.0, displacement: 0.0, displacement_y: 1.0, rotation: 0.0 };
    let force =
        summed(follows(FrettingContact::tangential_force_y, FrettingContact::tangential_force_y_gradient));
    let own = Output {
        starts_anywhere: Some(Direction::Y),
        ..own(
            follows(FrettingContact::displacement_y, FrettingContact::displacement_y_gradient),
            Interface::displacement_y,
            |_| ALONG_Y,
        )
    };
    [
        input("tangential_displacement_y", "m", 1e-6, Range::FINITE, |i| &mut i.tangential_displacement_y).about(
            "Tangential displacement of body 1 at right angles to tangential_displacement, used when loading = transient; that of the drive where there is a rig_stiffness",
        ),
        output("tangential_force_y", "N", 10.0, Range::FINITE, &[], force).about(
            "Tangential force that body 1 exerts on body 2 along tangential_displacement_y; 0 in cyclic loading",
        )
        .independent_of(&["displacement_amplitude", "frequency"]),
        output("contact_displacement_y", "m", 1e-6, Range::FINITE, &["tangential_displacement_y", "loading"], own)
            .about("As contact_displacement, along tangential_displacement_y; where it stands in cyclic loading")
            .independent_of(&["displacement_amplitude", "frequency", "rotation"]),
    ]
}

/// Several contacts of one rigid body.
const fn interface() -> [Variable; 5] {
    const NONE: Gradient = Gradient { normal: 0.0, displacement: 0.0, displacement_y: 0.0, rotation: 0.0 };
    let moment = own(follows(|_| 0.0, |_| NONE), Interface::moment, Interface::moment_gradient);
    let touches = |contact: &FrettingContact| i32::from(contact.contact_radius() > 0.0);
    [
        text("contacts_file", |s| &mut s.contacts_file).about(
            "File with one contact in each line: offset, or offset, x and y, in profile_unit, and a factor of the radius; empty: one contact. \
             A relative name is looked for in the FMU's resources, then in the working directory",
        ),
        input("rotation", "rad", 1e-6, Range::FINITE, |i| &mut i.rotation).about(
            "Angle of body 1 about the normal through the origin of contacts_file, used when loading = transient",
        ),
        output("moment", "N.m", 1e-3, Range::FINITE, &[], moment)
            .about("Moment of the tangential forces of body 1 about the normal through the origin of contacts_file; 0 for one contact"),
        count("contact_count_in_touch", 0, touches, |interface| interface.contacts_in_touch() as i32)
            .about("Number of contacts that touch"),
        count("deepest_contact", 1, |_| 1, |interface| interface.deepest_contact() as i32 + 1).about(
            "Contact of contacts_file, counted from 1, that is worn deepest: wear_depth, contact_radius, stick_radius, max_pressure and the \
             fields are its own",
        ),
    ]
}

/// An Integer output about the contacts of an interface.
const fn count(
    name: &'static str,
    min: i32,
    one: fn(&FrettingContact) -> i32,
    many: fn(&Interface) -> i32,
) -> Variable {
    let data_type = DataType::Integer { min, max: Summit::MOST as i32 };
    Variable { initial_dependencies: NORMAL, ..variable(name, data_type, Access::Count { one, many }) }
}

/// A field at one of the probe radii.
const fn field(
    name: &'static str,
    unit: &str,
    probe: usize,
    read: fn(&FrettingContact, f64) -> f64,
) -> Variable {
    let data_type = DataType::Real { unit: Some(unit_named(unit)), nominal: None, range: Range::FINITE };
    variable(name, data_type, Access::Field { probe, read })
}

const fn unit_named(name: &str) -> Unit {
    let mut k = 0;
    while !is_same(UNITS[k].name.as_bytes(), name.as_bytes()) {
        k += 1;
    }
    UNITS[k]
}

const fn is_same(a: &[u8], b: &[u8]) -> bool {
    let mut k = 0;
    while k < a.len() && k < b.len() && a[k] == b[k] {
        k += 1;
    }
    k == a.len() && k == b.len()
}

const fn variable(name: &'static str, data_type: DataType, access: Access) -> Variable {
    let display_unit = match data_type {
        DataType::Real { unit: Some(Unit { display: [first, ..], .. }), .. } => Some(*first),
        _ => None,
    };
    Variable {
        name,
        description: "",
        data_type,
        display_unit,
        access,
        initial_dependencies: &[],
        independent_of: &[],
    }
}

impl Variable {
    const fn about(self, description: &'static str) -> Self {
        Self { description, ..self }
    }

    /// Another display unit than the first of its unit.
    const fn shown_in(self, name: &str) -> Self {
        let DataType::Real { unit: Some(unit), .. } = self.data_type else { panic!("it has no unit") };
        let mut k = 0;
        while !is_same(unit.display[k].name.as_bytes(), name.as_bytes()) {
            k += 1;
        }
        Self { display_unit: Some(unit.display[k]), ..self }
    }

    const fn independent_of(self, inputs: &'static [&'static str]) -> Self {
        Self { independent_of: inputs, ..self }
    }
}

const fn input(
    name: &'static str,
    unit: &str,
    nominal: f64,
    range: Range,
    field: fn(&mut Inputs) -> &mut f64,
) -> Variable {
    let data_type = DataType::Real { unit: Some(unit_named(unit)), nominal: Some(nominal), range };
    variable(name, data_type, Access::Input(field))
}

const fn output(
    name: &'static str,
    unit: &str,
    nominal: f64,
    range: Range,
    initial_dependencies: &'static [&'static str],
    output: Output,
) -> Variable {
    let data_type = DataType::Real { unit: Some(unit_named(unit)), nominal: Some(nominal), range };
    Variable { initial_dependencies, ..variable(name, data_type, Access::Output(output)) }
}

const fn slip(
    name: &'static str,
    initial_dependencies: &'static [&'static str],
    read: fn(&FrettingContact) -> SlipState,
) -> Variable {
    Variable {
        initial_dependencies,
        ..variable(name, DataType::Enumeration(&SLIP_STATE), Access::Slip(read))
    }
}

const fn real(
    name: &'static str,
    unit: &str,
    range: Range,
    field: fn(&mut Settings) -> &mut f64,
) -> Variable {
    let data_type = DataType::Real { unit: Some(unit_named(unit)), nominal: None, range };
    variable(name, data_type, Access::Parameter(field))
}

const fn tunable(
    name: &'static str,
    unit: &str,
    range: Range,
    field: fn(&mut Settings) -> &mut f64,
) -> Variable {
    Variable { access: Access::Tunable(field), ..real(name, unit, range, field) }
}

const fn unitless(name: &'static str, range: Range, field: fn(&mut Settings) -> &mut f64) -> Variable {
    variable(name, DataType::Real { unit: None, nominal: None, range }, Access::Parameter(field))
}

const fn integer(name: &'static str, min: i32, max: i32, field: fn(&mut Settings) -> &mut i32) -> Variable {
    variable(name, DataType::Integer { min, max }, Access::Number(field))
}

const fn choice(
    name: &'static str,
    items: &'static Enumeration,
    field: fn(&mut Settings) -> &mut i32,
) -> Variable {
    variable(name, DataType::Enumeration(items), Access::Number(field))
}

const fn text(name: &'static str, field: fn(&mut Settings) -> &mut CString) -> Variable {
    variable(name, DataType::String, Access::Text(field))
}
