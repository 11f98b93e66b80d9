//! Unpacked sizes of the datasets of a file, checked against its stored size.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use crate::error::Problem;
use crate::limits;

/// Unpacked size of each opened dataset by its index, bytes.
#[derive(Debug, Default)]
pub(super) struct UnpackedSizes(Mutex<BTreeMap<usize, u64>>);

impl UnpackedSizes {
    /// Records that the dataset `index` takes `bytes` bytes unpacked, in a file of `stored` bytes.
    ///
    /// # Errors
    /// [`Problem::TooLarge`] for a file that would exhaust memory or time. Nothing was unpacked.
    pub(super) fn take(&self, index: usize, bytes: u64, stored: u64) -> Result<(), Problem> {
        let mut each = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        each.insert(index, bytes);
        let all = each
            .values()
            .fold(0, |all: u64, bytes| all.saturating_add(*bytes));
        let most = limits::unpacked_bytes(stored);
        match all <= most {
            true => Ok(()),
            false => Err(Problem::too_large(
                format!(
                    "bytes of its decompressed arrays, {} times the size of the file (write it with less compression, or in several files)",
                    all / stored.max(1)
                ),
                all,
                most,
            )),
        }
    }
}
