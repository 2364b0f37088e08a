//! Profiles: nearly flat, sharp, tabulated.

use super::{Add, FORCE, standard};
use crate::judge::Judge;
use fretting_contact::{Error, Parameters, Profile, ProfileTable};

/// A parabola of 10 mm with waves on it whose image still rises, or none.
fn table(points: u32, roughness: f64) -> Result<Profile, Error> {
    let heights = (0..points).map(|i| {
        let r = 4e-4 * f64::from(i) / f64::from(points - 1);
        (r, r * r / 0.02 * (1.0 + roughness * (f64::from(i) * 0.7).sin()))
    });
    Ok(Profile::Table(ProfileTable::new(heights.collect())?))
}

pub(super) fn shapes(add: Add) {
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
