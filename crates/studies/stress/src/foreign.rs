//! Faults of pictures that a plugin makes.

use std::sync::{Mutex, PoisonError};

use taceva_core::{Frame, Input};
use taceva_dataset::Pass;
use taceva_evaluate::{EvaluateError, Work, model_extractor};
use taceva_models::Extractor;

use crate::findings::{CHANGED_REST, LOW};
use crate::pass::{Predictor, UNTOUCHED};
use crate::report::SeverityReport;
use crate::scale::difference;
use crate::setup::compares;
use crate::worn::{NewGel, ScoredFault};

/// A fault of pictures that a plugin makes.
///
/// ```
/// use taceva_core::Frame;
/// use taceva_stress::PictureFault;
///
/// /// Pictures without a change.
/// struct Nothing;
///
/// impl PictureFault for Nothing {
///     fn name(&self) -> &str {
///         "nothing"
///     }
///     fn apply(&self, frame: &Frame, _severity: u8, _sample: &str) -> Result<Frame, String> {
///         Ok(frame.clone())
///     }
/// }
/// assert_eq!(Nothing.name(), "nothing");
/// ```
pub trait PictureFault: Sync {
    /// Name of the fault.
    fn name(&self) -> &str;

    /// The picture `frame` of `sample` with the fault of `severity`, from 1 to 5: of the same size and format.
    ///
    /// # Errors
    /// The reason, if the plugin fails.
    fn apply(&self, frame: &Frame, severity: u8, sample: &str) -> Result<Frame, String>;
}

/// One severity of a fault.
struct Cell {
    severity: u8,
    /// The untouched picture with the fault; `None` without a reference.
    rest: Option<Frame>,
    /// Features beside that picture; `None` if the model reads none.
    fresh: Option<Extractor>,
}

/// Numbers of one severity.
#[derive(Clone, Default)]
struct Numbers {
    stale: Vec<f64>,
    fresh: Vec<f64>,
    /// Sum of the changes of all pictures.
    changes: f64,
}

impl NewGel<'_> {
    /// Scores of `fault` at `severities`, or the reason why it failed. A fault that fails once has no scores.
    pub(crate) fn foreign(
        &self,
        fault: &dyn PictureFault,
        severities: &[u8],
        work: Work<'_>,
    ) -> Result<Result<ScoredFault, String>, EvaluateError> {
        let cells = severities
            .iter()
            .map(|severity| self.cell(fault, *severity));
        let cells: Vec<Cell> = match cells.collect::<Result<_, String>>() {
            Ok(cells) => cells,
            Err(reason) => return Ok(Err(reason)),
        };
        let numbers = match self.numbers(fault, &cells, work)? {
            Ok(numbers) => numbers,
            Err(reason) => return Ok(Err(reason)),
        };
        let mut reports = Vec::new();
        let mut scored = Vec::new();
        for (cell, own) in cells.iter().zip(&numbers) {
            let stale = self.scorer.score(&own.stale)?;
            let fresh = (!own.fresh.is_empty()).then(|| self.scorer.score(&own.fresh));
            let fresh = fresh.transpose()?;
            let change = own.changes / self.rows.len() as f64;
            let stimulus = self.scale.contact.map(|contact| change / contact);
            let is_noticed = cell.rest.as_ref().is_some_and(|rest| self.differs(rest));
            reports.push(SeverityReport {
                severity: cell.severity,
                parameter: f64::from(cell.severity),
                stimulus,
                low_stimulus: stimulus.is_some_and(|stimulus| stimulus < LOW),
                check: is_noticed.then_some(CHANGED_REST).into_iter().collect(),
                stale: stale.beside(self.baseline, self.clean),
                fresh: fresh.map(|fresh| fresh.beside(self.baseline, self.clean)),
            });
            scored.push(stale);
        }
        let words = [fault.name(), "a fault of a plugin", "severity"];
        Ok(Ok(ScoredFault {
            report: self.report(words, reports, &scored),
            cells: scored,
            skipped: Vec::new(),
            decoded: self.rows.len() as u64,
        }))
    }

    fn cell(&self, fault: &dyn PictureFault, severity: u8) -> Result<Cell, String> {
        let reference = self.scale.untouched.as_ref();
        let reference = reference.filter(|_| self.scale.is_reference);
        let rest = reference.map(|frame| changed(fault, frame, severity, UNTOUCHED));
        let rest = rest.transpose()?;
        let fresh = rest.as_ref().filter(|_| compares(self.model));
        let fresh = fresh.and_then(|rest| {
            let extractor = self.model.extractor(rest.info(), Some(Input::from(rest)));
            extractor.ok()
        });
        Ok(Cell {
            severity,
            rest,
            fresh,
        })
    }

    /// Predictions of every cell, or the reason why `fault` failed.
    fn numbers(
        &self,
        fault: &dyn PictureFault,
        cells: &[Cell],
        work: Work<'_>,
    ) -> Result<Result<Vec<Numbers>, String>, EvaluateError> {
        let clean = self.model.reads_features();
        let clean = clean.then(|| model_extractor(self.dataset, self.model));
        let predictor = Predictor {
            model: self.model,
            clean: clean.transpose()?,
        };
        let samples = self.dataset.table().samples();
        let failure: Mutex<Option<String>> = Mutex::new(None);
        let failed = || failure.lock().unwrap_or_else(PoisonError::into_inner);
        let mut all = vec![Numbers::default(); cells.len()];
        self.dataset.map_frames(
            Pass::new(self.rows, work.jobs, work.progress),
            |row, frame| -> Result<Vec<Numbers>, EvaluateError> {
                let mut numbers = Vec::new();
                for cell in cells {
                    // After a failure the plugin is not asked again.
                    if failed().is_some() {
                        return Ok(numbers);
                    }
                    let faulty = match changed(fault, &frame, cell.severity, &samples[row]) {
                        Ok(faulty) => faulty,
                        Err(reason) => {
                            failed().get_or_insert(reason);
                            return Ok(numbers);
                        }
                    };
                    let fresh = cell.fresh.as_ref();
                    let fresh = fresh.map(|fresh| predictor.of(&faulty, Some(fresh)));
                    numbers.push(Numbers {
                        stale: predictor.of(&faulty, predictor.clean.as_ref())?,
                        fresh: fresh.transpose()?.unwrap_or_default(),
                        changes: difference(&faulty, &frame),
                    });
                }
                Ok(numbers)
            },
            |_, found| {
                let found: Vec<Numbers> = found?;
                for (all, own) in all.iter_mut().zip(found) {
                    all.stale.extend(own.stale);
                    all.fresh.extend(own.fresh);
                    all.changes += own.changes;
                }
                Ok(())
            },
        )?;
        let failure = failure.into_inner().unwrap_or_else(PoisonError::into_inner);
        Ok(failure.map_or(Ok(all), Err))
    }
}

/// The picture with the fault. A picture of another size or format is a failure of the fault.
fn changed(
    fault: &dyn PictureFault,
    frame: &Frame,
    severity: u8,
    sample: &str,
) -> Result<Frame, String> {
    let faulty = fault.apply(frame, severity, sample)?;
    match faulty.info() == frame.info() {
        true => Ok(faulty),
        false => Err(format!(
            "a picture of {} from one of {}, expected the same size and format",
            faulty.info(),
            frame.info()
        )),
    }
}
