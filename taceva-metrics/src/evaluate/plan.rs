//! Plan of an evaluation: computed metrics, skipped metrics with reasons, and the fields of a sample that the evaluation reads.

mod selection;

use std::collections::BTreeMap;

use taceva_core::{Channels, Field, FieldSet, Skipped};

use crate::error::MetricError;
use crate::evaluate::family::FamilyKind;
use crate::evaluate::metric::Metric;
use crate::evaluate::settings::Settings;
use crate::pair::is_valid;
use crate::score::ClusteredBy;
use crate::score::sensor_facts::SensorFacts;
use crate::stats::IntervalMethod;

/// Plan of an evaluation: the metrics to compute from given channels and fields of samples.
///
/// ```
/// use taceva_metrics::{Channel, Channels, FieldSet, MetricPlan, catalogue};
/// let channels = Channels::new([Channel::FZ])?;
/// let plan = MetricPlan::new(&catalogue::ALL, channels, FieldSet::PAIRS);
/// assert_eq!(plan.skipped()[0].reason.to_string(), "channel `Px` is not scored");
/// # Ok::<(), taceva_metrics::ChannelError>(())
/// ```
#[derive(Clone, Debug)]
pub struct MetricPlan {
    catalogue: &'static [&'static Metric],
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
    clustered_by: ClusteredBy,
}

impl MetricPlan {
    /// The same plan with other constants in the definitions of metrics.
    ///
    /// # Errors
    /// [`MetricError::Setting`] for a value outside the allowed range.
    pub fn with_settings(self, settings: Settings) -> Result<MetricPlan, MetricError> {
        settings.check()?;
        Ok(MetricPlan { settings, ..self })
    }

    /// The same plan with another seed of the hash that assigns contact points to clusters.
    #[must_use]
    pub fn with_seed(self, seed: u64) -> MetricPlan {
        MetricPlan { seed, ..self }
    }

    /// The same plan with another method for confidence intervals.
    ///
    /// ```
    /// use taceva_metrics::{Channel, Channels, FieldSet, IntervalMethod, MetricPlan, PoissonBootstrap, catalogue};
    /// let bootstrap = PoissonBootstrap::DEFAULT.with_replicates(2000).with_seed(7);
    /// let plan = MetricPlan::new(&catalogue::ALL, Channels::new([Channel::FZ])?, FieldSet::PAIRS)
    ///     .with_interval_method(IntervalMethod::PoissonBootstrap(bootstrap));
    /// # assert_eq!(plan.interval_method(), IntervalMethod::PoissonBootstrap(bootstrap));
    /// # Ok::<(), taceva_metrics::ChannelError>(())
    /// ```
    #[must_use]
    pub fn with_interval_method(self, interval_method: IntervalMethod) -> MetricPlan {
        MetricPlan {
            interval_method,
            ..self
        }
    }

    /// The same plan for independent samples. Every sample is then a cluster of its own. This applies to intervals of errors, R², skill, scores of
    /// planes, linearity, cross-talk, bias by level, tolerance, agreement and tolerance interval. The method of these intervals says `samples taken
    /// as independent`. Metrics that compare samples of one contact point still use contact points as clusters.
    ///
    /// Presses at one location are not independent: with single samples as clusters, intervals would contain the truth too seldom
    /// (`docs/coverage.md`). [`Batch::with_samples`](taceva_core::Batch::with_samples) names the clusters. In a batch without these names, samples
    /// that are equal in every channel share a cluster. More than [`NAMED_CLUSTERS`](crate::NAMED_CLUSTERS) clusters are assigned by hash to
    /// [`HASHED_CLUSTERS`](crate::HASHED_CLUSTERS). Scores therefore depend on the set of samples alone.
    ///
    /// ```
    /// use taceva_metrics::{Channel, Channels, ClusteredBy, FieldSet, MetricPlan, catalogue};
    /// let channels = Channels::new([Channel::FZ])?;
    /// let plan = MetricPlan::new(&catalogue::ALL, channels, FieldSet::PAIRS).independent_samples();
    /// assert_eq!(plan.clustered_by(), ClusteredBy::Sample);
    /// # Ok::<(), taceva_metrics::ChannelError>(())
    /// ```
    #[must_use]
    pub fn independent_samples(self) -> MetricPlan {
        MetricPlan {
            clustered_by: ClusteredBy::Sample,
            ..self
        }
    }

