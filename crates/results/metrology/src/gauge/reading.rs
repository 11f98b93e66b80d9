//! Readings of a study.

/// Reading with numbers in place of labels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reading {
    pub(super) part: usize,
    pub(super) operator: usize,
    pub(super) trial: usize,
    pub(super) value: f64,
}
