//! Which metrics are computed, which are not and why, and what that takes.

use std::collections::BTreeMap;

use taceva_core::{Channels, Field, FieldSet, SkipReason, Skipped};

use crate::error::MetricError;
use crate::evaluate::accumulator::Accumulator;
use crate::evaluate::facts::SensorFacts;
use crate::evaluate::settings::Settings;
use crate::families::accuracy::{Pairs, Plane};
use crate::families::bias_level::Levels;
use crate::families::channelwise::{ByChannel, Channelwise};
use crate::families::crosstalk::Crosstalk;
use crate::families::detection::Idle;
use crate::families::drift::Drifts;
use crate::families::family::Family;
use crate::families::hysteresis::Loops;
use crate::families::inter_sensor::InterSensor;
use crate::families::intrinsic::{self, Intrinsic};
use crate::families::lighting::Lighting;
use crate::families::linearity::Lines;
use crate::families::repeatability::Repeats;
use crate::families::resolution::Resolution;
use crate::families::spatial::Spatial;
use crate::families::surface::Surface;
use crate::families::tolerance::Tolerances;
use crate::metric::{Formula, Metric};
use crate::paired::is_valid;
use crate::stats::IntervalMethod;

/// What an evaluation of given channels and fields will compute.
///
/// ```
/// use taceva_core::{Channel, Channels, FieldSet};
/// use taceva_metrics::{MetricPlan, catalogue};
/// let channels = Channels::new([Channel::FZ])?;
/// let plan = MetricPlan::new(&catalogue::ALL, channels, FieldSet::PAIRS);
/// assert_eq!(plan.skipped()[0].reason.to_string(), "nothing is scored on a channel `Px`");
/// # Ok::<(), taceva_core::ChannelError>(())
/// ```
#[derive(Clone, Debug)]
pub struct MetricPlan {
    wanted: Vec<&'static Metric>,
    available: FieldSet,
    channels: Channels,
    facts: SensorFacts,
    settings: Settings,
    kept: Vec<&'static Metric>,
    skipped: Vec<Skipped>,
    fields: FieldSet,
    seed: u64,
    interval_method: IntervalMethod,
    constants: BTreeMap<String, f64>,
    independent: bool,
}

impl MetricPlan {
    /// Keeps of `wanted` what samples with these channels and fields allow, in the order of reports.
    pub fn new(wanted: &[&'static Metric], channels: Channels, available: FieldSet) -> MetricPlan {
        let in_order = crate::catalogue::ALL.into_iter();
        let wanted = in_order.filter(|metric| wanted.iter().any(|wanted| wanted.id == metric.id));
        let plan = MetricPlan {
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
            independent: false,
        };
        plan.decided()
    }

    /// The same plan for a sensor of which `facts` are known: what they allow is kept too.
    ///
    /// ```
    /// use taceva_core::{Channel, Channels, FieldSet, Footprint};
    /// use taceva_metrics::{MetricPlan, SensorFacts, catalogue};
    /// let channels = Channels::new([Channel::PX, Channel::PY, Channel::PZ, Channel::FZ])?;
    /// let plan = MetricPlan::new(&catalogue::select(["uniformity"])?, channels, FieldSet::PAIRS);
    /// assert_eq!(plan.skipped()[0].reason.to_string(), "the sensor's `footprint` is not declared");
    /// let footprint = Some(Footprint::disc(12.5, Some(1.0))?);
    /// let plan = plan.with_facts(SensorFacts { footprint, ..SensorFacts::default() });
    /// assert_eq!((plan.kept().len(), plan.skipped().len()), (1, 0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn with_facts(self, facts: SensorFacts) -> MetricPlan {
        MetricPlan { facts, ..self }.decided()
    }

    /// The same plan with other constants where a definition leaves one open.
    ///
    /// # Errors
    /// [`MetricError::Setting`] for one with which no score is meant.
    pub fn with_settings(self, settings: Settings) -> Result<MetricPlan, MetricError> {
        settings.check()?;
        Ok(MetricPlan { settings, ..self })
    }

