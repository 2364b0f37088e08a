//! Wear against what is known of it: the final state and the way there at constant depth, the
//! tables at constant force, gross slip, and the identity of worn volume and friction work.

use crate::common::*;
use fretting_contact::problems::Problem;
use fretting_contact::reference::ConstantDepthEnd;
use fretting_contact::reference::wear::worn_flat_radius;
use fretting_contact::reference::wear_tables::{
    CONE_CONSTANT_FORCE, ConstantForceRow, FLAT_PUNCH_GROSS_SLIP, PARABOLA_CONSTANT_DEPTH,
    PARABOLA_CONSTANT_FORCE, SPHERE_GROSS_SLIP,
};
use fretting_contact::{Error, FrettingContact, NormalControl, Parameters, Profile};
use std::f64::consts::PI;

use NormalControl::{Force, Indentation};

/// Cycles of the transient scenes to Ñ = 1, and steps of each.
const LIFE: usize = 200;
const STEPS: usize = 40;

fn end_of(scene: &Problem) -> ConstantDepthEnd {
    scene.end.expect("the depth is held")
}

/// The identities that hold in every scene. V = (k/σ₀) W by definition; the worn profile holds that
/// volume, except for the clipping of rounding and the outermost cell; what the transforms alone
/// miss of the work is put right at each update, and known.
#[track_caller]
fn assert_volumes_agree(contact: &FrettingContact, defect: f64, what: &str) {
    let per_work = contact.parameters().wear_per_work();
    assert_eq!(contact.wear_volume(), per_work * contact.dissipated_energy(), "{what}");
    let missed = (contact.profile_volume() / contact.wear_volume() - 1.0).abs();
    let share = contact.transform_defect() / contact.dissipated_energy();
    let clipped = contact.clipped_work() / contact.dissipated_energy();
    println!(
        "{what}: profile misses {missed:.1e}, transforms {share:.1e}, clipped {clipped:.1e} of the work"
    );
    assert!(missed <= 1e-3, "{what}: the profile misses {missed:e} of the volume");
    assert!(share <= defect, "{what}: the transforms miss {share:e} of the work");
}

/// Nothing wears where every spring sticks: exactly nothing, also between the probes.
#[track_caller]
fn assert_stick_unworn(contact: &FrettingContact, what: &str) {
    let c = contact.stick_radius();
    for k in 0..1000 {
        let r = c * f64::from(k) / 1000.0;
        assert_eq!(contact.worn_depth_at(r), 0.0, "{what}: worn at r = {r:e} inside c = {c:e}");
    }
    assert!(contact.worn_depth_at(1.05 * c) > 0.0, "{what}: not worn outside c");
}

/// Compares the worn volume with that of a table, within a relative error `most`.
fn assert_volume(contact: &FrettingContact, scene: &Problem, volume: f64, most: f64, what: &str) {
    let measured = contact.wear_volume() / scene.volume_unit();
    println!("{what}: V = {measured:.5} against {volume}, {:+.2e}", measured / volume - 1.0);
    close_to(measured, volume, most, &format!("{what}: V"));
}

/// The volume, step by step; the stick radius does not move.
#[test]
fn steps_at_constant_depth_follow_the_table() {
    let scene = wear_scene(&BALL, Indentation, LIFE as f64);
    let c = 0.4 * scene.start.normal.radius();
    let mut contact = begun(&scene);
    let mut done = 0;
    for (cycles, volume) in PARABOLA_CONSTANT_DEPTH {
        let target = (cycles * LIFE as f64).round() as usize;
        cycle(&scene, &mut contact, target - done, STEPS);
        done = target;
        assert_volume(&contact, &scene, volume, 0.02, &format!("stepping, parabola at {cycles}"));
        let mut top = contact.clone();
        to(&mut top, scene.normal, scene.amplitude);
        close_to(top.stick_radius(), c, 1e-9, &format!("c at {cycles}"));
        assert_stick_unworn(&top, "parabola");
    }
    assert_volumes_agree(&contact, 5e-3, "stepping, parabola at constant depth");
    println!("{}", contact.counters());
}

/// From below; the stick radius does not move.
#[test]
fn steps_at_constant_depth_approach_the_final_volume_of_the_cone() {
    let scene = wear_scene(&CONE, Indentation, LIFE as f64);
    let a = scene.start.normal.radius();
    let mut contact = begun(&scene);
    cycle(&scene, &mut contact, LIFE, STEPS);
    let end = end_of(&scene).worn_volume();
    println!("stepping, cone: V = {} of V_inf at 1", contact.wear_volume() / end);
    assert!(contact.wear_volume() > 0.8 * end && contact.wear_volume() < 1.02 * end);
    to(&mut contact, scene.normal, scene.amplitude);
    close_to(contact.stick_radius(), 0.4 * a, 1e-9, "c");
    assert_stick_unworn(&contact, "cone");
    assert_volumes_agree(&contact, 3e-2, "stepping, cone at constant depth");
    println!("{}", contact.counters());
}

#[test]
fn whole_cycles_at_constant_depth_follow_the_table() {
    let scene = wear_scene(&BALL, Indentation, 1e4);
    let c = 0.4 * scene.start.normal.radius();
    let mut contact = begun(&scene);
    let mut done = 0.0;
    for (cycles, volume) in PARABOLA_CONSTANT_DEPTH {
        contact
            .advance_cycles(scene.normal, scene.amplitude, (cycles - done) * scene.seed_cycles())
            .expect("cycles");
        done = cycles;
        assert_volume(&contact, &scene, volume, 1e-3, &format!("cycles, parabola at {cycles}"));
        close_to(contact.stick_radius(), c, 1e-9, "c");
        assert_stick_unworn(&contact, "parabola, cycles");
    }
    assert_volumes_agree(&contact, 1e-2, "cycles, parabola at constant depth");
    println!("{}", contact.counters());
}

