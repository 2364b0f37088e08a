//! Tangential loading at constant normal load: loops, their work, fronts, stiffness and tractions.
//!
//! Between its knots the spring row is exact, so that under a constant load there is no
//! discretisation error whose order could be observed: forces are asserted to rounding, at the
//! coarsest resolution as at a fine one. An order shows only where springs touch while the body
//! moves, and is asserted there.

use crate::common::*;
use fretting_contact::reference::tangential::sphere_traction;
use fretting_contact::reference::{MonomialContact, PlainSpringRow};
use fretting_contact::{FrettingContact, Parameters, Profile, SlipState};
use std::f64::consts::TAU;

/// μF_N of the usual scene, N.
const LIMIT: f64 = MU * FORCE;

fn at_resolution(profile: &Profile, resolution: usize) -> FrettingContact {
    started(Parameters { resolution, ..without_wear(profile.clone()) })
}

/// Rounding only: 1e-9 of μF_N, where 1e-4 would do.
#[test]
fn loading_and_return_follow_the_closed_forms_at_any_resolution() {
    for profile in analytic() {
        let exact = exact(&profile, FORCE);
        for resolution in [8, 512] {
            for theta in [0.25, 0.5, 0.75, 0.95, 1.0, 1.5] {
                let mut contact = at_resolution(&profile, resolution);
                let reversal = theta * exact.full_slip();
                for k in 1..=20 {
                    let u = reversal * f64::from(k) / 20.0;
                    to(&mut contact, FORCE, u);
                    close(
                        contact.tangential_force(),
                        exact.loading(u),
                        1e-9 * LIMIT,
                        &format!("{profile:?} up {u}"),
                    );
                }
                for k in (-20..20).rev() {
                    let u = reversal * f64::from(k) / 20.0;
                    to(&mut contact, FORCE, u);
                    let back = exact.returning(reversal, u);
                    close(contact.tangential_force(), back, 1e-9 * LIMIT, &format!("{profile:?} down {u}"));
                }
                for k in -19..=20 {
                    let u = reversal * f64::from(k) / 20.0;
                    to(&mut contact, FORCE, u);
                    let again = -exact.returning(reversal, -u);
                    close(contact.tangential_force(), again, 1e-9 * LIMIT, &format!("{profile:?} again {u}"));
                }
            }
        }
    }
}

/// T = 2G*aU, to the last digits, for motions that the friction bound does not know from none: the
/// front then lies nearer to the contact edge than doubles tell.
#[test]
fn motions_far_below_full_slip_are_elastic() {
    for profile in analytic() {
        for wear_coefficient in [0.0, 1e-4] {
            let full = exact(&profile, FORCE).full_slip();
            for share in [1e-10, 1e-13, 1e-15, 3e-16, 1e-17, 1e-30, 1e-200] {
                let parameters = Parameters { wear_coefficient, ..without_wear(profile.clone()) };
                let stiffness = 2.0 * parameters.materials.tangential_modulus();
                let mut contact = started(parameters);
                for place in [1.0, -1.0, 0.5] {
                    let u = place * share * full;
                    to(&mut contact, FORCE, u);
                    let elastic = stiffness * contact.contact_radius() * u;
                    let what = format!("{profile:?}, wear {wear_coefficient:e}, {u:e} m");
                    // on the way back the rounding of the bound shows, 1e-16 of μF_N
                    let rounding = if place == 1.0 { 0.0 } else { 1e-15 * LIMIT };
                    close(contact.tangential_force(), elastic, 1e-8 * elastic.abs() + rounding, &what);
                }
            }
        }
    }
}

/// Steel on steel in six digits.
#[test]
fn the_steel_ball_gives_the_tabulated_numbers() {
    let full = exact(&BALL, FORCE).full_slip();
    for (theta, force, work) in [
        (0.25, 21.0289, 1.27356e-6),
        (0.5, 38.7868, 11.0828e-6),
        (0.75, 52.5, 41.8696e-6),
        (1.0, 60.0, 121.802e-6),
    ] {
        let mut contact = pressed(BALL, FORCE);
        to(&mut contact, FORCE, theta * full);
        close_to(contact.tangential_force(), force, 5e-6, "T0");
        let first = contact.dissipated_energy();
        to(&mut contact, FORCE, -theta * full);
        to(&mut contact, FORCE, theta * full);
        close_to(contact.dissipated_energy() - first, work, 5e-6, "W");
    }
}

