//! Derivatives of the worn depth and of the stiffness for a contact that moves in both tangential
//! directions: by Archard's law at the deepest point, against the same motion along x, and against
//! differences.

use crate::common::{
    BALL, CONE, FORCE, MU, PUNCH, close_to, contact, exact, normal_input, started, without_wear,
};
use fretting_contact::{FrettingContact, Gradient, NormalControl, Parameters};

/// A direction that is neither axis.
const WAY: [f64; 2] = [0.8, -0.6];

fn along(place: f64) -> [f64; 2] {
    WAY.map(|part| part * place)
}

/// Where all springs slip, the middle of a ball wears by (k/σ₀) μp **n** per displacement, and no
/// other way; on the way back nothing wears until springs are at their bound again.
#[test]
fn the_middle_of_a_ball_wears_by_the_law() {
    let mut contact = started(Parameters { profile: BALL, ..Parameters::default() });
    for k in 1..=20 {
        contact.advance_to_planar(FORCE, along(5e-5 * f64::from(k))).unwrap();
    }
    assert_eq!(contact.stick_radius(), 0.0);
    let per_work = contact.parameters().wear_coefficient / contact.parameters().hardness;
    let gradient = contact.wear_depth_gradient();
    let rate = per_work * MU * contact.pressure_at(0.0);
    close_to(gradient.displacement, rate * WAY[0], 1e-4, "along x");
    close_to(gradient.displacement_y, rate * WAY[1], 1e-4, "along y");

    let before = contact.wear_depth();
    contact.advance_to_planar(FORCE, along(1.2e-3)).unwrap();
    let predicted = 2e-4 * (gradient.displacement * WAY[0] + gradient.displacement_y * WAY[1]);
    close_to(predicted, contact.wear_depth() - before, 1e-2, "over a stretch");

    contact.advance_to_planar(FORCE, along(1.2e-3 - 1e-9)).unwrap();
    let gradient = contact.wear_depth_gradient();
    assert_eq!((gradient.displacement, gradient.displacement_y), (0.0, 0.0), "just after the reversal");
    contact.advance_to_planar(FORCE, along(1.1e-3)).unwrap();
    let gradient = contact.wear_depth_gradient();
    assert!(gradient.displacement < 0.0 && gradient.displacement_y > 0.0, "{gradient:?}");
}

/// In partial slip, before and after wear: what the same strokes along x give, turned.
#[test]
fn depth_grows_as_on_the_line_along_x() {
    for profile in [BALL, CONE] {
        let full = exact(&profile, FORCE).full_slip();
        let parameters = Parameters { profile: profile.clone(), resolution: 256, ..Parameters::default() };
        let (mut line, mut plane) = (contact(parameters.clone()), contact(parameters));
        line.start_at(FORCE, 0.0).unwrap();
        plane.start_at(FORCE, 0.0).unwrap();
        for (k, share) in [0.4, 0.7, -0.7, 0.7, -0.7, 0.1].into_iter().enumerate() {
            line.advance_to(FORCE, share * full).unwrap();
            plane.advance_to_planar(FORCE, along(share * full)).unwrap();
            let (of_line, of_plane) = (line.wear_depth_gradient(), plane.wear_depth_gradient());
            assert!(
                of_line.displacement != 0.0 && of_line.normal != 0.0,
                "{profile:?}: it wears on stroke {k}"
            );
            let [x, y] = WAY;
            let predicted = of_plane.displacement * x + of_plane.displacement_y * y;
            let across = of_plane.displacement * y - of_plane.displacement_y * x;
            // the front is between two of 512 samples; the deepest point is one of the nodes
            println!(
                "{profile:?} {k}: {} {}",
                predicted / of_line.displacement - 1.0,
                of_plane.normal / of_line.normal - 1.0
            );
            close_to(predicted, of_line.displacement, 3e-2, "along the motion");
            close_to(of_plane.normal, of_line.normal, 3e-2, "by the load");
            assert!(across.abs() < 1e-6 * predicted.abs(), "{across:e} of {predicted:e}");
        }
    }
}