#[test]
fn the_final_state_at_constant_depth_is_the_closed_one() {
    for profile in [BALL, CONE] {
        let scene = wear_scene(&profile, Indentation, 1e4);
        let (a, d) = (scene.start.normal.radius(), scene.start.normal.depth());
        let end = end_of(&scene);
        let mut contact = begun(&scene);
        contact.advance_cycles(scene.normal, scene.amplitude, 9.0 * scene.seed_cycles()).expect("cycles");
        let worst = (0..2000)
            .map(|k| 1.5 * a * f64::from(k) / 2000.0)
            .map(|r| {
                let worn = if r <= 0.4 * a || r >= end.outer_radius() { 0.0 } else { end.worn_depth(r) };
                (contact.worn_depth_at(r) - worn).abs() / d
            })
            .fold(0.0, f64::max);
        println!(
            "final {profile:?}: sup error {worst:.2e} d0, V/V_inf - 1 = {:+.2e}, a/a_inf - 1 = {:+.2e}",
            contact.wear_volume() / end.worn_volume() - 1.0,
            contact.contact_radius() / end.outer_radius() - 1.0
        );
        println!(
            "F/F_inf - 1 = {:+.2e}, T: {:+.2e}, deepest {:+.2e}",
            contact.normal_reaction() / end.normal_force(E_STAR) - 1.0,
            contact.tangential_force() / end.tangential_force(G_STAR, scene.amplitude) - 1.0,
            contact.wear_depth() / end.deepest_wear().1 - 1.0
        );
        assert!(worst <= 3e-4, "{profile:?}: {worst:e} d0");
        close_to(contact.wear_volume(), end.worn_volume(), 3e-4, "V");
        // in the end g = d all over the slip zone, to the tolerance: where they cross last is
        // ill-defined
        close_to(contact.contact_radius(), end.outer_radius(), 0.05, "a");
        close_to(contact.normal_reaction(), end.normal_force(E_STAR), 3e-4, "F_N");
        close_to(contact.tangential_force(), end.tangential_force(G_STAR, scene.amplitude), 1e-9, "T");
        close_to(contact.wear_depth(), end.deepest_wear().1, 1e-3, "deepest wear");
        close_to(contact.stick_radius(), 0.4 * a, 1e-9, "c");
        assert_stick_unworn(&contact, "final state");
        assert_volumes_agree(&contact, 1e-2, &format!("{profile:?} to the final state"));
        println!("{}", contact.counters());
    }
}

/// Compares a contact at +U₀ with a row of the table: depth and volume within the given errors, all
/// within 2 %.
fn assert_row(
    contact: &FrettingContact,
    scene: &Problem,
    row: &ConstantForceRow,
    (depth, volume): (f64, f64),
    what: &str,
) {
    let (a, d) = (scene.start.normal.radius(), scene.start.normal.depth());
    let pairs = [
        (contact.indentation_depth() / d, row.depth, depth, "d"),
        (contact.stick_radius() / a, row.stick_radius, 0.02, "c"),
        (contact.wear_volume() / scene.volume_unit(), row.volume, volume, "V"),
        (contact.wear_depth() / d, row.deepest, 0.02, "deepest"),
    ];
    let offs: Vec<String> = pairs.iter().map(|(m, t, _, n)| format!("{n} {:+.1e}", m / t - 1.0)).collect();
    println!("{what} at {}: {}", row.cycles, offs.join(", "));
    for (measured, tabulated, most, name) in pairs {
        close_to(measured, tabulated, most, &format!("{what} at {}: {name}", row.cycles));
    }
}

#[test]
fn steps_at_constant_force_follow_the_tables() {
    for (profile, table, life) in
        [(BALL, PARABOLA_CONSTANT_FORCE, 1000.0), (CONE, CONE_CONSTANT_FORCE, 400.0)]
    {
        let scene = wear_scene(&profile, Force, life);
        let mut contact = begun(&scene);
        let mut done = 0;
        for row in &table {
            let target = (row.cycles * life).round() as usize;
            cycle(&scene, &mut contact, target - done, STEPS);
            done = target;
            let mut top = contact.clone();
            to(&mut top, scene.normal, scene.amplitude);
            assert_row(&top, &scene, row, (1e-3, 1e-2), &format!("stepping, {profile:?}"));
        }
        assert_volumes_agree(&contact, 2e-2, &format!("stepping, {profile:?} at constant force"));
        println!("{}", contact.counters());
    }
}

#[test]
fn whole_cycles_at_constant_force_follow_the_tables() {
    for (profile, table) in [(BALL, PARABOLA_CONSTANT_FORCE), (CONE, CONE_CONSTANT_FORCE)] {
        let scene = wear_scene(&profile, Force, 1e4);
        let mut contact = begun(&scene);
        let mut done = 0.0;
        for row in &table {
            contact.advance_cycles(scene.normal, scene.amplitude, (row.cycles - done) * 1e4).expect("cycles");
            done = row.cycles;
            assert_row(&contact, &scene, row, (6e-4, 2e-3), &format!("cycles, {profile:?}"));
        }
        assert_volumes_agree(&contact, 1e-2, &format!("cycles, {profile:?} at constant force"));
        println!("{}", contact.counters());
    }
}

