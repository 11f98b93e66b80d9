//! What a sample is used for.

use std::fmt;

use serde::{Deserialize, Serialize};

/// What a sample is used for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Part {
    /// Learnt from.
    Train,
    /// Settings are chosen by it.
    Validation,
    /// Measured on, and never seen before.
    Test,
}

impl Part {
    /// Every part, in order.
    pub const ALL: [Part; 3] = [Part::Train, Part::Validation, Part::Test];

    /// The part called `train`, `val`, `validation` or `test`.
    pub fn from_name(name: &str) -> Option<Part> {
        match name {
            "train" => Some(Part::Train),
            "val" | "validation" => Some(Part::Validation),
            "test" => Some(Part::Test),
            _ => None,
        }
    }

    /// How it is written.
    pub const fn name(self) -> &'static str {
        match self {
            Part::Train => "train",
            Part::Validation => "validation",
            Part::Test => "test",
        }
    }

    pub(super) const fn short_name(self) -> &'static str {
        match self {
            Part::Validation => "val",
            _ => self.name(),
        }
    }
}

impl fmt::Display for Part {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
