//! Scores tasks of classes, from columns of classes and columns of their scores.

use taceva_core::shown;
use taceva_dataset::TaskKind;
use taceva_tasks::events::EventRule;
use taceva_tasks::{Classes, TaskError, TaskState};

use super::labels::{ClassColumn, ClassNames};
use super::score_columns::ScoreColumns;
use super::{Clusters, RowPair, TaskRule, TaskSpec, TaskTables, empty, events, listed};
use crate::error::EvaluateError;
use crate::score_states::ScoreStates;

/// A labelled sample of a task.
#[derive(Clone, Debug)]
pub(super) struct ClassRow<'a> {
    /// Cluster of the sample.
    pub(super) cluster: &'a str,
    /// Row numbers of the sample in both tables.
    pub(super) pair: RowPair,
    /// Index of the true class among the classes of the task.
    pub(super) truth: u32,
    /// Index of the predicted class, after the threshold and the debounce.
    pub(super) predicted: u32,
    /// Index of the predicted class, after the threshold and before the debounce.
    pub(super) before_debounce: u32,
    /// Scores of the classes; empty if the predictions have no scores.
    pub(super) scores: Vec<f64>,
}

/// Labelled samples of a task.
struct LabelledRows<'a> {
    rows: Vec<ClassRow<'a>>,
    /// Number of rows without a label.
    unlabelled: u64,
    /// Number of rows with a score that is not finite.
    invalid: u64,
}

/// Sums for the scores of a task with classes.
pub(super) fn state(
    tables: &TaskTables,
    clusters: &Clusters<'_>,
    task: &TaskSpec,
    rule: Option<&TaskRule>,
) -> Result<TaskState, EvaluateError> {
    let names = ClassNames::of(tables, task)?;
    let refused =
        |error: TaskError| EvaluateError::Request(format!("task `{}`: {error}", shown(&task.name)));
    let mut classes = Classes::new(names.all(), task.positive.as_deref()).map_err(refused)?;
    if let Some(rule) = rule.filter(|rule| !rule.is_empty()) {
        classes = classes.after_rule(rule.to_string());
    }
    let is_by_threshold = rule.is_some_and(|rule| rule.threshold.is_some());
    let LabelledRows {
        mut rows,
        unlabelled,
        invalid,
    } = rows(tables, clusters, task, &names, is_by_threshold)?;
    let positive = names.positive(task);
    if let Some(rule) = rule {
        apply(rule, &mut rows, &names, task)?;
    }
    rows.retain(|row| clusters.has(row.pair));
    for row in &rows {
        let [truth, predicted] = [row.truth, row.predicted];
        classes
            .push_positions(row.cluster, &[truth], &[predicted])
            .map_err(refused)?;
    }
    let mut state = empty(task, clusters);
    state.classes = Some(classes);
    state.notes.extend(names.note());
    state.unlabelled = unlabelled;
    state.invalid = invalid;
    state.is_sequence = rule.is_some_and(|rule| rule.debounce.is_some());
    if let Some(columns) = ScoreColumns::of(tables, task, &names)? {
        let positive = task.positive.as_deref();
        let scored = ScoreStates::new(names.all(), positive, columns.are_all());
        let mut scored = scored.map_err(refused)?;
        for row in &rows {
            let pushed = scored.push(row.cluster, row.truth, &row.scores);
            pushed.map_err(refused)?;
        }
        scored.add_to(&mut state).map_err(refused)?;
    }
    if let (TaskKind::Event, Some(positive)) = (task.kind, positive) {
        events::add(&mut state, tables, &rows, positive, rule)?;
    }
    Ok(state)
}

