//! What tells the spacing of a grating.

use serde::{Deserialize, Serialize};

/// What tells the spacing of a grating from a picture of it, lines and dots apart.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum GratingTeller {
    /// Linear discriminants of how strong each fineness is in the picture.
    #[default]
    Spectrum,
    /// A small network with an output for each spacing.
    Cnn,
    /// A small network with one output, the spacing itself, which may lie between those that were taught.
    CnnLength,
}