/// On the way to the end the cells limit the error: twice as many take two fifths of it off.
#[test]
fn the_volume_on_the_way_converges_with_the_cells() {
    for (control, table) in [
        (Indentation, PARABOLA_CONSTANT_DEPTH.to_vec()),
        (Force, PARABOLA_CONSTANT_FORCE.iter().map(|row| (row.cycles, row.volume)).collect()),
    ] {
        let scene = wear_scene(&BALL, control, 1e4);
        let off = |resolution: usize| {
            let mut contact = contact(Parameters { resolution, ..scene.parameters.clone() });
            contact.start_at(scene.normal, 0.0).expect("the load is carried");
            let mut done = 0.0;
            let off = |(cycles, volume): &(f64, f64)| {
                contact.advance_cycles(scene.normal, scene.amplitude, (cycles - done) * 1e4).expect("cycles");
                done = *cycles;
                (contact.wear_volume() / scene.volume_unit() / volume - 1.0).abs()
            };
            table.iter().map(off).fold(0.0, f64::max)
        };
        let (usual, fine) = (off(64), off(128));
        println!("{control:?}: V on the way {usual:.1e}, with twice the cells {fine:.1e}");
        assert!(usual < 5e-4 && fine < 2.5e-4 && fine < 0.6 * usual, "{control:?}: {usual:e}, {fine:e}");
    }
}

/// Few cycles that wear as much as thousands: strokes are gathered on the profile of their start,
/// and their work is corrected by what their wear changes in it. Both begin at a first quarter.
#[test]
fn cycles_that_wear_fast_follow_whole_ones() {
    let off = |control: NormalControl, cycles: u32| {
        let scene = wear_scene(&BALL, control, 1.0);
        let life = 0.2;
        let wear_coefficient = scene.parameters.wear_coefficient * life / f64::from(cycles);
        let parameters = Parameters { wear_coefficient, ..scene.parameters.clone() };
        let pressed = || {
            let mut contact = contact(parameters.clone());
            contact.start_at(scene.normal, 0.0).expect("the load is carried");
            contact
        };
        let (mut whole, mut stepped) = (pressed(), pressed());
        whole.advance_cycles(scene.normal, scene.amplitude, 0.25).expect("a quarter");
        to(&mut stepped, scene.normal, scene.amplitude);
        let before = [whole.wear_volume(), stepped.wear_volume()];
        whole.advance_cycles(scene.normal, scene.amplitude, f64::from(cycles)).expect("cycles");
        for k in 1..=STEPS as u32 * cycles {
            let phase = std::f64::consts::TAU * f64::from(k) / STEPS as f64;
            to(&mut stepped, scene.normal, scene.amplitude * phase.cos());
        }
        (stepped.wear_volume() - before[1]) / (whole.wear_volume() - before[0]) - 1.0
    };
    for control in [Force, Indentation] {
        for cycles in [10, 40, 160] {
            let off = off(control, cycles);
            println!("{control:?}: stepping against cycles, {cycles}: {off:+.1e}");
            assert!(off.abs() < 5e-4, "{control:?}, {cycles} cycles: {off:e}");
        }
    }
}

/// A contact in gross slip over a path s with κ = kμ/σ₀ such that κE* s/length = S at s = `path`.
fn sliding(profile: Profile, length: f64, most: f64, path: f64) -> FrettingContact {
    let hardness = 8e9;
    let wear_coefficient = most * length / (E_STAR * path) / MU * hardness;
    started(Parameters { profile, wear_coefficient, hardness, ..Parameters::default() })
}

/// Under a flat punch all springs slip at once, at U = u_max; from there on V = κ F_N s.
#[test]
fn a_flat_punch_in_gross_slip_flattens_its_pressure_as_tabulated() {
    let b = 1e-4;
    let (most, path) = (2.0, 1e-3);
    let mut contact = sliding(PUNCH, b, most, path);
    let full = exact(&PUNCH, FORCE).full_slip();
    let mean = FORCE / (std::f64::consts::PI * b * b);
    let mut at = 0.0;
    for (s, ratio) in FLAT_PUNCH_GROSS_SLIP {
        let slid = s / most * path;
        in_steps(&mut contact, (FORCE, at), (FORCE, full + slid), 400);
        at = full + slid;
        let measured = contact.pressure_at(0.0) / mean;
        let per_path = contact.parameters().wear_per_work() * MU * FORCE;
        let volume = contact.wear_volume() / (per_path * slid) - 1.0;
        println!("punch at {s}: p(0)/mean {measured:.4}: {:+.2e}, V {volume:+.1e}", measured / ratio - 1.0);
        close_to(measured, ratio, 0.01, &format!("p(0) at {s}"));
        // integrated in time, as the pressure falls
        close(volume, 0.0, 1e-6, &format!("V at {s}"));
    }
    // the pressure of the rim is singular at first
    assert_volumes_agree(&contact, 0.02, "punch in gross slip");
}

