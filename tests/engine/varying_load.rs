//! Normal load and displacement that vary together: the exact rules, random histories against a
//! plain row of springs, and a sweep over six decades of load. No wear here.

use crate::common::{self, *};
use fretting_contact::reference::PlainSpringRow;
use fretting_contact::reference::tangential::oblique_rise;
use fretting_contact::{FrettingContact, NormalControl, Parameters, Profile};
use rand::rngs::StdRng;

/// Largest force of the random histories, N, and μ times it.
const MOST: f64 = 100.0;
const LIMIT: f64 = MU * MOST;

/// A rising load leaves every spring where it is: not even a rounding error of T.
#[test]
fn a_rising_load_at_rest_leaves_the_tangential_force() {
    for profile in analytic() {
        let exact = exact(&profile, 20.0);
        let mut contact = pressed(profile.clone(), 20.0);
        to(&mut contact, 20.0, 0.8 * exact.full_slip());
        to(&mut contact, 20.0, -0.1 * exact.full_slip());
        let (force, work) = (contact.tangential_force(), contact.dissipated_energy());
        for normal in [20.001, 25.0, 400.0] {
            to(&mut contact, normal, -0.1 * exact.full_slip());
            close(
                contact.tangential_force(),
                force,
                1e-12 * MU * 20.0,
                &format!("{profile:?} at {normal} N"),
            );
            assert_eq!(contact.dissipated_energy(), work, "{profile:?} at {normal} N");
        }
    }
}

/// A falling load clips the springs to what first loading at the lower load gives: ± rounding.
#[test]
fn a_falling_load_at_rest_leaves_what_first_loading_gives() {
    for profile in analytic() {
        for theta in [0.4, 0.9, 1.3] {
            let u = theta * exact(&profile, MOST).full_slip();
            let mut contact = pressed(profile.clone(), MOST);
            to(&mut contact, MOST, u);
            let mut work = contact.dissipated_energy();
            for normal in [70.0, 69.99, 30.0, 1.0, 1e-3] {
                to(&mut contact, normal, u);
                let expected = exact(&profile, normal).loading(u);
                let what = format!("{profile:?}, {theta} at {normal} N");
                close(contact.tangential_force(), expected, 1e-9 * MU * normal, &what);
                assert!(contact.dissipated_energy() >= work, "{what}: the springs slip back");
                work = contact.dissipated_energy();
            }
        }
    }
}

/// U and d rise together on a straight line: no spring slips up to dU/dd = μE*/G*, beyond that all
/// do, whatever state it starts from. Under indentation control that is one step, exact to
/// rounding.
#[test]
fn an_oblique_rise_of_depth_and_displacement_slips_beyond_the_slip_ratio_only() {
    for profile in analytic() {
        let depth = exact(&profile, MOST).normal.depth();
        let slip_ratio = MU * E_STAR / G_STAR;
        for share in [0.3, 0.999] {
            let parameters =
                Parameters { normal_control: NormalControl::Indentation, ..without_wear(profile.clone()) };
            // from first touch, and from a state in partial slip
            for (start, prestress) in [(0.0, 0.0), (0.4 * depth, 0.5), (0.4 * depth, -0.9)] {
                let mut contact = contact(parameters.clone());
                to(&mut contact, start, 0.0);
                let shift = prestress * slip_ratio * start;
                to(&mut contact, start, shift);
                let (t, f, w) =
                    (contact.tangential_force(), contact.normal_reaction(), contact.dissipated_energy());
                for part in [0.1, 0.5, 1.0] {
                    let d = start + part * (depth - start);
                    to(&mut contact, d, shift + share * slip_ratio * (d - start));
                    let rise =
                        oblique_rise(share * slip_ratio, G_STAR, E_STAR, contact.normal_reaction() - f);
                    let what = format!("{profile:?}, {share}, {prestress}, {part}");
                    close(contact.tangential_force(), t + rise, 1e-9 * LIMIT, &what);
                    close(contact.dissipated_energy(), w, 1e-12 * LIMIT * slip_ratio * depth, &what);
                }
            }
        }
        let parameters =
            Parameters { normal_control: NormalControl::Indentation, ..without_wear(profile.clone()) };
        let mut contact = contact(parameters);
        to(&mut contact, depth, 1.5 * slip_ratio * depth);
        let limit = MU * contact.normal_reaction();
        close(contact.tangential_force(), limit, 1e-9 * limit, "beyond the slip ratio everything slips");
        assert!(contact.dissipated_energy() > 1e-3 * limit * slip_ratio * depth);
    }
}

/// One point of a random history: N or m, and m.
type Point = (f64, f64);

/// A random history of a profile: forces up to 100 N, sometimes none or a pull; displacements into
/// gross slip; some lines change one of the two only.
struct History {
    profile: Profile,
    control: NormalControl,
    points: Vec<Point>,
}

