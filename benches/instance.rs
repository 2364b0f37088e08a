//! What an instance costs through the C interface: its memory beyond the tables that all share, its
//! start, and a life with wear step by step, with its error against cyclic loading.
//!
//! `cargo bench --bench instance`. Times are medians of repeats on this machine; bytes are what the
//! allocator was asked for.

#[path = "../tests/fmi/counting.rs"]
mod counting;
#[path = "../tests/fmi/host.rs"]
#[allow(dead_code, reason = "the tests use more of it")]
mod host;

use counting::{Counting, allocations, live_bytes};
use fretting_contact::NormalControl;
use fretting_contact::problems::{PARABOLA, Problem};
use host::{Fmu, OK, reference};
use std::f64::consts::TAU;
use std::time::{Duration, Instant};

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Steps of a cycle.
const STEPS: u32 = 100;
/// Cycles of a life.
const CYCLES: u32 = 10_000;
/// Ñ at the end of the life: most of the wear has happened.
const LIFE: f64 = 1.0;

fn main() {
    // cargo passes --bench when it benchmarks; anything else only wants to know that this runs
    let benchmark = std::env::args().any(|argument| argument == "--bench");
    let (starts, cycles, lives) = if benchmark { (2000, CYCLES, 3) } else { (2, 20, 1) };
    memory();
    start(starts);
    rollback(if benchmark { 20_000 } else { 2 });
    for control in [NormalControl::Indentation, NormalControl::Force] {
        life(control, cycles, lives);
    }
}

/// Cycles of U = amplitude·sin under a load that swings by ±`swing` N, from cycle `first` on.
fn run(fmu: &Fmu, cycles: std::ops::Range<u32>, amplitude: f64, swing: f64) {
    let inputs = [reference("normal_force"), reference("tangential_displacement")];
    for count in cycles.start * STEPS..cycles.end * STEPS {
        let phase = TAU * f64::from((count + 1) % STEPS) / f64::from(STEPS);
        let values = [100.0 + swing * phase.cos(), amplitude * phase.sin()];
        assert_eq!(fmu.set_reals(&inputs, &values), OK);
        assert_eq!(fmu.do_step(f64::from(count), 1.0), OK);
    }
}

/// Bytes of one instance at several stages of its life, while another keeps the shared tables
/// alive.
fn memory() {
    println!("memory of one instance beyond shared tables, KiB");
    for (name, wear, swing) in [
        ("no wear, steady load", 0.0, 0.0),
        ("no wear, varying load", 0.0, 30.0),
        ("wear, steady cycles", 3.2e-2, 0.0),
        ("wear, varying load", 3.2e-2, 30.0),
    ] {
        let make = || Fmu::started(|fmu| assert_eq!(fmu.set_real("wear_coefficient", wear), OK));
        let keeper = make();
        run(&keeper, 0..20, 1e-6, swing);
        let before = live_bytes();
        let fmu = make();
        let started = live_bytes();
        run(&fmu, 0..20, 1e-6, swing);
        let [started, run] = [started, live_bytes()].map(|bytes| (bytes - before) as f64 / 1024.0);
        println!("  {name:24} started {started:7.1}, after 20 cycles {run:7.1}");
    }
}

/// Time from fmi2Instantiate to the end of the initialization.
fn start(repeats: usize) {
    let (mut requests, mut times) = (0, Vec::with_capacity(repeats));
    for _ in 0..repeats {
        let (before, now) = (allocations(), Instant::now());
        let fmu = Fmu::started(|_| {});
        times.push(now.elapsed());
        requests = allocations() - before;
        drop(fmu);
    }
    println!("instantiate, set up, initialize: {:.2?}, {requests} requests for memory", median(times));
}

