use super::*;
use crate::quadrature::composite;
use crate::transform::leg;
use std::f64::consts::FRAC_2_PI;

fn analytic() -> Vec<(Profile, f64)> {
    vec![
        (Profile::Parabola { radius: 0.01 }, 2e-4),
        (Profile::Cone { slope: 0.02 }, 3e-4),
        (Profile::PowerLaw { exponent: 3.5, coefficient: 1e6 }, 3e-4),
        (Profile::PowerLaw { exponent: 1.4, coefficient: 1.0 }, 3e-4),
        (Profile::BluntedSphere { radius: 0.01, flat_radius: 1e-4 }, 1.887e-4),
        (Profile::RoundedPunch { radius: 0.01, flat_radius: 1e-4 }, 2.5e-4),
    ]
}

/// g from f by its definition: with r = x sin t, g = x ∫ f'(x sin t) dt.
fn image_by_definition(profile: &Profile, x: f64) -> f64 {
    let slope = |r: f64| {
        let step = 1e-6 * r;
        (profile.height(r + step) - profile.height(r - step)) / (2.0 * step)
    };
    let rim = (profile.flat_radius() / x).min(1.0).asin();
    // t = rim + span s³ smooths the start, where f' may go like a root of r
    let span = PI / 2.0 - rim;
    x * composite(0.0, 1.0, |s| 3.0 * span * s * s * slope(x * (rim + span * s.powi(3)).sin()))
}

/// f(r) = k f₀(r/k); the image scales in the same way.
#[test]
fn a_scaled_profile_is_geometrically_similar() {
    for (profile, a) in analytic() {
        let scaled = profile.scaled(2.5).unwrap();
        for share in [0.3, 0.9, 1.7] {
            let x = a * share;
            let pairs = [
                (scaled.height(2.5 * x), 2.5 * profile.height(x)),
                (scaled.image(2.5 * x), 2.5 * profile.image(x)),
            ];
            for (found, exact) in pairs {
                assert!((found - exact).abs() <= 1e-13 * exact.abs(), "{profile:?}: {found} {exact}");
            }
        }
    }
    assert!(Profile::Parabola { radius: 1e29 }.scaled(100.0).is_err());
}

#[test]
fn images_follow_from_heights_by_equation_1() {
    for (profile, a) in analytic() {
        for share in [0.6, 0.9, 1.0, 1.7] {
            let x = a * share;
            let (closed, defined) = (profile.image(x), image_by_definition(&profile, x));
            assert!(
                (closed - defined).abs() < 1e-5 * profile.image(a),
                "{profile:?} at {x}: {closed} {defined}"
            );
        }
    }
}

#[test]
fn integrals_and_slopes_agree_with_quadrature_of_the_image() {
    for (profile, a) in analytic() {
        let b = profile.flat_radius();
        for share in [1.02, 1.3, 2.0] {
            let x = if b > 0.0 { b * share } else { a * share };
            // x = b + t² removes the square root at the rim
            let end = (x - b).sqrt();
            let over = |f: &dyn Fn(f64) -> f64| {
                (0..40)
                    .map(|k| {
                        let edge = |k: i32| end * f64::from(k) / 40.0;
                        composite(edge(k), edge(k + 1), |t| 2.0 * t * f(b + t * t))
                    })
                    .sum::<f64>()
            };
            let close = |p: f64, q: f64, what: &str| {
                assert!((p / q - 1.0).abs() < 1e-9, "{profile:?} {what} at {x}: {p:e} {q:e}");
            };
            close(profile.load_integral(x), over(&|x| x * profile.image_slope(x)), "load integral");
            close(profile.square_integral(x), over(&|x| profile.image(x).powi(2)), "square integral");
            close(profile.image(x), over(&|x| profile.image_slope(x)), "image");
        }
    }
}

