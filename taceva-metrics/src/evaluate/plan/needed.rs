//! Which metrics a plan keeps, and what is read for them.

use taceva_core::{Field, FieldSet, SkipReason, Skipped};

use super::MetricPlan;
use crate::families::accuracy::Plane;
use crate::families::intrinsic::{self, Intrinsic};
use crate::metric::{Formula, Metric};

impl MetricPlan {
    /// Decides what is kept and what is read.
    pub(super) fn decided(mut self) -> MetricPlan {
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
}
