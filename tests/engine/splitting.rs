//! A straight line may be walked in one step or in several: random bodies, motions and wear, of
//! which neither way is refused.

use crate::common::*;
use fretting_contact::problems::Problem;
use fretting_contact::{FrettingContact, NormalControl, Parameters, Profile, ProfileTable};
use rand::RngExt;
use rand::rngs::StdRng;
use std::f64::consts::PI;

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

/// A ball of 10 mm up to 0.47 mm whose image is rough: from point to point its rise varies by a
/// factor of e^1.5, one standard deviation.
fn rough_ball(random: &mut StdRng) -> ProfileTable {
    let radii: Vec<f64> = (0..376).map(|i| 1.25e-6 * f64::from(i)).collect();
    let mut image = vec![0.0];
    for ends in radii.windows(2) {
        let even = (ends[1] * ends[1] - ends[0] * ends[0]) / 0.01;
        let normal = (0..12).map(|_| uniform(random, -0.5, 0.5)).sum::<f64>();
        let rise = (1.5 * normal - 1.1).exp();
        image.push(image[image.len() - 1] + even * rise);
    }
    let image_at = |x: f64| {
        let place = (x / radii[1]).powi(2);
        let inner = place.sqrt().floor().min(374.0);
        let share = (place - inner * inner) / (2.0 * inner + 1.0);
        image[inner as usize] + share * (image[inner as usize + 1] - image[inner as usize])
    };
    // f = (2/π) ∫ g dx/√(r² − x²) from 0 to r
    let height = |r: f64| {
        let angles = (0..4000).map(|k| (f64::from(k) + 0.5) * PI / 8000.0);
        angles.map(|angle| image_at(r * angle.sin())).sum::<f64>() / 4000.0
    };
    ProfileTable::new(radii.iter().map(|r| (*r, height(*r))).collect()).unwrap()
}

/// Short strokes on rough bodies at a constant depth. Springs that stick differ by rounding, and
/// that is no slip: the nodes stay where springs slip.
#[test]
fn strokes_on_rough_tables_may_be_split() {
    let mut random = seeded(3);
    for body in 0..30 {
        let parameters = Parameters {
            profile: Profile::Table(rough_ball(&mut random)),
            wear_coefficient: 0.7,
            normal_control: NormalControl::Indentation,
            ..Parameters::default()
        };
        let depth = 3.5e-6;
        let lines: Vec<Line> =
            (0..200).map(|_| (depth, [uniform(&mut random, -0.56e-6, 0.56e-6), 0.0])).collect();
        let [one, two, four] = [1, 2, 4].map(|steps| walked(&parameters, &lines, steps));
        for split in [two, four] {
            close_to(split.wear_volume(), one.wear_volume(), 0.06, &format!("worn volume of body {body}"));
        }
    }
}

/// Strokes that begin in gross slip, one by one, against as many cycles in one call; bodies that
/// are flat at their tip come to stick there as their rim wears. (After an update of the moving
/// mesh the springs at the contact edge were not at their bound, so that the next strokes did not
/// look alike, and were worn on nodes at rest: V of r⁸ was 20 % too large, of r⁴ 11 %, and at a
/// tolerance of 1e-4 7 % off.)
#[test]
fn strokes_that_begin_in_gross_slip_wear_as_whole_cycles() {
    let power_law = |exponent, coefficient| Profile::PowerLaw { exponent, coefficient };
    for (profile, amplitude, steps, most) in [
        (power_law(8.0, 1e25), 1.15, 1, 3e-3),
        // 3.3e-3 at the tolerance 1e-4
        (power_law(8.0, 1e25), 1.15, 20, 4e-3),
        (power_law(4.0, 1e9), 1.25, 1, 3e-3),
        (power_law(4.0, 1e9), 1.25, 20, 3e-3),
        (BLUNTED, 1.1, 1, 3e-3),
        (ROUNDED, 1.1, 1, 3e-3),
        // the rim wears before all else
        (PUNCH, 1.02, 1, 5e-2),
    ] {
        for tolerance in [1e-3, 1e-4] {
            let start = exact(&profile, FORCE);
            let (a, d) = (start.normal.radius(), start.normal.depth());
            let amplitude = amplitude * start.full_slip();
            let mut parameters = Parameters { profile: profile.clone(), tolerance, ..Parameters::default() };
            parameters.wear_coefficient =
                PI * a * a * d / (500.0 * MU * FORCE * amplitude) * parameters.hardness;
            let mut stepped = started(parameters.clone());
            let mut whole = started(parameters);
            in_steps(&mut stepped, (FORCE, 0.0), (FORCE, amplitude), steps);
            whole.advance_cycles(FORCE, amplitude, 0.25).unwrap();
            for part in 1..=4 {
                for _ in 0..100 {
                    in_steps(&mut stepped, (FORCE, amplitude), (FORCE, -amplitude), steps);
                    in_steps(&mut stepped, (FORCE, -amplitude), (FORCE, amplitude), steps);
                }
                whole.advance_cycles(FORCE, amplitude, 100.0).unwrap();
                let off = stepped.wear_volume() / whole.wear_volume() - 1.0;
                println!("{profile:?}, {steps} steps, {tolerance:e}, part {part}: V {off:+.1e}");
                assert!(off.abs() < most, "{profile:?}, {steps} steps, {tolerance:e}: V {off:e}");
            }
        }
    }
}

