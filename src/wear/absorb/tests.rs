use super::*;
use crate::engine::FrettingContact;
use crate::friction::{Path, SlipPiece, Springs};
use crate::parameters::{NormalControl, Parameters};
use crate::reference::wear::ConstantDepthEnd;
use crate::reference::wear_tables::{PARABOLA_CONSTANT_DEPTH, SPHERE_GROSS_SLIP};
use crate::reference::{Shape, WearingRow};
use crate::surface::{Contact, FrontWay, Surface};
use crate::wear::backlog::WearBacklog;
use std::f64::consts::{PI, TAU};

const E_STAR: f64 = 210e9 / (2.0 * (1.0 - 0.09));
const G_STAR: f64 = 2.0 * 210e9 / 2.6 / 1.7;
const MU: f64 = 0.6;
const RADIUS: f64 = 0.01;
/// d₀, m.
const DEPTH: f64 = 3.48291e-6;

fn constants(wear_per_work: f64, force_control: bool) -> Constants {
    Constants {
        normal_modulus: E_STAR,
        tangential_modulus: G_STAR,
        friction_coefficient: MU,
        wear_per_work,
        force_control,
    }
}

fn ball() -> Profile {
    Profile::Parabola { radius: RADIUS }
}

/// A ball on nodes for a contact of radius `a` (m) that slips outside `front`, worn by a law.
fn worn_by(
    law: SlipAtDepth,
    nodes: &Nodes,
    work: f64,
    constants: &Constants,
    tolerance: f64,
) -> (Nodes, f64) {
    let operator = Operator::new(nodes.x());
    let volume = constants.wear_per_work * work;
    let mut counters = Counters::default();
    let absorbed = absorb((nodes, &ball()), &operator, &[law], volume, (constants, tolerance), &mut counters)
        .expect("it is followed");
    let mut nodes = nodes.clone();
    println!("  {} steps, {} rejected", counters.factorisations, counters.rejected_steps);
    // a pressure that overshoots would heal: next to nothing
    assert!(absorbed.clipped <= 1e-9 * volume);
    nodes.set_worn(absorbed.worn.0, absorbed.worn.1, &ball());
    (nodes, absorbed.volume)
}

/// Work of a cycle of the ball at 0.84 u_max (c = 0.4 a₀), J.
fn work_of_cycle(force: f64, full_slip: f64, theta: f64) -> f64 {
    let rest = 1.0 - theta;
    MU * force * full_slip * (4.0 * theta + 4.0 * theta * rest.powf(1.5) - 3.2 * (1.0 - rest.powf(2.5)))
}

/// V on the way at constant depth, c = 0.4 a₀, from one call each; and the final shape.
#[test]
fn cycles_at_constant_depth_follow_the_closed_form() {
    let a = (DEPTH * RADIUS).sqrt();
    let (force, theta) = (4.0 / 3.0 * E_STAR * DEPTH * a, 0.84);
    let constants = constants(1e-13, false);
    let full_slip = constants.bound_slope() * DEPTH;
    let unit = PI * a * a * DEPTH / (constants.wear_per_work * MU * force * theta * full_slip);
    let run = |cells: usize, cycles: f64| {
        let nodes = Nodes::around(&ball(), cells, 1.3 * a, 0.4 * a);
        let slope = constants.bound_slope();
        let law = SlipAtDepth::of_cycles(theta * full_slip, cycles * unit, DEPTH, slope);
        let work = work_of_cycle(force, full_slip, theta) * cycles * unit;
        let (worn, volume) = worn_by(law, &nodes, work, &constants, 1e-3);
        // nothing wears inside the front, to the bit
        let inside = (0..100).map(|k| worn.depth_at(0.4 * a * f64::from(k) / 100.0)).fold(0.0, f64::max);
        assert_eq!(inside, 0.0);
        (worn, volume / (a * a * DEPTH))
    };
    for (cycles, volume) in &PARABOLA_CONSTANT_DEPTH[..2] {
        let errors = [16, 32, 64].map(|cells| (run(cells, *cycles).1 / volume - 1.0).abs());
        let order = (errors[0] / errors[2]).log2() / 2.0;
        println!("V at {cycles}: {errors:.1?}, order {order:.1}", errors = errors.map(|e| 1e3 * e));
        // of first order, since the contact edge wanders through cells at rest; what it converges
        // to is exact
        let limit = 2.0 * errors[2] - errors[1];
        assert!((0.8..1.3).contains(&order) && limit.abs() < 1e-3, "{cycles}: {errors:?}");
    }
    let end = ConstantDepthEnd::new(Shape::Parabola { radius: RADIUS }, DEPTH, 0.4 * a);
    let (worn, _) = run(32, 9.0);
    let radii = (1..200).map(|k| 1.4 * a * f64::from(k) / 200.0);
    let shape = radii.map(|r| (worn.depth_at(r) - end.worn_depth(r)).abs()).fold(0.0, f64::max) / DEPTH;
    println!("final shape: {shape:.1e} d0");
    assert!(shape < 2e-3, "{shape:e}");
}

