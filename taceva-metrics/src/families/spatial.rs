//! Spatial robustness: variation of errors with distance from the sensor's axis and with depth.

mod robustness;
mod sums;

pub(crate) use robustness::R_SPATIAL;

use std::collections::BTreeMap;

use taceva_core::{Batch, Nanometre, Unit};

use crate::count::as_f64;
use crate::evaluate::family::{
    Details, Family, FamilyKind, Intervals, Numbers, Output, each_row, erased,
};
use crate::evaluate::metric::Metric;
use crate::evaluate::plan::MetricPlan;
use crate::evaluate::settings::Settings;
use crate::exact::merge::keyed;
use crate::exact::moments::Moments;
use crate::exact::record::Record;
use crate::exact::sorted_map::SortedMap;
use crate::families::accuracy::outputs;
use crate::pair::Paired;
use crate::score::curve::Curve;
use crate::score::sensor_facts;
use crate::score::value::Value;
use crate::score::{Count, Parameter, Variant};
use sums::{BINS, Reach, SpatialSums};

/// Metric family that groups errors by distance from the sensor's axis and by depth.
pub(crate) static KIND: FamilyKind =
    FamilyKind::new("taceva.spatial/1", |plan| erased(Spatial::for_plan(plan)?));

/// Family that sums the errors of each channel by distance from the sensor's axis and by depth.
pub(crate) struct Spatial {
    settings: Settings,
    footprint: String,
    reach: Reach,
    place: [usize; 3],
    channels: usize,
    outputs: Vec<Output>,
}

impl Spatial {
    /// Creates the family for `plan`. `None` without the channels of the place (`Px`, `Py`, `Pz`), a footprint or its greatest depth.
    pub(crate) fn for_plan(plan: &MetricPlan) -> Option<Spatial> {
        let footprint = plan.facts().footprint?;
        let channels = plan.channels();
        let position = |name| channels.position(name);
        Some(Spatial {
            settings: *plan.settings(),
            footprint: sensor_facts::written(&footprint),
            reach: Reach::of(&footprint)?,
            place: [position("Px")?, position("Py")?, position("Pz")?],
            channels: channels.len(),
            outputs: outputs(channels),
        })
    }

    /// Curve of the mean absolute error in each bin, over the centres of the bins in mm. The last bin ends at `extent`.
    fn curve(&self, bins: &SortedMap<u8, Moments>, extent: Nanometre) -> Value {
        let of = |bin: u8| {
            bins.get(&bin)
                .filter(|moments| moments.n >= self.settings.n_min)
        };
        let centre = |bin: u8| f64::from(2 * u16::from(bin) + 1) * extent.to_millimetres();
        Value::Curve(Curve {
            x: (0..BINS)
                .map(|bin| centre(bin) / f64::from(2 * u16::from(BINS)))
                .collect(),
            x_unit: Unit::Millimetre,
            values: (0..BINS)
                .map(|bin| of(bin).and_then(Moments::mean))
                .collect(),
            counts: (0..BINS)
                .map(|bin| bins.get(&bin).map_or(0, |bin| bin.n))
                .collect(),
            band: None,
        })
    }
}

impl Family for Spatial {
    type Sums = SpatialSums;

    fn parameters(&self) -> BTreeMap<String, String> {
        keyed([
            ("bins".to_owned(), BINS.to_string()),
            ("footprint".to_owned(), self.footprint.clone()),
        ])
    }

    fn empty(&self) -> Vec<SpatialSums> {
        vec![SpatialSums::default(); self.channels]
    }

    fn deposit(&mut self, sums: &mut [SpatialSums], batch: &Batch, rows: Option<&[u32]>) {
        each_row(batch, rows, |row| {
            let place = self.place.map(|axis| batch.truth(axis).get(row));
            let [Some(x), Some(y), Some(z)] = place else {
                return;
            };
            for (channel, sums) in sums.iter_mut().enumerate() {
                if let Some(pair) = Paired::at(batch, channel, row) {
                    sums.add(pair, [x, y, z], self.reach);
                }
            }
        });
    }

    fn to_record(&self, sums: &SpatialSums) -> Record {
        sums.to_record()
    }

    fn read_record(&self, _position: usize, record: &Record) -> Result<SpatialSums, String> {
        SpatialSums::read_record(record)
    }

    fn outputs(&self, _metric: &Metric) -> Vec<Output> {
        self.outputs.clone()
    }

    fn count(&self, _metric: &Metric, sums: &SpatialSums) -> u64 {
        sums.n
    }

    fn invalid(&self, sums: &SpatialSums) -> u64 {
        sums.n_invalid
    }

    fn numbers(&self, _metric: &Metric, output: &Output, sums: &SpatialSums) -> Numbers {
        robustness::robustness(sums, &self.settings, output.unit)
    }

    /// Interval of the variation of errors beyond chance, from the variances between and within contact points.
    fn intervals(
        &self,
        _metric: &Metric,
        output: &Output,
        clusters: &[&Vec<SpatialSums>],
    ) -> Option<Intervals> {
        let parts = output.parts.iter();
        let parts = parts.map(|&part| clusters.iter().map(|sums| &sums[part]).collect());
        let parts: Vec<Vec<&SpatialSums>> = parts.collect();
        Some(robustness::of_clusters(&parts, &self.settings))
    }

    fn details(&self, _metric: &Metric, output: &Output, parts: &[&SpatialSums]) -> Details {
        let parameter = |name, value| Parameter { name, value };
        let mut details = Details {
            parameters: vec![
                parameter("bins", f64::from(BINS)),
                parameter("n_min", as_f64(self.settings.n_min)),
                parameter("ddof", f64::from(self.settings.ddof)),
                parameter("window", f64::from(self.settings.smoothing_window)),
            ],
            ..Details::default()
        };
        if let [sums] = parts {
            let used = |bins: &SortedMap<u8, Moments>| {
                let used = bins.values().filter(|bin| bin.n >= self.settings.n_min);
                used.fold(0, |used, _| used + 1)
            };
            let count = |name, value| Count { name, value };
            details.counts = vec![
                count("outside", sums.outside),
                count("bins_distance", used(&sums.distance)),
                count("bins_depth", used(&sums.depth)),
            ];
            let distance = self.curve(&sums.distance, self.reach.radius);
            let depth = self.curve(&sums.depth, self.reach.depth);
            details.variants = vec![
                Variant::plain("distance", output.unit, distance),
                Variant::plain("depth", output.unit, depth),
            ];
        }
        details
    }
}
