//! Memory alignment. Channels are stored in panels of sixteen, and tensors start at a cache line.

use std::ops::{Deref, DerefMut};

use crate::error::NetworkError;

/// Number of channels per panel: one cache line of f32 values, and a multiple of every vector width.
pub(crate) const PANEL: usize = 16;

/// Values aligned to a cache line. No vector of a panel therefore crosses a cache line.
#[derive(Debug)]
pub(crate) struct Aligned {
    /// Aligned values, preceded by `skipped` unused values.
    values: Vec<f32>,
    skipped: usize,
}

impl Aligned {
    /// Allocates `length` zeros.
    pub(crate) fn zeros(length: usize) -> Aligned {
        Aligned::within(vec![0.0; length + PANEL], length)
    }

    /// Allocates `length` zeros. Returns an error if the allocation fails.
    ///
    /// # Errors
    /// [`NetworkError::Memory`] if there is too little memory.
    pub(crate) fn try_zeros(length: usize) -> Result<Aligned, NetworkError> {
        let room = length.saturating_add(PANEL);
        let mut values = Vec::new();
        let reserved = values.try_reserve_exact(room);
        reserved.map_err(|_| NetworkError::Memory {
            bytes: length.saturating_mul(size_of::<f32>()),
        })?;
        values.resize(room, 0.0);
        Ok(Aligned::within(values, length))
    }

    /// Uses `length` values of `values`, starting at the first cache line. `values` must have at least `PANEL` more values than `length`.
    fn within(values: Vec<f32>, length: usize) -> Aligned {
        const LINE: usize = 64;
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
    /// Copies the values to a new aligned allocation.
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
    fn more_numbers_than_memory_can_have_are_refused_with_their_bytes() {
        for length in [usize::MAX / 8, usize::MAX] {
            let refused = Aligned::try_zeros(length).map(|_| ());
            let bytes = length.saturating_mul(4);
            assert_eq!(refused, Err(NetworkError::Memory { bytes }));
        }
    }

    #[test]
    fn numbers_begin_a_cache_line_and_keep_their_length() {
        for length in [0, 1, 15, 16, 1000] {
            let numbers = Aligned::of(&vec![2.0; length]).clone();
            let zeros = Aligned::try_zeros(length).expect("a few numbers");
            assert_eq!((numbers.len(), zeros.len()), (length, length));
            assert_eq!(zeros.as_ptr().align_offset(64), 0);
            assert_eq!(numbers.as_ptr().align_offset(64), 0);
            assert!(
                numbers
                    .iter()
                    .all(|number| number.to_bits() == 2.0_f32.to_bits())
            );
        }
    }
}
