//! Gauge studies of the channels of one table, for readers and programs.

use serde::Serialize;
use taceva_core::counted;
use taceva_metrology::gauge::{Band, Design, GaugeReport, Method};
use taceva_results::not_measured;

use crate::number::FormattedValue;
use crate::table::{Cell, Column, Table};

/// Columns of the readings that identify parts, operators and trials.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct GaugeColumns {
    /// Columns that identify the part.
    pub part: Vec<String>,
    /// Columns that identify the operator.
    pub by: Vec<String>,
    /// Columns that identify the trial.
    pub trial: Vec<String>,
}

/// Gauge study of one channel.
#[derive(Clone, Debug, PartialEq)]
pub struct ChannelGauge {
    /// Name of the channel.
    pub channel: String,
    /// Definition of the readings: `error` (prediction minus truth), or `prediction`.
    pub response: &'static str,
    /// Number of skipped rows, which lack a reading or a label.
    pub rows_left_out: usize,
    /// Variance components with their intervals.
    pub report: GaugeReport,
}

/// Gauge studies of the channels of one table, with the same columns and settings.
#[derive(Clone, Debug, PartialEq)]
pub struct GaugeStudies {
    /// Columns that identify parts, operators and trials.
    pub columns: GaugeColumns,
    /// Origins of the samples, such as `recorded` and `simulated`.
    pub sources: Vec<String>,
    /// Digest of the table.
    pub digest: String,
    /// One study for each channel.
    pub channels: Vec<ChannelGauge>,
}

/// JSON of one channel: the gauge study and its readings.
#[derive(Serialize)]
struct Document<'a> {
    #[serde(flatten)]
    report: &'a GaugeReport,
    channel: &'a str,
    response: &'a str,
    columns: &'a GaugeColumns,
    rows_left_out: usize,
    digest: &'a str,
    sources: &'a [String],
    not_measured: Option<String>,
    remarks: Vec<String>,
}

impl GaugeStudies {
    /// Table for readers with one row for each component.
    pub fn table(&self) -> Table {
        let mut studies = self.channels.iter();
        let has_tolerance = studies.any(|of| of.report.tolerance.is_some());
        let mut columns = vec![
            Column::new("channel"),
            Column::new("component"),
            Column::new("deviation"),
            Column::new("unit"),
            Column::new("of variance").unit("%"),
            Column::new("of study").unit("%"),
        ];
        columns.extend(has_tolerance.then(|| Column::new("of tolerance").unit("%")));
        let mut table = Table::new(self.caption(), columns);
        for of in &self.channels {
            for one in &of.report.components {
                let mut cells = vec![
                    Cell::text(of.channel.as_str()),
                    Cell::text(one.name.to_string()),
                    estimate(Some(one.sd), Some(one.ci95)),
                    Cell::text(of.report.unit.as_str()),
                    estimate(one.percent_contribution, None),
                    estimate(one.percent_study, one.percent_study_ci95),
                ];
                cells.extend(
                    has_tolerance
                        .then(|| estimate(one.percent_tolerance, one.percent_tolerance_ci95)),
                );
                table.push(cells);
            }
        }
        for of in &self.channels {
            for words in of.summary().into_iter().chain(of.remarks()) {
                table.note(format!("{}: {words}.", of.channel));
            }
        }
        table.note_all(self.not_measured());
        table
    }

    /// Table for programs: one row for each number, in shortest round-trip form, and one row for each remark.
    pub fn numbers(&self) -> Table {
        let columns = [
            "channel",
            "response",
            "component",
            "quantity",
            "value",
            "unit",
            "ci95_low",
            "ci95_high",
            "remark",
            "source",
        ];
        let mut table = Table::new("Gauge study", columns);
        let source = self.sources.join(" ");
        for of in &self.channels {
            let mut push = |number: &Number<'_>| table.push(number.cells(of, &source));
            for one in &of.report.components {
                let unit = of.report.unit.as_str();
                let squared = match unit {
                    "" => String::new(),
                    unit => format!("{unit}²"),
                };
                let name = one.name.to_string();
                let number = |quantity, unit, value, ends| Number {
                    component: &name,
                    quantity,
                    unit,
                    value,
                    ends,
                    remark: "",
                };
                push(&number("sd", unit, Some(one.sd), Some(one.ci95)));
                push(&number(
                    "variance",
                    squared.as_str(),
                    Some(one.variance),
                    None,
                ));
                push(&number(
                    "percent_contribution",
                    "%",
                    one.percent_contribution,
                    None,
                ));
                push(&number(
                    "percent_study",
                    "%",
                    one.percent_study,
                    one.percent_study_ci95,
                ));
                if of.report.tolerance.is_some() {
                    push(&number(
                        "percent_tolerance",
                        "%",
                        one.percent_tolerance,
                        one.percent_tolerance_ci95,
                    ));
                }
            }
            let ndc = &of.report.ndc;
            let undefined = ndc.undefined.map(|reason| reason.to_string());
            push(&Number {
                quantity: "ndc",
                unit: "1",
                value: ndc.value,
                ends: ndc.ci95,
                remark: undefined.as_deref().unwrap_or_default(),
                ..Number::default()
            });
            for remark in of.remarks() {
                push(&Number {
                    quantity: "remark",
                    remark: &remark,
                    ..Number::default()
                });
            }
        }
        table
    }

