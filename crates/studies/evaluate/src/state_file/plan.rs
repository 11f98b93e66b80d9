//! The plan of metrics in a state file.

use std::collections::BTreeMap;
use std::path::Path;

use serde::{Deserialize, Serialize};
use taceva_core::{
    Channel, Channels, Field, FieldSet, Footprint, Nanometre, Newton, Outline, Unit,
};
use taceva_metrics::{ClusteredBy, MetricPlan, SensorFacts, Settings, catalogue};

use crate::error::EvaluateError;

/// A plan of metrics as written in a file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct WrittenPlan {
    metrics: Vec<String>,
    channels: Vec<(String, Unit)>,
    /// Period of the values of each channel, in degrees.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    periods: BTreeMap<String, u16>,
    fields: Vec<String>,
    seed: u64,
    footprint: Option<WrittenFootprint>,
    opaque: Option<bool>,
    reference_scene: String,
    frame_size: Option<[u32; 2]>,
    bins: u32,
    n_min: u64,
    ddof: u32,
    gate_n: f64,
    smoothing_window: u32,
    resolution_tolerance_nm: i64,
    /// Constant predictions for the skill, by channel. Absent if they are unknown or differ between states.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub(crate) constants: BTreeMap<String, f64>,
    /// True if the clusters of intervals are recordings instead of contact points.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    by_recording: bool,
    /// True if groups of samples, such as blocks of time, are the clusters.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    by_group: bool,
    /// True if the clusters are single samples.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    independent: bool,
}

/// A footprint in whole nanometres: a radius, or half a width and half a height.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenFootprint {
    radius_nm: Option<i64>,
    half_nm: Option<[i64; 2]>,
    depth_max_nm: Option<i64>,
}

impl WrittenPlan {
    pub(super) fn of(plan: &MetricPlan) -> WrittenPlan {
        let (facts, settings) = (plan.facts(), plan.settings());
        WrittenPlan {
            metrics: plan
                .wanted()
                .iter()
                .map(|metric| metric.id.to_owned())
                .collect(),
            channels: plan
                .channels()
                .iter()
                .map(|channel| (channel.name().to_owned(), channel.unit()))
                .collect(),
            periods: plan
                .channels()
                .iter()
                .filter_map(|channel| Some((channel.name().to_owned(), channel.period()?)))
                .collect(),
            fields: plan
                .available()
                .iter()
                .map(|field| field.name().to_owned())
                .collect(),
            seed: plan.seed(),
            footprint: facts.footprint.as_ref().map(WrittenFootprint::of),
            opaque: facts.opaque,
            reference_scene: facts.reference_scene.clone(),
            frame_size: facts.frame_size,
            bins: settings.bins,
            n_min: settings.n_min,
            ddof: settings.ddof,
            gate_n: settings.gate.0,
            smoothing_window: settings.smoothing_window,
            resolution_tolerance_nm: settings.resolution_tolerance.0,
            constants: plan.constants().clone(),
            by_recording: plan.clustered_by() == ClusteredBy::Recording,
            by_group: plan.clustered_by() == ClusteredBy::Group,
            independent: plan.clustered_by() == ClusteredBy::Sample,
        }
    }

    /// True if states of both plans can be merged. The constants for the skill may differ, because they are used only at the end.
    pub(crate) fn merges_with(&self, other: &WrittenPlan) -> bool {
        let without = |plan: &WrittenPlan| WrittenPlan {
            constants: BTreeMap::new(),
            ..plan.clone()
        };
        without(self) == without(other)
    }

    pub(crate) fn to_plan(&self, path: &Path) -> Result<MetricPlan, EvaluateError> {
        let wrong = |problem: String| EvaluateError::State {
            path: path.to_owned(),
            problem,
        };
        let metrics = catalogue::select(self.metrics.iter().map(String::as_str))?;
        let channels = self
            .channels
            .iter()
            .map(|(name, unit)| {
                let channel = Channel::named(name, *unit)?;
                match self.periods.get(name) {
                    Some(period) => channel.with_period(*period),
                    None => Ok(channel),
                }
            })
            .collect::<Result<Vec<_>, _>>()
            .and_then(Channels::new)
            .map_err(|error| wrong(error.to_string()))?;
        let field = |name: &String| {
            let found = Field::ALL.into_iter().find(|field| field.name() == name);
            found.ok_or_else(|| wrong(format!("unknown field `{name}`")))
        };
        let fields: FieldSet = self.fields.iter().map(field).collect::<Result<_, _>>()?;
        let footprint = self.footprint.as_ref().map(WrittenFootprint::to_core);
        let plan = MetricPlan::new(&metrics, channels, fields)
            .with_facts(
                SensorFacts::default()
                    .with_footprint(footprint.transpose().map_err(wrong)?)
                    .with_opaque(self.opaque)
                    .with_reference_scene(self.reference_scene.clone())
                    .with_frame_size(self.frame_size),
            )
            .with_seed(self.seed)
            .with_constants(self.constants.clone())?
            .with_settings(
                Settings::default()
                    .with_bins(self.bins)
                    .with_n_min(self.n_min)
                    .with_ddof(self.ddof)
                    .with_gate(Newton(self.gate_n))
                    .with_smoothing_window(self.smoothing_window)
                    .with_resolution_tolerance(Nanometre(self.resolution_tolerance_nm)),
            );
        let plan = plan?;
        Ok(match (self.by_recording, self.by_group, self.independent) {
            (true, _, _) => plan.by_recording(),
            (_, true, _) => plan.by_group(),
            (_, _, true) => plan.independent_samples(),
            _ => plan,
        })
    }
}

impl WrittenFootprint {
    fn of(footprint: &Footprint) -> WrittenFootprint {
        let (radius_nm, half_nm) = match footprint.outline() {
            Outline::Disc { radius } => (Some(radius.0), None),
            _ => (None, Some(footprint.half_extent().map(|half| half.0))),
        };
        WrittenFootprint {
            radius_nm,
            half_nm,
            depth_max_nm: footprint.depth_max().map(|depth| depth.0),
        }
    }

    fn to_core(&self) -> Result<Footprint, String> {
        let millimetres = |length: i64| Nanometre(length).to_millimetres();
        let depth = self.depth_max_nm.map(millimetres);
        match (self.radius_nm, self.half_nm) {
            (Some(radius), None) => Footprint::disc(millimetres(radius), depth),
            (None, Some([x, y])) => Footprint::rectangle(millimetres(x), millimetres(y), depth),
            _ => {
                return Err("a footprint needs exactly one of `radius_nm` and `half_nm`".to_owned());
            }
        }
        .map_err(|error| error.to_string())
    }
}
