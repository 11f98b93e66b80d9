//! Windows, the sequences of frames that a model reads for one sample, within the clusters of a task.

use std::collections::{BTreeMap, BTreeSet};

use taceva_core::{Features, shown};
use taceva_dataset::{Dataset, Task, TaskKind};
use taceva_models::{Extractor, FeatureSpec, FrameWindow};

use super::extract;
use crate::error::EvaluateError;
use crate::rows::{Need, usable};
use crate::work::Work;

/// Place of a row in the sequence of its cluster.
#[derive(Clone, Copy)]
struct Place {
    cluster: usize,
    place: usize,
}

/// Rows with an input, cluster by cluster. A cluster is in the order of time if all of its rows have times, otherwise in the order of the recording.
struct Sequences {
    clusters: Vec<Vec<usize>>,
    /// Place of each row of the dataset; `None` for a row without an input or without a cluster.
    places: Vec<Option<Place>>,
    /// Column of the clusters.
    column: String,
}

impl Sequences {
    fn of(dataset: &Dataset, column: &str, reads_frames: bool) -> Sequences {
        let table = dataset.table();
        let names = dataset.clusters_of(&Task::new("", TaskKind::Class, column));
        let need = Need {
            frame: reads_frames,
            labels: None,
        };
        let mut clusters: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
        for row in usable(dataset, &dataset.all_rows(), need) {
            if let Some(cluster) = names[row].as_deref() {
                clusters.entry(cluster).or_default().push(row);
            }
        }
        let time = |row: usize| table.t_s()[row];
        let mut clusters: Vec<Vec<usize>> = clusters.into_values().collect();
        for rows in &mut clusters {
            if rows.iter().all(|&row| time(row).is_some()) {
                let key = |row: usize| time(row).unwrap_or_default();
                rows.sort_by(|&one, &other| key(one).total_cmp(&key(other)));
            }
        }
        let mut places = vec![None; table.rows()];
        for (cluster, rows) in clusters.iter().enumerate() {
            for (place, &row) in rows.iter().enumerate() {
                places[row] = Some(Place { cluster, place });
            }
        }
        Sequences {
            clusters,
            places,
            column: column.to_owned(),
        }
    }

    /// Rows of the frames that the sample in `row` reads, the newest first.
    fn window(&self, row: usize, window: FrameWindow) -> Result<Vec<usize>, EvaluateError> {
        let Some(Place { cluster, place }) = self.places[row] else {
            return Err(EvaluateError::Request(format!(
                "row {row} has no value in the cluster column `{}`, whose frames form windows: fill the column in, or leave --window out",
                shown(&self.column)
            )));
        };
        let rows = &self.clusters[cluster];
        Ok(window.places(place).map(|place| rows[place]).collect())
    }

    /// Rows of all frames that the samples in `rows` read, ascending.
    fn read(&self, rows: &[usize], window: FrameWindow) -> Result<Vec<usize>, EvaluateError> {
        let mut read = BTreeSet::new();
        for &row in rows {
            read.extend(self.window(row, window)?);
        }
        Ok(read.into_iter().collect())
    }
}

/// Name of the column with the clusters; windows do not cross clusters.
fn required(window: FrameWindow, column: Option<&str>) -> Result<&str, EvaluateError> {
    column.ok_or_else(|| {
        EvaluateError::Request(format!(
            "window={}: a window needs the clusters of a task; name the task by --task",
            window.frames()
        ))
    })
}

/// Rows whose inputs `spec` reads for the samples in `rows`: these rows, or all rows of their windows of frames in the clusters of `column`.
///
/// # Errors
/// [`EvaluateError::Request`] for windows without `column`, or for a row without a cluster.
pub(crate) fn rows_read(
    dataset: &Dataset,
    spec: &FeatureSpec,
    column: Option<&str>,
    rows: &[usize],
) -> Result<Vec<usize>, EvaluateError> {
    let Some(window) = spec.window else {
        return Ok(rows.to_vec());
    };
    let column = required(window, column)?;
    Sequences::of(dataset, column, spec.channels.is_none()).read(rows, window)
}

/// Features of `rows` by `spec`, computed by [`extract`]. Each row has the features of its frame, or of its window of frames in the clusters of
/// `column`.
///
/// # Errors
/// Errors of [`extract`] and of [`rows_read`].
pub(crate) fn extract_as(
    dataset: &Dataset,
    spec: &FeatureSpec,
    column: Option<&str>,
    extractor: impl Fn(&Dataset) -> Result<Extractor, EvaluateError>,
    rows: &[usize],
    work: Work<'_>,
) -> Result<Features, EvaluateError> {
    let Some(window) = spec.window else {
        return extract(dataset, extractor, rows, work);
    };
    let column = required(window, column)?;
    let sequences = Sequences::of(dataset, column, spec.channels.is_none());
    let read = sequences.read(rows, window)?;
    let frames = extract(dataset, extractor, &read, work)?;
    let frame = |row: usize| {
        let at = read.binary_search(&row);
        frames.sample(at.expect("the frames of all windows were read"))
    };
    let depth = spec.frame_shape().depth;
    let mut values = Vec::with_capacity(rows.len() * spec.shape().len());
    for &row in rows {
        let of_window = sequences.window(row, window)?;
        let of_window: Vec<&[f32]> = of_window.into_iter().map(frame).collect();
        window.join(&of_window, depth, &mut values);
    }
    Ok(Features::new(spec.shape(), values)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_window_stays_in_its_cluster_and_repeats_the_first_frame() {
        let at = |cluster, place| Some(Place { cluster, place });
        // Rows of two clusters in turn, and a row without a cluster.
        let sequences = Sequences {
            clusters: vec![vec![0, 2], vec![1, 3]],
            places: vec![at(0, 0), at(1, 0), at(0, 1), at(1, 1), None],
            column: "stroke".to_owned(),
        };
        let window = FrameWindow::new(3, 1).expect("several frames");
        assert_eq!(sequences.window(3, window).expect("known"), [3, 1, 1]);
        assert_eq!(
            sequences.read(&[2, 3], window).expect("known"),
            [0, 1, 2, 3]
        );
        let error = sequences.window(4, window).expect_err("no cluster");
        assert!(error.to_string().contains("`stroke`"), "{error}");
    }
}
