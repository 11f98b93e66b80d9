//! Tables and keys of a budget file, each with the position of its text.

use serde::Deserialize;
use toml::Spanned;

use super::amount::Amount;

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WrittenBudget {
    pub(super) budget_version: Spanned<u32>,
    pub(super) measurand: Spanned<String>,
    pub(super) unit: Option<Spanned<String>>,
    #[serde(default)]
    pub(super) at: Vec<Spanned<Amount>>,
    pub(super) coverage: Option<Spanned<f64>>,
    pub(super) expression: Option<Spanned<String>>,
    #[serde(default)]
    pub(super) source: Vec<Spanned<WrittenSource>>,
    #[serde(default)]
    pub(super) correlation: Vec<Spanned<WrittenCorrelation>>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WrittenSource {
    pub(super) name: Spanned<String>,
    pub(super) from: Option<Spanned<String>>,
    pub(super) value: Option<Spanned<Amount>>,
    pub(super) u: Option<Spanned<Amount>>,
    #[serde(rename = "U")]
    pub(super) expanded: Option<Spanned<Amount>>,
    pub(super) k: Option<Spanned<f64>>,
    pub(super) p: Option<Spanned<f64>>,
    pub(super) s: Option<Spanned<Amount>>,
    pub(super) readings: Option<Spanned<f64>>,
    pub(super) rows: Option<Spanned<Vec<f64>>>,
    pub(super) half_width: Option<Spanned<Amount>>,
    pub(super) shape: Option<Spanned<String>>,
    pub(super) beta: Option<Spanned<f64>>,
    pub(super) limits: Option<Spanned<Amount>>,
    pub(super) dof: Option<Spanned<f64>>,
    pub(super) reliability: Option<Spanned<Amount>>,
    pub(super) hours: Option<Spanned<f64>>,
    pub(super) enters: Option<Spanned<String>>,
    pub(super) set: Option<Spanned<String>>,
    pub(super) covers: Option<Spanned<String>>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WrittenCorrelation {
    pub(super) between: Spanned<[String; 2]>,
    pub(super) r: Spanned<Amount>,
}
