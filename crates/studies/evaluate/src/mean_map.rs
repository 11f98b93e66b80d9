//! Mean depth map of the training part, which is the constant that a model should beat.

use taceva_core::shown;
use taceva_dataset::{Dataset, Table};
use taceva_models::Part;
use taceva_tasks::depth::DepthMap;

use crate::error::EvaluateError;

/// Rows whose declared part is `part`.
pub(crate) fn rows_of(table: &Table, part: Part) -> Vec<usize> {
    let parts = table.part().iter().enumerate();
    let own = parts.filter(|(_, own)| own.as_deref().and_then(Part::from_name) == Some(part));
    own.map(|(row, _)| row).collect()
}

/// Mean of the valid depths of each pixel over the maps of `rows`; `None` if no row has a map. A pixel that is valid in no map is invalid.
pub(crate) fn mean_map(
    dataset: &Dataset,
    task: &str,
    rows: &[usize],
) -> Result<Option<DepthMap>, EvaluateError> {
    let refused =
        |problem: String| EvaluateError::Request(format!("task `{}`: {problem}", shown(task)));
    let mut size = [0; 2];
    let (mut sums, mut counts) = (Vec::<f64>::new(), Vec::<u32>::new());
    for row in rows {
        let Some(map) = dataset.depth_map(task, *row)? else {
            continue;
        };
        if sums.is_empty() {
            size = [map.rows, map.columns];
            sums = vec![0.0; map.mm.len()];
            counts = vec![0_u32; map.mm.len()];
        }
        if size != [map.rows, map.columns] {
            let [rows, columns] = size;
            return Err(refused(format!(
                "maps of {rows} x {columns} and {} x {} pixels have no mean: score recordings with maps of one size",
                map.rows, map.columns
            )));
        }
        let pixels = sums.iter_mut().zip(&mut counts).zip(&map.mm);
        for ((sum, count), depth) in pixels.filter(|(_, depth)| !depth.is_nan()) {
            *sum += depth;
            *count += 1;
        }
    }
    if sums.is_empty() {
        return Ok(None);
    }
    let means = sums.iter().zip(&counts).map(|(sum, count)| match count {
        0 => f64::NAN,
        count => sum / f64::from(*count),
    });
    let mean = DepthMap::new(size[0], size[1], means.collect());
    mean.map(Some).map_err(|error| refused(error.to_string()))
}