impl History {
    fn random(index: u64) -> Self {
        let mut random = seeded(1000 + index);
        let profiles = analytic();
        let profile = profiles[index as usize % profiles.len()].clone();
        let control = if index % 3 == 2 { NormalControl::Indentation } else { NormalControl::Force };
        let full = exact(&profile, MOST).full_slip();
        let mut points = vec![(Self::normal(&profile, control, &mut random), 0.0)];
        for _ in 0..12 {
            let (normal, displacement) = points[points.len() - 1];
            let next = (Self::normal(&profile, control, &mut random), uniform(&mut random, -1.2, 1.2) * full);
            points.push(match uniform(&mut random, 0.0, 1.0) {
                chance if chance < 0.2 => (normal, next.1),
                chance if chance < 0.4 => (next.0, displacement),
                _ => next,
            });
        }
        Self { profile, control, points }
    }

    fn normal(profile: &Profile, control: NormalControl, random: &mut StdRng) -> f64 {
        let force = match uniform(random, 0.0, 1.0) {
            chance if chance < 0.08 => 0.0,
            chance if chance < 0.16 => -20.0,
            chance if chance < 0.3 => 10f64.powf(uniform(random, -3.0, 2.0)),
            _ => uniform(random, 0.0, MOST),
        };
        normal_input(profile, control, force)
    }

    fn contact(&self) -> FrettingContact {
        contact(Parameters { normal_control: self.control, ..without_wear(self.profile.clone()) })
    }

    fn row(&self, springs: usize) -> PlainSpringRow {
        let length = match self.profile {
            Profile::FlatPunch { flat_radius } => flat_radius,
            _ => 1.037 * exact(&self.profile, MOST).normal.radius(),
        };
        PlainSpringRow::under(shape(&self.profile), length, springs, E_STAR, G_STAR, MU)
    }

    fn advance(&self, row: &mut PlainSpringRow, (normal, displacement): Point, substeps: usize) {
        match self.control {
            NormalControl::Force => row.advance(normal, displacement, substeps),
            NormalControl::Indentation => row.advance_at_depth(normal, displacement, substeps),
        }
    }
}

/// The row gives T to about 1e-7 (order 2 in the spacing); what the engine is off by is the
/// sampling of springs that touch while the body moves (64 cells): 1e-5 at worst, where 1e-3 would
/// do.
#[test]
fn random_histories_agree_with_a_plain_row_of_springs() {
    let mut worst: f64 = 0.0;
    let (mut parted, mut slid) = (0, 0);
    for index in 0..200 {
        let history = History::random(index);
        let (mut contact, mut row) = (history.contact(), history.row(100_000));
        let mut work = 0.0;
        for &point in &history.points {
            to(&mut contact, point.0, point.1);
            history.advance(&mut row, point, 1);
            let force = contact.tangential_force();
            let error = (force - row.tangential_force()).abs() / LIMIT;
            worst = worst.max(error);
            assert!(error <= 1e-3, "history {index} of {:?} at {point:?}: off by {error:e}", history.profile);
            let limit = contact.parameters().friction_coefficient * contact.normal_reaction();
            assert!(force.abs() <= limit, "history {index}: {force} above {limit}");
            assert!(contact.stick_radius() <= contact.contact_radius());
            assert!(contact.dissipated_energy() >= work, "history {index}: work falls");
            work = contact.dissipated_energy();
            parted += u32::from(contact.contact_radius() == 0.0);
            slid += u32::from(limit > 0.0 && force.abs() == limit);
        }
    }
    println!(
        "worst error of T over mu F_N,max in 200 histories: {worst:e}; apart {parted}, sliding {slid} times"
    );
    assert!(parted > 100 && slid > 100, "the histories reach everywhere: {parted}, {slid}");
    assert!(worst <= 3e-5, "{worst:e}");
}

/// The row's work needs sub-steps (its error falls with their square), 400 here.
#[test]
fn the_work_of_random_histories_agrees_with_a_plain_row() {
    let mut worst: f64 = 0.0;
    for index in 0..24 {
        let history = History::random(index);
        let (mut contact, mut row) = (history.contact(), history.row(10_000));
        for &point in &history.points {
            to(&mut contact, point.0, point.1);
            history.advance(&mut row, point, 400);
        }
        let error = contact.dissipated_energy() / row.friction_work() - 1.0;
        worst = worst.max(error.abs());
    }
    println!("worst relative error of the work: {worst:e}");
    assert!(worst <= 2e-4, "{worst:e}");
}

/// Each line in one step, and in seven.
#[test]
fn splitting_the_lines_of_random_histories_changes_next_to_nothing() {
    let (mut force_off, mut work_off): (f64, f64) = (0.0, 0.0);
    for index in 0..60 {
        let history = History::random(index);
        let (mut whole, mut split) = (history.contact(), history.contact());
        let mut from = (0.0, 0.0);
        for &point in &history.points {
            to(&mut whole, point.0, point.1);
            in_steps(&mut split, from, point, 7);
            from = point;
            let off = (whole.tangential_force() - split.tangential_force()).abs() / LIMIT;
            force_off = force_off.max(off);
        }
        work_off = work_off.max((split.dissipated_energy() / whole.dissipated_energy() - 1.0).abs());
    }
    println!("split in seven: T off by {force_off:e} of mu F_N,max, work by {work_off:e}");
    assert!(force_off <= 1e-5, "{force_off:e}");
    assert!(work_off <= 3e-4, "{work_off:e}");
}

