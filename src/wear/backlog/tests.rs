use super::*;
use crate::friction::{Path, Samples, Springs};
use crate::parameters::NormalControl;
use crate::profile::Profile;
use crate::surface::Surface;
use nalgebra::Vector2;

const M: f64 = 0.7;
const DEPTH: f64 = 3.5e-6;

/// A ball pressed to a depth, moved along strokes of equal steps under it. Returns the backlog.
fn strokes(ends: &[f64], steps: u32) -> WearBacklog {
    let surface = Surface::new(Profile::Parabola { radius: 0.01 });
    let open = Contact { control: 0.0, depth: 0.0, radius: 0.0, load: 0.0 };
    let contact = surface.contact(NormalControl::Indentation, DEPTH, 1.0).expect("a ball can be pressed");
    let path = |from: Contact, start: f64, end: f64| Path {
        surface: &surface,
        control: NormalControl::Indentation,
        bound_slope: M,
        start_slope: M,
        from,
        to: contact,
        stiffness_ratio: 1.0,
        start: Vector2::new(start, 0.0),
        end: Vector2::new(end, 0.0),
        samples: Samples(128),
    };
    let (mut springs, _) = Springs::default().walk(&path(open, 0.0, 0.0), Springs::default(), None);
    let (mut backlog, mut place) = (WearBacklog::default(), 0.0);
    for &end in ends {
        let start = place;
        for k in 1..=steps {
            let next = if k == steps { end } else { start + (end - start) * f64::from(k) / f64::from(steps) };
            let mut slips = Vec::new();
            let path = path(contact, place, next);
            let (row, work) = springs.walk(&path, Springs::default(), Some(&mut slips));
            backlog.record(&slips, (work, work / M), (&contact, &contact), (0.0, false));
            (springs, place) = (row, next);
        }
    }
    backlog
}

/// Cycles of one amplitude make E = 4N (U₀ − m (d − g))₊, whatever the steps: to rounding, and
/// nothing inside the front.
#[test]
fn equal_cycles_make_their_closed_law_whatever_the_steps() {
    let amplitude = 0.6 * M * DEPTH;
    let mut ends = vec![amplitude];
    ends.extend((0..10).flat_map(|_| [-amplitude, amplitude]));
    // the first quarter is a fourth of a cycle
    let exact = SlipAtDepth::of_motion(Sliding::Cycles(amplitude), 10.25, DEPTH, M);
    for steps in [1, 7, 40] {
        let backlog = strokes(&ends, steps);
        let law = backlog.law();
        assert_eq!(law.len(), 1, "{steps} steps");
        assert!((law[0].depth / DEPTH - 1.0).abs() < 1e-14);
        let front = DEPTH - amplitude / M;
        assert!((law[0].front() - front).abs() < 1e-9 * DEPTH, "{steps} steps: {:e}", law[0].front() - front);
        assert!(
            (backlog.front() - front).abs() < 1e-9 * DEPTH,
            "{steps} steps: {:e}",
            backlog.front() - front
        );
        for k in 0..=100 {
            let image = DEPTH * f64::from(k) / 100.0;
            let (slip, expected) = (law[0].at(image).0, exact.at(image).0);
            assert!(
                (slip - expected).abs() < 1e-9 * amplitude,
                "{steps} steps at {image:e}: {slip:e} {expected:e}"
            );
            assert!(image > front || slip == 0.0, "{steps} steps: slip {slip:e} inside the front");
        }
    }
}

/// A slide that begins while springs slip moves its front inward: what slips lies between the two
/// fronts and outside.
#[test]
fn a_slide_that_goes_on_slips_from_its_new_front() {
    let (before, now) = (0.3 * M * DEPTH, 0.7 * M * DEPTH);
    for steps in [1, 50] {
        let all = strokes(&[before, now], steps).law();
        let first = strokes(&[before], steps).law();
        for k in 0..=200 {
            let image = DEPTH * f64::from(k) / 200.0;
            let slip = all[0].at(image).0 - first[0].at(image).0;
            let bound = M * (DEPTH - image);
            let expected = (now - bound).max(0.0) - (before - bound).max(0.0);
            assert!((slip - expected).abs() < 1e-8 * now, "{steps} at {image:e}: {slip:e} {expected:e}");
        }
    }
}

