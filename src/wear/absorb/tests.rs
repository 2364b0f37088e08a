use super::*;
use crate::friction::{Path, Springs};
use crate::parameters::NormalControl;
use crate::profile::Profile;
use crate::reference::WearingRow;
use crate::surface::{Contact, FrontWay, Surface};
use crate::wear::WearBacklog;

const E_STAR: f64 = 210e9 / (2.0 * (1.0 - 0.09));
const G_STAR: f64 = 2.0 * 210e9 / 2.6 / 1.7;
const MU: f64 = 0.6;

struct Mini {
    control: NormalControl,
    constants: Constants,
    surface: Surface,
    contact: Contact,
    springs: Springs,
    displacement: f64,
    backlog: WearBacklog,
    volume: f64,
    window: f64,
    resolution: usize,
    tolerance: f64,
    counters: Counters,
    operator: Option<(Vec<f64>, Operator)>,
    jump: f64,
    levels: usize,
    start: Option<Springs>,
    direction: f64,
}

impl Mini {
    fn new(control: NormalControl, per_work: f64, resolution: usize, window: f64, tolerance: f64) -> Self {
        let profile = Profile::Parabola { radius: 0.01 };
        Self {
            control,
            constants: Constants {
                normal_modulus: E_STAR,
                tangential_modulus: G_STAR,
                friction_coefficient: MU,
                wear_per_work: per_work,
                force_control: control == NormalControl::Force,
            },
            surface: Surface::new(profile),
            contact: Contact { control: 0.0, depth: 0.0, radius: 0.0, load: 0.0 },
            springs: Springs::default(),
            displacement: 0.0,
            backlog: WearBacklog::default(),
            volume: 0.0,
            window,
            resolution,
            tolerance,
            counters: Counters::default(),
            operator: None,
            jump: 0.0,
            levels: 0,
            start: None,
            direction: 0.0,
        }
    }

    fn walk(&mut self, value: f64, displacement: f64, pieces: usize) {
        let (v0, u0) = (self.contact.control, self.displacement);
        for k in 1..=pieces {
            let share = k as f64 / pieces as f64;
            self.piece(v0 + share * (value - v0), u0 + share * (displacement - u0));
        }
    }

    fn piece(&mut self, value: f64, displacement: f64) {
        let to = self.surface.contact(self.control, value, 2.0 * E_STAR).unwrap();
        let slope = self.constants.bound_slope();
        let path = Path {
            surface: &self.surface,
            control: self.control,
            bound_slope: slope,
            from: self.contact,
            to,
            start: self.displacement,
            end: displacement,
            sampling: 1.0 / self.resolution as f64,
        };
        let direction = (displacement - self.displacement).signum();
        if direction != self.direction {
            self.start = None;
        }
        self.direction = direction;
        let mut slips = Vec::new();
        let (springs, half) = self.springs.walk(&path, Springs::default(), Some(&mut slips));
        let tip = self.surface.tip();
        self.backlog.record(&slips, half / slope, (&self.contact, &to), tip);
        let work = 2.0 * G_STAR * half;
        self.backlog.work += work;
        (self.springs, self.contact, self.displacement) = (springs, to, displacement);
        let room = std::f64::consts::PI * to.radius.powi(2) * to.depth;
        if self.window > 0.0 && self.constants.wear_per_work * self.backlog.work > self.window * room {
            self.update();
        }
    }

    fn update(&mut self) {
        if self.backlog.is_empty() {
            return;
        }
        let backlog = std::mem::take(&mut self.backlog);
        let law = backlog.law(self.surface.tip());
        self.levels = self.levels.max(law.len());
        let front = law.iter().map(SlipAtDepth::front).fold(f64::INFINITY, f64::min);
        let deepest = law.iter().map(|law| law.depth).fold(0.0, f64::max);
        let radius = self.surface.contact(NormalControl::Indentation, deepest, 1.0).unwrap().radius.max(self.contact.radius);
        let inner = if front > self.surface.tip() { self.surface.radius_of_image(front, 0.0, radius) } else { 0.0 };
        let profile = self.surface.profile().clone();
        let mut nodes = match self.surface.worn() {
            None => Nodes::around(&profile, self.resolution, 1.02 * radius, inner),
            Some(nodes) => {
                let mut nodes = nodes.clone();
                nodes.adapt(&profile, radius, (inner, FrontWay::Returns));
                nodes
            }
        };
        if self.operator.as_ref().is_none_or(|(x, _)| x != nodes.x()) {
            self.operator = Some((nodes.x().to_vec(), Operator::new(nodes.x())));
        }
        let image_before: Vec<f64> = nodes.x().iter().map(|x| self.surface.image(*x)).collect();
        let (_, operator) = self.operator.as_ref().unwrap();
        let volume = self.constants.wear_per_work * backlog.work;
        let absorbed =
            absorb((&nodes, &profile), operator, &law, volume, (&self.constants, self.tolerance), &mut self.counters)
                .unwrap();
        let old_surface = self.surface.clone();
        self.volume += absorbed.volume;
        nodes.set_worn(absorbed.worn.0, absorbed.worn.1, &profile);
        self.surface.set_worn(Some(nodes));
        let now = self.surface.contact(self.control, self.contact.control, 2.0 * E_STAR).unwrap();
        let before = self.force();
        let _ = image_before;
        let moved = self.springs.moved_to(&old_surface, &self.surface);
        let slope = self.constants.bound_slope();
        let path = Path {
            surface: &self.surface,
            control: self.control,
            bound_slope: slope,
            from: self.contact,
            to: now,
            start: self.displacement,
            end: self.displacement,
            sampling: 1.0 / self.resolution as f64,
        };
        let mut slips = Vec::new();
        let (springs, _) = moved.walk(&path, Springs::default(), Some(&mut slips));
        self.springs = springs;
        if std::env::var("NOEXTRA").is_err() {
            // at the bound all the time
            let overlap: f64 = slips.iter().map(|p| now.depth * p.integral - p.image.0 * p.integral - p.moment).sum();
            self.backlog.record(&slips, overlap, (&now, &now), self.surface.tip());
            self.backlog.work += 2.0 * G_STAR * slope * overlap;
        }
        self.start = Some(self.springs.clone());
        self.contact = now;
        self.jump = f64::max(self.jump, (self.force() - before).abs() / (MU * 2.0 * E_STAR * now.load));
    }

