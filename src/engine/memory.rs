//! Memory that a step needs and that holds nothing between two steps: without it the next step
//! gives the same, and takes longer.

use super::state::Mark;
use super::stroke::StrokeStart;
use crate::friction::{PlanarRow, SlipPiece, Springs};
use crate::surface::TransformCache;
use crate::wear::UnitMesh;
use std::sync::Arc;

#[derive(Debug, Default)]
pub(crate) struct Memory {
    /// A former row.
    pub(super) springs: Springs,
    /// A former row of vectors.
    pub(super) planar: PlanarRow,
    /// The start of the stroke before the present one.
    pub(super) stroke: StrokeStart,
    /// Pieces of slip of the line that is being walked.
    pub(super) slips: Vec<SlipPiece>,
    /// The state before a change that may fail.
    pub(super) before: Option<Box<Mark>>,
    /// Tables of the moving mesh, kept so that they need not be made for each update.
    pub(super) mesh: Option<Arc<UnitMesh>>,
    /// Those of the nodes at rest.
    pub(super) transforms: TransformCache,
}

/// A copy of a contact has the tables, and buffers of its own.
impl Clone for Memory {
    fn clone(&self) -> Self {
        Self { mesh: self.mesh.clone(), transforms: self.transforms.clone(), ..Self::default() }
    }
}
