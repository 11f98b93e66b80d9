//! Scores of each metric, computed on the presses and channels that are planned for it.

use std::collections::BTreeMap;
use std::num::NonZeroUsize;
use std::ops::Range;

use taceva_core::{Batch, Channel, Channels, Column, Field, FieldSet, SkipReason, Skipped};
use taceva_dataset::Dataset;
use taceva_metrics::{Evaluation, Metric, MetricPlan};
use taceva_protocol::{PhaseKind, PlanReason, Subject};

use super::gratings::PredictedSpacings;
use super::phase_rows::PhaseRows;
use taceva_acquire::{PlannedScene, PlannedStudy};
use taceva_evaluate::Note;
use taceva_evaluate::skill;
use taceva_evaluate::{Bounded, EvaluateError, StateFile};
use taceva_evaluate::{Columns, OF_SENSOR, Rows, accumulate};
use taceva_evaluate::{Predicted, provenance_of, subject_of, truth};

/// Inputs from which the scores of a study are computed.
pub(super) struct Scores<'a> {
    pub(super) scene: &'a PlannedScene,
    pub(super) study: &'a PlannedStudy,
    pub(super) dataset: &'a Dataset,
    pub(super) phase_rows: &'a PhaseRows<'a>,
    /// Predictions, with the row of the dataset for each prediction, ascending; `None` if no metric reads predictions.
    pub(super) predicted: Option<&'a (Predicted, Vec<usize>)>,
    /// Predicted spacings of presses on gratings; `None` if no metric reads spacings.
    pub(super) predicted_spacings: Option<&'a PredictedSpacings>,
    pub(super) jobs: NonZeroUsize,
}

/// Rows and channels on which some metrics are computed together.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct ScoreGroup {
    phase: PhaseKind,
    channels: Vec<String>,
    predictions: Option<Within>,
    /// True if the metrics read all rows of the recording, but times only from the rows of the phase.
    of_sensor: bool,
}

/// Range to which predictions are limited before a metric reads them.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Within {
    /// Predictions limited to the bounds that the model states.
    Bounds,
    /// Predictions without a limit.
    Nothing,
}

impl Within {
    /// Range for the predictions that `metric` reads; `None` if the metric reads no predictions.
    fn of(metric: &Metric) -> Option<Within> {
        metric.reads_predictions().then(|| {
            if metric.reads_unbounded_predictions() {
                Within::Nothing
            } else {
                Within::Bounds
            }
        })
    }
}

/// Scores of a study, with the sums from which they were computed.
pub(super) struct StudyScores {
    pub(super) evaluation: Evaluation,
    /// Notes on metrics that are left out for a reason that is not a skip.
    pub(super) notes: Vec<Note>,
    /// State of each group of rows: the sums behind its scores.
    pub(super) states: Vec<StateFile>,
    /// Name of the phase on whose presses each metric is computed, by the name of the metric; empty for a recording without a plan.
    pub(super) phases: BTreeMap<String, String>,
}

/// Computes the scores of all groups of rows.
pub(super) fn score(scores: &Scores<'_>) -> Result<StudyScores, EvaluateError> {
    let mut groups: BTreeMap<ScoreGroup, Vec<&'static Metric>> = BTreeMap::new();
    for (planned, metric) in scores.phase_rows.metrics() {
        let group = ScoreGroup {
            phase: planned.phase,
            channels: planned.channels.clone(),
            predictions: Within::of(metric),
            of_sensor: metric.id == OF_SENSOR,
        };
        groups.entry(group).or_default().push(metric);
    }
    let is_asked_for = groups
        .values()
        .flatten()
        .any(|metric| metric.id == skill().id);
    if let Some(group) = scores.skill_group().filter(|_| !is_asked_for) {
        groups.entry(group).or_default().push(skill());
    }
    let (mut skipped, notes) = left_out(scores.study);
    let (mut parts, mut states, mut phases) = (Vec::new(), Vec::new(), BTreeMap::new());
    for (group, metrics) in &groups {
        let scored = scores.on(group, metrics)?;
        skipped.extend(scored.evaluation.skipped().iter().cloned());
        parts.push(scored.evaluation);
        states.push(scored.state);
        phases.extend(scored.phases);
    }
    Ok(StudyScores {
        evaluation: Evaluation::joined(parts, skipped),
        notes,
        states,
        phases,
    })
}

/// Scores of one group of rows, with the state from which they were computed.
struct GroupScores {
    evaluation: Evaluation,
    state: StateFile,
    /// Name of the phase on whose presses each metric is computed, by the name of the metric.
    phases: BTreeMap<String, String>,
}