/// Nothing wears, or nothing slips: the depth stays, whatever moves.
#[test]
fn without_wear_or_slip_the_depth_stays() {
    let still = |contact: &FrettingContact| assert_eq!(contact.wear_depth_gradient(), Gradient::default());
    for profile in [BALL, PUNCH] {
        let mut plain = started(without_wear(profile.clone()));
        plain.advance_to_planar(FORCE, [1e-6, 1e-6]).unwrap();
        still(&plain);
    }
    // the whole contact of a punch sticks up to full slip
    let mut punch = started(Parameters { profile: PUNCH, ..Parameters::default() });
    punch.advance_to_planar(FORCE, along(0.9 * exact(&PUNCH, FORCE).full_slip())).unwrap();
    still(&punch);
    assert_eq!(punch.stick_radius_gradient(), Gradient::default(), "no front moves");
    let mut line = started(Parameters { profile: PUNCH, ..Parameters::default() });
    punch.advance_to_planar(FORCE, along(1.1 * exact(&PUNCH, FORCE).full_slip())).unwrap();
    line.advance_to(FORCE, 1.1 * exact(&PUNCH, FORCE).full_slip()).unwrap();
    // its rim is the deepest place, where the pressure is no number: no rate is given, as on the
    // line
    for contact in [&punch, &line] {
        assert!(contact.wear_depth() > 0.0);
        still(contact);
    }
    assert_eq!(punch.stick_radius_gradient(), Gradient::default(), "no front moves");
}

/// The stiffness along the motion changes as going straight on changes it, after one line and after
/// a bend, while the load rests, rises and falls more slowly than the slip zone follows; after one
/// line also as going back changes it while the load falls so fast that the slip zone stays on its
/// side.
#[test]
fn the_stiffness_changes_as_its_gradient_says() {
    for profile in [BALL, CONE] {
        for control in [NormalControl::Force, NormalControl::Indentation] {
            let normal = normal_input(&profile, control, FORCE);
            let full = exact(&profile, FORCE).full_slip();
            for places in [&[[0.4, 0.2]][..], &[[0.4, 0.2], [0.12, 0.36]]] {
                let parameters = without_wear(profile.clone());
                let mut contact = contact(Parameters { normal_control: control, ..parameters });
                contact.start_at(normal, 0.0).unwrap();
                let (mut from, mut to) = ([0.0; 2], [0.0; 2]);
                for place in places {
                    (from, to) = (to, place.map(|share| share * full));
                    contact.advance_to_planar(normal, to).unwrap();
                }
                let length = (to[0] - from[0]).hypot(to[1] - from[1]);
                let back = (places.len() == 1).then_some((-1.0, -5.0));
                for (way, share) in [(1.0, 0.0), (1.0, 0.2), (1.0, -0.2)].into_iter().chain(back) {
                    let step = [0, 1].map(|k| way * 1e-4 * full * (to[k] - from[k]) / length);
                    let by_load = share * 1e-4 * normal;
                    let after = |contact: &FrettingContact, steps: f64| {
                        let mut moved = contact.clone();
                        let place = [to[0] + steps * step[0], to[1] + steps * step[1]];
                        moved.advance_to_planar(normal + steps * by_load, place).unwrap();
                        moved
                    };
                    let middle = after(&contact, 1.0);
                    let end = after(&middle, 2.0);
                    let difference = 0.5 * (end.tangential_stiffness() - contact.tangential_stiffness());
                    let gradient = middle.tangential_stiffness_gradient();
                    let predicted = gradient.normal * by_load
                        + gradient.displacement * step[0]
                        + gradient.displacement_y * step[1];
                    let what = format!("{profile:?}, {control:?}, to {places:?}, load {share}");
                    close_to(predicted, difference, 3e-2, &what);
                }
            }
        }
    }
}
