use super::*;
use crate::parameters::NormalControl;
use crate::profile::Profile;
use crate::quadrature::composite;
use nalgebra::Vector2;
use rand::{RngExt, SeedableRng, rngs::StdRng};

const M: f64 = 0.7;

fn profiles() -> [Profile; 5] {
    [
        Profile::Parabola { radius: 0.01 },
        Profile::Cone { slope: 0.02 },
        Profile::PowerLaw { exponent: 3.5, coefficient: 1e6 },
        Profile::BluntedSphere { radius: 0.01, flat_radius: 1e-4 },
        Profile::RoundedPunch { radius: 0.01, flat_radius: 1e-4 },
    ]
}

fn at_depth(surface: &Surface, depth: f64) -> Contact {
    surface.contact(NormalControl::Indentation, depth, 1.0).expect("the profile carries any depth")
}

/// A line that is sampled as on 64 cells.
fn line(surface: &Surface, control: NormalControl, from: (Contact, f64), to: (Contact, f64)) -> Path<'_> {
    let place = |x| Vector2::new(x, 0.0);
    let ((from, start), (to, end)) = ((from.0, place(from.1)), (to.0, place(to.1)));
    let samples = Samples(128);
    Path {
        surface,
        control,
        bound_slope: M,
        start_slope: M,
        stiffness_ratio: 1.0,
        from,
        to,
        start,
        end,
        samples,
    }
}

fn path<'a>(surface: &'a Surface, from: Contact, to: Contact, start: f64, end: f64) -> Path<'a> {
    let control = NormalControl::Indentation;
    line(surface, control, (from, start), (to, end))
}

/// A row pressed to `depth` at rest, and its contact.
fn pressed(surface: &Surface, depth: f64) -> (Springs, Contact) {
    let contact = at_depth(surface, depth);
    let open = at_depth(surface, surface.image(0.0));
    let (springs, work) =
        Springs::default().walk(&path(surface, open, contact, 0.0, 0.0), Springs::default(), None);
    assert_eq!(work, 0.0);
    (springs, contact)
}

fn moved(springs: &Springs, surface: &Surface, contact: Contact, start: f64, end: f64) -> (Springs, f64) {
    springs.walk(&path(surface, contact, contact, start, end), Springs::default(), None)
}

/// ∫ (g − g₁)ⁿ dx by Gauss on even panels, in (x − x₁)/Δx so that narrow intervals keep their
/// digits.
fn moment(profile: &Profile, x: f64, width: f64, power: i32) -> f64 {
    let image = profile.image(x);
    width * composite(0.0, 20.0, |t| (profile.image(x + width * t / 20.0) - image).powi(power)) / 20.0
}

/// Wide intervals take differences of closed integrals, narrow ones a form of their own that takes
/// g as linear in x² (good to 1e-4); either keeps Cauchy's inequality.
#[test]
fn moments_agree_with_quadrature_down_to_narrow_intervals() {
    for profile in profiles() {
        let surface = Surface::new(profile.clone());
        for x in [1.1e-4, 2e-4] {
            for share in [0.5, 0.1, 1e-2, 1e-3, 2.9e-4, 1e-4, 1e-6] {
                let width = share * x;
                let interval = Interval::between(&surface.place(x), &surface.place(x + width));
                let (first, second) = (moment(&profile, x, width, 1), moment(&profile, x, width, 2));
                // a difference of load integrals loses 1e-16 φ ≈ 1e-16 x g against Δg Δx
                let image = profile.image(x);
                let lost = 20.0 * f64::EPSILON * x * image / (interval.rise * width);
                let what = format!("{profile:?} at {x}, {share}");
                assert!(
                    (interval.first / first - 1.0).abs() < 1e-9 + 4.0 * lost,
                    "{what}: {} {first}",
                    interval.first
                );
                let coarse = if share < 3e-4 { 1e-3 } else { 1e-5 };
                assert!(
                    (interval.second / second - 1.0).abs() < coarse,
                    "{what}: {} {second}",
                    interval.second
                );
                assert!(interval.second * width >= interval.first.powi(2) * (1.0 - 1e-12), "{what}: Cauchy");
            }
        }
    }
}

