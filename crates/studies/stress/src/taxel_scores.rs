//! Scores of a model on signals of taxels with faults, from one pass over the samples.

use std::num::NonZeroUsize;

use taceva_check::{SignalFacts, codes_of_signals};
use taceva_core::{Input, Signals};
use taceva_dataset::{Dataset, DatasetError, Pass};
use taceva_evaluate::{EvaluateError, Work, model_extractor};
use taceva_models::{Extractor, Model};

use crate::fault::Fault;
use crate::findings::LOW;
use crate::pass::{Predictor, compares};
use crate::report::{ByChannel, SeverityReport};
use crate::samples::elapsed_s;
use crate::setup::StressRequest;
use crate::severity::{Level, Levels};
use crate::stress::{Stress, draw_seeds};
use crate::taxel_scale::{TaxelScale, change};
use crate::worn::{NewGel, ScoredFault};

/// Seconds in an hour.
const HOUR_S: f64 = 3600.0;

/// Predictions without a fault, and with each fault of taxels at each severity.
///
/// # Shapes
/// Predictions: `[rows, draws, channels]`, row after row; one draw without a fault.
pub(crate) struct TaxelTest {
    pub(crate) clean: Vec<f64>,
    /// Statistics of the signals without a fault.
    facts: SignalFacts,
    cells: Vec<Cell>,
}

/// Fault of taxels at one severity.
struct Cell {
    fault: &'static Fault,
    level: Level,
    draws: Vec<CellDraw>,
    /// Predictions of a model that uses the untouched signals from before the fault.
    stale: Vec<f64>,
    /// Predictions with new untouched signals, which have the fault; empty without them.
    fresh: Vec<f64>,
    /// Sum over all samples of the mean change of their signals by the fault, each a mean over random draws.
    changes: f64,
}

/// One random draw of a fault.
struct CellDraw {
    stress: Stress<'static>,
    /// Feature extractor with new untouched signals, which have the fault; `None` if the model reads none or the recording has none.
    fresh: Option<Extractor>,
    /// Statistics of the signals with the fault.
    facts: SignalFacts,
}

impl TaxelTest {
    /// Predicts `rows` with each of `faults`. Reads the signals of a row once for all faults.
    pub(crate) fn of(
        dataset: &Dataset,
        model: &Model,
        rows: &[usize],
        faults: &[&'static Fault],
        scale: &TaxelScale,
        request: &StressRequest,
        work: Work<'_>,
    ) -> Result<TaxelTest, EvaluateError> {
        let clean = model.reads_features();
        let clean = clean.then(|| model_extractor(dataset, model)).transpose()?;
        let predictor = Predictor { model, clean };
        // Only a fault that grows with time reads times. Without times, this fault is skipped.
        let elapsed = elapsed_s(dataset, rows);
        let elapsed = elapsed.unwrap_or_else(|| vec![0.0; dataset.table().rows()]);
        let hours: Vec<f64> = elapsed.iter().map(|time| time / HOUR_S).collect();
        let end = hours.iter().copied().fold(0.0, f64::max);
        let cells = faults.iter().flat_map(|&fault| {
            let levels = Levels::by_parameter(fault, &request.severities).reached;
            let levels = levels.into_iter();
            levels.map(move |level| Cell::new(fault, level, model, scale, request, end))
        });
        let mut test = TaxelTest {
            clean: Vec::new(),
            facts: scale.facts.clone(),
            cells: cells.collect(),
        };
        // One thread, because several would share one file.
        let pass = Pass::new(rows, NonZeroUsize::MIN, work.progress);
        dataset.map_rows(
            pass,
            "read signals",
            |row| dataset.signals(row),
            |row, signals| {
                let signals = signals.ok_or_else(|| {
                    DatasetError::request(dataset.path(), format!("row {row} has no signals"))
                })?;
                let added = test.add(&signals, hours[row], &predictor, scale);
                added.map_err(|error| DatasetError::Sink {
                    row,
                    source: error.into(),
                })
            },
        )?;
        Ok(test)
    }

    /// Adds the predictions of the next sample, which was recorded `hours` after the first.
    fn add(
        &mut self,
        signals: &Signals,
        hours: f64,
        predictor: &Predictor<'_>,
        scale: &TaxelScale,
    ) -> Result<(), EvaluateError> {
        let before = predictor.clean.as_ref();
        self.clean.extend(predictor.of(signals, before)?);
        self.facts.add(signals.values());
        for cell in &mut self.cells {
            let share = 1.0 / cell.draws.len() as f64;
            for draw in &mut cell.draws {
                let faulty = draw
                    .stress
                    .apply_to_signals(signals, &scale.full_scale, hours);
                cell.stale.extend(predictor.of(&faulty, before)?);
                if let Some(fresh) = &draw.fresh {
                    cell.fresh.extend(predictor.of(&faulty, Some(fresh))?);
                }
                cell.changes += share * change(&faulty, signals);
                draw.facts.add(faulty.values());
            }
        }
        Ok(())
    }
}

impl Cell {
    /// Creates the cell of `fault` at `level`, without samples. The recording takes `end` hours.
    fn new(
        fault: &'static Fault,
        level: Level,
        model: &Model,
        scale: &TaxelScale,
        request: &StressRequest,
        end: f64,
    ) -> Cell {
        let rest = scale.facts.rest.as_ref().filter(|_| compares(model));
        let seeds = draw_seeds(fault, request.seed, request.draws);
        let draws = seeds.into_iter().map(|seed| {
            let stress = Stress::new(fault, level.parameter, seed);
            let fresh = rest.and_then(|rest| {
                let faulty = stress.apply_to_signals(rest, &scale.full_scale, end);
                let reference = Some(Input::from(&faulty));
                model.extractor(faulty.info(), reference).ok()
            });
            CellDraw {
                stress,
                fresh,
                facts: scale.facts.clone(),
            }
        });
        Cell {
            fault,
            level,
            draws: draws.collect(),
            stale: Vec::new(),
            fresh: Vec::new(),
            changes: 0.0,
        }
    }

