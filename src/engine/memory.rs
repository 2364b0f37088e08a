//! Memory that a step needs and that holds nothing between two steps: without it the next step
//! gives the same, and takes longer.

use super::state::Mark;
use super::stroke::StrokeStart;
use crate::friction::{Row, SlipPiece};
use crate::surface::{NodeTransforms, Nodes, TransformCache};
use std::sync::Arc;

/// Made when a step first needs it: a contact of an interface has none between two steps.
#[derive(Debug, Clone, Default)]
pub(crate) struct Memory(Option<Box<Buffers>>);

impl Memory {
    #[inline(always)]
    pub(super) fn get(&mut self) -> &mut Buffers {
        self.0.get_or_insert_default()
    }

    /// The tables of nodes where they are there.
    pub(super) fn transforms_of(&self, nodes: &Nodes) -> Option<Arc<NodeTransforms>> {
        self.0.as_ref().and_then(|buffers| buffers.transforms.find(nodes).cloned())
    }
}

#[derive(Debug, Default)]
pub(super) struct Buffers {
    /// A former row.
    pub(super) row: Row,
    /// The start of the stroke before the present one.
    pub(super) stroke: StrokeStart,
    /// Pieces of slip of the line that is being walked.
    pub(super) slips: Vec<SlipPiece>,
    /// The state before a change that may fail.
    pub(super) before: Option<Box<Mark>>,
    /// Tables of the nodes at rest.
    pub(super) transforms: TransformCache,
}

/// A copy of a contact has the tables, and buffers of its own.
impl Clone for Buffers {
    fn clone(&self) -> Self {
        Self { transforms: self.transforms.clone(), ..Self::default() }
    }
}
