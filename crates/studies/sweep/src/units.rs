//! Checks sensor units against limits, and describes each unit in one line.

use std::fs;

use serde::{Deserialize, Serialize};
use taceva_core::shown;
use taceva_report::{Cell, Column, LimitsFile, Study, Table, TaskResult as LabelScores, accept};

use crate::analysis::{Found, Loaded};
use crate::error::SweepError;
use crate::folder::SweepFolder;
use crate::task_list::TaskList;

/// Sensor unit checked against limits.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Unit {
    /// Recording of the unit.
    pub dataset: String,
    /// Serial number of the unit.
    pub serial: String,
    /// Model with its settings, split and seed, as text.
    pub task: String,
    /// True if every limit is met.
    pub is_passed: bool,
    /// Limits that the unit does not meet, with the values found; or the reason why there is no result.
    pub broken: Vec<String>,
}

/// Checks the result of every task against the limits of the sweep. Empty if the sweep has no limits.
pub(crate) fn units(
    folder: &SweepFolder,
    list: &TaskList,
    loaded: &[Loaded<'_>],
) -> Result<Vec<Unit>, SweepError> {
    let Some(path) = &list.limits else {
        return Ok(Vec::new());
    };
    let text = fs::read_to_string(path).map_err(SweepError::io("read", path))?;
    let limits = LimitsFile::read(&text).map_err(|error| SweepError::Kept {
        path: path.clone(),
        problem: error.to_string(),
    })?;
    loaded
        .iter()
        .map(|one| unit(folder, one, &limits))
        .collect()
}

fn unit(folder: &SweepFolder, one: &Loaded<'_>, limits: &LimitsFile) -> Result<Unit, SweepError> {
    let task = one.task;
    let mut unit = Unit {
        dataset: task.dataset.clone(),
        serial: String::new(),
        task: format!(
            "{}, {}, seed {}",
            task.title(),
            match &task.split {
                Some(split) => split.clone(),
                None => format!("split {}", task.division()),
            },
            task.seed
        ),
        is_passed: false,
        broken: Vec::new(),
    };
    match &one.found {
        Found::Missing => unit.broken.push("no result yet".to_owned()),
        Found::Failed(reason) => unit.broken.push(reason.clone()),
        Found::Result(result) => {
            unit.serial.clone_from(&result.serial);
            let path = folder.evaluation(&task.key);
            let text = result.read_evaluation(folder)?;
            let wrong = |problem: String| SweepError::Kept {
                path: path.clone(),
                problem: format!(
                    "{problem}; remove this file and the file of the same name in `results` to run the task again"
                ),
            };
            let studies = match &task.labels {
                Some(labels) => {
                    LabelScores::read(labels.as_str(), &text).map(|scores| vec![scores.study()])
                }
                None => Study::read(&text),
            };
            let studies = studies.map_err(|error| wrong(error.to_string()))?;
            let study = studies
                .first()
                .ok_or_else(|| wrong("no study".to_owned()))?;
            let findings = accept(study, limits).map_err(|error| wrong(error.to_string()))?;
            for finding in findings.iter().filter(|finding| !finding.is_kept) {
                let value = finding
                    .value
                    .map_or_else(|| "no value".to_owned(), |value| format!("{value}"));
                let limit = &finding.limit;
                let why = finding.reason.as_deref().unwrap_or("not met");
                unit.broken.push(format!(
                    "{} {}: {value} {}, {why}",
                    limit.metric, limit.channel, limit.unit
                ));
            }
            unit.is_passed = unit.broken.is_empty();
        }
    }
    Ok(unit)
}

/// Table with one row for each unit.
pub(crate) fn table(units: &[Unit]) -> Table {
    let columns = ["recording", "serial", "model", "verdict", "limits not met"];
    let mut table = Table::new("Units", columns.map(Column::new));
    for unit in units {
        table.push([
            Cell::text(unit.dataset.as_str()),
            Cell::text(unit.serial.as_str()),
            Cell::text(unit.task.as_str()),
            Cell::Verdict(unit.is_passed),
            Cell::text(shown(&unit.broken.join("; ")).to_string()),
        ]);
    }
    let passed = units.iter().filter(|unit| unit.is_passed).count();
    table.note(format!("{passed} of {} meet every limit.", units.len()));
    table
}
