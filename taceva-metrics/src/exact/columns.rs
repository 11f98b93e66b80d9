//! Exact sums of columns of equal length and of products of two columns, block by block.
//!
//! As in `block_sums.rs`, a grid is a range of magnitudes with fixed units. A block is summed in integer numbers of units, on grids that fit the
//! latest values. A row that does not fit is added alone. The selection of these rows depends on earlier rows, but the sums do not.

use super::bounds::best_top;
use super::column_kernel::{OfColumn, OfProducts, range_of};
use super::grid::{Grid, ProductUnits};
use super::kernel::{Block, add, add_products};
use super::machine::Machine;
use super::sum::ExactSum;
use super::unit_sums::{deposit, deposit_products};
use crate::pair::is_valid;

/// Least number of rows of a block. Adding fewer rows one by one is faster.
const FEW_ROWS: usize = 8;
/// Greatest number of rows between moves of the unit counts to the exact sums. Each row adds less than 2⁴⁴ units, so the rows and one block fit an
/// `i64`.
const MOST_ROWS: usize = 1 << 18;
/// Reciprocal of the greatest share of rows outside the grids in a block. A greater share changes the grids.
const ROWS_PER_STRAY: usize = 8;

/// Sums of columns and of their products.
pub(crate) trait ColumnSums {
    /// Sums of the columns, then sums of the products.
    fn sums(&mut self) -> [&mut [ExactSum]; 2];
    /// Records added rows, whose values are all usable numbers.
    fn take(&mut self, columns: &[&[f64]]);
    /// Records a row that was skipped for a NaN or a magnitude above 2¹⁰²¹.
    fn leave_out(&mut self);
}

/// Adds rows of columns to exact sums, block by block.
#[derive(Clone, Debug)]
pub(crate) struct ColumnAdder {
    machine: Machine,
    /// Indices of the two columns of each product.
    products: Vec<[usize; 2]>,
    /// Current grids, one per column; empty before the first block.
    grids: Vec<Grid>,
    units: Units,
}

/// Numbers of units that are not yet added to the exact sums.
#[derive(Clone, Debug, Default)]
struct Units {
    columns: Vec<[i64; 2]>,
    products: Vec<ProductUnits>,
    rows: usize,
}

impl ColumnAdder {
    /// Creates an adder of columns and of `products`, each given by the indices of its two columns.
    pub(crate) fn new(products: Vec<[usize; 2]>) -> ColumnAdder {
        ColumnAdder::with_machine(products, Machine::detect())
    }

    fn with_machine(products: Vec<[usize; 2]>, machine: Machine) -> ColumnAdder {
        ColumnAdder {
            machine,
            products,
            grids: Vec::new(),
            units: Units::default(),
        }
    }

    /// Adds the rows of `columns`. A row with a NaN or a magnitude above 2¹⁰²¹ is skipped.
    pub(crate) fn add(&mut self, columns: &[&[f64]], into: &mut impl ColumnSums) {
        let rows = columns.first().map_or(0, |column| column.len());
        if rows < FEW_ROWS {
            (0..rows).for_each(|row| self.add_row(columns, row, into));
            return;
        }
        let block_rows = Block::rows_on(self.machine);
        for start in (0..rows).step_by(block_rows) {
            let end = rows.min(start + block_rows);
            let block: Vec<&[f64]> = columns.iter().map(|column| &column[start..end]).collect();
            if self.add_block(&block) {
                into.take(&block);
            } else {
                self.add_strays_apart(&block, into);
            }
            if self.units.rows > MOST_ROWS {
                self.settle(into);
            }
        }
        self.settle(into);
    }

