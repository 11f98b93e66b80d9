//! What a model file says of the library of its model.

use serde::{Deserialize, Serialize};

/// What a card says of the library that fitted a model.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct LibraryCard {
    /// The release that fitted it, `linfa 0.8.1`.
    pub release: String,
    /// The feature that a program needs in order to read the model.
    pub feature: String,
}
