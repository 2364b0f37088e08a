//! Blunted spheres that are hardly pressed: their contact is the flat and a narrow ring around it,
//! and only the ring slips.

use crate::common::{FORCE, close_to, exact, started, without_wear};
use fretting_contact::Profile;

/// The ring is 0.2 % of the contact radius wide.
const BODY: Profile = Profile::BluntedSphere { radius: 0.01, flat_radius: 4e-4 };

/// Strokes along y, where springs are samples, do the work of strokes along x, where they are
/// exact.
#[test]
fn samples_follow_the_ring() {
    let full = exact(&BODY, FORCE).full_slip();
    for share in [0.3, 0.6, 0.9] {
        let work = |along: fn(f64) -> [f64; 2]| {
            let mut contact = started(without_wear(BODY));
            for place in [share, -share, share, -share] {
                contact.advance_to_planar(FORCE, along(place * full)).expect("the line can be walked");
            }
            contact.dissipated_energy()
        };
        close_to(work(|u| [0.0, u]), work(|u| [u, 0.0]), 5e-3, "W along y");
    }
}
