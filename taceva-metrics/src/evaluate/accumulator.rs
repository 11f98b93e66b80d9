//! Accumulators, which sum samples and compute scores. Metrics of one family share an accumulator.

mod any_family;
mod erased_sums;
mod resampling;
mod scores;

use std::collections::BTreeMap;

use taceva_core::{Batch, Channels};

pub(crate) use self::any_family::{AnyFamily, erased};
use self::erased_sums::ErasedSums;
use crate::error::MetricError;
use crate::evaluate::batch_clusters::BatchClusters;
use crate::evaluate::family::FamilyKind;
use crate::evaluate::plan::MetricPlan;
use crate::evaluate::state::{Shape, State, describe, written};
use crate::score::ClusteredBy;
use crate::stats::IntervalMethod;
use crate::stats::clusters::{Clustering, Clusters};
use crate::stats::row_groups::Grouped;

/// Sums of one family of metrics, separate for each cluster of samples.
///
/// # Laws
/// Equal sets of samples give equal states and bit-identical scores, for any order, split and merge. Merging an empty state changes nothing.
pub(crate) struct Accumulator {
    kind: &'static FamilyKind,
    family: Box<dyn AnyFamily>,
    channels: Channels,
    clustering: Clustering<ErasedSums>,
    clusters: Clusters<ErasedSums>,
    interval_method: IntervalMethod,
    clustered_by: ClusteredBy,
    /// Parameters that merged states must share: periods of angles, and the centres about which the angles are unwrapped.
    periods: BTreeMap<String, String>,
}

impl Accumulator {
    /// Empty accumulators of `plan`, one per family, in the order of the catalogue.
    pub(crate) fn of_plan(plan: &MetricPlan) -> Vec<Accumulator> {
        let mut accumulators: Vec<Accumulator> = Vec::new();
        let periods = plan.channels().iter().filter_map(|channel| {
            let period = channel.period()?;
            let about = plan.constant(channel.name());
            let about = about.map_or_else(String::new, |centre| format!(" about {centre}"));
            Some((format!("period {channel}"), format!("{period}{about}")))
        });
        let periods: BTreeMap<String, String> = periods.collect();
        for kind in plan.families() {
            if let Some(family) = (kind.build)(plan) {
                accumulators.push(Accumulator {
                    clustering: Clustering {
                        empty: family.empty(),
                        seed: plan.seed(),
                    },
                    kind,
                    family,
                    channels: plan.channels().clone(),
                    periods: periods.clone(),
                    clusters: Clusters::default(),
                    interval_method: plan.interval_method(),
                    clustered_by: match kind.clusters_of_plan {
                        true => plan.clustered_by(),
                        false => ClusteredBy::Point,
                    },
                });
            }
        }
        accumulators
    }

    /// True if the accumulator keeps separate sums for each contact point.
    pub(crate) fn is_by_point(&self) -> bool {
        self.clustered_by == ClusteredBy::Point && !self.kind.is_whole
    }

    /// Adds the samples of `batch` with their `clusters`.
    pub(crate) fn update(
        &mut self,
        batch: &Batch,
        clusters: &BatchClusters<'_>,
    ) -> Result<(), MetricError> {
        if batch.channels() != &self.channels {
            return Err(MetricError::Channels {
                expected: describe(&written(&self.channels)),
                found: describe(&written(batch.channels())),
            });
        }
        let family = &mut self.family;
        let rows = batch.rows();
        if self.kind.is_whole {
            let are_clustered = match self.clustered_by {
                ClusteredBy::Sample => true,
                kind => clusters.by(kind).is_some(),
            };
            self.clustering
                .deposit_whole(&mut self.clusters, rows, are_clustered, |parts| {
                    family.deposit(parts, batch, None);
                });
            return Ok(());
        }
        let own;
        let grouped = match self.clustered_by {
            ClusteredBy::Point => match family.clusters(batch) {
                Some(labels) if !clusters.are_points(&labels) => {
                    own = Grouped::new(labels, self.clustering.seed);
                    Some(&own)
                }
                labels => labels.and_then(|_| clusters.by(ClusteredBy::Point)),
            },
            kind => clusters.by(kind),
        };
        self.clustering
            .deposit(&mut self.clusters, rows, grouped, |parts, rows| {
                family.deposit(parts, batch, rows);
            });
        Ok(())
    }

    /// State of all added samples.
    pub(crate) fn state(&self) -> State {
        let Shape {
            schema,
            parameters,
            channels,
        } = self.shape();
        let records =
            |parts: &ErasedSums| Ok::<_, std::convert::Infallible>(self.family.to_records(parts));
        let clusters = match self.clusters.try_map(records) {
            Ok(clusters) => clusters,
            Err(never) => match never {},
        };
        State {
            schema: schema.to_owned(),
            parameters,
            channels,
            clusters,
        }
    }

    /// True if the accumulator reads states of `schema`.
    pub(crate) fn reads(&self, schema: &str) -> bool {
        schema == self.kind.schema
    }

    /// Merges the state of another accumulator.
    pub(crate) fn merge(&mut self, state: &State) -> Result<(), MetricError> {
        state.check(&self.shape())?;
        let clusters = state.clusters.try_map(|records| {
            let malformed = |what| MetricError::Malformed {
                schema: self.kind.schema,
                what,
            };
            self.family.read_records(records).map_err(malformed)
        })?;
        self.clustering.merge(&mut self.clusters, &clusters);
        Ok(())
    }

    fn shape(&self) -> Shape {
        let mut parameters = self.family.parameters();
        parameters.insert("seed".to_owned(), self.clustering.seed.to_string());
        parameters.extend(self.periods.clone());
        let clusters = match self.clustered_by {
            ClusteredBy::Point => None,
            ClusteredBy::Sample => Some("samples"),
            ClusteredBy::Recording => Some("recordings"),
            ClusteredBy::Group => Some("groups"),
        };
        if let Some(clusters) = clusters {
            parameters.insert("clusters".to_owned(), clusters.to_owned());
        }
        Shape {
            schema: self.kind.schema,
            parameters,
            channels: written(&self.channels),
        }
    }
}