/// Where no spring touches while the body moves there is nothing to sample: lines of falling or
/// constant load may be split to rounding.
#[test]
fn lines_of_falling_load_may_be_split_to_rounding() {
    for profile in analytic() {
        let full = exact(&profile, MOST).full_slip();
        let (mut whole, mut split) = (pressed(profile.clone(), MOST), pressed(profile.clone(), MOST));
        let mut from = (MOST, 0.0);
        for point in [(100.0, 0.7), (80.0, 0.1), (79.0, -0.6), (30.0, 0.2), (30.0, -0.1), (2.0, 0.01)] {
            let point = (point.0, point.1 * full);
            to(&mut whole, point.0, point.1);
            in_steps(&mut split, from, point, 13);
            from = point;
            let what = format!("{profile:?} at {point:?}");
            close(split.tangential_force(), whole.tangential_force(), 1e-12 * LIMIT, &what);
        }
    }
}

/// One run from 1 mN to 1 kN and back. Going up, T starts each decade from what it was, and what
/// slips had not been in contact at the decade below: T = T_before + loading. Going down, a stroke
/// of gross slip makes the state known; the way back is Masing's. Either to rounding, at every
/// point of the loop.
#[test]
fn a_sweep_over_six_decades_of_load_keeps_its_digits() {
    let mut worst: f64 = 0.0;
    for profile in [BALL, CONE, BLUNTED] {
        let decades: Vec<f64> = (-3..=3).map(|decade| 10f64.powi(decade)).collect();
        let mut contact = pressed(profile.clone(), decades[0]);
        let mut check = |contact: &FrettingContact, expected: f64, force: f64| {
            let error = (contact.tangential_force() - expected).abs() / (MU * force);
            worst = worst.max(error);
            assert!(error <= 1e-3, "{profile:?} at {force} N: {error:e}");
        };
        for &force in &decades {
            to(&mut contact, force, 0.0);
            let exact = exact(&profile, force);
            let before = contact.tangential_force();
            // the springs outside the front of 0.5 u_max have touched since, unstressed, but under
            // a flat tip
            let reversal = 0.5 * exact.full_slip();
            let fresh = exact.stick_radius(reversal) > common::exact(&profile, 0.1 * force).normal.radius();
            for k in 1..=8 {
                to(&mut contact, force, reversal * f64::from(k) / 8.0);
                if fresh {
                    check(&contact, before + exact.loading(contact.displacement()), force);
                }
            }
            for k in (-8..8).rev() {
                to(&mut contact, force, reversal * f64::from(k) / 8.0);
                if fresh {
                    check(&contact, before + exact.returning(reversal, contact.displacement()), force);
                }
            }
            to(&mut contact, force, 0.0);
        }
        for &force in decades.iter().rev() {
            let start = contact.displacement();
            to(&mut contact, force, start);
            let exact = exact(&profile, force);
            let full = exact.full_slip();
            to(&mut contact, force, start + 3.0 * full);
            check(&contact, MU * force, force);
            for k in 0..16 {
                let back = f64::from(k) / 8.0 * full;
                to(&mut contact, force, start + 3.0 * full - back);
                check(&contact, exact.returning(2.0 * full, 2.0 * full - back), force);
            }
        }
    }
    println!("worst error of T over mu F_N in the sweep: {worst:e}");
    assert!(worst <= 1e-9, "{worst:e}");
}

/// A twentieth of the smallest load is 0, and so is a part of the smallest radius: neither may ask
/// for endless steps.
#[test]
fn the_smallest_loads_and_radii_take_no_more_steps_than_others() {
    let most = |control: NormalControl, loads: &[f64]| {
        let parameters = Parameters {
            profile: Profile::Cone { slope: 0.02 },
            wear_coefficient: 0.0,
            normal_control: control,
            ..Parameters::default()
        };
        let mut contact = FrettingContact::new(parameters).unwrap();
        contact.start_at(0.0, 0.0).unwrap();
        for (k, &load) in loads.iter().enumerate() {
            contact.advance_to(load, 1e-320 * (k % 2) as f64).unwrap();
        }
        assert!(contact.counters().spring_walks <= 20 * loads.len() as u64 + 20, "{}", contact.counters());
    };
    let smallest = f64::from_bits(1);
    most(NormalControl::Indentation, &[smallest, 3.0 * smallest, smallest, 7.0 * smallest, 0.0]);
    let light = 1e-312; // N; over 2E* it is of the smallest numbers
    most(NormalControl::Force, &[light, 3.0 * light, light, 7.0 * light, 0.0]);
}
