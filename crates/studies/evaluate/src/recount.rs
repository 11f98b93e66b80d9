//! Scores a table of samples by the plan in a state file, and compares the sums with those in the file.

mod phases;

pub use phases::recount_phases;

use std::num::NonZeroUsize;
use std::ops::Range;

use taceva_core::{Batch, Column, Field, FieldSet, GratingKind, Labels, Nanometre, Phase, shown};
use taceva_metrics::{ClusteredBy, Evaluator, Metric, MetricPlan};
use taceva_results::{EvaluationReport, Provenance, Samples, Skip};

use crate::accumulate::{Rows, accumulate, reads_no_prediction, restricted};
use crate::error::EvaluateError;
use crate::state_file::{ReadState, StateFile};

/// Fields that a table of samples stores without loss.
const EXACT: [Field; 10] = [
    Field::Truth,
    Field::Prediction,
    Field::Point,
    Field::DepthStep,
    Field::Repeat,
    Field::Phase,
    Field::Scene,
    Field::UnitId,
    Field::Kind,
    Field::Spacing,
];

/// Column of predicted spacings, in mm.
const PREDICTED_SPACING: &str = "spacing_predicted_mm";

/// Scores of tables, computed by the plan and the facts in a state file.
#[derive(Debug)]
pub struct Recount {
    /// Report with the subject and the provenance of the state.
    pub report: EvaluationReport,
    /// True if the sums of the tables equal those of the state bit for bit.
    pub has_equal_sums: bool,
    /// Metrics that cannot be computed from the tables, each with the reason.
    pub left_out: Vec<Skip>,
}

impl Recount {
    /// Scores of `evaluator`, with the subject and the provenance of the state `file`. `left_out` lists the metrics that were not computed.
    ///
    /// # Errors
    /// [`EvaluateError::Scores`] for samples that the accumulators reject.
    pub(crate) fn of(
        file: &StateFile,
        mut evaluator: Evaluator,
        left_out: Vec<Skip>,
    ) -> Result<Recount, EvaluateError> {
        let has_equal_sums = evaluator.states()? == file.states;
        let evaluation = file.finish(evaluator)?;
        let (subject, provenance) = (file.subject.clone(), file.provenance.clone());
        Ok(Recount {
            report: EvaluationReport::new(subject, &evaluation, provenance),
            has_equal_sums,
            left_out,
        })
    }
}

/// Scores `samples` by the plan of `state`. Omits metrics that read fields absent from the table.
///
/// # Errors
/// [`EvaluateError::State`] for samples that do not match the state. [`EvaluateError::Scores`] for numbers that the metrics reject.
pub fn recount_samples(
    state: &ReadState,
    samples: &Samples,
    jobs: NonZeroUsize,
) -> Result<Recount, EvaluateError> {
    let ReadState { path, file, .. } = state;
    let plan = file.plan.to_plan(path)?;
    let rows = |is_unbounded: bool| SampleRows {
        samples,
        provenance: &file.provenance,
        is_unbounded,
        rows: (0..samples.rows()).collect(),
        timed: None,
    };
    rows(false)
        .check(&plan)
        .map_err(|problem| EvaluateError::State {
            path: path.clone(),
            problem,
        })?;
    let (metrics, left_out) = covered(&plan);
    let mut total = Evaluator::new(&plan);
    for is_unbounded in [false, true] {
        let own = metrics.iter().copied();
        let own: Vec<&'static Metric> = own
            .filter(|metric| metric.reads_unbounded_predictions() == is_unbounded)
            .collect();
        let plan = restricted(&plan, &own)?;
        total.merge(accumulate(&rows(is_unbounded), &plan, jobs)?)?;
    }
    Recount::of(file, total, left_out)
}

/// Divides the metrics of `plan` into metrics that can be computed from a table of samples, and other metrics.
fn covered(plan: &MetricPlan) -> (Vec<&'static Metric>, Vec<Skip>) {
    let (mut metrics, mut left_out) = (Vec::new(), Vec::new());
    let exact: FieldSet = EXACT.into_iter().collect();
    for metric in plan.kept().iter().copied() {
        let mut fields = metric.needs.fields.iter();
        let lacking = fields.find(|field| !exact.contains(*field));
        let reason = match (reads_no_prediction(metric), lacking) {
            (true, _) => {
                "this metric reads every row of the recording, but the table has only the scored rows"
            }
            (false, Some(_)) => {
                "this metric reads frames, times or brightness, which the table lacks"
            }
            (false, None) => {
                metrics.push(metric);
                continue;
            }
        };
        left_out.push(Skip {
            what: metric.id.to_owned(),
            reason: reason.to_owned(),
        });
    }
    (metrics, left_out)
}

/// Rows of a table of samples.
struct SampleRows<'a> {
    samples: &'a Samples,
    /// Provenance of the state. It names the recordings that are clusters.
    provenance: &'a Provenance,
    /// True to read predictions before clipping to the bounds of the model.
    is_unbounded: bool,
    /// Rows of the table that are summed, ascending.
    rows: Vec<usize>,
    /// Rows whose times are read, ascending; `None` for all rows.
    timed: Option<Vec<usize>>,
}

