//! Which nodes a line through others replaces.

/// Share of the largest image that thinning may take at the usual tolerance.
const USUAL_SHARE: f64 = 5e-5;

/// How much further off than an image a depth may be, since it makes the volume and no pressure;
/// and both, where nodes lie close together at the end. Half of it and twice give the same volumes
/// (docs/decisions/wear_backlog.md).
pub(super) const NEARLY: f64 = 20.0;

/// Indices of the nodes to keep: the lines (in x²) between them meet image and depth of all others,
/// the image within a share of the largest.
///
/// Nodes are crowded at the end where they lie closer together than a part of their distance from
/// it, or of the radius, which falls with the root of the share, as the error of a line does with
/// the square of its length. From `mesh_start` (m) on they are cells of the moving mesh that ends
/// there, and are left out. Elsewhere they are left out where the lines meet them nearly, which
/// they do not at a steep step in the profile that other loads have worn.
pub(crate) fn kept_nodes([x, image, depth]: [&[f64]; 3], (share, mesh_start): (f64, f64)) -> Vec<usize> {
    let last = x.len() - 1;
    let spread = (share / USUAL_SHARE).sqrt().min(1.0);
    let crowded = |anchor: usize, end: usize| {
        let close = spread * (0.25 * (x[last] - x[anchor])).min(0.01 * x[last]);
        x[end] - x[anchor] < close
    };
    let met = |share| both_met_by_lines(x, image, depth, share);
    let (meets, meets_nearly) = (met(share), met(NEARLY * share));
    thinned_while(x, image, |anchor, end| {
        let may_crowd = || x[anchor] >= mesh_start || meets_nearly(anchor, end + 1);
        crowded(anchor, end) && may_crowd() || meets(anchor, end + 1)
    })
}

/// Indices of nodes without those that may be left out of the cell that begins at a kept one: asked
/// for both, the kept one first.
pub(super) fn thinned_while(
    x: &[f64],
    image: &[f64],
    may_be_left_out: impl Fn(usize, usize) -> bool,
) -> Vec<usize> {
    let mut kept = vec![0];
    let (mut anchor, last) = (0, x.len() - 1);
    while anchor < last {
        let mut end = anchor + 1;
        // what has not worn at all stays so up to its last node
        let ends_unworn = |end: usize| image[anchor] == 0.0 && image[end] == 0.0 && image[end + 1] != 0.0;
        while end < last && !ends_unworn(end) && may_be_left_out(anchor, end) {
            end += 1;
        }
        kept.push(end);
        anchor = end;
    }
    kept
}

/// Whether lines (in x²) between two nodes meet both image and depth at all between them, the image
/// within a share of its largest value. An image that is flat behind a front has a depth that is
/// not.
pub(super) fn both_met_by_lines(
    x: &[f64],
    image: &[f64],
    depth: &[f64],
    share: f64,
) -> impl Fn(usize, usize) -> bool {
    let (image, depth) = (met_by_lines(x, image, share), met_by_lines(x, depth, NEARLY * share));
    move |anchor, end| image(anchor, end) && depth(anchor, end)
}

/// Whether the line (in x²) between two nodes meets a field at all between them within a share of
/// its largest value.
fn met_by_lines(x: &[f64], field: &[f64], share: f64) -> impl Fn(usize, usize) -> bool {
    let least = share * field.iter().fold(0.0, |most: f64, h| most.max(h.abs()));
    move |anchor, end| {
        let slope = (field[end] - field[anchor]) / ((x[end] - x[anchor]) * (x[end] + x[anchor]));
        (anchor + 1..end).all(|k| {
            let line = field[anchor] + slope * (x[k] - x[anchor]) * (x[k] + x[anchor]);
            (line - field[k]).abs() <= least
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The line from the axis to the first worn node would meet all between them well enough, and
    /// wear what has not worn.
    #[test]
    fn thinning_leaves_what_has_not_worn_at_all_unworn() {
        let x = [0.0, 0.2, 0.4, 0.5, 0.50001, 0.6, 0.7];
        let image = [0.0, 0.0, 0.0, 0.0, 1e-9, 0.5, 1.0];
        let meets = both_met_by_lines(&x, &image, &[0.0; 7], 0.01);
        assert_eq!(thinned_while(&x, &image, |anchor, end| meets(anchor, end + 1))[..2], [0, 3]);
        assert_eq!(kept_nodes([&x, &image, &[0.0; 7]], (0.01, 0.0))[..2], [0, 3]);
    }

    /// The image of a slip zone that has worn free is flat behind its front, its depth is not.
    #[test]
    fn thinning_meets_the_depth_as_well() {
        let x: Vec<f64> = (0..=40).map(|i| f64::from(i) / 40.0).collect();
        let depth: Vec<f64> = x.iter().map(|x| (x * x - 0.25_f64).max(0.0).sqrt()).collect();
        let image = vec![1.0; 41];
        let thinned = |depth: &[f64], share: f64| {
            let meets = both_met_by_lines(&x, &image, depth, share);
            thinned_while(&x, &image, |anchor, end| meets(anchor, end + 1))
        };
        let (alone, both) = (thinned(&image, 0.01), thinned(&depth, 0.01 / NEARLY));
        assert_eq!(alone, [0, 40]);
        let meets = |pair: &[usize]| met_by_lines(&x, &depth, 0.01)(pair[0], pair[1]);
        assert!(both.len() > 4 && both.windows(2).all(meets), "{both:?}");
    }
}