/// Strokes at constant depth that are up to 30 % shorter than the largest come to its final state,
/// and there they end to wear. (On nodes at rest all their slip lies then in one cell: V of these
/// twelve was up to 43 % too large and rising, and what the profile had lost 27 % less than that.)
/// Of 40 sequences V is −4.9 to 0.7 % off, −1.7 % in the median; with 256 cells at 1e-5, where the
/// few largest strokes are not at an end yet, eight are −2.2 to −0.2 % off. The profile is within
/// 0.5 % of V.
#[test]
fn strokes_that_differ_end_to_wear_in_the_final_state() {
    let amplitude = 0.27 * exact(&ROUNDED, FORCE).full_slip();
    let mut parameters = Parameters { profile: ROUNDED, ..Parameters::default() };
    let depth = started(parameters.clone()).indentation_depth();
    let per_cycle = started(parameters.clone()).wear_volume_per_cycle(amplitude);
    parameters.normal_control = NormalControl::Indentation;
    let begun = |parameters: &Parameters| {
        let mut contact = contact(parameters.clone());
        contact.start_at(depth, 0.0).unwrap();
        contact
    };
    let mut whole = begun(&parameters);
    whole.advance_cycles(depth, amplitude, 1e12).unwrap();
    // eight cycles as the first would wear all that
    parameters.wear_coefficient *= whole.wear_volume() / per_cycle / 8.0;
    let mut all_off = Vec::new();
    for seed in 1..=12 {
        let (mut contact, mut random) = (begun(&parameters), seeded(seed));
        for n in 0..1280 {
            let side = if n % 2 == 0 { 1.0 } else { -1.0 };
            let place = side * amplitude * uniform(&mut random, 0.7, 1.0);
            contact.advance_to(depth, place).unwrap();
        }
        let off = contact.wear_volume() / whole.wear_volume() - 1.0;
        let behind = contact.profile_volume() / contact.wear_volume() - 1.0;
        println!("{seed}: V {off:+.1e}, profile {behind:+.1e}; {}", contact.counters());
        assert!((-0.08..0.02).contains(&off), "{seed}: V {off:e}");
        assert!(behind.abs() < 0.01, "{seed}: profile {behind:e}");
        all_off.push(off);
    }
    all_off.sort_by(f64::total_cmp);
    assert!(all_off[6].abs() < 0.04, "median of V: {:e}", all_off[6]);
}

/// How far the worn volume of strokes is off that of whole cycles, and the volume of their profile
/// off that, after each of some parts of so many cycles.
fn strokes_off_cycles(
    parameters: Parameters,
    amplitude: f64,
    (parts, cycles): (usize, u32),
) -> Vec<[f64; 2]> {
    let (mut stepped, mut whole) = (started(parameters.clone()), started(parameters));
    stepped.advance_to(FORCE, amplitude).unwrap();
    whole.advance_cycles(FORCE, amplitude, 0.25).unwrap();
    let mut part = || {
        for _ in 0..cycles {
            stepped.advance_to(FORCE, -amplitude).unwrap();
            stepped.advance_to(FORCE, amplitude).unwrap();
        }
        whole.advance_cycles(FORCE, amplitude, f64::from(cycles)).unwrap();
        let worn = stepped.wear_volume();
        [worn / whole.wear_volume() - 1.0, stepped.profile_volume() / worn - 1.0]
    };
    (0..parts).map(|_| part()).collect()
}

