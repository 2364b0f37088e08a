//! The laws of contact, friction and wear know no length, no stress, no coefficient of friction and
//! no direction of their own. Where all lengths or all stresses of a scene are multiplied by a
//! number, or friction and displacements, so are its results. Powers of two change no digit. With
//! them the results are the same bits, which shows that every threshold of the engine is a relative
//! one.

use crate::common::{BLUNTED, CONE, PUNCH, ROUNDED, contact, sampled_sphere, seeded, uniform};
use fretting_contact::{Counters, FrettingContact, Interface, NormalControl};
use fretting_contact::{Parameters, Profile, Summit};
use std::f64::consts::TAU;

/// Factors of a scene.
#[derive(Debug, Clone, Copy)]
struct Scale {
    length: f64,
    stress: f64,
    /// Of the coefficient of friction, and of displacements besides that of lengths.
    friction: f64,
    /// Of directions, ±1.
    side: f64,
}

/// Load (N, or a depth in m), and displacement or amplitude, m.
type Line = (f64, [f64; 2]);

impl Scale {
    const ONE: Self = Self { length: 1.0, stress: 1.0, friction: 1.0, side: 1.0 };

    /// Lengths, stresses and friction times powers of two.
    fn two_to(length: i32, stress: i32, friction: i32) -> Self {
        let [length, stress, friction] = [length, stress, friction].map(|power| 2f64.powi(power));
        Self { length, stress, friction, side: 1.0 }
    }

    fn force(self) -> f64 {
        self.stress * self.length.powi(2)
    }

    fn displacement(self) -> f64 {
        self.side * self.friction * self.length
    }

    fn tangential_force(self) -> f64 {
        self.side * self.friction * self.force()
    }

    fn work(self) -> f64 {
        self.tangential_force() * self.displacement()
    }

    fn parameters(self, of: &Parameters) -> Parameters {
        let profile = of.profile.scaled(self.length).expect("a scaled profile is one");
        let mut scaled = Parameters { profile, ..of.clone() };
        scaled.materials.body_1.youngs_modulus *= self.stress;
        scaled.materials.body_2.youngs_modulus *= self.stress;
        scaled.friction_coefficient *= self.friction;
        scaled.friction_coefficient_final *= self.friction;
        // volumes stay: the work has the square of the friction
        scaled.hardness *= self.stress * self.friction.powi(2);
        scaled.running_in_energy *= self.work();
        scaled.coating_thickness *= self.length;
        scaled.rig_stiffness *= self.stress * self.length;
        scaled
    }

    fn line(self, control: NormalControl, (normal, displacement): Line) -> Line {
        let normal = match control {
            NormalControl::Force => self.force() * normal,
            NormalControl::Indentation => self.length * normal,
        };
        (normal, displacement.map(|u| self.displacement() * u))
    }
}

/// What a contact gives, in the units of the scene at scale 1.
fn results(contact: &FrettingContact, scale: Scale) -> Vec<f64> {
    let mut results = vec![
        contact.tangential_force() / scale.tangential_force(),
        contact.tangential_force_y() / scale.tangential_force(),
        contact.normal_reaction() / scale.force(),
        contact.dissipated_energy() / scale.work(),
        contact.wear_volume() / scale.length.powi(3),
    ];
    let lengths = [
        contact.indentation_depth(),
        contact.contact_radius(),
        contact.stick_radius(),
        contact.wear_depth(),
        contact.worn_depth_at(0.7 * contact.contact_radius()),
    ];
    results.extend(lengths.map(|length| length / scale.length));
    results.extend(contact.cycles_to_wear_through());
    results
}

/// The results of steps, and the counted work. A second number of steps are calls of cycles.
fn run(parameters: &Parameters, lines: &[Line], cycles: usize, scale: Scale) -> (Vec<Vec<f64>>, Counters) {
    let mut contact = contact(scale.parameters(parameters));
    let mut all = Vec::new();
    for (k, line) in lines.iter().enumerate() {
        let (normal, place) = scale.line(parameters.normal_control, *line);
        if k < lines.len() - cycles {
            contact.advance_to_planar(normal, place).unwrap();
        } else {
            contact.advance_cycles(normal, place[0], 1e4).unwrap();
        }
        all.push(results(&contact, scale));
    }
    (all, *contact.counters())
}

/// Strokes and loads at random, with the bodies apart at times.
fn random_lines(load: f64) -> Vec<Line> {
    let mut random = seeded(5);
    let line = |_| {
        let share = uniform(&mut random, -0.2, 1.5);
        (share * load, [uniform(&mut random, -2.5e-6, 2.5e-6), 0.0])
    };
    (0..120).map(line).collect()
}

/// Ten cycles in steps at constant load, and three calls of cycles.
fn cycles(load: f64) -> Vec<Line> {
    let steps = (1..=200).map(|k| (load, [1.6e-6 * (TAU * f64::from(k) / 20.0).sin(), 0.0]));
    steps.chain([(load, [1.5e-6, 0.0]); 3]).collect()
}

