//! Bounds on the values of pairs. Within the bounds, vector sums of a block are exact.

use super::grid::{Grid, power_of_two};
use super::vector::Vector;
use crate::exact::streams::{Stream, Streams};
use crate::pair::Paired;

/// Greatest exponent of two of a grid. Squares cannot overflow, and the rounding errors of squares cannot underflow.
const GREATEST_TOP: i32 = 400;
/// Grid of the terms of sMAPE, which are at most 2 before rounding.
pub(super) const TERMS: Grid = Grid { top: 1 };

/// Grids that fit the residuals and the truths of a set of pairs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Grids {
    /// Grid of the residuals, truth − prediction.
    pub(super) residual: Grid,
    /// Grid of the truths.
    pub(super) truth: Grid,
}

/// Range of magnitudes from `least` to `greatest`, and zero.
#[derive(Clone, Copy, Debug)]
pub(super) struct Range {
    pub(super) least: f64,
    pub(super) greatest: f64,
}

impl Range {
    /// Range of magnitudes whose exponents of two are `top` − `reach` to `top`.
    pub(super) fn new(top: i32, reach: i32) -> Range {
        Range {
            least: power_of_two((top - reach).max(-1022)),
            greatest: f64::from_bits(power_of_two(top + 1).to_bits() - 1),
        }
    }

    pub(super) fn holds(self, magnitude: f64) -> bool {
        (magnitude == 0.0) | ((self.least <= magnitude) & (magnitude <= self.greatest))
    }
}

/// Range with the same bounds in every lane of a vector.
pub(super) struct RangeInLanes<V> {
    below_least: V,
    greatest: V,
}

impl Range {
    #[inline(always)]
    pub(super) fn in_lanes<V: Vector>(self, proof: V::Proof) -> RangeInLanes<V> {
        RangeInLanes {
            below_least: V::splat(proof, self.least).predecessor(),
            greatest: V::splat(proof, self.greatest),
        }
    }
}

impl<V: Vector> RangeInLanes<V> {
    /// True if all magnitudes are within the range. `greatest` is the greatest magnitude, `below_least` the predecessor of the least nonzero
    /// magnitude.
    #[inline(always)]
    pub(super) fn hold(self, below_least: V, greatest: V) -> bool {
        greatest.all_at_most(self.greatest) && self.below_least.all_at_most(below_least)
    }
}

/// Bounds on residuals (truth − prediction) and on truths that keep the sums of the requested streams exact.
///
/// The magnitude of a prediction is at most the sum of both magnitudes, and needs no bounds of its own.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    pub(super) residual: Range,
    pub(super) truth: Range,
}

impl Bounds {
    pub(super) fn new(grids: Grids, streams: Streams) -> Bounds {
        let reach = |square| {
            if streams.contains(square) {
                Grid::REACH_OF_SQUARES
            } else {
                Grid::REACH
            }
        };
        let (residual, truth) = (grids.residual.top, grids.truth.top);
        let mut of_residual = reach(Stream::Squared);
        if streams.contains(Stream::Symmetric) {
            of_residual = of_residual.min(residual - least_residual_of_terms(residual, truth));
        }
        let values = Streams::of(&[Stream::Truth, Stream::TruthSquared]);
        Bounds {
            residual: Range::new(residual, of_residual),
            truth: if streams.intersects(values) {
                Range::new(truth, reach(Stream::TruthSquared))
            } else {
                // No stream sums y. The range only keeps the terms of sMAPE from overflowing.
                Range {
                    least: f64::from_bits(1),
                    ..Range::new(truth, 0)
                }
            },
        }
    }

    /// True if `pair` is within the bounds.
    pub(super) fn hold(&self, pair: Paired<f64>) -> bool {
        self.residual.holds(pair.residual().abs()) & self.truth.holds(pair.reference.abs())
    }
}

