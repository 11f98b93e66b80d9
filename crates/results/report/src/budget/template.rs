//! Initial budget file, with every measured figure and with comments on missing figures.

use taceva_metrology::budget::{BudgetText, Evidence, Figure, Missing, MonteCarlo};
use taceva_results::not_measured;

use crate::budget_source::{
    BETWEEN, BIAS, BudgetSource, CERTIFICATE, DRIFT, LIGHT, REPEATS, WITHIN, ZERO,
};
use crate::escape::{terminal as line, toml_string as quoted};
use crate::number::FormattedValue;

/// Uncertainty sources of the budget file. A source is written as a comment if the user must complete one of its keys.
const SOURCES: [BudgetSource; 8] = [
    BIAS,
    BETWEEN,
    WITHIN,
    REPEATS,
    ZERO,
    LIGHT,
    DRIFT,
    CERTIFICATE,
];

/// Data for an initial budget file.
#[derive(Clone, Copy, Debug)]
pub struct BudgetTemplate<'a> {
    /// Name of the tested sensor.
    pub sensor: &'a str,
    /// Origin of the samples of the result.
    pub origin: &'a str,
    /// Path of the result, as a command-line argument.
    pub result: &'a str,
    /// Channel that the budget is for.
    pub measurand: &'a str,
    /// Unit of the channel.
    pub unit: &'a str,
    /// Value of the measurand for which the budget is computed, in `unit`.
    pub at: f64,
    /// Figures measured from the result.
    pub evidence: &'a Evidence,
    /// Figures without a measured value, each with its reason.
    pub absent: &'a [Missing],
}

impl BudgetTemplate<'_> {
    /// Text of the budget file, which `taceva budget` accepts unchanged.
    pub fn text(&self) -> String {
        let at = format!("{} {}", self.at, self.unit);
        let mut out = format!(
            "# Uncertainty budget of {}, from a result of {}, samples {}.\n# then: taceva budget THIS.toml --results {}\n",
            line(self.measurand),
            line(self.sensor),
            line(self.origin),
            line(self.result)
        );
        if let Some(words) = not_measured([self.origin]) {
            out += &format!("# {words}\n");
        }
        out += &format!(
            "budget_version = 1\nmeasurand = {}\nat = [{}]\ncoverage = 0.95\n",
            quoted(self.measurand),
            quoted(&at)
        );
        for source in SOURCES {
            let figure = source.figure;
            if let Some(outer) = self.holder(figure) {
                out += &format!("\n# {figure}: measured, and inside `{outer}`\n");
                continue;
            }
            if let Some(found) = self.found(figure) {
                let text = source.text();
                let text = match source.keys.contains('?') {
                    true => format!("# {}\n", text.trim_end().replace('\n', "\n# ")),
                    false => text,
                };
                out += &format!("\n# {}\n{text}", line(&found));
            }
        }
        let remarks = self.remarks(&out);
        out + &remarks
    }

    /// Measured figure that includes the uncertainty of `figure`; `None` without such a figure.
    fn holder(&self, figure: &str) -> Option<&'static str> {
        let is_measured = |figure: &str| self.evidence.figure(figure).is_some();
        let outer: &[BudgetSource] = match figure {
            _ if !is_measured(figure) => &[],
            _ if figure == REPEATS.figure => &[WITHIN],
            _ if figure == ZERO.figure => &[WITHIN, BETWEEN, REPEATS],
            _ => &[],
        };
        let mut outer = outer.iter().map(|source| source.figure);
        outer.find(|figure| is_measured(figure))
    }

    /// Measured figure as text; `None` if it has no value.
    fn found(&self, figure: &str) -> Option<String> {
        if figure == CERTIFICATE.figure {
            let found = self.evidence.certificate()?;
            return Some(format!(
                "certificate {} of {}, serial {}",
                found.number, found.laboratory, found.serial
            ));
        }
        let found: &Figure = self.evidence.figure(figure)?;
        let phrase = |value: f64, unit: &str| {
            FormattedValue::number(value, None).phrase(&format!(" {unit}"))
        };
        if figure == DRIFT.figure {
            let slope = phrase(found.value, &format!("{}/h", self.unit));
            return Some(format!(
                "slope {slope}; state the hours, then remove the `# ` of the lines below"
            ));
        }
        let rows = found.n.map_or_else(String::new, |n| format!(", {n} rows"));
        let clusters = found.clusters;
        let clusters = clusters.map_or_else(String::new, |count| format!(" in {count} clusters"));
        let column = match figure == ZERO.figure {
            true => ", from the column of this name of the samples",
            false => "",
        };
        Some(format!(
            "u = {}{rows}{clusters}, nu {}{column}",
            phrase(found.u, self.unit),
            found.freedom
        ))
    }

    /// Comments on effects that the budget file `written` does not cover.
    fn remarks(&self, written: &str) -> String {
        let parsed = BudgetText::parse(written);
        let budgets = parsed.and_then(|text| text.budgets(self.evidence, None::<MonteCarlo>));
        let missing = match budgets {
            Ok(budgets) => budgets.into_iter().next().map(|of| of.missing),
            Err(error) => return format!("\n# not yet a budget: {}\n", line(&error.to_string())),
        };
        let mut out = String::new();
        let missing = missing.unwrap_or_default();
        for of in &missing {
            out += &self.remark(of);
        }
        let is_named = |absent: &&Missing| {
            let mut missing = missing.iter();
            missing.any(|of| of.source == absent.source)
        };
        for absent in self.absent.iter().filter(|absent| !is_named(absent)) {
            out += &format!("\n# {}: {}\n", absent.source, line(&absent.reason));
        }
        out
    }

    fn remark(&self, missing: &Missing) -> String {
        let source = missing.source.as_str();
        let absent = self.absent.iter().find(|absent| absent.source == source);
        let why = absent.map_or_else(String::new, |absent| format!(": {}", absent.reason));
        let (effect, reason) = missing
            .reason
            .split_once(": ")
            .unwrap_or(("", &missing.reason));
        let words = match source {
            "certificate" => format!("no certificate{why}"),
            _ => format!("{reason}: {effect} ({source}){why}"),
        };
        let mut out = format!("\n# {}\n", line(&words));
        if source == "gauge" {
            out += "# after `taceva gauge … --format json --out gauge.json`:\n# [[source]]\n# name = \"unit to unit\"\n# from = \"gauge.json#unit\"\n";
        }
        out
    }
}