/// A step may be split at will: the row after a thousand small steps is that after one, to
/// rounding.
#[test]
fn splitting_steps_changes_nothing() {
    for profile in analytic() {
        let full = exact(&profile, FORCE).full_slip();
        let (mut whole, mut split) = (pressed(profile.clone(), FORCE), pressed(profile.clone(), FORCE));
        let mut from = 0.0;
        for theta in [0.8, -0.3, 0.5, -0.9, 1.4, 0.2] {
            let target = theta * full;
            to(&mut whole, FORCE, target);
            in_steps(&mut split, (FORCE, from), (FORCE, target), 1000);
            from = target;
            let what = format!("{profile:?} at {theta}");
            close(split.tangential_force(), whole.tangential_force(), 1e-12 * LIMIT, &what);
            // each small work is a small difference of large moments
            close_to(split.dissipated_energy(), whole.dissipated_energy(), 1e-9, &what);
            close(split.stick_radius(), whole.stick_radius(), 1e-9 * whole.contact_radius(), &what);
        }
    }
}

#[test]
fn the_loop_work_is_the_closed_one() {
    for profile in analytic() {
        let exact = exact(&profile, FORCE);
        for theta in [0.25, 0.5, 0.75, 1.0, 1.5] {
            let u = theta * exact.full_slip();
            let work = match profile {
                Profile::Parabola { .. }
                | Profile::Cone { .. }
                | Profile::PowerLaw { .. }
                | Profile::FlatPunch { .. } => MonomialContact::new(&exact.normal, G_STAR, MU).loop_work(u),
                _ => exact.loop_work(u),
            };
            for resolution in [8, 512] {
                let mut contact = at_resolution(&profile, resolution);
                to(&mut contact, FORCE, u);
                // a small loop under a flat dissipates next to nothing: there the scale is that of
                // full slip
                let allowed = 1e-9 * work + 1e-14 * LIMIT * exact.full_slip();
                close(
                    contact.dissipated_energy(),
                    work / 4.0,
                    allowed,
                    &format!("{profile:?}, {theta}: quarter"),
                );
                to(&mut contact, FORCE, -u);
                to(&mut contact, FORCE, u);
                close(
                    contact.dissipated_energy(),
                    1.25 * work,
                    allowed,
                    &format!("{profile:?}, {theta}: loop"),
                );
            }
        }
    }
}

/// The slip ring of a wide flat is thin: there the image rises like the root of the distance from
/// the rim, in an interval far narrower than its radius. (Taken for linear in x², the work of a
/// whole stroke was up to 45 % too large.)
#[test]
fn the_loop_work_of_a_thin_ring_around_a_flat_is_the_closed_one() {
    let blunted = Profile::BluntedSphere { radius: 0.01, flat_radius: 1e-3 };
    let rounded = Profile::RoundedPunch { radius: 0.05, flat_radius: 3e-3 };
    for (profile, force) in [(&blunted, 100.0), (&blunted, 500.0), (&blunted, 5000.0), (&rounded, 50.0)] {
        let exact = exact(profile, force);
        for theta in [0.05, 0.3, 0.7, 0.95, 1.5] {
            let amplitude = theta * exact.full_slip();
            let work = exact.loop_work(amplitude);
            let mut contact = at_resolution(profile, 64);
            to(&mut contact, force, 0.0);
            to(&mut contact, force, amplitude);
            let before = contact.dissipated_energy();
            to(&mut contact, force, -amplitude);
            to(&mut contact, force, amplitude);
            let off = (contact.dissipated_energy() - before) / work - 1.0;
            let ring = exact.normal.radius() / exact.normal.shape().flat_radius() - 1.0;
            println!("{profile:?}, {force} N, {theta}: ring of {ring:.1e}, work {off:+.1e}");
            assert!(off.abs() < 2e-6, "{profile:?}, {force} N, {theta}: {off:e}");
        }
    }
}

#[test]
fn fronts_stand_where_the_closed_forms_put_them() {
    for profile in analytic() {
        let exact = exact(&profile, FORCE);
        let a = exact.normal.radius();
        let mut contact = pressed(profile.clone(), FORCE);
        for theta in [0.1, 0.3, 0.6, 0.9, 0.99] {
            let u = theta * exact.full_slip();
            to(&mut contact, FORCE, u);
            close(
                contact.stick_radius(),
                exact.stick_radius(u),
                1e-9 * a,
                &format!("{profile:?} c at {theta}"),
            );
        }
        let reversal = 0.99 * exact.full_slip();
        for theta in [0.9, 0.5, 0.0, -0.6, -0.9] {
            let u = theta * exact.full_slip();
            to(&mut contact, FORCE, u);
            let front = exact.stick_radius(0.5 * (reversal - u));
            close(contact.stick_radius(), front, 1e-9 * a, &format!("{profile:?} c back at {theta}"));
        }
        to(&mut contact, FORCE, -1.2 * exact.full_slip());
        assert_eq!(contact.stick_radius(), 0.0);
    }
}