/// A rim rounded by some nanometres wears like a sharp one, at any load.
#[test]
fn a_punch_with_a_sharp_rim_wears_like_a_flat_punch() {
    let b = 1e-4;
    let full = exact(&PUNCH, FORCE).full_slip();
    let worn = |profile: Profile, load: f64| {
        let mut contact = sliding(profile, b, 0.05, 2.0 * full);
        for (load, place) in [(load, 0.0), (0.0, 0.3), (load, 0.6), (load, -0.6), (load, 2.4)] {
            to(&mut contact, load, place * full);
        }
        (contact.wear_volume(), contact.tangential_force())
    };
    for load in [0.98, 0.99, 0.999, 1.0, 1.0001, 1.001, 1.01, 1.02].map(|share| share * FORCE) {
        let (volume, force) = worn(PUNCH, load);
        for radius in [1e-9, 1e-8] {
            let sharp = worn(Profile::RoundedPunch { radius, flat_radius: b }, load);
            close_to(sharp.0, volume, 2e-3, "V");
            close_to(sharp.1, force, 1e-4, "T");
        }
    }
}

/// Strokes, swings of load and many cycles of a sphere with a flat: at most a ring of 1e-2 to 1e-11
/// of the radius slips, until the load falls to nothing. k is 9e-5 to 10, more than that of any
/// material. Every load is followed, and what wears shows on the profile, except for what the
/// stability report allows: the tolerance times V + πa²d.
#[test]
fn a_sphere_with_a_flat_wears_at_any_load() {
    for (flat_radius, seed) in [3e-4, 1e-3, 3e-3, 1e-2].into_iter().flat_map(|b| [(b, 1e4), (b, 1e6)]) {
        let profile = Profile::BluntedSphere { radius: 0.01, flat_radius };
        for k in 0..20 {
            let load = FORCE * (1.0 + 1e-3 * f64::from(k));
            let start = exact(&profile, load);
            let disc = PI * start.normal.radius().powi(2) * start.normal.depth();
            let amplitude = 0.6 * start.full_slip();
            let wear_per_work = disc / (seed * MU * load * amplitude);
            let wear_coefficient = wear_per_work * Parameters::default().hardness;
            let mut contact =
                contact(Parameters { profile: profile.clone(), wear_coefficient, ..Parameters::default() });
            contact.start_at(load, 0.0).expect("it can be pressed");
            for (share, place) in [(1.0, 1.0), (1.0, -1.0), (0.5, 0.2), (1.2, 0.9), (0.0, 0.5), (1.0, 1.0)] {
                to(&mut contact, share * load, place * amplitude);
            }
            contact.advance_cycles(load, amplitude, 0.2 * seed).expect("the cycles are followed");
            to(&mut contact, load, 4.0 * amplitude);
            let missed = (contact.profile_volume() - contact.wear_volume()).abs();
            let what = format!("b = {flat_radius}, N0 = {seed}, {load} N, {wear_coefficient:e}: {missed:e}");
            assert!(missed <= 1e-3 * (contact.wear_volume() + disc), "{what}");
        }
    }
}

#[test]
fn a_sphere_in_gross_slip_wears_at_the_centre_as_tabulated() {
    let start = exact(&BALL, FORCE);
    let (a, d) = (start.normal.radius(), start.normal.depth());
    let (most, path) = (10.0, 10e-3);
    let mut contact = sliding(BALL, a, most, path);
    let full = start.full_slip();
    // up to full slip the springs dissipate as much as over a path of u_max/5, which counts
    to(&mut contact, FORCE, full);
    let lead = contact.dissipated_energy() / (MU * FORCE);
    close_to(lead, 0.2 * full, 1e-2, "path of the onset");
    let mut at = full;
    for (s, centre) in SPHERE_GROSS_SLIP {
        let slid = s / most * path;
        let next = full + slid - lead;
        in_steps(&mut contact, (FORCE, at), (FORCE, next), 400);
        at = next;
        let measured = contact.worn_depth_at(0.0) / d;
        let per_path = contact.parameters().wear_per_work() * MU * FORCE;
        let volume = contact.wear_volume() / (per_path * slid) - 1.0;
        println!("sphere at {s}: w0/d0 {measured:.4}: {:+.2e}, V {volume:+.1e}", measured / centre - 1.0);
        close_to(measured, centre, 0.01, &format!("central wear at {s}"));
        // while the pressure spreads, the springs give back some of their elastic energy: that of a
        // path of u_max/10
        close(volume, 0.0, 0.3 * full / slid, &format!("V at {s}"));
    }
    // the segment worn off; at S = 10 the law for late times is not yet exact
    let late = worn_flat_radius(0.01, contact.wear_volume());
    println!("late radius {:+.2e}", contact.contact_radius() / late - 1.0);
    close_to(contact.contact_radius(), late, 0.05, "a of the worn flat");
    assert_volumes_agree(&contact, 0.05, "sphere in gross slip");
}

