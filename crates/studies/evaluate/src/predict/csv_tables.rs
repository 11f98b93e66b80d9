//! Predictions as CSV tables, in the format that `score` reads.

use std::io::{self, Write};

use taceva_core::Column;
use taceva_results::Samples;

use super::Predicted;
use super::task_cells::TaskCells;
use crate::rows::DISTANCE;

impl Predicted {
    /// Writes the predictions: `sample`, one column for each channel, and `distance` if it is known.
    ///
    /// # Errors
    /// Errors of `out`.
    pub fn write_predictions(&self, out: &mut dyn Write) -> io::Result<()> {
        let task = self.task.as_ref();
        self.write(&self.prediction, task, false, self.distance(), out)
    }

    /// Writes the unclipped predictions, in the format of [`write_predictions`](Predicted::write_predictions). `score` needs them to compute robustness.
    ///
    /// # Errors
    /// Errors of `out`.
    pub fn write_unbounded_predictions(&self, out: &mut dyn Write) -> io::Result<()> {
        let task = self.task.as_ref();
        self.write(&self.unbounded, task, false, self.distance(), out)
    }

    /// Writes the standard deviation of each prediction: `sample` and one column for each channel. Returns false if the model predicts no standard
    /// deviations.
    ///
    /// # Errors
    /// Errors of `out`.
    pub fn write_deviations(&self, out: &mut dyn Write) -> io::Result<bool> {
        match &self.deviation {
            Some(deviation) => self.write(deviation, None, false, None, out).map(|()| true),
            None => Ok(false),
        }
    }

    /// Writes the truth of the same samples. Columns are `sample`, `point_id` or the group in its place, other known fields (`scene`, `repeat`,
    /// `phase` and the like), and one column for each channel.
    ///
    /// # Errors
    /// Errors of `out`.
    pub fn write_truth(&self, out: &mut dyn Write) -> io::Result<()> {
        self.write(&self.truth, self.task.as_ref(), true, None, out)
    }

    fn write(
        &self,
        columns: &[Column],
        task: Option<&TaskCells>,
        is_truth: bool,
        distance: Option<&[f64]>,
        out: &mut dyn Write,
    ) -> io::Result<()> {
        let points = self.points.as_ref().filter(|_| is_truth);
        let beside = if is_truth { &self.beside[..] } else { &[] };
        let mut writer = csv::Writer::from_writer(out);
        let mut head = vec![Samples::KEY];
        head.extend(points.map(|_| "point_id"));
        head.extend(beside.iter().map(|(name, _)| *name));
        let labels = match task {
            Some(task) => task.label_columns(),
            None => self
                .channels
                .iter()
                .map(|own| own.name().to_owned())
                .collect(),
        };
        head.extend(labels.iter().map(String::as_str));
        // Columns of the channels of a task, in the order of its labels.
        let order = task.map_or_else(Vec::new, TaskCells::channels);
        let order = order.iter().filter_map(|name| self.channels.position(name));
        let order: Vec<usize> = order.collect();
        let scored = task.filter(|_| !is_truth);
        let scores = scored.map_or_else(Vec::new, TaskCells::score_columns);
        head.extend(scores.iter().map(String::as_str));
        let clusters = task.filter(|_| is_truth);
        let clusters = clusters.filter(|task| task.cluster_column(&head).is_some());
        head.extend(clusters.and_then(|task| task.cluster_column(&[])));
        head.extend(distance.map(|_| DISTANCE));
        writer.write_record(head)?;
        for row in 0..self.rows() {
            let mut cells = vec![self.ids[row].clone()];
            cells.extend(points.map(|points| points[row].clone()));
            let texts = beside.iter().map(|(_, texts)| texts[row].clone());
            cells.extend(texts.map(Option::unwrap_or_default));
            let values = columns.iter().map(|column| column.get(row));
            let text =
                |value: Option<f64>| value.map_or_else(String::new, |value| format!("{value:?}"));
            match task {
                None => cells.extend(values.map(text)),
                Some(task) => {
                    let values = order.iter().map(|&channel| columns[channel].get(row));
                    cells.extend(task.label_cells(&values.collect::<Vec<_>>()));
                }
            }
            let scores = scored.into_iter().flat_map(|task| task.scores(row));
            cells.extend(scores.map(|score| format!("{score:?}")));
            cells.extend(clusters.map(|task| task.cluster(row)));
            cells.extend(distance.map(|distance| format!("{:?}", distance[row])));
            writer.write_record(cells)?;
        }
        writer.flush()
    }
}
