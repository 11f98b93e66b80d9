//! One pass over the pictures. Each picture is decoded once, then predicted without a fault and with every fault.

use taceva_core::{Frame, Input};
use taceva_dataset::{Dataset, Pass};
use taceva_evaluate::{EvaluateError, Work, blank, model_extractor};
use taceva_models::{Extractor, Model};

use crate::looks::Look;
use crate::scale::difference;
use crate::severity::Level;
use crate::stress::Stress;

/// Cell of the stress test: one fault at one severity.
pub(crate) struct Cell<'m> {
    /// Index of the fault in the list of tested faults.
    pub(crate) fault: usize,
    pub(crate) level: Level,
    /// Random draws of the fault, at least one.
    pub(crate) draws: Vec<CellDraw<'m>>,
}

/// One random draw of a fault.
pub(crate) struct CellDraw<'m> {
    pub(crate) stress: Stress<'m>,
    /// Feature extractor with a new untouched picture, which has the fault; `None` if the model or the fault uses no such picture.
    fresh: Option<Extractor>,
}

impl<'m> Cell<'m> {
    /// Creates the cell of a fault. If `untouched` is given, also creates the extractors for a new untouched picture.
    pub(crate) fn new(
        fault: usize,
        level: Level,
        stresses: Vec<Stress<'m>>,
        model: &Model,
        untouched: Option<&Frame>,
    ) -> Cell<'m> {
        let draws = stresses.into_iter().map(|stress| CellDraw {
            fresh: untouched.and_then(|untouched| {
                let faulty = stress.apply(untouched, UNTOUCHED, None);
                // A picture in which markers are no longer found gives no extractor.
                let reference = Some(Input::from(&faulty));
                model.extractor(faulty.info(), reference).ok()
            }),
            stress,
        });
        let mut draws: Vec<CellDraw<'m>> = draws.collect();
        if draws.iter().any(|draw| draw.fresh.is_none()) {
            draws.iter_mut().for_each(|draw| draw.fresh = None);
        }
        Cell {
            fault,
            level,
            draws,
        }
    }

    /// Fault of the first draw, if it repeats pictures; `None` for other faults.
    fn repeating(&self) -> Option<&Stress<'m>> {
        let mut stresses = self.draws.iter().map(|draw| &draw.stress);
        stresses.find(|stress| stress.repeats())
    }
}

/// Sample name that stands for the untouched picture when random numbers of a fault are drawn.
pub(crate) const UNTOUCHED: &str = "untouched";

/// Predictions without a fault, and with the fault of every cell. They stay in memory until all pictures are read, because each is decoded once.
///
/// # Shapes
/// `[rows, draws, channels]`, row after row; one draw without a fault.
pub(crate) struct Predictions {
    pub(crate) clean: Vec<f64>,
    /// Statistics of each picture without a fault.
    pub(crate) looks: Vec<Look>,
    pub(crate) cells: Vec<CellPredictions>,
}

/// Predictions of one cell, which is a fault at one severity.
#[derive(Clone, Default)]
pub(crate) struct CellPredictions {
    /// Predictions with the untouched picture from before the fault.
    pub(crate) stale: Vec<f64>,
    /// Predictions with a new untouched picture, which has the fault; empty if there is none.
    pub(crate) fresh: Vec<f64>,
    /// Statistics of each picture with the fault.
    ///
    /// # Shapes
    /// `[rows, draws]`.
    pub(crate) looks: Vec<Look>,
    /// Sum over all pictures of their change by the fault, a mean over draws, as fractions of full scale.
    changes: f64,
}

impl CellPredictions {
    /// Mean change by the fault over `rows` pictures, a fraction of full scale.
    pub(crate) fn change(&self, rows: usize) -> f64 {
        self.changes / rows as f64
    }
}

/// Predicted row: its picture, and the predictions of each cell.
struct Row {
    frame: Frame,
    clean: Vec<f64>,
    look: Look,
    /// Predictions of each cell. Those of a fault that repeats pictures are added later, in the order of the rows.
    cells: Vec<CellPredictions>,
}

/// True if predictions depend on an untouched picture.
pub(crate) fn compares(model: &Model) -> bool {
    model.reads_features() && model.card().features.asks_for_reference().is_some()
}