/// Cycles in gross slip under a force that flatten a body far beyond its elastic depth: no cycle
/// works more than friction along its path, T is the limit of friction, and neither the cells nor
/// the calls matter, whatever the body. (Were the image of a body that is not linear in x² exact
/// beside that of its wear in lines, a cone would wear 5 % too much on 64 cells.)
#[test]
fn in_gross_slip_a_force_works_along_its_path_however_far_a_body_wears() {
    const FORCE: f64 = 100.0;
    const AMPLITUDE: f64 = 2e-5;
    let bodies = [
        Profile::Cone { slope: 0.02 },
        Profile::PowerLaw { exponent: 1.5, coefficient: 0.5 },
        Profile::PowerLaw { exponent: 4.0, coefficient: 1e9 },
        Profile::RoundedPunch { radius: 0.01, flat_radius: 1e-4 },
        Profile::BluntedSphere { radius: 0.01, flat_radius: 1e-4 },
    ];
    for profile in bodies {
        for cycles in [1e4, 1e6] {
            let share = |resolution: usize, tolerance: f64, calls: u32| {
                let parameters =
                    Parameters { profile: profile.clone(), resolution, tolerance, ..Parameters::default() };
                let path = 4.0 * AMPLITUDE * cycles;
                let limit = parameters.friction_coefficient * FORCE;
                let most = parameters.wear_per_work() * limit * path;
                let mut contact = FrettingContact::new(parameters).unwrap();
                for _ in 0..calls {
                    contact.advance_cycles(FORCE, AMPLITUDE, cycles / f64::from(calls)).unwrap();
                }
                close_to(contact.tangential_force(), limit, 1e-12, "T");
                contact.wear_volume() / most
            };
            let exact = share(128, 1e-4, 1);
            let off = [share(32, 1e-3, 1), share(64, 1e-3, 1), share(64, 1e-3, 10)].map(|v| v / exact - 1.0);
            println!("{profile:?}, {cycles:e}: {exact:.5} of the limit, off by {off:?}");
            assert!(exact < 1.0 && exact > 0.9);
            assert!(off[0].abs() < 3e-4 && off[1].abs() < 1e-4 && off[2].abs() < 1e-4, "{off:?}");
            // nearly 3/2, as the pressure ends like a root
            let [coarse, fine, exact] = [32, 64, 128].map(|resolution| share(resolution, 1e-5, 1));
            let order = ((coarse - fine) / (fine - exact)).log2();
            println!("order {order:.2}");
            assert!(order > 1.3, "{profile:?}, {cycles:e}: order {order}");
        }
    }
}

/// Slip that is the same everywhere wears where the pressure is high: far beyond its elastic depth
/// any body carries an even pressure, from the axis to near the edge.
#[test]
fn a_body_that_has_worn_far_in_gross_slip_carries_an_even_pressure() {
    for (profile, most) in [
        (BALL, 0.02),
        (Profile::Cone { slope: 0.02 }, 0.05),
        (Profile::PowerLaw { exponent: 4.0, coefficient: 1e9 }, 0.02),
        (Profile::RoundedPunch { radius: 0.01, flat_radius: 1e-4 }, 0.05),
        (Profile::BluntedSphere { radius: 0.01, flat_radius: 1e-4 }, 0.1),
    ] {
        let mut contact = FrettingContact::new(Parameters { profile, ..Parameters::default() }).unwrap();
        contact.advance_cycles(100.0, 2e-5, 1e6).unwrap();
        let a = contact.contact_radius();
        let mean = 100.0 / (PI * a * a);
        let off = |pressure: f64| (pressure / mean - 1.0).abs();
        // beside the nodes, too
        let worst =
            (0..500).map(|k| off(contact.pressure_at(0.9 * a * f64::from(k) / 500.0))).fold(0.0, f64::max);
        let (largest, traction) = (off(contact.max_pressure()), contact.shear_traction_at(0.3 * a));
        println!("{:?}: {worst:.4}, largest {largest:.4}", contact.parameters().profile);
        assert!(worst < most && largest < most, "{worst} {largest}");
        // springs take the image with what lines leave of the body between the nodes
        close_to(traction, MU * contact.pressure_at(0.3 * a), 0.04, "traction");
    }
}

#[test]
fn a_contact_that_sticks_makes_no_nodes_and_no_transforms() {
    // a flat punch sticks as a whole
    let full = exact(&PUNCH, FORCE).full_slip();
    let mut punch = started(Parameters { profile: PUNCH, ..Parameters::default() });
    for k in 0..200 {
        to(&mut punch, FORCE, 0.9 * full * f64::from(k % 9 - 4) / 4.0);
    }
    // a ball whose load rises along with its displacement sticks, too
    let mut ball = contact(Parameters { normal_control: Indentation, ..Parameters::default() });
    for k in 0..=100 {
        to(&mut ball, 3e-8 * f64::from(k), 0.5e-8 * f64::from(k));
    }
    for contact in [punch, ball] {
        let counters = contact.counters();
        assert_eq!(
            (counters.pressure_transforms, counters.transform_tables, counters.profile_updates),
            (0, 0, 0)
        );
        close(contact.wear_volume(), 0.0, 1e-33, "V");
        assert_eq!(contact.wear_depth(), 0.0);
        assert!(contact.probe_radii().iter().all(|r| contact.worn_depth_at(*r) == 0.0));
    }
}

#[test]
fn without_wear_there_is_no_transform_whatever_happens() {
    for (wear_coefficient, friction_coefficient) in [(0.0, MU), (3.2e-4, 0.0)] {
        let mut contact =
            contact(Parameters { wear_coefficient, friction_coefficient, ..Parameters::default() });
        let mut random = seeded(3);
        for _ in 0..300 {
            to(&mut contact, uniform(&mut random, -10.0, 100.0), uniform(&mut random, -5e-6, 5e-6));
        }
        contact.advance_cycles(50.0, 2e-6, 1e5).expect("cycles");
        let counters = contact.counters();
        let transforms = [
            counters.descent_transforms,
            counters.pressure_transforms,
            counters.transform_tables,
            counters.factorisations,
            counters.profile_updates,
        ];
        assert_eq!(transforms, [0; 5]);
        assert_eq!((contact.wear_volume(), contact.wear_depth(), contact.profile_volume()), (0.0, 0.0, 0.0));
        assert_eq!(contact.dissipated_energy() > 0.0, friction_coefficient > 0.0);
    }
}

