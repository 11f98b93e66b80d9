//! Scores tasks of poses and places from their columns.

use taceva_core::SourceUnit;
use taceva_dataset::TaskKind;
use taceva_import::CsvTable;
use taceva_tasks::pose::{EulerErrors, Pose, PoseError, PoseState, Rotation};
use taceva_tasks::{TaskState, WorstSample};

use super::likely_scale::{LikelyScale, VectorPair};
use super::{Clusters, TaskSpec, TaskTables, empty, is_not_finite};
use crate::error::EvaluateError;
use crate::pose_definition::pose_definition;

/// Suffixes of the columns of a pose: translation in mm, then the quaternion.
const PARTS: [&str; 7] = ["x", "y", "z", "qx", "qy", "qz", "qw"];

/// Columns of poses, or of places, which are poses without rotation.
struct PoseColumns<'a> {
    table: &'a CsvTable,
    /// Positions of the columns of translation, and of the quaternion of a pose.
    columns: Vec<usize>,
    /// Unit of the translation; `None` for mm.
    unit: Option<SourceUnit>,
    /// Noun for messages.
    noun: &'static str,
}

impl<'a> PoseColumns<'a> {
    fn of(table: &'a CsvTable, task: &TaskSpec) -> Result<PoseColumns<'a>, EvaluateError> {
        let (parts, noun) = match task.kind {
            TaskKind::Place => (&PARTS[..3], "place"),
            _ => (&PARTS[..], "pose"),
        };
        let columns = parts.iter();
        let columns = columns.map(|part| table.position(&format!("{}.{part}", task.name)));
        Ok(PoseColumns {
            table,
            columns: columns.collect::<Result<_, _>>()?,
            unit: None,
            noun,
        })
    }

    /// True if a number in a row is NaN or infinite.
    fn has_invalid(&self, row: usize) -> bool {
        let mut columns = self.columns.iter();
        columns.any(|column| is_not_finite(self.table.cell(row, *column)))
    }

    /// Pose in a row; `None` if all its cells are empty.
    fn pose(&self, row: usize) -> Result<Option<Pose>, EvaluateError> {
        let cells = self.columns.iter().zip(PARTS);
        let cells = cells.map(|(column, part)| match &self.unit {
            Some(unit) if !part.starts_with('q') => self.table.number_in_unit(row, *column, unit),
            _ => self.table.number(row, *column),
        });
        let cells: Vec<Option<f64>> = cells.collect::<Result<_, _>>()?;
        let numbers: Vec<f64> = cells.iter().copied().flatten().collect();
        let (translation, quaternion) = match numbers[..] {
            [x, y, z] if cells.len() == 3 => ([x, y, z], [0.0, 0.0, 0.0, 1.0]),
            [x, y, z, qx, qy, qz, qw] => ([x, y, z], [qx, qy, qz, qw]),
            _ => {
                let missing = cells.iter().position(Option::is_none);
                return match missing.filter(|_| !numbers.is_empty()) {
                    Some(missing) => {
                        let expected = format!(
                            "expected a number, as in the other columns of the {}",
                            self.noun
                        );
                        let column = self.columns[missing];
                        Err(self.table.refuse(row, column, &expected).into())
                    }
                    None => Ok(None),
                };
            }
        };
        let number = row as u64 + 1;
        Rotation::of_quaternion(number, quaternion)
            .and_then(|rotation| Pose::new(number, translation, rotation))
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

/// Sums for the scores of a task of poses or places. The constant prediction is the origin.
pub(super) fn state(
    tables: &TaskTables,
    clusters: &Clusters<'_>,
    task: &TaskSpec,
) -> Result<TaskState, EvaluateError> {
    let truth = PoseColumns::of(&tables.truth, task)?;
    let prediction = PoseColumns {
        unit: match &task.unit {
            Some(_) => Some(task.length_unit()?),
            None => None,
        },
        ..PoseColumns::of(&tables.prediction, task)?
    };
    let mut state = PoseState::new(pose_definition(&task.name, task.thresholds.as_ref())?);
    let mut euler = (task.kind != TaskKind::Place).then(EulerErrors::default);
    let mut of_task = empty(task, clusters);
    let mut left_out = 0;
    let mut vectors = Vec::with_capacity(tables.pairs.len());
    for pair in &tables.pairs {
        let is_own = clusters.has(*pair);
        if tables.allow_invalid
            && (truth.has_invalid(pair.truth) || prediction.has_invalid(pair.prediction))
        {
            of_task.invalid += u64::from(is_own);
            continue;
        }
        let Some(true_pose) = truth.pose(pair.truth)? else {
            left_out += u64::from(is_own);
            continue;
        };
        let Some(predicted) = prediction.pose(pair.prediction)? else {
            let expected = format!("expected a {}, because the truth has one", prediction.noun);
            let column = prediction.columns[0];
            let refused = prediction.table.refuse(pair.prediction, column, &expected);
            return Err(refused.into());
        };
        let cluster = clusters.cell(*pair)?;
        vectors.push(VectorPair::of_poses(&true_pose, &predicted));
        if !is_own {
            continue;
        }
        state.push(cluster, &true_pose, &predicted);
        if let Some(euler) = &mut euler {
            euler.push(&true_pose, &predicted);
        }
        let error = true_pose.distance_mm(&predicted);
        let sample = format!("row {}", pair.truth + 1);
        let worst = WorstSample::new(pair.truth, sample, cluster, error, "mm");
        of_task.evidence.add_worst(worst);
    }
    of_task.unlabelled = left_out;
    let scale = LikelyScale::of(&vectors);
    of_task.notes.extend(scale.map(|scale| scale.remark(task)));
    of_task.pose = Some(state);
    of_task.euler = euler;
    Ok(of_task)
}
