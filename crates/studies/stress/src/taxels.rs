//! Signals of taxels, which a fault can change.

use taceva_core::random::Draws;
use taceva_core::single;

/// Note in the report on faults of taxels.
pub(crate) const BY_PARAMETER: &str = "its severity is its parameter, not a stimulus";

/// Change that a fault makes to signals.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TaxelChange {
    /// True if the change grows with time.
    pub(crate) grows: bool,
    /// Function that changes the signals of all taxels, given taxel by taxel.
    pub(crate) change: fn(&mut [f32], &TaxelDraw<'_>),
}

/// Parameter and random numbers of a fault of taxels.
pub(crate) struct TaxelDraw<'a> {
    pub(crate) parameter: f64,
    /// Number of channels of a taxel.
    pub(crate) channels: usize,
    /// Greatest change by contact of each channel of a taxel, over all taxels.
    pub(crate) full_scale: &'a [f64],
    /// Time since the first sample, h.
    pub(crate) hours: f64,
    pub(crate) draws: Draws,
}

impl TaxelDraw<'_> {
    /// Random sign with the index `counter`: 1 or −1, with equal probability.
    pub(crate) fn sign(&self, counter: u64) -> f64 {
        match self.draws.unit(counter) < 0.5 {
            true => 1.0,
            false => -1.0,
        }
    }
}

/// Rounds to single precision. A number beyond its range becomes the nearest finite number.
pub(crate) fn finite(number: f64) -> f32 {
    single(number).clamp(f32::MIN, f32::MAX)
}
