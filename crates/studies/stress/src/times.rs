//! Metrics of the times of selected rows of a recording, such as the frame rate.

use std::num::NonZeroUsize;

use taceva_core::{Channel, Channels, Column};
use taceva_dataset::Dataset;
use taceva_evaluate::{Columns, EvaluateError, OF_SENSOR, accumulate};
use taceva_metrics::{MetricPlan, catalogue};

use crate::report::{ByChannel, TimeScore};

/// Names of the metrics of times that need no prediction.
const METRICS: [&str; 3] = ["frame_rate", "jitter", "dropped"];

/// Computes the metrics of the times of `rows`; empty if they have no times.
pub(crate) fn time_scores(
    dataset: &Dataset,
    rows: &[usize],
) -> Result<ByChannel<TimeScore>, EvaluateError> {
    // A batch needs a channel, although times do not.
    let channels = Channels::new([Channel::FZ]).expect("one channel");
    let plan = MetricPlan::new(&catalogue::select([OF_SENSOR])?, channels, dataset.fields());
    let unknown: [Column; 1] = [rows.iter().map(|_| None).collect()];
    let source = Columns {
        truth: &unknown,
        prediction: &unknown,
        dataset,
        rows,
        groups: None,
    };
    let evaluation = accumulate(&source, &plan, NonZeroUsize::MIN)?.finish()?;
    let scores = evaluation.scores();
    let scores = scores.filter(|(_, name, _)| METRICS.contains(name));
    let scores = scores.map(|(_, name, score)| {
        let score = TimeScore {
            value: score.value.scalar(),
            unit: score.unit.symbol(),
        };
        (name.to_owned(), score)
    });
    Ok(scores.collect())
}

/// True if the rows of `dataset` were recorded continuously, so that a frame rate is defined.
pub(crate) fn is_stream(dataset: &Dataset) -> Result<bool, EvaluateError> {
    let scores = time_scores(dataset, &dataset.all_rows())?;
    Ok(scores.get(METRICS[0]).is_some_and(|of| of.value.is_some()))
}