/// Three orbits under a load that varies.
fn orbits(load: f64) -> Vec<Line> {
    let line = |k| {
        let turn = TAU * f64::from(k) / 30.0;
        (load * (1.0 + 0.3 * (0.7 * turn).sin()), [turn.sin(), turn.cos()].map(|share| 1.5e-6 * share))
    };
    (1..=90).map(line).collect()
}

/// From the size of a molecule to that of a planet for the usual ball, and the other way round.
fn scales() -> [Scale; 7] {
    [
        Scale::two_to(30, 0, 0),
        Scale::two_to(-25, 0, 0),
        Scale::two_to(0, -23, 0),
        Scale::two_to(7, 9, 0),
        Scale::two_to(0, 0, -9),
        Scale::two_to(0, 0, 11),
        Scale { side: -1.0, ..Scale::ONE },
    ]
}

#[track_caller]
fn assert_similar(name: &str, parameters: &Parameters, scales: &[Scale]) {
    let load = match parameters.normal_control {
        NormalControl::Force => 100.0,
        NormalControl::Indentation => 3e-6,
    };
    for (motion, lines, calls) in
        [("random", random_lines(load), 0), ("cycles", cycles(load), 3), ("orbits", orbits(load), 0)]
    {
        let first = run(parameters, &lines, calls, Scale::ONE);
        // a call of cycles ends at the positive amplitude
        for scale in scales.iter().filter(|scale| calls == 0 || scale.side > 0.0) {
            let other = run(parameters, &lines, calls, *scale);
            let same = first.0.iter().zip(&other.0).take_while(|(a, b)| a == b).count();
            assert_eq!(same, lines.len(), "{name}, {motion}, {scale:?}");
            assert_eq!(first.1, other.1, "{name}, {motion}, {scale:?}");
        }
    }
}

fn usual() -> Parameters {
    Parameters { wear_coefficient: 3.2e-2, resolution: 32, ..Parameters::default() }
}

#[test]
fn profiles_of_all_kinds_are_similar() {
    let profiles = [Profile::Parabola { radius: 0.01 }, CONE, BLUNTED, ROUNDED, PUNCH];
    for profile in profiles.into_iter().chain([Profile::Table(sampled_sphere(200))]) {
        let name = format!("{profile:.40?}");
        assert_similar(&name, &Parameters { profile, ..usual() }, &scales());
    }
    // powers of scaled numbers may differ in the last digit
    let profile = Profile::PowerLaw { exponent: 3.0, coefficient: 2e5 };
    let scales_of_power_law = [Scale::two_to(0, 20, 0), Scale::two_to(0, -23, 7)];
    assert_similar("power law", &Parameters { profile, ..usual() }, &scales_of_power_law);
    let profile = Profile::Ellipse { radius_x: 0.01, radius_y: 0.004 };
    assert_similar("ellipse", &Parameters { profile, wear_coefficient: 0.0, ..usual() }, &scales());
}

#[test]
fn rigs_running_in_coatings_and_fine_cells_are_similar() {
    let scenes = [
        ("depth", Parameters { normal_control: NormalControl::Indentation, ..usual() }),
        ("rig", Parameters { rig_stiffness: 3e7, ..usual() }),
        ("running in", Parameters { friction_coefficient_final: 0.9, running_in_energy: 1e-4, ..usual() }),
        ("coating", Parameters { coating_thickness: 2e-7, ..usual() }),
        ("no wear", Parameters { wear_coefficient: 0.0, ..usual() }),
        ("160 cells", Parameters { resolution: 160, ..usual() }),
    ];
    for (name, parameters) in scenes {
        let scales = scales();
        // the search for the equilibrium with a rig ends on one side of it
        let scales = if name == "rig" { &scales[..6] } else { &scales[..] };
        assert_similar(name, &parameters, scales);
    }
}

#[test]
fn many_contacts_are_similar() {
    let summits: Vec<Summit> = (0..7)
        .map(|k| Summit { radius_factor: 1.0 + 0.1 * f64::from(k), ..Summit::at_offset(4e-7 * f64::from(k)) })
        .collect();
    let run = |scale: Scale| {
        let scaled: Vec<Summit> =
            summits.iter().map(|summit| Summit { offset: scale.length * summit.offset, ..*summit }).collect();
        let mut joint = Interface::new(scale.parameters(&usual()), &scaled).unwrap();
        let step = |line: &Line| {
            let (force, place) = scale.line(NormalControl::Force, *line);
            joint.advance_to(force, place, 0.0).unwrap();
            [
                joint.tangential_force() / scale.tangential_force(),
                joint.indentation_depth() / scale.length,
                joint.dissipated_energy() / scale.work(),
                joint.wear_volume() / scale.length.powi(3),
                joint.wear_depth() / scale.length,
            ]
        };
        random_lines(400.0).iter().map(step).collect::<Vec<_>>()
    };
    let first = run(Scale::ONE);
    for scale in scales() {
        let other = run(scale);
        let same = first.iter().zip(&other).take_while(|(a, b)| a == b).count();
        assert_eq!(same, first.len(), "{scale:?}");
    }
}
