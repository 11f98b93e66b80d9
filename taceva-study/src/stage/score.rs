//! Scores: each metric on the presses and the channels that the plan means for it.

use std::collections::BTreeMap;
use std::num::NonZeroUsize;
use std::ops::Range;

use taceva_core::{Batch, Channel, Channels, Column, Field, FieldSet, SkipReason, Skipped};
use taceva_dataset::Dataset;
use taceva_metrics::{Evaluation, Metric, MetricPlan};
use taceva_protocol::{PhaseKind, PlanReason, Subject};

use super::deal::{Deal, reads_prediction};
use super::gratings::ToldSpacings;
use crate::error::StudyError;
use crate::predict::{Predicted, truth};
use crate::scene::{PlannedScene, PlannedStudy};
use crate::tally::{Columns, Rows, tally};

/// What is scored.
pub(super) struct Scores<'a> {
    pub(super) scene: &'a PlannedScene,
    pub(super) study: &'a PlannedStudy,
    pub(super) dataset: &'a Dataset,
    pub(super) deal: &'a Deal<'a>,
    /// What was predicted, and which rows of the dataset that is; ascending.
    pub(super) predicted: Option<&'a (Predicted, Vec<usize>)>,
    /// Which spacings the presses of gratings were taken for.
    pub(super) told: Option<&'a ToldSpacings>,
    pub(super) jobs: NonZeroUsize,
}

/// Metrics that are computed on the same rows and channels.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct Ground {
    phase: PhaseKind,
    channels: Vec<String>,
    of_predictions: bool,
    /// Whether times count in the phase alone and everything else wherever it was recorded.
    of_sensor: bool,
}

/// The metric that says how fast a sensor looks and how far: pictures come as fast as they can at rest, where nothing is touched, so that
/// its places of contact are those of every other part of the protocol.
const OF_SENSOR: &str = "intrinsic";

/// The scores, and what a reader must know of what was left out beyond what a skip can say.
pub(super) fn score(scores: &Scores<'_>) -> Result<(Evaluation, Vec<String>), StudyError> {
    let mut grounds: BTreeMap<Ground, Vec<&'static Metric>> = BTreeMap::new();
    for (planned, metric) in scores.deal.metrics() {
        let ground = Ground {
            phase: planned.phase,
            channels: planned.channels.clone(),
            of_predictions: reads_prediction(metric),
            of_sensor: metric.id == OF_SENSOR,
        };
        grounds.entry(ground).or_default().push(metric);
    }
    let (mut skipped, notes) = left_out(scores.study);
    let mut parts = Vec::new();
    for (ground, metrics) in &grounds {
        let part = scores.on(ground, metrics)?;
        skipped.extend(part.skipped().iter().cloned());
        parts.push(part);
    }
    Ok((Evaluation::joined(parts, skipped), notes))
}

impl Scores<'_> {
    fn on(&self, ground: &Ground, metrics: &[&'static Metric]) -> Result<Evaluation, StudyError> {
        let channels = self.channels(ground)?;
        let (rows, prediction) = self.rows(ground, &channels);
        let truth: Vec<Column> = channels
            .iter()
            .map(|channel| truth(self.dataset, channel, &rows))
            .collect::<Result<_, _>>()?;
        let table = self.dataset.table();
        let made = [
            self.predicted.map(|_| Field::Prediction),
            self.told.map(|_| Field::PredictedSpacing),
        ];
        let made: FieldSet = made.into_iter().flatten().collect();
        let settings = self.scene.scene.metrics.settings.settings();
        let plan = MetricPlan::new(metrics, channels, table.fields() | made)
            .with_facts(self.study.plan.sensor_facts())
            .with_seed(self.scene.scene.seed)
            .with_settings(settings)?;
        let columns = Columns {
            truth: &truth,
            prediction: &prediction,
            table,
            rows: &rows,
        };
        let told = self.told.filter(|told| told.rows == rows);
        let samples = Samples {
            columns,
            timed: ground.of_sensor.then(|| self.deal.rows(ground.phase)),
            spacings: told.map(|told| &told.spacings),
        };
        Ok(tally(&samples, &plan, self.jobs)?.finish()?)
    }

    /// The channels of the recording that the metrics of `ground` look at.
    fn channels(&self, ground: &Ground) -> Result<Channels, StudyError> {
        let known = self.dataset.table().channels();
        let chosen = ground
            .channels
            .iter()
            .filter_map(|name| known.by_name(name));
        let chosen: Vec<Channel> = chosen.cloned().collect();
        Channels::new(chosen).map_err(|error| StudyError::Request(error.to_string()))
    }

    /// The rows of `ground` and what is predicted of them; where a metric reads predictions, rows without one take no part.
    fn rows(&self, ground: &Ground, channels: &Channels) -> (Vec<usize>, Vec<Column>) {
        let rows = match ground.of_sensor {
            true => self.dataset.all_rows(),
            false => self.deal.rows(ground.phase),
        };
        let (true, Some((predicted, of_rows))) = (ground.of_predictions, self.predicted) else {
            let mut nothing = Column::default();
            rows.iter().for_each(|_| nothing.push(None));
            return (rows, vec![nothing; channels.len()]);
        };
        let found = rows
            .into_iter()
            .filter_map(|row| Some((row, of_rows.binary_search(&row).ok()?)));
        let (rows, positions): (Vec<usize>, Vec<usize>) = found.unzip();
        let column = |channel: &Channel| {
            let at = predicted.channels().position(channel.name());
            let mut column = Column::default();
            for &position in &positions {
                column.push(at.and_then(|at| predicted.prediction()[at].get(position)));
            }
            column
        };
        let prediction = channels.iter().map(column).collect();
        (rows, prediction)
    }
}

/// Rows with the spacings that were told of them, if any were.
struct Samples<'a> {
    columns: Columns<'a>,
    /// The rows whose times count, ascending; those of all rows if absent.
    timed: Option<Vec<usize>>,
    spacings: Option<&'a Column>,
}

impl Rows for Samples<'_> {
    fn rows(&self) -> usize {
        self.columns.rows()
    }

    fn batch(&self, plan: &MetricPlan, rows: Range<usize>) -> Result<Batch, StudyError> {
        let mut batch = self.columns.batch(plan, rows.clone())?;
        if let (Some(timed), Some(times)) = (&self.timed, batch.numbers(Field::Stamp)) {
            let mut counted = Column::default();
            for (position, row) in self.columns.rows[rows.clone()].iter().enumerate() {
                let counts = timed.binary_search(row).is_ok();
                counted.push(times.get(position).filter(|_| counts));
            }
            batch = batch.with_numbers(Field::Stamp, counted);
        }
        Ok(match self.spacings {
            Some(spacings) => batch.with_numbers(Field::PredictedSpacing, spacings.slice(rows)),
            None => batch,
        })
    }
}

/// What the plan left out of what was asked for: reasons that any stream may have, and in words those that only a plan can.
fn left_out(study: &PlannedStudy) -> (Vec<Skipped>, Vec<String>) {
    let (mut skipped, mut notes) = (Vec::new(), Vec::new());
    for skip in &study.plan.skipped {
        if !matches!(skip.subject, Subject::Metric(_)) {
            continue;
        }
        let what = skip.subject.key();
        match &skip.reason {
            PlanReason::Skip(SkipReason::NotWanted) => {}
            PlanReason::Skip(reason) => skipped.push(Skipped {
                what,
                reason: reason.clone(),
            }),
            reason => notes.push(format!("{what}: {reason}")),
        }
    }
    (skipped, notes)
}