impl Scores<'_> {
    fn on(
        &self,
        group: &ScoreGroup,
        metrics: &[&'static Metric],
    ) -> Result<GroupScores, EvaluateError> {
        let channels = self.channels(group)?;
        let Taken {
            rows,
            prediction,
            bounded,
        } = self.rows(group, &channels);
        let truth: Vec<Column> = channels
            .iter()
            .map(|channel| truth(self.dataset, channel, &rows))
            .collect::<Result<_, _>>()?;
        let table = self.dataset.table();
        let made = [
            self.predicted.map(|_| Field::Prediction),
            self.predicted_spacings.map(|_| Field::PredictedSpacing),
        ];
        let made: FieldSet = made.into_iter().flatten().collect();
        let settings = self.scene.scene.metrics.settings.settings();
        let plan = MetricPlan::new(metrics, channels, table.fields() | made)
            .with_facts(self.study.plan.sensor_facts())
            .with_seed(self.scene.scene.seed)
            .with_constants(self.constants())?
            .with_settings(settings)?;
        let columns = Columns {
            truth: &truth,
            prediction: &prediction,
            dataset: self.dataset,
            rows: &rows,
            groups: None,
        };
        let predicted_spacings = self
            .predicted_spacings
            .filter(|predicted_spacings| predicted_spacings.rows == rows);
        let samples = Samples {
            columns,
            timed: group.of_sensor.then(|| self.phase_rows.rows(group.phase)),
            spacings: predicted_spacings.map(|predicted_spacings| &predicted_spacings.spacings),
        };
        let mut evaluator = accumulate(&samples, &plan, self.jobs)?;
        let shares = bounded.shares();
        let (mut subject, mut provenance) = (subject_of(self.dataset), provenance_of(self.dataset));
        provenance.phases = self.phase_rows.named(group.phase, metrics);
        // The report names this unit too.
        if let Some((unit, _)) = self.phase_rows.measured_unit() {
            subject.serial = unit;
        }
        let state = StateFile::of(&mut evaluator, &subject, &provenance, bounded)?;
        let evaluation = evaluator.finish()?.with_bounded_shares(&shares);
        Ok(GroupScores {
            evaluation,
            state,
            phases: provenance.phases,
        })
    }

    /// Group of rows that determines the skill of the model; `None` without predictions. These are the calibration presses that the model has not
    /// seen. If there are none, the phase with the most predictions is used.
    fn skill_group(&self) -> Option<ScoreGroup> {
        let (_, predicted) = self.predicted?;
        let count = |phase: PhaseKind| {
            let rows = self.phase_rows.rows(phase).into_iter();
            rows.filter(|row| predicted.binary_search(row).is_ok())
                .count()
        };
        let phase = match count(PhaseKind::Calibration) {
            0 => {
                let phases = self.phase_rows.predicted_phases().into_iter();
                phases.max_by_key(|phase| count(*phase))?
            }
            _ => PhaseKind::Calibration,
        };
        Some(ScoreGroup {
            phase,
            channels: self.phase_rows.predicted_channels(),
            predictions: Some(Within::Bounds),
            of_sensor: false,
        })
    }

    /// Constant prediction of each channel, with which the skill metric compares the model. A channel without a stated constant is absent.
    fn constants(&self) -> BTreeMap<String, f64> {
        let predicted = self.predicted.map(|(predicted, _)| predicted);
        predicted.map_or_else(BTreeMap::new, |predicted| predicted.constants().clone())
    }

    /// Channels of the recording that the metrics of `group` read.
    fn channels(&self, group: &ScoreGroup) -> Result<Channels, EvaluateError> {
        let known = self.dataset.table().channels();
        let chosen = group.channels.iter().filter_map(|name| known.by_name(name));
        let chosen: Vec<Channel> = chosen.cloned().collect();
        Channels::new(chosen).map_err(|error| EvaluateError::Request(error.to_string()))
    }

    /// Rows of `group`, with their predictions. If the metrics read predictions, rows without a prediction are left out.
    fn rows(&self, group: &ScoreGroup, channels: &Channels) -> Taken {
        let rows = match group.of_sensor {
            true => self.dataset.all_rows(),
            false => self.phase_rows.rows(group.phase),
        };
        let (Some(within), Some((predicted, of_rows))) = (group.predictions, self.predicted) else {
            let mut nothing = Column::default();
            rows.iter().for_each(|_| nothing.push(None));
            return Taken {
                rows,
                prediction: vec![nothing; channels.len()],
                bounded: Bounded::default(),
            };
        };
        let of_model = match within {
            Within::Bounds => predicted.prediction(),
            Within::Nothing => predicted.unbounded(),
        };
        let found = rows
            .into_iter()
            .filter_map(|row| Some((row, of_rows.binary_search(&row).ok()?)));
        let (rows, positions): (Vec<usize>, Vec<usize>) = found.unzip();
        let column = |channel: &Channel| {
            let at = predicted.channels().position(channel.name());
            let mut column = Column::default();
            for &position in &positions {
                column.push(at.and_then(|at| of_model[at].get(position)));
            }
            column
        };
        Taken {
            prediction: channels.iter().map(column).collect(),
            bounded: predicted.bounded(positions.iter().copied()),
            rows,
        }
    }
}

/// Rows that the metrics of one group read, with their predictions.
struct Taken {
    rows: Vec<usize>,
    /// Predictions of the rows, one column per channel.
    prediction: Vec<Column>,
    /// Number of predictions of each channel that exceed the bounds of the model.
    bounded: Bounded,
}

/// Rows of one group, with their predicted spacings if metrics read spacings.
struct Samples<'a> {
    columns: Columns<'a>,
    /// Rows whose times a metric reads, ascending; `None` if it reads the times of all rows.
    timed: Option<Vec<usize>>,
    spacings: Option<&'a Column>,
}

impl Rows for Samples<'_> {
    fn rows(&self) -> usize {
        self.columns.rows()
    }

    fn batch(&self, plan: &MetricPlan, rows: Range<usize>) -> Result<Batch, EvaluateError> {
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

/// Requested metrics that the plan skips. A metric skipped for a [`SkipReason`] becomes a skip of the report. Any other reason becomes a note.
fn left_out(study: &PlannedStudy) -> (Vec<Skipped>, Vec<Note>) {
    let (mut skipped, mut notes) = (Vec::new(), Vec::new());
    for skip in &study.plan.skipped {
        if !matches!(skip.subject, Subject::Metric(_)) {
            continue;
        }
        let what = skip.subject.key();
        match &skip.reason {
            PlanReason::Skip(SkipReason::NotWanted) => {}
            PlanReason::Skip(reason) => skipped.push(Skipped::new(what, reason.clone())),
            reason => notes.push(Note::NotPlanned {
                what,
                reason: reason.to_string(),
            }),
        }
    }
    (skipped, notes)
}
