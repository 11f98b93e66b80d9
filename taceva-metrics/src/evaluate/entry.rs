//! One finished score with the metric and the channel that it is of.

use crate::evaluate::metric::Metric;
use crate::score::Score;

/// One score, with what it is of.
#[derive(Clone, Debug)]
pub(crate) struct Entry {
    pub(crate) metric: &'static Metric,
    pub(crate) channel: String,
    pub(crate) score: Score,
}