    /// Codes of the checks of taxels that find the fault in every random draw, except the codes in `clean`.
    fn check(&self, dataset: &Dataset, clean: &[&'static str]) -> Vec<&'static str> {
        let draws = self.draws.iter();
        let draws = draws.map(|draw| codes_of_signals(dataset, &draw.facts));
        let draws: Vec<Vec<&'static str>> = draws.collect();
        let mut found = draws.first().cloned().unwrap_or_default();
        found.retain(|code| !clean.contains(code) && draws.iter().all(|of| of.contains(code)));
        found
    }
}

impl NewGel<'_> {
    /// Scores the predictions with `fault`, which is one of the faults of `test`.
    pub(crate) fn by_taxels(
        &self,
        fault: &'static Fault,
        test: &TaxelTest,
        request: &StressRequest,
    ) -> Result<ScoredFault, EvaluateError> {
        let clean = codes_of_signals(self.dataset, &test.facts);
        let own = test.cells.iter().filter(|cell| cell.fault.id == fault.id);
        let own: Vec<&Cell> = own.collect();
        let mut severities = Vec::new();
        let mut cells = Vec::new();
        let mut has_ended = false;
        for cell in &own {
            if has_ended {
                break;
            }
            let stale = self.scorer.score(&cell.stale)?;
            let fresh = (!cell.fresh.is_empty()).then(|| self.scorer.score(&cell.fresh));
            let fresh = fresh.transpose()?;
            let change = cell.changes / self.rows.len() as f64;
            let stimulus = self.scale.contact.map(|contact| change / contact);
            severities.push(SeverityReport {
                severity: cell.level.severity,
                parameter: cell.level.parameter,
                stimulus,
                low_stimulus: stimulus.is_some_and(|stimulus| stimulus < LOW),
                check: cell.check(self.dataset, &clean),
                stale: stale.beside(self.baseline, self.clean),
                fresh: fresh.map(|fresh| fresh.beside(self.baseline, self.clean)),
                times: ByChannel::new(),
            });
            has_ended = request.stops_at_no_skill && !stale.has_skill();
            cells.push(stale);
        }
        let words = [fault.id, fault.title, fault.parameter];
        let last = severities.last().map(|of| of.severity);
        let mut report = self.report(words, severities, &cells);
        report.note = fault.note.map(str::to_owned);
        report.stopped_at = last.filter(|_| cells.len() < own.len());
        Ok(ScoredFault {
            report,
            cells,
            skipped: Vec::new(),
            decoded: 0,
        })
    }
}
