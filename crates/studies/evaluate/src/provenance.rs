//! From what, and how, a result was made: enough to make it again.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use taceva_core::PressOutcome;
use taceva_dataset::Dataset;
use taceva_models::{ChosenBy, Model};

use crate::error::EvaluateError;
use crate::note::Note;
use crate::recordings::{self, RecordingProvenance};
use crate::rows::DataPart;

/// From what, and how, a result was made.
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
    /// The digests of the tables, where there is no dataset.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub tables: BTreeMap<String, String>,
    /// The model and its digest.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub model: Option<ModelProvenance>,
    /// How samples were divided.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub split: Option<String>,
    /// The seed of everything that was drawn.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seed: Option<u64>,
    /// The part that was scored: `test`, `all`, …
    #[serde(skip_serializing_if = "Option::is_none")]
    pub part: Option<String>,
    /// Samples a part, where there is a split.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub samples: BTreeMap<String, usize>,
    /// How the presses of each recording ended, by its digest, where a protocol pressed: all of them, scored or not.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub presses: BTreeMap<String, BTreeMap<PressOutcome, u64>>,
    /// Frames that it rests on, each once for learning and once for predicting, decoded now or when their features were kept.
    pub frames_decoded: u64,
    /// Third-party code that took part.
    pub plugins: Vec<String>,
    /// The digest of the table of samples that was written beside the result.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub samples_table: Option<String>,
    /// What was changed by hand in what it was made from, and accepted: file, date, reason and digests.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub edits: Vec<String>,
    /// What it was made from that carries no seal, so that changes of it could not be noticed.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub unsealed: Vec<String>,
    /// What a reader should know.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
}

impl Provenance {
    /// The provenance of `dataset` itself.
    pub fn of(dataset: &Dataset) -> Provenance {
        let mut provenance = Provenance {
            taceva: env!("CARGO_PKG_VERSION").to_owned(),
            dataset: Some(dataset.digest().to_string()),
            recordings: recordings::provenance(dataset),
            ..Provenance::default()
        };
        match dataset.recordings() {
            [] => provenance.add_recording(dataset, ""),
            joined => joined.iter().for_each(|own| {
                provenance.add_recording(own.dataset(), &format!("{}/", own.name()));
            }),
        }
        provenance
    }

    /// Adds what the header of a recording says of how it came to be; its file is called by `folder` first.
    fn add_recording(&mut self, dataset: &Dataset, folder: &str) {
        let header = dataset.header();
        if !header.presses.is_empty() {
            let digest = dataset.digest().to_string();
            self.presses.insert(digest, header.presses.clone());
        }
        let edits = header.seal.history.iter();
        self.edits
            .extend(edits.map(|edit| format!("{folder}dataset.toml, {edit}")));
        if !header.seal.is_sealed {
            let format = header.format;
            self.unsealed
                .push(format!("{folder}dataset.toml of format {format}"));
        }
    }

    /// Whether the model was fitted on some of the samples that were scored, so that its skill on others stays unknown.
    pub fn is_of_seen_samples(&self) -> bool {
        let is_test = |part: &str| part == DataPart::Test.name();
        self.split.is_some() && self.part.as_deref().is_some_and(|part| !is_test(part))
    }

    /// How many presses ended in which way, of all recordings together.
    pub fn press_counts(&self) -> BTreeMap<PressOutcome, u64> {
        let mut counts = BTreeMap::new();
        for (outcome, count) in self.presses.values().flatten() {
            *counts.entry(*outcome).or_default() += count;
        }
        counts
    }

    /// The provenance of both: what they share, with everything that was read for either.
    pub fn joined(mut self, other: &Provenance) -> Provenance {
        let same = |own: Option<String>, other: &Option<String>| {
            own.filter(|own| other.as_ref() == Some(own))
        };
        self.dataset = same(self.dataset, &other.dataset);
        self.split = same(self.split, &other.split);
        self.part = same(self.part, &other.part);
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
        for (own, other) in [
            (&mut self.edits, &other.edits),
            (&mut self.unsealed, &other.unsealed),
        ] {
            let new: Vec<String> = other
                .iter()
                .filter(|line| !own.contains(line))
                .cloned()
                .collect();
            own.extend(new);
        }
        for plugin in &other.plugins {
            if !self.plugins.contains(plugin) {
                self.plugins.push(plugin.clone());
            }
        }
        self
    }
}

/// The model behind a result.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModelProvenance {
    /// Its name: `ridge`.
    pub name: String,
    /// Its settings, chosen ones included.
    pub settings: BTreeMap<String, String>,
    /// The digest of the model file; `unknown` of a model that a caller holds.
    pub digest: String,
    /// The digest of the dataset it was fitted on; `unknown` of a model that was not fitted here.
    pub fitted_on: String,
    /// `given`, where a caller holds the model and only its predictions were taken.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub origin: Option<String>,
}

impl ModelProvenance {
    /// What a model's card says of it.
    pub fn of(model: &Model) -> Result<ModelProvenance, EvaluateError> {
        let card = model.card();
        let mut settings: BTreeMap<String, String> = card
            .settings
            .iter()
            .filter_map(|word| word.split_once('='))
            .map(|(key, value)| (key.to_owned(), value.to_owned()))
            .collect();
        settings.insert("features".to_owned(), card.features.to_string());
        if let Some(name) = card
            .choice
            .setting
            .as_ref()
            .filter(|_| card.choice.by != ChosenBy::Nobody)
        {
            let channels = card.channels.iter().zip(&card.choice.channels);
            let chosen: Vec<String> = channels
                .filter_map(|(channel, choice)| {
                    Some(format!("{}:{:.3e}", channel.name, choice.value?))
                })
                .collect();
            settings.insert(name.clone(), chosen.join(","));
        }
        Ok(ModelProvenance {
            name: card.model.clone(),
            settings,
            digest: model.digest()?,
            fitted_on: card
                .provenance
                .data
                .clone()
                .unwrap_or_else(|| "unknown".to_owned()),
            origin: None,
        })
    }
}

/// The choices that a person left open.
pub fn choices(model: &Model) -> impl Iterator<Item = Note> {
    let card = model.card();
    let features = card.feature_choice.as_ref().map(ToString::to_string);
    let choices = features
        .into_iter()
        .chain(card.auto.as_ref().map(ToString::to_string));
    choices.map(|choice| Note::Chosen { fold: None, choice })
}
