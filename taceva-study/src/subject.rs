//! What was evaluated.

use serde::Serialize;
use taceva_dataset::{Dataset, Source};

/// The sensor that a result is about, and whether its samples are real.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
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

    /// The subject of tables that say nothing about it.
    pub fn unknown() -> Subject {
        let unknown = || "unknown".to_owned();
        Subject {
            sensor: unknown(),
            serial: unknown(),
            gel: unknown(),
            source: unknown(),
        }
    }
}
