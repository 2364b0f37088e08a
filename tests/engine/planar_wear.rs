//! Wear of motion in the plane: against a row of vector springs stepped explicitly, and in its
//! limits.

use crate::common::*;
use fretting_contact::reference::{PlanarWearingRow, WearingRow};
use fretting_contact::{FrettingContact, Parameters};
use std::f64::consts::{PI, TAU};

/// The ball under the usual force, N₀ = `life` at 0.6 u_max.
fn begin(parameters: &Parameters, life: f64, cells: usize) -> (FrettingContact, PlanarWearingRow, f64) {
    let start = exact(&BALL, FORCE);
    let (a, d) = (start.normal.radius(), start.normal.depth());
    let wear_per_work = PI * a * a * d / (life * 0.6 * MU * FORCE * start.full_slip());
    let parameters =
        Parameters { wear_coefficient: wear_per_work * parameters.hardness, ..parameters.clone() };
    let contact = started(parameters);
    let radius = a * a / d;
    let row = WearingRow::new(|x| x * x / radius, (2.0 * a, cells), (E_STAR, G_STAR), (MU, wear_per_work));
    let mut row = PlanarWearingRow::new(row);
    row.walk(FORCE, [0.0; 2], 1);
    (contact, row, d)
}

/// What the two make of a path, side by side: volume (relative), profile (in d₀), force (in μF_N).
#[derive(Debug)]
struct Outcome {
    volume: f64,
    profile: f64,
    force: f64,
}

/// `path` gives load and place in shares of the usual force and of full slip.
fn compare(
    parameters: &Parameters,
    (life, cells, steps): (f64, usize, usize),
    corners: usize,
    path: impl Fn(usize) -> (f64, [f64; 2]),
) -> Outcome {
    let full = exact(&BALL, FORCE).full_slip();
    let (mut contact, mut row, depth) = begin(parameters, life, cells);
    let mut force = 0.0f64;
    for k in 1..=corners {
        let (load, place) = path(k);
        let (load, place) = (load * FORCE, place.map(|part| part * full));
        contact.advance_to_planar(load, place).unwrap();
        row.walk(load, place, steps);
        let [x, y] = row.tangential_force();
        let off = (contact.tangential_force() - x).hypot(contact.tangential_force_y() - y);
        force = force.max(off / (MU * load));
    }
    let profile =
        row.body().worn_profile().map(|(r, w)| (contact.worn_depth_at(r) - w).abs()).fold(0.0, f64::max);
    let missed = contact.profile_volume() / contact.wear_volume() - 1.0;
    assert!(missed.abs() < 1e-3, "the profile misses {missed:e} of the volume");
    let volume = contact.wear_volume() / row.body().worn_volume() - 1.0;
    let outcome = Outcome { volume, profile: profile / depth, force };
    println!("{outcome:?}; {}", contact.counters());
    outcome
}

fn circle(radius: f64) -> impl Fn(usize) -> (f64, [f64; 2]) {
    move |k| {
        let phase = TAU * k as f64 / 40.0;
        (1.0, [radius * phase.cos(), radius * phase.sin()])
    }
}

impl Outcome {
    /// The row itself is good to some 5e-3.
    #[track_caller]
    fn assert_close(&self, most: f64) {
        assert!(self.volume.abs() < most && self.profile < 1e-2 && self.force < 1e-2, "{self:?}");
    }
}

const ROW: (f64, usize, usize) = (300.0, 300, 10);

/// The engine takes traction and slip of a radius for parallel. On an orbit springs lag behind the
/// motion, each by its own angle: 0.6 % of V.
#[test]
fn orbits_in_partial_and_in_gross_slip() {
    for radius in [0.6, 1.5] {
        compare(&Parameters::default(), ROW, 600, circle(radius)).assert_close(8e-3);
    }
}

#[test]
fn lissajous_figures_under_loads_that_vary() {
    for (turns, swing) in [(2.0, 0.0), (1.0, 0.3), (1.5, 0.3)] {
        let path = |k: usize| {
            let phase = TAU * k as f64 / 60.0;
            (1.0 + swing * (0.7 * phase).sin(), [0.7 * phase.sin(), 0.5 * (turns * phase + 0.4).sin()])
        };
        compare(&Parameters::default(), ROW, 600, path).assert_close(5e-3);
    }
}

/// Finer cells and a tighter tolerance lead to the same wear, though the front creeps outward all
/// the time.
#[test]
fn an_orbit_wears_the_same_at_any_setting() {
    let full = exact(&BALL, FORCE).full_slip();
    for radius in [0.3, 0.6] {
        let worn = |(resolution, tolerance): (usize, f64)| {
            let settings = Parameters { resolution, tolerance, ..Parameters::default() };
            let (mut contact, ..) = begin(&settings, 60.0, 20);
            for k in 1..=400 {
                contact.advance_to_planar(FORCE, circle(radius)(k).1.map(|part| part * full)).unwrap();
            }
            contact.wear_volume()
        };
        let volumes = [(64, 1e-3), (64, 1e-4), (128, 1e-3), (128, 1e-4)].map(worn);
        let best = volumes[3];
        println!("{radius}: {:?}", volumes.map(|volume| volume / best - 1.0));
        for volume in volumes {
            close_to(volume, best, 6e-3, &format!("{radius}: {volumes:?}"));
        }
    }
}

