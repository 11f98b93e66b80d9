//! One reading of a study.

/// Reading whose labels are numbers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reading {
    pub(super) part: usize,
    pub(super) operator: usize,
    pub(super) trial: usize,
    pub(super) value: f64,
}
