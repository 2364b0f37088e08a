use super::*;
use crate::parameters::NormalControl;
use crate::profile::Profile;

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

/// Work and slip as a sliding path `path` (m) outside `front` (share of a) brings them.
fn pending(surface: &Surface, contact: &Contact, tables: &NodeTransforms, front: f64, path: f64) -> Pending {
    let nodes = surface.worn().expect("the scene has nodes");
    let constants = constants();
    let load: Vec<f64> =
        nodes.x().iter().map(|&x| E_STAR * (contact.depth - surface.image(x)).max(0.0)).collect();
    let pressure = pressure_nodes(tables, nodes.x(), &load, &Edge::new(nodes, contact, f64::INFINITY));
    let traction: Vec<f64> = pressure.iter().map(|p| constants.friction_coefficient * p).collect();
    let slip: Vec<f64> = nodes
        .x()
        .iter()
        .map(|&x| if x > front * contact.radius * (1.0 + 1e-9) { path } else { 0.0 })
        .collect();
    let product: Vec<f64> = traction.iter().zip(&slip).map(|(t, s)| t * s).collect();
    // the work as the nodes find it, so that `add` need not rescale
    let work = nodes.integral_to_edge(&product, contact.radius);
    let mut pending = Pending::default();
    let missed = pending.add(nodes, contact, (&traction, &slip), work, 1.25);
    assert!(missed <= 1e-12 * work);
    pending
}

fn update(surface: &Surface, tables: &NodeTransforms, pending: &Pending) -> Vec<f64> {
    worn_depth(surface, tables, pending, NormalControl::Indentation, &constants())
        .expect("it can be solved")
        .depth
}

