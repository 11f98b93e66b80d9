//! Published numbers of a sensor, and their sources.

use serde::Deserialize;
use taceva_metrics::Standing;

/// Where numbers are from.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Source {
    /// The name by which numbers of the same file refer to it.
    pub id: String,
    /// Authors, title, place and year of publication.
    pub text: String,
    /// Its address, if it has one.
    pub link: Option<String>,
}

/// A published number.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Published {
    /// The metric: `mae`.
    pub metric: String,
    /// The channel or plane.
    pub channel: String,
    /// The number, in `unit`.
    pub value: f64,
    /// The unit.
    pub unit: String,
    /// The id of the source.
    pub source: String,
    /// Where in the source: `table`, `figure`, `text`, or `derived` from its numbers.
    pub read_from: String,
    /// How it was measured.
    pub conditions: String,
    /// How it is defined.
    pub definition: String,
    /// How the true value relates to the number where it is not stated exactly: `about`, `above` or `below` it; absent of an exact number.
    pub bound: Option<Roughly>,
    /// What a reader must know.
    pub note: Option<String>,
    /// Whether it takes part in verdicts, by the published R² of its channel.
    #[serde(skip)]
    pub standing: Standing,
    /// Its interval of 95 %; none of published numbers.
    #[serde(skip)]
    pub interval: Option<[f64; 2]>,
}

impl Published {
    /// The number as it was published, with `≈`, `>` or `<` where it is not exact.
    pub fn shown(&self) -> String {
        let sign = self.bound.map_or("", Roughly::sign);
        format!("{sign}{}", self.value)
    }
}

/// How a published number that is not exact relates to the true one. Such a number is shown, but not compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Roughly {
    /// About as much.
    About,
    /// More than that.
    Above,
    /// Less than that.
    Below,
}

impl Roughly {
    /// The sign before the number.
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
    /// The metric.
    pub metric: String,
    /// Why there is none.
    pub reason: String,
}
