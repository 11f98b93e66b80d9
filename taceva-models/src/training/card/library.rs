//! Card entry for the library that fitted a model.

use serde::{Deserialize, Serialize};

/// Library that fitted a model.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct LibraryCard {
    /// Name and release of the library, such as `linfa 0.8.1`.
    pub release: String,
    /// Cargo feature that a program needs to read the model.
    pub feature: String,
}