impl SampleRows<'_> {
    /// Rejects a table that lacks a channel or the name of a cluster, or contains an unknown phase or kind of grating.
    fn check(&self, plan: &MetricPlan) -> Result<(), String> {
        let mut channels = plan.channels().iter();
        if let Some(channel) =
            channels.find(|channel| self.samples.channel(channel.name()).is_none())
        {
            return Err(format!(
                "the table of samples has no channel `{}`, which the state contains",
                shown(channel.name())
            ));
        }
        for row in 0..self.samples.rows() {
            let line = row + 2;
            if plan.clustered_by() != ClusteredBy::Point && self.cluster(plan, row).is_none() {
                return Err(format!(
                    "the table of samples, line {line}: no name of the cluster, which the state needs"
                ));
            }
            let phase = self.samples.word(Field::Phase.name(), row);
            let kind = self.samples.word(Field::Kind.name(), row);
            let unknown = phase
                .filter(|name| Phase::from_name(name).is_none())
                .or(kind.filter(|name| GratingKind::from_name(name).is_none()));
            if let Some(word) = unknown {
                return Err(format!(
                    "the table of samples, line {line}: unknown phase or kind of grating `{}`",
                    shown(word)
                ));
            }
        }
        Ok(())
    }

    /// Name of the cluster of a row, if clusters are not contact points.
    fn cluster(&self, plan: &MetricPlan, row: usize) -> Option<String> {
        match plan.clustered_by() {
            ClusteredBy::Recording => {
                let name = self.samples.word("recording", row)?;
                let mut recordings = self.provenance.recordings.iter();
                let own = recordings.find(|recording| recording.name == name)?;
                Some(own.digest.clone())
            }
            ClusteredBy::Group => {
                let group = self.samples.word(Samples::GROUP, row)?;
                let dataset = self.provenance.dataset.as_deref()?;
                Some(format!("{dataset} {group}"))
            }
            ClusteredBy::Sample => self.samples.word(Samples::KEY, row).map(str::to_owned),
            _ => None,
        }
    }

    fn labels(&self, field: Field, rows: &[usize]) -> Labels {
        let mut labels = Labels::default();
        for row in rows {
            match self.samples.word(field.name(), *row) {
                Some(word) => labels.push(word),
                None => labels.push_absent(),
            }
        }
        labels
    }

    /// True if the time of `row` is read.
    fn is_timed(&self, row: usize) -> bool {
        let timed = self.timed.as_ref();
        timed.is_none_or(|timed| timed.binary_search(&row).is_ok())
    }

    fn numbers(&self, field: Field, rows: &[usize]) -> Column {
        let name = match field {
            Field::PredictedSpacing => PREDICTED_SPACING,
            field => field.name(),
        };
        let number = |row: usize| {
            let number = self.samples.number(name, row)?;
            match field {
                // Spacings are summed in whole nanometres.
                Field::Spacing | Field::PredictedSpacing => {
                    format!("{number:?}").parse().ok().map(Nanometre::to_f64)
                }
                Field::Stamp => self.is_timed(row).then_some(number),
                _ => Some(number),
            }
        };
        column(rows, number)
    }
}

impl Rows for SampleRows<'_> {
    fn rows(&self) -> usize {
        self.rows.len()
    }

    fn batch(&self, plan: &MetricPlan, rows: Range<usize>) -> Result<Batch, EvaluateError> {
        let rows = &self.rows[rows];
        let (mut truth, mut prediction) = (Vec::new(), Vec::new());
        for channel in plan.channels().iter() {
            let own = self.samples.channel(channel.name());
            truth.push(column(rows, |row| own?.truth(row)));
            prediction.push(column(rows, |row| match self.is_unbounded {
                true => self.samples.unbounded(channel.name(), row),
                false => own?.prediction(row),
            }));
        }
        let wanted = plan.fields();
        let points = wanted
            .contains(Field::Point)
            .then(|| self.labels(Field::Point, rows));
        let mut batch = Batch::from_columns(plan.channels().clone(), truth, prediction, points);
        let mut clusters = Labels::default();
        for row in rows {
            match self.cluster(plan, *row) {
                Some(name) => clusters.push(&name),
                None => clusters.push_absent(),
            }
        }
        batch = match plan.clustered_by() {
            ClusteredBy::Recording | ClusteredBy::Group => batch.with_recordings(clusters),
            ClusteredBy::Sample => batch.with_samples(clusters),
            _ => batch,
        };
        for field in wanted.iter() {
            batch = match field {
                Field::UnitId | Field::Scene | Field::Phase | Field::Kind | Field::FrameDigest => {
                    batch.with_labels(field, self.labels(field, rows))
                }
                Field::DepthStep
                | Field::Repeat
                | Field::Spacing
                | Field::PredictedSpacing
                | Field::Stamp
                | Field::Intensity => batch.with_numbers(field, self.numbers(field, rows)),
                _ => batch,
            };
        }
        Ok(batch)
    }
}

fn column(rows: &[usize], value: impl Fn(usize) -> Option<f64>) -> Column {
    let mut column = Column::default();
    rows.iter().for_each(|row| column.push(value(*row)));
    column
}
