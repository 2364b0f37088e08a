use super::*;
use crate::parameters::NormalControl;
use crate::profile::Profile;
use crate::surface::Region;
use crate::surface::Surface;
use crate::wear::mesh::{UnitMesh, grading};
use crate::wear::patch::multigrid::TOLERANCE;
use crate::wear::patch::{Frozen, Motion, Rate, Rig, State};
use crate::wear::{Constants, Sliding, rosenbrock};
use std::sync::Arc;

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
}

const SCENES: [Scene; 7] = [
    Scene { region: Region::Annulus, control: NormalControl::Force, rim: false, rig: true },
    Scene { region: Region::Annulus, control: NormalControl::Indentation, rim: false, rig: false },
    Scene { region: Region::Annulus, control: NormalControl::Force, rim: false, rig: false },
    Scene { region: Region::Disc, control: NormalControl::Indentation, rim: false, rig: false },
    Scene { region: Region::Disc, control: NormalControl::Force, rim: false, rig: false },
    Scene { region: Region::Disc, control: NormalControl::Indentation, rim: true, rig: false },
    Scene { region: Region::Disc, control: NormalControl::Force, rim: true, rig: false },
];

impl Scene {
    /// The unworn region on a mesh for direct or iterative solution, and how much of the motion
    /// wears about the indentation depth.
    fn begin(self, cells: usize, halved: bool) -> (Patch, State, Rate, f64) {
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
        let mesh = Arc::new(UnitMesh::graded(self.region, cells, grading(self.region, cells), halved));
        let rig = self.rig.then(|| {
            // T/(2G*) of the unworn ball: U₀ c + m ∫ q dx from c on
            let outside = (a * a * (a - c) - (a.powi(3) - c.powi(3)) / 3.0) / RADIUS;
            let own = sliding.amplitude();
            Rig { amplitude: own + (own * c + constants.bound_slope() * outside) / a, compliance: 1.0 / a }
        });
        let motion = Motion { control: self.control, value, sliding, rig };
        let patch = Patch::new((surface, Frozen::default()), mesh, c, motion, self.rim, &constants);
        let depth = vec![0.0; cells + 1];
        let rate = patch.rate(&depth, a * a).expect("it is in contact");
        let state = State { depth, radius_squared: rate.radius_squared };
        (patch, state, rate, a / (0.6 * 1e-13 * 115e9 * slip))
    }

    /// Calls `sink` with the states of a life, on one mesh wherever its front goes, and the steps
    /// that error control takes there; returns what was counted.
    fn integrate(self, cells: usize, halved: bool, sink: &mut dyn FnMut(&State, &Rate, f64)) -> Counters {
        let (patch, mut state, mut rate, life) = self.begin(cells, halved);
        let (mut passed, mut step) = (0.0, 1e-4 * life);
        let mut counters = Counters::default();
        while passed < 3.0 * life {
            let trial = rosenbrock::step(&patch, &state, &rate, step, &mut counters);
            let ratio = trial.as_ref().map_or(f64::INFINITY, |trial| trial.error) / (1e-3 * DEPTH);
            let factor = if ratio.is_finite() { (0.8 * ratio.cbrt().recip()).clamp(0.2, 4.0) } else { 0.2 };
            if let Some(trial) = trial.filter(|_| ratio <= 1.0) {
                sink(&state, &rate, step);
                (state, rate) = (trial.state, trial.rate);
                passed += step;
            }
            step *= factor;
        }
        counters
    }
}

fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |most: f64, value| most.max(value.abs()))
}

/// Largest image of depths.
fn image(patch: &Patch, depth: &[f64]) -> f64 {
    let mut z = vec![0.0; depth.len()];
    patch.mesh.abel(depth, &mut z);
    largest(z.into_iter())
}

#[test]
fn both_forms_of_the_system_have_the_same_solution() {
    for scene in SCENES {
        let (direct, ..) = scene.begin(256, false);
        let (halved, ..) = scene.begin(256, true);
        let mut compared = 0;
        scene.integrate(256, false, &mut |state, rate, step| {
            let mut counters = Counters::default();
            let given = (&state.depth[..], rate);
            let (exact, volume) = Linear::new(&direct, given, 0.43 * step, &mut counters)
                .solve(&rate.growth, &mut counters)
                .expect("a solution");
            let multigrid = Multigrid::new(&halved, given, 0.43 * step);
            // far tighter than needed, up to the rounding in difference quotients for the edge; and
            // as it is used
            for (tolerance, most) in [(1e-10, 1e-5), (TOLERANCE, 20.0 * TOLERANCE)] {
                let (other, other_volume) =
                    multigrid.solve_to(tolerance, &rate.growth, &mut counters).expect("a solution");
                let error: Vec<f64> = exact.iter().zip(&other).map(|(a, b)| a - b).collect();
                let error = image(&direct, &error) / image(&direct, &exact);
                // beside the rate that it changes
                let volume_error = 0.43 * step * (volume - other_volume).abs() / rate.volume_rate;
                assert!(
                    error < most && volume_error < most,
                    "{scene:?}, {step:e}, to {tolerance:e}: image {error:e}, volume {volume_error:e}"
                );
            }
            compared += 1;
        });
        assert!(compared >= 2, "{scene:?}: {compared}");
    }
}

#[test]
fn both_forms_take_the_same_steps() {
    for scene in SCENES {
        let (direct, ..) = scene.begin(256, false);
        let (halved, ..) = scene.begin(256, true);
        let counters = scene.integrate(256, false, &mut |state, rate, step| {
            let mut counters = [Counters::default(); 2];
            let mut trial = |patch: &Patch, k: usize| {
                rosenbrock::step(patch, state, rate, step, &mut counters[k]).expect("a step")
            };
            let (exact, other) = (trial(&direct, 0), trial(&halved, 1));
            let error: Vec<f64> =
                exact.state.depth.iter().zip(&other.state.depth).map(|(a, b)| a - b).collect();
            let error = image(&direct, &error) / DEPTH;
            let volume = (exact.volume / other.volume - 1.0).abs();
            // a hundredth of the error that a step may have
            assert!(error < 1e-5 && volume < 1e-5, "{scene:?}, {step:e}: image {error:e}, volume {volume:e}");
            assert!(counters[0].solver_iterations == 0 && counters[1].solver_iterations > 0);
        });
        let halved = scene.integrate(256, true, &mut |_, _, _| ());
        let steps = (counters.factorisations, halved.factorisations);
        assert!(steps.0.abs_diff(steps.1) <= 1, "{scene:?}: {steps:?} steps");
    }
}

/// Work that does not depend on the clock: the iterations stay bounded while the mesh is refined.
#[test]
fn the_iterations_do_not_grow_with_the_cells() {
    for scene in SCENES {
        for cells in [256, 1024, 4096] {
            let counters = scene.integrate(cells, true, &mut |_, _, _| ());
            // a step solves its system four times
            let each = counters.solver_iterations as f64 / (4 * counters.factorisations) as f64;
            assert!(each <= 10.0, "{scene:?}, {cells} cells: {each} iterations");
        }
    }
}