/// Largest fall of the worn depth at any probe of a run, up to 95 % of the contact radius, in d₀.
/// Next to the contact edge of a profile that wears so fast the reading between two updates
/// oscillates from node to node, by up to a tenth of d₀ at some N₀.
fn largest_healing(
    (profile, seed_cycles): (&Profile, f64),
    steps: usize,
    mut next: impl FnMut(usize, &Problem) -> (f64, f64),
) -> f64 {
    let mut scene = wear_scene(profile, Force, seed_cycles);
    scene.parameters.resolution = 32;
    let mut contact = begun(&scene);
    let radii: Vec<f64> = (0..60).map(|k| 1.6 * scene.start.normal.radius() * f64::from(k) / 60.0).collect();
    let mut before = vec![0.0; radii.len()];
    let mut most: f64 = 0.0;
    for k in 1..=steps {
        let (normal, displacement) = next(k, &scene);
        to(&mut contact, normal, displacement);
        let most_radius = 0.95 * contact.contact_radius();
        for (r, before) in radii.iter().zip(&mut before).filter(|(r, _)| **r <= most_radius) {
            let now = contact.worn_depth_at(*r);
            most = most.max((*before - now) / scene.start.normal.depth());
            *before = now;
        }
    }
    most
}

/// Nothing heals but by what the profile takes back of an estimate: in a first stroke the depth
/// next to the contact edge is that of one update, which grows with the stroke, and later that of a
/// part of the cycle. One stroke here wears some d₀/80, a hundred times what a user's would.
/// At three of 480 values of N₀ from 30 to 54 it is more than 2e-3, 3.6e-3 at most, at the edge.
#[test]
fn wear_never_heals_at_any_probe() {
    for profile in [BALL, CONE] {
        let mut healing: Vec<f64> = (30..54)
            .map(|seed_cycles| {
                largest_healing((&profile, f64::from(seed_cycles)), 300, |k, scene| {
                    (scene.normal, scene.amplitude * (std::f64::consts::TAU * k as f64 / 20.0).sin())
                })
            })
            .collect();
        healing.sort_by(f64::total_cmp);
        println!("{profile:?}, constant load: heals {:.1e}, at most {:.1e} d0", healing[21], healing[23]);
        assert!(healing[21] <= 2e-3 && healing[23] <= 4e-3, "{profile:?}: {healing:?}");
        let mut random = seeded(11);
        let healing = largest_healing((&profile, 40.0), 60, |_, scene| {
            (uniform(&mut random, -0.1, 1.0) * FORCE, uniform(&mut random, -1.5, 1.5) * scene.amplitude)
        });
        println!("{profile:?}, random: heals {healing:.1e} d0");
        assert!(healing <= 5e-4, "{profile:?}: {healing:e}");
    }
}

/// Cycles of partial slip under a large load leave a wall at their stick radius. Long slides under
/// a load whose contact ends inside that do not wear there, nor take wear back. (An update of a
/// long slide left out the narrow cells of the wall: the depth fell by 13 % of the deepest, and
/// 1.8 % of the volume was lost.) The volume is within 6e-4 now.
#[test]
fn long_slides_keep_what_has_worn_outside_their_contact() {
    let full = |force: f64| exact(&BALL, force).full_slip();
    let (large, small) = (285.3, 69.15);
    let mut contact = contact(Parameters::default());
    contact.start_at(large, 0.0).unwrap();
    contact.advance_cycles(large, 0.5466 * full(large), 85_915.0).unwrap();
    let amplitude = 1.816 * full(small);
    contact.advance_cycles(small, amplitude, 87.67).unwrap();
    let depths =
        |contact: &FrettingContact| (0..400).map(|i| contact.worn_depth_at(f64::from(i) * 1e-6)).collect();
    let before: Vec<f64> = depths(&contact);
    for far in [true, false, true, false] {
        let place = amplitude + if far { 33.64 * full(small) } else { 0.0 };
        contact.advance_to(small, place).unwrap();
    }
    let after: Vec<f64> = depths(&contact);
    let healed = before.iter().zip(&after).map(|(before, after)| before - after).fold(0.0, f64::max);
    let (healed, off) =
        (healed / contact.wear_depth(), contact.profile_volume() / contact.wear_volume() - 1.0);
    println!("heals {healed:.1e} of the deepest, profile {off:+.1e}");
    assert!(healed < 2e-3 && off.abs() < 1e-3, "heals {healed:e}, profile {off:e}");
}

