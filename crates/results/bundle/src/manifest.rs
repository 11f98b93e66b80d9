//! The manifest of a bundle: its files, the files behind each study, and its claims.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use taceva_core::shown;
use taceva_results::{EvaluationReport, not_measured};

use crate::author::Author;
use crate::claim::Claim;
use crate::error::{BundleError, Damage};
use crate::layout::{FRAMES_ROLE, GENERATED, MANIFEST, MODEL_ROLE};
use crate::organization::Organization;

/// Schema of the manifest.
pub const BUNDLE_SCHEMA: &str = "taceva.bundle/1";

/// Content of every bundle.
pub(crate) const ABOUT: &str = "Results of TacEva with the files that compute them again.";
/// Sentence on a bundle without author or licence.
const UNFINISHED: &str = "Draft: author or licence is missing.";

/// Content of `bundle.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Manifest {
    /// Schema of the manifest, [`BUNDLE_SCHEMA`].
    pub schema: String,
    /// Name of the bundle for readers.
    pub name: String,
    /// Day on which the bundle was made.
    pub created: String,
    /// Version of the program that made the bundle.
    pub taceva: String,
    /// SPDX identifier of the licence; `None` for a draft.
    pub licence: Option<String>,
    /// Authors; empty for a draft.
    pub authors: Vec<Author>,
    /// Organization of the authors, which publishes the bundle; `None` if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub organization: Option<Organization>,
    /// True if author or licence is still missing.
    #[serde(rename = "draft", default, skip_serializing_if = "std::ops::Not::not")]
    pub is_unfinished: bool,
    /// Origin of the samples, as in the results.
    pub source: String,
    /// Statement on samples that were not measured.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub badge: Option<String>,
    /// All files except the manifest.
    pub files: Vec<BundledFile>,
    /// Files behind each study of the results.
    pub studies: Vec<StudyFiles>,
    /// Numbers of the results that the bundle claims.
    pub claims: Vec<Claim>,
    /// Files that were left out.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub withheld: Vec<Withheld>,
    /// Number of redacted words in each text.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub redacted: BTreeMap<String, u64>,
    /// Digest of the samples.
    pub samples_digest: String,
}

/// File of a bundle.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct BundledFile {
    /// Path in the bundle.
    pub path: String,
    /// Size in bytes.
    pub size: u64,
    /// `sha256:` and 64 hexadecimal digits.
    pub sha256: String,
    /// Role of the file: `state`, `truth`, `prediction`, `samples`, `results`, …
    pub role: String,
}

impl BundledFile {
    /// Hexadecimal digits of the digest.
    pub(crate) fn digits(&self) -> &str {
        self.sha256.strip_prefix("sha256:").unwrap_or(&self.sha256)
    }

    /// Media type, for Croissant.
    pub(crate) fn media_type(&self) -> &'static str {
        match self.path.rsplit('.').next() {
            Some("json") => "application/json",
            Some("csv") => "text/csv",
            Some("parquet") => "application/x-parquet",
            Some("toml") => "application/toml",
            Some("taceva" | "pack") => "application/octet-stream",
            Some("png") => "image/png",
            Some("jpg" | "jpeg") => "image/jpeg",
            _ => "text/plain",
        }
    }
}

/// Files behind a study.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct StudyFiles {
    /// Origin of the samples of the study, as in the results.
    #[serde(default)]
    pub source: String,
    /// Paths of the states; several states are merged.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub states: Vec<String>,
    /// Scored tables of truth and predictions; `None` if not included.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tables: Option<TableFiles>,
    /// The table of samples that an evaluation wrote; `None` if not included.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub samples: Option<String>,
    /// The model file that made the predictions; `None` if not included.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub model: Option<String>,
    /// Folders of the recordings with the pictures behind the predictions.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub frames: Vec<String>,
}

