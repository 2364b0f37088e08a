//! Stiff and extreme scenes.

use crate::judge::Judge;
use fretting_contact::{
    Elastic, Error, FrettingContact, NormalControl, Pair, Parameters, Profile, ProfileTable,
};
use std::f64::consts::PI;

/// What a scene does.
pub(crate) type Run = Box<dyn Fn(&mut Judge) -> Result<(), Error> + Send>;

/// One scene: what is extreme about it, and how to run it.
pub(crate) struct Scene {
    pub(crate) name: String,
    pub(crate) extreme: String,
    pub(crate) run: Run,
}

type Outcome = Result<(), Error>;

/// Usual load, N.
const FORCE: f64 = 100.0;
/// N₀ of most scenes: a stroke wears some 0.3 % of a₀² d₀.
const SEED: f64 = 100.0;

/// All scenes.
pub(crate) fn all() -> Vec<Scene> {
    let mut scenes = Vec::new();
    let mut add = |name: &str, extreme: String, run: Box<dyn Fn(&mut Judge) -> Outcome + Send>| {
        scenes.push(Scene { name: name.into(), extreme, run });
    };
    materials(&mut add);
    loads(&mut add);
    wear(&mut add);
    ends_of_double_precision(&mut add);
    many_steps(&mut add);
    shapes(&mut add);
    amplitudes(&mut add);
    fineness(&mut add);
    scenes
}

type Add<'a> = &'a mut dyn FnMut(&str, String, Box<dyn Fn(&mut Judge) -> Outcome + Send>);

fn steel(young: f64, poisson: f64) -> Elastic {
    Elastic { youngs_modulus: young, poisson_ratio: poisson }
}

fn pair(young: f64, poisson: f64) -> Pair {
    Pair { body_1: steel(young, poisson), body_2: steel(young, poisson) }
}

fn without_wear() -> Parameters {
    Parameters { wear_coefficient: 0.0, ..Parameters::default() }
}

fn held_in_depth() -> Parameters {
    Parameters { normal_control: NormalControl::Indentation, ..Parameters::default() }
}

/// μ E* d/G*: displacement that makes all slip, of a contact that is pressed.
fn full_slip(contact: &FrettingContact) -> f64 {
    let Parameters { materials, friction_coefficient, .. } = contact.parameters();
    friction_coefficient * contact.indentation_depth() * materials.normal_modulus()
        / materials.tangential_modulus()
}

/// The unworn contact under a load.
fn pressed(parameters: &Parameters, normal: f64) -> Result<FrettingContact, Error> {
    let mut contact = FrettingContact::new(parameters.clone())?;
    contact.start_at(normal, 0.0)?;
    Ok(contact)
}

/// The same with a wear coefficient that makes N₀ = `cycles` at U₀ = 0.6 u_max; and that amplitude.
fn wearing(parameters: &Parameters, normal: f64, cycles: f64) -> Result<(Parameters, f64), Error> {
    let unworn = pressed(&Parameters { wear_coefficient: 0.0, ..parameters.clone() }, normal)?;
    let amplitude = 0.6 * full_slip(&unworn);
    let (a, d) = (unworn.contact_radius(), unworn.indentation_depth());
    let limit = parameters.friction_coefficient * unworn.normal_reaction();
    let per_work = PI * a * a * d / (cycles * limit * amplitude);
    let wear_coefficient =
        if limit > 0.0 { per_work * parameters.hardness } else { parameters.wear_coefficient };
    Ok((Parameters { wear_coefficient, ..parameters.clone() }, amplitude))
}

/// A short, eventful life: loops with wear, swings of load, cycles in one call, a slide, contact lost and found.
fn standard(judge: &mut Judge, parameters: &Parameters, normal: f64) -> Outcome {
    life(judge, parameters, normal, SEED)
}

