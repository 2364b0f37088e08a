//! Wear of slip in the plane of the contact: the product of the vectors of traction and slip.

use super::Pending;
use crate::surface::{Contact, Nodes};

impl Pending {
    /// [`Self::add`] with traction and slip by components.
    ///
    /// The slip path that couples wear to pressure is the part of the slip along the traction: then work and path are in the ratio of the
    /// traction, and wear ends where that does.
    pub(crate) fn add_in_plane(
        &mut self,
        nodes: &Nodes,
        contact: &Contact,
        (traction, slip): (&[Vec<f64>; 2], &[Vec<f64>; 2]),
        work: f64,
    ) -> f64 {
        let count = nodes.x().len();
        let all = slip.each_ref().map(|part| part.iter().sum::<f64>());
        let one_way = (0..count).all(|i| slip[0][i] * all[0] + slip[1][i] * all[1] >= 0.0);
        let (mut product, mut path) = (Vec::with_capacity(count), Vec::with_capacity(count));
        for i in 0..count {
            let [x, y] = traction.each_ref().map(|part| part.get(i).copied().unwrap_or(0.0));
            let (work, size) = (x * slip[0][i] + y * slip[1][i], x.hypot(y));
            product.push(work);
            path.push(if work > 0.0 { work / size } else { slip[0][i].hypot(slip[1][i]) });
        }
        self.add_product(nodes, contact, (&product, &path, one_way), (work, 1.25))
    }
}