/// A model with its feature extractor for the recording.
pub(crate) struct Predictor<'a> {
    pub(crate) model: &'a Model,
    /// Extractor of the features without a fault; `None` for a model whose predictions depend on no feature.
    pub(crate) clean: Option<Extractor>,
}

impl Predictor<'_> {
    /// Predictions from one picture, or from the signals of one sample, without limits on their range. They depend on no other sample.
    pub(crate) fn of<'i>(
        &self,
        input: impl Into<Input<'i>>,
        extractor: Option<&Extractor>,
    ) -> Result<Vec<f64>, EvaluateError> {
        let features = match extractor {
            Some(extractor) => extractor.extract_all([input])?,
            None => blank(self.model.card().features.shape(), 1)?,
        };
        Ok(self.model.predict_unbounded(&features)?)
    }

    /// Predictions and statistics of the picture `frame` of `sample`. `share` is the time of the sample, a fraction of the duration of the recording.
    fn row(
        &self,
        sample: &str,
        share: f64,
        frame: Frame,
        cells: &[Cell<'_>],
        reference: Option<&Frame>,
    ) -> Result<Row, EvaluateError> {
        let clean = self.of(&frame, self.clean.as_ref())?;
        let of_cell = |cell: &Cell<'_>| -> Result<CellPredictions, EvaluateError> {
            let mut found = CellPredictions::default();
            if cell.repeating().is_some() {
                return Ok(found);
            }
            for draw in &cell.draws {
                let faulty = draw.stress.at(share).apply(&frame, sample, None);
                found.stale.extend(self.of(&faulty, self.clean.as_ref())?);
                found.looks.push(Look::of(&faulty, reference));
                if let (Some(fresh), Some(_)) = (&draw.fresh, &self.clean) {
                    found.fresh.extend(self.of(&faulty, Some(fresh))?);
                }
                found.changes += difference(&faulty, &frame) / cell.draws.len() as f64;
            }
            Ok(found)
        };
        let cells = cells.iter().map(of_cell).collect::<Result<_, _>>()?;
        Ok(Row {
            look: Look::of(&frame, reference),
            frame,
            clean,
            cells,
        })
    }
}

/// Predictions of `rows`, which have pictures, without a fault and with the fault of each of `cells`. `shares` has the time of each row of the table,
/// a fraction of the duration. `reference` is the untouched picture of the recording.
pub(crate) fn predictions(
    dataset: &Dataset,
    model: &Model,
    rows: &[usize],
    shares: &[f64],
    cells: &[Cell<'_>],
    reference: Option<&Frame>,
    work: Work<'_>,
) -> Result<Predictions, EvaluateError> {
    let clean = model.reads_features();
    let clean = clean.then(|| model_extractor(dataset, model)).transpose()?;
    let predictor = Predictor { model, clean };
    let samples = dataset.table().samples();
    let mut all = Predictions {
        clean: Vec::new(),
        looks: Vec::new(),
        cells: vec![CellPredictions::default(); cells.len()],
    };
    let mut before: Option<Row> = None;
    dataset.map_frames(
        Pass::new(rows, work.jobs, work.progress),
        |row, frame| predictor.row(&samples[row], shares[row], frame, cells, reference),
        |row, found| {
            let mut found: Row = found?;
            for (cell, own) in cells.iter().zip(&mut found.cells) {
                if let Some(stress) = cell.repeating() {
                    let repeated = before
                        .as_ref()
                        .filter(|_| stress.is_repeated(&samples[row]));
                    own.stale = repeated.map_or(&found.clean, |row| &row.clean).clone();
                    own.looks = vec![repeated.map_or(&found.look, |row| &row.look).clone()];
                    own.changes = repeated.map_or(0.0, |row| difference(&row.frame, &found.frame));
                }
            }
            all.clean.extend_from_slice(&found.clean);
            all.looks.push(found.look.clone());
            for (cell, own) in all.cells.iter_mut().zip(&found.cells) {
                cell.looks.extend_from_slice(&own.looks);
                cell.stale.extend_from_slice(&own.stale);
                cell.fresh.extend_from_slice(&own.fresh);
                cell.changes += own.changes;
            }
            before = Some(found);
            Ok(())
        },
    )?;
    Ok(all)
}