/// Central wear of a ball that slides onward at constant force.
#[test]
fn sliding_at_constant_force_follows_the_table() {
    let a = (DEPTH * RADIUS).sqrt();
    let force = 4.0 / 3.0 * E_STAR * DEPTH * a;
    let constants = constants(1e-13, true);
    let nodes = Nodes::around(&ball(), 64, 2.2 * a, 0.0);
    for (path, central) in &SPHERE_GROSS_SLIP[..3] {
        let metres = path * a / (constants.wear_per_work * MU * E_STAR);
        let law = SlipAtDepth::of_sliding(metres, DEPTH);
        let (worn, volume) = worn_by(law, &nodes, MU * force * metres, &constants, 1e-3);
        let measured = worn.depth_at(0.0) / DEPTH;
        let volume = volume / (constants.wear_per_work * MU * force * metres) - 1.0;
        println!("S = {path}: w0/d0 {:+.1e}, V {volume:+.1e}", measured / central - 1.0);
        assert!((measured / central - 1.0).abs() < 1e-2 && volume.abs() < 1e-2, "{path}");
    }
}

/// Springs on a ball whose depth and displacement vary, worn by backlogs.
struct Scene {
    constants: Constants,
    surface: Surface,
    contact: Contact,
    springs: Springs,
    displacement: f64,
    backlog: WearBacklog,
    /// Volume worn by laws, m³.
    volume: f64,
    counters: Counters,
}

/// What a backlog may wear, over π a² d.
const WINDOW: f64 = 1e-3;

impl Scene {
    fn new(wear_per_work: f64) -> Self {
        Self {
            constants: constants(wear_per_work, false),
            surface: Surface::new(ball()),
            contact: Contact { control: 0.0, depth: 0.0, radius: 0.0, load: 0.0 },
            springs: Springs::default(),
            displacement: 0.0,
            backlog: WearBacklog::default(),
            volume: 0.0,
            counters: Counters::default(),
        }
    }

    fn contact_at(&self, depth: f64) -> Contact {
        self.surface.contact(NormalControl::Indentation, depth, 1.0).expect("a ball can be pressed")
    }

    fn slip_to(&mut self, to: Contact, displacement: f64) {
        let path = Path {
            surface: &self.surface,
            control: NormalControl::Indentation,
            bound_slope: self.constants.bound_slope(),
            from: self.contact,
            to,
            start: self.displacement,
            end: displacement,
            sampling: 1.0 / 64.0,
        };
        let mut slips = Vec::new();
        let (springs, work) = self.springs.walk_and_record(&path, Springs::default(), Some(&mut slips));
        let overlap = if to == self.contact && displacement == self.displacement {
            // nothing has moved but the bound: at which the springs have been all the time
            slips.iter().map(|piece| piece.overlap_moment(to.depth)).sum()
        } else {
            work / self.constants.bound_slope()
        };
        self.gather(&slips, overlap, (self.contact, to));
        (self.springs, self.contact, self.displacement) = (springs, to, displacement);
    }

    fn gather(&mut self, slips: &[SlipPiece], overlap: f64, (from, to): (Contact, Contact)) {
        self.backlog.record(slips, overlap, (&from, &to), self.surface.tip());
        self.backlog.work += 2.0 * G_STAR * self.constants.bound_slope() * overlap;
    }

    /// Walks a straight line in pieces of at most a twentieth of the depth.
    fn walk(&mut self, depth: f64, displacement: f64) {
        let (from, start) = (self.contact.depth, self.displacement);
        let pieces = ((depth - from).abs() / depth.max(from) / 0.05).ceil().max(1.0) as u32;
        for k in 1..=pieces {
            let share = f64::from(k) / f64::from(pieces);
            let to = self.contact_at(from + share * (depth - from));
            self.slip_to(to, start + share * (displacement - start));
            let room = PI * to.radius * to.radius * to.depth;
            if self.constants.wear_per_work * self.backlog.work > WINDOW * room {
                self.follow();
            }
        }
    }