#[test]
fn pressures_carry_the_load() {
    // 2π ∫ p r dr = F_N = 2 E* φ(a), with p = E* J/π: ∫ J r dr = φ(a)
    for (profile, a) in analytic() {
        let b = profile.flat_radius();
        // r = b ∓ s² smooths the singular rim, r = a sin-like end is smoothed by the second
        // substitution
        let inner = if b > 0.0 {
            (0..60)
                .map(|k| {
                    let edge = |k: i32| b.sqrt() * f64::from(k) / 60.0;
                    composite(edge(k), edge(k + 1), |s| {
                        let r = b - s * s;
                        2.0 * s * r * profile.pressure_integral(r.max(0.0), a)
                    })
                })
                .sum::<f64>()
        } else {
            0.0
        };
        let outer: f64 = (0..60)
            .map(|k| {
                let edge = |k: i32| f64::from(k) / 60.0;
                composite(edge(k), edge(k + 1), |s| {
                    // r from b to a with clustering at both ends
                    let w = s * s * (3.0 - 2.0 * s);
                    let r = b + (a - b) * w;
                    (a - b) * 6.0 * s * (1.0 - s) * r * profile.pressure_integral(r, a)
                })
            })
            .sum();
        let total = inner + outer;
        assert!((total / profile.load_integral(a) - 1.0).abs() < 2e-6, "{profile:?}: {total:e}");
    }
}

#[test]
fn central_pressures_match_their_closed_forms() {
    let (a, b, radius) = (1.887e-4, 1e-4, 0.01);
    let blunted = Profile::BluntedSphere { radius, flat_radius: b };
    let expected = (2.0 * leg(a, b) - b * (b / a).acos()) / radius;
    assert!((blunted.pressure_integral(0.0, a) / expected - 1.0).abs() < 1e-12);
    let sphere = Profile::Parabola { radius };
    assert!((sphere.pressure_integral(0.0, a) / (2.0 * a / radius) - 1.0).abs() < 1e-15);
    assert!(Profile::Cone { slope: 0.1 }.pressure_integral(0.0, a).is_infinite());
    assert!(blunted.pressure_integral(b, a).is_infinite());
    assert!(Profile::RoundedPunch { radius, flat_radius: b }.pressure_integral(b, a).is_finite());
}

/// Over parts of any length the pressure integral is the integral over these parts alone.
#[test]
fn parts_of_the_pressure_integral_keep_their_digits() {
    let table = ProfileTable::new((0..40).map(|i| (1e-5 * f64::from(i), 5e-10 * f64::from(i * i))).collect());
    let mut profiles = analytic();
    profiles.push((Profile::Table(table.unwrap()), 3e-4));
    for (profile, a) in profiles {
        for r in [0.0, 0.3, 0.8].map(|share: f64| share * a) {
            let from = r.max(profile.flat_radius()) + 0.05 * a;
            let middle = from + 0.4 * (a - from);
            let part = |from: f64, to: f64| profile.pressure_integral_between(r, (from, to));
            let (whole, parts) = (part(from, a), part(from, middle) + part(middle, a));
            assert!((parts / whole - 1.0).abs() < 1e-13, "{profile:?}, {r:e}: {parts:e} {whole:e}");
            let difference = profile.pressure_integral(r, a) - profile.pressure_integral(r, from);
            let finite = difference.is_finite();
            assert!(!finite || (difference / whole - 1.0).abs() < 1e-12, "{profile:?}, {r:e}");
            // of so short a part the midpoint rule knows all digits, and the difference two
            let (short, width) = (part(middle, middle * (1.0 + 1e-7)), 1e-7 * middle);
            let x = middle * (1.0 + 0.5e-7);
            let exact = profile.image_slope(x) * width / leg(x, r);
            assert!((short / exact - 1.0).abs() < 1e-8, "{profile:?}, {r:e}: {short:e} {exact:e}");
        }
    }
}

