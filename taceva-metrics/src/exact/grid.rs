//! Vector sums without rounding, for values in a known range of magnitudes.
//!
//! A large first summand, 1.5 × 2ᵏ, fixes the rounding: its sum with small values is a multiple of 2^(k−52). Two subtractions return the cut-off part
//! of a value exactly. A second sum of the same kind, the fine sum, collects these parts. Each sum stays between 2ᵏ and 2^(k+1), so its bit pattern,
//! read as an integer, counts its units of 2^(k−52). After Demmel and Nguyen, "Parallel Reproducible Summation", 2015, who round the remainder; this
//! code keeps the remainder.

use super::vector::Vector;

/// Greatest number of values added to one lane of a vector before the numbers of units must be read.
pub(super) const DEPTH: usize = 128;
/// Exponent k of the start 1.5 × 2ᵏ of the coarse sum, minus the greatest exponent e of a value. 2⁷ values below 2^(e+1) add less than 2^(e+8). Twice
/// this sum keeps the result between 2ᵏ and 2^(k+1).
const COARSE: i32 = 10;
/// Exponent k of the start 1.5 × 2ᵏ of the fine sum, minus the greatest exponent e of a value. 2⁷ cut-off parts below 2^(e−42) keep the result
/// between 2ᵏ and 2^(k+1).
const FINE: i32 = -34;
/// Bits of a mantissa after the leading bit.
const FRACTION: i32 = 52;

/// Grid: fixed units for sums of values below 2^(top + 1) in magnitude.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Grid {
    /// Exponent of two of the greatest magnitude.
    pub(super) top: i32,
}

impl Grid {
    /// Grid of rounded products of values on this grid and on `other`.
    pub(super) fn of_products(self, other: Grid) -> Grid {
        Grid {
            top: self.top + other.top + 1,
        }
    }

    /// Grid of the rounding errors of products of values on this grid and on `other`.
    pub(super) fn of_errors_of_products(self, other: Grid) -> Grid {
        Grid {
            top: self.top + other.top - FRACTION - 1,
        }
    }

    /// Greatest distance from the top of the grid down to the exponent of a value. The value's last place is then at least a unit of the fine sum.
    pub(super) const REACH: i32 = -FINE;
    /// Greatest distance from the top down to the exponent of a value that is squared, or multiplied by a value of another grid.
    ///
    /// Let e be the exponent of the value and t the top. The last place of the rounded square, 2e − 52, must be at least the unit 2t + 1 − `REACH` −
    /// 52. The rounding error of the square ends at 2e − 104, on a grid of top 2t − 53, and allows one exponent more. For a product, both exponents
    /// and both tops add up.
    pub(super) const REACH_OF_SQUARES: i32 = (Grid::REACH - 1) / 2;

    /// Exponents of two of the units of the coarse sum and of the fine sum.
    pub(super) fn units(self) -> [i32; 2] {
        [COARSE, FINE].map(|height| self.top + height - FRACTION)
    }

    fn starts(self) -> [f64; 2] {
        [COARSE, FINE].map(|height| 1.5 * power_of_two(self.top + height))
    }
}

/// Coarse and fine sum in each lane. The fine sum collects the part that the coarse sum cuts off.
#[derive(Clone, Copy)]
pub(super) struct GridSum<V> {
    start: [V; 2],
    coarse: V,
    fine: V,
}

impl<V: Vector> GridSum<V> {
    /// Empty sum.
    #[inline(always)]
    pub(super) fn new(proof: V::Proof, grid: Grid) -> GridSum<V> {
        let [coarse, fine] = grid.starts();
        let (coarse, fine) = (V::splat(proof, coarse), V::splat(proof, fine));
        GridSum {
            start: [coarse, fine],
            coarse,
            fine,
        }
    }

    /// Adds a value that is zero, or whose exponent is at most `REACH` below `Grid::top`. `one` is 1 in each lane, as for `plus_aside`.
    #[inline(always)]
    pub(super) fn add(&mut self, value: V, one: V) {
        let next = self.coarse.plus(value);
        let taken = next.minus(self.coarse);
        self.coarse = next;
        self.fine = self.fine.plus_aside(value.minus(taken), one);
    }

    /// True if no NaN was added.
    #[inline(always)]
    pub(super) fn is_sound(self) -> bool {
        self.coarse.all_at_most(self.start[0].plus(self.start[0]))
    }

    /// Numbers of units in the coarse sum and in the fine sum, over all lanes; [`Grid::units`] returns the exponents of the units.
    #[inline(always)]
    pub(super) fn units(self) -> [i64; 2] {
        [
            self.coarse.units_above(self.start[0]),
            self.fine.units_above(self.start[1]),
        ]
    }
}