/// The same for any N₀.
fn life(judge: &mut Judge, parameters: &Parameters, normal: f64, seed: f64) -> Outcome {
    let (parameters, amplitude) = wearing(parameters, normal, seed)?;
    let mut contact = pressed(&parameters, normal)?;
    judge.state(&contact);
    let way =
        [(1.0, 1.0), (1.0, -1.0), (0.5, 0.2), (1.2, 0.9), (0.9, -1.0), (1.0, 0.0), (0.0, 0.5), (1.0, 1.0)];
    for (load, place) in way {
        judge.step(&mut contact, |c| c.advance_to(load * normal, place * amplitude))?;
    }
    judge.step(&mut contact, |c| c.advance_cycles(normal, amplitude, 0.2 * seed))?;
    let mut parts = contact.clone();
    judge.step(&mut contact, |c| c.advance_to(0.9 * normal, -0.5 * amplitude))?;
    in_parts(&mut parts, (normal, amplitude), (0.9 * normal, -0.5 * amplitude), 7)?;
    judge.split(&contact, &parts);
    judge.step(&mut contact, |c| c.advance_to(normal, 4.0 * amplitude))
}

/// The line from `from` to `to`, (normal, displacement), in equal parts.
fn in_parts(contact: &mut FrettingContact, from: (f64, f64), to: (f64, f64), parts: u32) -> Outcome {
    for k in 1..parts {
        let share = f64::from(k) / f64::from(parts);
        let between = |a: f64, b: f64| a + share * (b - a);
        contact.advance_to(between(from.0, to.0), between(from.1, to.1))?;
    }
    contact.advance_to(to.0, to.1)
}

fn materials(add: Add) {
    for young in [1e3, 1e5, 1e7, 1e9, 1e11, 1e13] {
        // the same strains everywhere
        let force = FORCE * young / 210e9;
        let parameters = Parameters { materials: pair(young, 0.3), ..Parameters::default() };
        add(
            "Young's modulus",
            format!("E = {young:e} Pa"),
            Box::new(move |j| standard(j, &parameters, force)),
        );
    }
    let materials = Pair { body_1: steel(1e3, 0.3), body_2: steel(1e13, 0.3) };
    let soft = Parameters { materials, ..Parameters::default() };
    add("soft on hard", "E = 1e3 on 1e13 Pa".into(), Box::new(move |j| standard(j, &soft, 1e-6)));
    for poisson in [-0.9, 0.0, 0.49, 0.5] {
        let parameters = Parameters { materials: pair(210e9, poisson), ..Parameters::default() };
        add("Poisson ratio", format!("nu = {poisson}"), Box::new(move |j| standard(j, &parameters, FORCE)));
    }
    for friction_coefficient in [0.0, 1e-6, 0.05, 1.0, 3.0, 10.0] {
        let parameters = Parameters { friction_coefficient, ..Parameters::default() };
        let extreme = format!("mu = {friction_coefficient}");
        add("friction", extreme, Box::new(move |j| standard(j, &parameters, FORCE)));
    }
    for radius in [1e-9, 1e-6, 1e-3, 1.0, 1e3] {
        let parameters = Parameters { profile: Profile::Parabola { radius }, ..Parameters::default() };
        let force = FORCE * (radius / 0.01) * (radius / 0.01);
        let extreme = format!("R = {radius:e} m, the same pressure");
        let scaled = parameters.clone();
        add("radius", extreme, Box::new(move |j| standard(j, &scaled, force)));
        let extreme = format!("R = {radius:e} m, {FORCE} N");
        add("radius", extreme, Box::new(move |j| standard(j, &parameters, FORCE)));
    }
}