    /// Decides what is kept and what is read.
    fn decided(mut self) -> MetricPlan {
        self.kept.clear();
        self.skipped.clear();
        self.fields = FieldSet::EMPTY;
        for metric in self.wanted.clone() {
            match self.obstacle(metric) {
                Some(reason) => self.skipped.push(Skipped {
                    what: format!("metric:{}", metric.id),
                    reason,
                }),
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

    /// The same plan for samples that do not depend on each other: every sample is a cluster of its own in the intervals of errors, R², skill,
    /// planes, linearity, cross-talk, bias by level and tolerance, and each of these intervals says `samples taken as independent`. Metrics that
    /// ask which samples belong together keep their contact locations.
    ///
    /// Presses at one location are not independent: their intervals would hold the truth too seldom (`docs/coverage.md`). Samples that are equal
    /// in every channel share a cluster, and more than [`NAMED_CLUSTERS`](crate::NAMED_CLUSTERS) are dealt into
    /// [`HASHED_CLUSTERS`](crate::HASHED_CLUSTERS), so that scores depend on the set of samples alone.
    ///
    /// ```
    /// use taceva_metrics::{Channel, Channels, FieldSet, MetricPlan, catalogue};
    /// let channels = Channels::new([Channel::FZ])?;
    /// let plan = MetricPlan::new(&catalogue::ALL, channels, FieldSet::PAIRS).independent_samples();
    /// assert!(plan.takes_samples_as_independent());
    /// # Ok::<(), taceva_metrics::ChannelError>(())
    /// ```
    #[must_use]
    pub fn independent_samples(self) -> MetricPlan {
        MetricPlan {
            independent: true,
            ..self
        }
    }

    /// Whether every sample is a cluster of its own.
    pub fn takes_samples_as_independent(&self) -> bool {
        self.independent
    }

    /// The same plan for a model whose best constant answers are known: by channel the mean of the labels it was fitted on, in the unit of
    /// the channel. Skill is measured by them; of channels that are not named, by the mean of the evaluated truth.
    ///
    /// # Errors
    /// [`MetricError::Setting`] for a constant that is no usable number.
    pub fn with_constants(
        self,
        constants: BTreeMap<String, f64>,
    ) -> Result<MetricPlan, MetricError> {
        if let Some((channel, constant)) = constants.iter().find(|(_, value)| !is_valid(**value)) {
            return Err(MetricError::Setting {
                name: "constant",
                expected: "a finite number".to_owned(),
                found: format!("{constant} of `{channel}`"),
            });
        }
        Ok(MetricPlan { constants, ..self })
    }

    /// The metrics that were asked for.
    pub fn wanted(&self) -> &[&'static Metric] {
        &self.wanted
    }

    /// What samples may carry.
    pub fn available(&self) -> FieldSet {
        self.available
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

    /// What is known of the sensor.
    pub fn facts(&self) -> &SensorFacts {
        &self.facts
    }

    /// The constants where a definition leaves one open.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The best constant answers of the model, by channel, as far as they are known.
    pub fn constants(&self) -> &BTreeMap<String, f64> {
        &self.constants
    }

    /// The best constant answer of the model for the channel called `channel`.
    pub(crate) fn constant(&self, channel: &str) -> Option<f64> {
        self.constants.get(channel).copied()
    }

    /// Whether samples may carry `field`.
    pub(crate) fn carries(&self, field: Field) -> bool {
        self.available.contains(field)
    }

    /// What `metric` reads where samples carry it, and does without where they do not.
    fn optional(&self, metric: &Metric) -> FieldSet {
        let fields = match metric.formula {
            Formula::Intrinsic => intrinsic::OPTIONAL_FIELDS,
            _ => FieldSet::EMPTY,
        };
        fields.iter().filter(|field| self.carries(*field)).collect()
    }

    /// What keeps `metric` from having a value.
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
        let absent_axis = || match metric.formula {
            Formula::Plane(_) => Plane::missing_axis(&self.channels),
            _ => None,
        };
        absent_channel
            .or_else(absent_axis)
            .map(|name| SkipReason::ChannelAbsent(name.to_owned()))
            .or_else(|| {
                let facts = metric.facts.iter();
                facts.filter_map(|fact| fact.obstacle(&self.facts)).next()
            })
            .or_else(|| match metric.formula {
                Formula::Intrinsic => Intrinsic::obstacle(self),
                _ => None,
            })
    }

    /// One accumulator for all metrics that share what is kept.
    pub(crate) fn accumulators(&self) -> Vec<Accumulator> {
        let families = [
            Pairs::for_plan(self).map(|family| self.by_row(family)),
            Plane::for_metrics(&self.kept, &self.channels).map(|family| self.by_row(family)),
            Resolution::for_plan(self).map(|family| self.clustered(family)),
            Surface::for_plan(self).map(|family| self.clustered(family)),
            Spatial::for_plan(self).map(|family| self.clustered(family)),
            Lighting::for_plan(self).map(|family| self.clustered(family)),
            self.by_channel(Repeats, MetricPlan::clustered),
            Loops::for_plan(self).map(|family| self.clustered(family)),
            InterSensor::for_plan(self).map(|family| self.clustered(family)),
            Intrinsic::for_plan(self).map(|family| self.clustered(family)),
            Idle::for_plan(self).and_then(|kind| self.by_channel(kind, MetricPlan::clustered)),
            self.by_channel(Lines, MetricPlan::by_row),
            Crosstalk::for_plan(self).map(|family| self.by_row(family)),
            self.by_channel(Levels, MetricPlan::by_row),
            self.by_channel(Tolerances, MetricPlan::by_row),
            self.by_channel(Drifts, MetricPlan::clustered),
        ];
        families.into_iter().flatten().collect()
    }

    fn by_channel<K>(
        &self,
        kind: K,
        clustered: fn(&MetricPlan, ByChannel<K>) -> Accumulator,
    ) -> Option<Accumulator>
    where
        K: Channelwise,
    {
        ByChannel::for_plan(kind, self).map(|family| clustered(self, family))
    }

    /// An accumulator whose clusters are rows where samples are taken as independent.
    fn by_row<F>(&self, family: F) -> Accumulator
    where
        F: Family,
    {
        Accumulator::new(family, self).with_rows_as_clusters(self.independent)
    }

    fn clustered<F>(&self, family: F) -> Accumulator
    where
        F: Family,
    {
        Accumulator::new(family, self)
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
        let wanted = catalogue::select(["accuracy", "mae_euclid"]).expect("known names");
        let plan = MetricPlan::new(&wanted, channels, available);
        assert_eq!((plan.skipped(), plan.fields()), (&[][..], available));
        assert_eq!(plan.accumulators().len(), 2);
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
            [Skipped {
                what: "metric:mae_euclid".into(),
                reason: SkipReason::ChannelAbsent("Fy".into())
            }]
        );
    }
}