/// Sum of products: the rounded products and, separately, their rounding errors.
#[derive(Clone, Copy)]
pub(super) struct ProductSum<V> {
    rounded: GridSum<V>,
    lost: GridSum<V>,
}

impl<V: Vector> ProductSum<V> {
    /// Empty sum of products of a value on grid `left` and a value on grid `right`.
    #[inline(always)]
    pub(super) fn new(proof: V::Proof, [left, right]: [Grid; 2]) -> ProductSum<V> {
        ProductSum {
            rounded: GridSum::new(proof, left.of_products(right)),
            lost: GridSum::new(proof, left.of_errors_of_products(right)),
        }
    }

    /// Adds the product of two values. Each is zero, or its exponent is at most `REACH_OF_SQUARES` below the top of its grid.
    #[inline(always)]
    pub(super) fn add_product(&mut self, left: V, right: V, one: V) {
        let [rounded, lost] = left.product(right);
        self.rounded.add(rounded, one);
        self.lost.add(lost, one);
    }

    /// True if no NaN was added.
    #[inline(always)]
    pub(super) fn is_sound(self) -> bool {
        self.rounded.is_sound()
    }

    /// Numbers of units in the sum of rounded products and in the sum of their rounding errors.
    #[inline(always)]
    pub(super) fn units(self) -> ProductUnits {
        [self.rounded.units(), self.lost.units()]
    }
}

/// Numbers of units, coarse and fine, of the rounded products and of their rounding errors.
pub(super) type ProductUnits = [[i64; 2]; 2];

/// 2^exponent, for exponents of normal numbers.
pub(super) fn power_of_two(exponent: i32) -> f64 {
    let field = u64::try_from(exponent + 1023).expect("the exponent of a normal number");
    f64::from_bits(field << FRACTION)
}

#[cfg(test)]
mod tests {
    use taceva_core::Isa;

    use super::*;
    use crate::exact::ExactSum;
    use crate::exact::machine::Machine;
    use crate::exact::vector::Job;

    /// Job that adds the values one after another in every lane of a vector.
    struct Add<'a> {
        grid: Grid,
        values: &'a [f64],
    }

    impl Job for Add<'_> {
        type Output = (u32, [i64; 2], ProductUnits);

        #[inline(always)]
        fn run<V: Vector>(self, proof: V::Proof) -> Self::Output {
            let mut sum = GridSum::<V>::new(proof, self.grid);
            let mut squares = ProductSum::<V>::new(proof, [self.grid; 2]);
            let one = V::splat(proof, 1.0);
            for &value in self.values {
                let value = V::splat(proof, value);
                sum.add(value, one);
                squares.add_product(value, value, one);
            }
            assert!(sum.is_sound() && squares.is_sound());
            let lanes = u32::try_from(V::LANES).expect("a few");
            (lanes, sum.units(), squares.units())
        }
    }

    fn exact(grid: Grid, units: [i64; 2], sum: &mut ExactSum) {
        for (units, unit) in units.into_iter().zip(grid.units()) {
            sum.add_units(units, unit);
        }
    }

    #[test]
    fn a_full_lane_of_the_greatest_and_least_values_of_a_grid_loses_nothing() {
        for top in [-400, -1, 0, 400] {
            let grid = Grid { top };
            let greatest = f64::from_bits(power_of_two(top + 1).to_bits() - 1);
            let least = f64::from_bits(power_of_two(top - Grid::REACH_OF_SQUARES).to_bits() + 1);
            let up = vec![greatest; DEPTH];
            let down = vec![-greatest; DEPTH];
            let mixed: Vec<f64> = (0..DEPTH / 2).flat_map(|_| [least, -greatest]).collect();
            for values in [up, down, mixed] {
                for isa in Isa::available() {
                    let machine = Machine::with(isa).expect("it is available");
                    let values = &values;
                    let (lanes, units, squares) = machine.run(Add { grid, values });
                    let (mut sum, mut of_squares) = (ExactSum::default(), ExactSum::default());
                    for _ in 0..lanes {
                        values.iter().for_each(|&value| sum.add(-value));
                        values
                            .iter()
                            .for_each(|&value| of_squares.add_product(value, -value));
                    }
                    exact(grid, units, &mut sum);
                    exact(grid.of_products(grid), squares[0], &mut of_squares);
                    exact(
                        grid.of_errors_of_products(grid),
                        squares[1],
                        &mut of_squares,
                    );
                    assert_eq!(sum, ExactSum::default(), "{isa}, 2^{top}");
                    assert_eq!(of_squares, ExactSum::default(), "{isa}, 2^{top}, squares");
                }
            }
        }
    }
}
