//! What was evaluated.

use serde::{Deserialize, Serialize};
use taceva_dataset::{Dataset, SensorFile, Source};

/// The sensor that a result is about, and whether its samples are real.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Subject {
    /// The sensor model.
    pub sensor: String,
    /// The serial number of the unit, or `unknown`.
    pub serial: String,
    /// The id of the gel, or `unknown`.
    pub gel: String,
    /// Where the samples come from: `recorded`, `simulated`, `synthetic`, or `unknown` for tables of numbers.
    pub source: String,
}

impl Subject {
    /// The subject of a dataset.
    pub fn of(dataset: &Dataset) -> Subject {
        let header = dataset.header();
        let source = match header.source {
            Source::Recorded => "recorded",
            Source::Simulated => "simulated",
            Source::Synthetic => "synthetic",
        };
        Subject {
            sensor: header.sensor.model.clone(),
            serial: header.sensor.serial.clone(),
            gel: header.sensor.gel.clone(),
            source: source.to_owned(),
        }
    }

    /// The subject of tables of numbers, as far as a sensor file names it.
    pub fn of_file(file: &SensorFile) -> Subject {
        let stated = |text: &Option<String>| text.clone().unwrap_or_else(|| "unknown".to_owned());
        Subject {
            sensor: stated(&file.model),
            serial: stated(&file.serial),
            gel: stated(&file.gel),
            source: "unknown".to_owned(),
        }
    }

    /// The subject of both: where they differ, `several`.
    pub fn joined(&self, other: &Subject) -> Subject {
        let join = |own: &String, other: &String| {
            if own == other {
                own.clone()
            } else {
                "several".to_owned()
            }
        };
        Subject {
            sensor: join(&self.sensor, &other.sensor),
            serial: join(&self.serial, &other.serial),
            gel: join(&self.gel, &other.gel),
            source: join(&self.source, &other.source),
        }
    }
}
