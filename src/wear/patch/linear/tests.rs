use super::*;
use crate::parameters::NormalControl;
use crate::profile::Profile;
use crate::surface::Region;
use crate::surface::{Nodes, Surface};
use crate::wear::mesh::UnitMesh;
use crate::wear::patch::{Frozen, Motion, Outside, Rate, Rig, State};
use crate::wear::{Constants, Sliding, rosenbrock};

const DEPTH: f64 = 4e-6;
const RADIUS: f64 = 0.01;

/// What a region looks like.
#[derive(Debug, Clone, Copy)]
struct Scene {
    region: Region,
    control: NormalControl,
    /// Whether the body is a punch that ends with the contact.
    rim: bool,
    /// Whether there is a rig as stiff as the contact.
    rig: bool,
    /// Whether other loads have worn the body further out.
    outside: bool,
    /// Whether there are cycles of other amplitudes among those of the largest.
    mixed: bool,
}

const BALL: Scene = Scene {
    region: Region::Annulus,
    control: NormalControl::Indentation,
    rim: false,
    rig: false,
    outside: false,
    mixed: false,
};

const SCENES: [Scene; 13] = [
    Scene { control: NormalControl::Force, rig: true, ..BALL },
    BALL,
    Scene { control: NormalControl::Force, ..BALL },
    Scene { region: Region::Disc, ..BALL },
    Scene { region: Region::Disc, control: NormalControl::Force, ..BALL },
    Scene { region: Region::Disc, rim: true, ..BALL },
    Scene { region: Region::Disc, control: NormalControl::Force, rim: true, ..BALL },
    Scene { mixed: true, ..BALL },
    Scene { control: NormalControl::Force, mixed: true, ..BALL },
    Scene { outside: true, ..BALL },
    Scene { control: NormalControl::Force, outside: true, ..BALL },
    Scene { region: Region::Disc, outside: true, ..BALL },
    Scene { region: Region::Disc, control: NormalControl::Force, outside: true, ..BALL },
];

impl Scene {
    /// The unworn region, and how much of the motion wears about the indentation depth.
    fn begin(self, cells: usize) -> (Patch, State, Rate, f64) {
        let profile = if self.rim {
            Profile::FlatPunch { flat_radius: 2e-4 }
        } else {
            Profile::Parabola { radius: RADIUS }
        };
        let constants = Constants {
            normal_modulus: 115e9,
            tangential_modulus: 95e9,
            friction_coefficient: 0.6,
            wear_per_work: 1e-13,
            force_control: self.control == NormalControl::Force,
        };
        let a = if self.rim { 2e-4 } else { (RADIUS * DEPTH).sqrt() };
        let surface = Surface::new(profile);
        let value = match self.control {
            NormalControl::Indentation => DEPTH,
            // F/(2E*) = a d − ∫ g dx
            NormalControl::Force => a * DEPTH - if self.rim { 0.0 } else { a.powi(3) / (3.0 * RADIUS) },
        };
        let (sliding, c, slip) = match self.region {
            Region::Annulus => {
                let amplitude = constants.bound_slope() * DEPTH * (1.0 - 0.16);
                (Sliding::Cycles(amplitude), 0.4 * a, 4.0 * amplitude)
            }
            Region::Disc => (Sliding::Onward, 0.0, 1.0),
        };
        let mesh = UnitMesh::shared(self.region, false, cells);
        let rig = self.rig.then(|| {
            // T/(2G*) of the unworn ball: U₀ c + m ∫ q dx from c on
            let outside = (a * a * (a - c) - (a.powi(3) - c.powi(3)) / 3.0) / RADIUS;
            let own = sliding.amplitude();
            Rig { amplitude: own + (own * c + constants.bound_slope() * outside) / a, compliance: 1.0 / a }
        });
        let shares = [(0.4, 1.0), (-0.1, 0.7), (0.9, 0.5)];
        let mixture = || shares.map(|(share, part)| (share, part * sliding.amplitude())).into();
        let mixture = self.mixed.then(mixture);
        let motion = Motion { control: self.control, value, sliding, mixture, rig };
        let outside = if self.outside { worn_outside(a) } else { Outside::default() };
        let places = (c, Frozen::default(), outside);
        let patch = Patch::new(surface, mesh, places, motion, self.rim, &constants);
        let depth = if self.outside { smooth_inside(&patch, a) } else { vec![0.0; cells + 1] };
        let rate = patch.rate(&depth, a * a).expect("it is in contact");
        let state = State { depth, radius_squared: rate.radius_squared };
        (patch, state, rate, a / (0.6 * 1e-13 * 115e9 * slip))
    }

