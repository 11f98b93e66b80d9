//! Report of a gauge study as text.

use std::fmt;

use taceva_core::counted;
use taceva_metrics::Value;

use super::GaugeReport;

/// Formats a number to four significant digits.
fn digits(number: f64) -> String {
    Value::Scalar(number).to_string()
}

/// Number with both ends of its interval; a dash for a missing number.
fn with_ends(number: Option<f64>, ends: Option<[f64; 2]>) -> String {
    match (number, ends) {
        (Some(number), Some([low, high])) => {
            format!("{} [{}, {}]", digits(number), digits(low), digits(high))
        }
        (Some(number), None) => digits(number),
        (None, _) => "-".to_owned(),
    }
}

impl fmt::Display for GaugeReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let counts = [
            counted(self.parts, "part"),
            counted(self.operators, "operator"),
            counted(self.trials, "trial"),
        ];
        writeln!(f, "{}; intervals of 95 %", counts.join(", "))?;
        let unit = if self.unit.is_empty() {
            "unit of the readings"
        } else {
            &self.unit
        };
        let deviation = format!("sd, {unit}");
        writeln!(
            f,
            "{:<16} {deviation:<34} {:<30} of tolerance, %",
            "component", "of study, %"
        )?;
        for one in &self.components {
            let name = one.name.to_string();
            let sd = with_ends(Some(one.sd), Some(one.ci95));
            let study = with_ends(one.percent_study, one.percent_study_ci95);
            let tolerance = with_ends(one.percent_tolerance, one.percent_tolerance_ci95);
            writeln!(f, "{name:<16} {sd:<34} {study:<30} {tolerance}")?;
        }
        match self.ndc.undefined {
            Some(reason) => writeln!(f, "distinct categories: undefined, {reason}")?,
            None => {
                let ndc = with_ends(self.ndc.value, self.ndc.ci95);
                writeln!(
                    f,
                    "distinct categories: {ndc}, rounded down to {}",
                    self.ndc.floor.unwrap_or_default()
                )?;
            }
        }
        self.flags
            .iter()
            .try_for_each(|flag| writeln!(f, "note: {flag}"))
    }
}