/// ∂T/∂U = 2G*c, and a difference quotient over 1e-6 u_max, whose own error is of that order near
/// full slip.
#[test]
fn the_stiffness_is_that_of_the_closed_form_and_of_differences() {
    for profile in analytic() {
        let exact = exact(&profile, FORCE);
        let full = exact.full_slip();
        let most = 2.0 * G_STAR * exact.normal.radius();
        let mut contact = pressed(profile.clone(), FORCE);
        close_to(contact.tangential_stiffness(), most, 1e-9, &format!("{profile:?} at rest"));
        for theta in [0.2, 0.5, 0.8] {
            to(&mut contact, FORCE, theta * full);
            let stiffness = contact.tangential_stiffness();
            close(stiffness, exact.stiffness(theta * full), 1e-9 * most, &format!("{profile:?} at {theta}"));
            let mut next = contact.clone();
            let step = 1e-6 * full;
            to(&mut next, FORCE, theta * full + step);
            let quotient = (next.tangential_force() - contact.tangential_force()) / step;
            close(stiffness, quotient, 2e-5 * most, &format!("{profile:?} at {theta}, difference"));
        }
        // going back, everything sticks at first
        to(&mut contact, FORCE, 0.3 * full);
        let stuck = exact.stiffness(0.5 * (0.8 - 0.3) * full);
        close(contact.tangential_stiffness(), stuck, 1e-9 * most, &format!("{profile:?} back"));
        to(&mut contact, FORCE, -1.5 * full);
        assert_eq!(contact.tangential_stiffness(), 0.0, "{profile:?} in gross slip");
    }
}

#[test]
fn the_slip_state_names_what_happens() {
    let full = exact(&BALL, FORCE).full_slip();
    let mut ball = contact(without_wear(BALL));
    assert_eq!(ball.slip_state(), SlipState::Separated);
    for (force, displacement, state) in [
        (FORCE, 0.0, SlipState::Stick),
        (FORCE, 0.01 * full, SlipState::PartialSlip),
        (FORCE, 0.99 * full, SlipState::PartialSlip),
        (FORCE, 1.01 * full, SlipState::GrossSlip),
        (FORCE, 0.5 * full, SlipState::PartialSlip),
        (FORCE, -0.98 * full, SlipState::PartialSlip),
        (FORCE, -1.02 * full, SlipState::GrossSlip),
        (0.0, -1.02 * full, SlipState::Separated),
        (FORCE, -1.02 * full, SlipState::Stick),
    ] {
        to(&mut ball, force, displacement);
        assert_eq!(ball.slip_state(), state, "{force} N, {displacement} m");
    }
    // a flat punch sticks as a whole until it slips as a whole
    let full = exact(&PUNCH, FORCE).full_slip();
    let mut punch = pressed(PUNCH, FORCE);
    for (displacement, state) in [
        (0.0, SlipState::Stick),
        (0.5 * full, SlipState::Stick),
        (0.999 * full, SlipState::Stick),
        (1.001 * full, SlipState::GrossSlip),
        (0.5 * full, SlipState::Stick),
        (-0.998 * full, SlipState::Stick),
        (-1.002 * full, SlipState::GrossSlip),
    ] {
        to(&mut punch, FORCE, displacement);
        assert_eq!(punch.slip_state(), state, "{displacement} m");
    }
}

/// T after any sequence of displacements by Masing's rules: each reversal starts a branch of twice
/// the size, and a branch that passes the reversal before it wipes out both.
struct Masing {
    reversals: Vec<f64>,
}

impl Masing {
    fn force(&mut self, displacement: f64, loading: impl Fn(f64) -> f64) -> f64 {
        // wipe out what this movement passes; the first branch, from rest, is passed at the mirror
        // image of its end
        loop {
            match self.reversals[..] {
                [.., before, last] if (displacement - before) * (before - last) >= 0.0 => {
                    self.reversals.truncate(self.reversals.len() - 2);
                }
                [first] if displacement.abs() >= first.abs() => self.reversals.clear(),
                _ => break,
            }
        }
        let mut force = self.reversals.first().map_or(0.0, |first| loading(*first));
        let points: Vec<f64> = self.reversals.iter().copied().chain([displacement]).collect();
        if points.len() == 1 {
            force = loading(displacement);
        }
        for pair in points.windows(2) {
            force += 2.0 * loading(0.5 * (pair[1] - pair[0]));
        }
        self.reversals.push(displacement);
        force
    }
}