#[test]
fn the_rounded_punch_is_smooth_where_series_and_closed_form_meet() {
    let (radius, b) = (0.01, 1e-4);
    for eps in [1e-7, 1e-6] {
        let at = |alpha: f64| b / alpha.cos();
        let (below, above) = (at(0.03 * (1.0 - eps)), at(0.03 * (1.0 + eps)));
        let profile = Profile::RoundedPunch { radius, flat_radius: b };
        let rise = profile.load_integral(above) - profile.load_integral(below);
        let slope = 0.5 * (above + below) * profile.image_slope(0.5 * (above + below));
        assert!((rise / (slope * (above - below)) - 1.0).abs() < 1e-4, "{eps}: {rise:e}");
    }
}

#[test]
fn inverses_invert() {
    for (profile, a) in analytic() {
        if let Some(x) = profile.radius_at_depth(profile.image(a)) {
            assert!((x / a - 1.0).abs() < 1e-14, "{profile:?}");
        }
        if let Some(x) = profile.radius_at_load(profile.load_integral(a)) {
            assert!((x / a - 1.0).abs() < 1e-14, "{profile:?}");
        }
    }
}

#[test]
fn a_sampled_sphere_is_the_sphere() {
    let radius = 0.01;
    let points = (0..40).map(|i| 1e-5 * f64::from(i)).map(|r| (r, r * r / (2.0 * radius))).collect();
    let table = Profile::Table(ProfileTable::new(points).unwrap());
    let sphere = Profile::Parabola { radius };
    for x in [3e-6, 1e-5, 1.234e-4, 3.9e-4] {
        for (t, s) in [
            (table.image(x), sphere.image(x)),
            (table.height(x), sphere.height(x)),
            (table.image_slope(x), sphere.image_slope(x)),
            (table.load_integral(x), sphere.load_integral(x)),
            (table.square_integral(x), sphere.square_integral(x)),
            (table.pressure_integral(0.4 * x, x), sphere.pressure_integral(0.4 * x, x)),
        ] {
            assert!((t / s - 1.0).abs() < 1e-10, "x = {x}: {t:e} {s:e}");
        }
    }
}

#[test]
fn a_sampled_cone_converges_with_second_order() {
    let cone = Profile::Cone { slope: 0.02 };
    let error = |n: u32| {
        let points =
            (0..=n).map(|i| 3e-4 * f64::from(i) / f64::from(n)).map(|r| (r, cone.height(r))).collect();
        let table = Profile::Table(ProfileTable::new(points).unwrap());
        (table.image(3e-4) / cone.image(3e-4) - 1.0).abs()
    };
    let order = (error(50) / error(200)).log2() / 2.0;
    assert!(order > 1.9, "order {order}, errors {:e} {:e}", error(50), error(200));
}

#[test]
fn bad_tables_are_refused_with_their_place() {
    let message = |text: &str| ProfileTable::parse(text).unwrap_err().to_string();
    for (text, line, part) in [
        ("0 0\n1e-4 1e-7\n0.5e-4 2e-7", "line 3", "sort"),
        ("0 0\n1e-4 1e-7\n1e-4 2e-7", "line 3", "twice"),
        ("0 0\n1e-4\n2e-4 1e-6", "line 2", "1 column(s)"),
        ("0 0 0\n1e-4 0 0", "line 1", "3 column(s)"),
        ("0 0\n1e-4 abc\n2e-4 1", "line 2", "`abc` is not a number"),
        ("# r f\n0 0\nx 1", "line 3", "`x` is not a number"),
        ("0 0\n1e-4 nan\n2e-4 1", "line 2", "finite"),
        ("1e-5 0\n1e-4 1e-6\n2e-4 1", "line 1", "axis"),
        ("0 0\n1e-4 -1e-6\n2e-4 -4e-6", "line 2", "fall outward"),
        ("r z\n2e-4 0\n1e-4 3e-6\n0 4e-6", "line 3", "change the sign"),
        ("", "whole table", "0 point(s)"),
        ("0 0\n1e-4 1e-7", "whole table", "2 point(s)"),
    ] {
        let m = message(text);
        assert!(m.contains(line) && m.contains(part), "{text:?}: {m}");
    }
    let many = (0..45_000).map(|i| (1e-8 * f64::from(i), 0.0)).collect();
    let m = ProfileTable::new(many).unwrap_err().to_string();
    assert!(m.contains("45000 points") && m.contains("at most 20000") && m.contains("every 3"), "{m}");
    let fine = ProfileTable::parse("# head\n0, 0\n1e-5;\t1e-9 # note\n\n2e-5 4e-9\n").unwrap();
    assert_eq!(fine.points(), [(0.0, 0.0), (1e-5, 1e-9), (2e-5, 4e-9)]);
}