impl StudyFiles {
    /// Names of all files, except the files of recordings.
    pub(crate) fn names(&self) -> impl Iterator<Item = &String> {
        let inputs = self.states.iter().chain(self.table_names());
        inputs.chain(&self.model)
    }

    /// Names of the tables.
    pub(crate) fn table_names(&self) -> impl Iterator<Item = &String> {
        let tables = self.tables.iter();
        let tables = tables.flat_map(|tables| [&tables.truth, &tables.prediction]);
        tables.chain(&self.samples)
    }

    /// Table whose rows are the samples of the study; `None` without a table.
    pub(crate) fn sample_table(&self) -> Option<&str> {
        let truth = self.tables.as_ref().map(|tables| tables.truth.as_str());
        truth.or(self.samples.as_deref())
    }
}

/// Scored tables of truth and predictions.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct TableFiles {
    /// Path of the table of truth in the bundle.
    pub truth: String,
    /// Path of the table of predictions in the bundle.
    pub prediction: String,
    /// Name of the key column that the caller chose; `None` to find the column by its name.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub key: Option<String>,
}

/// File that was left out of a bundle.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Withheld {
    /// Role of the file.
    pub role: String,
    /// Reason why the file was left out.
    pub reason: String,
    /// Digest of the file.
    pub digest: String,
}

/// Keys that are read before the schema is known.
#[derive(Deserialize)]
struct Head {
    schema: String,
    #[serde(default)]
    taceva: Option<String>,
}

/// A manifest, with the digest of its seal and its accepted edits.
pub(crate) struct SealedManifest {
    pub(crate) manifest: Manifest,
    pub(crate) digest: String,
    pub(crate) edits: Vec<String>,
}

impl Manifest {
    /// Files that are not generated from the manifest.
    pub(crate) fn given_files(&self) -> impl Iterator<Item = &BundledFile> {
        let files = self.files.iter();
        files.filter(|file| !GENERATED.contains(&file.path.as_str()))
    }

    /// Remarks for readers: that the samples were not measured, and that the bundle is a draft. Empty if neither is true.
    pub(crate) fn remarks(&self) -> Vec<String> {
        let unfinished = self.is_unfinished.then(|| UNFINISHED.to_owned());
        self.badge.iter().cloned().chain(unfinished).collect()
    }

    /// Content of the bundle in words, with the remarks.
    pub(crate) fn description(&self) -> String {
        let mut sentences = self.remarks();
        sentences.insert(0, ABOUT.to_owned());
        sentences.join(" ")
    }

    /// Reads the text of a manifest.
    ///
    /// # Errors
    /// [`Damage`] for another schema, a broken seal or a value that breaks the schema.
    pub(crate) fn parse(text: &str) -> Result<SealedManifest, Damage> {
        let damaged = |rule, problem: String| Damage::new(MANIFEST, rule, problem);
        let rule = "the manifest has the schema of this version";
        let head: Head = serde_json::from_str(text)
            .map_err(|error| damaged(rule, format!("not a manifest of a bundle: {error}")))?;
        if head.schema != BUNDLE_SCHEMA {
            let problem = format!(
                "schema `{}`, written by TacEva {}: expected `{BUNDLE_SCHEMA}`, which TacEva {} reads; make the bundle again with this version",
                shown(&head.schema),
                shown(head.taceva.as_deref().unwrap_or("of an unknown version")),
                env!("CARGO_PKG_VERSION"),
            );
            return Err(damaged(rule, problem));
        }
        let opened = taceva_files::seal::json::check(text)
            .map_err(|error| damaged("the manifest has its seal", unsealed(&error.to_string())))?;
        if has_own_seal(text) != Some(true) {
            let problem = "`seal` is not exactly the seal of the content; make the bundle again";
            return Err(damaged("the manifest has its seal", problem.to_owned()));
        }
        let manifest = serde_json::from_str(text)
            .map_err(|error| damaged(rule, shown(&error.to_string()).to_string()))?;
        Ok(SealedManifest {
            manifest,
            digest: opened.digest,
            edits: opened.history.iter().map(ToString::to_string).collect(),
        })
    }