/// Where a difference of integrals is all rounding, the first moment of an interval as between
/// two kinks of cycles that hardly differ still has five digits.
#[test]
fn first_moments_keep_their_digits_in_the_narrowest_intervals() {
    for profile in profiles() {
        let surface = Surface::new(profile.clone());
        for share in [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-9] {
            let (x, width) = (2e-4, share * 2e-4);
            let interval = Interval::between_near(&surface.place(x), &surface.place(x + width));
            // in units of the rise that the interval has: that loses digits of its own
            let rise = profile.image(x + width) - profile.image(x);
            let off = interval.first / interval.rise * rise / moment(&profile, x, width, 1) - 1.0;
            assert!(off.abs() < 2e-5, "{profile:?}, {share}: {off:e}");
        }
    }
}

#[test]
fn products_and_integrals_of_functions_linear_in_the_image_are_those_of_quadrature() {
    for profile in profiles() {
        let surface = Surface::new(profile.clone());
        let (p, q) = (surface.place(1.2e-4), surface.place(2.1e-4));
        let interval = Interval::between(&p, &q);
        let linear = |ends: (f64, f64), x: f64| {
            ends.0 + (ends.1 - ends.0) * (profile.image(x) - p.image) / (q.image - p.image)
        };
        let over = |f: &dyn Fn(f64) -> f64| {
            (q.x - p.x) * composite(0.0, 20.0, |t| f(p.x + (q.x - p.x) * t / 20.0)) / 20.0
        };
        let (f, h) = ((2.0, -1.0), (0.5, 3.0));
        let single = over(&|x| linear(f, x));
        assert!((interval.linear(f.0, f.1) / single - 1.0).abs() < 1e-9, "{profile:?}");
        let double = over(&|x| linear(f, x) * linear(h, x));
        assert!((interval.product(f, h) / double - 1.0).abs() < 1e-7, "{profile:?}");
    }
}

/// Under a flat the image does not rise: functions are linear in x there.
#[test]
fn intervals_under_a_flat_are_linear_in_the_radius() {
    let surface = Surface::new(Profile::FlatPunch { flat_radius: 1e-4 });
    let interval = Interval::between(&surface.place(2e-5), &surface.place(1e-4));
    assert!((interval.linear(1.0, 3.0) - 2.0 * 8e-5).abs() < 1e-18);
    // ∫ (1 + 2t)(2 − t) dt = 2 + 3/2 − 2/3
    let product = 8e-5 * (2.0 + 1.5 - 2.0 / 3.0);
    assert!((interval.product((1.0, 3.0), (2.0, 1.0)) - product).abs() < 1e-18);
}

/// A first clip puts one knot at the front, g(c) = d − U/m; the next, which passes it, removes it
/// again.
#[test]
fn a_clip_adds_a_knot_at_the_front_and_removes_those_it_wipes_out() {
    let surface = Surface::new(Profile::Parabola { radius: 0.01 });
    let (rest, contact) = pressed(&surface, 4e-6);
    assert_eq!(rest.knots().len(), 2);
    let full = M * contact.depth;
    let (mut springs, mut at) = (rest, 0.0);
    for share in [0.2, 0.5, 0.8] {
        springs = moved(&springs, &surface, contact, at, share * full).0;
        at = share * full;
        let radii: Vec<f64> = springs.knots().iter().map(|knot| knot.place.x).collect();
        let front = contact.radius * (1.0 - share).sqrt();
        assert_eq!(radii.len(), 3, "{radii:?}");
        assert!((radii[1] / front - 1.0).abs() < 1e-12, "{radii:?}");
    }
    // gross slip wipes out everything but axis and edge
    springs = moved(&springs, &surface, contact, at, 1.5 * full).0;
    assert_eq!(springs.knots().len(), 2);
    assert_eq!(springs.stick_radius(&contact, M, 1.5 * full), 0.0);
}

#[test]
fn many_loops_need_a_handful_of_knots() {
    for profile in profiles() {
        let surface = Surface::new(profile.clone());
        let (mut springs, contact) = pressed(&surface, 4e-6);
        let (full, mut at, mut most) = (M * contact.depth, 0.0, 0);
        for k in 1..=20_000 {
            let next = 0.9 * full * (0.1 * f64::from(k)).sin();
            springs = moved(&springs, &surface, contact, at, next).0;
            at = next;
            most = most.max(springs.knots().len());
        }
        // axis, edge, two fronts, and what a few slightly lower maxima leave behind, as they have
        // to
        assert!(most <= 20, "{profile:?}: {most} knots");
    }
}