    /// Adds a block whose rows all fit the grids. Returns false and adds nothing if a row does not fit.
    fn add_block(&mut self, block: &[&[f64]]) -> bool {
        if self.grids.is_empty() {
            return false;
        }
        let columns = block.iter().zip(&self.grids);
        let columns = columns.map(|(&values, &grid)| self.machine.run(OfColumn { values, grid }));
        let Some(columns) = columns.collect::<Option<Vec<_>>>() else {
            return false;
        };
        let units = &mut self.units;
        units.columns.resize(columns.len(), [0; 2]);
        units.products.resize(self.products.len(), [[0; 2]; 2]);
        for (sum, column) in units.columns.iter_mut().zip(columns) {
            add(sum, column);
        }
        for (sum, of) in units.products.iter_mut().zip(&self.products) {
            let product = OfProducts {
                columns: of.map(|column| block[column]),
                grids: of.map(|column| self.grids[column]),
            };
            add_products(sum, self.machine.run(product));
        }
        units.rows += block[0].len();
        true
    }

    /// Adds a block with strays, rows that do not fit the grids: the strays one by one, and the other rows as a block.
    #[cold]
    #[inline(never)]
    fn add_strays_apart(&mut self, block: &[&[f64]], into: &mut impl ColumnSums) {
        let (mut fitting, mut strays) = self.divide(block);
        if self.grids.is_empty() || strays.len() > block[0].len() / ROWS_PER_STRAY {
            self.settle(into);
            let top = |column: &&[f64]| best_top(column.iter().copied(), Grid::REACH_OF_SQUARES);
            let tops = block.iter().map(top);
            self.grids = tops.map(|top| Grid { top }).collect();
            (fitting, strays) = self.divide(block);
        }
        if strays.len() < block[0].len() {
            let fitting: Vec<&[f64]> = fitting.iter().map(Vec::as_slice).collect();
            assert!(self.add_block(&fitting), "rows out of range were removed");
            into.take(&fitting);
        }
        strays
            .into_iter()
            .for_each(|row| self.add_row(block, row, into));
    }

    /// Columns of the rows that fit the grids, and indices of the other rows.
    fn divide(&self, block: &[&[f64]]) -> (Vec<Vec<f64>>, Vec<usize>) {
        let ranges: Vec<_> = self.grids.iter().map(|grid| range_of(*grid)).collect();
        let fits = |row: &usize| {
            let mut columns = block.iter().zip(&ranges);
            columns.all(|(column, range)| range.holds(column[*row].abs()))
        };
        let (fitting, strays): (Vec<usize>, Vec<usize>) = (0..block[0].len()).partition(fits);
        let only = |column: &&[f64]| fitting.iter().map(|&row| column[row]).collect();
        (block.iter().map(only).collect(), strays)
    }

    fn add_row(&self, columns: &[&[f64]], row: usize, into: &mut impl ColumnSums) {
        let row: Vec<&[f64]> = columns.iter().map(|column| &column[row..=row]).collect();
        if !row.iter().all(|value| is_valid(value[0])) {
            return into.leave_out();
        }
        let [columns, products] = into.sums();
        for (sum, value) in columns.iter_mut().zip(&row) {
            sum.add(value[0]);
        }
        for (sum, &[left, right]) in products.iter_mut().zip(&self.products) {
            sum.add_product(row[left][0], row[right][0]);
        }
        into.take(&row);
    }