/// At constant depth strokes that wear a good part of a life each end where whole cycles do, with
/// their stick radius, in one step and in parts. (A part of a stroke was taken for a whole one,
/// after which the springs stand at a reversal: the front moved in, and V went up to 40 % beyond
/// the final one.)
#[test]
fn parts_of_strokes_in_fast_wear_end_in_the_final_state() {
    let settings: [(f64, usize); 4] = [(1e-3, 1), (1e-3, 20), (1e-4, 1), (1e-4, 20)];
    for (profile, life) in [(BALL, 10.0), (BALL, 30.0), (CONE, 10.0), (CONE, 30.0)] {
        for (tolerance, steps) in settings {
            let scene = Problem::partial_slip(shape(&profile), NormalControl::Indentation, 0.84);
            let mut scene = scene.with_seed_cycles(life);
            scene.parameters.tolerance = tolerance;
            let (mut stepped, mut whole) = (begun(&scene), begun(&scene));
            let (depth, amplitude) = (scene.normal, scene.amplitude);
            in_steps(&mut stepped, (depth, 0.0), (depth, amplitude), steps);
            for _ in 0..4 * life as u32 {
                in_steps(&mut stepped, (depth, amplitude), (depth, -amplitude), steps);
                in_steps(&mut stepped, (depth, -amplitude), (depth, amplitude), steps);
            }
            whole.advance_cycles(depth, amplitude, 4.0 * life + 0.25).unwrap();
            let off = stepped.wear_volume() / whole.wear_volume() - 1.0;
            let name = format!("{profile:?}, N0 = {life}, {steps} steps, {tolerance:e}");
            println!("{name}: V {off:+.1e}");
            assert!(off.abs() < 5.0 * tolerance, "{name}: V {off:e}");
            close_to(stepped.stick_radius(), whole.stick_radius(), 1e-9, &name);
        }
    }
}

/// One stroke to 1.3 of full slip, in wear of which 20 slides of 0.6 of it take a volume of π a² d:
/// what springs slip as their bound falls counts for a slide, too. (Taken for a first quarter of
/// cycles it was left out, and V was 2 % low.) Rows of 100 to 400 springs have 0.13292 to 0.13330.
#[test]
fn a_stroke_into_gross_slip_in_fast_wear_counts_what_its_bound_gives_up() {
    let start = exact(&BALL, FORCE);
    let (a, d, full) = (start.normal.radius(), start.normal.depth(), start.full_slip());
    let mut parameters = Parameters { profile: BALL, ..Parameters::default() };
    parameters.wear_coefficient = PI * a * a * d / (20.0 * MU * FORCE * 0.6 * full) * parameters.hardness;
    let mut contact = started(parameters);
    in_steps(&mut contact, (FORCE, 0.0), (FORCE, 1.3 * full), 8);
    close_to(contact.wear_volume(), 0.1333 * a * a * d, 3e-3, "V");
}

/// Strokes of 0.02 to 0.1 of full slip wear their thin annulus off as whole cycles, until nothing
/// is left to wear. (An update waited for a share of what an annulus of a tenth of the radius can
/// lose: V was up to three times too large, since the profile was updated once or never. At tighter
/// settings strokes stopped wearing before the end, up to 30 % low, since the load at a front was
/// that of another image.) The largest error is 2.4e-3 at 1e-3, and 1.1e-4 at 1e-4.
#[test]
fn strokes_that_slip_in_a_thin_annulus_wear_as_whole_cycles() {
    let power_law = Profile::PowerLaw { exponent: 8.0, coefficient: 1e25 };
    for profile in [BALL, ROUNDED, BLUNTED, power_law] {
        for share in [0.02, 0.05, 0.1] {
            for (tolerance, most) in [(1e-3, 5e-3), (1e-4, 3e-4)] {
                let amplitude = share * exact(&profile, FORCE).full_slip();
                let parameters = Parameters { profile: profile.clone(), tolerance, ..Parameters::default() };
                let mut life = started(parameters.clone());
                let per_cycle = life.wear_volume_per_cycle(amplitude);
                life.advance_cycles(FORCE, amplitude, 1e12).unwrap();
                // 100 cycles would wear three times what can wear
                let faster = 3.0 * life.wear_volume() / (100.0 * per_cycle);
                let wear_coefficient = faster * parameters.wear_coefficient;
                let parameters = Parameters { wear_coefficient, ..parameters };
                for (part, off) in strokes_off_cycles(parameters, amplitude, (4, 25)).iter().enumerate() {
                    let name = format!("{profile:?}, {share} of full slip, {tolerance:e}, part {part}");
                    println!("{name}: V {:+.1e}, profile {:+.1e}", off[0], off[1]);
                    assert!(off.iter().all(|off| off.abs() < most), "{name}: {off:?}");
                }
            }
        }
    }
}