/// A ramp of load and displacement in many small steps keeps its knots at the sampling's spacing,
/// not one per step.
#[test]
fn a_ramp_in_small_steps_does_not_pile_up_knots() {
    let surface = Surface::new(Profile::Parabola { radius: 0.01 });
    let (mut springs, mut contact) = (Springs::default(), at_depth(&surface, 0.0));
    let steps = 5000;
    for k in 1..=steps {
        let share = f64::from(k) / f64::from(steps);
        let next = at_depth(&surface, 4e-6 * share);
        // a curve, so that the origins are not linear in g
        let displacement = |share: f64| 1e-6 * share * share;
        let before = f64::from(k - 1) / f64::from(steps);
        let line = path(&surface, contact, next, displacement(before), displacement(share));
        springs = springs.walk(&line, Springs::default(), None).0;
        contact = next;
    }
    // at most 64 to a factor e of the radius, which grows by √5000 from the first step
    assert!(springs.knots().len() < 64 * 5, "{} knots", springs.knots().len());
    // e = U at touch = 1e-6 (g/d)²: T/2G* = ∫ (U − e) dx = U a (1 − 1/5)
    let expected = 1e-6 * contact.radius * 0.8;
    assert!((springs.deflection_integral(1e-6) / expected - 1.0).abs() < 1e-4);
}

#[test]
fn springs_that_leave_contact_are_forgotten() {
    let surface = Surface::new(Profile::Cone { slope: 0.02 });
    let (rest, contact) = pressed(&surface, 4e-6);
    let (springs, _) = moved(&rest, &surface, contact, 0.0, 1e-6);
    let less = at_depth(&surface, 1e-6);
    let (cut, work) = springs.walk(&path(&surface, contact, less, 1e-6, 1e-6), Springs::default(), None);
    assert!(work > 0.0);
    assert!(cut.knots().iter().all(|knot| knot.place.x <= less.radius));
    let (again, none) = cut.walk(&path(&surface, less, contact, 1e-6, 1e-6), Springs::default(), None);
    assert_eq!(none, 0.0);
    assert_eq!(again.deflection_integral(1e-6), cut.deflection_integral(1e-6));
    let open = at_depth(&surface, 0.0);
    let (gone, _) = again.walk(&path(&surface, contact, open, 1e-6, 1e-6), Springs::default(), None);
    assert!(gone.knots().is_empty());
}

#[test]
fn origins_are_read_between_knots_linearly_in_the_image() {
    let surface = Surface::new(Profile::Parabola { radius: 0.01 });
    let (rest, contact) = pressed(&surface, 4e-6);
    let u = 0.5 * M * contact.depth;
    let (springs, _) = moved(&rest, &surface, contact, 0.0, u);
    let radii: Vec<f64> = (0..=20).map(|k| contact.radius * f64::from(k) / 20.0).collect();
    for (x, origin) in radii.iter().zip(springs.origins_at(&surface, &radii)) {
        let bound = M * (contact.depth - surface.image(*x)).max(0.0);
        assert!((origin - (u - bound.min(u))).abs() < 1e-12 * u, "{x}");
    }
}

/// The short way under a steady contact gives what the general walk gives, over 2,000 random lines,
/// in force, work and front; a line that it refuses has changed nothing.
#[test]
fn a_slide_gives_what_a_walk_gives() {
    for profile in profiles() {
        let surface = Surface::new(profile.clone());
        let (start, contact) = pressed(&surface, 4e-6);
        let full = M * contact.depth;
        let (mut short, mut long) = (start.clone(), start);
        let (mut short_work, mut long_work, mut at, mut state) = (0.0, 0.0, 0.0, 1u32);
        for n in 0..2000 {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let next = 1.2 * full * (f64::from(state) / f64::from(u32::MAX) - 0.5);
            short_work += short
                .slide(&surface, &contact, M, next, (1.0, f64::MAX), None)
                .expect("one zone slips to one side");
            let (row, work) = moved(&long, &surface, contact, at, next);
            (long, long_work, at) = (row, long_work + work, next);
            let what = format!("{profile:?}, line {n} to {next:e}");
            let scale = full * contact.radius;
            let integral = |row: &Springs| row.deflection_integral(at) / scale;
            assert!((integral(&short) - integral(&long)).abs() < 1e-13, "{what}");
            let front = |row: &Springs| row.stick_radius(&contact, M, at) / contact.radius;
            assert!(
                (front(&short) - front(&long)).abs() < 1e-9,
                "{what}: {} {}",
                front(&short),
                front(&long)
            );
            assert!(short.knots().len() <= long.knots().len() + 3, "{what}");
        }
        assert!((short_work / long_work - 1.0).abs() < 1e-12, "{profile:?}: {short_work:e} {long_work:e}");
    }
}

