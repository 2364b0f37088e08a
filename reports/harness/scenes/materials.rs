//! Materials, friction and size: the same short life over many decades.

use super::{Add, FORCE, pair, standard, steel};
use fretting_contact::{Pair, Parameters, Profile};

pub(super) fn materials(add: Add) {
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