/// A copy is the same whatever the backlog held before.
#[test]
fn a_copy_in_other_memory_is_the_same() {
    let backlogs = [&[][..], &[0.4], &[0.4, -0.9], &[1.5, -0.2, 0.3]];
    let backlogs = backlogs.map(|ends| {
        let mut ends: Vec<f64> = ends.iter().map(|end| end * M * DEPTH).collect();
        ends.push(0.0);
        strokes(&ends, 3)
    });
    for from in &backlogs {
        for mut to in backlogs.clone() {
            to.copy_from(from);
            assert_eq!(&to, from);
        }
    }
}

/// Knots of the springs bend the slip of a stroke and unbend it on the way back: what cancels there
/// is not kept, and the law is as without it.
#[test]
fn hinges_that_cancel_leave_the_backlog() {
    let mut levels = Levels::default();
    let mut level = Level::new(0);
    (level.slip, level.moment) = (1.0, DEPTH);
    levels.insert(0, level, &[]);
    let bins = Bins { edge: level.edge(DEPTH), bits: BITS };
    levels.level(0).add_hinge(-2.0, 0.5 * DEPTH, bins);
    let one = levels.clone();
    for slope in [0.7, 0.1, -0.8] {
        levels.level(0).add_hinge(slope, 0.25 * DEPTH, bins);
    }
    assert_eq!(levels, one);
    // two places in one bin that cancel are a step of the slip
    levels.level(0).add_hinge(2.0, 0.5001 * DEPTH, bins);
    let (level, hinges) = levels.iter().next().expect("there is a level");
    assert_eq!(hinges.len(), 2);
    let mut law = SlipAtDepth::default();
    level.law_into((hinges, bins), DEPTH, &mut law);
    let (step, slip) = (2e-4 * DEPTH, law.at(0.9 * DEPTH).0);
    assert!((slip / step - 1.0).abs() < 1e-9, "{slip:e} {step:e}");
}

/// Springs that are drawn along a circle of radius U lag behind by the angle whose sine is b/U, so
/// that they slip by a share √(1 − b²/U²) of its length, b = m (d − g): many pieces, and a root at
/// the front.
#[test]
fn the_slip_of_an_orbit_keeps_its_shape_in_the_bins_of_the_plane() {
    let front = 0.4 * DEPTH;
    let slip = |image: f64| (1.0 - ((DEPTH - image) / (DEPTH - front)).powi(2)).max(0.0).sqrt();
    let contact = Contact { control: DEPTH, depth: DEPTH, radius: 1e-4, load: 1e-10 };
    let error = |in_plane: bool| {
        let image = |j: usize| front + (DEPTH - front) * j as f64 / 400.0;
        let piece = |j: usize| {
            let image = (image(j), image(j + 1));
            SlipPiece { image, slip: (slip(image.0), slip(image.1)), integral: 1.0, moment: 0.0 }
        };
        let pieces: Vec<SlipPiece> = (0..400).map(piece).collect();
        let mut backlog = WearBacklog::default();
        backlog.record(&pieces, (1.0, 1.0), (&contact, &contact), (0.0, in_plane));
        let law = backlog.law();
        let images = (0..=2000).map(|k| DEPTH * f64::from(k) / 2000.0);
        images.map(|image| (law[0].at(image).0 - slip(image)).abs()).fold(0.0, f64::max)
    };
    let (line, plane) = (error(false), error(true));
    println!("{line:.3} {plane:.3}");
    assert!(plane < 0.3 * line && plane < 0.03, "{line} {plane}");
}

/// The core slips by no rounding that strokes have left there.
#[test]
fn rounding_inside_a_front_is_no_slip() {
    let law = |rounding: f64, steepness: f64| {
        let (front, slope) = (0.8 * DEPTH, 4.0 * M);
        SlipAtDepth::new(DEPTH, (steepness, rounding), vec![(front, slope, -slope * front)])
    };
    assert_eq!(law(1e-15 * DEPTH, 0.0).front(), 0.8 * DEPTH);
    assert_eq!(law(0.0, 1e-15).front(), 0.8 * DEPTH);
    assert_eq!(law(1e-6 * DEPTH, 0.0).front(), f64::NEG_INFINITY);
    assert_eq!(law(0.0, 1e-6).front(), f64::NEG_INFINITY);
}

/// Gross slip to and fro: every spring slips, the innermost least.
#[test]
fn gross_slip_has_no_front() {
    let amplitude = 1.5 * M * DEPTH;
    let law = strokes(&[amplitude, -amplitude], 10).law();
    assert_eq!(law[0].front(), f64::NEG_INFINITY);
    for k in 0..=10 {
        let image = DEPTH * f64::from(k) / 10.0;
        let bound = M * (DEPTH - image);
        let expected = (amplitude - bound) + 2.0 * (amplitude - bound);
        assert!((law[0].at(image).0 - expected).abs() < 1e-9 * amplitude, "{image:e}");
    }
}