#[test]
fn a_dip_in_the_image_is_located() {
    let points = vec![(0.0, 0.0), (1e-5, 1e-9), (2e-5, 4e-9), (3e-5, 1e-9), (4e-5, 16e-9)];
    assert_eq!(ProfileTable::new(points).unwrap().monotone_up_to(), 2e-5);
}

#[test]
fn tables_survive_serde_and_refuse_bad_points() {
    let table = ProfileTable::new(vec![(0.0, 0.0), (1e-5, 1e-9), (2e-5, 4e-9)]).unwrap();
    let json = serde_json::to_string(&table).unwrap();
    assert_eq!(serde_json::from_str::<ProfileTable>(&json).unwrap(), table);
    assert!(serde_json::from_str::<ProfileTable>("[[0.0,0.0],[1.0,0.0],[0.5,0.0]]").is_err());
}

/// A sphere with waves on it that are too flat for its image to fall.
fn waved_sphere(points: u32) -> ProfileTable {
    let radii = (0..points).map(|i| 4e-4 * f64::from(i) / f64::from(points - 1));
    ProfileTable::new(radii.map(|r| (r, r * r / 0.02 + 1e-12 * (r * 1e5).cos())).collect()).unwrap()
}

#[test]
fn radii_of_a_table_are_found_without_iteration() {
    let table = waved_sphere(1000);
    assert_eq!(table.monotone_up_to(), f64::INFINITY);
    let profile = Profile::Table(table);
    for x in [1e-9, 3.3e-5, 4e-4 * 500.0 / 999.0, 2.2e-4, 3.9999e-4] {
        let depth = profile.radius_at_depth(profile.image(x)).unwrap();
        let load = profile.radius_at_load(profile.load_integral(x)).unwrap();
        assert!((depth / x - 1.0).abs() < 1e-9 && (load / x - 1.0).abs() < 1e-9, "{x:e}: {depth:e} {load:e}");
    }
    // at the end of the table and beyond
    for x in [4e-4, 5e-4] {
        assert!(profile.radius_at_depth(profile.image(x)).is_none());
        assert!(profile.radius_at_load(profile.load_integral(x)).is_none());
    }
}

#[test]
fn where_a_tables_image_falls_the_outermost_radius_counts() {
    let points = vec![(0.0, 0.0), (1e-5, 1e-9), (2e-5, 4e-9), (3e-5, 1e-9), (4e-5, 16e-9), (5e-5, 32e-9)];
    let profile = Profile::Table(ProfileTable::new(points).unwrap());
    let (peak, trough) = (profile.image(2e-5), profile.image(3e-5));
    assert!(peak > trough);
    // three radii share this image: the caller has to say which it means
    assert!(profile.radius_at_depth(0.5 * (peak + trough)).is_none());
    // above the peak there is one
    let x = profile.radius_at_depth(1.01 * peak).unwrap();
    assert!(x > 3e-5 && (profile.image(x) / (1.01 * peak) - 1.0).abs() < 1e-14);
    let level = 0.5 * (profile.load_integral(2e-5) + profile.load_integral(3e-5));
    let x = profile.radius_at_load(level).unwrap();
    assert!(x > 3e-5 && x < 4e-5, "{x:e}");
    assert!((profile.load_integral(x) - level).abs() < 1e-14 * level.abs());
}

