//! Counts of faults that occurred.

use std::sync::atomic::{AtomicU64, Ordering};

use super::FaultKind;

/// Counts of each kind of fault, shared by a wrapper and its observer.
#[derive(Debug, Default)]
pub struct FaultLog {
    counts: [AtomicU64; FaultKind::ALL.len()],
}

impl FaultLog {
    /// Number of faults of `kind` so far.
    pub fn count(&self, kind: FaultKind) -> u64 {
        self.counts[kind as usize].load(Ordering::Relaxed)
    }

    pub(super) fn note(&self, kind: FaultKind) {
        self.counts[kind as usize].fetch_add(1, Ordering::Relaxed);
    }
}
