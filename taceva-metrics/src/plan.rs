//! Which metrics are computed, which are not and why, and what that takes.

use taceva_core::{Channels, Field, FieldSet, SkipReason, Skipped};

use crate::accumulator::{Accumulator, Clustered, Family, Pairs, Plane};
use crate::metric::{Formula, Metric};
use crate::stats::IntervalMethod;

/// What an evaluation of given channels and fields will compute.
///
/// ```
/// use taceva_core::{Channel, Channels, FieldSet};
/// use taceva_metrics::{MetricPlan, catalogue};
/// let channels = Channels::new([Channel::FZ])?;
/// let plan = MetricPlan::new(&catalogue::ALL, channels, FieldSet::PAIRS);
/// assert_eq!(plan.skipped()[0].reason.to_string(), "there is no channel `Px`");
/// # Ok::<(), taceva_core::ChannelError>(())
/// ```
#[derive(Clone, Debug)]
pub struct MetricPlan {
    kept: Vec<&'static Metric>,
    skipped: Vec<Skipped>,
    channels: Channels,
    fields: FieldSet,
    seed: u64,
    interval_method: IntervalMethod,
}

impl MetricPlan {
    /// Keeps of `wanted` what samples with these channels and fields allow, in the order of reports.
    pub fn new(wanted: &[&'static Metric], channels: Channels, available: FieldSet) -> MetricPlan {
        let mut plan = MetricPlan {
            kept: Vec::new(),
            skipped: Vec::new(),
            channels,
            fields: FieldSet::EMPTY,
            seed: 0,
            interval_method: IntervalMethod::default(),
        };
        let in_order = crate::catalogue::ALL.into_iter();
        for metric in in_order.filter(|metric| wanted.iter().any(|wanted| wanted.id == metric.id)) {
            match plan.obstacle(metric, available) {
                Some(reason) => plan.skipped.push(Skipped {
                    what: format!("metric:{}", metric.id),
                    reason,
                }),
                None => {
                    plan.kept.push(metric);
                    plan.fields = plan.fields | metric.needs.fields;
                }
            }
        }
        if !plan.kept.is_empty() && available.contains(Field::Point) {
            plan.fields = plan.fields.with(Field::Point);
        }
        plan
    }

    /// The same plan with another seed of the hash that deals contact locations into clusters.
    #[must_use]
    pub fn with_seed(self, seed: u64) -> MetricPlan {
        MetricPlan { seed, ..self }
    }

    /// The same plan with intervals found another way.
    ///
    /// ```
    /// use taceva_core::{Channel, Channels, FieldSet};
    /// use taceva_metrics::{IntervalMethod, MetricPlan, PoissonBootstrap, catalogue};
    /// let bootstrap = PoissonBootstrap { replicates: 2000, seed: 7, ..PoissonBootstrap::default() };
    /// let plan = MetricPlan::new(&catalogue::ALL, Channels::new([Channel::FZ])?, FieldSet::PAIRS)
    ///     .with_interval_method(IntervalMethod::PoissonBootstrap(bootstrap));
    /// # assert_eq!(plan.interval_method(), IntervalMethod::PoissonBootstrap(bootstrap));
    /// # Ok::<(), taceva_core::ChannelError>(())
    /// ```
    #[must_use]
    pub fn with_interval_method(self, interval_method: IntervalMethod) -> MetricPlan {
        MetricPlan {
            interval_method,
            ..self
        }
    }

    /// The metrics that are computed.
    pub fn kept(&self) -> &[&'static Metric] {
        &self.kept
    }

    /// The metrics that are not, and why.
    pub fn skipped(&self) -> &[Skipped] {
        &self.skipped
    }

    /// The channels of the samples.
    pub fn channels(&self) -> &Channels {
        &self.channels
    }

    /// What is read of a sample.
    pub fn fields(&self) -> FieldSet {
        self.fields
    }

    /// The seed of the hash that deals contact locations into clusters.
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// How intervals are found.
    pub fn interval_method(&self) -> IntervalMethod {
        self.interval_method
    }

    /// What keeps `metric` from having a value.
    fn obstacle(&self, metric: &Metric, available: FieldSet) -> Option<SkipReason> {
        let absent_field = metric
            .needs
            .fields
            .iter()
            .find(|field| !available.contains(*field));
        if let Some(field) = absent_field {
            return Some(SkipReason::FieldAbsent(field));
        }
        let absent = |name: &&str| self.channels.position(name).is_none();
        let absent_channel = metric.needs.channels.iter().copied().find(absent);
        let absent_axis = || match metric.formula {
            Formula::Plane(_) => Plane::missing_axis(&self.channels),
            Formula::Pairs { .. } => None,
        };
        absent_channel
            .or_else(absent_axis)
            .map(|name| SkipReason::ChannelAbsent(name.to_owned()))
    }

    /// One accumulator for all metrics that share what is kept.
    pub(crate) fn accumulators(&self) -> Vec<Box<dyn Accumulator>> {
        let mut accumulators: Vec<Box<dyn Accumulator>> = Vec::new();
        if let Some(pairs) = Pairs::for_metrics(&self.kept, &self.channels) {
            accumulators.push(self.clustered(pairs));
        }
        if let Some(plane) = Plane::for_metrics(&self.kept, &self.channels) {
            accumulators.push(self.clustered(plane));
        }
        accumulators
    }

    fn clustered<F>(&self, family: F) -> Box<dyn Accumulator>
    where
        F: Family + 'static,
    {
        Box::new(Clustered::new(family, self))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue;
    use taceva_core::Channel;

    #[test]
    fn without_predictions_nothing_is_kept_and_nothing_is_read() {
        let channels = Channels::new([Channel::FZ]).expect("one channel");
        let available = FieldSet::PAIRS.without(Field::Prediction);
        let plan = MetricPlan::new(&catalogue::ALL, channels, available);
        assert_eq!((plan.kept().len(), plan.fields()), (0, FieldSet::EMPTY));
        assert_eq!(plan.skipped().len(), catalogue::ALL.len());
        assert_eq!(
            plan.skipped()[0].reason,
            SkipReason::FieldAbsent(Field::Prediction)
        );
    }

    #[test]
    fn samples_without_locations_are_evaluated_all_the_same() {
        let channels = Channels::new([Channel::FX, Channel::FY]).expect("two channels");
        let available = FieldSet::PAIRS.without(Field::Point);
        let plan = MetricPlan::new(&catalogue::ALL, channels, available);
        assert_eq!((plan.skipped(), plan.fields()), (&[][..], available));
        assert_eq!(plan.accumulators().len(), 2);
    }

    #[test]
    fn half_a_plane_names_the_axis_it_lacks() {
        let channels = Channels::new([Channel::FX]).expect("one channel");
        let plan = MetricPlan::new(&catalogue::ALL, channels, FieldSet::PAIRS);
        assert_eq!(
            plan.skipped(),
            [Skipped {
                what: "metric:mae_euclid".into(),
                reason: SkipReason::ChannelAbsent("Fy".into())
            }]
        );
    }
}
