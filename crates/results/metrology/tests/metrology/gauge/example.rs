//! Readings of AIAG's worked example.

use serde_json::Value;
use taceva_metrology::gauge::{GaugeReport, GaugeSettings, GaugeStudy};

use crate::support::golden;

pub(crate) fn file() -> Value {
    golden(include_str!("../../golden/msa.json"))
}

/// One reading.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    pub(crate) part: String,
    pub(crate) operator: String,
    pub(crate) trial: String,
    pub(crate) value: f64,
}

/// Readings of AIAG's worked example, multiplied by `factor`.
pub(crate) fn readings(factor: f64) -> Vec<Row> {
    let file = file();
    let mut all = Vec::new();
    for operator in ["A", "B", "C"] {
        for (trial, row) in file["data"][operator]
            .as_array()
            .expect("trials")
            .iter()
            .enumerate()
        {
            for (part, value) in row.as_array().expect("parts").iter().enumerate() {
                let value = value.as_f64().expect("a number") * factor;
                let value = if factor > 1.0 { value.round() } else { value };
                all.push(Row {
                    part: format!("part {part}"),
                    operator: operator.to_owned(),
                    trial: trial.to_string(),
                    value,
                });
            }
        }
    }
    all
}

pub(crate) fn study_of(readings: &[Row]) -> GaugeStudy {
    let mut study = GaugeStudy::default();
    for row in readings {
        study
            .add(&row.part, &row.operator, &row.trial, row.value)
            .expect("finite");
    }
    study
}

pub(crate) fn settings(change: impl FnOnce(&mut GaugeSettings)) -> GaugeSettings {
    let mut settings = GaugeSettings::default();
    settings.draws = 2000;
    change(&mut settings);
    settings
}

pub(crate) fn analyse(change: impl FnOnce(&mut GaugeSettings)) -> GaugeReport {
    study_of(&readings(1.0))
        .analyse(&settings(change))
        .expect("a report")
}
