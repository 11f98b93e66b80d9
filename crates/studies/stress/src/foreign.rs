//! Faults of pictures that a plugin makes.

use taceva_core::{Frame, Input};
use taceva_dataset::Pass;
use taceva_evaluate::{EvaluateError, Work, model_extractor};
use taceva_models::Extractor;

use crate::findings::{CHANGED_REST, LOW};
use crate::pass::{Predictor, UNTOUCHED, compares};
use crate::report::{ByChannel, SeverityReport};
use crate::scale::difference;
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
///     fn key(&self) -> &str {
///         "org.example/nothing"
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

    /// Text that identifies the version of the fault. Scores of faults with different keys are not compared.
    fn key(&self) -> &str;

    /// Returns the picture `frame` of the sample `sample` with the fault. `severity` is from 1 to 5. Size and format must not change.
    ///
    /// # Errors
    /// The reason, if the plugin fails.
    fn apply(&self, frame: &Frame, severity: u8, sample: &str) -> Result<Frame, String>;
}

/// Fault of a plugin at one severity.
struct Cell {
    severity: u8,
    /// True if the check of untouched pictures finds the fault.
    is_noticed: bool,
    /// Feature extractor whose untouched picture has the fault; `None` without an untouched picture, or if the model reads none.
    fresh: Option<Extractor>,
}

/// Predictions and picture changes of one severity.
#[derive(Clone, Default)]
struct Numbers {
    stale: Vec<f64>,
    fresh: Vec<f64>,
    /// Sum over all pictures of their mean change by the fault, each a fraction of full scale.
    changes: f64,
}

impl NewGel<'_> {
    /// Scores of the plugin fault `fault` at `severities`, or the reason why it failed. If it fails for one picture, it has no scores at all.
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
            reports.push(SeverityReport {
                severity: cell.severity,
                parameter: f64::from(cell.severity),
                stimulus,
                low_stimulus: stimulus.is_some_and(|stimulus| stimulus < LOW),
                check: cell
                    .is_noticed
                    .then_some(CHANGED_REST)
                    .into_iter()
                    .collect(),
                stale: stale.beside(self.baseline, self.clean),
                fresh: fresh.map(|fresh| fresh.beside(self.baseline, self.clean)),
                times: ByChannel::new(),
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
        let Some(reference) = reference.filter(|_| self.scale.is_reference) else {
            return Ok(Cell {
                severity,
                is_noticed: false,
                fresh: None,
            });
        };
        let rest = changed(fault, reference, severity, UNTOUCHED)?;
        // The fault is also in the pictures of contact.
        let pressed = self.scale.pressed.iter().enumerate();
        let pressed = pressed.map(|(number, frame)| {
            let sample = format!("pressed {number}");
            changed(fault, frame, severity, &sample)
        });
        let pressed: Vec<Frame> = pressed.collect::<Result<_, String>>()?;
        let fresh = compares(self.model).then(|| {
            let extractor = self.model.extractor(rest.info(), Some(Input::from(&rest)));
            extractor.ok()
        });
        Ok(Cell {
            severity,
            is_noticed: self.differs(&rest, &pressed),
            fresh: fresh.flatten(),
        })
    }

    /// Predictions with `fault` at the severity of each of `cells`, or the reason why the fault failed.
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
        let mut all = vec![Numbers::default(); cells.len()];
        let mut failure: Option<String> = None;
        let passed = self.dataset.map_frames(
            Pass::new(self.rows, work.jobs, work.progress),
            |row, frame| -> Result<Result<Vec<Numbers>, String>, EvaluateError> {
                let mut numbers = Vec::new();
                for cell in cells {
                    let faulty = match changed(fault, &frame, cell.severity, &samples[row]) {
                        Ok(faulty) => faulty,
                        Err(reason) => return Ok(Err(reason)),
                    };
                    let fresh = cell.fresh.as_ref();
                    let fresh = fresh.map(|fresh| predictor.of(&faulty, Some(fresh)));
                    numbers.push(Numbers {
                        stale: predictor.of(&faulty, predictor.clean.as_ref())?,
                        fresh: fresh.transpose()?.unwrap_or_default(),
                        changes: difference(&faulty, &frame),
                    });
                }
                Ok(Ok(numbers))
            },
            |_, found| {
                // The first failure in the order of the rows ends the pass.
                let found: Vec<Numbers> =
                    found?.inspect_err(|reason| failure = Some(reason.clone()))?;
                for (all, own) in all.iter_mut().zip(found) {
                    all.stale.extend(own.stale);
                    all.fresh.extend(own.fresh);
                    all.changes += own.changes;
                }
                Ok(())
            },
        );
        if let Some(reason) = failure {
            return Ok(Err(reason));
        }
        passed?;
        Ok(Ok(all))
    }
}

/// Returns the picture with the fault. Fails if the plugin returns a picture of another size or format.
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