/// Apart, the worn profile stays to the bit; pressed again, the contact is the same as without
/// having been apart.
#[test]
fn contact_lost_and_found_keeps_the_worn_profile() {
    let scene = wear_scene(&BALL, Force, 100.0);
    let mut contact = begun(&scene);
    cycle(&scene, &mut contact, 30, STEPS);
    let probes: Vec<f64> = (0..50).map(|k| 4e-6 * f64::from(k)).collect();
    let depths = |c: &FrettingContact| probes.iter().map(|r| c.worn_depth_at(*r)).collect::<Vec<_>>();
    to(&mut contact, -5.0, 0.0);
    let (worn, volume) = (depths(&contact), contact.wear_volume());
    assert!(worn.iter().any(|w| *w > 0.0));
    for displacement in [1e-3, -1e-3, 0.0] {
        to(&mut contact, -5.0, displacement);
        assert_eq!((contact.wear_volume(), depths(&contact)), (volume, worn.clone()));
        assert_eq!(
            [contact.tangential_force(), contact.contact_radius(), contact.normal_reaction()],
            [0.0; 3]
        );
    }
    to(&mut contact, FORCE, 0.0);
    close(contact.tangential_force(), 0.0, 1e-12 * MU * FORCE, "pressed again at rest");
    assert_eq!((contact.wear_volume(), depths(&contact)), (volume, worn.clone()));
    let radius = contact.contact_radius();
    contact.start_at(FORCE, 3e-6).expect("the load is carried");
    // a new start takes off what was still to wear
    close_to(contact.wear_volume(), volume, 1e-5, "V");
    let deepest = contact.wear_depth();
    // 1.2e-5: between updates the profile is read to first order in what has worn since
    for (now, before) in depths(&contact).into_iter().zip(worn) {
        close(now, before, 2e-5 * deepest, "the worn depth");
    }
    close_to(contact.contact_radius(), radius, 1e-6, "a");
    close(contact.tangential_force(), 0.0, 1e-12 * MU * FORCE, "started again");
    // and it goes on wearing
    to(&mut contact, FORCE, 5e-6);
    assert!(contact.wear_volume() > volume);
}

/// Steps ten times smaller put the profile updates at other instants, each of which is good to the
/// tolerance of 1e-3.
#[test]
fn splitting_steps_changes_the_wear_within_the_tolerance() {
    for control in [Force, Indentation] {
        let scene = wear_scene(&BALL, control, 100.0);
        let (mut coarse, mut fine) = (begun(&scene), begun(&scene));
        cycle(&scene, &mut coarse, 30, 40);
        cycle(&scene, &mut fine, 30, 400);
        let off = coarse.wear_volume() / fine.wear_volume() - 1.0;
        println!(
            "{control:?}: 40 against 400 steps a cycle: V {off:+.1e}, depth {:+.1e}",
            coarse.wear_depth() / fine.wear_depth() - 1.0
        );
        assert!(off.abs() <= 1.5e-3, "{control:?}: {off:e}");
        let updates = (coarse.counters().profile_updates, fine.counters().profile_updates);
        println!("{control:?}: updates {updates:?}");
        assert!(
            updates.1 <= updates.0 + updates.0 / 3,
            "small steps must not cost more updates: {updates:?}"
        );
    }
}

/// Transient stepping and the cycle-averaged form are different code for the same law.
#[test]
fn whole_cycles_agree_with_plain_stepping() {
    for control in [Force, Indentation] {
        let scene = wear_scene(&CONE, control, 400.0);
        let (mut stepped, mut averaged) = (begun(&scene), begun(&scene));
        cycle(&scene, &mut stepped, 100, STEPS);
        averaged.advance_cycles(scene.normal, scene.amplitude, 100.0).expect("cycles");
        let off = stepped.wear_volume() / averaged.wear_volume() - 1.0;
        println!("{control:?}: stepping against cycles, V {off:+.1e}");
        assert!(off.abs() <= 1.5e-3, "{control:?}: {off:e}");
    }
}

/// Counted work of known scenes: a loss of efficiency fails here, without a clock.
#[test]
fn the_counted_work_stays_bounded() {
    let scene = wear_scene(&BALL, Indentation, LIFE as f64);
    let mut stepped = begun(&scene);
    cycle(&scene, &mut stepped, LIFE, STEPS);
    let counters = stepped.counters();
    println!("stepping: {counters}");
    assert_eq!(counters.steps, (LIFE * STEPS) as u64);
    // an update per half cycle, since here each wears more than the limit; four stages each, and
    // nothing on other nodes
    let updates = counters.profile_updates;
    assert!(updates <= 2 * LIFE as u64 + 20, "{counters}");
    assert!(counters.rejected_steps <= 10, "{counters}");
    assert_eq!(counters.factorisations, updates + counters.rejected_steps, "{counters}");
    assert_eq!(counters.pressure_transforms, 4 * counters.factorisations, "{counters}");
    assert!(counters.spring_walks <= counters.steps + 3 * updates, "{counters}");
    assert_eq!(counters.transform_tables, 0, "{counters}");
    let mut averaged = begun(&scene);
    averaged.advance_cycles(scene.normal, scene.amplitude, 9.0 * LIFE as f64).expect("cycles");
    let counters = averaged.counters();
    println!("cycles: {counters}");
    assert!(counters.rejected_steps <= 5, "{counters}");
    assert!(counters.factorisations <= 45, "{counters}");
    let steps = counters.profile_updates + counters.rejected_steps;
    assert!(counters.pressure_transforms <= 4 * steps, "{counters}");
    assert_eq!(counters.transform_tables, 0, "{counters}");
}

/// Steps far longer than the relaxation, at which the quadrature of the rate is all rounding.
#[test]
fn a_call_of_far_more_cycles_than_a_life_wears_no_more_than_it() {
    for profile in [BALL, CONE, ROUNDED] {
        let amplitude = 0.84 * exact(&profile, FORCE).full_slip();
        let volume = |cycles: f64| {
            let mut contact = started(Parameters { profile: profile.clone(), ..Parameters::default() });
            contact.advance_cycles(FORCE, amplitude, cycles).expect("the cycles are followed");
            contact.wear_volume()
        };
        for more in [1e8, 1e10, 1e12].map(|cycles| volume(cycles) / volume(1e9) - 1.0) {
            assert!(more.abs() < 1e-6, "{profile:?}: {more:e}");
        }
    }
}