#[test]
fn tables_beyond_what_is_computed_with_are_refused() {
    for (points, why) in [
        (vec![(0.0, 0.0), (1e-200, 1e-9), (1.0, 1.0)], "1e-30 m at least"),
        (vec![(0.0, 0.0), (1e29, 1e10), (1e31, 1e11)], "1e30 m at most"),
        (vec![(0.0, 0.0), (1.0, 1.0), (2.0, -2e30)], "1e30 m at most"),
    ] {
        let message = ProfileTable::new(points.clone()).unwrap_err().to_string();
        assert!(message.contains(why), "{points:?}: {message}");
    }
    // points next to each other, up and down by all that is taken, still make an image of numbers
    let mut jagged = vec![(0.0, 0.0)];
    jagged.extend(
        (0..200).map(|k| (f64::from_bits(1f64.to_bits() + k), if k % 2 == 0 { 1e30 } else { -1e30 })),
    );
    let jagged = ProfileTable::new(jagged).unwrap();
    assert!(
        jagged.radii().iter().all(|&x| jagged.image(x).abs() < 1e60 && jagged.square_integral(x) < 1e150)
    );
    // small is not too small
    let small = ProfileTable::new(vec![(0.0, 0.0), (1e-29, 1e-80), (2e-29, 4e-80)]).unwrap();
    assert!((Profile::Table(small).image(1e-29) / 2e-80 - 1.0).abs() < 1e-14);
}

#[test]
fn a_flat_punch_has_no_height_inside_and_no_end_of_it_outside() {
    let punch = Profile::FlatPunch { flat_radius: 1e-4 };
    assert_eq!([punch.height(0.0), punch.height(1e-4), punch.height(1.1e-4)], [0.0, 0.0, f64::INFINITY]);
    assert_eq!(Profile::Parabola { radius: 0.01 }.pressure_integral(2e-4, 1e-4), 0.0);
}

#[test]
fn copies_of_a_table_share_their_data() {
    let table = waved_sphere(100);
    assert!(std::ptr::eq(table.points(), table.clone().points()));
    assert_eq!(table, ProfileTable::new(table.points().to_vec()).unwrap());
    assert_ne!(table, waved_sphere(101));
}

/// A tip that is all but a point: what is left is the parabola f = r²/(2R), by as much as b is of
/// x.
#[test]
fn a_rounded_punch_with_next_to_no_flat_is_a_parabola() {
    let (radius, x) = (0.01, 2e-4);
    let parabola = Profile::Parabola { radius };
    for b in [1e-9, 1e-14, 1e-30] {
        let punch = Profile::RoundedPunch { radius, flat_radius: b };
        let values =
            |p: &Profile| [p.image(x), p.image_slope(x), p.load_integral(x), p.image_and_integrals(x).2];
        for (value, limit) in values(&punch).into_iter().zip(values(&parabola)) {
            assert!((value - limit).abs() <= (5.0 * b / x + 1e-14) * limit, "b = {b}: {value:e}, {limit:e}");
        }
    }
}

/// Whatever the flat is of the radius: the integrals have the derivatives that they should, also
/// where their forms meet.
#[test]
fn the_integrals_of_a_rounded_punch_have_its_image_as_derivative() {
    let (radius, b) = (0.01, 1e-5);
    let profile = Profile::RoundedPunch { radius, flat_radius: b };
    for share in [1.5, 3.0, 4.1, 4.13, 5.0, 30.0, 1e3, 1e5] {
        let x = share * b;
        let h = 1e-4 * x;
        let slope = |f: &dyn Fn(f64) -> f64| {
            // fourth order
            (8.0 * (f(x + h) - f(x - h)) - (f(x + 2.0 * h) - f(x - 2.0 * h))) / (12.0 * h)
        };
        let (square, load) =
            (slope(&|x| profile.image_and_integrals(x).2), slope(&|x| profile.load_integral(x)));
        let (g, rise) = (profile.image(x), profile.image_slope(x));
        assert!((square - g * g).abs() <= 1e-9 * g * g, "{share}: {square:e} {:e}", g * g);
        assert!((load - x * rise).abs() <= 1e-9 * x * rise, "{share}: {load:e} {:e}", x * rise);
        assert!((slope(&|x| profile.image(x)) - rise).abs() <= 1e-9 * rise, "{share}");
    }
}

