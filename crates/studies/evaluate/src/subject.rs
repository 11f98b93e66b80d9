//! Subjects of evaluations: the sensor, if known.

use taceva_dataset::{Dataset, SensorFile, Source};
use taceva_results::Subject;

/// Sensor of a dataset, as the subject of a report.
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

/// Sensor that `file` describes, as the subject of a report on tables of numbers.
pub(crate) fn of_file(file: &SensorFile) -> Subject {
    let stated = |text: &Option<String>| text.clone().unwrap_or_else(|| "unknown".to_owned());
    Subject {
        sensor: stated(&file.model),
        serial: stated(&file.serial),
        gel: stated(&file.gel),
        ..Subject::default()
    }
}