/// Labelled rows in the order of the truth.
fn rows<'a>(
    tables: &'a TaskTables,
    clusters: &Clusters<'a>,
    task: &TaskSpec,
    names: &ClassNames,
    is_by_threshold: bool,
) -> Result<LabelledRows<'a>, EvaluateError> {
    let of_truth = ClassColumn::of(&tables.truth, &task.name, names)?;
    let columns = ScoreColumns::of(tables, task, names)?;
    let of_prediction = match &columns {
        _ if is_by_threshold => None,
        Some(_) if !tables.prediction.has(&task.name) => None,
        None if !tables.prediction.has(&task.name) => {
            return Err(without_predictions(tables, task));
        }
        _ => Some(ClassColumn::of(&tables.prediction, &task.name, names)?),
    };
    let mut labelled = LabelledRows {
        rows: Vec::with_capacity(tables.pairs.len()),
        unlabelled: 0,
        invalid: 0,
    };
    for pair in &tables.pairs {
        let Some(truth) = of_truth.class(pair.truth)? else {
            labelled.unlabelled += u64::from(clusters.has(*pair));
            continue;
        };
        if let Some(columns) = &columns
            && tables.allow_invalid
            && columns.has_invalid(pair.prediction)
        {
            labelled.invalid += u64::from(clusters.has(*pair));
            continue;
        }
        let scores = match &columns {
            Some(columns) => columns.scores(pair.prediction)?,
            None => Vec::new(),
        };
        let predicted = match &of_prediction {
            // The threshold decides below.
            _ if is_by_threshold => 0,
            Some(column) => column.stated(pair.prediction)?,
            None => ScoreColumns::greatest(&scores, task, names)?,
        };
        labelled.rows.push(ClassRow {
            cluster: clusters.cell(*pair)?,
            pair: *pair,
            truth,
            predicted,
            before_debounce: predicted,
            scores,
        });
    }
    Ok(labelled)
}

/// Error for predictions without classes and without scores.
fn without_predictions(tables: &TaskTables, task: &TaskSpec) -> EvaluateError {
    let table = &tables.prediction;
    EvaluateError::Tables {
        path: table.path().to_owned(),
        problem: format!(
            "no column `{0}` with classes and no column `{0}.p.CLASS` with scores, expected one of them; the columns are {1}",
            shown(&task.name),
            listed(table.names().iter().map(String::as_str))
        ),
    }
}

/// Applies the threshold to the scores of the positive class, then the debounce to the rows of each cluster in their order.
fn apply(
    rule: &TaskRule,
    rows: &mut [ClassRow<'_>],
    names: &ClassNames,
    task: &TaskSpec,
) -> Result<(), EvaluateError> {
    let name = shown(&task.name);
    let refused = |problem: String| EvaluateError::Request(format!("task `{name}`: {problem}"));
    let Some(positive) = names.positive(task).filter(|_| names.all().len() == 2) else {
        return Err(refused(format!(
            "a threshold or a debounce needs two classes and a positive class, but the classes are {}: state positive=CLASS, or omit the rule",
            listed(names.all().iter().map(String::as_str))
        )));
    };
    let negative = 1 - positive;
    if let Some(threshold) = rule.threshold {
        check_threshold(threshold, rows, positive).map_err(refused)?;
        for row in rows.iter_mut() {
            let Some(score) = ScoreColumns::of_class(&row.scores, positive) else {
                return Err(refused(format!(
                    "a threshold needs the scores of the positive class, expected a column {name}.p.CLASS in the predictions"
                )));
            };
            row.predicted = match score > threshold {
                true => positive,
                false => negative,
            };
            row.before_debounce = row.predicted;
        }
    }
    if let Some(least) = rule.debounce {
        let rule = EventRule::default().with_debounce(least);
        let rule = rule.map_err(|error| refused(error.to_string()))?;
        events::debounce(rows, positive, negative, rule);
    }
    Ok(())
}

/// Refuses a threshold outside 0 to 1 for scores within 0 to 1. Other scores, such as log-odds, accept any threshold.
fn check_threshold(threshold: f64, rows: &[ClassRow<'_>], positive: u32) -> Result<(), String> {
    let scores = rows.iter();
    let scores = scores.filter_map(|row| ScoreColumns::of_class(&row.scores, positive));
    let scores: Vec<f64> = scores.collect();
    let range = 0.0..=1.0;
    let are_probabilities = !scores.is_empty() && scores.iter().all(|score| range.contains(score));
    match are_probabilities && !range.contains(&threshold) {
        false => Ok(()),
        true => Err(format!(
            "the threshold {threshold} is outside 0 to 1, but all scores of the positive class lie inside: every row would get the same class; state a threshold from 0 to 1"
        )),
    }
}