/// One step that would wear many times the depth is refused; the contact is as it was and can be
/// moved on.
#[test]
fn a_step_that_wears_too_much_is_refused() {
    for control in [Force, Indentation] {
        let scene = wear_scene(&BALL, control, 0.02);
        let mut contact = begun(&scene);
        let before = state(&contact);
        let error = contact.advance_to(scene.normal, 5.0 * scene.amplitude).expect_err("it wears too much");
        assert!(matches!(error, Error::WearOutrun { .. }), "{control:?}: {error}");
        assert_eq!(state(&contact), before, "{control:?}");
        to(&mut contact, scene.normal, 1e-3 * scene.amplitude);
        assert!(contact.tangential_force() > 0.0);
    }
}

/// Strokes that wear so much that no two are alike, until a mesh can be made on what they have
/// left: at constant depth the stick circle does not move, and inside it nothing wears.
#[test]
fn a_new_mesh_wears_nothing_that_sticks() {
    let mut parameters = Parameters { normal_control: Indentation, ..Parameters::default() };
    parameters.wear_coefficient *= 5000.0;
    let Profile::Parabola { radius } = parameters.profile else { panic!("the default is a ball") };
    let depth = 3.5e-6;
    let edge = (radius * depth).sqrt();
    let amplitude = MU * E_STAR / G_STAR * depth * (1.0 - 0.4 * 0.4);
    let mut contact = FrettingContact::new(parameters).expect("valid");
    contact.start_at(depth, 0.0).expect("the load is carried");
    for stroke in 0..40 {
        for point in 1..=8 {
            let share = (PI * f64::from(point) / 8.0).cos() * if stroke % 2 == 0 { 1.0 } else { -1.0 };
            to(&mut contact, depth, share * amplitude);
        }
        close_to(contact.stick_radius(), 0.4 * edge, 1e-9, "stick radius");
        let worn_at = |share: f64| contact.worn_depth_at(share * edge * (1.0 - 1e-9));
        for share in [0.1, 0.3, 0.399] {
            assert_eq!(worn_at(share), 0.0, "stroke {stroke}, at {share}");
        }
        // at the end of the first stroke slip has gone further in than at the last update, and no
        // node stands at its edge yet
        let most = if stroke > 0 { 0.0 } else { 1e-5 * depth };
        assert!(worn_at(0.4) <= most, "stroke {stroke}: {:e}", worn_at(0.4));
    }
    assert!(contact.counters().factorisations > 0, "no mesh was made");
}

/// A load that is 0 but for rounding, as that of a sine, makes a contact that any slip wears off:
/// the step is followed as one of a body that is lifted off.
#[test]
fn a_body_that_is_lifted_off_but_for_rounding_may_be_moved() {
    for profile in [BALL, CONE] {
        for control in [NormalControl::Force, NormalControl::Indentation] {
            for y in [0.0, 1e-6] {
                let worn = |share: f64| {
                    let mut contact = contact(Parameters {
                        profile: profile.clone(),
                        normal_control: control,
                        ..Parameters::default()
                    });
                    let load = normal_input(&profile, control, FORCE);
                    contact.start_at(load, 0.0).unwrap();
                    for [normal, x] in [[1.0, 2.0], [share, 1.0], [share, -2.0], [1.0, -2.0], [1.0, 2.0]] {
                        contact.advance_to_planar(load * normal, [1e-6 * x, y * x]).unwrap();
                    }
                    contact.wear_volume()
                };
                for share in [1e-15, 1e-17, 1e-20] {
                    close_to(worn(share), worn(0.0), 1e-3, &format!("{profile:?}, {control:?}: V"));
                }
            }
        }
    }
}

/// A step that all but lifts the body off is one of few pieces: slip is over before the contact is
/// small.
#[test]
fn a_load_that_falls_to_next_to_nothing_takes_few_walks() {
    for profile in [BALL, ROUNDED] {
        let fallen = |load: f64| {
            let mut contact = started(Parameters { profile: profile.clone(), ..Parameters::default() });
            to(&mut contact, FORCE, 2e-6);
            let walks = contact.counters().spring_walks;
            to(&mut contact, load, -1e-6);
            (contact.counters().spring_walks - walks, contact.wear_volume())
        };
        let (walks, volume) = fallen(0.0);
        for load in [1e-6, 1e-12] {
            let near = fallen(load);
            assert!(near.0 <= 2 * walks, "{profile:?}, {load:e} N: {} walks, {walks} to 0 N", near.0);
            close_to(near.1, volume, 3e-3, "worn volume");
        }
    }
}

/// Held in depth, a mesh over all of the contact changes its load by no more than wears, and
/// friction its limit: it was 2e-4 off for a cone and a blunted sphere, whatever had worn.
#[test]
fn a_mesh_in_gross_slip_keeps_the_load_of_its_depth() {
    for profile in analytic() {
        let exact = exact(&profile, FORCE);
        let parameters =
            Parameters { profile: profile.clone(), normal_control: Indentation, ..Parameters::default() };
        let mut contact = contact(parameters);
        let depth = exact.normal.depth();
        contact.start_at(depth, 0.0).expect("the depth is taken");
        contact.advance_cycles(depth, 2.0 * exact.full_slip(), 1e-9).expect("the cycles are followed");
        close_to(contact.normal_reaction(), FORCE, 1e-9, &format!("{profile:?}: F"));
        close_to(contact.tangential_force(), MU * FORCE, 1e-9, &format!("{profile:?}: T"));
    }
}