    /// Moves the numbers of units to the exact sums in `into`.
    fn settle(&mut self, into: &mut impl ColumnSums) {
        if self.units.rows == 0 {
            return;
        }
        let [columns, products] = into.sums();
        for ((sum, units), &grid) in columns.iter_mut().zip(&self.units.columns).zip(&self.grids) {
            deposit(*units, grid, sum);
        }
        for ((sum, units), of) in products
            .iter_mut()
            .zip(&self.units.products)
            .zip(&self.products)
        {
            deposit_products(*units, of.map(|column| self.grids[column]), sum);
        }
        self.units.columns.fill([0; 2]);
        self.units.products.fill([[0; 2]; 2]);
        self.units.rows = 0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use proptest::test_runner::RngSeed;
    use taceva_core::Isa;

    /// Sums of two columns, of the square of the first and of their product, with counts of rows and the greatest values.
    #[derive(Clone, Debug, Default, PartialEq)]
    struct Noted {
        columns: [ExactSum; 2],
        products: [ExactSum; 2],
        rows: usize,
        left_out: usize,
        greatest: [f64; 2],
    }

    impl ColumnSums for Noted {
        fn sums(&mut self) -> [&mut [ExactSum]; 2] {
            [&mut self.columns, &mut self.products]
        }

        fn take(&mut self, columns: &[&[f64]]) {
            self.rows += columns[0].len();
            for (greatest, column) in self.greatest.iter_mut().zip(columns) {
                *greatest = column.iter().copied().fold(*greatest, f64::max);
            }
        }

        fn leave_out(&mut self) {
            self.left_out += 1;
        }
    }

    fn adder(isa: Isa) -> ColumnAdder {
        let machine = Machine::with(isa).expect("it is available");
        ColumnAdder::with_machine(vec![[0, 0], [1, 0]], machine)
    }

    /// Reference for the tests: adds the rows one by one.
    fn one_by_one(rows: &[[f64; 2]]) -> Noted {
        let mut noted = Noted::default();
        for &[left, right] in rows {
            if !is_valid(left) || !is_valid(right) {
                noted.left_out += 1;
                continue;
            }
            noted.rows += 1;
            noted.columns[0].add(left);
            noted.columns[1].add(right);
            noted.products[0].add_product(left, left);
            noted.products[1].add_product(right, left);
            noted.greatest = [noted.greatest[0].max(left), noted.greatest[1].max(right)];
        }
        noted
    }

    fn added(isa: Isa, rows: &[[f64; 2]], at_once: usize) -> Noted {
        let (mut adder, mut noted) = (adder(isa), Noted::default());
        for part in rows.chunks(at_once) {
            let columns = [0, 1].map(|column| part.iter().map(|row| row[column]).collect());
            let columns: [Vec<f64>; 2] = columns;
            adder.add(&[&columns[0], &columns[1]], &mut noted);
        }
        noted
    }

    fn value() -> impl Strategy<Value = f64> {
        prop_oneof![
            8 => -2.0..2.0_f64,
            1 => any::<f64>(),
            1 => prop_oneof![Just(0.0), Just(-0.0), Just(f64::NAN), Just(f64::INFINITY)],
        ]
    }

    proptest! {
        #![proptest_config(ProptestConfig {
            cases: 60,
            rng_seed: RngSeed::Fixed(2025),
            failure_persistence: None,
            ..ProptestConfig::default()
        })]

        #[test]
        fn blocks_add_what_rows_add_on_every_machine(
            rows in prop::collection::vec([value(), value()], 0..700),
            at_once in 1_usize..700,
        ) {
            let expected = one_by_one(&rows);
            for isa in Isa::available() {
                prop_assert_eq!(added(isa, &rows, at_once), expected.clone(), "{}", isa);
            }
        }
    }

    #[test]
    fn values_far_from_those_before_them_move_the_grids_and_lose_nothing() {
        let scales = [1.0, 1e-90, 1e90, 1e-300, 1e300, 3.0];
        let rows: Vec<[f64; 2]> = (0..6 * 600_u32)
            .map(|row| {
                let scale = scales[row as usize / 600];
                let value = f64::from(row % 601) / 7.0 - 31.0;
                [value * scale, (0.3 - value) / scale]
            })
            .collect();
        let expected = one_by_one(&rows);
        assert_eq!(expected.rows, rows.len());
        for isa in Isa::available() {
            assert_eq!(added(isa, &rows, rows.len()), expected, "{isa}");
        }
    }

    #[test]
    fn more_rows_than_units_can_count_are_settled_in_between() {
        let rows = vec![[1.999_999, -1.999_999]; MOST_ROWS + 5000];
        let noted = added(Isa::detect(), &rows, rows.len());
        let mut expected = ExactSum::default();
        (0..rows.len()).for_each(|_| expected.add_product(1.999_999, 1.999_999));
        assert_eq!(noted.products[0], expected);
        assert_eq!(noted.rows, rows.len());
    }
}
