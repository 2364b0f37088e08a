//! What a mesh that moves with the contact edge covers.

/// What a moving mesh covers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub(crate) enum Region {
    /// From the stick radius to the contact edge.
    Annulus,
    /// The whole contact, in gross slip.
    Disc,
}
