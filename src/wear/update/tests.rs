use super::*;
use crate::profile::Profile;
use crate::surface::{FrontMotion, TransformCache};
use crate::wear::{Sliding, SlipAtDepth};
use std::f64::consts::PI;

const E_STAR: f64 = 115e9;
const DEPTH: f64 = 4e-6;

fn constants() -> Constants {
    Constants {
        normal_modulus: E_STAR,
        tangential_modulus: 95e9,
        friction_coefficient: 0.6,
        wear_per_work: 1e-13,
        force_control: false,
    }
}

/// A ball pressed to d = 4 µm, on nodes for slip that reaches in to `front` (share of a).
fn scene(resolution: usize, front: f64) -> (Surface, Contact, NodeTransforms) {
    let profile = Profile::Parabola { radius: 0.01 };
    let mut surface = Surface::new(profile.clone());
    let contact = surface.contact(NormalControl::Indentation, DEPTH, 1.0).expect("a ball can be pressed");
    let nodes = Nodes::around(&profile, resolution, contact.radius, front * contact.radius);
    let tables = NodeTransforms::new(nodes.x());
    surface.set_worn(Some(nodes));
    (surface, contact, tables)
}

/// Fields of springs that slide by `path` (m) outside `front` (share of a).
fn slid(surface: &Surface, contact: &Contact, tables: &NodeTransforms, front: f64, path: f64) -> SlipFields {
    let nodes = surface.worn().expect("the scene has nodes");
    let load: Vec<f64> =
        nodes.x().iter().map(|&x| E_STAR * (contact.depth - surface.image(x)).max(0.0)).collect();
    let mut pressure =
        pressure_nodes(tables, nodes.x(), &load, &Edge::new(nodes, &[], contact, f64::INFINITY));
    pressure.resize(nodes.x().len(), 0.0);
    let slips = |x: f64| if x > front * contact.radius * (1.0 + 1e-9) { path } else { 0.0 };
    let slip_path: Vec<f64> = nodes.x().iter().map(|x| slips(*x)).collect();
    let friction = constants().friction_coefficient;
    let work_per_area = pressure.iter().zip(&slip_path).map(|(p, s)| friction * p * s).collect();
    SlipFields { work_per_area, slip_path, contact: *contact, clipped: 0.0, defect: 0.0, transforms: 0 }
}

fn update(surface: &Surface, tables: &NodeTransforms, fields: &SlipFields) -> Vec<f64> {
    worn_depth(surface, tables, fields, NormalControl::Indentation, &constants())
        .expect("it can be solved")
        .depth
}

/// q is linear in x² between the nodes, as is that of a ball: p at the nodes is Hertz's, to
/// rounding.
#[test]
fn the_pressure_at_the_nodes_is_hertzs() {
    for (resolution, front) in [(8, 0.0), (64, 0.4)] {
        let (surface, contact, tables) = scene(resolution, front);
        let nodes = surface.worn().expect("the scene has nodes");
        let load: Vec<f64> =
            nodes.x().iter().map(|&x| E_STAR * (contact.depth - surface.image(x)).max(0.0)).collect();
        let edge = Edge::new(nodes, &[], &contact, f64::INFINITY);
        let central = 2.0 * E_STAR * contact.radius / (PI * 0.01);
        for (x, p) in nodes.x().iter().zip(pressure_nodes(&tables, nodes.x(), &load, &edge)) {
            let hertz = central * (1.0 - (x / contact.radius).powi(2)).max(0.0).sqrt();
            assert!((p - hertz).abs() < 1e-9 * central, "{x}: {p:e} {hertz:e}");
        }
    }
}

#[test]
fn no_slip_is_no_wear() {
    let (surface, contact, tables) = scene(32, 0.4);
    let none = slid(&surface, &contact, &tables, 0.4, 0.0);
    assert!(update(&surface, &tables, &none).iter().all(|w| *w == 0.0));
    // and where the middle sticks it keeps exactly its shape
    let outside = slid(&surface, &contact, &tables, 0.4, 1e-4);
    let depth = update(&surface, &tables, &outside);
    let nodes = surface.worn().expect("the scene has nodes");
    for (x, w) in nodes.x().iter().zip(&depth) {
        if *x <= 0.4 * contact.radius {
            assert_eq!(*w, 0.0, "{x}");
        } else if *x < 0.99 * contact.radius {
            assert!(*w > 0.0, "{x}");
        }
    }
    let image = tables.abel(&depth);
    let stuck = nodes.x().partition_point(|x| *x <= 0.4 * contact.radius);
    assert!(image[..stuck].iter().all(|h| *h == 0.0));
}