/// However often a loop is repeated, the row keeps a knot at the axis, at the front of the loop, at
/// that of the stroke and at the edge; creep in steps that are hardly more than rounding adds none.
#[test]
fn repeated_loops_and_creep_add_no_knots() {
    for profile in profiles() {
        let surface = Surface::new(profile.clone());
        let (mut springs, contact) = pressed(&surface, 4e-6);
        let full = M * contact.depth;
        let mut to = |displacement: f64| {
            springs
                .slide(&surface, &contact, M, displacement, (1.0, f64::MAX), None)
                .expect("one zone slips to one side");
            springs.knots().len()
        };
        for k in 1..=2000 {
            let knots = to(0.6 * full * (std::f64::consts::TAU * f64::from(k) / 20.0).sin());
            assert!(knots <= 4, "{profile:?}, step {k}: {knots} knots");
        }
        for k in 1..=2000 {
            let knots = to(2e-15 * full * f64::from(k));
            assert!(knots <= 6, "{profile:?}, creep {k}: {knots} knots");
        }
    }
}

#[test]
fn a_slide_refuses_zones_that_slip_both_ways_and_work_without_bound() {
    let surface = Surface::new(Profile::Parabola { radius: 0.01 });
    let (start, contact) = pressed(&surface, 4e-6);
    let full = M * contact.depth;
    // beyond their bound on one side at the axis, on the other in the middle, as no path leaves
    // them
    let origins = [(0.0, 1.1 * full), (0.5 * contact.radius, -1.1 * full), (contact.radius, -1.1 * full)];
    let mut twisted = Springs::from_origins(&surface, &origins);
    let before = twisted.clone();
    assert_eq!(twisted.slide(&surface, &contact, M, 0.0, (1.0, f64::MAX), None), None);
    assert_eq!(twisted, before);
    let mut far = start.clone();
    assert_eq!(far.slide(&surface, &contact, M, 1e300, (1e100, f64::MAX), None), None);
    assert_eq!(far, start);
}

/// W over a loop of amplitude U₀ = θ u_max tends to ½ θ³ μF_N u_max as θ falls (the series of
/// Mindlin's loop for the sphere; μF_N/2G* is m φ(a) here). What sticks must not add to it: its
/// slip is rounding, but its area is everything.
#[test]
fn the_work_of_a_minute_loop_is_that_of_its_minute_annulus() {
    let surface = Surface::new(Profile::Parabola { radius: 0.01 });
    let (start, contact) = pressed(&surface, 4e-6);
    let full = M * contact.depth;
    for k in 0..20 {
        let theta = 2e-6 * 1.13f64.powi(k);
        let crest = theta * full;
        let mut springs = moved(&start, &surface, contact, 0.0, crest).0;
        let mut work = 0.0;
        for k in 1..=100 {
            let next = crest * (std::f64::consts::TAU * f64::from(k) / 100.0).cos();
            work += springs
                .slide(&surface, &contact, M, next, (1.0, f64::MAX), None)
                .expect("one zone slips to one side");
        }
        let expected = 0.5 * theta.powi(3) * M * contact.load * full;
        // the bound is known to eps u_max, the annulus reaches θ u_max below its edge and the slip
        // is of that size, too
        let tolerance = theta + 1e-14 / (theta * theta);
        assert!((work / expected - 1.0).abs() < tolerance, "{theta:e}: {work:e} against {expected:e}");
    }
}

/// Work over a few lines of random load and displacement, one walk for each of `pieces` of a line.
fn work_of_lines(surface: &Surface, control: NormalControl, lines: &[(f64, f64)], pieces: u32) -> f64 {
    let at = |value| surface.contact(control, value, 1.0).expect("the profile carries it");
    let mut from = (at(lines[0].0), lines[0].1);
    let start = at(if control == NormalControl::Force { 0.0 } else { surface.image(0.0) });
    let walk = |row: Springs, (from, start): (Contact, f64), (to, end): (Contact, f64)| {
        let path = Path { samples: Samples(20_000), ..line(surface, control, (from, start), (to, end)) };
        row.walk(&path, Springs::default(), None)
    };
    let (mut row, _) = walk(Springs::default(), (start, from.1), from);
    let mut work = 0.0;
    for &(value, displacement) in &lines[1..] {
        let line = (from.0.control, from.1);
        for k in 1..=pieces {
            let share = f64::from(k) / f64::from(pieces);
            let part = |a: f64, b: f64| if k == pieces { b } else { a + share * (b - a) };
            let to = (at(part(line.0, value)), part(line.1, displacement));
            let (next, more) = walk(row, from, to);
            (row, from, work) = (next, to, work + more);
        }
    }
    work
}

