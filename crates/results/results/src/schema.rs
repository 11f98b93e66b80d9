//! Reads and writes results as sealed JSON with a schema.

use std::borrow::Cow;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use taceva_core::shown;

use crate::error::ResultsError;
use crate::report::{EVALUATION_SCHEMA, EvaluationReport};

/// Schema of the JSON of all evaluations of a scene, with the same version numbers as [`EVALUATION_SCHEMA`].
pub const RUN_SCHEMA: &str = "taceva.run/1.0";

/// Evaluation reports of a scene, one per study.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RunReport<'a> {
    /// Schema of the report: [`RUN_SCHEMA`].
    pub schema: Cow<'a, str>,
    /// One report per study.
    pub studies: Cow<'a, [EvaluationReport]>,
}

impl<'a> RunReport<'a> {
    /// Creates the report of a run from the reports of its studies.
    pub fn new(studies: &'a [EvaluationReport]) -> RunReport<'a> {
        RunReport {
            schema: Cow::Borrowed(RUN_SCHEMA),
            studies: Cow::Borrowed(studies),
        }
    }
}

/// Parses the evaluation reports in a text with the schema [`EVALUATION_SCHEMA`] or [`RUN_SCHEMA`].
///
/// Accepted manual edits are added to the provenance of each evaluation.
///
/// ```
/// let error = taceva_results::read(r#"{"schema": "taceva.evaluation/1.3", "provenance": {"taceva": "0.1.0"}}"#).unwrap_err();
/// assert_eq!(
///     error.to_string(),
///     "schema `taceva.evaluation/1.3`, written by TacEva 0.1.0: expected `taceva.evaluation/1.0`; run `taceva evaluate …` again with this version"
/// );
/// ```
///
/// # Errors
/// [`ResultsError`] if the text is not JSON, has another schema, is unsealed or changed, or contains an unexpected value.
pub fn read(text: &str) -> Result<Vec<EvaluationReport>, ResultsError> {
    let head: Head = serde_json::from_str(text)?;
    let Some(serde_json::Value::String(schema)) = &head.schema else {
        return Err(ResultsError::Schema {
            found: "no schema".to_owned(),
        });
    };
    let is_run = match schema.as_str() {
        EVALUATION_SCHEMA => false,
        RUN_SCHEMA => true,
        other if other.starts_with("taceva.evaluation/") => {
            return Err(head.refusal(other, EVALUATION_SCHEMA, EVALUATE_AGAIN));
        }
        other if other.starts_with("taceva.run/") => {
            return Err(head.refusal(other, RUN_SCHEMA, RUN_AGAIN));
        }
        other => {
            return Err(ResultsError::Schema {
                found: format!("schema `{}`", shown(other)),
            });
        }
    };
    let seal = taceva_files::seal::json::check(text)?;
    let mut reports = match is_run {
        true => place_named::<RunReport<'_>>(text)?.studies.into_owned(),
        false => vec![place_named(text)?],
    };
    for report in &mut reports {
        let edits = seal.history.iter();
        report
            .provenance
            .edits
            .extend(edits.map(|edit| format!("results, {edit}")));
    }
    Ok(reports)
}

/// Formats `report` as sealed JSON, one value per line.
///
/// # Errors
/// [`ResultsError`] if `report` does not serialize to a JSON object.
pub fn sealed(report: &impl Serialize) -> Result<String, ResultsError> {
    let text = serde_json::to_string_pretty(report)?;
    Ok(taceva_files::seal::json::seal(&text)?)
}

/// Remedy if another version of TacEva wrote an evaluation report.
const EVALUATE_AGAIN: &str = "run `taceva evaluate …` again with this version";
/// Remedy if another version of TacEva wrote a run report. New scores need no new presses on a real rig.
const RUN_AGAIN: &str = "run `taceva run …` again with this version, or without new presses `taceva evaluate` on each of its recordings";

/// Parts of a JSON text that state its schema and the version of TacEva that wrote it.
#[derive(Default, Deserialize)]
struct Head {
    schema: Option<serde_json::Value>,
    #[serde(default)]
    provenance: serde_json::Value,
    #[serde(default)]
    studies: serde_json::Value,
}

impl Head {
    fn refusal(&self, found: &str, expected: &'static str, remedy: &'static str) -> ResultsError {
        let own = &self.provenance["taceva"];
        let of_first = &self.studies[0]["provenance"]["taceva"];
        let version = own.as_str().or_else(|| of_first.as_str());
        ResultsError::Version {
            found: shown(found).to_string(),
            version: shown(version.unwrap_or("of an unknown version")).to_string(),
            expected,
            remedy,
        }
    }
}

/// Parses `text` as JSON. An error names the path of the unexpected value.
fn place_named<T: DeserializeOwned>(text: &str) -> Result<T, ResultsError> {
    let mut json = serde_json::Deserializer::from_str(text);
    serde_path_to_error::deserialize(&mut json).map_err(|error| ResultsError::Place {
        place: shown(&error.path().to_string()).to_string(),
        problem: shown(&error.inner().to_string()).to_string(),
    })
}
