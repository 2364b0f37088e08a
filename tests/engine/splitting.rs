//! A straight line may be walked in one step or in several: random bodies, motions and wear, of
//! which neither way is refused.

use crate::common::*;
use fretting_contact::{FrettingContact, NormalControl, Parameters, Profile};
use rand::RngExt;
use rand::rngs::StdRng;

/// Load (N, or a depth in m) and place (m) at the end of a line.
type Line = (f64, [f64; 2]);

/// A scene of 60 lines: displacement and load vary with time, or both are random.
fn scene(random: &mut StdRng) -> (Parameters, Vec<Line>) {
    let profiles =
        [BALL, CONE, BLUNTED, ROUNDED, PUNCH, Profile::PowerLaw { exponent: 3.0, coefficient: 2e5 }];
    let profile = profiles[random.random_range(0..profiles.len())].clone();
    let mut one_in = |number: u32| random.random_range(0..number) == 0;
    let (by_depth, runs_in, planar, at_random) = (one_in(4), one_in(4), one_in(3), one_in(3));
    let wear_coefficient = 3.2e-4 * 10f64.powf(uniform(random, -1.0, 2.6));
    let running_in_energy = if runs_in { 10f64.powf(uniform(random, -5.0, -2.0)) } else { 0.0 };
    let (amplitude, turn) = (uniform(random, 0.3e-6, 4e-6), uniform(random, 0.1, 1.0));
    let swing = uniform(random, 0.0, 0.5);
    let load = if by_depth { normal_input(&profile, NormalControl::Indentation, FORCE) } else { FORCE };
    let normal_control = if by_depth { NormalControl::Indentation } else { NormalControl::Force };
    let line = |k: u32| {
        let turned = turn * f64::from(k);
        let (share, [x, y]) = if at_random {
            (uniform(random, 0.2, 1.5), [0; 2].map(|_| uniform(random, -1.0, 1.0)))
        } else {
            (1.0 + swing * (0.7 * turned).sin(), [turned.sin(), turned.cos()])
        };
        (load * share, [amplitude * x, if planar { amplitude * y } else { 0.0 }])
    };
    let lines = (0..60).map(line).collect();
    let parameters = Parameters {
        profile,
        wear_coefficient,
        running_in_energy,
        friction_coefficient_final: 0.9,
        normal_control,
        ..Parameters::default()
    };
    (parameters, lines)
}

/// A contact after all lines, each in a number of steps.
fn walked(parameters: &Parameters, lines: &[Line], steps: u32) -> FrettingContact {
    let mut contact = contact(parameters.clone());
    let mut from = (lines[0].0, [0.0; 2]);
    contact.start_at(from.0, 0.0).unwrap();
    for to in lines {
        for k in 1..=steps {
            let share = f64::from(k) / f64::from(steps);
            let mix = |a: f64, b: f64| if k == steps { b } else { a + share * (b - a) };
            let place = [0, 1].map(|axis| mix(from.1[axis], to.1[axis]));
            contact.advance_to_planar(mix(from.0, to.0), place).unwrap();
        }
        from = *to;
    }
    contact
}

/// Relative differences of V and W between lines in one step and in five, and that of T over μF_N.
fn differences(parameters: &Parameters, lines: &[Line]) -> [f64; 3] {
    let [one, five] = [1, 5].map(|steps| walked(parameters, lines, steps));
    let relative = |a: f64, b: f64| if a == b { 0.0 } else { (a / b - 1.0).abs() };
    [
        relative(one.wear_volume(), five.wear_volume()),
        relative(one.dissipated_energy(), five.dissipated_energy()),
        (one.tangential_force() - five.tangential_force()).abs() / (MU * five.normal_reaction()),
    ]
}

#[test]
fn random_lines_may_be_split() {
    let mut random = seeded(1);
    let mut worst = [0.0_f64; 3];
    for number in 0..60 {
        let (parameters, lines) = scene(&mut random);
        let found = differences(&parameters, &lines);
        worst = [0, 1, 2].map(|k| worst[k].max(found[k]));
        assert!(found.iter().all(|off| *off < 5e-3), "scene {number}: {found:?} of {parameters:?}");
    }
    println!("V, W, T differ by {worst:?} at most");
}

/// An update after several strokes, whose hinges nearly cancel in their bins: taken at the nodes,
/// the slope of that law made the work 1.6 % too large.
#[test]
fn an_update_of_many_strokes_corrects_the_work_by_little() {
    let parameters = Parameters {
        wear_coefficient: 0.051_049_829_139_740_31,
        friction_coefficient_final: 0.9,
        running_in_energy: 0.000_451_867_378_823_026_7,
        ..Parameters::default()
    };
    let line = |k| {
        let turned = 0.435_720_290_061_957_56 * f64::from(k);
        (FORCE * (1.0 + 0.4 * (0.7 * turned).sin()), [1.721_912_917_214_294_8e-6 * turned.sin(), 0.0])
    };
    let lines: Vec<Line> = (0..60).map(line).collect();
    let found = differences(&parameters, &lines);
    assert!(found.iter().all(|off| *off < 1e-3), "{found:?}");
}
