//! Subject of an evaluation: the sensor.

use serde::{Deserialize, Serialize};

/// Sensor whose samples were evaluated, with the origin of the samples.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Subject {
    /// Name of the sensor model: `DIGIT`.
    pub sensor: String,
    /// Serial number of the unit, or `unknown`.
    #[serde(default = "unknown")]
    pub serial: String,
    /// Id of the gel, or `unknown`.
    #[serde(default = "unknown")]
    pub gel: String,
    /// Origin of the samples: `recorded`, `simulated`, `synthetic`, `published`, `unknown` or `several`.
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
    /// Subject of two combined results: `several` for each field with different values.
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
