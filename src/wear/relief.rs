//! By how much the wear of a backlog changes the friction work of the motion that made it.
//!
//! The springs do their work on the profile of the last update. Meanwhile the profile wears, so
//! that their overlap q = d − g falls by δ until the next update, by half of that on average. Under
//! a bound m q the slip of a spring is ΔU less the bound at either end of its stroke: a slip path
//! whose slope in g is c m contains the bound c times. So the work of all of it changes by c δ/2 in
//! the mean. A spring whose slip has turned (c = 2 in each stroke) slips by so much more. One that
//! has slipped one way only (c = 0), as where strokes creep, slips by δ: its bound falls behind it.

use super::backlog::SlipAtDepth;
use crate::parameters::NormalControl;
use crate::surface::Surface;

/// How the friction work of a motion changes on average while the image at the nodes of a surface
/// grows by a change (m), over that on the surface as it is; −1 where no work is done at the nodes.
/// Under force control each part of the motion keeps its load, under indentation control its depth.
pub(crate) fn change_of_mean_work(
    surface: &Surface,
    law: &[SlipAtDepth],
    change: &[f64],
    control: NormalControl,
) -> f64 {
    let Some(nodes) = surface.worn() else { return 0.0 };
    let x = nodes.x();
    let images: Vec<f64> = x.iter().map(|x| surface.image(*x)).collect();
    let (mut work, mut difference) = (0.0, 0.0);
    for law in law {
        let inside = images.partition_point(|g| *g < law.depth);
        let approach = match control {
            NormalControl::Force => mean(&x[..inside], &change[..inside]),
            NormalControl::Indentation => 0.0,
        };
        // image, overlap, half of its fall, and slip
        let at =
            |image: f64, change: f64| (image, law.depth - image, 0.5 * (change - approach), law.at(image).0);
        for i in 1..=inside.min(x.len() - 1) {
            let inner = at(images[i - 1], change[i - 1]);
            let (mut outer, mut width) = (at(images[i], change[i]), x[i] - x[i - 1]);
            if i == inside {
                // up to the contact edge
                let part = (law.depth - images[i - 1]) / (images[i] - images[i - 1]);
                outer = at(law.depth, change[i - 1] + part * (change[i] - change[i - 1]));
                width *= part;
            }
            // dE/dg as its mean over the cell: between two hinges of one bin it may be anything
            let ((inner_image, .., inner_slip), (outer_image, .., outer_slip)) = (inner, outer);
            let rise = outer_image - inner_image;
            let slope = if rise > 0.0 { (outer_slip - inner_slip) / rise } else { 0.0 };
            for (_, overlap, fall, slip) in [inner, outer] {
                work += 0.5 * width * overlap * slip;
                difference += 0.5 * width * fall * (overlap * slope - slip);
            }
        }
    }
    if work > 0.0 { difference / work } else { -1.0 }
}

/// Share of the fall of the bound by which springs slip on beyond what [`change_of_mean_work`]
/// counts, from some images (m) on: 1 − c/2 of what has slipped one way only.
pub(crate) fn uncounted_shares(law: &[SlipAtDepth], bound_slope: f64) -> Vec<(f64, f64)> {
    let mut rises: Vec<(f64, f64)> = law.iter().flat_map(SlipAtDepth::rises).collect();
    rises.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    let mut slope = 0.0;
    let shares = rises.iter().map(|(image, rise)| {
        slope += rise;
        (*image, (1.0 - 0.5 * slope / bound_slope).clamp(0.0, 1.0))
    });
    shares.collect()
}

/// Mean of values at some radii, linear between them.
fn mean(x: &[f64], values: &[f64]) -> f64 {
    let width = x.last().map_or(0.0, |last| last - x[0]);
    if width == 0.0 {
        return 0.0;
    }
    let areas = x.windows(2).zip(values.windows(2)).map(|(x, v)| 0.5 * (x[1] - x[0]) * (v[0] + v[1]));
    areas.sum::<f64>() / width
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::profile::Profile;
    use crate::surface::Nodes;
    use crate::wear::Sliding;

    /// On a ball whose image is raised by ε g, cycles of amplitude U₀ do the work of a ball of
    /// radius R/(1 + ε): ∫ (d − g)(U₀ − m (d − g))₊ dx goes like the contact radius, √R.
    #[test]
    fn the_mean_work_of_cycles_on_a_sharper_ball_is_the_closed_one() {
        let (radius, edge, share) = (0.01, 2e-4, 1e-3);
        let profile = Profile::Parabola { radius };
        let depth = edge * edge / radius;
        let error = |cells: usize| {
            let mut surface = Surface::new(profile.clone());
            surface.set_worn(Some(Nodes::around(&profile, cells, edge, 0.6 * edge)));
            let nodes = surface.worn().expect("it has nodes");
            let change: Vec<f64> = nodes.x().iter().map(|x| share * surface.image(*x)).collect();
            // the front of this amplitude is a node
            let law = SlipAtDepth::of_motion(Sliding::Cycles(0.64 * depth), 1.0, depth, 1.0);
            let found = 1.0 + change_of_mean_work(&surface, &[law], &change, NormalControl::Indentation);
            let exact = 0.5 * (1.0 + 1.0 / f64::sqrt(1.0 + share));
            (found - exact).abs() / share
        };
        let (coarse, fine) = (error(64), error(128));
        assert!(fine < 2e-3 && fine < 0.6 * coarse, "{coarse:e} {fine:e}");
    }

    /// Cycles whose front is in the last cell of the contact do no work at any node.
    #[test]
    fn work_between_two_nodes_is_left_to_the_update() {
        let (profile, edge) = (Profile::Parabola { radius: 0.01 }, 2e-4);
        let depth = edge * edge / 0.01;
        let mut surface = Surface::new(profile.clone());
        surface.set_worn(Some(Nodes::around(&profile, 64, edge, 0.0)));
        let change = vec![0.0; surface.worn().expect("it has nodes").x().len()];
        let found = |amplitude: f64| {
            let law = SlipAtDepth::of_motion(Sliding::Cycles(amplitude), 1.0, depth, 1.0);
            change_of_mean_work(&surface, &[law], &change, NormalControl::Indentation)
        };
        assert_eq!(found(1e-6 * depth), -1.0);
        assert_eq!(found(0.5 * depth), 0.0);
    }

    /// Sliding onward at constant force does the same work on any profile.
    #[test]
    fn sliding_at_constant_force_does_the_same_work_on_any_profile() {
        let profile = Profile::Parabola { radius: 0.01 };
        let edge = 2e-4;
        let depth = edge * edge / 0.01;
        let mut surface = Surface::new(profile.clone());
        surface.set_worn(Some(Nodes::around(&profile, 64, edge, 0.0)));
        let nodes = surface.worn().expect("it has nodes");
        let change: Vec<f64> = nodes.x().iter().map(|x| 1e-2 * depth * (1.0 - x / edge)).collect();
        let law = SlipAtDepth::of_motion(Sliding::Onward, 1.0, depth, 1.0);
        let found = change_of_mean_work(&surface, &[law], &change, NormalControl::Force);
        assert!(found.abs() < 1e-4, "{found}");
    }
}
