//! The faults that occurred.

use std::sync::atomic::{AtomicU64, Ordering};

use super::FaultKind;

/// How often each kind of fault has happened; shared by a wrapper and whoever watches it.
#[derive(Debug, Default)]
pub struct FaultLog {
    counts: [AtomicU64; FaultKind::ALL.len()],
}

impl FaultLog {
    /// How often `kind` has happened.
    pub fn count(&self, kind: FaultKind) -> u64 {
        self.counts[kind as usize].load(Ordering::Relaxed)
    }

    pub(super) fn note(&self, kind: FaultKind) {
        self.counts[kind as usize].fetch_add(1, Ordering::Relaxed);
    }
}