    /// True if tables were left out.
    pub(crate) fn withholds_tables(&self) -> bool {
        let mut withheld = self.withheld.iter();
        withheld.any(|own| ![MODEL_ROLE, FRAMES_ROLE].contains(&own.role.as_str()))
    }

    /// Digest of the file `name` in the manifest; `None` for an unlisted file.
    pub(crate) fn digest(&self, name: &str) -> Option<&str> {
        let file = self.files.iter().find(|file| file.path == name)?;
        Some(&file.sha256)
    }

    /// Text of the manifest with its seal.
    ///
    /// # Errors
    /// [`BundleError::Results`] if the manifest cannot be written as JSON.
    pub(crate) fn sealed(&self) -> Result<String, BundleError> {
        let sealed = taceva_results::sealed(self).map_err(|source| BundleError::Results {
            path: MANIFEST.into(),
            source,
        })?;
        Ok(format!("{sealed}\n"))
    }
}

/// Digest of the model file behind `report`; `None` for a model in memory, the models of a cross-validation, or no model.
pub(crate) fn model_digest(report: &EvaluationReport) -> Option<&str> {
    let own = &report.provenance;
    let is_file = |digest: &&str| digest.starts_with("sha256:") && own.cross_validation().is_none();
    let digest = own.model.as_ref().map(|model| model.digest.as_str());
    digest.filter(is_file)
}

/// Address of the licence with this SPDX identifier.
pub(crate) fn licence_address(licence: &str) -> String {
    format!("https://spdx.org/licenses/{licence}")
}

/// Message on a broken seal, without the command for accepting edits, which does not apply to manifests.
fn unsealed(fault: &str) -> String {
    let fault = fault.split("; restore it").next().unwrap_or(fault);
    format!("{fault}; restore it, or make the bundle again with `taceva bundle`")
}

/// True if every word of the seal equals the seal of the content; `None` without a seal. The digest of a seal does not cover the seal itself.
fn has_own_seal(text: &str) -> Option<bool> {
    let mut content: serde_json::Value = serde_json::from_str(text).ok()?;
    let seal = content.as_object_mut()?.remove("seal")?;
    let sealed = taceva_files::seal::json::seal(&content.to_string()).ok()?;
    let again: serde_json::Value = serde_json::from_str(&sealed).ok()?;
    Some(again["seal"] == seal)
}

/// Origin of the samples of all `reports`.
pub(crate) fn source_of(reports: &[EvaluationReport]) -> String {
    let mut sources = reports.iter().map(|report| report.subject.source.as_str());
    let first = sources.next().unwrap_or("unknown");
    match sources.all(|source| source == first) {
        true => first.to_owned(),
        false => "several".to_owned(),
    }
}

/// Statement on samples of `reports` that were not measured.
pub(crate) fn badge_of(reports: &[EvaluationReport]) -> Option<String> {
    not_measured(reports.iter().map(|report| report.subject.source.as_str()))
}

#[cfg(test)]
mod tests {
    use super::model_digest;

    #[test]
    fn the_models_of_a_cross_validation_are_no_file() {
        let result = r#"{"schema": "taceva.evaluation/1.0", "subject": {"sensor": "drawn"},
            "provenance": {"part": "test", "split": "random",
                "model": {"name": "ridge", "settings": {}, "digest": "sha256:0", "fitted_on": "sha256:1"}},
            "metrics": {"mae": {"Fz": {"value": 0.1, "unit": "N"}}}}"#;
        let sealed = taceva_files::seal::json::seal(result).expect("JSON");
        let mut report = taceva_results::read(&sealed).expect("results").remove(0);
        assert_eq!(model_digest(&report), Some("sha256:0"));
        report.provenance.split = Some("cv:5 by-point".to_owned());
        assert_eq!(model_digest(&report), None);
    }
}
