//! Columns of poses, as states of a task.

use taceva_core::shown;
use taceva_import::CsvTable;
use taceva_tasks::pose::{EulerErrors, Pose, PoseError, PoseState, PoseTask, Rotation, Thresholds};
use taceva_tasks::{TaskState, WorstSample};

use super::{Clusters, TaskSpec, TaskTables, empty};
use crate::error::EvaluateError;

/// Ends of the names of the columns of a pose: translation in mm, then the quaternion.
const PARTS: [&str; 7] = ["x", "y", "z", "qx", "qy", "qz", "qw"];

/// Positions of the seven columns of a pose.
struct PoseColumns<'a> {
    table: &'a CsvTable,
    columns: [usize; 7],
}

impl<'a> PoseColumns<'a> {
    fn of(table: &'a CsvTable, task: &str) -> Result<PoseColumns<'a>, EvaluateError> {
        let mut columns = [0; 7];
        for (column, part) in columns.iter_mut().zip(PARTS) {
            *column = table.position(&format!("{task}.{part}"))?;
        }
        Ok(PoseColumns { table, columns })
    }

    /// Pose in a row; `None` if all seven cells are empty.
    fn pose(&self, row: usize) -> Result<Option<Pose>, EvaluateError> {
        let mut numbers = [None; 7];
        for (number, column) in numbers.iter_mut().zip(self.columns) {
            *number = self.table.number(row, column)?;
        }
        let [
            Some(x),
            Some(y),
            Some(z),
            Some(qx),
            Some(qy),
            Some(qz),
            Some(qw),
        ] = numbers
        else {
            return match numbers.iter().position(Option::is_none) {
                Some(missing) if numbers.iter().any(Option::is_some) => {
                    let expected = "expected a number, as in the other columns of the pose";
                    Err(self
                        .table
                        .refuse(row, self.columns[missing], expected)
                        .into())
                }
                _ => Ok(None),
            };
        };
        let number = row as u64 + 1;
        Rotation::of_quaternion(number, [qx, qy, qz, qw])
            .and_then(|rotation| Pose::new(number, [x, y, z], rotation))
            .map(Some)
            .map_err(|error| self.refused(&error))
    }

    fn refused(&self, error: &PoseError) -> EvaluateError {
        EvaluateError::Tables {
            path: self.table.path().to_owned(),
            problem: error.to_string(),
        }
    }
}

/// State of a task of poses.
pub(super) fn state(
    tables: &TaskTables,
    clusters: &Clusters<'_>,
    task: &TaskSpec,
) -> Result<TaskState, EvaluateError> {
    let truth = PoseColumns::of(&tables.truth, &task.name)?;
    let prediction = PoseColumns::of(&tables.prediction, &task.name)?;
    let mut state = PoseState::new(definition(task)?);
    let mut euler = EulerErrors::default();
    let mut of_task = empty(task, clusters);
    let mut left_out = 0;
    for pair in &tables.pairs {
        let Some(true_pose) = truth.pose(pair.truth)? else {
            left_out += 1;
            continue;
        };
        let Some(predicted) = prediction.pose(pair.prediction)? else {
            let expected = "expected a pose, because the truth has one";
            let refused = prediction
                .table
                .refuse(pair.prediction, prediction.columns[0], expected);
            return Err(refused.into());
        };
        let cluster = clusters.cell(*pair)?;
        state.push(cluster, &true_pose, &predicted);
        euler.push(&true_pose, &predicted);
        let error = true_pose.distance_mm(&predicted);
        let sample = format!("row {}", pair.truth + 1);
        let worst = WorstSample::new(pair.truth, sample, cluster, error, "mm");
        of_task.evidence.add_worst(worst);
    }
    of_task.unlabelled = left_out;
    of_task.pose = Some(state);
    of_task.euler = Some(euler);
    Ok(of_task)
}

fn definition(task: &TaskSpec) -> Result<PoseTask, EvaluateError> {
    let Some(of) = &task.thresholds else {
        return Ok(PoseTask::default());
    };
    let [translation, rotation] =
        [&of.t, &of.r].map(|texts| texts.iter().map(String::as_str).collect::<Vec<_>>());
    let thresholds = Thresholds::new(&translation, &rotation);
    let thresholds = thresholds.map_err(|error| {
        EvaluateError::Request(format!("task `{}`: {error}", shown(&task.name)))
    })?;
    Ok(PoseTask::default().with_thresholds(thresholds))
}
