//! Spread within cells, and statistics of these spreads over cells.

use std::sync::OnceLock;

use crate::exact::merge::Merge;
use crate::exact::moments::Moments;
use crate::exact::{Dyadic, ExactSum};
use crate::families::cells::Cells;
use crate::score::value::{Finished, UndefinedReason};

/// Repeats of one cell, and their cached spread.
#[derive(Clone, Debug, Default)]
pub(crate) struct Cell {
    moments: Moments,
    spread: OnceLock<Option<Spread>>,
}

impl Cell {
    /// Cell with the given repeats.
    pub(crate) fn new(moments: Moments) -> Cell {
        Cell {
            moments,
            spread: OnceLock::new(),
        }
    }

    /// Adds a finite repeat.
    pub(crate) fn add(&mut self, value: f64) {
        self.spread = OnceLock::new();
        self.moments.add(value);
    }

    /// Count and sums of the repeats.
    pub(crate) fn moments(&self) -> &Moments {
        &self.moments
    }

    /// Spread of the repeats; `None` for fewer than two repeats.
    pub(crate) fn spread(&self) -> Option<Spread> {
        *self.spread.get_or_init(|| Spread::of(&self.moments))
    }
}

impl PartialEq for Cell {
    fn eq(&self, other: &Cell) -> bool {
        self.moments == other.moments
    }
}

impl Merge for Cell {
    fn merge(&mut self, other: &Cell) {
        self.spread = OnceLock::new();
        self.moments.merge(&other.moments);
    }
}

/// Spread of the repeats of one cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Spread {
    /// Number of repeats minus 1.
    pub(crate) freedom: u64,
    /// Mean, rounded once.
    pub(crate) mean: f64,
    /// Sample variance, rounded once.
    pub(crate) variance: f64,
    /// Root of `variance`.
    pub(crate) deviation: f64,
    /// Standard deviation with the divisor n: root of the rounded variance.
    pub(crate) population_deviation: f64,
}

impl Spread {
    fn of(moments: &Moments) -> Option<Spread> {
        let variance = moments.variance(1)?;
        Some(Spread {
            freedom: moments.n - 1,
            mean: moments.mean()?,
            variance,
            deviation: variance.sqrt(),
            population_deviation: moments.deviation(0)?,
        })
    }

    fn is_finite(&self) -> bool {
        self.variance.is_finite()
    }
}

/// Spreads of all cells with at least two repeats.
pub(crate) struct SpreadSums {
    spreads: Vec<Spread>,
    /// Reason for a missing score; `None` if a score is possible.
    reason: Option<UndefinedReason>,
}

impl SpreadSums {
    /// Collects the spreads of `cells`.
    pub(crate) fn of(cells: &Cells<Cell>) -> SpreadSums {
        let spreads: Vec<Spread> = cells.iter().filter_map(|(_, cell)| cell.spread()).collect();
        let reason = if cells.len() == 0 {
            Some(UndefinedReason::Empty)
        } else if !cells.are_named() {
            Some(UndefinedReason::NoClusters)
        } else if spreads.is_empty() {
            Some(UndefinedReason::NoRepeatedPress)
        } else if !spreads.iter().all(Spread::is_finite) {
            Some(UndefinedReason::Overflow)
        } else {
            None
        };
        SpreadSums { spreads, reason }
    }

    /// Number of cells with a spread.
    pub(crate) fn count(&self) -> u64 {
        self.spreads.iter().fold(0, |count, _| count + 1)
    }

    /// Mean of `number` over the cells, rounded once.
    pub(crate) fn mean(&self, number: fn(&Spread) -> f64) -> Finished {
        self.defined()?;
        let sum: ExactSum = self.spreads.iter().map(number).collect();
        mean(&sum, self.count())
    }

    /// Pooled standard deviation of the repeats: root of the mean of the cells' rounded variances, weighted by their degrees of freedom.
    pub(crate) fn pooled(&self) -> Finished {
        self.defined()?;
        let (mut variances, mut freedom) = (ExactSum::default(), 0_u64);
        for spread in &self.spreads {
            freedom = freedom.saturating_add(spread.freedom);
            variances.add_product(whole(spread.freedom), spread.variance);
        }
        mean(&variances, freedom).map(f64::sqrt)
    }

    /// Spread of the cell means beyond the scatter of their repeats: √max(0, s_m² − s_r² mean(1 / n_c)).
    ///
    /// s_m is the standard deviation of the cell means, s_r the pooled one of the repeats, and n_c the number of repeats of a cell.
    pub(crate) fn signal(&self) -> Finished {
        let (means, repeats) = (self.deviation_of_means()?, self.pooled()?);
        let shares: ExactSum = self
            .spreads
            .iter()
            .map(|spread| 1.0 / (whole(spread.freedom) + 1.0))
            .collect();
        let by_chance = repeats * repeats * mean(&shares, self.count())?;
        Ok((means * means - by_chance).max(0.0).sqrt())
    }

    /// Sample standard deviation of the cells' rounded means.
    fn deviation_of_means(&self) -> Finished {
        self.defined()?;
        let means: Moments = self.spreads.iter().map(|spread| spread.mean).collect();
        let too_few = UndefinedReason::TooFewCells {
            have: self.count(),
            least: 2,
        };
        means.deviation(1).ok_or(too_few)
    }

    fn defined(&self) -> Result<(), UndefinedReason> {
        self.reason.map_or(Ok(()), Err)
    }
}

fn whole(count: u64) -> f64 {
    count as f64
}

/// Mean from an exact sum, rounded once.
pub(crate) fn mean(sum: &ExactSum, count: u64) -> Result<f64, UndefinedReason> {
    if count == 0 {
        return Err(UndefinedReason::NoRepeatedPress);
    }
    Ok(sum.to_dyadic().over(&Dyadic::from(count)))
}