/// Strokes at an angle wear what strokes along x do.
#[test]
fn a_line_at_any_angle_wears_as_the_line_along_x() {
    for amplitude in [0.6, 1.5] {
        let (mut plane, _, depth) = begin(&Parameters::default(), 300.0, 20);
        let (mut line, ..) = begin(&Parameters::default(), 300.0, 20);
        let full = exact(&BALL, FORCE).full_slip();
        for k in 1..=40 * 20 {
            let place = amplitude * full * (TAU * f64::from(k) / 40.0).sin();
            plane.advance_to_planar(FORCE, [0.8 * place, -0.6 * place]).unwrap();
            line.advance_to(FORCE, place).unwrap();
        }
        let volume = plane.wear_volume() / line.wear_volume() - 1.0;
        let profile =
            line.probe_radii().into_iter().map(|r| (plane.worn_depth_at(r) - line.worn_depth_at(r)).abs());
        let profile = profile.fold(0.0, f64::max) / depth;
        println!("{amplitude}: volume {volume:.1e}, profile {profile:.1e} of d");
        assert!(volume.abs() < 5e-3 && profile < 1e-2, "{amplitude}: {volume:e} {profile:e}");
    }
}

/// The body is all but lifted off in one step: the same wears as where it is lifted off.
#[test]
fn a_load_that_falls_to_next_to_nothing_in_a_step_is_followed() {
    for (profile, wear_coefficient) in [(BALL, 3.2e-4), (BALL, 3.2e-2), (PUNCH, 3.2e-4)] {
        let full = exact(&profile, FORCE).full_slip();
        let worn = |load: f64| {
            let wearing = Parameters { profile: profile.clone(), wear_coefficient, ..Parameters::default() };
            let mut contact = started(wearing);
            contact.advance_to_planar(FORCE, [0.3 * full, 0.6 * full]).unwrap();
            contact.advance_to_planar(load, [-0.3 * full, 0.2 * full]).unwrap();
            contact.wear_volume()
        };
        for load in [1e-4, 1e-6, 1e-9, 1e-14] {
            close_to(worn(load), worn(0.0), 2e-3, "worn volume");
        }
    }
}

/// A body that lifts off while it slides back wears the same profile along x and along y, whatever
/// the steps: springs that have left do not slip on.
#[test]
fn lift_off_leaves_the_same_profile_in_any_direction_and_steps() {
    let full = exact(&BALL, FORCE).full_slip();
    let lifted = |direction: [f64; 2], steps: usize| {
        let mut contact = started(Parameters::default());
        let place = |u: f64| direction.map(|part| u * full * part);
        contact.advance_to_planar(FORCE, place(1.5)).unwrap();
        for k in 1..=steps {
            let share = k as f64 / steps as f64;
            contact.advance_to_planar(FORCE * (1.0 - share), place(1.5 - share)).unwrap();
        }
        contact
    };
    let one = lifted([1.0, 0.0], 1);
    for direction in [[1.0, 0.0], [0.0, 1.0], [0.6, 0.8]] {
        for steps in [1, 10, 300] {
            let contact = lifted(direction, steps);
            let off = |r: f64| (contact.worn_depth_at(r) - one.worn_depth_at(r)).abs() / one.wear_depth();
            let radius = *contact.probe_radii().last().unwrap();
            let profile = (0..100).map(|i| off(radius * f64::from(i) / 100.0)).fold(0.0, f64::max);
            assert!(profile < 5e-3, "{direction:?}, {steps} steps: the profile differs by {profile:e}");
            close_to(contact.wear_depth(), one.wear_depth(), 2e-3, "depth of wear");
        }
    }
}

/// Worn volume and profile are computed by different code: (k/σ₀) times the springs' work, and what
/// the transforms have taken off.
#[test]
fn the_profile_has_worn_by_the_work_of_friction() {
    for profile in [BALL, CONE, BLUNTED, ROUNDED, PUNCH] {
        let start = exact(&profile, FORCE);
        let (a, d) = (start.normal.radius(), start.normal.depth());
        let wear_per_work = PI * a * a * d / (300.0 * 0.6 * MU * FORCE * start.full_slip());
        let hardness = Parameters::default().hardness;
        let mut contact = started(Parameters {
            profile: profile.clone(),
            wear_coefficient: wear_per_work * hardness,
            ..Parameters::default()
        });
        let mut random = seeded(3);
        for k in 1..=200 {
            let mut up_to = |most: f64| start.full_slip() * uniform(&mut random, -most, most);
            let place = [up_to(1.2), up_to(1.2)];
            let load = FORCE * if k % 3 == 0 { uniform(&mut random, 0.7, 1.3) } else { 1.0 };
            contact.advance_to_planar(load, place).unwrap();
        }
        let (volume, on_profile) = (contact.wear_volume(), contact.profile_volume());
        println!(
            "{profile:?}: {volume:e} {on_profile:e}, clipped {:e} of the work, missed {:e}",
            contact.clipped_work() / contact.dissipated_energy(),
            contact.transform_defect() / contact.dissipated_energy()
        );
        close_to(volume, wear_per_work * contact.dissipated_energy(), 1e-12, "by the work");
        close_to(on_profile, volume, 1e-3, &format!("{profile:?}"));
    }
}

/// How the caller splits the sides of a polygon changes what has worn by far less than the
/// tolerance of the integration promises.
#[test]
fn a_step_may_be_split() {
    let full = exact(&BALL, FORCE).full_slip();
    let worn = |parts: u32| {
        let (mut contact, ..) = begin(&Parameters::default(), 300.0, 20);
        let mut last = [0.0; 2];
        for k in 1..=400 {
            let place = circle(0.8)(k).1.map(|part| part * full);
            for part in 1..=parts {
                let share = f64::from(part) / f64::from(parts);
                let at = |k: usize| last[k] + share * (place[k] - last[k]);
                contact.advance_to_planar(FORCE, if part == parts { place } else { [at(0), at(1)] }).unwrap();
            }
            last = place;
        }
        contact.wear_volume()
    };
    let (one, many) = (worn(1), worn(7));
    println!("{one:e} {many:e}");
    close_to(many, one, 2e-3, "volume");
}