    /// JSON of one channel with its readings, with the schema `taceva.gauge/1`.
    pub fn json(&self, of: &ChannelGauge) -> String {
        let document = Document {
            report: &of.report,
            channel: &of.channel,
            response: of.response,
            columns: &self.columns,
            rows_left_out: of.rows_left_out,
            digest: &self.digest,
            sources: &self.sources,
            not_measured: self.not_measured(),
            remarks: of.remarks(),
        };
        let text = serde_json::to_string_pretty(&document);
        format!("{}\n", text.expect("names are texts"))
    }

    fn not_measured(&self) -> Option<String> {
        not_measured(self.sources.iter().map(String::as_str))
    }

    fn caption(&self) -> String {
        let report = self.channels.first().map(|of| &of.report);
        let design = match report.map(|report| report.design) {
            Some(Design::Nested) => "nested",
            _ => "crossed",
        };
        let method = match report.map(|report| report.method) {
            Some(Method::Range) => "average and range",
            _ => "analysis of variance",
        };
        let GaugeColumns { part, by, trial } = &self.columns;
        let [part, by, trial] = [part, by, trial].map(|names| names.join(" and "));
        format!(
            "Gauge study, {design}, by {method}, with 95 % intervals: parts by {part}, operators by {by}, trials by {trial}"
        )
    }
}

impl ChannelGauge {
    /// Sentences with the size of the gauge study, the number of distinct categories, and the AIAG class.
    fn summary(&self) -> Vec<String> {
        let report = &self.report;
        let parts = match report.design {
            Design::Nested => format!("{} of each operator", counted(report.parts, "part")),
            _ => counted(report.parts, "part"),
        };
        let readings = match self.response {
            "error" => "errors, prediction minus truth",
            _ => "readings",
        };
        let size = format!(
            "{readings} of {parts}, {}, {}",
            counted(report.operators, "operator"),
            counted(report.trials, "trial")
        );
        let ndc = match (report.ndc.value, report.ndc.undefined) {
            (Some(value), _) => format!(
                "{} distinct categories, rounded down to {}",
                FormattedValue::number(value, finite(report.ndc.ci95)).phrase(""),
                report.ndc.floor.unwrap_or_default()
            ),
            (None, Some(reason)) => format!("distinct categories undefined, {reason}"),
            (None, None) => "distinct categories undefined".to_owned(),
        };
        let band = report.band.map(|band| {
            let ends = report.band_ci95.map_or_else(String::new, |[low, high]| {
                format!(
                    "; from {} to {} within the interval",
                    band_name(low),
                    band_name(high)
                )
            });
            format!(
                "the gauge is {} by its share of the study{ends} (AIAG: below 10 % acceptable, above 30 % unacceptable)",
                band_name(band)
            )
        });
        [size, ndc].into_iter().chain(band).collect()
    }

    /// Remarks on the gauge study, without full stops at the end.
    fn remarks(&self) -> Vec<String> {
        let flags = self.report.flags.iter().map(ToString::to_string);
        let left_out = (self.rows_left_out > 0).then(|| {
            format!(
                "{} left out, without a reading or without a label",
                counted(self.rows_left_out, "row")
            )
        });
        flags.chain(left_out).collect()
    }
}

/// Row of the table for programs.
#[derive(Clone, Copy, Debug, Default)]
struct Number<'a> {
    component: &'a str,
    quantity: &'a str,
    unit: &'a str,
    value: Option<f64>,
    ends: Option<[f64; 2]>,
    remark: &'a str,
}

impl Number<'_> {
    fn cells(&self, of: &ChannelGauge, source: &str) -> [Cell; 10] {
        [
            Cell::text(of.channel.as_str()),
            Cell::text(of.response),
            Cell::text(self.component),
            Cell::text(self.quantity),
            Cell::exact(self.value),
            Cell::text(self.unit),
            Cell::exact(self.ends.map(|[low, _]| low)),
            Cell::exact(self.ends.map(|[_, high]| high)),
            Cell::text(self.remark),
            Cell::text(source),
        ]
    }
}

fn band_name(band: Band) -> &'static str {
    match band {
        Band::Acceptable => "acceptable",
        Band::Conditional => "conditional",
        _ => "unacceptable",
    }
}

fn finite(ends: Option<[f64; 2]>) -> Option<[f64; 2]> {
    ends.filter(|ends| ends.iter().all(|end| end.is_finite()))
}

fn estimate(value: Option<f64>, ends: Option<[f64; 2]>) -> Cell {
    Cell::estimate(value, finite(ends))
}
