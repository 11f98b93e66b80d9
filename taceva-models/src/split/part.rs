//! Parts of a split.

use std::fmt;

use serde::{Deserialize, Serialize};

/// Part of the samples: training, validation or test.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Part {
    /// Training samples.
    Train,
    /// Validation samples, on which model settings are chosen.
    Validation,
    /// Test samples, which are not used in a fit.
    Test,
}

impl Part {
    /// All parts, in the order training, validation, test.
    pub const ALL: [Part; 3] = [Part::Train, Part::Validation, Part::Test];

    /// Returns the part named `train`, `val`, `validation` or `test`; `None` for other names.
    pub fn from_name(name: &str) -> Option<Part> {
        match name {
            "train" => Some(Part::Train),
            "val" | "validation" => Some(Part::Validation),
            "test" => Some(Part::Test),
            _ => None,
        }
    }

    /// Name of the part: `train`, `validation` or `test`.
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