    /// Wears the backlog off. Springs keep their place; those whose bound falls slip with it.
    fn follow(&mut self) {
        let backlog = std::mem::take(&mut self.backlog);
        let law = backlog.law();
        let front = law.iter().map(SlipAtDepth::front).fold(f64::INFINITY, f64::min);
        let deepest = law.iter().map(|law| law.depth).fold(0.0, f64::max);
        let radius = self.contact_at(deepest).radius.max(self.contact.radius);
        let inner =
            if front > self.surface.tip() { self.surface.radius_of_image(front, 0.0, radius) } else { 0.0 };
        let mut nodes = match self.surface.worn() {
            None => Nodes::around(&ball(), 64, radius, inner),
            Some(nodes) => nodes.clone(),
        };
        nodes.adapt(&ball(), radius, (inner, FrontWay::Returns));
        let operator = Operator::new(nodes.x());
        let volume = self.constants.wear_per_work * backlog.work;
        let scales = (&self.constants, 1e-3);
        let absorbed = absorb((&nodes, &ball()), &operator, &law, volume, scales, &mut self.counters)
            .expect("it is followed");
        self.volume += absorbed.volume;
        nodes.set_worn(absorbed.worn.0, absorbed.worn.1, &ball());
        let old = self.surface.clone();
        self.surface.set_worn(Some(nodes));
        self.springs = self.springs.moved_to(&old, &self.surface);
        let to = self.contact_at(self.contact.depth);
        self.contact = to;
        self.slip_to(to, self.displacement);
    }
}

/// V of the engine's own updates on the same history, m³.
fn engine(wear_per_work: f64, depth: impl Fn(f64) -> f64, place: impl Fn(f64) -> f64) -> f64 {
    let parameters = Parameters { normal_control: NormalControl::Indentation, ..Parameters::default() };
    let wear_coefficient = wear_per_work * parameters.hardness;
    let mut contact =
        FrettingContact::new(Parameters { wear_coefficient, ..parameters }).expect("valid parameters");
    contact.start_at(depth(0.0), 0.0).expect("a ball can be pressed");
    for k in (1..=320).map(f64::from) {
        contact.advance_to(depth(k), place(k)).expect("the line can be walked");
    }
    contact.wear_volume()
}

/// Load and displacement vary together, 20 cycles of 16 lines, against a row of springs stepped
/// explicitly and extrapolated to no spacing, which is good to some 1e-3.
#[test]
fn a_varying_load_wears_as_an_explicit_row_of_springs() {
    let a = (DEPTH * RADIUS).sqrt();
    let wear_per_work = 4e-11;
    let full_slip = constants(0.0, false).bound_slope() * DEPTH;
    for (name, phase, amplitude) in [
        ("in phase", 0.0, 0.6),
        ("a quarter ahead", 0.25, 0.6),
        ("anti-phase", 0.5, 0.6),
        ("gross slip", 0.25, 1.2),
    ] {
        let depth = |k: f64| DEPTH * (0.7 + 0.3 * (TAU * (k / 16.0 + phase)).sin());
        let place = |k: f64| amplitude * full_slip * (TAU * k / 16.0).sin();
        let row = |cells: usize, steps: usize| {
            let image = |x: f64| x * x / RADIUS;
            let mut row = WearingRow::new(image, (1.5 * a, cells), (E_STAR, G_STAR), (MU, wear_per_work));
            row.walk_to_depth(depth(0.0), 0.0, 1);
            (1..=320).map(f64::from).for_each(|k| row.walk_to_depth(depth(k), place(k), steps));
            row.worn_volume()
        };
        let exact = 2.0 * row(240, 24) - row(120, 12);
        let mut scene = Scene::new(wear_per_work);
        scene.walk(depth(0.0), 0.0);
        (1..=320).map(f64::from).for_each(|k| scene.walk(depth(k), place(k)));
        scene.follow();
        let volume = scene.volume / exact - 1.0;
        println!(
            "{name}: V = {:.4} a0² d0, {:+.2} %, the engine {:+.2} %, {} updates, {} steps",
            exact / (a * a * DEPTH),
            100.0 * volume,
            100.0 * (engine(wear_per_work, depth, place) / exact - 1.0),
            scene.counters.profile_updates,
            scene.counters.factorisations
        );
        assert!(volume.abs() < 5e-3, "{name}: {volume:e}");
        let on_profile = scene.surface.worn().map_or(0.0, Nodes::worn_volume);
        assert!((on_profile / scene.volume - 1.0).abs() < 1e-3, "{name}");
    }
}
