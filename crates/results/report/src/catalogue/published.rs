//! Published numbers of a sensor, with their sources.

use serde::Deserialize;
use taceva_metrics::Standing;

use crate::results::UNSTATED;

/// Source of numbers.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Source {
    /// Id to which numbers in the same file refer.
    pub id: String,
    /// Authors, title, journal and year of the publication.
    pub text: String,
    /// URL of the source, if there is a URL.
    pub link: Option<String>,
}

/// Published number.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Published {
    /// Metric: `mae`.
    pub metric: String,
    /// Channel or plane of the number, such as `Fz` or `Fxy`.
    pub channel: String,
    /// Number in `unit`.
    pub value: f64,
    /// Unit of the number.
    pub unit: String,
    /// Id of the source.
    pub source: String,
    /// Place in the source: `table`, `figure`, `text`, or `derived` from its numbers.
    pub read_from: String,
    /// Measurement conditions.
    pub conditions: String,
    /// Definition of the metric by the source.
    pub definition: String,
    /// Relation of the true value to an inexact number: `about`, `above` or `below`; `None` for an exact number.
    pub bound: Option<Roughly>,
    /// Remark for readers, if any.
    pub note: Option<String>,
    /// Standing of the number in verdicts, by the published R² of the channel.
    #[serde(skip)]
    pub standing: Standing,
    /// 95 % confidence interval of a number from a result; `None` for a number from a publication.
    #[serde(skip)]
    pub interval: Option<[f64; 2]>,
}

impl Published {
    /// True if the source states the definition of the number.
    pub fn is_defined(&self) -> bool {
        self.definition != UNSTATED
    }

    /// Number as published, with `≈`, `>` or `<` if it is inexact.
    pub fn shown(&self) -> String {
        let sign = self.bound.map_or("", Roughly::sign);
        format!("{sign}{}", self.value)
    }
}

/// Relation of the true value to an inexact published number. Reports show an inexact number but do not compare it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Roughly {
    /// Approximately equal.
    About,
    /// Above the number.
    Above,
    /// Below the number.
    Below,
}

impl Roughly {
    /// Sign printed before the number.
    pub const fn sign(self) -> &'static str {
        match self {
            Roughly::About => "≈ ",
            Roughly::Above => "> ",
            Roughly::Below => "< ",
        }
    }
}

/// A number that was not published.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Missing {
    /// Name of the metric.
    pub metric: String,
    /// Reason why the number is missing.
    pub reason: String,
}
