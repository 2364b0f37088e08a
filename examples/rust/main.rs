//! The library by itself, without FMI: a loop of a pressed ball, its wear, and the same seen
//! through a compliant rig.
//!
//! cargo run --release --no-default-features --example rust

use fretting_contact::{FrettingContact, Parameters, Profile};
use std::error::Error;
use std::io::{Write, stdout};

/// Normal force, N, and amplitude, m.
const FORCE: f64 = 100.0;
const AMPLITUDE: f64 = 2e-6;

fn main() -> Result<(), Box<dyn Error>> {
    run(&mut stdout())
}

pub(crate) fn run(out: &mut impl Write) -> Result<(), Box<dyn Error>> {
    let steel_ball = Parameters { profile: Profile::Parabola { radius: 0.01 }, ..Parameters::default() };

    let mut contact = FrettingContact::new(steel_ball.clone())?;
    contact.start_at(FORCE, 0.0)?;
    writeln!(out, "contact radius       {:.4e} m", contact.contact_radius())?;
    writeln!(out, "peak pressure        {:.4e} Pa", contact.max_pressure())?;

    writeln!(out, "\n{:>12} {:>12} {:>12}", "U (m)", "T (N)", "c (m)")?;
    for step in 0..=12 {
        let phase = std::f64::consts::TAU * f64::from(step) / 12.0;
        contact.advance_to(FORCE, AMPLITUDE * phase.sin())?;
        writeln!(
            out,
            "{:12.3e} {:12.4} {:12.3e}",
            contact.displacement(),
            contact.tangential_force(),
            contact.stick_radius()
        )?;
    }

    // a step may span any number of cycles
    contact.advance_cycles(FORCE, AMPLITUDE, 1e5)?;
    writeln!(out, "\nafter 100,000 cycles")?;
    writeln!(out, "worn volume          {:.4e} m3", contact.wear_volume())?;
    writeln!(out, "deepest point        {:.4e} m", contact.wear_depth())?;
    writeln!(out, "work of friction     {:.4e} J", contact.dissipated_energy())?;

    // what a rig of 20 N/um makes of the same drive
    let mut held = FrettingContact::new(Parameters { rig_stiffness: 2e7, ..steel_ball })?;
    held.start_at(FORCE, 0.0)?;
    held.advance_to(FORCE, AMPLITUDE)?;
    writeln!(out, "\nbehind a rig of 20 N/um, of 2 um at the drive")?;
    writeln!(out, "the contact moves    {:.4e} m", held.displacement())?;
    writeln!(out, "tangential force     {:.4} N", held.tangential_force())?;
    Ok(())
}
