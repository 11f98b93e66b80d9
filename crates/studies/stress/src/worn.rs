//! Faults of a gel. The same presses are made on a worn gel, so that force and picture change together.

use std::collections::BTreeMap;

use taceva_check::{FrameFacts, RestChange, Tiles};
use taceva_core::{Frame, counted};
use taceva_dataset::{Dataset, Pass};
use taceva_evaluate::{EvaluateError, Work, model_extractor};
use taceva_models::Model;

use crate::estimate::{Estimate, Undefined};
use crate::findings::{CHANGED_REST, LOW, breaks_at, recovers};
use crate::pass::{Predictor, compares};
use crate::report::{ByChannel, CleanScore, FaultReport, SeverityReport, SkippedFault};
use crate::scale::{Scale, difference};
use crate::score::{Scored, Scorer, degradation};

/// Fault of a gel, with a recording of the same presses on a worn gel for each severity. A simulated bench makes it; callers only read it.
#[derive(Debug)]
pub struct WornFault {
    /// Name of the fault, such as `gel_softening`.
    pub id: String,
    /// Cause and appearance, in one line.
    pub title: String,
    /// Meaning and unit of the parameter.
    pub parameter: String,
    /// Worn gels in ascending order of severity.
    pub severities: Vec<WornGel>,
    /// Severities that the bench cannot make of this gel, with reasons.
    pub skipped: Vec<SkippedFault>,
}

/// Recording of the same presses on a gel with a fault of one severity. A simulated bench makes it; callers only read it.
#[derive(Debug)]
pub struct WornGel {
    /// The severity, from 1 to 5.
    pub severity: u8,
    /// Parameter of the fault.
    pub parameter: f64,
    /// Recording on the worn gel. Its samples have the names of the samples on the new gel.
    pub dataset: Dataset,
}

/// Recording on the new gel, and its scores.
pub(crate) struct NewGel<'a> {
    pub(crate) dataset: &'a Dataset,
    pub(crate) model: &'a Model,
    /// Rows of the scored samples, ascending.
    pub(crate) rows: &'a [usize],
    pub(crate) scorer: &'a Scorer<'a>,
    pub(crate) baseline: &'a Scored,
    pub(crate) clean: &'a ByChannel<CleanScore>,
    pub(crate) scale: &'a Scale,
}

/// Scores of one fault at each tested severity.
pub(crate) struct ScoredFault {
    pub(crate) report: FaultReport,
    /// Scores at each severity. The model uses the untouched picture from before the fault.
    pub(crate) cells: Vec<Scored>,
    pub(crate) skipped: Vec<SkippedFault>,
    /// Number of decoded pictures.
    pub(crate) decoded: u64,
}

/// Predictions from pictures of a worn gel.
#[derive(Default)]
struct Predictions {
    stale: Vec<f64>,
    fresh: Vec<f64>,
    /// Sum over all pictures of their mean change by the fault, each a fraction of full scale.
    changes: f64,
}