/// 300 random turning points for each profile: nested loops of all depths, closed in any order.
#[test]
fn nested_loops_remember_their_turning_points() {
    let mut random = seeded(7);
    for profile in analytic() {
        let exact = exact(&profile, FORCE);
        let mut contact = pressed(profile.clone(), FORCE);
        let mut masing = Masing { reversals: Vec::new() };
        let mut at: f64 = 0.0;
        for n in 0..300 {
            // up and down in turns, so that each point is a reversal; some reach into gross slip
            let reach = if n % 40 < 2 { 1.3 } else { 0.9 };
            at = if n % 2 == 0 {
                uniform(&mut random, at, at.max(reach) + 0.01)
            } else {
                uniform(&mut random, at.min(-reach) - 0.01, at)
            };
            to(&mut contact, FORCE, at * exact.full_slip());
            let expected = masing.force(at * exact.full_slip(), |u| exact.loading(u));
            close(contact.tangential_force(), expected, 1e-9 * LIMIT, &format!("{profile:?}, point {n}"));
        }
    }
}

/// A loop inside a loop, closed: the outer branch goes on as though it had never been left.
#[test]
fn a_closed_minor_loop_leaves_no_trace() {
    for profile in analytic() {
        let full = exact(&profile, FORCE).full_slip();
        let (mut with, mut without) = (pressed(profile.clone(), FORCE), pressed(profile.clone(), FORCE));
        for theta in [0.9, -0.2] {
            to(&mut with, FORCE, theta * full);
            to(&mut without, FORCE, theta * full);
        }
        for theta in [0.5, 0.1, 0.4, 0.1, 0.5, -0.2] {
            to(&mut with, FORCE, theta * full);
        }
        close(with.tangential_force(), without.tangential_force(), 1e-12 * LIMIT, "at the point of return");
        for theta in [-0.5, -0.9, 0.3] {
            to(&mut with, FORCE, theta * full);
            to(&mut without, FORCE, theta * full);
            close(
                with.tangential_force(),
                without.tangential_force(),
                1e-12 * LIMIT,
                &format!("{profile:?} {theta}"),
            );
        }
        assert!(with.dissipated_energy() >= without.dissipated_energy());
    }
}

/// Cattaneo and Mindlin's traction under the sphere, and μ [p(r; a) − p(r; c)] under the others.
/// 1e-9 of the largest mean pressure: only rounding and quadrature are left.
#[test]
fn the_traction_is_cattaneos_and_mindlins() {
    for theta in [0.3, 0.7, 0.95] {
        for profile in analytic().into_iter().filter(|p| !matches!(p, Profile::FlatPunch { .. })) {
            let exact = exact(&profile, FORCE);
            let (a, u) = (exact.normal.radius(), theta * exact.full_slip());
            let mut contact = pressed(profile.clone(), FORCE);
            to(&mut contact, FORCE, u);
            let c = exact.stick_radius(u);
            for share in [0.07, 0.2, 0.4, 0.66, 0.83, 0.97] {
                let r = share * a;
                let scale = MU * exact.normal.mean_pressure();
                let what = format!("{profile:?}, {theta}, r = {share} a");
                close(contact.shear_traction_at(r), exact.traction(u, r), 1e-8 * scale, &what);
                if profile == BALL {
                    let sphere = sphere_traction(MU, exact.normal.central_pressure(), a, c, r);
                    close(contact.shear_traction_at(r), sphere, 1e-9 * scale, &what);
                }
            }
        }
    }
}

/// A flat punch that sticks: τ = G* U/(π √(b² − r²)).
#[test]
fn the_traction_of_a_sticking_punch_is_that_of_its_edge() {
    let full = exact(&PUNCH, FORCE).full_slip();
    let mut punch = pressed(PUNCH, FORCE);
    to(&mut punch, FORCE, 0.5 * full);
    for r in [0.0_f64, 0.3e-4, 0.9e-4] {
        let traction = G_STAR * 0.5 * full / (std::f64::consts::PI * (1e-8 - r * r).sqrt());
        close_to(punch.shear_traction_at(r), traction, 1e-9, &format!("r = {r}"));
    }
}