/// As the slip becomes small the implicit update becomes the explicit one, Δw = (k/σ₀) A, at first
/// order.
#[test]
fn a_small_update_is_the_explicit_one() {
    let (surface, contact, tables) = scene(32, 0.0);
    let off = |path: f64| {
        let fields = slid(&surface, &contact, &tables, -1.0, path);
        let depth = update(&surface, &tables, &fields);
        let wanted = constants().wear_per_work * fields.work_per_area[0];
        (depth[0] / wanted - 1.0).abs()
    };
    let (coarse, fine) = (off(1e-6), off(1e-8));
    assert!(coarse < 0.1 && fine < 1e-3, "{coarse:e} {fine:e}");
    assert!((coarse / fine).log10() > 1.8, "{coarse:e} {fine:e}");
}

/// One update that would remove many d explicitly: the pressure falls where material goes, so that
/// under a held depth no more than the overlap can go, and the contact is not torn open.
#[test]
fn a_stiff_update_stays_bounded() {
    let (surface, contact, tables) = scene(48, 0.4);
    for (path, explicit) in [(1e-2, 0.1), (1.0, 10.0), (100.0, 1000.0)] {
        let fields = slid(&surface, &contact, &tables, 0.4, path);
        let middle = surface.worn().expect("nodes").x().partition_point(|x| *x < 0.7 * contact.radius);
        let wanted = constants().wear_per_work * fields.work_per_area[middle];
        assert!(wanted > explicit * DEPTH, "the explicit update would take {} d", wanted / DEPTH);
        let depth = update(&surface, &tables, &fields);
        // f∞ − f₀ of the final state is 0.391 d at most; one linear step overshoots that somewhat
        assert!(
            depth.iter().all(|w| *w >= 0.0 && *w < DEPTH),
            "{path}: {:e}",
            depth.iter().fold(0.0, |a: f64, b| a.max(*b))
        );
        let image = tables.abel(&depth);
        assert!(image.iter().all(|h| h.is_finite()));
    }
}

/// Sliding makes A = μ p s at every node, and cycles make the closed slip of their springs outside
/// their front and none inside; both are scaled to the springs' work.
#[test]
fn laws_of_repeated_motion_make_their_fields() {
    let (surface, contact, tables) = scene(64, 0.4);
    let nodes = surface.worn().expect("the scene has nodes");
    let fields = |law: SlipAtDepth, work: f64| {
        SlipFields::of_law((&surface, nodes), &tables, (&[law], work), &constants())
            .expect("the contact is found")
    };
    let bound_slope = constants().bound_slope();
    let path = 1e-3;
    let force = 4.0 / 3.0 * E_STAR * DEPTH * contact.radius;
    let work = constants().friction_coefficient * force * path;
    let onward = fields(SlipAtDepth::of_motion(Sliding::Onward, path, DEPTH, bound_slope), work);
    let expected = slid(&surface, &contact, &tables, -1.0, path);
    assert!(onward.defect < 2e-3 * work, "{:e}", onward.defect / work);
    for (found, expected) in onward.work_per_area.iter().zip(&expected.work_per_area) {
        assert!((found / expected - 1.0).abs() < 2e-3 || *expected == 0.0, "{found:e} {expected:e}");
    }
    // c = 0.4 a, so U₀ = m d (1 − 0.16)
    let amplitude = bound_slope * DEPTH * (1.0 - 0.16);
    let law = SlipAtDepth::of_motion(Sliding::Cycles(amplitude), 5.0, DEPTH, bound_slope);
    for work in [1.0, 3.0] {
        let cycles = fields(law.clone(), work);
        let total = nodes.integral_to_edge(&cycles.work_per_area, cycles.contact.radius);
        assert!((total / work - 1.0).abs() < 1e-12, "{total}");
        for (x, path) in nodes.x().iter().zip(&cycles.slip_path) {
            assert_eq!(*path > 0.0, *x > 0.4 * contact.radius * (1.0 + 1e-9), "{x:e}: {path:e}");
        }
        assert_eq!(cycles.clipped, 0.0);
    }
}