/// Under a contact beside which the flat is nothing, J is that of the parabola, 2 √(a² − r²)/R.
#[test]
fn pressures_over_next_to_no_flat_are_those_of_a_parabola() {
    let (radius, b) = (0.01, 1e-30);
    for profile in
        [Profile::RoundedPunch { radius, flat_radius: b }, Profile::BluntedSphere { radius, flat_radius: b }]
    {
        for a in [1e-15, 1e-4, 1.3e46] {
            for r in [0.0, 0.5 * a] {
                let exact = 2.0 / radius * leg(a, r);
                let value = profile.pressure_integral(r, a);
                assert!(
                    (value / exact - 1.0).abs() < 1e-9,
                    "{profile:?}, {r:e} of {a:e}: {value:e}, {exact:e}"
                );
            }
        }
    }
}

#[test]
fn the_roughness_of_a_table_is_what_it_has_beyond_a_sphere() {
    let table = |rough: f64| {
        let point = |k: i32| {
            let r = 1e-5 * f64::from(k).sqrt();
            (r, r * r / 0.02 + if k % 2 == 0 { rough } else { -rough })
        };
        ProfileTable::new((0..=100).map(point).collect()).unwrap()
    };
    assert!(table(0.0).roughness() < 1e-20);
    assert_eq!(table(0.0).largest_fall(), 0.0);
    // each point lies 2 rough off the line through its neighbours
    assert!((table(1e-8).roughness() / 2e-8 - 1.0).abs() < 1e-9);
    assert!(table(1e-8).largest_fall() > 2e-8);
}

#[test]
fn a_height_on_the_axis_is_subtracted_and_remembered() {
    let table = ProfileTable::parse_in("r;f\n200;12,5\n100;11\n0;10,5\n", LengthUnit::Um).unwrap();
    assert_eq!(table.subtracted_height(), 10.5e-6);
    for (point, expected) in table.points().iter().zip([(0.0, 0.0), (1e-4, 0.5e-6), (2e-4, 2e-6)]) {
        assert!(point.0 == expected.0 && (point.1 - expected.1).abs() < 1e-20, "{point:?}");
    }
}

#[test]
fn a_scan_over_both_sides_is_sent_to_the_command() {
    let message = ProfileTable::parse("-1e-4 5e-7\n0 0\n1e-4 5e-7\n").unwrap_err().to_string();
    for part in ["line 1, \"-1e-4 5e-7\"", "r = -1e-4 m", "cargo fmu profile"] {
        assert!(message.contains(part), "{message}");
    }
}

/// Rough radii, unevenly spaced over three decades: a sphere with waves on it, above the axis.
fn rough(points: usize) -> ProfileTable {
    let radius = |i: usize| {
        let t = i as f64 / (points - 1) as f64;
        3e-4 * (0.1 * t + 0.9 * t.powi(3)) + 1e-8 * (i as f64 * 2.4).sin() * t * (1.0 - t)
    };
    let height = |r: f64| 2e-7 + r * r / 0.02 + 1e-9 * (r * 7e5).sin();
    ProfileTable::new((0..points).map(radius).map(|r| (r, height(r))).collect()).unwrap()
}

