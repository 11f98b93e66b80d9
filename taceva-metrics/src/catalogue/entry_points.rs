//! Constructors of plans, evaluators and evaluations that use the whole catalogue.

use taceva_core::{Channel, ChannelError, Channels, FieldSet, Skipped};

use super::ALL;
use crate::evaluate::metric::Metric;
use crate::evaluate::{Evaluation, Evaluator, MetricPlan};

impl MetricPlan {
    /// Plan with the metrics of `wanted` that the `channels` and the `available` fields allow, in the order of reports.
    pub fn new(wanted: &[&'static Metric], channels: Channels, available: FieldSet) -> MetricPlan {
        MetricPlan::of(&ALL, wanted, channels, available)
    }
}

impl Evaluator {
    /// Evaluator of every metric that needs only truth and prediction of `channels`, and contact points.
    ///
    /// # Errors
    /// [`ChannelError::Twice`] if a channel occurs twice.
    ///
    /// ```
    /// use taceva_metrics::{Channel, Evaluator};
    /// let mut evaluator = Evaluator::of_channels([Channel::FZ])?;
    /// evaluator.update_pairs(Channel::FZ, &[0.25, 0.5], &[0.5, 0.5])?;
    /// assert_eq!(evaluator.score()?.mae(Channel::FZ).and_then(|score| score.value.scalar()), Some(0.125));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn of_channels(
        channels: impl IntoIterator<Item = Channel>,
    ) -> Result<Evaluator, ChannelError> {
        let channels = Channels::new(channels)?;
        let plan = MetricPlan::new(&ALL, channels, FieldSet::PAIRS);
        Ok(Evaluator::new(&plan))
    }
}

impl Evaluation {
    /// Combines the scores of `parts` into one evaluation, in the order of reports. `skipped` lists metrics that no part contains.
    ///
    /// Use this function if the parts come from different samples, because their sums are not merged. The skill of a channel in any part sets the
    /// standing of all scores of the channel.
    pub fn joined(
        parts: impl IntoIterator<Item = Evaluation>,
        skipped: Vec<Skipped>,
    ) -> Evaluation {
        Evaluation::in_order(&ALL, parts, skipped)
    }
}
