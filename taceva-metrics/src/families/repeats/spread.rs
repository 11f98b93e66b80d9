//! Spread of predictions within a cell of repeated presses, and statistics of these spreads over cells.

use std::sync::OnceLock;

use crate::exact::merge::Merge;
use crate::exact::moments::Moments;
use crate::exact::{Dyadic, ExactSum};
use crate::families::cells::Cells;
use crate::score::value::{Finished, UndefinedReason};

/// Repeated predictions at one contact point and depth, and their cached spread.
#[derive(Clone, Debug, Default)]
pub(crate) struct Cell {
    moments: Moments,
    spread: OnceLock<Option<Spread>>,
}

impl Cell {
    /// Cell with the count and sums of its repeated predictions.
    pub(crate) fn new(moments: Moments) -> Cell {
        Cell {
            moments,
            spread: OnceLock::new(),
        }
    }

    /// Adds a repeated prediction, which must be finite.
    pub(crate) fn add(&mut self, value: f64) {
        self.spread = OnceLock::new();
        self.moments.add(value);
    }

    /// Count and sums of the repeated predictions.
    pub(crate) fn moments(&self) -> &Moments {
        &self.moments
    }

    /// Spread of the repeated predictions; `None` for fewer than two.
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

/// Mean and spread of the repeated predictions of one cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Spread {
    /// Degrees of freedom: the number of repeated predictions minus 1.
    pub(crate) freedom: u64,
    /// Mean of the repeated predictions, rounded once.
    pub(crate) mean: f64,
    /// Sample variance of the repeated predictions, rounded once.
    pub(crate) variance: f64,
    /// Sample standard deviation: the square root of `variance`.
    pub(crate) deviation: f64,
    /// Standard deviation with the divisor n: the square root of that variance, which is rounded once.
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

/// Spreads of the predictions of all cells with at least two repeated presses.
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

    /// Number of cells with at least two repeated predictions.
    pub(crate) fn count(&self) -> u64 {
        self.spreads.iter().fold(0, |count, _| count + 1)
    }

    /// Mean of `number` over the cells with at least two repeated predictions, rounded once.
    pub(crate) fn mean(&self, number: fn(&Spread) -> f64) -> Finished {
        self.defined()?;
        let sum: ExactSum = self.spreads.iter().map(number).collect();
        mean(&sum, self.count())
    }

    /// Pooled standard deviation of the repeated predictions. Rounded variances of cells are averaged, weighted by their degrees of freedom.
    pub(crate) fn pooled(&self) -> Finished {
        self.defined()?;
        let (mut variances, mut freedom) = (ExactSum::default(), 0_u64);
        for spread in &self.spreads {
            freedom = freedom.saturating_add(spread.freedom);
            variances.add_product(whole(spread.freedom), spread.variance);
        }
        mean(&variances, freedom).map(f64::sqrt)
    }

    /// Spread of the cell means beyond the scatter of repeated predictions: √max(0, s_m² − s_r² mean(1 / n_c)).
    ///
    /// s_m is the standard deviation of the cell means, and s_r the pooled standard deviation of repeated predictions. n_c is the number of
    /// predictions in a cell, and the mean is over cells.
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

    /// Sample standard deviation of the rounded means of cells.
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

/// Mean of `count` values with the exact sum `sum`, rounded once.
pub(crate) fn mean(sum: &ExactSum, count: u64) -> Result<f64, UndefinedReason> {
    if count == 0 {
        return Err(UndefinedReason::NoRepeatedPress);
    }
    Ok(sum.to_dyadic().over(&Dyadic::from(count)))
}