impl NewGel<'_> {
    /// Scores the model on the recordings of `fault`. A severity whose recording lacks a sample is skipped, because the same presses are compared.
    pub(crate) fn beside(
        &self,
        fault: &WornFault,
        work: Work<'_>,
    ) -> Result<ScoredFault, EvaluateError> {
        let mut severities = Vec::new();
        let mut cells = Vec::new();
        let mut skipped = fault.skipped.clone();
        let mut decoded = 0;
        for worn in &fault.severities {
            let Some(rows) = self.rows_of(&worn.dataset) else {
                let samples = counted(self.rows.len(), "sample");
                skipped.push(SkippedFault {
                    fault: fault.id.clone(),
                    reason: format!(
                        "severity {}: presses on the worn gel ended early, so some of {samples} are missing",
                        worn.severity
                    ),
                });
                continue;
            };
            let found = self.predictions(&worn.dataset, &rows, work)?;
            let scorer = self.scorer.of_worn(&worn.dataset, &rows)?;
            let stale = scorer.score(&found.stale)?;
            let fresh = (!found.fresh.is_empty()).then(|| scorer.score(&found.fresh));
            let fresh = fresh.transpose()?;
            let (is_noticed, looked_at) = self.is_noticed(&worn.dataset, &rows)?;
            decoded += 2 * self.rows.len() as u64 + looked_at;
            let change = found.changes / self.rows.len() as f64;
            let stimulus = self.scale.contact.map(|contact| change / contact);
            severities.push(SeverityReport {
                severity: worn.severity,
                parameter: worn.parameter,
                stimulus,
                low_stimulus: stimulus.is_some_and(|stimulus| stimulus < LOW),
                check: is_noticed.then_some(CHANGED_REST).into_iter().collect(),
                stale: stale.beside(self.baseline, self.clean),
                fresh: fresh.map(|fresh| fresh.beside(self.baseline, self.clean)),
                times: ByChannel::new(),
            });
            cells.push(stale);
        }
        Ok(ScoredFault {
            report: self.report(
                [&fault.id, &fault.title, &fault.parameter],
                severities,
                &cells,
            ),
            cells,
            skipped,
            decoded,
        })
    }

    /// Builds the report of a fault with this name, title and parameter.
    pub(crate) fn report(
        &self,
        [id, title, parameter]: [&str; 3],
        severities: Vec<SeverityReport>,
        cells: &[Scored],
    ) -> FaultReport {
        let names: Vec<&String> = self.baseline.names().collect();
        let mean = |name: &str| degradation(name, cells, self.baseline);
        let has_fresh = !severities.is_empty() && severities.iter().all(|of| of.fresh.is_some());
        let recovered = |name: &str| match has_fresh {
            true => recovers(&severities, name, &mean(name)),
            false => Estimate::undefined(Undefined::NoFreshReference),
        };
        let by_channel = |value: &dyn Fn(&str) -> Estimate| -> ByChannel<Estimate> {
            let names = names.iter();
            names
                .map(|name| ((*name).clone(), value(name.as_str())))
                .collect()
        };
        let breaks = names.iter();
        let breaks = breaks.map(|name| ((*name).clone(), breaks_at(&severities, name.as_str())));
        FaultReport {
            id: id.to_owned(),
            title: title.to_owned(),
            parameter: parameter.to_owned(),
            note: None,
            mean: by_channel(&mean),
            recovers: by_channel(&recovered),
            breaks_at: breaks.collect(),
            unreached: Vec::new(),
            stopped_at: None,
            relative_error: None,
            difference: None,
            times: ByChannel::new(),
            errors: cells.iter().map(|cell| cell.errors.clone()).collect(),
            severities,
        }
    }

    /// Rows of the scored samples in `worn`, ascending; `None` if a sample or its picture is missing.
    fn rows_of(&self, worn: &Dataset) -> Option<Vec<usize>> {
        let names = worn.table().samples().iter().zip(0..);
        let places: BTreeMap<&String, usize> = names.collect();
        let samples = self.dataset.table().samples();
        let rows = self.rows.iter().map(|row| {
            let place = places.get(&samples[*row]).copied()?;
            worn.table().frames()[place].as_ref().map(|_| place)
        });
        let rows: Vec<usize> = rows.collect::<Option<_>>()?;
        rows.is_sorted_by(|one, next| one < next).then_some(rows)
    }

    fn predictions(
        &self,
        worn: &Dataset,
        rows: &[usize],
        work: Work<'_>,
    ) -> Result<Predictions, EvaluateError> {
        let model = self.model;
        let before = model.reads_features();
        let before = before.then(|| model_extractor(self.dataset, model));
        let before = before.transpose()?;
        let has_fresh = compares(model) && worn.reference()?.is_some();
        let after = has_fresh
            .then(|| model_extractor(worn, model))
            .transpose()?;
        let predictor = Predictor {
            model,
            clean: before,
        };
        let mut all = Predictions::default();
        worn.map_frames(
            Pass::new(rows, work.jobs, work.progress),
            |row, frame| -> Result<Predictions, EvaluateError> {
                let own = rows.binary_search(&row).ok().map(|place| self.rows[place]);
                let new = own.map(|row| self.dataset.frame(row)).transpose()?;
                let changes = new.flatten().map_or(0.0, |new| difference(&frame, &new));
                let fresh = after.as_ref();
                let fresh = fresh.map(|after| predictor.of(&frame, Some(after)));
                Ok(Predictions {
                    stale: predictor.of(&frame, predictor.clean.as_ref())?,
                    fresh: fresh.transpose()?.unwrap_or_default(),
                    changes,
                })
            },
            |_, found| {
                let found: Predictions = found?;
                all.stale.extend(found.stale);
                all.fresh.extend(found.fresh);
                all.changes += found.changes;
                Ok(())
            },
        )?;
        Ok(all)
    }

    /// True if the check of untouched pictures finds the fault. Also returns the number of pictures decoded for the check.
    fn is_noticed(&self, worn: &Dataset, rows: &[usize]) -> Result<(bool, u64), EvaluateError> {
        let after = Scale::of(worn, rows)?;
        let rest = after.untouched.filter(|_| after.is_reference);
        let is_noticed = rest.is_some_and(|rest| self.differs(&rest, &after.pressed));
        Ok((is_noticed, after.decoded))
    }

    /// True if the check of untouched pictures finds that `after` differs from the reference. It compares the difference with that of `pressed` from
    /// `after`.
    pub(crate) fn differs(&self, after: &Frame, pressed: &[Frame]) -> bool {
        let before = self.scale.untouched.as_ref();
        let Some(before) = before.filter(|_| self.scale.is_reference) else {
            return false;
        };
        let tiles = |frame: &Frame| FrameFacts::of(frame, None).tiles;
        let pressed: Vec<Tiles> = pressed.iter().map(tiles).collect();
        let pressed: Vec<&Tiles> = pressed.iter().collect();
        let change = RestChange::of(&tiles(before), &tiles(after), &pressed);
        change.is_some_and(|change| change.is_overall() || change.is_local())
    }
}
