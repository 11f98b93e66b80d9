//! Wanted widths of intervals: `want_width = { "mae.Fz" = "10 %" }`.

use std::fmt;

/// Wanted width of the 95 % interval of a score. The width is upper end / lower end − 1.
#[derive(Clone, Debug, PartialEq)]
pub struct WantedWidth {
    /// Name of the metric, from [`METRICS`](WantedWidth::METRICS).
    pub metric: String,
    /// Channel or plane: `Fz`, `Pxy`.
    pub channel: String,
    /// Greatest width of the interval: 0.1 for 10 %.
    pub width: f64,
}

impl WantedWidth {
    /// Metrics for which widths can be wanted: means of errors by contact point, and roots of such means.
    pub const METRICS: [&'static str; 2] = ["mae", "rmse"];

    /// Parses `mae.Fz` and `10 %`; `None` without a dot, or if the width is not a percentage from above 0 to 1000.
    pub(crate) fn parse(score: &str, width: &str) -> Option<WantedWidth> {
        let (metric, channel) = score.split_once('.')?;
        let percent: f64 = width.strip_suffix('%')?.trim().parse().ok()?;
        (percent > 0.0 && percent <= 1_000.0).then(|| WantedWidth {
            metric: metric.to_owned(),
            channel: channel.to_owned(),
            width: percent / 100.0,
        })
    }
}

/// Formats the score, such as `mae.Fz`.
impl fmt::Display for WantedWidth {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}.{}", self.metric, self.channel)
    }
}
