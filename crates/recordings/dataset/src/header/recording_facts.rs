//! Facts of a recording that are known before its first sample.

use std::collections::BTreeMap;

use taceva_core::Clock;

use super::{Footprint, SensorFacts, Source};

/// What is known about a recording before its first sample.
///
/// ```
/// use taceva_core::Clock;
/// use taceva_dataset::{Footprint, RecordingFacts, SensorFacts, Source};
///
/// let facts = RecordingFacts::new(Source::Recorded, Clock::Monotonic, SensorFacts::new("DIGIT"))
///     .with_footprint(Footprint::rectangle(8.0, 10.0));
/// assert!(facts.footprint.is_some());
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct RecordingFacts {
    /// Whether the samples are measured, simulated or made up.
    pub source: Source,
    /// The clock that stamps the samples: what `t_s` counts from.
    pub clock: Clock,
    /// Model, serial number and gel of the sensor.
    pub sensor: SensorFacts,
    /// Where the sensor senses, if it is known.
    pub footprint: Option<Footprint>,
    /// The settings of the camera that were set and read back, by name: `exposure_ms` is `15.7`; empty where nobody knows.
    pub settings: BTreeMap<String, String>,
}

impl RecordingFacts {
    /// Facts without a footprint.
    pub fn new(source: Source, clock: Clock, sensor: SensorFacts) -> RecordingFacts {
        RecordingFacts {
            source,
            clock,
            sensor,
            footprint: None,
            settings: BTreeMap::new(),
        }
    }

    /// The same with the settings of the camera that were set and read back.
    #[must_use]
    pub fn with_settings(self, settings: BTreeMap<String, String>) -> RecordingFacts {
        RecordingFacts { settings, ..self }
    }

    /// The same with the part of the gel that the sensor senses with.
    #[must_use]
    pub fn with_footprint(self, footprint: Footprint) -> RecordingFacts {
        RecordingFacts {
            footprint: Some(footprint),
            ..self
        }
    }
}
