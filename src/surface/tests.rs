use super::*;

fn ball() -> Profile {
    Profile::Parabola { radius: 0.01 }
}

/// Nodes for a contact of 0.2 mm whose slip reaches inward to 0.1 mm, with some wear outside of
/// that.
fn worn_nodes() -> Nodes {
    let mut nodes = Nodes::around(&ball(), 32, 2e-4, 1e-4);
    let image: Vec<f64> =
        nodes.x().iter().map(|&x| if x > 1e-4 { 1e-6 * (1.0 - (1e-4 / x).powi(2)) } else { 0.0 }).collect();
    let depth = vec![0.0; image.len()];
    nodes.set_worn(image, depth, &ball());
    nodes
}

#[test]
fn nodes_lie_in_the_slipping_annulus_with_one_at_the_front() {
    let nodes = Nodes::around(&ball(), 32, 2e-4, 1e-4);
    let x = nodes.x();
    assert!(x.windows(2).all(|pair| pair[0] < pair[1]));
    assert_eq!(x[0], 0.0);
    assert_eq!(x[1], 1e-4, "nothing to resolve where nothing slips");
    assert!(x.iter().filter(|x| **x > 1e-4 && **x < 2e-4).count() >= 31);
    assert!(nodes.x()[nodes.last()] > 2e-4, "room to grow");
    // the flat of a blunted sphere ends at a node
    let blunted = Profile::BluntedSphere { radius: 0.01, flat_radius: 1.3e-4 };
    assert!(Nodes::around(&blunted, 32, 2e-4, 1e-4).x().contains(&1.3e-4));
    // those of a punch do not pass its rim
    let punch = Profile::FlatPunch { flat_radius: 2e-4 };
    let nodes = Nodes::around(&punch, 32, 2e-4, 0.0);
    assert_eq!(nodes.x()[nodes.last()], 2e-4);
}

/// h is piecewise linear in x²: halving its cells is an identity, also for the integrals made from
/// it.
#[test]
fn refinement_changes_neither_the_image_nor_its_integrals() {
    let before = worn_nodes();
    let mut after = before.clone();
    after.adapt(&ball(), 1.7e-4, (0.6e-4, FrontMotion::Returns));
    assert!(after.x().len() > before.x().len() + 5);
    assert!(after.x().contains(&0.6e-4), "the new front has a node");
    let end = before.x()[before.last()];
    let square_at = |nodes: &Nodes, x: f64| nodes.place_in(&ball(), nodes.cell(x), x).square;
    for k in 0..2000 {
        let x = end * f64::from(k) / 2000.0;
        let [(g0, load0), (g1, load1)] =
            [&before, &after].map(|nodes| nodes.image_and_load_in(&ball(), nodes.cell(x), x));
        assert!((g0 - g1).abs() < 1e-20, "g at {x}: {g0:e} {g1:e}");
        assert!((load0 - load1).abs() < 1e-22, "load at {x}: {load0:e} {load1:e}");
        // four-point Lobatto is exact on each cell for a polynomial, whatever the cells
        let (q0, q1) = (square_at(&before, x), square_at(&after, x));
        assert!((q0 - q1).abs() < 1e-12 * q1.max(1e-20), "square at {x}: {q0:e} {q1:e}");
    }
}

/// ∫ g² has what the body has, however wide a cell is: a core without wear is one.
#[test]
fn the_square_integral_of_any_body_is_exact_where_nothing_has_worn() {
    let power = |exponent, coefficient| Profile::PowerLaw { exponent, coefficient };
    let flat = 0.6e-4;
    let bodies = [
        ball(),
        Profile::Cone { slope: 0.02 },
        power(1.5, 0.5),
        power(3.0, 2e5),
        power(4.0, 1e9),
        Profile::BluntedSphere { radius: 0.01, flat_radius: flat },
        Profile::RoundedPunch { radius: 0.01, flat_radius: flat },
    ];
    for profile in bodies {
        let mut nodes = Nodes::around(&profile, 32, 2e-4, 1e-4);
        let image: Vec<f64> = nodes.x().iter().map(|&x| 2e-3 * (x - 1e-4).max(0.0)).collect();
        let depth = vec![0.0; image.len()];
        nodes.set_worn(image, depth, &profile);
        let square_at = |x: f64| nodes.place_in(&profile, nodes.cell(x), x).square;
        for x in [0.3e-4, flat, 0.7e-4, 0.99e-4] {
            assert_eq!(square_at(x), profile.square_integral(x), "{profile:?}, {x}");
        }
        // Simpson's rule on the image itself
        let (count, end) = (4000, nodes.x()[nodes.last()]);
        let step = (end - 1e-4) / f64::from(count);
        let mut sum = 0.0;
        for k in 0..count {
            let at = |part: f64| nodes.image_at(&profile, 1e-4 + (f64::from(k) + part) * step).powi(2);
            sum += step / 6.0 * (at(0.0) + 4.0 * at(0.5) + at(1.0));
        }
        let expected = profile.square_integral(1e-4) + sum;
        assert!(
            (square_at(end) / expected - 1.0).abs() < 1e-6,
            "{profile:?}: {:e}",
            square_at(end) / expected - 1.0
        );
    }
}

