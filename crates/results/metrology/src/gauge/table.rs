//! Table of an analysis of variance.

use serde::{Deserialize, Serialize};

/// Source of variation.
///
/// ```
/// use taceva_metrology::gauge::Source;
/// assert_ne!(Source::Part, Source::Operator);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Source {
    /// Variation between operators.
    Operator,
    /// Variation between parts; within operators in a nested study.
    Part,
    /// Interaction of operators and parts.
    Interaction,
    /// Variation within cells, between trials.
    Repeatability,
    /// Pooled interaction and repeatability.
    Pooled,
    /// Total variation about the mean.
    Total,
}

/// Row of an analysis-of-variance table, in the squared unit of the readings.
///
/// ```
/// use taceva_metrology::gauge::{GaugeSettings, GaugeStudy, Source};
/// let mut study = GaugeStudy::default();
/// for (at, value) in [1.0, 1.1, 1.2, 1.4, 2.0, 2.2, 2.1, 2.3].into_iter().enumerate() {
///     study.add(["p", "q"][at / 4], ["A", "B"][at / 2 % 2], ["1", "2"][at % 2], value)?;
/// }
/// let report = study.analyse(&GaugeSettings::default())?;
/// let total = report.table.last().ok_or("a table")?;
/// assert_eq!((total.source, total.df), (Source::Total, 7));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct TableRow {
    /// Source of variation.
    pub source: Source,
    /// Degrees of freedom.
    pub df: u64,
    /// Sum of squares.
    pub ss: f64,
    /// Mean square; `None` for the total.
    pub ms: Option<f64>,
    /// Mean square divided by the mean square in the denominator of the F test; `None` without an F test.
    pub f: Option<f64>,
    /// p value of the F ratio; `None` without a ratio.
    pub p: Option<f64>,
}
