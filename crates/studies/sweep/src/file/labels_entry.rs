//! Tasks of two tables that a sweep scores in shards.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use taceva_core::shown;
use taceva_evaluate::{EvaluateError, TaskRule, TaskSpec};

use super::model_entry::word;
use super::place::FilePlace;
use crate::error::SweepError;
use crate::syntax::WrittenScore;

/// Tasks of two tables, as `taceva score --task` takes them.
///
/// ```
/// use taceva_sweep::SweepFile;
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("slip.toml");
/// std::fs::write(&path, r#"
///     sweep_version = 1
///     [score]
///     truth = "truth.csv"
///     pred = "pred.csv"
///     shards = 8
///     task = "slip=event:positive=slip"
///     cluster = "stroke"
/// "#)?;
/// let tables = SweepFile::read(&path)?.tables.ok_or("tables")?;
/// assert_eq!(tables.labels.ok_or("tasks")?.cluster.as_deref(), Some("stroke"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct LabelsEntry {
    /// Tasks, such as `slip=event:positive=slip`.
    pub tasks: Vec<String>,
    /// Column with the clusters; `None` for `point_id`.
    pub cluster: Option<String>,
    /// True if rows with a non-finite number are counted and left out, false if they are rejected.
    pub allow_invalid: bool,
    /// Thresholds by the name of the task, as decimals.
    pub thresholds: BTreeMap<String, String>,
    /// Debounce of each task in frames, by the name of the task.
    pub debounces: BTreeMap<String, String>,
}

impl LabelsEntry {
    /// Parses the tasks of `written`; `None` without a task.
    pub(super) fn of(
        written: &WrittenScore,
        place: FilePlace<'_>,
    ) -> Result<Option<LabelsEntry>, SweepError> {
        let tasks = written.task.as_slice().to_vec();
        if tasks.is_empty() {
            let rules = [
                ("cluster", written.cluster.is_some()),
                ("threshold", !written.threshold.is_empty()),
                ("debounce", !written.debounce.is_empty()),
            ];
            return match rules.iter().find(|(_, is_there)| *is_there) {
                None => Ok(None),
                Some((key, _)) => Err(place.wrong(
                    key,
                    format!("`{key}` is for tasks: write `task = \"NAME=KIND\"` beside it"),
                )),
            };
        }
        if !written.units.is_empty() {
            let problem = "`units` is for channels, but `task` scores labels: omit `units`";
            return Err(place.wrong("units", problem.to_owned()));
        }
        let texts = |key: &str, written: &BTreeMap<String, toml::Value>| {
            let texts = written.iter().map(|(name, value)| {
                let text = word(value).ok_or_else(|| {
                    let problem = format!("`{key}` of {}: expected a number", shown(name));
                    place.wrong(key, problem)
                })?;
                Ok((name.clone(), text))
            });
            texts.collect::<Result<BTreeMap<_, _>, SweepError>>()
        };
        let entry = LabelsEntry {
            tasks,
            cluster: written.cluster.clone(),
            allow_invalid: written.allow_invalid,
            thresholds: texts("threshold", &written.threshold)?,
            debounces: texts("debounce", &written.debounce)?,
        };
        let checked = entry.specs().and(entry.rules());
        checked.map_err(|error| place.wrong("task", error.to_string()))?;
        Ok(Some(entry))
    }

    /// All parts as text. Different entries have different texts.
    pub(crate) fn words(&self) -> Vec<String> {
        let tasks = self.tasks.iter().map(|task| format!("task {task}"));
        let cluster = self.cluster.iter();
        let cluster = cluster.map(|cluster| format!("cluster {cluster}"));
        let rules = [
            ("threshold", &self.thresholds),
            ("debounce", &self.debounces),
        ];
        let rules = rules.into_iter().flat_map(|(key, rules)| {
            let rules = rules.iter();
            rules.map(move |(name, rule)| format!("{key} {name}={rule}"))
        });
        let invalid = self.allow_invalid.then(|| "allow_invalid".to_owned());
        tasks.chain(cluster).chain(rules).chain(invalid).collect()
    }

    /// Parsed tasks.
    ///
    /// # Errors
    /// [`EvaluateError::Request`] for a text that is not a task.
    pub(crate) fn specs(&self) -> Result<Vec<TaskSpec>, EvaluateError> {
        let specs = self.tasks.iter().map(|task| task.parse::<TaskSpec>());
        specs
            .collect::<Result<_, String>>()
            .map_err(EvaluateError::Request)
    }

    /// Rules by the name of the task.
    ///
    /// # Errors
    /// [`EvaluateError::Request`] for a threshold that is not a finite number, or a debounce that is not a number of frames.
    pub(crate) fn rules(&self) -> Result<BTreeMap<String, TaskRule>, EvaluateError> {
        let mut rules: BTreeMap<String, TaskRule> = BTreeMap::new();
        let wrong = |key: &str, text: &str, expected: &str| {
            EvaluateError::Request(format!("`{key}`: `{}`, expected {expected}", shown(text)))
        };
        for (name, text) in &self.thresholds {
            let limit = text.parse::<f64>().ok().filter(|limit| limit.is_finite());
            let limit = limit.ok_or_else(|| wrong("threshold", text, "a number"))?;
            rules.entry(name.clone()).or_default().threshold = Some(limit);
        }
        for (name, text) in &self.debounces {
            let count = text.parse::<u32>().ok().filter(|count| *count > 0);
            let count =
                count.ok_or_else(|| wrong("debounce", text, "a number of frames, 1 or more"))?;
            rules.entry(name.clone()).or_default().debounce = Some(count);
        }
        Ok(rules)
    }
}