#[test]
fn nothing_to_adapt_leaves_the_nodes() {
    let mut nodes = worn_nodes();
    nodes.adapt(&ball(), 2e-4, (1e-4, FrontMotion::Returns));
    let before = nodes.clone();
    nodes.adapt(&ball(), 2e-4, (1e-4, FrontMotion::Returns));
    assert_eq!(nodes, before);
}

/// Slip of a smaller amplitude leaves fine cells outside its front only. Those of a wider one
/// grow inward from them by no more than a factor from one to the next.
#[test]
fn cells_inside_a_former_front_grow_from_its_fine_ones() {
    let (a, former) = (2e-4, 1.7e-4);
    // a fortieth of an even cell
    let least = 0.025 * a / 64.0;
    let mut nodes = Nodes::around(&ball(), 64, a, former);
    let width = |nodes: &Nodes, j: usize| nodes.x()[j + 1] - nodes.x()[j];
    let at = |nodes: &Nodes| nodes.x().iter().position(|x| *x == former).expect("a node at the front");
    let front = at(&nodes);
    assert!(width(&nodes, front - 1) > 1e4 * width(&nodes, front), "fine outside only");
    nodes.adapt(&ball(), a, (0.8e-4, FrontMotion::Returns));
    let front = at(&nodes);
    for j in 1..nodes.last() {
        let (inner, outer) = (width(&nodes, j - 1), width(&nodes, j));
        let in_region = nodes.x()[j - 1] > 0.8e-4 && nodes.x()[j + 1] < a && inner.min(outer) >= least;
        assert!(!in_region || inner.max(outer) < 6.1 * inner.min(outer), "{j}: {inner:e} and {outer:e}");
    }
    assert!(width(&nodes, front - 1) < 4.1 * least, "{:e}", width(&nodes, front - 1));
}

/// New nodes beyond the old ones take the image whose profile is unworn there, not zero.
#[test]
fn extension_keeps_the_profile_unworn_outside() {
    let mut nodes = worn_nodes();
    let end = nodes.x()[nodes.last()];
    let inside = crate::transform::inverse_at(nodes.x(), nodes.worn_image(), 1.5e-4);
    nodes.adapt(&ball(), 1.5 * end, (1e-4, FrontMotion::Returns));
    assert!(nodes.x()[nodes.last()] > 1.5 * end);
    let worn = |r: f64| crate::transform::inverse_at(nodes.x(), nodes.worn_image(), r);
    assert!((worn(1.5e-4) - inside).abs() < 1e-20, "inside nothing changes");
    let deepest = worn(1.9e-4);
    for &x in nodes.x().iter().filter(|x| **x > 1.001 * end) {
        assert!(worn(x).abs() < 1e-12 * deepest, "worn {:e} at {x}", worn(x));
    }
}

#[test]
fn volume_is_that_of_the_cells() {
    let nodes = worn_nodes();
    // w = 1 − r²/b² is linear in r²: ∫ 2πr w dr up to the last node x is π x² (1 − x²/2b²)
    let depth: Vec<f64> = nodes.x().iter().map(|x| 1.0 - x * x / 1e-6).collect();
    let end = nodes.x()[nodes.last()];
    let exact = std::f64::consts::PI * end * end * (1.0 - end * end / 2e-6);
    assert!((nodes.volume(&depth) / exact - 1.0).abs() < 1e-12);
}

/// The contact of a worn surface solves its own equations: g(a) = d and the load integral, under
/// either control.
#[test]
fn worn_contacts_satisfy_their_equations_and_the_controls_agree() {
    let mut surface = Surface::new(ball());
    surface.set_worn(Some(worn_nodes()));
    for depth in [1e-8, 5e-7, 1e-6, 3e-6, 4.2e-6, 8e-6] {
        let contact = surface.contact(NormalControl::Indentation, depth, 1.0).expect("it can be pressed");
        assert!((surface.image(contact.radius) / depth - 1.0).abs() < 1e-9, "{depth}");
        assert!((surface.load(contact.radius) / contact.load - 1.0).abs() < 1e-9, "{depth}");
        let back = surface.contact(NormalControl::Force, contact.load, 1.0).expect("it can be pressed");
        assert!((back.depth / depth - 1.0).abs() < 1e-9, "{depth}: {}", back.depth);
        assert!((back.radius / contact.radius - 1.0).abs() < 1e-9, "{depth}");
    }
}

/// Where the image is level or falls a little, as near the end of a wear life, the edge is the
/// outermost crossing.
#[test]
fn the_contact_edge_is_the_outermost_crossing() {
    let mut nodes = Nodes::around(&ball(), 32, 2e-4, 1e-4);
    // g = d + ripple in the annulus, with the unworn ball rising beyond it
    let ripple = |x: f64| 3e-6 + 1e-9 * (x * 1e6).sin() - x * x / 0.01;
    let image: Vec<f64> =
        nodes.x().iter().map(|&x| if x > 1e-4 && x < 1.7e-4 { ripple(x) } else { 0.0 }).collect();
    let depth = vec![0.0; image.len()];
    nodes.set_worn(image, depth, &ball());
    let mut surface = Surface::new(ball());
    surface.set_worn(Some(nodes));
    let contact = surface.contact(NormalControl::Indentation, 3.0e-6, 1.0).expect("it can be pressed");
    let beyond = (1..1000).map(|k| contact.radius * (1.0 + 1e-3 * f64::from(k)));
    assert!(beyond.clone().all(|x| surface.image(x) > 3.0e-6), "a = {}", contact.radius);
    assert!(contact.radius > 1.55e-4, "a = {}", contact.radius);
}

