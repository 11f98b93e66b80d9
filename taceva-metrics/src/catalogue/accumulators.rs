//! The accumulators of a plan: one for all metrics that are finished from the same sums.

use crate::evaluate::accumulator::Accumulator;
use crate::evaluate::family::Family;
use crate::evaluate::plan::MetricPlan;
use crate::families::accuracy::{Pairs, Plane};
use crate::families::bias_level::Levels;
use crate::families::channelwise::{ByChannel, Channelwise};
use crate::families::crosstalk::Crosstalk;
use crate::families::detection::Idle;
use crate::families::drift::Drifts;
use crate::families::hysteresis::Loops;
use crate::families::inter_sensor::InterSensor;
use crate::families::intrinsic::Intrinsic;
use crate::families::lighting::Lighting;
use crate::families::linearity::Lines;
use crate::families::repeatability::Repeats;
use crate::families::resolution::Resolution;
use crate::families::spatial::Spatial;
use crate::families::surface::Surface;
use crate::families::tolerance::Tolerances;

impl MetricPlan {
    /// One accumulator for all metrics that share what is kept.
    pub(crate) fn accumulators(&self) -> Vec<Accumulator> {
        let families = [
            Pairs::for_plan(self).map(|family| self.as_asked(family)),
            Plane::for_metrics(self.kept(), self.channels()).map(|family| self.as_asked(family)),
            Resolution::for_plan(self).map(|family| self.clustered(family)),
            Surface::for_plan(self).map(|family| self.clustered(family)),
            Spatial::for_plan(self).map(|family| self.clustered(family)),
            Lighting::for_plan(self).map(|family| self.clustered(family)),
            self.by_channel(Repeats, MetricPlan::clustered),
            Loops::for_plan(self).map(|family| self.clustered(family)),
            InterSensor::for_plan(self).map(|family| self.clustered(family)),
            Intrinsic::for_plan(self).map(|family| self.clustered(family)),
            Idle::for_plan(self).and_then(|kind| self.by_channel(kind, MetricPlan::clustered)),
            self.by_channel(Lines::default(), MetricPlan::as_asked),
            Crosstalk::for_plan(self).map(|family| self.as_asked(family)),
            self.by_channel(Levels::default(), MetricPlan::as_asked),
            self.by_channel(Tolerances::for_plan(self), MetricPlan::as_asked),
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

    /// An accumulator whose clusters are those that the plan asks for: rows where samples are taken as independent, recordings, or contact points.
    fn as_asked<F>(&self, family: F) -> Accumulator
    where
        F: Family,
    {
        Accumulator::new(family, self).clustered_by(self.clustered_by())
    }

    fn clustered<F>(&self, family: F) -> Accumulator
    where
        F: Family,
    {
        Accumulator::new(family, self)
    }
}