/// q is linear in x² between the nodes, as is that of a ball: p at the nodes is Hertz's, to rounding.
#[test]
fn the_pressure_at_the_nodes_is_hertzs() {
    for (resolution, front) in [(8, 0.0), (64, 0.4)] {
        let (surface, contact, tables) = scene(resolution, front);
        let nodes = surface.worn().expect("the scene has nodes");
        let load: Vec<f64> =
            nodes.x().iter().map(|&x| E_STAR * (contact.depth - surface.image(x)).max(0.0)).collect();
        let edge = Edge::new(nodes, &contact, f64::INFINITY);
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
    let none = pending(&surface, &contact, &tables, 0.4, 0.0);
    assert!(none.is_empty());
    assert!(update(&surface, &tables, &none).iter().all(|w| *w == 0.0));
    // and where the middle sticks it keeps exactly its shape
    let outside = pending(&surface, &contact, &tables, 0.4, 1e-4);
    let depth = update(&surface, &tables, &outside);
    let nodes = surface.worn().expect("the scene has nodes");
    for (x, w) in nodes.x().iter().zip(&depth) {
        if *x <= 0.4 * contact.radius {
            assert_eq!(*w, 0.0, "{x}");
        } else if *x < 0.99 * contact.radius {
            assert!(*w > 0.0, "{x}");
        }
    }
    let image = tables.ascend(&depth);
    let stuck = nodes.x().partition_point(|x| *x <= 0.4 * contact.radius);
    assert!(image[..stuck].iter().all(|h| *h == 0.0));
}

/// As the slip becomes small the implicit update becomes the explicit one, Δw = (k/σ₀) A, at first order.
#[test]
fn a_small_update_is_the_explicit_one() {
    let (surface, contact, tables) = scene(32, 0.0);
    let off = |path: f64| {
        let pending = pending(&surface, &contact, &tables, -1.0, path);
        let depth = update(&surface, &tables, &pending);
        let wanted = constants().wear_per_work * pending.work_per_area[0];
        (depth[0] / wanted - 1.0).abs()
    };
    let (coarse, fine) = (off(1e-6), off(1e-8));
    assert!(coarse < 0.1 && fine < 1e-3, "{coarse:e} {fine:e}");
    assert!((coarse / fine).log10() > 1.8, "{coarse:e} {fine:e}");
}

/// One update that would remove many d explicitly: the pressure falls where material goes, so that under a held depth no
/// more than the overlap can go, and the contact is not torn open.
#[test]
fn a_stiff_update_stays_bounded() {
    let (surface, contact, tables) = scene(48, 0.4);
    for (path, explicit) in [(1e-2, 0.1), (1.0, 10.0), (100.0, 1000.0)] {
        let pending = pending(&surface, &contact, &tables, 0.4, path);
        let middle = surface.worn().expect("nodes").x().partition_point(|x| *x < 0.7 * contact.radius);
        let wanted = constants().wear_per_work * pending.work_per_area[middle];
        assert!(wanted > explicit * DEPTH, "the explicit update would take {} d", wanted / DEPTH);
        let depth = update(&surface, &tables, &pending);
        // f∞ − f₀ of the final state is 0.391 d at most; one linear step overshoots that somewhat
        assert!(
            depth.iter().all(|w| *w >= 0.0 && *w < DEPTH),
            "{path}: {:e}",
            depth.iter().fold(0.0, |a: f64, b| a.max(*b))
        );
        let image = tables.ascend(&depth);
        assert!(image.iter().all(|h| h.is_finite()));
    }
}

#[test]
fn opposite_slip_is_clipped_and_counted_and_the_rest_takes_the_springs_work() {
    let (surface, contact, _) = scene(16, 0.0);
    let nodes = surface.worn().expect("the scene has nodes");
    let count = nodes.x().len();
    // two zones under one direction of traction, of which the outer one slips back
    let slip: Vec<f64> = (0..count).map(|i| if i < 5 { 2.0 } else { -2.0 }).collect();
    let gain: Vec<f64> = (0..count).map(|i| if i < 5 { 2.0 } else { 0.0 }).collect();
    let healed: Vec<f64> = (0..count).map(|i| if i < 5 { 0.0 } else { 2.0 }).collect();
    let found = nodes.integral_to_edge(&gain, contact.radius);
    let mut pending = Pending::default();
    let missed = pending.add(nodes, &contact, (&vec![1.0; count], &slip), 3.0 * found, 4.0);
    assert!((missed / (2.0 * found) - 1.0).abs() < 1e-12);
    assert_eq!(pending.clipped, nodes.volume(&healed));
    assert!(pending.slip_path.iter().all(|s| *s == 2.0));
    assert!(pending.work_per_area[..5].iter().all(|a| (a - 6.0).abs() < 1e-12));
    assert!(pending.work_per_area[5..].iter().all(|a| *a == 0.0));
    assert_eq!(pending.work, 3.0 * found);
}

/// Where all slips one way, a pressure below 0 is an overshoot of the last update: this one has to know of it, or would drive it
/// on.
#[test]
fn an_overshooting_pressure_is_not_clipped_before_the_update() {
    let (surface, contact, _) = scene(16, 0.0);
    let nodes = surface.worn().expect("the scene has nodes");
    let count = nodes.x().len();
    let traction: Vec<f64> = (0..count).map(|i| if i == 5 { -0.1 } else { 1.0 }).collect();
    let mut pending = Pending::default();
    let found = nodes.integral_to_edge(&traction, contact.radius);
    pending.add(nodes, &contact, (&traction, &vec![1.0; count]), found, 4.0);
    assert_eq!(pending.clipped, 0.0);
    assert!(pending.work_per_area.iter().zip(&traction).all(|(a, t)| (a - t).abs() < 1e-12));
}

#[test]
fn tables_are_made_once_for_a_set_of_nodes() {
    let (mut surface, contact, _) = scene(16, 0.4);
    let mut cache = TransformCache::default();
    let mut nodes = surface.worn().expect("the scene has nodes").clone();
    assert!(cache.get(&nodes).1);
    assert!(!cache.get(&nodes).1);
    nodes.adapt(
        surface.profile(),
        1.3 * contact.radius,
        (0.3 * contact.radius, crate::surface::FrontWay::Returns),
    );
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
                let pending = pending(&surface, &contact, &transforms, front, path);
                let update =
                    worn_depth(&surface, &transforms, &pending, NormalControl::Indentation, &constants())
                        .expect("it can be solved");
                (update.systems, update.iterations)
            });
            println!("front {front}, path {path}: {counts:?}");
            assert!(counts.iter().all(|(systems, iterations)| *systems <= 8 && *iterations <= 100));
        }
    }
}

/// Under a held force a contact that wears much grows through many cells, and the iteration loses its edge: it is then made in
/// parts, and says so where even those are not followed.
#[test]
fn an_update_under_which_the_contact_grows_far_is_followed_in_parts() {
    let constants = Constants { force_control: true, ..constants() };
    let volume = |path: f64| {
        let (surface, contact, transforms) = scene(64, 0.4);
        let contact = Contact { control: contact.load, ..contact };
        let pending =
            Pending { contact: Some(contact), ..pending(&surface, &contact, &transforms, 0.4, path) };
        let update = worn_depth(&surface, &transforms, &pending, NormalControl::Force, &constants)
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
