//! Columns of places, as states of a task.

use taceva_import::CsvTable;
use taceva_tasks::pose::{Pose, PoseState, PoseTask, Rotation};
use taceva_tasks::{TaskState, WorstSample};

use super::{Clusters, TaskSpec, TaskTables, empty};
use crate::error::EvaluateError;

/// Positions of the three columns of a place in mm.
struct PlaceColumns<'a> {
    table: &'a CsvTable,
    columns: [usize; 3],
}

impl<'a> PlaceColumns<'a> {
    fn of(table: &'a CsvTable, task: &str) -> Result<PlaceColumns<'a>, EvaluateError> {
        let mut columns = [0; 3];
        for (column, part) in columns.iter_mut().zip(["x", "y", "z"]) {
            *column = table.position(&format!("{task}.{part}"))?;
        }
        Ok(PlaceColumns { table, columns })
    }

    /// Place in a row, as a pose without rotation; `None` if all three cells are empty.
    fn pose(&self, row: usize) -> Result<Option<Pose>, EvaluateError> {
        let mut numbers = [None; 3];
        for (number, column) in numbers.iter_mut().zip(self.columns) {
            *number = self.table.number(row, column)?;
        }
        let [Some(x), Some(y), Some(z)] = numbers else {
            return match numbers.iter().position(Option::is_none) {
                Some(missing) if numbers.iter().any(Option::is_some) => {
                    let expected = "expected a number, as in the other columns of the place";
                    let column = self.columns[missing];
                    Err(self.table.refuse(row, column, expected).into())
                }
                _ => Ok(None),
            };
        };
        let number = row as u64 + 1;
        Rotation::of_quaternion(number, [0.0, 0.0, 0.0, 1.0])
            .and_then(|still| Pose::new(number, [x, y, z], still))
            .map(Some)
            .map_err(|error| EvaluateError::Tables {
                path: self.table.path().to_owned(),
                problem: error.to_string(),
            })
    }
}

/// State of a task of places: poses without rotation. A prediction at the origin is the constant.
pub(super) fn state(
    tables: &TaskTables,
    clusters: &Clusters<'_>,
    task: &TaskSpec,
) -> Result<TaskState, EvaluateError> {
    let truth = PlaceColumns::of(&tables.truth, &task.name)?;
    let prediction = PlaceColumns::of(&tables.prediction, &task.name)?;
    let mut state = PoseState::new(PoseTask::default());
    let mut of_task = empty(task, clusters);
    let mut left_out = 0;
    for pair in &tables.pairs {
        let Some(true_place) = truth.pose(pair.truth)? else {
            left_out += 1;
            continue;
        };
        let Some(predicted) = prediction.pose(pair.prediction)? else {
            let expected = "expected a place, because the truth has one";
            let column = prediction.columns[0];
            let refused = prediction.table.refuse(pair.prediction, column, expected);
            return Err(refused.into());
        };
        let cluster = clusters.cell(*pair)?;
        state.push(cluster, &true_place, &predicted);
        let error = true_place.distance_mm(&predicted);
        let sample = format!("row {}", pair.truth + 1);
        let worst = WorstSample::new(pair.truth, sample, cluster, error, "mm");
        of_task.evidence.add_worst(worst);
    }
    of_task.unlabelled = left_out;
    of_task.pose = Some(state);
    Ok(of_task)
}