fn loads(add: Add) {
    for (extreme, loads) in
        [("1e9 up", [1e-7, FORCE]), ("1e9 down", [FORCE, 1e-7]), ("1e18 down", [1e9, 1e-9])]
    {
        for (kind, parameters) in [("no wear", without_wear()), ("wear", Parameters::default())] {
            let run = move |j: &mut Judge| {
                let (parameters, amplitude) = match kind {
                    "wear" => wearing(&parameters, FORCE, SEED)?,
                    _ => (parameters.clone(), 1e-6),
                };
                let mut contact = pressed(&parameters, loads[0])?;
                for k in 0..10 {
                    let place = if k % 4 < 2 { amplitude } else { -amplitude };
                    j.step(&mut contact, |c| c.advance_to(loads[(k + 1) % 2], place))?;
                }
                Ok(())
            };
            add("load jump in one step", format!("{extreme}, {kind}"), Box::new(run));
        }
    }
    for (extreme, parameters, press, lift) in [
        ("force", Parameters::default(), FORCE, -FORCE),
        ("force, to exactly 0", Parameters::default(), FORCE, 0.0),
        ("depth", held_in_depth(), 3.5e-6, -1e-6),
    ] {
        let run = move |j: &mut Judge| {
            let (parameters, amplitude) = wearing(&parameters, press, SEED)?;
            let mut contact = pressed(&parameters, press)?;
            for k in 0..100 {
                let place = amplitude * (2.7 * f64::from(k)).sin();
                j.step(&mut contact, |c| c.advance_to(if k % 2 == 0 { lift } else { press }, place))?;
            }
            Ok(())
        };
        add("chatter across separation", extreme.into(), Box::new(run));
    }
    for (extreme, share, steps) in [("1e6 u_max", 1e6, 6), ("1e-12 u_max", 1e-12, 2000)] {
        for (kind, parameters, load) in [
            ("no wear", without_wear(), FORCE),
            ("wear", Parameters::default(), FORCE),
            ("wear, depth held", held_in_depth(), 3.5e-6),
        ] {
            let run = move |j: &mut Judge| {
                let mut contact = pressed(&parameters, load)?;
                let way = share * full_slip(&contact);
                let mut place = 0.0;
                for k in 0..steps {
                    place += if k % 3 == 2 { -way } else { way };
                    j.step(&mut contact, |c| c.advance_to(load, place))?;
                }
                Ok(())
            };
            add("displacement step", format!("{extreme}, {kind}"), Box::new(run));
        }
    }
}

fn wear(add: Add) {
    for seed in [50.0, 20.0, 5.0, 1.0] {
        let run = move |j: &mut Judge| life(j, &Parameters::default(), FORCE, seed);
        add("fast wear", format!("N0 = {seed} cycles, loads vary"), Box::new(run));
    }
    for (extreme, parameters, normal, share) in [
        ("gross slip, force", Parameters::default(), FORCE, 5.0),
        ("gross slip, depth", held_in_depth(), 3.5e-6, 5.0),
        ("partial slip, force", Parameters::default(), FORCE, 1.0),
        ("partial slip, depth", held_in_depth(), 3.5e-6, 1.0),
    ] {
        let run = move |j: &mut Judge| {
            let (parameters, amplitude) = wearing(&parameters, normal, 0.02)?;
            let mut contact = pressed(&parameters, normal)?;
            for place in [share, -share, share, -share] {
                j.step(&mut contact, |c| c.advance_to(normal, place * amplitude))?;
            }
            Ok(())
        };
        add("one step wears more than d0", extreme.into(), Box::new(run));
    }
    for (extreme, parameters, normal, life) in [
        ("N/N0 = 100, force", Parameters::default(), FORCE, 100.0),
        ("N/N0 = 1e6, force", Parameters::default(), FORCE, 1e6),
        ("N/N0 = 100, depth", held_in_depth(), 3.5e-6, 100.0),
        ("N/N0 = 1e6, depth", held_in_depth(), 3.5e-6, 1e6),
    ] {
        let run = move |j: &mut Judge| {
            let (parameters, amplitude) = wearing(&parameters, normal, SEED)?;
            let mut contact = pressed(&parameters, normal)?;
            j.step(&mut contact, |c| c.advance_cycles(normal, amplitude, life * SEED))
        };
        add("a long life in one call", extreme.into(), Box::new(run));
    }
    for (extreme, seed, cycles) in [
        ("1e9 cycles of a life", 1e9, 1e9),
        ("1e9 cycles, 1e-12 of d0", 1e21, 1e9),
        ("1e15 cycles", 1e15, 1e15),
    ] {
        let run = move |j: &mut Judge| {
            let (parameters, amplitude) = wearing(&Parameters::default(), FORCE, seed)?;
            let mut contact = pressed(&parameters, FORCE)?;
            let mut many = contact.clone();
            j.step(&mut contact, |c| c.advance_cycles(FORCE, amplitude, cycles))?;
            for _ in 0..100 {
                many.advance_cycles(FORCE, amplitude, cycles / 100.0)?;
            }
            j.split(&contact, &many);
            Ok(())
        };
        add("slow wear", extreme.into(), Box::new(run));
    }
}