/// Slip under several depths adds up, each under its own pressure; the largest contact counts.
#[test]
fn slip_under_several_depths_adds_up() {
    let (surface, contact, tables) = scene(64, 0.0);
    let law = |depth: f64, path: f64| SlipAtDepth::of_motion(Sliding::Onward, path, depth, 1.0);
    let fields = |law: &[SlipAtDepth], work: f64| {
        let nodes = surface.worn().expect("the scene has nodes");
        SlipFields::of_law((&surface, nodes), &tables, (law, work), &constants())
            .expect("the contact is found")
    };
    let all = fields(&[law(0.5 * DEPTH, 2e-3), law(DEPTH, 1e-3)], 1.0);
    let (shallow, deep) = (fields(&[law(0.5 * DEPTH, 2e-3)], 1.0), fields(&[law(DEPTH, 1e-3)], 1.0));
    assert!((all.contact.radius / contact.radius - 1.0).abs() < 1e-12);
    // F ~ d^1.5, so that the work is shared as 2·0.5^1.5 to 1
    let share = 2.0 * 0.5f64.powf(1.5);
    for i in 0..all.slip_path.len() {
        let expected = (share * shallow.work_per_area[i] + deep.work_per_area[i]) / (1.0 + share);
        let scale = deep.work_per_area[0];
        assert!((all.work_per_area[i] - expected).abs() < 2e-3 * scale, "{i}");
        assert!((all.slip_path[i] - shallow.slip_path[i] - deep.slip_path[i]).abs() < 1e-12);
    }
}

/// Under a contact that opens nothing slips.
#[test]
fn a_law_out_of_contact_has_fields_of_zero() {
    let (surface, _, tables) = scene(16, 0.0);
    let law = SlipAtDepth::of_motion(Sliding::Onward, 1e-3, -1e-6, 1.0);
    let nodes = surface.worn().expect("the scene has nodes");
    let fields =
        SlipFields::of_law((&surface, nodes), &tables, (&[law], 1.0), &constants()).expect("no error");
    assert!(!fields.wear() && fields.slip_path.iter().all(|path| *path == 0.0));
}

#[test]
fn tables_are_made_once_for_a_set_of_nodes() {
    let (mut surface, contact, _) = scene(16, 0.4);
    let mut cache = TransformCache::default();
    let mut nodes = surface.worn().expect("the scene has nodes").clone();
    assert!(cache.get(&nodes).1);
    assert!(!cache.get(&nodes).1);
    nodes.adapt(surface.profile(), 1.3 * contact.radius, (0.3 * contact.radius, FrontMotion::Returns));
    assert!(cache.get(&nodes).1, "the nodes have moved");
    surface.set_worn(Some(nodes.clone()));
    assert!(!cache.get(&nodes).1);
}

/// What the iterations of an update are worth: none of them grows with the number of nodes.
#[test]
fn an_update_takes_a_bounded_number_of_iterations_whatever_the_nodes() {
    for front in [0.0, 0.4] {
        // from a hundredth of a depth, as between two updates of a life, to a fifth
        for path in [1e-3, 1e-2] {
            let counts = [32, 128, 512, 2048].map(|resolution| {
                let (surface, contact, transforms) = scene(resolution, front);
                let fields = slid(&surface, &contact, &transforms, front, path);
                let update =
                    worn_depth(&surface, &transforms, &fields, NormalControl::Indentation, &constants())
                        .expect("it can be solved");
                (update.systems, update.iterations)
            });
            println!("front {front}, path {path}: {counts:?}");
            assert!(counts.iter().all(|(systems, iterations)| *systems <= 8 && *iterations <= 100));
        }
    }
}

/// Under a held force a contact that wears much grows through many cells, and the iteration loses
/// its edge: it is then made in parts, and says so where even those are not followed.
#[test]
fn an_update_under_which_the_contact_grows_far_is_followed_in_parts() {
    let constants = Constants { force_control: true, ..constants() };
    let volume = |path: f64| {
        let (surface, contact, transforms) = scene(64, 0.4);
        let contact = Contact { control: contact.load, ..contact };
        let fields = SlipFields { contact, ..slid(&surface, &contact, &transforms, 0.4, path) };
        let update = worn_depth(&surface, &transforms, &fields, NormalControl::Force, &constants)
            .expect("it can be solved");
        println!("path {path}: {} systems, followed {}", update.systems, update.followed);
        let nodes = surface.worn().expect("the scene has nodes");
        (nodes.volume(&update.depth), update.systems, update.followed)
    };
    let (small, large, absurd) = (volume(1e-3), volume(0.1), volume(1e3));
    assert!(small.2 && small.1 <= 8, "{small:?}");
    assert!(large.2 && large.1 > 8, "{large:?}");
    assert!(small.0 < large.0 && !absurd.2, "{small:?} {large:?} {absurd:?}");
}
