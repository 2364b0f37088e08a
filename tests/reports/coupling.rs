//! The contact under four masters, as the report has it: where explicit coupling ends, and that the
//! contact's derivative takes one beyond.

use crate::masters::{Master, RATIOS, STIFFNESSES, comparison, explicit_limits};

#[test]
fn explicit_coupling_ends_at_two_over_omega() {
    let limits = explicit_limits().expect("the contact can be moved");
    assert_eq!(limits.len(), 21);
    for limit in limits {
        // twelve bisections of [½, 2] leave 4e-4
        assert!((limit.step / limit.theory - 1.0).abs() < 1e-3, "{limit:?}");
    }
}

#[test]
fn the_derivative_makes_any_step_stable() {
    let rows = comparison(&RATIOS, &STIFFNESSES).expect("the contact can be moved");
    assert_eq!(rows.len(), 7 * 6 * 4);
    for row in rows {
        match row.master {
            Master::Explicit => assert_eq!(row.stable(), row.stiffness < 2.0, "{row:?}"),
            Master::HalfExplicit => {
                // of a contact that sticks; slip only makes it softer
                let stiffness = row.stiffness.powi(2) * (1.0 - row.ratio) / (1.0 + row.ratio);
                assert_eq!(row.stable(), stiffness < 4.0, "{row:?}");
            }
            Master::SemiImplicit | Master::Iterative => {
                // of first order in hω_d, and nearly quasi-static where the system is stiff
                let allowed = if row.stiffness > 1.0 { 1e-5 } else { 2e-2 };
                assert!(row.stable() && row.work_error.abs() < allowed, "{row:?}");
                assert!(row.force_error.abs() < allowed, "{row:?}");
                assert!(row.calls <= if row.master == Master::Iterative { 3.0 } else { 1.0 }, "{row:?}");
            }
        }
    }
}
