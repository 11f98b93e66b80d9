//! Rows of a recording by phase of the protocol, and the rows available to a model.

use std::collections::{BTreeMap, BTreeSet};

use taceva_core::{Field, Unit};
use taceva_dataset::Dataset;
use taceva_metrics::{Metric, catalogue};
use taceva_protocol::{PhaseKind, Plan, PlanSkip, PlannedMetric, PlannedPress, Subject};

use taceva_acquire::PlannedStudy;
use taceva_evaluate::EvaluateError;
use taceva_evaluate::FitRequest;
use taceva_evaluate::Note;
use taceva_evaluate::{DataPart, Divided};

/// Rows of a recording, grouped by the phase of the protocol for which their press was made.
pub(super) struct PhaseRows<'a> {
    plan: &'a Plan,
    dataset: &'a Dataset,
    /// Rows of each phase. `None` if the plan has no presses: every row then belongs to every phase.
    rows: Option<BTreeMap<PhaseKind, Vec<usize>>>,
    /// Rows of presses that are repeated on other units than the first, ascending. They belong to no phase, because no metric of one unit reads them.
    of_other_units: Vec<usize>,
}

/// Name in the report for rows of presses that are repeated on other units.
const OTHER_UNITS: &str = "other-units";
/// Channels of the place and depth of the ball, from which contact shapes are computed.
const OF_SHAPES: [&str; 3] = ["Px", "Py", "Pz"];

impl<'a> PhaseRows<'a> {
    pub(super) fn new(study: &'a PlannedStudy, dataset: &'a Dataset) -> PhaseRows<'a> {
        let plan = &study.plan;
        let mut of_other_units = Vec::new();
        let rows = (!plan.presses.is_empty()).then(|| by_phase(plan, dataset, &mut of_other_units));
        PhaseRows {
            plan,
            dataset,
            rows,
            of_other_units,
        }
    }

    /// Rows of one phase of the protocol, ascending.
    pub(super) fn rows(&self, kind: PhaseKind) -> Vec<usize> {
        match &self.rows {
            Some(rows) => rows.get(&kind).cloned().unwrap_or_default(),
            None => self.dataset.all_rows(),
        }
    }

    /// Rows of every phase of the protocol, by name of the phase; `None` for a recording without a plan.
    pub(super) fn protocol(&self) -> Option<BTreeMap<&'static str, Vec<usize>>> {
        let rows = self.rows.as_ref()?.iter();
        let phases = rows.map(|(kind, rows)| (kind.name(), rows.clone()));
        let others =
            (!self.of_other_units.is_empty()).then(|| (OTHER_UNITS, self.of_other_units.clone()));
        Some(phases.chain(others).collect())
    }

    /// Name of `phase` for the name of each of `metrics`; empty for a recording without a plan.
    pub(super) fn named(
        &self,
        phase: PhaseKind,
        metrics: &[&'static Metric],
    ) -> BTreeMap<String, String> {
        let metrics = metrics.iter().filter(|_| self.rows.is_some());
        metrics
            .map(|metric| (metric.id.to_owned(), phase.name().to_owned()))
            .collect()
    }

    /// Rows of presses that are repeated on other units than the first, ascending.
    pub(super) fn of_other_units(&self) -> &[usize] {
        &self.of_other_units
    }

    /// Planned metrics, each with its entry in the catalogue of metrics.
    pub(super) fn metrics(&self) -> impl Iterator<Item = (&'a PlannedMetric, &'static Metric)> {
        let planned = self.plan.metrics.iter();
        planned.filter_map(|metric| Some((metric, catalogue::find(&metric.id)?)))
    }

    /// True if contact shapes are planned. Their depth maps are computed from the predicted places and depths.
    fn has_shapes(&self) -> bool {
        self.plan.phases.contains(&PhaseKind::Shape)
    }

    /// Reason why the plan skips the phase `kind`; `None` if the phase is not skipped.
    pub(super) fn skipped(&self, kind: PhaseKind) -> Option<String> {
        let is_own = |skip: &&PlanSkip| skip.subject == Subject::Phase(kind);
        let is_planned = self.plan.phases.contains(&kind);
        let skip = self.plan.skipped.iter().find(is_own);
        skip.filter(|_| !is_planned)
            .map(|skip| skip.reason.to_string())
    }

    /// True if a planned metric or task compares predictions with the truth.
    pub(super) fn reads_predictions(&self) -> bool {
        !self.predicted_phases().is_empty()
    }

    /// True if any planned metric compares predicted spacings with the true spacings.
    pub(super) fn reads_spacings(&self) -> bool {
        let mut metrics = self.metrics();
        metrics.any(|(_, metric)| metric.needs.fields.contains(Field::PredictedSpacing))
    }

    /// Phases of the protocol whose predictions are needed. These are the phases of metrics that read predictions, contact shapes, and the
    /// calibration, which gives the skill of the model. Loading and unloading belong to them if their presses have frames.
    pub(super) fn predicted_phases(&self) -> BTreeSet<PhaseKind> {
        let metrics = self.metrics();
        let predicted = metrics.filter(|(_, metric)| metric.reads_predictions());
        let mut phases: BTreeSet<PhaseKind> = predicted.map(|(planned, _)| planned.phase).collect();
        phases.extend(self.has_shapes().then_some(PhaseKind::Shape));
        if !phases.is_empty() {
            phases.insert(PhaseKind::Calibration);
            let mut branches = self.plan.presses_of(PhaseKind::LoadUnload);
            if branches.any(|press| press.frames) {
                phases.insert(PhaseKind::LoadUnload);
            }
        }
        phases
    }

    /// Channels to predict, in the order of the plan. A metric or a contact shape reads them, and at least one sample with a frame has them.
    pub(super) fn predicted_channels(&self) -> Vec<String> {
        let table = self.dataset.table();
        let is_seen = |channel: &str| {
            let position = table.channels().position(channel);
            let seen = |(row, frame): (usize, &Option<_>)| {
                let truth = position.and_then(|position| table.truth(position).get(row));
                frame.is_some() && truth.is_some()
            };
            table.frames().iter().enumerate().any(seen)
        };
        let is_predicted = |channel: &&String| {
            let mut metrics = self.metrics();
            let position = table.channels().position(channel);
            let is_force =
                position.is_some_and(|at| table.channels().as_slice()[at].unit() == Unit::Newton);
            let is_of_shape = self.has_shapes() && OF_SHAPES.contains(&channel.as_str());
            is_of_shape
                || metrics.any(|(planned, metric)| {
                    metric.reads_predictions()
                        && planned.channels.contains(channel)
                        && (is_force || !metric.is_of_forces())
                })
        };
        let channels = self.plan.channels.iter();
        let predicted = channels.filter(is_predicted);
        predicted
            .filter(|channel| is_seen(channel))
            .cloned()
            .collect()
    }

    /// Splits the calibration presses into the parts of a fit. Each contact point stays in one part. All other presses are in no part.
    pub(super) fn divided(&self, request: &FitRequest) -> Result<Divided, EvaluateError> {
        let dataset = self.dataset;
        if self.rows.is_none() {
            return Divided::new(dataset, request.split.as_deref(), request.seed);
        }
        let rows = self.rows(PhaseKind::Calibration);
        let split = request.split.as_deref().unwrap_or("by-point");
        Divided::within(dataset, &rows, Some(split), request.seed)
    }

    /// Name of the unit, if only one was measured outside the surface map, with a note for the metrics that compare units. `None` if the study has no
    /// other unit, no metric compares units, or several units were measured.
    pub(super) fn measured_unit(&self) -> Option<(String, Note)> {
        let units = self.dataset.table().as_text(Field::UnitId.name())?;
        let mut of: Vec<String> = units.iter().flatten().cloned().collect();
        of.sort_unstable();
        of.dedup();
        let kinds = PhaseKind::ALL.into_iter();
        let rows = kinds
            .filter(|kind| *kind != PhaseKind::SurfaceMap)
            .flat_map(|kind| self.rows(kind));
        let measured: BTreeSet<&String> = rows.filter_map(|row| units[row].as_ref()).collect();
        let metrics = self
            .metrics()
            .filter(|(planned, _)| planned.phase == PhaseKind::SurfaceMap)
            .map(|(_, metric)| metric.id);
        let metrics: Vec<&'static str> = metrics.collect();
        let mut measured = measured.into_iter();
        let (Some(unit), None) = (measured.next(), measured.next()) else {
            return None;
        };
        (of.len() > 1 && !metrics.is_empty()).then(|| {
            let unit = unit.clone();
            let note = Note::MeasuredUnit {
                unit: unit.clone(),
                metrics,
                of,
            };
            (unit, note)
        })
    }

    /// Note on the number of samples that are missing, because presses ended early; `None` if none is missing.
    pub(super) fn shortfall(&self) -> Option<Note> {
        self.rows.as_ref()?;
        let presses = self.plan.presses.iter();
        let planned: usize = presses.map(|press| press.press.samples()).sum();
        let found = self.dataset.table().rows();
        (found < planned).then(|| Note::Untaken {
            count: planned - found,
            of: planned,
        })
    }
}

