//! Calibration of a model's predicted standard deviations.

use std::num::NonZeroUsize;

use taceva_core::{Column, Field, FieldSet};
use taceva_dataset::Dataset;
use taceva_metrics::{MetricPlan, catalogue};
use taceva_models::NORMAL_95;

use crate::accumulate::{Columns, accumulate};
use crate::error::EvaluateError;
use crate::note::{Coverage, Note};
use crate::predict::Predicted;

/// Share of predictions within 1.96 predicted standard deviations of the truth, for each channel, with an interval by contact point. `predicted`
/// holds the predictions of the rows `rows` of `dataset`. `None` if the model predicts no standard deviation.
///
/// Only rows for which `counts` is true are counted: presses in the light of the training data, because the standard deviations are valid only in
/// this light.
pub fn calibration(
    dataset: &Dataset,
    predicted: &Predicted,
    rows: &[usize],
    counts: impl Fn(usize) -> bool,
    jobs: NonZeroUsize,
) -> Result<Option<Note>, EvaluateError> {
    let Some(deviations) = predicted.deviation() else {
        return Ok(None);
    };
    let mut hits = Vec::new();
    let mut zeros = Vec::new();
    for (channel, deviations) in deviations.iter().enumerate() {
        let (truth, found) = (
            &predicted.truth()[channel],
            &predicted.prediction()[channel],
        );
        let known = &predicted.channels().as_slice()[channel];
        let (mut own, mut zero) = (Column::default(), Column::default());
        for (at, row) in rows.iter().enumerate() {
            let pair = truth.get(at).zip(found.get(at));
            let inside = pair.filter(|_| counts(*row)).zip(deviations.get(at)).map(
                |((truth, found), deviation)| {
                    let found = known.nearest(found, truth);
                    f64::from((found - truth).abs() <= NORMAL_95 * deviation)
                },
            );
            own.push(inside);
            zero.push(inside.map(|_| 0.0));
        }
        hits.push(own);
        zeros.push(zero);
    }
    // A hit is 1 and a miss 0. The share of hits is therefore a mean, with the interval of a mean.
    let share = catalogue::find("mae").expect("`mae` is in the catalogue");
    let available: FieldSet = dataset.table().fields().with(Field::Prediction);
    let plan = MetricPlan::new(&[share], predicted.channels().clone(), available);
    let columns = Columns {
        groups: None,
        truth: &zeros,
        prediction: &hits,
        dataset,
        rows,
    };
    let evaluation = accumulate(&columns, &plan, jobs)?.finish()?;
    let percent = |value: f64| 100.0 * value.clamp(0.0, 1.0);
    let coverage = |channel: &str| {
        let score = evaluation.score(share.id, channel)?;
        Some(Coverage {
            channel: channel.to_owned(),
            percent: percent(score.value.scalar()?),
            interval: score.interval.ends().map(|ends| ends.map(percent)),
            n: score.n,
        })
    };
    let channels = predicted.channels().iter();
    let channels: Vec<Coverage> = channels
        .filter_map(|channel| coverage(channel.name()))
        .collect();
    Ok((!channels.is_empty()).then_some(Note::Calibration(channels)))
}
