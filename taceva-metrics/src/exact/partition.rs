//! Partition of a block into rows that fit its grids and other rows, the strays.

use std::ops::Range;

use super::bounds::Bounds;
use super::kernel::BLOCK_ROWS;
use crate::pair::Paired;

/// Rows of a block. The rows that fit the grids come first, and then the other rows, the strays.
pub(super) struct Parts {
    estimate: [f64; BLOCK_ROWS],
    reference: [f64; BLOCK_ROWS],
    pub(super) strays: usize,
}

impl Parts {
    /// Copies pairs within `bounds` to the front, and other pairs to the end.
    pub(super) fn divide(&mut self, pairs: Paired<&[f64]>, bounds: &Bounds) {
        let (mut fitting, mut strays) = (0, 0);
        for pair in pairs.iter() {
            let fits = bounds.hold(pair);
            // Avoids a branch, which would be mispredicted at each stray.
            let place = if fits {
                fitting
            } else {
                pairs.estimate.len() - 1 - strays
            };
            (self.estimate[place], self.reference[place]) = (pair.estimate, pair.reference);
            fitting += usize::from(fits);
            strays += usize::from(!fits);
        }
        self.strays = strays;
    }

    pub(super) fn rows(&self, rows: Range<usize>) -> Paired<&[f64]> {
        Paired {
            estimate: &self.estimate[rows.clone()],
            reference: &self.reference[rows],
        }
    }
}

impl Default for Parts {
    fn default() -> Parts {
        Parts {
            estimate: [0.0; BLOCK_ROWS],
            reference: [0.0; BLOCK_ROWS],
            strays: 0,
        }
    }
}
