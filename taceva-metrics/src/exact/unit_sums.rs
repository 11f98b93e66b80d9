//! Sums as integer numbers of fixed units, before they move to an [`ExactSum`].

use super::bounds::{Bounds, Grids, TERMS};
use super::grid::{Grid, ProductUnits};
use super::kernel::{ErrorUnits, ValueUnits};
use super::sum::ExactSum;
use crate::exact::streams::{Stream, Streams};

/// Number of fitting rows per tolerated stray, a row outside the grids. [`FREE_STRAYS`] more are tolerated.
const ROWS_PER_STRAY: usize = 16;

const FREE_STRAYS: usize = 16;

/// Numbers of units that are not yet in an [`ExactSum`], with their grids and bounds.
#[derive(Clone, Debug)]
pub(super) struct Pending {
    pub(super) grids: Grids,
    pub(super) bounds: Bounds,
    pub(super) errors: ErrorUnits,
    pub(super) values: ValueUnits,
    /// Rows summed in these units.
    pub(super) rows: usize,
    /// Rows summed on these grids since the grids were chosen; `strays` counts the rows that did not fit.
    pub(super) rows_on_grids: usize,
    pub(super) strays: usize,
}

impl Pending {
    pub(super) fn new(grids: Grids, streams: Streams) -> Pending {
        Pending {
            grids,
            bounds: Bounds::new(grids, streams),
            errors: ErrorUnits::default(),
            values: ValueUnits::default(),
            rows: 0,
            rows_on_grids: 0,
            strays: 0,
        }
    }

    /// Greatest number of strays, rows that do not fit, before other grids are chosen.
    pub(super) fn free_strays(&self) -> usize {
        FREE_STRAYS + self.rows_on_grids / ROWS_PER_STRAY
    }

    pub(super) fn clear(&mut self) {
        self.errors = ErrorUnits::default();
        self.values = ValueUnits::default();
        self.rows = 0;
    }

    /// Adds the units of `stream` to `sum`.
    pub(super) fn deposit(&self, stream: Stream, sum: &mut ExactSum) {
        let Grids { residual, truth } = self.grids;
        match stream {
            Stream::Absolute => deposit(self.errors.absolute, residual, sum),
            Stream::Residual => deposit(self.errors.residual, residual, sum),
            Stream::Squared => deposit_products(self.errors.squared, [residual; 2], sum),
            Stream::Truth => deposit(self.values.truth, truth, sum),
            Stream::TruthSquared => deposit_products(self.values.squared, [truth; 2], sum),
            Stream::Symmetric => deposit(self.values.symmetric, TERMS, sum),
        }
    }
}

pub(super) fn deposit(units: [i64; 2], grid: Grid, sum: &mut ExactSum) {
    for (units, unit) in units.into_iter().zip(grid.units()) {
        sum.add_units(units, unit);
    }
}

/// Adds units of products of values on these grids to `sum`.
pub(super) fn deposit_products(
    [rounded, lost]: ProductUnits,
    [left, right]: [Grid; 2],
    sum: &mut ExactSum,
) {
    deposit(rounded, left.of_products(right), sum);
    deposit(lost, left.of_errors_of_products(right), sum);
}
