//! Facts about a recording that are known before its first sample.

use std::collections::BTreeMap;
use std::ops::RangeInclusive;
use std::path::Path;
use std::time::Duration;

use taceva_core::{Clock, Date, Traceability};

use super::{Footprint, Header, SensorFacts, Source};
use crate::text::shown;

/// Facts about a recording that are known before its first sample.
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
    /// Origin of the samples: measured, simulated or synthetic.
    pub source: Source,
    /// Clock that stamps the samples. Defines the origin of `t_s`.
    pub clock: Clock,
    /// UTC day on which the recording began; `None` if nothing was measured, or for an import.
    pub recorded_on: Option<Date>,
    /// UTC day of the last session, if different from `recorded_on`.
    pub recorded_until: Option<Date>,
    /// Model, serial number and gel of the sensor.
    pub sensor: SensorFacts,
    /// Sensing area, if known.
    pub footprint: Option<Footprint>,
    /// Settings read back from camera, transducer (`force_…`) and robot (`robot_…`), by name, such as `15.7` for `exposure_ms`; empty if unknown.
    pub settings: BTreeMap<String, String>,
    /// Instruments that measure the labels, with their certificates; empty if none is stated.
    pub traceability: Vec<Traceability>,
}

impl RecordingFacts {
    /// Facts with unknown footprint, settings, day and instruments.
    pub fn new(source: Source, clock: Clock, sensor: SensorFacts) -> RecordingFacts {
        RecordingFacts {
            source,
            clock,
            recorded_on: None,
            recorded_until: None,
            sensor,
            footprint: None,
            settings: BTreeMap::new(),
            traceability: Vec::new(),
        }
    }

    /// The same facts with the settings read back from devices.
    #[must_use]
    pub fn with_settings(self, settings: BTreeMap<String, String>) -> RecordingFacts {
        RecordingFacts { settings, ..self }
    }

    /// The same facts with the day on which the recording begins.
    #[must_use]
    pub fn with_recorded_on(self, recorded_on: Option<Date>) -> RecordingFacts {
        RecordingFacts {
            recorded_on,
            ..self
        }
    }

    /// The same facts with the instruments that measure the labels.
    #[must_use]
    pub fn with_traceability(self, traceability: Vec<Traceability>) -> RecordingFacts {
        RecordingFacts {
            traceability,
            ..self
        }
    }

    /// The same facts with the sensing area.
    #[must_use]
    pub fn with_footprint(self, footprint: Footprint) -> RecordingFacts {
        RecordingFacts {
            footprint: Some(footprint),
            ..self
        }
    }

    /// The same facts, with the day, settings and instruments of `before`, the interrupted recording that is resumed.
    pub(crate) fn resuming(self, before: &RecordingFacts) -> RecordingFacts {
        RecordingFacts {
            recorded_on: before.recorded_on,
            recorded_until: before.recorded_until,
            settings: before.settings.clone(),
            traceability: before.traceability.clone(),
            ..self
        }
    }

    /// Error message for the first setting whose value differs in `now`; `None` if all agree. A setting that only `now` has is ignored, because
    /// earlier builds stored fewer settings.
    pub(crate) fn other_setting(&self, now: &RecordingFacts) -> Option<String> {
        self.settings.iter().find_map(|(name, before)| {
            let found = match now.settings.get(name) {
                Some(found) if found == before => return None,
                Some(found) => format!("`{}`", shown(found)),
                None => "not stated by the device".to_owned(),
            };
            let (name, before) = (shown(name), shown(before));
            Some(format!("the setting `{name}` is {found}, expected `{before}` as in the existing recording: restore it, or record into a new folder"))
        })
    }

    /// Error message if the instruments differ from the instruments of `now`; `path` is the existing recording. A recording without instruments
    /// agrees with any `now`, because earlier builds stored none.
    pub(crate) fn other_instrument(&self, now: &RecordingFacts, path: &Path) -> Option<String> {
        if self.traceability.is_empty() || self.traceability == now.traceability {
            return None;
        }
        let [before, now] = [self, now].map(|facts| {
            let mut devices = facts.traceability.clone();
            for of in &mut devices {
                of.certificate = None;
            }
            devices
        });
        Some(match before == now {
            true => format!(
                "the existing recording has another certificate of an instrument, or none; close that recording with `taceva capture {} --close`, or record into a new folder",
                taceva_core::shown(path)
            ),
            false => "the existing recording has another serial number or driver of an instrument; record into a new folder".to_owned(),
        })
    }
}

impl Header {
    /// First and last UTC day of the sample times `t_s`, s, or of the sessions of the recording; `None` if no day is known.
    pub fn days(&self, t_s: &[Option<f64>]) -> Option<RangeInclusive<Date>> {
        if self.clock != Clock::Unix {
            let first = self.recorded_on?;
            return Some(first..=self.recorded_until.unwrap_or(first));
        }
        let day = |time_s: f64| {
            let since = Duration::try_from_secs_f64(time_s).ok()?;
            Some(Date::of_unix_s(since.as_secs()))
        };
        let times = t_s.iter().flatten();
        let first_s = times.clone().copied().fold(f64::INFINITY, f64::min);
        let last_s = times.copied().fold(f64::NEG_INFINITY, f64::max);
        Some(day(first_s)?..=day(last_s)?)
    }
}
