//! Uncertainty sources that a result can provide for a budget.

use crate::escape::toml_string as quoted;

/// Source of a budget: a measured figure with a name for readers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct BudgetSource {
    /// Key of the figure in the result, such as `error.within`.
    pub(crate) figure: &'static str,
    pub(crate) name: &'static str,
    /// Lines with further keys. The user must replace a value `?`.
    pub(crate) keys: &'static str,
}

const fn source(figure: &'static str, name: &'static str, keys: &'static str) -> BudgetSource {
    BudgetSource { figure, name, keys }
}

/// Correction of the mean residual.
pub(crate) const BIAS: BudgetSource = source("bias", "mean residual", "");
/// Variation of the residuals between places on the gel.
pub(crate) const BETWEEN: BudgetSource = source("error.between", "place to place", "");
/// Scatter of the residual of one reading at one place on the gel.
pub(crate) const WITHIN: BudgetSource = source("error.within", "one reading", "readings = 1\n");
/// Scatter of repeated presses. [`WITHIN`] includes this scatter.
pub(crate) const REPEATS: BudgetSource = source("repeatability", "repeats", "readings = 1\n");
/// Zero point of the depths. [`WITHIN`], [`BETWEEN`] and [`REPEATS`] include its error.
pub(crate) const ZERO: BudgetSource = source("zero_u_mm", "zero of depths", "");
/// Variation of the mean residual between light scenes.
pub(crate) const LIGHT: BudgetSource = source("r_light", "other light", "");
/// Drift of the sensor's zero over time.
pub(crate) const DRIFT: BudgetSource = source(
    "drift",
    "drift since calibration",
    "hours = ?   # hours since the calibration of the zero\n",
);
/// Certificate of the reference.
pub(crate) const CERTIFICATE: BudgetSource = source("certificate", "reference", "");

impl BudgetSource {
    /// Text of the source for a budget file.
    pub(crate) fn text(&self) -> String {
        format!(
            "[[source]]\nname = {}\nfrom = {}\n{}",
            quoted(self.name),
            quoted(self.figure),
            self.keys
        )
    }
}
