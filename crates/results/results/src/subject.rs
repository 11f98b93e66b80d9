//! Subject of an evaluation.

use serde::{Deserialize, Serialize};

/// Sensor that a result is about, and origin of its samples.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Subject {
    /// The sensor model.
    pub sensor: String,
    /// The serial number of the unit, or `unknown`.
    #[serde(default = "unknown")]
    pub serial: String,
    /// The id of the gel, or `unknown`.
    #[serde(default = "unknown")]
    pub gel: String,
    /// The origin of the samples: `recorded`, `simulated`, `synthetic`, `published`, `unknown` or `several`.
    #[serde(default = "unknown")]
    pub source: String,
}

fn unknown() -> String {
    "unknown".to_owned()
}

impl Default for Subject {
    fn default() -> Subject {
        Subject {
            sensor: unknown(),
            serial: unknown(),
            gel: unknown(),
            source: unknown(),
        }
    }
}

impl Subject {
    /// The subject of both: `several` where they differ.
    #[must_use]
    pub fn joined(&self, other: &Subject) -> Subject {
        let join = |own: &String, other: &String| match own == other {
            true => own.clone(),
            false => "several".to_owned(),
        };
        Subject {
            sensor: join(&self.sensor, &other.sensor),
            serial: join(&self.serial, &other.serial),
            gel: join(&self.gel, &other.gel),
            source: join(&self.source, &other.source),
        }
    }
}
