//! Provenance of results: enough to make them again.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use taceva_core::PressOutcome;

/// Inputs and settings behind a result.
///
/// Nothing here depends on the machine, the time or the number of jobs: the same inputs give the same bytes.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Provenance {
    /// The version of TacEva.
    pub taceva: String,
    /// The digest of the dataset.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dataset: Option<String>,
    /// The recordings that were taken as one, in the order in which they were named; none where there is one.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub recordings: Vec<RecordingProvenance>,
    /// The view of the frames, of a recording whose samples have several pictures: `left`, or `left+right` side by side.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub view: Option<String>,
    /// The digests of the tables, where there is no dataset.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub tables: BTreeMap<String, String>,
    /// The model and its digest.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub model: Option<ModelProvenance>,
    /// The division of samples into parts.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub split: Option<String>,
    /// Findings on neighbouring samples that resemble each other, and their division.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub neighbours: Option<String>,
    /// The seed of everything that was drawn.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seed: Option<u64>,
    /// The part that was scored: `test`, `all`, …
    #[serde(skip_serializing_if = "Option::is_none")]
    pub part: Option<String>,
    /// Samples a part, where there is a split.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub samples: BTreeMap<String, usize>,
    /// Outcomes of all presses of each recording, by its digest, where a protocol pressed.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub presses: BTreeMap<String, BTreeMap<PressOutcome, u64>>,
    /// Frames that it rests on, each once for learning and once for predicting, decoded now or when their features were kept.
    pub frames_decoded: u64,
    /// Third-party code that took part.
    pub plugins: Vec<String>,
    /// The digest of the table of samples that was written beside the result.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub samples_table: Option<String>,
    /// Accepted edits by hand of its inputs: file, date, reason and digests.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub edits: Vec<String>,
    /// Notes for a reader.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
}

impl Provenance {
    /// The number of presses of each outcome, of all recordings together.
    pub fn press_counts(&self) -> BTreeMap<PressOutcome, u64> {
        let mut counts = BTreeMap::new();
        for (outcome, count) in self.presses.values().flatten() {
            *counts.entry(*outcome).or_default() += count;
        }
        counts
    }

    /// The provenance of both: common values, with all inputs of either.
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
        for (part, count) in &other.samples {
            *self.samples.entry(part.clone()).or_default() += count;
        }
        // The same recording tells the same, however often it took part.
        let presses = other.presses.iter();
        self.presses
            .extend(presses.map(|(digest, counts)| (digest.clone(), counts.clone())));
        // Nobody writes the samples of several states.
        self.samples_table = None;
        self.frames_decoded += other.frames_decoded;
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

/// Model behind a result.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModelProvenance {
    /// The name: `ridge`.
    pub name: String,
    /// The settings, chosen ones included.
    pub settings: BTreeMap<String, String>,
    /// The digest of the model file; `unknown` of a model that a caller holds.
    pub digest: String,
    /// The digest of the dataset it was fitted on; `unknown` of a model that was not fitted here.
    pub fitted_on: String,
    /// `given`, where a caller holds the model and only its predictions were taken.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub origin: Option<String>,
}

/// Recording among those that a result is of.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct RecordingProvenance {
    /// The prefix of the names of its samples and contact points.
    pub name: String,
    /// Its digest.
    pub digest: String,
    /// The number of its samples, scored or not.
    pub samples: usize,
}
