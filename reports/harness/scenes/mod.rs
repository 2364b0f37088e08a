//! Stiff and extreme scenes.

mod ellipse;
mod joints;
mod limits;
mod loads;
mod materials;
mod plane;
mod rig;
mod shapes;
mod steps;
mod wear;

use crate::judge::Judge;
use fretting_contact::{Elastic, Error, FrettingContact, NormalControl, Pair, Parameters};
use std::f64::consts::PI;

/// What a scene does.
pub(crate) type Run = Box<dyn Fn(&mut Judge) -> Result<(), Error> + Send>;

/// One scene: what is extreme about it, and how to run it.
pub(crate) struct Scene {
    pub(crate) name: String,
    pub(crate) extreme: String,
    pub(crate) run: Run,
}

impl Scene {
    /// Name and extreme.
    pub(crate) fn title(&self) -> String {
        format!("{}, {}", self.name, self.extreme)
    }
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
    materials::materials(&mut add);
    loads::loads(&mut add);
    wear::wear(&mut add);
    limits::pushes(&mut add);
    limits::inputs(&mut add);
    limits::parameters(&mut add);
    steps::tiny(&mut add);
    shapes::shapes(&mut add);
    steps::amplitudes(&mut add);
    steps::fineness(&mut add);
    plane::plane(&mut add);
    rig::rig(&mut add);
    ellipse::ellipse(&mut add);
    joints::joints(&mut add);
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

/// μ E* d/G*: displacement along x that makes all slip, of a contact that is pressed.
fn full_slip(contact: &FrettingContact) -> f64 {
    let Parameters { materials, friction_coefficient, .. } = contact.parameters();
    friction_coefficient * contact.indentation_depth() * materials.normal_modulus()
        / contact.tangential_moduli()[0]
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

/// A short, eventful life: loops with wear, swings of load, cycles in one call, a slide, contact
/// lost and found.
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

/// A line in the plane from partial slip to gross slip, in one step and in 1000.
fn split_in_plane(judge: &mut Judge, parameters: &Parameters) -> Outcome {
    let mut one = pressed(parameters, FORCE)?;
    let full = full_slip(&one);
    let (start, end) = ([0.3 * full, 0.2 * full], [-0.5 * full, 0.9 * full]);
    one.advance_to_planar(FORCE, start)?;
    let mut many = one.clone();
    judge.step(&mut one, |c| c.advance_to_planar(FORCE, end))?;
    for k in 1..=1000 {
        let share = f64::from(k) / 1000.0;
        many.advance_to_planar(FORCE, [0, 1].map(|i| start[i] + share * (end[i] - start[i])))?;
    }
    judge.split(&one, &many);
    Ok(())
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
