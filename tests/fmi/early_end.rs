//! Simulations that end before their stop time: at any point, after a step that was discarded or
//! refused; and the new simulation that the same instance begins afterwards.

use crate::host::{DISCARD, ERROR, Fmu, OK, WARNING};

const X: &str = "tangential_displacement";
const Y: &str = "tangential_displacement_y";
const START: f64 = 2.5;
const STOP: f64 = 12.5;

/// What the instance is set up as, and its inputs step by step.
struct Scene {
    name: &'static str,
    integers: &'static [(&'static str, i32)],
    reals: &'static [(&'static str, f64)],
    steps: &'static [&'static [(&'static str, f64)]],
    /// An input that no step can be made to.
    impossible: (&'static str, f64),
}

/// Every way in which a contact keeps a history: springs along a line and in the plane, wear by
/// strokes and by cycles, a rig.
const SCENES: [Scene; 4] = [
    Scene {
        name: "strokes",
        integers: &[],
        reals: &[("wear_coefficient", 0.1)],
        steps: &[
            &[(X, 3e-6)],
            &[(X, -3e-6)],
            &[(X, 1.1e-6), ("normal_force", 80.0)],
            &[(X, 3e-6)],
            &[(X, -2e-6)],
        ],
        impossible: ("normal_force", 1e61),
    },
    Scene {
        name: "the plane",
        integers: &[("normal_control", 2)],
        reals: &[("wear_coefficient", 0.1), ("indentation", 3.5e-6)],
        steps: &[&[(X, 2e-6)], &[(Y, 2e-6)], &[(X, -2e-6)], &[(X, 0.0), (Y, -2e-6)], &[(X, 3e-6)]],
        impossible: ("indentation", 1e61),
    },
    Scene {
        name: "cycles",
        integers: &[("loading", 2)],
        reals: &[("frequency", 100.0), ("displacement_amplitude", 1.5e-6)],
        steps: &[&[], &[("normal_force", 120.0)], &[], &[("displacement_amplitude", 2e-6)], &[]],
        impossible: ("normal_force", 1e61),
    },
    Scene {
        name: "a rig",
        integers: &[],
        reals: &[("wear_coefficient", 0.1), ("rig_stiffness", 2e7)],
        steps: &[&[(X, 6e-6)], &[(X, -6e-6)], &[("normal_force", 120.0)], &[(X, 6e-6)], &[(X, -6e-6)]],
        impossible: ("normal_force", 1e61),
    },
];

impl Scene {
    /// Set up and initialized, with a stop time.
    fn begin(&self, fmu: &Fmu) {
        self.integers.iter().for_each(|&(name, value)| assert_eq!(fmu.set_integer(name, value), OK));
        self.reals.iter().for_each(|&(name, value)| assert_eq!(fmu.set_real(name, value), OK));
        assert_eq!(fmu.setup(START, Some(STOP)), OK);
        assert_eq!((fmu.enter_initialization(), fmu.exit_initialization()), (OK, OK), "{}", self.name);
    }

    /// The first `count` steps of 1 s, and what the instance tells after each.
    fn run(&self, fmu: &Fmu, count: usize) -> Vec<Vec<u64>> {
        let mut states = vec![fmu.bits()];
        for (k, inputs) in self.steps[..count].iter().enumerate() {
            fmu.step_with(inputs, START + k as f64, 1.0);
            states.push(fmu.bits());
        }
        states
    }

    /// All that a fresh instance tells.
    fn alone(&self) -> Vec<Vec<u64>> {
        let fmu = Fmu::new();
        self.begin(&fmu);
        self.run(&fmu, self.steps.len())
    }

    /// The instance ends now, having reported `last` after `count` steps, and starts again as if
    /// nothing had been.
    fn end_and_start_again(&self, fmu: &Fmu, count: usize, status: i32, alone: &[Vec<u64>]) {
        let time = START + count as f64;
        fmu.messages();
        assert_eq!((fmu.terminate(), fmu.messages()), (OK, vec![]), "{}", self.name);
        // results stay, and so does what became of the steps
        assert_eq!(fmu.bits(), alone[count], "{}", self.name);
        assert_eq!((fmu.last_successful_time(), fmu.step_status()), (time, status as _), "{}", self.name);
        // but nothing goes on
        let ended = &["not allowed in state \"terminated\""];
        fmu.refused(fmu.do_step(time, 1.0), ended);
        fmu.refused(fmu.set_real(X, 0.0), ended);
        fmu.refused(fmu.terminate(), ended);
        assert_eq!((fmu.bits(), fmu.last_successful_time()), (alone[count].clone(), time), "{}", self.name);

        assert_eq!(fmu.reset(), OK);
        self.begin(fmu);
        assert_eq!((fmu.last_successful_time(), fmu.step_status()), (START, OK), "{}", self.name);
        assert_eq!(self.run(fmu, self.steps.len()), alone, "{}", self.name);
    }

    /// An instance that has begun and taken so many steps.
    fn after(&self, count: usize) -> Fmu {
        let fmu = Fmu::new();
        self.begin(&fmu);
        self.run(&fmu, count);
        fmu
    }
}

/// After the initialization alone, and after each of the steps, on one instance that starts again
/// each time.
#[test]
fn a_simulation_may_end_at_any_point() {
    for scene in SCENES {
        let (fmu, alone) = (Fmu::new(), scene.alone());
        assert!(alone.windows(2).all(|pair| pair[0] != pair[1]), "{}: every step does something", scene.name);
        for count in 0..=scene.steps.len() {
            scene.begin(&fmu);
            assert_eq!(scene.run(&fmu, count), alone[..=count]);
            scene.end_and_start_again(&fmu, count, OK as i32, &alone);
            assert_eq!(fmu.reset(), OK);
        }
    }
}

/// The input that could not be reached is forgotten, and so are a slope and a parameter that no
/// step has taken over.
#[test]
fn a_simulation_may_end_at_a_step_that_was_discarded() {
    for scene in SCENES {
        let alone = scene.alone();
        for count in [0, 3] {
            let fmu = scene.after(count);
            let (name, value) = scene.impossible;
            assert_eq!((fmu.set_real(name, value), fmu.set_slope(X, 1, 1e-6)), (OK, OK));
            assert_eq!(fmu.set_real("friction_coefficient", 0.3), OK);
            assert_eq!(fmu.do_step(START + count as f64, 1.0), DISCARD, "{}", scene.name);
            scene.end_and_start_again(&fmu, count, DISCARD as i32, &alone);
        }
    }
}

/// A call that was refused has changed nothing: the instance may end in order.
#[test]
fn a_simulation_may_end_after_an_error() {
    for scene in SCENES {
        let alone = scene.alone();
        for count in [0, 3] {
            let fmu = scene.after(count);
            let time = START + count as f64;
            fmu.refused(fmu.do_step(time, -1.0), &["communicationStepSize = -1.0"]);
            fmu.refused(fmu.do_step(time + 0.5, 1.0), &["currentCommunicationPoint"]);
            fmu.refused(fmu.do_step(time, STOP), &["stop time 12.5"]);
            scene.end_and_start_again(&fmu, count, ERROR as i32, &alone);
        }
    }
}

/// Without fmi2Terminate, too: an importer whose simulation broke off may reset at once.
#[test]
fn a_simulation_that_was_aborted_can_start_again() {
    for scene in SCENES {
        let (fmu, alone) = (Fmu::new(), scene.alone());
        for count in 0..scene.steps.len() {
            scene.begin(&fmu);
            scene.run(&fmu, count);
            assert_eq!(fmu.set_real(scene.impossible.0, scene.impossible.1), OK);
            assert_eq!(fmu.do_step(START + count as f64, 1.0), DISCARD);
            assert_eq!(fmu.reset(), OK);
        }
        // also during the initialization, which the importer gave up
        assert_eq!((fmu.setup(0.0, None), fmu.enter_initialization()), (OK, OK));
        assert_eq!((fmu.set_real("radius", 0.05), fmu.reset()), (OK, OK));
        scene.begin(&fmu);
        assert_eq!(scene.run(&fmu, scene.steps.len()), alone, "{}", scene.name);
    }
}

/// What comes with a warning comes with it again.
#[test]
fn a_new_simulation_warns_again() {
    let fmu = Fmu::new();
    for _ in 0..2 {
        assert_eq!((fmu.set_real("youngs_modulus_2", 70e9), fmu.enter_initialization()), (OK, OK));
        assert_eq!(fmu.exit_initialization(), WARNING);
        assert!(fmu.message().contains("not elastically similar"));
        assert_eq!((fmu.terminate(), fmu.reset()), (OK, OK));
    }
}
