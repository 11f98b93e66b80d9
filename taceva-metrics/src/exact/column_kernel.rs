//! Inner loops that sum a block of one column, or the products of two columns, in integer numbers of fixed units.

use super::bounds::Range;
use super::grid::{Grid, GridSum, ProductSum, ProductUnits};
use super::kernel::{Visit, visit_all};
use super::vector::{Job, Vector};
use crate::pair::Paired;

/// Range of values on `grid` whose products are summed exactly too.
pub(super) fn range_of(grid: Grid) -> Range {
    Range::new(grid.top, Grid::REACH_OF_SQUARES)
}

/// Job that sums a column. The result is `None` if a value is out of range.
pub(super) struct OfColumn<'a> {
    pub(super) values: &'a [f64],
    pub(super) grid: Grid,
}

struct ColumnVisit<V> {
    one: V,
    greatest: V,
    /// Predecessor of the least nonzero magnitude of the visited values.
    least: V,
    sum: GridSum<V>,
}

impl<V: Vector> Visit<V> for ColumnVisit<V> {
    #[inline(always)]
    fn visit(&mut self, value: V, _same: V) {
        let magnitude = value.magnitude();
        self.greatest = magnitude.greatest(self.greatest);
        self.least = magnitude.predecessor().least(self.least);
        self.sum.add(value, self.one);
    }
}

impl Job for OfColumn<'_> {
    type Output = Option<[i64; 2]>;

    #[inline(always)]
    fn run<V: Vector>(self, proof: V::Proof) -> Option<[i64; 2]> {
        let OfColumn { values, grid } = self;
        let mut visitor = ColumnVisit::<V> {
            one: V::splat(proof, std::hint::black_box(1.0)),
            greatest: V::splat(proof, 0.0),
            least: V::splat(proof, f64::MAX),
            sum: GridSum::new(proof, grid),
        };
        visit_all(proof, both(values, values), Paired::default(), &mut visitor);
        let range = range_of(grid).in_lanes::<V>(proof);
        let within = range.hold(visitor.least, visitor.greatest);
        // A NaN is neither greatest nor least, but stays in the sum.
        (within && visitor.sum.is_sound()).then(|| visitor.sum.units())
    }
}

/// Job that sums the products of two columns. All values must be in the ranges of their grids.
pub(super) struct OfProducts<'a> {
    pub(super) columns: [&'a [f64]; 2],
    pub(super) grids: [Grid; 2],
}

struct ProductVisit<V> {
    one: V,
    sum: ProductSum<V>,
}

impl<V: Vector> Visit<V> for ProductVisit<V> {
    #[inline(always)]
    fn visit(&mut self, left: V, right: V) {
        self.sum.add_product(left, right, self.one);
    }
}

impl Job for OfProducts<'_> {
    type Output = ProductUnits;

    #[inline(always)]
    fn run<V: Vector>(self, proof: V::Proof) -> ProductUnits {
        let [left, right] = self.columns;
        let mut visitor = ProductVisit::<V> {
            one: V::splat(proof, std::hint::black_box(1.0)),
            sum: ProductSum::new(proof, self.grids),
        };
        visit_all(proof, both(left, right), Paired::default(), &mut visitor);
        visitor.sum.units()
    }
}

fn both<'a>(left: &'a [f64], right: &'a [f64]) -> Paired<&'a [f64]> {
    Paired {
        estimate: left,
        reference: right,
    }
}