/// Largest error of the work of random lines between two loads that differ by `change`, relative.
fn error_of_work(surface: &Surface, control: NormalControl, change: f64) -> f64 {
    let contact = at_depth(surface, 4e-6);
    let top = if control == NormalControl::Force { contact.load } else { contact.depth };
    let error = |seed| {
        let mut random = StdRng::seed_from_u64(seed);
        let mut line = |k: u32| {
            let value = if k == 0 || random.random_bool(0.5) { top } else { top * (1.0 - change) };
            (value, random.random_range(-1.2..1.2) * M * contact.depth)
        };
        let lines: Vec<_> = (0..7).map(&mut line).collect();
        let fine = work_of_lines(surface, control, &lines, 200);
        (work_of_lines(surface, control, &lines, 1) / fine - 1.0).abs()
    };
    (0..10).map(error).fold(0.0, f64::max)
}

/// Bound and displacement change evenly: springs that touch and leave on the way, too.
#[test]
fn the_work_of_a_line_of_depth_is_exact_however_long() {
    for profile in profiles() {
        let error = error_of_work(&Surface::new(profile.clone()), NormalControl::Indentation, 0.8);
        // 200 pieces sum the rounding of their fronts, next to a rim where the image is steep
        assert!(error < 1e-8, "{profile:?}: {error:e}");
    }
}

#[test]
fn the_error_of_the_work_of_a_line_of_force_falls_nearly_with_the_square_of_its_change() {
    for profile in profiles() {
        let surface = Surface::new(profile.clone());
        // the order of a single halving scatters: from 1.6 (r^3.5) to 4.5 (cone)
        let errors = [0.4, 0.1, 0.05001].map(|change| error_of_work(&surface, NormalControl::Force, change));
        let order = 0.5 * (errors[0] / errors[1]).log2();
        assert!(order > 1.65, "{profile:?}: {order}, {errors:?}");
        assert!(errors[1] < 1.5e-5 && errors[2] < 4e-6, "{profile:?}: {errors:?}");
    }
}

/// A vibration that dies down leaves a kink at each reversal. With fewer of them the force stays,
/// and that of a motion which wipes them out one by one follows the share.
#[test]
fn a_coarser_row_has_the_force_and_nearly_the_future_of_a_fine_one() {
    for profile in profiles() {
        let surface = Surface::new(profile.clone());
        let (mut fine, contact) = pressed(&surface, 2e-6);
        let full = M * (contact.depth - surface.image(0.0));
        let mut place = 0.0;
        for k in 0..400 {
            let end = 0.8 * full * (1.0 - f64::from(k) / 450.0) * if k % 2 == 0 { 1.0 } else { -1.0 };
            fine = moved(&fine, &surface, contact, place, end).0;
            place = end;
        }
        let fine = fine;
        assert!(fine.knots().len() >= 390, "{profile:?}: {} knots", fine.knots().len());
        let mut fewer = 0;
        for share in [1e-3, 1e-4, 1e-5] {
            let mut coarse = fine.clone();
            let mut knots = fine.knots().len() + 1;
            while coarse.knots().len() < knots {
                knots = coarse.knots().len();
                coarse.coarsen(&contact, M, share);
            }
            let unit = contact.radius * full;
            let (kept, of) = (coarse.deflection_integral(place), fine.deflection_integral(place));
            assert!((kept - of).abs() <= 1e-13 * unit, "{profile:?} {share}: {kept} for {of}");
            let (mut worst, mut work) = (0f64, (0.0, 0.0));
            let (mut coarse_now, mut fine_now, mut now) = (coarse, fine.clone(), place);
            for k in 1..=60 {
                let next = place + (0.9 * full - place) * f64::from(k) / 60.0;
                let (row, w) = moved(&coarse_now, &surface, contact, now, next);
                let (exact, exact_work) = moved(&fine_now, &surface, contact, now, next);
                (coarse_now, fine_now, now) = (row, exact, next);
                work = (work.0 + w, work.1 + exact_work);
                let difference = coarse_now.deflection_integral(now) - fine_now.deflection_integral(now);
                worst = worst.max(difference.abs() / unit);
            }
            assert!(worst <= 0.25 * share, "{profile:?} {share}: {worst} with {knots} knots");
            assert!((work.0 / work.1 - 1.0).abs() <= share, "{profile:?} {share}: {work:?}");
            assert!(knots > fewer, "{profile:?} {share}: {knots} knots, {fewer} at the share before");
            fewer = knots;
        }
    }
}
