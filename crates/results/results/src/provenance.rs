//! Provenance of results: everything needed to compute them again.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use taceva_core::{Date, PressOutcome, Traceability};

/// Text in each note that warns of optimistic scores, because the training part contained neighbours or copies of test samples.
///
/// ```
/// let note = "3 of 9 pictures of the test part are in the fit too: the scores are optimistic";
/// assert!(note.contains(taceva_results::OPTIMISTIC));
/// ```
pub const OPTIMISTIC: &str = "the scores are optimistic";

/// Inputs and settings behind a result.
///
/// The provenance is independent of the machine, the time and the number of jobs: equal inputs give equal bytes.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Provenance {
    /// Version of TacEva.
    pub taceva: String,
    /// Digest of the dataset. `None` without a dataset, or if the results joined here have different datasets.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dataset: Option<String>,
    /// Recordings whose samples were joined for the result, in the order of the command line; empty for a single recording.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub recordings: Vec<RecordingProvenance>,
    /// View of the frames, if each sample has several pictures: `left`, or `left+right` side by side. `None` for other samples.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub view: Option<String>,
    /// Digest of each input table by the name of the table, for results without a dataset.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub tables: BTreeMap<String, String>,
    /// Model with its digest; `None` if no model was fitted or named.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub model: Option<ModelProvenance>,
    /// Split of the samples into parts, as text such as `by-point 70/20/10`; `None` without a split.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub split: Option<String>,
    /// Sentence that states if samples recorded one after another resemble each other, and if the split separates them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub neighbours: Option<String>,
    /// Seed of all random choices. `None` without a seed, or if the results joined here have different seeds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seed: Option<u64>,
    /// Scored part of the split: `test`, `all`, …. `None` if the results joined here have different parts.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub part: Option<String>,
    /// Number of samples in each part, if there is a split.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub samples: BTreeMap<String, usize>,
    /// Phase of the protocol in which a metric was scored, by name of the metric; empty without a protocol.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub phases: BTreeMap<String, String>,
    /// For each recording, by its digest, the number of presses by outcome; empty without a protocol.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub presses: BTreeMap<String, BTreeMap<PressOutcome, u64>>,
    /// Instruments that measured the labels, with their certificates, over all recordings.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub traceability: Vec<Traceability>,
    /// Settings of the recording devices, such as `force_rate_hz`. For several recordings, only the settings that are equal in all.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub devices: BTreeMap<String, String>,
    /// Latest UTC day of a recording whose instruments are known; `None` without such a recording.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub recorded_on: Option<Date>,
    /// Number of frames that training and prediction used, each with its own count. Frames whose features came from a cache count too.
    pub frames_decoded: u64,
    /// Third-party plugins that took part in computing the result.
    pub plugins: Vec<String>,
    /// Digest of the table of samples written next to the result; `None` without this table.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub samples_table: Option<String>,
    /// Accepted manual edits of the inputs: file, date, reason and digests.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub edits: Vec<String>,
    /// Notes on the result for its readers.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
}

impl Provenance {
    /// Number of presses by outcome, over all recordings.
    pub fn press_counts(&self) -> BTreeMap<PressOutcome, u64> {
        let mut counts = BTreeMap::new();
        for (outcome, count) in self.presses.values().flatten() {
            *counts.entry(*outcome).or_default() += count;
        }
        counts
    }

    /// Provenance of a result combined from both: settings and digests that are equal in both, and the recordings, tables and notes of either.
    #[must_use]
    pub fn joined(mut self, other: &Provenance) -> Provenance {
        let same = |own: Option<String>, other: &Option<String>| {
            own.filter(|own| other.as_ref() == Some(own))
        };
        self.dataset = same(self.dataset, &other.dataset);
        self.split = same(self.split, &other.split);
        self.view = same(self.view, &other.view);
        self.part = same(self.part, &other.part);
        self.neighbours = same(self.neighbours, &other.neighbours);
        self.seed = self.seed.filter(|seed| other.seed == Some(*seed));
        self.model = self
            .model
            .filter(|model| other.model.as_ref() == Some(model));
        for recording in &other.recordings {
            if !self.recordings.contains(recording) {
                self.recordings.push(recording.clone());
            }
        }
        for (role, digest) in &other.tables {
            let mut name = role.clone();
            let mut number = 2;
            while self.tables.get(&name).is_some_and(|known| known != digest) {
                name = format!("{role} {number}");
                number += 1;
            }
            self.tables.insert(name, digest.clone());
        }
        self.phases
            .retain(|metric, phase| other.phases.get(metric) == Some(phase));
        for (part, count) in &other.samples {
            let own = self.samples.entry(part.clone()).or_default();
            *own = own.saturating_add(*count);
        }
        // A recording counts once, however often it took part.
        let presses = other.presses.iter();
        self.presses
            .extend(presses.map(|(digest, counts)| (digest.clone(), counts.clone())));
        self.traceability = Traceability::joined(&self.traceability, &other.traceability);
        self.devices
            .retain(|name, value| other.devices.get(name) == Some(value));
        self.recorded_on = self.recorded_on.max(other.recorded_on);
        // No table of samples is written for several states.
        self.samples_table = None;
        self.frames_decoded = self.frames_decoded.saturating_add(other.frames_decoded);
        for note in &other.notes {
            if !self.notes.contains(note) {
                self.notes.push(note.clone());
            }
        }
        for edit in &other.edits {
            if !self.edits.contains(edit) {
                self.edits.push(edit.clone());
            }
        }
        for plugin in &other.plugins {
            if !self.plugins.contains(plugin) {
                self.plugins.push(plugin.clone());
            }
        }
        self
    }
}