    /// The same plan for samples of several recordings. Each recording is a cluster, so intervals show the variation between recordings. This applies
    /// to intervals of errors, R², skill, scores of planes, linearity, cross-talk, bias by level, tolerance, agreement and tolerance interval. The
    /// method of these intervals says `by recording`. Batches name the recording of each sample
    /// ([`Batch::with_recordings`](taceva_core::Batch::with_recordings)); without these names the intervals are undefined. Metrics that compare
    /// samples of one contact point still use contact points as clusters.
    ///
    /// ```
    /// use taceva_metrics::{Batch, Channel, Channels, Column, Evaluator, FieldSet, Labels, MetricPlan, catalogue};
    /// let channels = Channels::new([Channel::FZ])?;
    /// let plan = MetricPlan::new(&catalogue::ALL, channels.clone(), FieldSet::PAIRS).by_recording();
    /// let mut recordings = Labels::default();
    /// ["a", "b", "c", "d", "e"].iter().for_each(|name| recordings.push(name));
    /// let truth = vec![Column::full(vec![0.1, 0.2, 0.3, 0.4, 0.5])];
    /// let prediction = vec![Column::full(vec![0.2, 0.2, 0.2, 0.5, 0.7])];
    /// let mut evaluator = Evaluator::new(&plan);
    /// evaluator.update(&Batch::from_columns(channels, truth, prediction, None).with_recordings(recordings))?;
    /// let scores = evaluator.finish()?;
    /// let method = scores.mae(Channel::FZ).and_then(|score| score.interval.method()).ok_or("an interval")?;
    /// assert_eq!(method, "jackknife by recording, G=5, logarithmic");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn by_recording(self) -> MetricPlan {
        MetricPlan {
            clustered_by: ClusteredBy::Recording,
            ..self
        }
    }

    /// The same plan for samples in dependent groups, such as blocks of time or clips. Each group is a cluster. The group name of a sample replaces
    /// the recording of [`by_recording`](MetricPlan::by_recording), and the method of the intervals says `by group`.
    #[must_use]
    pub fn by_group(self) -> MetricPlan {
        MetricPlan {
            clustered_by: ClusteredBy::Group,
            ..self
        }
    }

    /// Kind of clusters in the intervals of metrics that do not require contact points.
    pub fn clustered_by(&self) -> ClusteredBy {
        self.clustered_by
    }

    /// The same plan with constant predictions to compare with the model. The constant of a channel is the mean of its training labels, in the unit
    /// of the channel. Without a constant, skill compares the model with the mean of the evaluated truth.
    ///
    /// # Errors
    /// [`MetricError::Setting`] for a NaN or a magnitude above 2¹⁰²¹.
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

    /// Families of the kept metrics, in the order of the catalogue.
    pub(crate) fn families(&self) -> Vec<&'static FamilyKind> {
        let is_kept = |kind: &FamilyKind| {
            let mut kept = self.kept.iter();
            kept.any(|metric| metric.family.schema == kind.schema)
        };
        let mut families: Vec<&'static FamilyKind> = Vec::new();
        for metric in self.catalogue {
            let mut known = families.iter();
            let is_known = known.any(|known| known.schema == metric.family.schema);
            if !is_known && is_kept(metric.family) {
                families.push(metric.family);
            }
        }
        families
    }

    /// Requested metrics.
    pub fn wanted(&self) -> &[&'static Metric] {
        &self.wanted
    }

    /// Fields that samples may have.
    pub fn available(&self) -> FieldSet {
        self.available
    }

    /// Metrics that the evaluation computes.
    pub fn kept(&self) -> &[&'static Metric] {
        &self.kept
    }

    /// Skipped metrics with their reasons.
    pub fn skipped(&self) -> &[Skipped] {
        &self.skipped
    }

    /// The channels of the samples.
    pub fn channels(&self) -> &Channels {
        &self.channels
    }

    /// Fields of a sample that the evaluation reads.
    pub fn fields(&self) -> FieldSet {
        self.fields
    }

    /// The seed of the hash that assigns contact points to clusters.
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// Method for confidence intervals.
    pub fn interval_method(&self) -> IntervalMethod {
        self.interval_method
    }

    /// Facts about the sensor.
    pub fn facts(&self) -> &SensorFacts {
        &self.facts
    }

    /// Constants in the definitions of metrics.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Constant predictions that skill compares with the model, by the name of the channel.
    pub fn constants(&self) -> &BTreeMap<String, f64> {
        &self.constants
    }

    /// Constant prediction that skill compares with the model in `channel`; `None` if unknown.
    pub(crate) fn constant(&self, channel: &str) -> Option<f64> {
        self.constants.get(channel).copied()
    }

    /// True if samples may have `field`.
    pub(crate) fn carries(&self, field: Field) -> bool {
        self.available.contains(field)
    }
}
