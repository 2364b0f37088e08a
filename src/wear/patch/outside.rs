//! Wear outside the contact, which other loads have left. The contact grows into it.

use crate::quadrature::GAUSS_3;
use crate::surface::Nodes;
use std::f64::consts::PI;
use std::sync::Arc;

/// Wear outside the contact, relative to the deepest, that is left out: an update of a profile that
/// wears very fast leaves so much there by an inexact contact edge.
const FAINT: f64 = 1e-2;

/// Worn depth outside the contact, by monotone cubics in X = x²; 0 where nothing has worn there.
#[derive(Debug, Clone, Default)]
pub(crate) struct Outside(Option<Arc<Worn>>);

#[derive(Debug)]
struct Worn {
    nodes: Nodes,
    /// ∫ w dX from each node on, m³.
    beyond: Vec<f64>,
}

impl Outside {
    /// Whether other loads have left wear outside a contact of some radius, m.
    pub(crate) fn is_left_on(nodes: &Nodes, radius: f64) -> bool {
        let beyond = nodes.x().partition_point(|x| *x <= radius);
        let deepest = |depths: &[f64]| depths.iter().fold(0.0, |most: f64, w| most.max(*w));
        deepest(&nodes.depth()[beyond..]) > FAINT * deepest(nodes.depth())
    }

    /// The wear outside a contact.
    pub(crate) fn of(nodes: &Nodes) -> Self {
        let mut beyond = vec![0.0; nodes.x().len()];
        for j in (0..nodes.last()).rev() {
            let (start, end) = (nodes.x()[j].powi(2), nodes.x()[j + 1].powi(2));
            beyond[j] = beyond[j + 1] + integral(nodes, start, end);
        }
        Self(Some(Arc::new(Worn { nodes: nodes.clone(), beyond })))
    }

    pub(crate) fn is_some(&self) -> bool {
        self.0.is_some()
    }

    /// The depth at the square of a radius, m, and its slope in that, 1/m.
    pub(super) fn depth_and_slope(&self, square: f64) -> (f64, f64) {
        self.0.as_ref().map_or((0.0, 0.0), |worn| worn.nodes.smooth_depth(square))
    }

    /// All that has worn, on either side of the contact edge, m³; `None` where nothing has outside.
    pub(crate) fn whole_volume(&self) -> Option<f64> {
        self.0.as_ref().map(|worn| PI * worn.beyond[0])
    }

    /// Volume beyond the square of a radius, m³.
    pub(super) fn volume_beyond(&self, square: f64) -> f64 {
        let Some(Worn { nodes, beyond, .. }) = self.0.as_deref() else { return 0.0 };
        let Some(cell) = nodes.cell(square.sqrt()) else { return 0.0 };
        PI * (integral(nodes, square, nodes.x()[cell + 1].powi(2)) + beyond[cell + 1])
    }

    /// Appends it to the nodes of the contact.
    pub(crate) fn append_to(&self, nodes: &mut Nodes) {
        if let Some(worn) = &self.0 {
            nodes.append_worn(&worn.nodes);
        }
    }
}

/// ∫ w dX within a cell, m³; the rule is exact for cubics.
fn integral(nodes: &Nodes, start: f64, end: f64) -> f64 {
    let (middle, half) = (0.5 * (start + end), 0.5 * (end - start));
    GAUSS_3.iter().map(|(node, weight)| half * weight * nodes.smooth_depth(middle + half * node).0).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Depth, slope in X and volume of w = (1 − X/b²)³ up to b from nodes, which rise faster than
    /// evenly: the slope is of second order in the cells, the others of more.
    #[test]
    fn the_wear_outside_is_read_as_it_was_left() {
        const END: f64 = 2.0;
        let exact = |square: f64| (1.0 - square / END.powi(2)).max(0.0);
        let errors = |cells: u32| {
            let x: Vec<f64> =
                (0..=2 * cells).map(|k| END * (f64::from(k) / f64::from(cells)).powf(1.5)).collect();
            let depth = x.iter().map(|x| exact(x * x).powi(3)).collect();
            let outside = Outside::of(&Nodes::holding((x.clone(), vec![0.0; x.len()], depth), 64, None));
            let mut errors = [0.0_f64; 3];
            for k in 0..=300 {
                let square = 1.0 + f64::from(k) * 0.012;
                let (depth, slope) = outside.depth_and_slope(square);
                let volume = PI * END.powi(2) * exact(square).powi(4) / 4.0;
                let found = [
                    depth - exact(square).powi(3),
                    slope + 3.0 * exact(square).powi(2) / END.powi(2),
                    outside.volume_beyond(square) - volume,
                ];
                errors.iter_mut().zip(found).for_each(|(most, error)| *most = most.max(error.abs()));
            }
            let whole = outside.whole_volume().expect("something has worn") - PI * END.powi(2) / 4.0;
            assert!(whole.abs() <= errors[2].max(1e-4), "{whole:e}");
            errors
        };
        let (coarse, fine) = (errors(20), errors(40));
        println!("{coarse:?} {fine:?}");
        for (coarse, (fine, order)) in coarse.iter().zip(fine.iter().zip([2.5, 1.9, 2.5])) {
            let observed = (coarse / fine).log2();
            assert!(observed > order, "{observed}: {coarse:e}, {fine:e}");
        }
        assert!(fine[0] < 1e-4 && fine[2] < 1e-4, "{fine:?}");
    }

    /// What is faint beside the deepest wear is left out, and so is what lies inside.
    #[test]
    fn little_wear_outside_is_left_out() {
        let is_left = |depth: f64| {
            let nodes = (vec![0.0, 1.0, 2.0, 3.0], vec![0.0; 4], vec![1.0, 1.0, depth, 0.0]);
            Outside::is_left_on(&Nodes::holding(nodes, 64, None), 1.5)
        };
        assert!(!is_left(0.0) && !is_left(0.009) && is_left(0.011));
        assert_eq!(Outside::default().depth_and_slope(4.0), (0.0, 0.0));
        assert_eq!(Outside::default().volume_beyond(4.0), 0.0);
    }
}
