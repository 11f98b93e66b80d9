//! Selection of a plan's metrics and of the fields that they read.

use std::collections::BTreeMap;

use taceva_core::{Channels, Field, FieldSet, SkipReason, Skipped};

use super::MetricPlan;
use crate::evaluate::metric::Metric;
use crate::evaluate::settings::Settings;
use crate::score::ClusteredBy;
use crate::score::sensor_facts::SensorFacts;
use crate::stats::IntervalMethod;

impl MetricPlan {
    /// Plan with the `wanted` metrics that these channels and fields allow, in the order of `catalogue`.
    pub(crate) fn of(
        catalogue: &'static [&'static Metric],
        wanted: &[&'static Metric],
        channels: Channels,
        available: FieldSet,
    ) -> MetricPlan {
        let in_order = catalogue.iter().copied();
        let wanted = in_order.filter(|metric| wanted.iter().any(|wanted| wanted.id == metric.id));
        let plan = MetricPlan {
            catalogue,
            wanted: wanted.collect(),
            available,
            channels,
            facts: SensorFacts::default(),
            settings: Settings::default(),
            kept: Vec::new(),
            skipped: Vec::new(),
            fields: FieldSet::EMPTY,
            seed: 0,
            interval_method: IntervalMethod::default(),
            constants: BTreeMap::new(),
            clustered_by: ClusteredBy::Point,
        };
        plan.decided()
    }

    /// The same plan with `facts` about the sensor, and the additional metrics that these facts allow.
    ///
    /// ```
    /// use taceva_metrics::{Channel, Channels, FieldSet, Footprint, MetricPlan, SensorFacts, catalogue};
    /// let channels = Channels::new([Channel::PX, Channel::PY, Channel::PZ, Channel::FZ])?;
    /// let plan = MetricPlan::new(&catalogue::select(["uniformity"])?, channels, FieldSet::PAIRS);
    /// assert_eq!(plan.skipped()[0].reason.to_string(), "the sensor's `footprint` is not declared");
    /// let footprint = Some(Footprint::disc(12.5, Some(1.0))?);
    /// let plan = plan.with_facts(SensorFacts::default().with_footprint(footprint));
    /// assert_eq!((plan.kept().len(), plan.skipped().len()), (1, 0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn with_facts(self, facts: SensorFacts) -> MetricPlan {
        MetricPlan { facts, ..self }.decided()
    }

    /// Selects the metrics to compute and the fields to read.
    fn decided(mut self) -> MetricPlan {
        self.kept.clear();
        self.skipped.clear();
        self.fields = FieldSet::EMPTY;
        for metric in self.wanted.clone() {
            match self.obstacle(metric) {
                Some(reason) => self
                    .skipped
                    .push(Skipped::new(format!("metric:{}", metric.id), reason)),
                None => {
                    self.kept.push(metric);
                    self.fields = self.fields | metric.needs.fields | self.optional(metric);
                }
            }
        }
        if !self.kept.is_empty() && self.available.contains(Field::Point) {
            self.fields = self.fields.with(Field::Point);
        }
        self
    }

    /// Optional fields of `metric` that samples have.
    fn optional(&self, metric: &Metric) -> FieldSet {
        let fields = metric.family.optional;
        fields.iter().filter(|field| self.carries(*field)).collect()
    }

    /// Reason why `metric` can have no value; `None` if a value is possible.
    fn obstacle(&self, metric: &Metric) -> Option<SkipReason> {
        let absent_field = metric
            .needs
            .fields
            .iter()
            .find(|field| !self.available.contains(*field));
        if let Some(field) = absent_field {
            return Some(SkipReason::FieldAbsent(field));
        }
        let absent = |name: &&str| self.channels.position(name).is_none();
        let absent_channel = metric.needs.channels.iter().copied().find(absent);
        absent_channel
            .map(|name| SkipReason::ChannelAbsent(name.to_owned()))
            .or_else(|| {
                let facts = metric.facts.iter();
                facts.filter_map(|fact| fact.obstacle(&self.facts)).next()
            })
            .or_else(|| (metric.family.obstacle)(self))
    }
}

#[cfg(test)]
mod tests {
    use taceva_core::Channel;

    use super::*;
    use crate::catalogue;
    use crate::evaluate::accumulator::Accumulator;

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
        let wanted = catalogue::select(["accuracy", "mae_euclid"]).expect("known names");
        let plan = MetricPlan::new(&wanted, channels, available);
        assert_eq!((plan.skipped(), plan.fields()), (&[][..], available));
        assert_eq!(Accumulator::of_plan(&plan).len(), 2);
    }

    #[test]
    fn metrics_of_the_truth_alone_need_no_predictions() {
        let channels = Channels::new([Channel::PZ, Channel::FZ]).expect("two channels");
        let truth = FieldSet::EMPTY.with(Field::Truth);
        let plan = MetricPlan::new(&catalogue::ALL, channels, truth);
        let kept: Vec<&str> = plan.kept().iter().map(|metric| metric.id).collect();
        assert_eq!((kept, plan.fields()), (vec!["sensitivity"], truth));
    }

    #[test]
    fn half_a_plane_names_the_axis_it_lacks() {
        let channels = Channels::new([Channel::FX]).expect("one channel");
        let wanted = catalogue::select(["mae", "mae_euclid"]).expect("known names");
        let plan = MetricPlan::new(&wanted, channels, FieldSet::PAIRS);
        assert_eq!(
            plan.skipped(),
            [Skipped::new(
                "metric:mae_euclid",
                SkipReason::ChannelAbsent("Fy".into())
            )]
        );
    }
}