/// Load and displacement rise together from first touch: each spring starts at the displacement of
/// its own touch, which is e = U (x/a)³ under a sphere, while the row is linear in g = x²/R between
/// its samples. Without slip, up to U = ⅔ u_max, T = 2G* ∫ (U − e) dx = 1.5 G* U a. That
/// interpolation is of second order.
#[test]
fn sampling_of_touching_springs_is_of_second_order() {
    let exact = exact(&BALL, FORCE);
    let u = 0.6 * exact.full_slip();
    let closed = 1.5 * G_STAR * u * exact.normal.radius();
    let errors = [64, 128, 256, 512].map(|resolution| {
        let mut contact = contact(Parameters { resolution, ..without_wear(BALL) });
        to(&mut contact, FORCE, u);
        close(contact.dissipated_energy(), 0.0, 1e-20, "nothing slips but by rounding");
        (contact.tangential_force() - closed).abs() / LIMIT
    });
    println!("errors of T over mu F_N: {errors:?}");
    // over the three doublings; single ones scatter, since the engine also samples at the ends of
    // its load pieces; the number of samples of a piece is rounded up, which makes coarse rows
    // finer than asked for: 1.97 here, 1.99 from 512 to 1024
    let order = (errors[0] / errors[3]).log2() / 3.0;
    assert!(order >= 1.95, "order {order}: {errors:?}");
    assert!(errors[0] < 1e-5, "{errors:?}");
}

/// The same with an outer annulus that slips, against a plain row of 1e5 springs (its own error is
/// 1e-7).
#[test]
fn a_slipping_oblique_rise_agrees_with_a_plain_row() {
    let exact = exact(&BALL, FORCE);
    for share in [0.75, 0.95] {
        let u = share * exact.full_slip();
        let mut row =
            PlainSpringRow::under(shape(&BALL), 1.037 * exact.normal.radius(), 100_000, E_STAR, G_STAR, MU);
        row.advance(FORCE, u, 400);
        let errors = [64, 128, 256, 512].map(|resolution| {
            let mut contact = contact(Parameters { resolution, ..without_wear(BALL) });
            to(&mut contact, FORCE, u);
            (contact.tangential_force() - row.tangential_force()).abs() / LIMIT
        });
        println!("errors of T over mu F_N at {share}: {errors:?}");
        assert!(errors[0] < 1e-3 && errors[3] < 1e-5, "{errors:?}");
    }
}

/// A vibration that dies down leaves a kink at each reversal: the row stays bounded, and gives what
/// one does that keeps them all.
#[test]
fn the_row_stays_bounded_while_a_vibration_dies_down() {
    for profile in [BALL, CONE, BLUNTED, ROUNDED] {
        let full = exact(&profile, FORCE).full_slip();
        let parameters = without_wear(profile.clone());
        let mut fine = started(Parameters { tolerance: 1e-7, ..parameters.clone() });
        let mut contact = started(parameters);
        let peak = |k: u32| 0.9 * full * (-3.0 * f64::from(k) / 1000.0).exp();
        let mut compare = |u: f64| {
            to(&mut fine, FORCE, u);
            to(&mut contact, FORCE, u);
            close(
                contact.tangential_force(),
                fine.tangential_force(),
                2e-5 * LIMIT,
                &format!("{profile:?} at {u}"),
            );
            (knots(&contact), knots(&fine))
        };
        let mut most = 0;
        for k in 0..1000 {
            most = most.max(compare(if k % 2 == 0 { peak(k) } else { -peak(k) }).0);
        }
        let (_, all) = compare(0.0);
        assert!(most <= 160 && all > 500, "{profile:?}: {most} of {all} knots");
        // what is left is wiped out, kink by kink
        for k in 1..=40 {
            compare(0.95 * full * f64::from(k) / 40.0);
        }
        close_to(contact.dissipated_energy(), fine.dissipated_energy(), 1e-6, "W");
    }
}

/// A sine whose period is no multiple of the step: its extremes differ by 1e-12 from cycle to
/// cycle, and each leaves a kink so near to the last one that their springs differ by rounding.
#[test]
fn the_row_stays_bounded_where_extremes_hardly_differ() {
    for profile in [BALL, CONE, BLUNTED, ROUNDED] {
        let reach = 0.6 * exact(&profile, FORCE).full_slip();
        let mut contact = started(without_wear(profile.clone()));
        for k in 1..=20_000 {
            to(&mut contact, FORCE, reach * (f64::from(k) * TAU * (1.0 - 5e-8) / 40.0).sin());
        }
        assert!(knots(&contact) <= 160, "{profile:?}: {} knots", knots(&contact));
    }
}