fn ends_of_double_precision(add: Add) {
    for (extreme, force, displacement) in [
        ("force 5e-324 N", 5e-324, 1e-6),
        ("force 1e-300 N", 1e-300, 1e-6),
        ("force 1e300 N", 1e300, 1e-6),
        ("displacement 5e-324 m", FORCE, 5e-324),
        ("displacement 1e300 m", FORCE, 1e300),
        ("both 1e300", 1e300, 1e300),
    ] {
        for (kind, parameters) in [("no wear", without_wear()), ("wear", Parameters::default())] {
            let run = move |j: &mut Judge| {
                let mut contact = pressed(&parameters, FORCE)?;
                for place in [displacement, -displacement, 0.0] {
                    j.step(&mut contact, |c| c.advance_to(force, place))?;
                }
                j.step(&mut contact, |c| c.advance_cycles(FORCE, 1e-6, 1.0))
            };
            add("input", format!("{extreme}, {kind}"), Box::new(run));
        }
    }
    for (extreme, amplitude, cycles) in [
        ("amplitude 1e300 m", 1e300, 1.0),
        ("amplitude 5e-324 m", 5e-324, 1e6),
        ("1e300 cycles", 1e-6, 1e300),
    ] {
        let run = move |j: &mut Judge| {
            let mut contact = pressed(&Parameters::default(), FORCE)?;
            j.step(&mut contact, |c| c.advance_cycles(FORCE, amplitude, cycles))
        };
        add("input", extreme.into(), Box::new(run));
    }
    let usual = Parameters::default;
    for (extreme, parameters) in [
        ("wear coefficient 1e300", Parameters { wear_coefficient: 1e300, ..usual() }),
        ("wear coefficient 5e-324", Parameters { wear_coefficient: 5e-324, ..usual() }),
        ("hardness 1e-300 Pa", Parameters { hardness: 1e-300, ..usual() }),
        ("E = 1e300 Pa", Parameters { materials: pair(1e300, 0.3), ..usual() }),
        ("E = 1e-300 Pa", Parameters { materials: pair(1e-300, 0.3), ..usual() }),
        ("R = 1e300 m", Parameters { profile: Profile::Parabola { radius: 1e300 }, ..usual() }),
        ("R = 1e-300 m", Parameters { profile: Profile::Parabola { radius: 1e-300 }, ..usual() }),
    ] {
        let run = move |j: &mut Judge| {
            let mut contact = pressed(&parameters, FORCE)?;
            for place in [1e-6, -1e-6] {
                j.step(&mut contact, |c| c.advance_to(FORCE, place))?;
            }
            j.step(&mut contact, |c| c.advance_cycles(FORCE, 1e-6, 1.0))
        };
        add("parameter", extreme.into(), Box::new(run));
    }
}

fn many_steps(add: Add) {
    for (steps, wears) in [(100_000, true), (1_000_000, true), (1_000_000, false), (10_000_000, false)] {
        let kind = if wears { "wear" } else { "no wear" };
        let run = move |j: &mut Judge| {
            let (parameters, amplitude) = wearing(&Parameters::default(), FORCE, SEED)?;
            let parameters = if wears { parameters } else { without_wear() };
            let mut one = pressed(&parameters, FORCE)?;
            let mut many = one.clone();
            let half = steps / 2;
            for (from, to) in
                [((FORCE, 0.0), (FORCE, amplitude)), ((FORCE, amplitude), (0.7 * FORCE, -amplitude))]
            {
                j.step(&mut one, |c| c.advance_to(to.0, to.1))?;
                in_parts(&mut many, from, to, half)?;
            }
            j.anew();
            j.state(&many);
            j.split(&one, &many);
            Ok(())
        };
        add("tiny steps against one", format!("{steps:e} steps, {kind}"), Box::new(run));
    }
    let run = |j: &mut Judge| {
        let (parameters, amplitude) = wearing(&Parameters::default(), FORCE, SEED)?;
        let mut one = pressed(&parameters, FORCE)?;
        let mut many = one.clone();
        j.step(&mut one, |c| c.advance_cycles(FORCE, amplitude, SEED))?;
        for _ in 0..2000 {
            many.advance_cycles(FORCE, amplitude, SEED / 2000.0)?;
        }
        j.split(&one, &many);
        Ok(())
    };
    add("tiny steps against one", "2000 parts of a cyclic life".into(), Box::new(run));
}

