//! Scores of tasks as a result: read from a report or computed from states, and as a study for limits.

use std::collections::BTreeMap;

use serde::Deserialize;
use taceva_core::{Unit, shown};
use taceva_metrics::{Better, LeftOut, Standing};
use taceva_results::{Interval, ResultsError, Score, Value, Variant};
use taceva_tasks::{TASKS_SCHEMA, TaskReport, TaskScore};

use crate::results::{Made, Study};

/// Beginning of the schema of every version.
const ANY_VERSION: &str = "taceva.tasks/";
/// Remedy for a result of another version.
const AGAIN: &str = "run `taceva score --task …` again with this version";
/// Roles of the tables with labels. A merged result numbers the roles.
const OF_LABELS: [&str; 2] = ["truth", "dataset"];
/// Name of the score of the best constant as a variant.
const OF_CONSTANT: &str = "of_constant";

/// Scores of tasks of one model, for comparisons and limits.
///
/// ```
/// use taceva_report::TaskResult;
/// use taceva_tasks::{TaskReport, TaskState, Classes};
/// let mut classes = Classes::new(["lost", "held"], Some("held"))?;
/// classes.push("cup", "held", "held")?;
/// let mut state = TaskState::new("grasp", "outcome", "object");
/// state.classes = Some(classes);
/// let mut report = TaskReport::new("0.2.0", "by `id`");
/// report.tasks.push(state.scores());
/// let result = TaskResult::of("model A", &report)?;
/// let study = result.study();
/// assert_eq!((study.sensor.as_str(), study.scores[0].metric.as_str()), ("model A", "class_accuracy"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct TaskResult {
    /// Name of the result for readers.
    #[serde(skip)]
    pub(crate) name: String,
    tables: BTreeMap<String, String>,
    pub(crate) sources: Vec<String>,
    pub(crate) tasks: Vec<ResultTask>,
}

/// One task of a result.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub(crate) struct ResultTask {
    pub(crate) name: String,
    cluster: String,
    names: Vec<String>,
    pub(crate) scores: Vec<ResultScore>,
    /// Names of the clusters; empty without a state.
    #[serde(skip)]
    pub(crate) clusters: Vec<String>,
}

/// One score of a task.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub(crate) struct ResultScore {
    pub(crate) metric: String,
    pub(crate) variant: Option<String>,
    pub(crate) unit: Option<String>,
    definition: String,
    pub(crate) estimate: ResultEstimate,
    /// Scores that leave out one cluster each; empty without a state.
    #[serde(skip)]
    pub(crate) left_out: Vec<LeftOut>,
}

/// Value and interval of a score.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub(crate) struct ResultEstimate {
    pub(crate) value: Option<f64>,
    pub(crate) undefined: Option<String>,
    ci95: Ends,
    method: Option<String>,
    standard_error: Option<f64>,
    degrees_of_freedom: Option<f64>,
    pub(crate) n: u64,
    pub(crate) clusters: u64,
    pub(crate) of_constant: Option<f64>,
}

/// Ends of an interval, or the reason for its absence.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(untagged)]
enum Ends {
    Known([f64; 2]),
    Absent { undefined: String },
}

/// Schema of a text, and the version that wrote it.
#[derive(Deserialize)]
struct Head {
    schema: String,
    #[serde(default)]
    taceva: Option<String>,
}

impl TaskResult {
    /// True if `text` has a schema of scores of tasks.
    pub fn is_in(text: &str) -> bool {
        let head: Option<Head> = serde_json::from_str(text).ok();
        head.is_some_and(|head| head.schema.starts_with(ANY_VERSION))
    }

    /// Reads the JSON of `score --task` or `evaluate --task` as the result called `name`.
    ///
    /// # Errors
    /// [`ResultsError`] if the text is not JSON, or has the schema of another version.
    pub fn read(name: impl Into<String>, text: &str) -> Result<TaskResult, ResultsError> {
        let head: Head = serde_json::from_str(text)?;
        if head.schema != TASKS_SCHEMA {
            let version = head.taceva.as_deref().unwrap_or("of an unknown version");
            return Err(ResultsError::Version {
                found: shown(&head.schema).to_string(),
                version: shown(version).to_string(),
                expected: TASKS_SCHEMA,
                remedy: AGAIN,
            });
        }
        let result: TaskResult = serde_json::from_str(text)?;
        Ok(TaskResult {
            name: name.into(),
            ..result
        })
    }

