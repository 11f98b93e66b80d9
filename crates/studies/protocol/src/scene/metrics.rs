//! Metrics and reports of a scene.

use std::collections::BTreeMap;
use std::fmt;

use serde::de::value::MapAccessDeserializer;
use serde::de::{MapAccess, Visitor};
use serde::{Deserialize, Deserializer};
use taceva_core::{Nanometre, Newton};
use taceva_metrics::Settings;

use super::wanted_width::WantedWidth;
use crate::text::Setting;

/// The metrics of a scene.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(remote = "Self", deny_unknown_fields, default)]
pub struct MetricsSpec {
    /// Names of metrics or groups; the default is all metrics that apply. A metric that is named individually must apply to a sensor of the scene.
    pub want: Option<Vec<Setting<String>>>,
    /// Greatest wanted widths of intervals, by score: `mae.Fz` has the value `"10 %"`.
    pub want_width: BTreeMap<String, Setting<String>>,
    /// Settings of the metrics.
    pub settings: MetricSettings,
}

impl MetricsSpec {
    /// Wanted widths of intervals, in the order of their scores' names.
    pub fn wanted_widths(&self) -> Vec<WantedWidth> {
        let widths = self.want_width.iter();
        let widths = widths.filter_map(|(score, width)| WantedWidth::parse(score, &width.value));
        widths.collect()
    }
}

// A derived implementation would accept a list as fields in order, and then expect a list in its first element.
impl<'de> Deserialize<'de> for MetricsSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<MetricsSpec, D::Error> {
        struct Table;

        impl<'de> Visitor<'de> for Table {
            type Value = MetricsSpec;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a table such as `metrics = { want = [\"mae\"] }`")
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<MetricsSpec, A::Error> {
                MetricsSpec::deserialize(MapAccessDeserializer::new(map))
            }
        }

        deserializer.deserialize_map(Table)
    }
}

/// Settings of the metrics. A metric uses its default for an absent setting.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default, expecting = "a table of settings")]
pub struct MetricSettings {
    /// Number of cells along each side of a map of the surface.
    pub bins: Option<Setting<u32>>,
    /// Least number of samples in a cell of a map or a bin of a curve.
    pub n_min: Option<Setting<u32>>,
    /// Least normal force of a press from which the sensitivity is computed, in N.
    #[serde(rename = "gate_N")]
    pub gate_n: Option<Setting<f64>>,
    /// Width of the moving average of a curve, in bins, an odd number.
    pub smoothing: Option<Setting<u32>>,
    /// Greatest error at which a predicted spacing counts as recognised, in mm.
    pub tolerance_mm: Option<Setting<f64>>,
}

impl MetricSettings {
    /// Settings of the scene, with the defaults of the metrics for absent ones.
    pub fn settings(&self) -> Settings {
        let default = Settings::default();
        let tolerance = self
            .tolerance_mm
            .and_then(|length| Nanometre::from_millimetres(length.value));
        let n_min = self
            .n_min
            .map_or(default.n_min, |least| u64::from(least.value));
        let window = self
            .smoothing
            .map_or(default.smoothing_window, |width| width.value);
        Settings::default()
            .with_bins(self.bins.map_or(default.bins, |bins| bins.value))
            .with_n_min(n_min)
            .with_gate(self.gate_n.map_or(default.gate, |gate| Newton(gate.value)))
            .with_smoothing_window(window)
            .with_resolution_tolerance(tolerance.unwrap_or(default.resolution_tolerance))
    }
}

/// Formats of the report.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(
    deny_unknown_fields,
    default,
    expecting = "a table with `formats`, `like` and `keep`"
)]
pub struct ReportSpec {
    /// Formats of the report, from [`FORMATS`](ReportSpec::FORMATS). If empty, text and JSON are written.
    pub formats: Vec<Setting<String>>,
    /// Published study, from [`LIKE`](ReportSpec::LIKE), whose table layout is also written. `None` writes no such tables.
    pub like: Option<Setting<String>>,
    /// Additional files, from [`KEEP`](ReportSpec::KEEP), that are stored in the folder of a run.
    pub keep: Vec<Setting<String>>,
}

impl ReportSpec {
    /// All formats of a report.
    pub const FORMATS: [&'static str; 6] = ["text", "json", "csv", "md", "tex", "html"];

    /// Studies whose table layout is supported.
    pub const LIKE: [&'static str; 1] = ["taceva"];

    /// Files that a run stores on request: fitted models.
    pub const KEEP: [&'static str; 1] = ["models"];

    /// True if the folder of a run stores its fitted models.
    pub fn keeps_models(&self) -> bool {
        !self.keep.is_empty()
    }
}