    /// Calls `sink` with the states of a life, on one mesh wherever its front goes, and the steps
    /// that error control takes there; returns what was counted.
    fn integrate(self, cells: usize, sink: &mut dyn FnMut(&Patch, &State, &Rate, f64)) {
        let (patch, mut state, mut rate, life) = self.begin(cells);
        let (mut passed, mut step) = (0.0, 1e-4 * life);
        let mut counters = Counters::default();
        while passed < 3.0 * life {
            let linear =
                Linear::new(&patch, (&state.depth, &rate), rosenbrock::GAMMA * step, &mut counters).unwrap();
            let trial = rosenbrock::step(&patch, &state, &rate, step, &linear, &mut counters);
            let ratio = trial.as_ref().map_or(f64::INFINITY, |trial| trial.error) / (1e-3 * DEPTH);
            let factor = if ratio.is_finite() { (0.8 * ratio.cbrt().recip()).clamp(0.2, 4.0) } else { 0.2 };
            if let Some(trial) = trial.filter(|_| ratio <= 1.0) {
                sink(&patch, &state, &rate, step);
                (state, rate) = (trial.state, trial.rate);
                passed += step;
            }
            step *= factor;
        }
    }
}

/// A fiftieth of the depth worn off at the contact edge, falling to nothing at twice its area.
fn worn_outside(a: f64) -> Outside {
    let x: Vec<f64> = (0..=40).map(|k| a * f64::from(k) / 25.0).collect();
    let depth = x.iter().map(|x| 0.02 * DEPTH * (2.0 - (x / a).powi(2)).max(0.0).powi(2)).collect();
    Outside::of(&Nodes::holding((x.clone(), vec![0.0; x.len()], depth), 25, None))
}

/// Depths of a state inside, from none at the inner edge, that go on smoothly as those.
fn smooth_inside(patch: &Patch, a: f64) -> Vec<f64> {
    let (edge, slope) = patch.outside.depth_and_slope(a * a);
    let bend = edge - slope * patch.span(a * a);
    patch.mesh.share.iter().map(|phi| bend * phi * (1.0 - phi)).collect()
}

fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |most: f64, value| most.max(value.abs()))
}

/// What a solution leaves of its right side, over the solution, and what its change of the volume
/// rate lacks, over that rate: both against difference quotients of the rates, largest over a life.
fn defects(scene: Scene, cells: usize) -> (f64, f64) {
    let mut defects = (0.0_f64, 0.0_f64);
    scene.integrate(cells, &mut |patch, state, rate, step| {
        let gamma_step = 0.43 * step;
        let linear = Linear::new(patch, (&state.depth, rate), gamma_step, &mut Counters::default())
            .expect("the matrix is regular");
        let mut z = rate.growth.clone();
        linear.solve(&mut z);
        let (x, change) = (linear.depth(&z), linear.volume_change(&z));
        let small = 1e-7 * DEPTH / largest(x.iter().copied());
        let [more, less] = [small, -small].map(|factor| {
            let depth: Vec<f64> = state.depth.iter().zip(&x).map(|(w, x)| w + factor * x).collect();
            patch.rate(&depth, rate.radius_squared).expect("it is in contact")
        });
        let slope = |more: f64, less: f64| (more - less) / (2.0 * small);
        // the depth at a given inner edge and at a moving outer one is no unknown
        let left = (patch.mesh.first()..patch.end())
            .map(|i| x[i] - gamma_step * slope(more.growth[i], less.growth[i]) - rate.growth[i]);
        let missing = gamma_step * (change - slope(more.volume_rate, less.volume_rate)) / rate.volume_rate;
        defects.0 = defects.0.max(largest(left) / largest(x.iter().copied()));
        defects.1 = defects.1.max(missing.abs());
    });
    defects
}

/// The matrix holds the scaling to the work of the springs and has the drift in second order, where
/// the rates have it in fourth: what that leaves falls with the cells.
#[test]
fn the_system_is_that_of_the_rates() {
    for scene in SCENES {
        for (cells, most_left, most_missing) in [(32, 1.2e-2, 8e-3), (256, 4e-3, 1e-3)] {
            let (left, missing) = defects(scene, cells);
            assert!(
                left < most_left && missing < most_missing,
                "{scene:?}, {cells} cells: depth {left:e}, volume {missing:e}"
            );
        }
    }
}
