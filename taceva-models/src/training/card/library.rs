//! Library of a model, as stored in its card.

use serde::{Deserialize, Serialize};

/// Library that fitted a model.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct LibraryCard {
    /// Release of the library that fitted the model, such as `linfa 0.8.1`.
    pub release: String,
    /// Cargo feature that a program needs to read the model.
    pub feature: String,
}
