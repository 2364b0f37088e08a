//! What an interface of many contacts costs: the time of a step of a thousand summits under a load
//! that varies, without wear and with it, at two resolutions and at ten times the wear; the memory
//! of each, and the size of its saved state; and the time of 10⁵ cycles in one call, which takes
//! blocks at constant approach. Time is in proportion to the numbers of contacts and of steps, so
//! that the scene of tenfold wear has 1000 steps, and that of cycles 50 contacts.
//!
//! `cargo bench --bench interface --no-default-features`, about a minute beside other work; a word
//! after `--` runs the scenes whose name has it. With `--features threads` on all cores. Bytes are
//! what the allocator was asked for; times are those of the processor on Linux.

#[path = "../tests/fmi/counting.rs"]
mod counting;

use counting::{Counting, live_bytes};
use fretting_contact::{Interface, Parameters, Summit};
use std::f64::consts::TAU;
use std::time::{Duration, Instant};

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Steps of a cycle.
const STEPS: u32 = 100;

/// Time that a processor has spent on this thread, where the system says it; else by the clock.
fn spent(start: Instant) -> Duration {
    let text = std::fs::read_to_string("/proc/self/schedstat").unwrap_or_default();
    let nanoseconds = text.split_whitespace().next().and_then(|first| first.parse().ok());
    nanoseconds.map_or_else(|| start.elapsed(), Duration::from_nanos)
}

/// Summits of 100 µm radius with evenly spread heights.
fn summits(count: u32, span: f64) -> Vec<Summit> {
    let offset = |k: u32| span * (f64::from(k) * 0.618_033_988_75).fract();
    (0..count).map(|k| Summit::at_offset(offset(k))).collect()
}

fn parameters(wear_coefficient: f64, resolution: usize) -> Parameters {
    let profile = fretting_contact::Profile::Parabola { radius: 1e-4 };
    Parameters { profile, wear_coefficient, resolution, ..Parameters::default() }
}

/// Steps of 1000 contacts; the load swings by 30 % in two thirds of the frequency.
fn run(name: &str, parameters: Parameters, steps: u32) {
    let mut joint = Interface::new(parameters, &summits(1000, 1e-6)).unwrap();
    let before = live_bytes();
    joint.start_at(100.0, [0.0; 2], 0.0).unwrap();
    let (now, began) = (Instant::now(), spent(Instant::now()));
    for k in 1..=steps {
        let phase = TAU * f64::from(k) / f64::from(STEPS);
        let (force, u) = (100.0 * (1.0 + 0.3 * (0.7 * phase).cos()), 0.6e-6 * phase.sin());
        joint.advance_to(force, [u, 0.0], 0.0).unwrap();
    }
    let time = spent(now).saturating_sub(began);
    // those that have never touched hold no state
    let touched = (0..1000).filter(|index| joint.contact(*index).is_some()).count();
    let kibibytes = (live_bytes() - before) as f64 / 1024.0;
    let saved = postcard::to_stdvec(&joint.snapshot()).unwrap().len() as f64 / 1024.0;
    println!(
        "{name}: {steps} steps {time:.2?}, {:.2} us a contact and step, {:.1} updates each; {:.2} KiB of each of {touched} that have touched, saved {:.2} KiB, {:.2} KiB over all; deepest wear {:.3e} m",
        1e6 * time.as_secs_f64() / f64::from(steps) / 1e3,
        joint.counters().profile_updates as f64 / 1e3,
        kibibytes / touched as f64,
        saved / touched as f64,
        kibibytes / 1e3,
        joint.wear_depth()
    );
}

/// Cycles in one call.
fn cycles(name: &str, resolution: usize, count: u32) {
    let mut joint = Interface::new(parameters(3.2e-4, resolution), &summits(count, 1e-6)).unwrap();
    let (now, began) = (Instant::now(), spent(Instant::now()));
    joint.advance_cycles(0.1 * f64::from(count), 0.3e-6, 1e5).unwrap();
    println!(
        "{name}: {count} contacts {:.2?}, deepest wear {:.3e} m, {} touch",
        spent(now).saturating_sub(began),
        joint.wear_depth(),
        joint.contacts_in_touch()
    );
}

fn main() {
    // cargo passes --bench when it benchmarks; anything else only wants to know that this runs
    let benchmark = std::env::args().any(|argument| argument == "--bench");
    let words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with('-')).collect();
    let asked = |name: &str| words.is_empty() || words.iter().any(|word| name.contains(word.as_str()));
    for (name, wear_coefficient, resolution, steps) in [
        ("no wear", 0.0, 64, 10_000),
        ("steel, 16 cells", 3.2e-4, 16, 10_000),
        ("steel, 64 cells", 3.2e-4, 64, 10_000),
        ("tenfold wear, 16 cells", 3.2e-3, 16, 1000),
    ] {
        if asked(name) {
            run(name, parameters(wear_coefficient, resolution), if benchmark { steps } else { 20 });
        }
    }
    let name = "running in";
    if asked(name) {
        // the energy of a contact in a few cycles
        let parameters =
            Parameters { friction_coefficient_final: 0.9, running_in_energy: 1e-6, ..parameters(0.0, 64) };
        run(name, parameters, if benchmark { 300 } else { 20 });
    }
    let name = "cycles, 16 cells, 1e5 in one call";
    if asked(name) {
        cycles(name, 16, if benchmark { 50 } else { 10 });
    }
}
