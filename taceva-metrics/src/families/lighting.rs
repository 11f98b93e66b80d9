//! Robustness to lighting: change of errors with the light that reaches the camera.

mod change;
mod delta;
mod robustness;
mod sums;

pub(crate) use robustness::R_LIGHT;

use taceva_core::{Batch, Field, Unit};

use crate::evaluate::family::{
    Details, Family, FamilyKind, Intervals, Numbers, Output, each_row, erased,
};
use crate::evaluate::metric::Metric;
use crate::evaluate::plan::MetricPlan;
use crate::exact::merge::Merge;
use crate::exact::record::Record;
use crate::families::accuracy::outputs;
use crate::pair::Paired;
use crate::score::Variant;
use crate::score::value::Value;
use sums::LightingSums;

/// Family of metrics computed from error and brightness in each lighting scene.
pub(crate) static KIND: FamilyKind =
    FamilyKind::new("taceva.lighting/1", |plan| erased(Lighting::for_plan(plan)));

/// Collects the errors of each channel and the brightness of the pictures, by lighting scene.
pub(crate) struct Lighting {
    reference: String,
    channels: usize,
    outputs: Vec<Output>,
}

impl Lighting {
    /// Creates the family for `plan`.
    pub(crate) fn for_plan(plan: &MetricPlan) -> Lighting {
        Lighting {
            reference: plan.facts().reference_scene.clone(),
            channels: plan.channels().len(),
            outputs: outputs(plan.channels()),
        }
    }
}

impl Family for Lighting {
    type Sums = LightingSums;

    fn empty(&self) -> Vec<LightingSums> {
        vec![LightingSums::default(); self.channels]
    }

    fn deposit(&mut self, sums: &mut [LightingSums], batch: &Batch, rows: Option<&[u32]>) {
        let (Some(scenes), Some(intensities)) =
            (batch.labels(Field::Scene), batch.numbers(Field::Intensity))
        else {
            return;
        };
        each_row(batch, rows, |row| {
            let (Some(scene), Some(intensity)) = (scenes.get(row), intensities.get(row)) else {
                return;
            };
            for (channel, sums) in sums.iter_mut().enumerate() {
                if let Some(pair) = Paired::at(batch, channel, row) {
                    sums.add(scene, pair, intensity);
                }
            }
        });
    }

    fn to_record(&self, sums: &LightingSums) -> Record {
        sums.to_record()
    }

    fn read_record(&self, _position: usize, record: &Record) -> Result<LightingSums, String> {
        LightingSums::read_record(record)
    }

    fn outputs(&self, _metric: &Metric) -> Vec<Output> {
        self.outputs.clone()
    }

    fn count(&self, _metric: &Metric, sums: &LightingSums) -> u64 {
        sums.n()
    }

    fn invalid(&self, sums: &LightingSums) -> u64 {
        sums.n_invalid
    }

    fn numbers(&self, _metric: &Metric, _output: &Output, sums: &LightingSums) -> Numbers {
        robustness::robustness(sums, &self.reference)
    }

    fn details(&self, _metric: &Metric, _output: &Output, parts: &[&LightingSums]) -> Details {
        match parts {
            [sums] => robustness::details(sums, &self.reference),
            [x, y] => Details {
                variants: vec![Variant::plain(
                    "of_mean_error",
                    Unit::One,
                    Value::from(robustness::of_plane([x, y], &self.reference)),
                )],
                // Both axes had the same light, so a flag of one axis holds for the plane.
                flags: robustness::flags(parts, &self.reference),
                ..Details::default()
            },
            _ => Details::default(),
        }
    }

    /// Intervals of one channel, by the delta method. `None` for a plane: its errors are correlated, so their mean has its own jackknife.
    fn intervals(
        &self,
        _metric: &Metric,
        output: &Output,
        clusters: &[&Vec<LightingSums>],
    ) -> Option<Intervals> {
        let &[part] = &output.parts[..] else {
            return None;
        };
        let clusters: Vec<&LightingSums> = clusters.iter().map(|sums| &sums[part]).collect();
        let mut total = LightingSums::default();
        clusters.iter().for_each(|cell| total.merge(cell));
        Some(delta::intervals(&total, &clusters, &self.reference))
    }
}
