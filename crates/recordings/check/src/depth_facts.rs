//! Statistics of the depth maps of every task.

use taceva_core::Progress;
use taceva_dataset::{Dataset, DatasetError, TaskLabel};

/// Statistics of the depth maps of one task.
///
/// This type gets no further field without a check that reads it.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct DepthFacts {
    /// Name of the task.
    pub task: String,
    /// Problem with the unit of the depths, in words; `None` if the unit is a length.
    pub unit_problem: Option<String>,
    /// Statistics of each map, by row; empty if the unit is not a length.
    pub maps: Vec<OneMap>,
}

/// Statistics of the depth map of one row.
///
/// # Units
/// `greatest` in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct OneMap {
    /// Row of the table.
    pub row: usize,
    /// Number of rows and of columns of pixels.
    pub size: [usize; 2],
    /// Number of valid pixels.
    pub valid: usize,
    /// Greatest absolute depth of the valid pixels.
    pub greatest: f64,
}

impl DepthFacts {
    /// Statistics for each task with depth maps. Reads every map whose task states a unit of length.
    ///
    /// # Errors
    /// [`DatasetError`] if a map is damaged or the run is cancelled.
    pub fn of_tasks(
        dataset: &Dataset,
        progress: &dyn Progress,
    ) -> Result<Vec<DepthFacts>, DatasetError> {
        let mut found = Vec::new();
        for own in dataset.tasks() {
            let task = own.task();
            let rows = 0..dataset.table().rows();
            let rows = rows.filter(|row| matches!(own.label(*row), Some(TaskLabel::Map(_))));
            let rows: Vec<usize> = rows.collect();
            if rows.is_empty() {
                continue;
            }
            let unit_problem = match &task.maps {
                Some(facts) => facts.mm(0.0).err(),
                None => Some("no unit is stated".to_owned()),
            };
            let mut maps = Vec::new();
            // Without a unit, no map has depths.
            for row in rows.into_iter().filter(|_| unit_problem.is_none()) {
                if progress.is_cancelled() {
                    return Err(DatasetError::Cancelled);
                }
                maps.extend(one_map(dataset, &task.name, row)?);
            }
            found.push(DepthFacts {
                task: task.name.clone(),
                unit_problem,
                maps,
            });
        }
        Ok(found)
    }
}

fn one_map(dataset: &Dataset, task: &str, row: usize) -> Result<Option<OneMap>, DatasetError> {
    let map = dataset.depth_map(task, row)?;
    Ok(map.map(|map| {
        let depths = map.mm.iter().filter(|depth| !depth.is_nan());
        OneMap {
            row,
            size: [map.rows, map.columns],
            valid: map.valid(),
            greatest: depths.fold(0.0, |greatest, depth| depth.abs().max(greatest)),
        }
    }))
}
