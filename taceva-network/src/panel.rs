//! Channels come in panels of sixteen, and tensors begin where a cache line begins.

use std::ops::{Deref, DerefMut};

/// Channels that lie beside each other in every tensor: a cache line of numbers, and a multiple of every vector.
pub(crate) const PANEL: usize = 16;

/// Numbers that begin where a cache line begins, so that no vector of a panel lies across two.
#[derive(Debug)]
pub(crate) struct Aligned {
    /// The numbers, after those that are skipped.
    values: Vec<f32>,
    skipped: usize,
}

impl Aligned {
    /// `length` zeros.
    pub(crate) fn zeros(length: usize) -> Aligned {
        const LINE: usize = 64;
        let values = vec![0.0; length + PANEL];
        let skipped = values.as_ptr().align_offset(LINE).min(PANEL);
        let mut aligned = Aligned { values, skipped };
        aligned.values.truncate(skipped + length);
        aligned
    }

    /// A copy of `values`.
    pub(crate) fn of(values: &[f32]) -> Aligned {
        let mut aligned = Aligned::zeros(values.len());
        aligned.copy_from_slice(values);
        aligned
    }
}

impl Clone for Aligned {
    /// A copy that is aligned too, wherever it comes to lie.
    fn clone(&self) -> Aligned {
        Aligned::of(self)
    }
}

impl Deref for Aligned {
    type Target = [f32];

    fn deref(&self) -> &[f32] {
        &self.values[self.skipped..]
    }
}

impl DerefMut for Aligned {
    fn deref_mut(&mut self) -> &mut [f32] {
        &mut self.values[self.skipped..]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_begin_a_cache_line_and_keep_their_length() {
        for length in [0, 1, 15, 16, 1000] {
            let numbers = Aligned::of(&vec![2.0; length]).clone();
            assert_eq!(numbers.len(), length);
            assert_eq!(numbers.as_ptr().align_offset(64), 0);
            assert!(
                numbers
                    .iter()
                    .all(|number| number.to_bits() == 2.0_f32.to_bits())
            );
        }
    }
}
