//! One finished score with its metric and channel.

use crate::evaluate::metric::Metric;
use crate::score::Score;

/// One score with its metric and channel.
#[derive(Clone, Debug)]
pub(crate) struct Entry {
    pub(crate) metric: &'static Metric,
    pub(crate) channel: String,
    pub(crate) score: Score,
}
