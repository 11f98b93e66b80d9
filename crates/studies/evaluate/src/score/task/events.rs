//! Onsets of events, and the debounce of classes.

use std::collections::BTreeMap;

use taceva_core::shown;
use taceva_import::CsvTable;
use taceva_tasks::TaskState;
use taceva_tasks::events::{EventError, EventRule, EventState, Frame};

use super::classes::ClassRow;
use super::score_columns::ScoreColumns;
use super::{TaskRule, TaskTables};
use crate::error::EvaluateError;

/// Column with the time of a sample, s.
const TIME: &str = "t_s";

/// Applies the debounce of `rule` to the predicted classes of each cluster, in the order of rows.
pub(super) fn debounce(rows: &mut [ClassRow<'_>], positive: u32, negative: u32, rule: EventRule) {
    for numbers in by_cluster(rows).into_values() {
        let scores: Vec<f64> = numbers
            .iter()
            .map(|number| f64::from(u8::from(rows[*number].predicted == positive)))
            .collect();
        for (number, label) in numbers.into_iter().zip(rule.labels(&scores)) {
            rows[number].predicted = if label { positive } else { negative };
        }
    }
}

/// Rule that detects onsets, with the threshold and the debounce of the task's rule.
pub(super) fn event_rule(rule: Option<&TaskRule>) -> Result<EventRule, EventError> {
    let rule = rule.copied().unwrap_or_default();
    let mut found = EventRule::default();
    if let Some(threshold) = rule.threshold {
        found = found.with_threshold(threshold)?;
    }
    if let Some(debounce) = rule.debounce {
        found = found.with_debounce(debounce)?;
    }
    Ok(found)
}

/// Adds the sums of onsets to `of_task`, or a remark if the truth has no times.
pub(super) fn add(
    of_task: &mut TaskState,
    tables: &TaskTables,
    rows: &[ClassRow<'_>],
    positive: u32,
    rule: Option<&TaskRule>,
) -> Result<(), EvaluateError> {
    let truth = &tables.truth;
    if !truth.has(TIME) {
        of_task.notes.push(format!(
            "onsets, delays and false alarms are skipped: the truth has no column `{TIME}` with the time in s"
        ));
        return Ok(());
    }
    let refused = |error: EventError| EvaluateError::Tables {
        path: truth.path().to_owned(),
        problem: error.to_string(),
    };
    let time = truth.position(TIME)?;
    let has_threshold = rule.is_some_and(|rule| rule.threshold.is_some());
    let mut state = EventState::new(event_rule(rule).map_err(refused)?);
    for (cluster, numbers) in by_cluster(rows) {
        let mut frames = Vec::with_capacity(numbers.len());
        for row in numbers.into_iter().map(|number| &rows[number]) {
            let score = match has_threshold {
                true => ScoreColumns::of_class(&row.scores, positive),
                false => None,
            };
            // The rule of onsets contains the debounce, so it is not applied here.
            let score = score.unwrap_or(f64::from(u8::from(row.before_debounce == positive)));
            let number = row.pair.truth as u64 + 1;
            let time_s = stated_time(truth, row.pair.truth, time)?;
            frames.push(Frame::new(
                number,
                Some(time_s),
                row.truth == positive,
                score,
            ));
        }
        state
            .push(cluster, &frames)
            .map_err(|error| of_sequence(truth, cluster, &error))?;
    }
    of_task.events = Some(state);
    of_task.is_sequence = true;
    Ok(())
}

/// Error for the sequence of `cluster`.
fn of_sequence(table: &CsvTable, cluster: &str, error: &EventError) -> EvaluateError {
    let advice = match error {
        EventError::TimeGoesBack { .. } => {
            ", or name the column that tells sequences apart with --cluster COLUMN"
        }
        _ => "",
    };
    EvaluateError::Tables {
        path: table.path().to_owned(),
        problem: format!("cluster `{}`: {error}{advice}", shown(cluster)),
    }
}

fn stated_time(table: &CsvTable, row: usize, column: usize) -> Result<f64, EvaluateError> {
    table.number(row, column)?.ok_or_else(|| {
        let expected = "expected the time of the sample in s";
        table.refuse(row, column, expected).into()
    })
}

/// Positions of the rows of each cluster, in their order.
fn by_cluster<'a>(rows: &[ClassRow<'a>]) -> BTreeMap<&'a str, Vec<usize>> {
    let mut clusters: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    for (number, row) in rows.iter().enumerate() {
        clusters.entry(row.cluster).or_default().push(number);
    }
    clusters
}