#[test]
fn the_profile_of_a_table_passes_through_its_points() {
    for points in [3, 20, 300, 2000] {
        let table = rough(points);
        for (r, f) in table.points() {
            assert!((table.height(*r) - f).abs() < 1e-12 * f, "{points} points, {r:e}");
        }
        assert_eq!(table.height(1.0), table.height(table.outer_radius()));
    }
}

#[test]
fn heights_and_pressures_of_a_table_are_those_of_its_pieces() {
    let table = rough(600);
    let (x, outer) = (table.radii(), table.outer_radius());
    let slope =
        |j: usize| (table.image(x[j + 1]) - table.image(x[j])) / ((x[j + 1] - x[j]) * (x[j + 1] + x[j]));
    // with x = r sin φ, f = (2/π) ∫ g dφ; g is smooth in φ on every piece
    let height = |r: f64| -> f64 {
        let angle = |x: f64| x.atan2(leg(r, x));
        let value = |phi: f64| FRAC_2_PI * table.image(r * phi.sin());
        let pieces = (0..599).filter(|j| x[*j] < r);
        pieces.map(|j| composite(angle(x[j]), angle(x[j + 1].min(r)), value)).sum()
    };
    let integral = |r: f64, a: f64| -> f64 {
        (0..599).map(|j| 2.0 * slope(j) * (leg(x[j + 1].min(a), r) - leg(x[j].min(a), r))).sum()
    };
    let scale = integral(0.0, outer);
    // at the points, next to them, and in the middle between them
    for pair in x.windows(2).step_by(37) {
        for r in [pair[0] * (1.0 + 1e-13), 0.5 * (pair[0] + pair[1]), pair[1]] {
            let (found, direct) = (table.height(r), height(r));
            assert!(
                r == 0.0 || (found - direct).abs() < 1e-12 * direct,
                "height at {r:e}: {found:e} {direct:e}"
            );
            for a in [0.5 * r, r, r * (1.0 + 1e-6), 1.1 * r, 0.3 * outer, outer, 2.0 * outer] {
                let (found, direct) = (table.pressure_integral(r, (r, a)), integral(r, a));
                assert!((found - direct).abs() < 1e-12 * scale, "{r:e} to {a:e}: {found:e} {direct:e}");
            }
        }
    }
    assert_eq!(table.pressure_integral(2.0 * outer, (2.0 * outer, 3.0 * outer)), 0.0);
}

#[test]
fn a_flat_tip_of_a_table_has_an_image_of_exactly_nothing() {
    for unit in [1e-29, 1e-4, 1e27] {
        let point = |i: u32| {
            let r = unit * f64::from(i);
            (r, 7.0 * unit + (r - 80.0 * unit).max(0.0) / 50.0)
        };
        let table = ProfileTable::new((0..200).map(point).collect()).unwrap();
        let image = |i: u32| table.image(unit * f64::from(i));
        assert!((0..=80).all(|i| image(i) == 7.0 * unit), "{unit:e}");
        assert!((81..200).all(|i| image(i) > 7.0 * unit), "{unit:e}");
        assert_eq!(table.height(33.3 * unit), 7.0 * unit);
    }
}

/// So near to the axis that a/r is no number: the value there.
#[test]
fn the_pressure_of_a_power_law_is_known_next_to_the_axis() {
    for exponent in [1.0, 2.0, 3.5] {
        let profile = Profile::PowerLaw { exponent, coefficient: 50.0 };
        let at = |r: f64| profile.pressure_integral(r, 1e-4);
        assert_eq!(at(1e-320), at(0.0), "{exponent}");
    }
}

/// Threads that ask for different arguments get the values of their own.
#[test]
fn kept_values_belong_to_their_arguments() {
    static LAST: super::LastValue = super::LastValue::new();
    let square = |x: f64| x * x;
    std::thread::scope(|scope| {
        for thread in 1..=4 {
            scope.spawn(move || {
                for k in 0..20_000 {
                    let x = f64::from(thread + k % 2);
                    assert_eq!(LAST.of(x, square), x * x);
                }
            });
        }
    });
}
