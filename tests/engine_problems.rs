//! The ready problems, driven by whole cycles, against all that is tabulated of them.

use fretting_contact::FrettingContact;
use fretting_contact::problems::{History, Problem};
use std::f64::consts::PI;

/// Every quantity that the table of `problem` gives in row `i`: (name, measured, tabulated).
fn row(problem: &Problem, i: usize, contact: &FrettingContact) -> Vec<(&'static str, f64, f64)> {
    let (a, d) = (problem.contact_radius(), problem.depth());
    let volume = contact.wear_volume() / problem.volume_unit();
    match problem.history {
        History::Unknown => Vec::new(),
        History::Volume(rows) => vec![("V", volume, rows[i].1)],
        History::ConstantForce(rows) => vec![
            ("d", contact.indentation_depth() / d, rows[i].depth),
            ("c", contact.stick_radius() / a, rows[i].stick_radius),
            ("V", volume, rows[i].volume),
            ("deepest", contact.wear_depth() / d, rows[i].deepest),
        ],
        History::CentralPressure(rows) => {
            let mean = problem.normal / (PI * a * a);
            vec![("p(0)", contact.pressure_at(0.0) / mean, rows[i].1)]
        }
        History::CentralWear(rows) => vec![("w(0)", contact.worn_depth_at(0.0) / d, rows[i].1)],
    }
}

#[test]
fn whole_cycles_follow_every_table() {
    let gross_slip = [Problem::flat_punch_in_gross_slip(), Problem::sphere_in_gross_slip()];
    for problem in Problem::published().into_iter().chain(gross_slip) {
        let mut contact = problem.begin().expect("a ready problem is valid");
        let mut compared = 0;
        for (i, life) in problem.checkpoints.iter().enumerate() {
            let before = if i == 0 { 0.0 } else { problem.checkpoints[i - 1] };
            problem.advance(&mut contact, life - before).expect("it can be advanced");
            if i >= problem.history.places().len() {
                continue;
            }
            for (name, measured, tabulated) in row(&problem, i, &contact) {
                let off = measured / tabulated - 1.0;
                println!("{} at {life:.4}: {name} {measured:.5}, {off:+.2e}", problem.name);
                assert!(off.abs() <= 0.02, "{} at {life}: {name} {measured} {tabulated}", problem.name);
                compared += 1;
            }
        }
        assert!(compared >= 4 || problem.history == History::Unknown, "{}", problem.name);
        println!("{}", contact.counters());
    }
}
