//! Passes over the scored pictures: one pass for all faults and severities, or one for each severity.

use std::collections::BTreeSet;

use taceva_core::Frame;
use taceva_dataset::Dataset;
use taceva_evaluate::{EvaluateError, Work};
use taceva_models::Model;

use crate::looks::Look;
use crate::pass::{Cell, CellPredictions, predictions};
use crate::score::{Scored, Scorer};
use crate::severity::NEVER;

/// Scored pictures, with the model and the scorer.
pub(crate) struct Pictures<'a> {
    pub(crate) dataset: &'a Dataset,
    pub(crate) model: &'a Model,
    pub(crate) rows: &'a [usize],
    /// Time of each row of the table, from 0 to 1 over the duration of the recording.
    pub(crate) shares: &'a [f64],
    /// Untouched picture of the recording; `None` if unknown.
    pub(crate) reference: Option<&'a Frame>,
    pub(crate) scorer: &'a Scorer<'a>,
    pub(crate) work: Work<'a>,
}

/// Predictions without a fault, and cells with their predictions and scores.
#[derive(Default)]
pub(crate) struct Tested<'m> {
    pub(crate) clean: Vec<f64>,
    /// Statistics of each picture without a fault.
    pub(crate) looks: Vec<Look>,
    pub(crate) cells: Vec<Cell<'m>>,
    pub(crate) predicted: Vec<CellPredictions>,
    pub(crate) scored: Vec<ScoredCell>,
    /// Number of times that each picture was decoded.
    pub(crate) passes: u64,
}

/// Scores of one cell: a fault at one severity.
pub(crate) struct ScoredCell {
    pub(crate) stale: Scored,
    pub(crate) fresh: Option<Scored>,
}

impl ScoredCell {
    fn of(scorer: &Scorer<'_>, of: &CellPredictions) -> Result<ScoredCell, EvaluateError> {
        let fresh = (!of.fresh.is_empty()).then(|| scorer.score(&of.fresh));
        Ok(ScoredCell {
            stale: scorer.score(&of.stale)?,
            fresh: fresh.transpose()?,
        })
    }
}

impl Pictures<'_> {
    /// Scores `cells` in one pass over the pictures.
    pub(crate) fn at_once<'m>(&self, cells: Vec<Cell<'m>>) -> Result<Tested<'m>, EvaluateError> {
        let found = predictions(
            self.dataset,
            self.model,
            self.rows,
            self.shares,
            &cells,
            self.reference,
            self.work,
        )?;
        let scored = found.cells.iter();
        let scored = scored.map(|of| ScoredCell::of(self.scorer, of));
        Ok(Tested {
            scored: scored.collect::<Result<_, EvaluateError>>()?,
            clean: found.clean,
            looks: found.looks,
            cells,
            predicted: found.cells,
            passes: 1,
        })
    }

    /// Scores `cells` in one pass over the pictures for each severity. A fault is not tested after the first severity at which no channel has skill.
    pub(crate) fn until_no_skill<'m>(
        &self,
        cells: Vec<Cell<'m>>,
    ) -> Result<Tested<'m>, EvaluateError> {
        let mut all = Tested::default();
        let mut ended: BTreeSet<usize> = BTreeSet::new();
        let mut rest = cells;
        for severity in 1..NEVER {
            let (mut now, later): (Vec<Cell<'m>>, Vec<Cell<'m>>) = rest
                .into_iter()
                .partition(|cell| cell.level.severity == severity);
            rest = later;
            now.retain(|cell| !ended.contains(&cell.fault));
            if !now.is_empty() {
                let found = self.at_once(now)?;
                let pairs = found.cells.iter().zip(&found.scored);
                let without = pairs.filter(|(_, scored)| !scored.stale.has_skill());
                ended.extend(without.map(|(cell, _)| cell.fault));
                all.add(found);
            }
        }
        match all.passes {
            0 => self.at_once(Vec::new()),
            _ => Ok(all),
        }
    }
}

impl<'m> Tested<'m> {
    fn add(&mut self, other: Tested<'m>) {
        self.clean = other.clean;
        self.looks = other.looks;
        self.cells.extend(other.cells);
        self.predicted.extend(other.predicted);
        self.scored.extend(other.scored);
        self.passes += other.passes;
    }
}