/// Least exponent of a residual whose sMAPE term fits the grid of terms, from the greatest exponents of residuals and truths.
///
/// For truth y, prediction ŷ and residual d = y − ŷ, the divisor of the term is (|y| + |ŷ|) / 2 + ε, with ε < 2⁻²⁶. Up to rounding, the divisor is
/// below |y| + |d| + ε. If m is the greatest exponent of these three summands, the divisor is below 2^(m+3).
fn least_residual_of_terms(residual: i32, truth: i32) -> i32 {
    let divisor = residual.max(truth).max(-27) + 3;
    TERMS.top - Grid::REACH + divisor
}

impl Grids {
    /// Grids that fit as many of `pairs` as possible.
    pub(super) fn fitting(pairs: Paired<&[f64]>, streams: Streams) -> Grids {
        let residuals = pairs.iter().map(|pair| pair.residual());
        let values = Streams::of(&[Stream::Truth, Stream::TruthSquared]);
        let truth = if streams.intersects(values) {
            best_top(pairs.reference.iter().copied(), Grid::REACH_OF_SQUARES)
        } else if streams.contains(Stream::Symmetric) {
            best_top(pairs.reference.iter().copied(), 2 * GREATEST_TOP)
        } else {
            GREATEST_TOP
        };
        Grids {
            residual: Grid {
                top: best_top(residuals, Grid::REACH_OF_SQUARES),
            },
            truth: Grid { top: truth },
        }
    }
}

/// Greatest of the `reach` + 1 successive exponents that contain most of `values`. If these values span fewer exponents, the result is one higher, so
/// that a slightly greater value fits too.
pub(super) fn best_top(values: impl Iterator<Item = f64>, reach: i32) -> i32 {
    let usable = -GREATEST_TOP..=GREATEST_TOP;
    let mut exponents: Vec<i32> = values
        .filter(|value| value.abs() > 0.0)
        .map(exponent)
        .filter(|exponent| usable.contains(exponent))
        .collect();
    exponents.sort_unstable();
    let (mut first, mut most, mut top, mut headroom) = (0, 0, 0, 0);
    for (last, &exponent) in exponents.iter().enumerate() {
        while exponents[first] < exponent - reach {
            first += 1;
        }
        if last - first >= most {
            (most, top) = (last - first, exponent);
            headroom = exponents[first] + reach - exponent;
        }
    }
    (top + headroom.min(1)).min(GREATEST_TOP)
}

/// Exponent of the leading bit of a normal number; for other numbers, an exponent outside all grids.
fn exponent(value: f64) -> i32 {
    let field = (value.to_bits() >> 52) & 0x7ff;
    i32::try_from(field).expect("eleven bits") - 1023
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_top_is_where_most_values_are_whatever_lies_far_off() {
        let values = [1e300, 4.0, 3.0, 0.0, 2.5, 1e-300, f64::NAN, f64::INFINITY];
        assert_eq!(best_top(values.into_iter(), 16), 3);
        assert_eq!(best_top([4.0, 1.0].into_iter(), 2), 2, "no room above");
        assert_eq!(best_top([0.0].into_iter(), 16), 0);
        assert_eq!(best_top([f64::from_bits(1)].into_iter(), 16), 0);
    }

    #[test]
    fn bounds_hold_zeros_and_refuse_what_is_no_number() {
        let grids = Grids {
            residual: Grid { top: 0 },
            truth: Grid { top: 3 },
        };
        let bounds = Bounds::new(grids, Streams::ALL);
        let hold = |estimate, reference| {
            bounds.hold(Paired {
                estimate,
                reference,
            })
        };
        assert!(hold(0.0, -0.0) && hold(7.5, 7.0) && hold(1.0, 1.0));
        assert!(!hold(f64::NAN, 1.0) && !hold(1.0, f64::NAN) && !hold(f64::INFINITY, 1.0));
        assert!(!hold(2.0, 0.0) && !hold(16.5, 16.0) && !hold(1.0, 1.0 + 1e-9));
    }
}