/// However long the history, the backlog has no more than two hinges of each bin.
#[test]
fn a_random_history_leaves_a_bounded_backlog() {
    let mut seed = 17_u64;
    let mut random = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1_u64 << 53) as f64
    };
    let ends: Vec<f64> = (0..4000).map(|_| (1.6 * random() - 0.8) * M * DEPTH).collect();
    let entries =
        |count: usize| strokes(&ends[..count], 3).levels().map(|(_, hinges)| hinges.len()).sum::<usize>();
    let (short, long) = (entries(2000), entries(4000));
    // places lie within fourteen octaves
    assert!(long <= 2 * (14 << BITS) && long <= short + 32, "{short} {long}");
}

/// Equal cycles are those of one amplitude, whatever part of a cycle they begin and end with;
/// sliding on is no cycles, and strokes of two amplitudes have two.
#[test]
fn a_law_of_equal_cycles_is_that_of_one_amplitude() {
    let full = M * DEPTH;
    let motion = |ends: &[f64]| strokes(ends, 5).law()[0].motion(M).expect("it is a motion");
    for amplitude in [0.3 * full, 0.9 * full] {
        let found = motion(&[amplitude, -amplitude, amplitude]);
        let Sliding::Cycles(size) = found.sliding else { panic!("{found:?}") };
        assert!((size / amplitude - 1.0).abs() < 1e-9 && (found.amount - 1.25).abs() < 1e-9, "{found:?}");
        assert_eq!(found.mixture, None);
    }
    assert!(motion(&[0.9 * full, 0.2 * full, 0.9 * full]).mixture.is_some());
    assert!(motion(&[0.5 * full, -0.5 * full, 0.8 * full]).mixture.is_some());
    let slide = SlipAtDepth::of_motion(Sliding::Onward, 3e-6, DEPTH, M).motion(M);
    assert_eq!(slide, Some(RepeatedMotion::of(Sliding::Onward, 3e-6)));
}

/// Cycles of several amplitudes slip like strokes to and fro that are not alike, whether the core
/// sticks or not.
#[test]
fn a_law_of_unequal_strokes_is_that_of_cycles_of_several_amplitudes() {
    let full = M * DEPTH;
    for largest in [0.9, 1.3] {
        let law = strokes(&[0.5, -0.3, largest, -largest, 0.4, -0.6].map(|place| place * full), 5).law();
        let motion = law[0].motion(M).expect("it is a motion");
        let mixture = motion.mixture.expect("they are of several amplitudes");
        assert!(mixture.iter().all(|(_, amplitude)| *amplitude <= motion.sliding.amplitude()));
        for image in [0.0, 0.2, 0.35, 0.6, 0.8, 0.95].map(|share| share * DEPTH) {
            let slips = mixture.iter().map(|(share, amplitude)| {
                4.0 * motion.amount * share * (amplitude - M * (DEPTH - image)).max(0.0)
            });
            let (slip, exact) = (slips.sum::<f64>(), law[0].at(image).0);
            assert!((slip - exact).abs() < 1e-9 * full, "{largest}, {image:e}: {slip:e} {exact:e}");
        }
    }
}

/// Cycles of the slip at the contact edge would wear springs that stick: between their front and
/// that of the law.
#[test]
fn a_law_with_its_front_elsewhere_is_none_of_cycles_of_one_amplitude() {
    let full = M * DEPTH;
    let front = DEPTH - 0.9 * full / M;
    for shift in [1e-5, 1e-3, 5e-3] {
        // twice the slope, until it meets the line of the cycles
        let (first, second) = (front + shift * DEPTH, front + 2.0 * shift * DEPTH);
        let slope = 4.0 * M;
        let knots = vec![(first, 2.0 * slope, -2.0 * slope * first), (second, slope, -slope * front)];
        let law = SlipAtDepth::new(DEPTH, (0.0, 0.0), knots);
        assert_eq!(
            law.at(DEPTH).0,
            SlipAtDepth::of_motion(Sliding::Cycles(0.9 * full), 1.0, DEPTH, M).at(DEPTH).0
        );
        let motion = law.motion(M).expect("it is a motion");
        assert!(motion.mixture.is_some() && motion.sliding.amplitude() < 0.9 * full, "{shift}: {motion:?}");
    }
}
