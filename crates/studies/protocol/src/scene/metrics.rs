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
    /// Names of metrics or groups; the default is all that apply. A metric that is named individually must apply to a sensor of the scene.
    pub want: Option<Vec<Setting<String>>>,
    /// Greatest widths of intervals by score: `"10 %"` for `mae.Fz`.
    pub want_width: BTreeMap<String, Setting<String>>,
    /// Settings of the metrics.
    pub settings: MetricSettings,
}

impl MetricsSpec {
    /// Wanted widths of intervals, by the names of their scores.
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

/// Settings of the metrics. For an absent setting, the metric's default applies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default, expecting = "a table of settings")]
pub struct MetricSettings {
    /// Number of cells along each side of a map.
    pub bins: Option<Setting<u32>>,
    /// Least number of samples in a cell or bin.
    pub n_min: Option<Setting<u32>>,
    /// Least force of a press that counts in the sensitivity, in N.
    #[serde(rename = "gate_N")]
    pub gate_n: Option<Setting<f64>>,
    /// Width of the moving average of a curve, in bins, an odd number.
    pub smoothing: Option<Setting<u32>>,
    /// Greatest error of a recognised spacing, in mm.
    pub tolerance_mm: Option<Setting<f64>>,
}

impl MetricSettings {
    /// Settings, completed by the defaults of the metrics.
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
    /// Any of [`FORMATS`](ReportSpec::FORMATS); text and JSON if empty.
    pub formats: Vec<Setting<String>>,
    /// One of [`LIKE`](ReportSpec::LIKE): published study whose table layout is also written. `None` writes no such tables.
    pub like: Option<Setting<String>>,
    /// Any of [`KEEP`](ReportSpec::KEEP): additional files to store in the folder of a run.
    pub keep: Vec<Setting<String>>,
}

impl ReportSpec {
    /// All formats.
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