/// Rows of the training and validation parts, which fit a model or choose its settings, ascending.
pub(super) fn seen(divided: &Divided) -> Vec<usize> {
    let parts = [DataPart::Train, DataPart::Validation].map(|part| divided.rows(part));
    let mut rows = parts.concat();
    rows.sort_unstable();
    rows
}

/// Rows of each phase of the protocol. Rows of presses that are repeated on other units are added to `others` instead. Samples are named
/// `<press>/<number>`.
fn by_phase(
    plan: &Plan,
    dataset: &Dataset,
    others: &mut Vec<usize>,
) -> BTreeMap<PhaseKind, Vec<usize>> {
    let first = plan.units.first();
    let is_other = |press: &PlannedPress| {
        press.phases.contains(&PhaseKind::Repeatability) && Some(&press.press.unit) != first
    };
    let presses = plan.presses.iter();
    // No phase for a repeated press on another unit.
    let phases: BTreeMap<String, &[PhaseKind]> = presses
        .map(|press| {
            let phases: &[PhaseKind] = match is_other(press) {
                true => &[],
                false => press.phases.as_slice(),
            };
            (press.id.to_string(), phases)
        })
        .collect();
    let mut rows: BTreeMap<PhaseKind, Vec<usize>> = BTreeMap::new();
    for (row, sample) in dataset.table().samples().iter().enumerate() {
        let press = sample
            .split_once('/')
            .map_or(sample.as_str(), |(press, _)| press);
        let of_press = phases.get(press).copied();
        if of_press.is_some_and(<[PhaseKind]>::is_empty) {
            others.push(row);
        }
        for kind in of_press.unwrap_or_default() {
            rows.entry(*kind).or_default().push(row);
        }
    }
    rows
}