/// While friction runs in, strokes wear as whole cycles, and both end. (Strokes of which each has
/// a slightly other coefficient of friction were no cycles to the engine, and were worn on nodes at
/// rest: V was 5 to 50 % too large after 1,200 cycles and rose on and on, or a step was refused.)
/// The largest error is 4.3e-3.
#[test]
fn strokes_wear_as_whole_cycles_while_friction_runs_in() {
    for (profile, amplitude) in [(BALL, 0.6), (BLUNTED, 0.4), (ROUNDED, 0.3)] {
        for (friction_coefficient_final, running_in_energy) in [(1.1 * MU, 1e-3), (1.5 * MU, 1e-4)] {
            let start = exact(&profile, FORCE);
            let (a, d) = (start.normal.radius(), start.normal.depth());
            let amplitude = amplitude * start.full_slip();
            let mut parameters = Parameters {
                profile: profile.clone(),
                friction_coefficient_final,
                running_in_energy,
                ..Parameters::default()
            };
            parameters.wear_coefficient =
                PI * a * a * d / (100.0 * MU * FORCE * amplitude) * parameters.hardness;
            for (part, off) in strokes_off_cycles(parameters, amplitude, (3, 200)).iter().enumerate() {
                let name = format!("{profile:?}, {running_in_energy} J, part {part}");
                println!("{name}: V {:+.1e}, profile {:+.1e}", off[0], off[1]);
                assert!(off[0].abs() < 6e-3 && off[1].abs() < 5e-3, "{name}: {off:?}");
            }
        }
    }
}

/// Strokes in gross slip, each walked in so many steps, leave the profile of as many cycles in one
/// call on fine cells. Updates go to and fro between the moving mesh and nodes at rest, and a
/// contact edge that moved with each change would dig a groove: of 21 to 31 % of the wear depth, in
/// these scenes at a tolerance of 1e-4. It is 5 % at most now (r⁴, 1e-3), and V 0.2 % off.
#[test]
fn strokes_in_gross_slip_leave_the_profile_of_whole_cycles() {
    let power_law = Profile::PowerLaw { exponent: 4.0, coefficient: 1e9 };
    for (profile, amplitude, steps) in [(BALL, 1.3, 20), (power_law.clone(), 1.3, 3), (power_law, 3.0, 1)] {
        for (tolerance, most) in [(1e-3, 0.06), (1e-4, 0.02)] {
            let start = exact(&profile, FORCE);
            let (a, d) = (start.normal.radius(), start.normal.depth());
            let amplitude = amplitude * start.full_slip();
            let (life, cycles) = (1000.0, 150);
            let wear_per_work = PI * a * a * d / (life * 4.0 * MU * FORCE * amplitude);
            let mut parameters = Parameters { profile: profile.clone(), tolerance, ..Parameters::default() };
            parameters.wear_coefficient = wear_per_work * parameters.hardness;
            let mut stepped = started(parameters.clone());
            let mut whole = contact(Parameters { resolution: 256, tolerance: 1e-5, ..parameters });
            in_steps(&mut stepped, (FORCE, 0.0), (FORCE, amplitude), steps);
            for _ in 0..cycles {
                in_steps(&mut stepped, (FORCE, amplitude), (FORCE, -amplitude), steps);
                in_steps(&mut stepped, (FORCE, -amplitude), (FORCE, amplitude), steps);
            }
            whole.advance_cycles(FORCE, amplitude, f64::from(cycles) + 0.25).unwrap();
            let radius = |i: u32| 1.2 * a * f64::from(i) / 100.0;
            let off = |i: u32| (stepped.worn_depth_at(radius(i)) - whole.worn_depth_at(radius(i))).abs();
            let off = (0..100).map(off).fold(0.0, f64::max) / whole.wear_depth();
            println!("{profile:?}, {steps} steps, {tolerance:e}: profile {off:.1e}");
            assert!(off < most, "{profile:?}, {steps} steps, {tolerance:e}: the profile differs by {off:e}");
            close_to(stepped.wear_volume(), whole.wear_volume(), 3e-3, "worn volume");
        }
    }
}