/// Model whose predictions were scored.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModelProvenance {
    /// Name of the model: `ridge`.
    pub name: String,
    /// Settings of the model, including the settings that the fit chose.
    pub settings: BTreeMap<String, String>,
    /// Digest of the model file; `unknown` for a model that exists only in the caller's program.
    pub digest: String,
    /// Digest of the training dataset; `unknown` for a model fitted by another program.
    pub fitted_on: String,
    /// Setting that the fit chose, and the method: `strength with each training sample left out in turn`; `None` without a choice.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub chosen_by: Option<String>,
    /// `given` if the caller passed only the predictions of the model; otherwise `None`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub origin: Option<String>,
}

/// One of several recordings whose samples were joined for a result.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct RecordingProvenance {
    /// Prefix of the names of the samples and contact points in the recording.
    pub name: String,
    /// Digest of the recording.
    pub digest: String,
    /// Number of samples in the recording, scored or not.
    pub samples: usize,
}

#[cfg(test)]
mod tests {
    use taceva_core::{Certificate, Coverage, Instrument};

    use super::*;

    fn of(number: &str) -> Provenance {
        let issued = "2026-05-12".parse().expect("a day");
        let coverage = Coverage::Factor(2.0);
        let mut force = Traceability::new(Instrument::Force);
        let mut certificate = Certificate::new(number, "a laboratory", issued, "42", coverage);
        let u = "3 mN".parse().expect("an amount");
        certificate.expanded.insert("Fz".to_owned(), u);
        force.certificate = Some(certificate);
        Provenance {
            traceability: vec![force],
            ..Provenance::default()
        }
    }

    #[test]
    fn a_joined_result_names_conflicting_certificates_both_and_equal_ones_once() {
        let joined = of("D-K-1").joined(&of("D-K-1")).joined(&of("D-K-2"));
        let numbers = joined.traceability.iter();
        let numbers: Vec<Option<&str>> = numbers
            .map(|of| Some(of.certificate.as_ref()?.number.as_str()))
            .collect();
        assert_eq!(numbers, [Some("D-K-1"), Some("D-K-2")]);
        let in_part = of("D-K-1").joined(&Provenance::default());
        assert!(in_part.traceability[1].certificate.is_none());
    }

    #[test]
    fn a_joined_result_states_the_settings_of_devices_that_are_equal_in_both() {
        let with = |filter: &str| {
            let settings = [("force_rate_hz", "500"), ("force_filter", filter)];
            let settings = settings.map(|(name, value)| (name.to_owned(), value.to_owned()));
            Provenance {
                devices: BTreeMap::from(settings),
                ..Provenance::default()
            }
        };
        assert_eq!(with("8").joined(&with("8")), with("8"));
        let joined = with("8").joined(&with("0"));
        let names: Vec<&str> = joined.devices.keys().map(String::as_str).collect();
        assert_eq!(names, ["force_rate_hz"]);
        let text = serde_json::to_string(&Provenance::default()).expect("JSON");
        assert!(!text.contains("devices"), "{text}");
    }

    #[test]
    fn certificates_read_back_from_a_result_and_no_key_is_written_without_them() {
        let provenance = of("D-K-1");
        let text = serde_json::to_string(&provenance).expect("JSON");
        assert!(text.contains(r#""U":{"Fz":"0.003 N"}"#), "{text}");
        assert_eq!(
            serde_json::from_str::<Provenance>(&text).expect("reads"),
            provenance
        );
        let text = serde_json::to_string(&Provenance::default()).expect("JSON");
        assert!(!text.contains("traceability"), "{text}");
    }
}