    /// Result called `name` with the scores of `report`, and with the scores that leave out one cluster each.
    ///
    /// # Errors
    /// [`ResultsError`] if a number of the report does not fit into JSON.
    pub fn of(name: impl Into<String>, report: &TaskReport) -> Result<TaskResult, ResultsError> {
        let mut result = TaskResult::read(name, &serde_json::to_string(report)?)?;
        for (task, own) in result.tasks.iter_mut().zip(&report.tasks) {
            task.clusters.clone_from(&own.clusters);
            for (score, own) in task.scores.iter_mut().zip(&own.scores) {
                score.left_out.clone_from(&own.estimate.left_out);
            }
        }
        Ok(result)
    }

    /// Adds the scores that leave out one cluster each from `other`, if both results have the same tables and scores.
    #[must_use]
    pub fn with_clusters_of(self, other: TaskResult) -> TaskResult {
        let is_same = self.tables == other.tables && numbers(&self) == numbers(&other);
        match is_same {
            true => TaskResult {
                name: self.name,
                ..other
            },
            false => self,
        }
    }

    /// Digests of the labels.
    pub(crate) fn labels(&self) -> Vec<&str> {
        let of_labels = self.tables.iter().filter(|(role, _)| {
            let word = role.split(' ').next().unwrap_or_default();
            OF_LABELS.contains(&word)
        });
        let mut digests: Vec<&str> = of_labels.map(|(_, digest)| digest.as_str()).collect();
        digests.sort_unstable();
        digests
    }

    /// The task called `name`; `None` for an unknown name.
    pub(crate) fn task(&self, name: &str) -> Option<&ResultTask> {
        self.tasks.iter().find(|task| task.name == name)
    }

    /// Study whose channels are the tasks, for limits. Omits scores in a unit that limits do not support, such as 1/min.
    pub fn study(&self) -> Study {
        let mut scores: Vec<Score> = Vec::new();
        for task in &self.tasks {
            for score in &task.scores {
                if score.known_unit().is_some() {
                    enter(&mut scores, task, score);
                }
            }
        }
        let source = match self.sources.as_slice() {
            [] => "unknown",
            [one] => one.as_str(),
            _ => "several",
        };
        let labels = self.labels();
        Study {
            sensor: self.name.clone(),
            serial: "unknown".to_owned(),
            gel: "unknown".to_owned(),
            source: source.to_owned(),
            scores,
            made: Made {
                truth: (!labels.is_empty()).then(|| labels.join(" ")),
                ..Made::default()
            },
            ..Study::default()
        }
    }
}

/// Bits of each score, to compare two results.
fn numbers(result: &TaskResult) -> Vec<Option<u64>> {
    let scores = result.tasks.iter().flat_map(|task| &task.scores);
    scores
        .map(|score| score.estimate.value.map(f64::to_bits))
        .collect()
}

/// Adds `score` to `scores`, as a score or as a variant of its metric.
fn enter(scores: &mut Vec<Score>, task: &ResultTask, score: &ResultScore) {
    let own = task.score_of(score);
    let Some(name) = &score.variant else {
        scores.push(own);
        return;
    };
    let variant = Variant {
        name: name.clone(),
        value: own.value.clone(),
        unit: own.unit,
        interval: own.interval.clone(),
    };
    let mut known = scores.iter_mut();
    match known.find(|known| known.metric == own.metric && known.channel == own.channel) {
        Some(whole) => whole.variants.push(variant),
        None => scores.push(Score {
            value: Value::Undefined(format!(
                "this metric has only variants, such as {}.{name}",
                own.metric
            )),
            interval: None,
            standing: Standing::Counts,
            variants: vec![variant],
            ..own
        }),
    }
}

