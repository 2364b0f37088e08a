use super::super::tests::{ALONG_THE_SPRING, move_spring, polar};
use super::*;

/// The law in many explicit steps: the body moves, the spring slips back along its force to its
/// bound: u_x = t_x/(1 + l), u_y = t_y/(1 + ρ l), slip l b.
fn explicit(
    start: Vector2<f64>,
    motion: Vector2<f64>,
    (first, last): (f64, f64),
    ratio: f64,
    steps: usize,
) -> (Vector2<f64>, f64, f64) {
    let (mut v, mut slip, mut work) = (start, 0.0, 0.0);
    for k in 1..=steps {
        let bound = first + (last - first) * k as f64 / steps as f64;
        let trial = v + motion * (1.0 / steps as f64);
        let at = |l: f64| Vector2::new(trial.x / (1.0 + l), trial.y / (1.0 + ratio * l));
        let mut l = 0.0;
        if norm(trial) > bound {
            for _ in 0..50 {
                let (now, step) = (at(l), 1e-6 * (1.0 + l));
                let slope = (norm(at(l + step)) - norm(now)) / step;
                l -= (norm(now) - bound) / slope;
            }
        }
        v = at(l);
        slip += l * bound;
        work += l * bound * bound;
    }
    (v, slip, work)
}

/// Force at the start, motion, the bound at both ends, and the ratio of the stiffnesses.
type Case = (Vector2<f64>, Vector2<f64>, (f64, f64), f64);

/// Starts inside and on the bound, at any angle to the motion, with a bound that stays, rises and
/// falls.
fn lines(bounds: &[f64]) -> Vec<Case> {
    let mut lines = Vec::new();
    for ratio in [0.7, 1.08, 1.4] {
        for share in [0.0, 0.6, 1.0] {
            for angle in [0.0, 0.7, 1.5, 2.0, 3.0, -1.0, -2.8] {
                for length in [0.3, 1.0, 5.0] {
                    for last in bounds {
                        let motion = polar(length, 0.4);
                        lines.push((polar(share, angle + 0.4), motion, (1.0, *last), ratio));
                    }
                }
            }
        }
    }
    lines
}

fn end(line: &Case) -> Moved {
    move_spring(line.0, line.1, line.2, line.3)
}

#[test]
fn a_line_is_the_limit_of_many_explicit_steps() {
    for line in lines(&[1.0, 1.05, 0.95]) {
        let exact = end(&line);
        let (v, slip, work) = explicit(line.0, line.1, line.2, line.3, 4000);
        let found = exact.slip * exact.mean_bound;
        let off = (norm(v - exact.deflection), (slip - exact.slip).abs(), (work - found).abs());
        // explicit steps are of first order
        assert!(off.0 < 2e-3 && off.1 < 2e-3 && off.2 < 2e-3, "{line:?}: {off:?}");
    }
}

/// Two numbers of explicit steps, extrapolated, agree far better: the closed form is right.
#[test]
fn the_closed_form_is_the_extrapolated_limit() {
    for line in lines(&[1.0]) {
        if norm(line.0) == 0.6 {
            // the onset of slip falls within a step, which spoils the order
            continue;
        }
        let exact = end(&line);
        let of = |steps| explicit(line.0, line.1, line.2, line.3, steps);
        let (coarse, fine, finest) = (of(1000), of(2000), of(4000));
        let extrapolated = |a: f64, b: f64, c: f64| (a - 6.0 * b + 8.0 * c) / 3.0;
        let v = coarse.0.zip_zip_map(&fine.0, &finest.0, extrapolated);
        let slip = extrapolated(coarse.1, fine.1, finest.1);
        let off = (norm(v - exact.deflection), (slip - exact.slip).abs());
        if norm(line.0) == 1.0 {
            assert!(off.0 < 1e-6 && off.1 < 1e-6, "{line:?}: {off:?}");
        } else {
            assert!(off.0 < 2e-3 && off.1 < 2e-3, "{line:?}: {off:?}");
        }
    }
}

#[test]
fn at_a_constant_bound_a_line_may_be_split_at_will() {
    for line in lines(&[1.0]) {
        let whole = end(&line);
        for share in [0.01, 0.37, 0.9] {
            let first = end(&(line.0, line.1 * share, line.2, line.3));
            let second = end(&(first.deflection, line.1 * (1.0 - share), line.2, line.3));
            let error = norm(second.deflection - whole.deflection);
            let slip = first.slip + second.slip - whole.slip;
            assert!(error < 1e-13 && slip.abs() < 1e-13, "{line:?} {share}: {error:e} {slip:e}");
        }
    }
}

/// Where the bound changes, the splitting is of second order: a line in parts of one stage each. A
/// line as
/// it is has the error of its stages.
#[test]
fn where_the_bound_changes_the_error_is_of_second_order() {
    let mut orders = Vec::new();
    for (start, motion, (first, _), ratio) in lines(&[1.0]) {
        let whole = |parts: u32| {
            let (mut v, last) = (start, 0.9);
            for k in 0..parts {
                let at = |k: u32| first + (last - first) * f64::from(k) / f64::from(parts);
                let part = motion * (1.0 / f64::from(parts));
                v = end(&(v, part, (at(k), at(k + 1)), ratio)).deflection;
            }
            v
        };
        let exact = whole(1024);
        let error = |parts| norm(whole(parts) - exact);
        assert!(error(1) < 5e-5, "{start:?} {motion:?} {ratio}: {:e}", error(1));
        if error(64) > 1e-9 {
            orders.push((error(64) / error(128)).log2());
        }
    }
    assert!(orders.len() > 20);
    orders.sort_by(f64::total_cmp);
    let middle = orders[orders.len() / 2];
    assert!(middle > 1.9 && middle < 2.3, "{middle}: {orders:?}");
}