/// A state saved, taken back and freed, against the step that is taken back.
fn rollback(repeats: u32) {
    println!("rollback: state saved + restored + freed, against one step, medians");
    for (name, wear, swing) in [
        ("no wear, steady load", 0.0, 0.0),
        ("no wear, varying load", 0.0, 30.0),
        ("wear, steady cycles", 3.2e-2, 0.0),
        ("wear, varying load", 3.2e-2, 30.0),
    ] {
        let fmu = Fmu::started(|fmu| assert_eq!(fmu.set_real("wear_coefficient", wear), OK));
        run(&fmu, 0..20, 1e-6, swing);
        let input = [reference("tangential_displacement")];
        let (mut states, mut steps, mut bytes) = (Vec::new(), Vec::new(), 0);
        for k in 0..repeats {
            let now = Instant::now();
            let mut saved = fmu.save();
            let saving = now.elapsed();
            // on and on within a stroke, a little less far each time
            let target = 0.3e-6 * (1.0 - f64::from(k % 10) * 1e-3);
            assert_eq!(fmu.set_reals(&input, &[target]), OK);
            let now = Instant::now();
            assert_eq!(fmu.do_step(f64::from(20 * STEPS), 1.0), OK);
            steps.push(now.elapsed());
            if k == 0 {
                bytes = fmu.serialized(saved).len();
            }
            let now = Instant::now();
            assert_eq!(fmu.restore(saved), OK);
            assert_eq!(fmu.free_saved(&mut saved), OK);
            states.push(saving + now.elapsed());
        }
        println!(
            "  {name:24} {:.2?} against {:.2?}; {bytes} bytes serialised",
            median(states),
            median(steps)
        );
    }
}

fn median(mut times: Vec<Duration>) -> Duration {
    times.sort();
    times[times.len() / 2]
}

/// A life in steps, and its worn volume against that of cyclic loading in one step.
fn life(control: NormalControl, cycles: u32, repeats: usize) {
    let problem = Problem::partial_slip(PARABOLA, control, 0.4).with_seed_cycles(f64::from(cycles) / LIFE);
    let (number, normal) = match control {
        NormalControl::Force => (1, "normal_force"),
        NormalControl::Indentation => (2, "indentation"),
    };
    let set = |fmu: &Fmu| {
        assert_eq!(fmu.set_integer("normal_control", number), OK);
        assert_eq!(fmu.set_real(normal, problem.normal), OK);
        assert_eq!(fmu.set_real("wear_coefficient", problem.parameters.wear_coefficient), OK);
    };
    let cyclic = Fmu::started(|fmu| {
        set(fmu);
        assert_eq!(fmu.set_integer("loading", 2), OK);
        assert_eq!(fmu.set_real("displacement_amplitude", problem.amplitude), OK);
    });
    let now = Instant::now();
    assert_eq!(cyclic.do_step(0.0, f64::from(cycles)), OK);
    let in_one = now.elapsed();
    let (mut times, mut volume, mut work) = (Vec::with_capacity(repeats), 0.0, Vec::new());
    for _ in 0..repeats {
        let fmu = Fmu::started(set);
        let now = Instant::now();
        run_life(&fmu, cycles, problem.amplitude);
        times.push(now.elapsed());
        volume = fmu.real("wear_volume");
        work = fmu.terminated_aloud();
    }
    let error = volume / cyclic.real("wear_volume") - 1.0;
    println!(
        "{cycles} cycles x {STEPS} steps, {}: {:.3?}, V off by {:.4} % from one cyclic step ({in_one:.2?})",
        problem.name,
        median(times),
        100.0 * error
    );
    println!("  {}", work.join("; "));
}

/// One input set and one output read at each step, as a machine model does.
fn run_life(fmu: &Fmu, cycles: u32, amplitude: f64) {
    let (input, output) = ([reference("tangential_displacement")], [reference("tangential_force")]);
    let sines: Vec<f64> =
        (1..=STEPS).map(|k| amplitude * (TAU * f64::from(k) / f64::from(STEPS)).sin()).collect();
    let mut force = [0.0];
    for cycle in 0..cycles {
        for (k, displacement) in sines.iter().enumerate() {
            assert_eq!(fmu.set_reals(&input, &[*displacement]), OK);
            assert_eq!(
                fmu.do_step(f64::from(cycle) + k as f64 / f64::from(STEPS), 1.0 / f64::from(STEPS)),
                OK
            );
            assert_eq!(fmu.get_reals(&output, &mut force), OK);
        }
    }
    assert!(force[0].is_finite());
}