impl ResultTask {
    /// Scores that readers compare: the main number of each metric, or its variants if there is no main number. Omits scores of single classes.
    pub(crate) fn compared(&self) -> impl Iterator<Item = &ResultScore> {
        self.scores
            .iter()
            .filter(move |score| match &score.variant {
                None => true,
                Some(variant) => {
                    let mut own = self.scores.iter();
                    let is_main =
                        |own: &ResultScore| own.metric == score.metric && own.variant.is_none();
                    let is_part = variant.starts_with("class ") || variant.contains(" ties_");
                    !is_part && !own.any(is_main)
                }
            })
    }

    /// Score of the same metric and variant as `of`; `None` if there is no such score.
    pub(crate) fn find(&self, of: &ResultScore) -> Option<&ResultScore> {
        let mut scores = self.scores.iter();
        scores.find(|score| score.metric == of.metric && score.variant == of.variant)
    }

    /// Everything that defines `score`: definition, unit, classes and column of the clusters.
    pub(crate) fn meaning(&self, score: &ResultScore) -> String {
        let mut names: Vec<&str> = self.names.iter().map(String::as_str).collect();
        // The order of the classes changes no score.
        names.sort_unstable();
        let unit = score.unit.as_deref().unwrap_or("1");
        let classes = match names.is_empty() {
            true => String::new(),
            false => format!(", classes {}", names.join(" ")),
        };
        format!(
            "{} in {unit}{classes}, clusters by {}",
            score.definition, self.cluster
        )
    }

    /// Converts `score` to a score whose channel is the task.
    pub(crate) fn score_of(&self, score: &ResultScore) -> Score {
        let of = &score.estimate;
        let value = match of.value {
            Some(value) => Value::Number(value),
            None => Value::Undefined(of.undefined.clone().unwrap_or_default()),
        };
        let unit = score.known_unit().unwrap_or(Unit::One);
        let constant = of.of_constant.map(|constant| Variant {
            name: OF_CONSTANT.to_owned(),
            value: Value::Number(constant),
            unit,
            interval: None,
        });
        Score {
            value,
            n: of.n,
            interval: Some(of.interval()),
            definition: self.meaning(score),
            standing: score.standing(),
            variants: constant.into_iter().collect(),
            ..Score::of_number(&score.metric, &self.name, 0.0, unit)
        }
    }
}

impl ResultScore {
    /// Name for readers: `f1`, `top_k k=2`.
    pub(crate) fn named(&self) -> String {
        match &self.variant {
            Some(variant) => format!("{} {variant}", self.metric),
            None => self.metric.clone(),
        }
    }

    /// Better direction of the score.
    pub(crate) fn better(&self) -> Better {
        TaskScore::direction(&self.metric, self.unit.as_deref())
    }

    /// Unit of the value; `None` for a unit that channels do not have.
    fn known_unit(&self) -> Option<Unit> {
        match &self.unit {
            None => Some(Unit::One),
            Some(symbol) => Unit::from_symbol(symbol),
        }
    }

    /// Standing of the score in verdicts. The score counts if its whole interval is better than the best constant, or if no constant has a score.
    pub(crate) fn standing(&self) -> Standing {
        let Some(constant) = self.estimate.of_constant else {
            return Standing::Counts;
        };
        let is_better = match (self.better(), &self.estimate.ci95) {
            (_, Ends::Absent { .. }) => return Standing::NoInterval,
            (Better::Higher, Ends::Known([low, _])) => *low > constant,
            (Better::Lower, Ends::Known([_, high])) => *high < constant,
            _ => true,
        };
        match is_better {
            true => Standing::Counts,
            false => Standing::NotAboveConstant,
        }
    }
}

impl ResultEstimate {
    /// Ends of the interval; `None` without an interval.
    pub(crate) fn ends(&self) -> Option<[f64; 2]> {
        match self.ci95 {
            Ends::Known(ends) => Some(ends),
            Ends::Absent { .. } => None,
        }
    }

    /// The interval with its method.
    fn interval(&self) -> Interval {
        match &self.ci95 {
            Ends::Known(ends) => Interval::Ends {
                ends: *ends,
                method: self.method.clone().unwrap_or_default(),
                standard_error: self.standard_error,
                clusters: Some(self.clusters),
                degrees_of_freedom: self.degrees_of_freedom,
            },
            Ends::Absent { undefined } => Interval::Absent(undefined.clone()),
        }
    }
}