/// What the drive brings is stored or taken by friction: ∫**v**·d**U** by a fine sum of exact
/// lines.
#[test]
fn the_work_of_the_drive_is_stored_or_taken_by_friction() {
    for line in lines(&[1.0]) {
        let (start, motion, bounds, ratio) = line;
        let steps = 4000;
        let (mut v, mut driven) = (start, 0.0);
        for _ in 0..steps {
            let part = motion * (1.0 / f64::from(steps));
            let next = end(&(v, part, bounds, ratio)).deflection;
            let middle = (v + next) * 0.5;
            driven += middle.x * part.x + middle.y * part.y / ratio;
            v = next;
        }
        let whole = end(&line);
        let stored = 0.5 * (stored(whole.deflection, ratio) - stored(start, ratio));
        let off = driven - stored - whole.slip * whole.mean_bound;
        assert!(off.abs() < 2e-6, "{line:?}: {off:e}");
    }
}

/// In steady slip the force is along the motion of the body, as Coulomb's law asks.
#[test]
fn a_long_way_turns_the_force_into_the_motion() {
    for ratio in [0.7, 1.4] {
        let way = polar(50.0, 0.9);
        let moved = move_spring(polar(1.0, 2.5), Vector2::new(way.x, ratio * way.y), (1.0, 1.0), ratio);
        assert!(norm(moved.deflection - polar(1.0, 0.9)) < 1e-14, "{:?}", moved.deflection);
        // the slip is the way of the body less what the spring has given way
        assert!((moved.slip - 50.0).abs() < 2.0);
    }
}

/// Along either axis it is the scalar spring, whatever the bound does.
#[test]
fn along_an_axis_a_spring_is_the_scalar_one() {
    for (axis, ratio) in [(0, 1.3), (1, 1.3), (1, 0.6)] {
        for (start, way, bounds) in ALONG_THE_SPRING {
            let on_axis = |value: f64| Vector2::ith(axis, value);
            let moved = move_spring(on_axis(start), on_axis(way), bounds, ratio);
            let trial: f64 = start + way;
            let expected = trial.clamp(-bounds.1, bounds.1);
            // the slip of a spring in its own units
            let slip = (trial - expected).abs() / if axis == 1 { ratio } else { 1.0 };
            assert!(norm(moved.deflection - on_axis(expected)) < 1e-14, "{axis} {start} {way}");
            assert!((moved.slip - slip).abs() < 1e-14, "{axis} {start} {way}: {} {slip}", moved.slip);
        }
    }
}

/// Near ρ = 1 it goes over into the isotropic spring.
#[test]
fn nearly_equal_stiffnesses_are_equal_ones() {
    for (start, motion, bounds, _) in lines(&[1.0, 1.05, 0.95]) {
        let equal = move_spring(start, motion, bounds, 1.0);
        let nearly = move_spring(start, motion, bounds, 1.0 + 1e-12);
        let off = norm(equal.deflection - nearly.deflection);
        let work = equal.slip * equal.mean_bound - nearly.slip * nearly.mean_bound;
        // the isotropic form has an error of 3e-6 where the bound changes
        assert!(off < 1e-4 && work.abs() < 2e-4, "{start:?} {motion:?} {bounds:?}: {off:e} {work:e}");
    }
}

/// The smallest numbers, no motion and no bound: nothing that is no number.
#[test]
fn the_ends_of_the_range_stay_numbers() {
    for (start, motion, bounds) in [
        ([1.0, 0.0], [0.0, 0.0], (1.0, 0.5)),
        ([0.6, 0.8], [0.0, 0.0], (1.0, 0.0)),
        ([0.6, 0.8], [1e-300, 1e-300], (1.0, 1.0)),
        ([0.6, 0.8], [1e200, 1e200], (1.0, 1e-200)),
        ([0.0, 0.0], [1.0, 1.0], (0.0, 0.0)),
        ([0.0, 0.0], [1.0, 1.0], (0.0, 1e-300)),
        ([-0.6, -0.8], [30.0, 40.0], (1.0, 0.3)),
        ([1e-200, 1e-200], [1e-200, 0.0], (1.5e-200, 1e-200)),
    ] {
        let moved = move_spring(start.into(), motion.into(), bounds, 1.2);
        let numbers = [moved.deflection.x, moved.deflection.y, moved.slip, moved.mean_bound];
        assert!(numbers.iter().all(|value| value.is_finite()), "{start:?} {motion:?} {bounds:?}: {moved:?}");
        assert!(norm(moved.deflection) <= bounds.1 * (1.0 + 1e-14) && moved.slip >= 0.0, "{moved:?}");
    }
}