/// Behind wear that ends at the last node the image falls, and with it the load integral. The
/// contact ends where that comes to the load for the last time.
#[test]
fn the_contact_radius_is_the_outermost_at_which_the_load_is_carried() {
    let mut nodes = Nodes::around(&ball(), 32, 2e-4, 1e-4);
    let last = nodes.last();
    let image = |k: usize| if k < last { 4e-6 * (nodes.x()[k] / 2e-4).powi(2) } else { 0.0 };
    let image = (0..=last).map(image).collect();
    nodes.set_worn(image, vec![0.0; last + 1], &ball());
    let (before_end, end) = (nodes.x()[last - 1], nodes.x()[last]);
    let mut surface = Surface::new(ball());
    surface.set_worn(Some(nodes));
    let (inside, at_end) = (surface.load(before_end), surface.load(end));
    assert!(at_end < inside);
    for share in [0.1, 0.5, 0.9] {
        let load = at_end + share * (inside - at_end);
        let contact = surface.contact(NormalControl::Force, load, 1.0).expect("the ball carries it");
        assert!(contact.radius > end, "{share}: {:e} of {end:e}", contact.radius);
        let carried = surface.load(contact.radius);
        assert!((carried / load - 1.0).abs() < 1e-14, "{share}: {carried:e} of {load:e}");
    }
}

/// What lies beyond a smaller contact keeps its image to a smooth change, also where nodes crowd
/// and their depths are not exactly those of the image.
#[test]
fn appended_nodes_keep_their_image_to_a_smooth_change() {
    const CROWD: f64 = 1.53;
    let mut x: Vec<f64> = (0..=80).map(|k| 0.025 * f64::from(k)).collect();
    let depth = |x: &f64| (1.0 - 0.4 * x * x).max(0.0);
    let image = NodeTransforms::new(&x).abel(&x.iter().map(depth).collect::<Vec<_>>());
    let zeros = vec![0.0; x.len()];
    let smooth = Nodes::holding((x.clone(), image, zeros), 64, None);
    x.extend((0..4).map(|k| CROWD + 1e-9 * f64::from(1 << k)));
    x.sort_by(f64::total_cmp);
    let image = x.iter().map(|x| smooth.line(smooth.worn_image(), *x)).collect();
    let off = |x: &f64| if x - CROWD > 3e-9 && x - CROWD < 1e-8 { 1.01 } else { 1.0 };
    let depths = x.iter().map(|x| off(x) * depth(x)).collect();
    let outside = Nodes::holding((x, image, depths), 64, None);
    let append_to = |change: f64| {
        let inside = 0..=40;
        let x = smooth.x()[inside.clone()].to_vec();
        let image = NodeTransforms::new(&x)
            .abel(&x.iter().map(|x| depth(x) + change * (1.0 - x * x)).collect::<Vec<_>>());
        let mut nodes = Nodes::holding((x, image, vec![0.0; 41]), 64, None);
        nodes.append_worn(&outside);
        nodes
    };
    let unchanged = append_to(0.0);
    for (x, image) in unchanged.x().iter().zip(unchanged.worn_image()) {
        let error = image - outside.line(outside.worn_image(), *x);
        assert!(error.abs() < 1e-11, "{x}: {error:e}");
    }
    let changed = append_to(0.1);
    assert!(changed.x().windows(2).filter(|pair| pair[1] - pair[0] < 1e-8).count() >= 3);
    let [before, change]: [Vec<f64>; 2] = [
        changed.x().iter().map(|x| outside.line(outside.worn_image(), *x)).collect(),
        changed.x().iter().map(|x| if *x > 1.0 { 0.0 } else { 0.1 * (1.0 - x * x) }).collect(),
    ];
    // the depth of the change is that inside, and none beyond
    let found: Vec<f64> = changed.worn_image().iter().zip(&before).map(|(new, old)| new - old).collect();
    let found = NodeTransforms::new(changed.x()).inverse_abel(&found);
    for (x, (found, change)) in changed.x().iter().zip(found.iter().zip(&change)) {
        assert!((found - change).abs() < 1e-9, "{x}: {found:e} {change:e}");
    }
    // and the image is smooth where the nodes crowd
    let crowd = changed.x().iter().zip(changed.worn_image()).filter(|(x, _)| (**x - CROWD).abs() < 0.05);
    let images: Vec<f64> = crowd.map(|(_, image)| *image).collect();
    assert!(images.windows(2).all(|pair| (pair[1] - pair[0]).abs() < 0.1), "{images:?}");
}