/// A parabola of 10 mm with waves on it whose image still rises, or none.
fn table(points: u32, roughness: f64) -> Result<Profile, Error> {
    let heights = (0..points).map(|i| {
        let r = 4e-4 * f64::from(i) / f64::from(points - 1);
        (r, r * r / 0.02 * (1.0 + roughness * (f64::from(i) * 0.7).sin()))
    });
    Ok(Profile::Table(ProfileTable::new(heights.collect())?))
}

fn shapes(add: Add) {
    for (extreme, profile) in [
        ("flat punch", Profile::FlatPunch { flat_radius: 1e-4 }),
        ("blunted sphere, b = 0.3 mm", Profile::BluntedSphere { radius: 0.01, flat_radius: 3e-4 }),
        (
            "blunted sphere, b = 10 mm: almost all flat",
            Profile::BluntedSphere { radius: 0.01, flat_radius: 1e-2 },
        ),
        ("rounded punch, sharp edge of 1e-9 m", Profile::RoundedPunch { radius: 1e-9, flat_radius: 1e-4 }),
        ("nearly flat: r^100", Profile::PowerLaw { exponent: 100.0, coefficient: 1e300 }),
        ("nearly flat: r^8", Profile::PowerLaw { exponent: 8.0, coefficient: 1e25 }),
        ("spike: r^0.1", Profile::PowerLaw { exponent: 0.1, coefficient: 1e-5 }),
        ("sharp cone, 1.57 rad", Profile::Cone { slope: 1.57 }),
        ("blunt cone, 1e-6 rad", Profile::Cone { slope: 1e-6 }),
    ] {
        let parameters = Parameters { profile, ..Parameters::default() };
        add("shape", extreme.into(), Box::new(move |j| standard(j, &parameters, FORCE)));
    }
    for (extreme, points, roughness) in [
        ("smooth table of 1e4 points", 10_000, 0.0),
        ("table of 1e4 points, rough by 1e-6", 10_000, 1e-6),
        ("table of 1e4 points, rough by 0.1", 10_000, 0.1),
        ("table of 5 points", 5, 0.0),
    ] {
        let run = move |j: &mut Judge| {
            standard(j, &Parameters { profile: table(points, roughness)?, ..Parameters::default() }, FORCE)
        };
        add("shape", extreme.into(), Box::new(run));
    }
}

fn amplitudes(add: Add) {
    for (extreme, shares) in [
        ("grows 1e-3 to 3 u_max", [1e-3, 1e-2, 0.1, 0.5, 0.9, 3.0]),
        ("shrinks 3 to 1e-3 u_max", [3.0, 0.9, 0.5, 0.1, 1e-2, 1e-3]),
        ("exactly u_max", [1.0; 6]),
        ("u_max (1 - 1e-12)", [1.0 - 1e-12; 6]),
        ("u_max (1 + 1e-12)", [1.0 + 1e-12; 6]),
    ] {
        for (kind, parameters, normal) in
            [("force", Parameters::default(), FORCE), ("depth", held_in_depth(), 3.5e-6)]
        {
            let run = move |j: &mut Judge| {
                let (parameters, _) = wearing(&parameters, normal, SEED)?;
                let mut contact = pressed(&parameters, normal)?;
                let full = full_slip(&contact);
                for share in shares {
                    j.step(&mut contact, |c| c.advance_cycles(normal, share * full, 0.1 * SEED))?;
                    for place in [-share, share] {
                        j.step(&mut contact, |c| c.advance_to(normal, place * full))?;
                    }
                }
                Ok(())
            };
            add("amplitude", format!("{extreme}, {kind}"), Box::new(run));
        }
    }
}

fn fineness(add: Add) {
    for resolution in [8, 16, 32, 128, 256, 512] {
        let parameters = Parameters { resolution, ..Parameters::default() };
        add("resolution", resolution.to_string(), Box::new(move |j| standard(j, &parameters, FORCE)));
    }
    for tolerance in [0.1, 1e-2, 1e-4, 1e-6] {
        let parameters = Parameters { tolerance, ..Parameters::default() };
        add("tolerance", format!("{tolerance:e}"), Box::new(move |j| standard(j, &parameters, FORCE)));
    }
}