    fn force(&self) -> f64 {
        2.0 * G_STAR * self.springs.deflection_integral(self.displacement)
    }

    fn total(&self) -> f64 {
        self.volume + self.constants.wear_per_work * self.backlog.work
    }
}

fn row(cells: usize, per_work: f64, extent: f64) -> WearingRow {
    WearingRow::new(|x| x * x / 0.01, (extent, cells), (E_STAR, G_STAR), (MU, per_work))
}

#[test]
#[ignore]
fn proto() {
    let d0 = 3.48291e-6;
    let a0 = (d0 * 0.01f64).sqrt();
    let umax = MU * E_STAR / G_STAR * d0;
    // depth between 0.4 and 1 d0
    let only = std::env::var("ONLY").map_or(99, |v| v.parse().unwrap());
    for (name, phase, amplitude) in [("in phase", 0.0, 0.6), ("quarter", 0.25, 0.6), ("anti", 0.5, 0.6), ("gross quarter", 0.25, 1.2)].into_iter().take(only) {
        let per_work = std::env::var("PW").map_or(4e-10, |v| v.parse().unwrap());
        let history: Vec<(f64, f64)> = (1..=320)
            .map(|k| {
                let t = 2.0 * std::f64::consts::PI * f64::from(k) / 16.0;
                (d0 * (0.7 + 0.3 * (t + 2.0 * std::f64::consts::PI * phase).sin()), amplitude * umax * t.sin())
            })
            .collect();
        let start = d0 * (0.7 + 0.3 * (2.0 * std::f64::consts::PI * phase).sin());
        let reference = |cells: usize, steps: usize| {
            let mut row = row(cells, per_work, 1.5 * a0);
            row.walk_to_depth(start, 0.0, 1);
            for &(d, u) in &history {
                row.walk_to_depth(d, u, steps);
            }
            if cells >= 240 && std::env::var("PROFILE").is_ok() {
                for (k, (r, w)) in row.worn_profile().enumerate() { if k % 10 == 0 && r < 1.3 * a0 { println!("    ref r {:.3} w {:.5}", r / a0, w / d0); } }
            }
            row.worn_volume()
        };
        let cells = std::env::var("CELLS").map_or(240, |v| v.parse().unwrap());
        let (r1, r2) = (reference(cells / 2, 12), reference(cells, 24));
        println!("{name}: V/(a0²d0) {:.5} {:.5} extrapolated {:.5}", r1 / (a0 * a0 * d0), r2 / (a0 * a0 * d0), (2.0 * r2 - r1) / (a0 * a0 * d0));
        let exact = 2.0 * r2 - r1;
        for (resolution, window, tolerance, share) in
            [(64, 1e-3, 1e-3, 0.05), (128, 1e-3, 1e-3, 0.05), (64, 1e-3, 1e-3, 0.01), (64, 2.5e-4, 1e-3, 0.02)]
        {
            let mut mini = Mini::new(NormalControl::Indentation, per_work, resolution, window, tolerance);
            mini.walk(start, 0.0, 1);
            let begin = std::time::Instant::now();
            for (k, &(d, u)) in history.iter().enumerate() {
                let pieces = ((d - mini.contact.depth).abs() / d0 / share).ceil().max(1.0) as usize;
                mini.walk(d, u, pieces);
                if window <= 0.0 && (k as i64 + 1 - (-window) as i64) % 16 == 0 {
                    mini.update();
                }
            }
            if std::env::var("PROFILE").is_ok() { let nodes = mini.surface.worn().unwrap();
                for k in 0..27 { let r = 0.05 * f64::from(k) * a0; println!("    r {:.3} w {:.5} h {:.5}", r / a0, nodes.depth_at(r) / d0, nodes.worn_part(r).0 / d0); } }
            let time = begin.elapsed().as_secs_f64();
            println!(
                "  n {resolution} window {window:e} tol {tolerance:e} share {share}: V off {:+.3} % T jump {:.1e}, levels {}, knots {}, {:.1} ms, {}",
                100.0 * (mini.total() / exact - 1.0), mini.jump, mini.levels, mini.springs.knots().len(), 1e3 * time, mini.counters
            );
        }
    }
}
