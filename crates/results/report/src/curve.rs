//! Calibration curve of a table, for readers and programs.

mod figures;

use serde::Serialize;
use taceva_core::counted;
use taceva_metrology::curve::{CurveFit, Indication, ProvingSeries};
use taceva_results::not_measured;

use crate::number::FormattedValue;
use crate::table::{Cell, Table};

/// Schema of a calibration curve as JSON.
pub const CURVE_SCHEMA: &str = "taceva.curve/1";

/// Column of a table with its unit.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct CurveAxis {
    /// Name of the column.
    pub column: String,
    /// Unit of the column; empty if the table states no unit.
    pub unit: String,
}

/// Request for figures of a curve, such as bands, predictions and detection limits.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveRequest {
    /// Coverage probability of confidence bands, prediction bands and intervals of inverse predictions, 0 to 1.
    pub p: f64,
    /// Reference values at which the confidence band and the prediction band of the curve are computed.
    pub at: Vec<f64>,
    /// Number of new readings whose mean is predicted or inverted.
    pub readings: u32,
    /// True for a simultaneous confidence band over all reference values.
    pub is_simultaneous: bool,
    /// Readings for which reference values are predicted.
    pub inverted: Vec<f64>,
    /// True to compute detection limits.
    pub detects: bool,
    /// Readings for relative errors in the manner of ISO 7500-1; `None` if not requested.
    pub indications: Option<Vec<Indication>>,
    /// Number of contact points of `indications`; `None` for independent rows.
    pub indicated_points: Option<usize>,
    /// Series for relative errors in the manner of ISO 376; `None` if not requested.
    pub proving: Option<ProvingSeries>,
}

/// Fitted calibration curve, with the origin of its data.
#[derive(Clone, Debug, PartialEq)]
pub struct CalibrationCurve {
    /// Column of the reference values.
    pub x: CurveAxis,
    /// Column of the readings.
    pub y: CurveAxis,
    /// Fitted polynomial.
    pub fit: CurveFit,
    /// Number of fitted rows.
    pub rows: usize,
    /// Number of contact points of the rows; `None` for independent rows.
    pub points: Option<usize>,
    /// Number of skipped rows, which lack a number or a contact point.
    pub rows_left_out: usize,
    /// Origins of the samples, such as `recorded` and `simulated`.
    pub sources: Vec<String>,
    /// Digest of the table.
    pub digest: String,
}

/// One computed figure of a curve, such as a prediction.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct CurveFigure {
    /// Name of the figure, such as `prediction`.
    pub quantity: String,
    /// Reference value, or the reading of an inverse prediction; `None` for figures of the whole curve.
    pub at: Option<f64>,
    /// Value of the figure; `None` if undefined.
    pub value: Option<f64>,
    /// Ends of the band or interval; `None` if undefined.
    pub ends: Option<[f64; 2]>,
    /// Standard uncertainty of the value; `None` if not computed.
    pub u: Option<f64>,
    /// Degrees of freedom of `u`; `None` if not computed.
    pub freedom: Option<f64>,
    /// Unit of the value.
    pub unit: String,
    /// Origin of the covariance, or the reason why the value is undefined.
    pub remark: String,
}

/// JSON of a curve.
#[derive(Serialize)]
struct Document<'a> {
    schema: &'a str,
    x: &'a CurveAxis,
    y: &'a CurveAxis,
    order: usize,
    n: usize,
    points: Option<usize>,
    rows_left_out: usize,
    p: f64,
    readings: u32,
    covariance: Vec<Vec<f64>>,
    figures: &'a [CurveFigure],
    digest: &'a str,
    sources: &'a [String],
    not_measured: Option<String>,
}

impl CalibrationCurve {
    /// Table for readers with one row for each figure.
    pub fn table(&self, figures: &[CurveFigure], request: &CurveRequest) -> Table {
        let points = self.points.map_or_else(String::new, |points| {
            format!(" of {}", counted(points, "point"))
        });
        let caption = format!(
            "Calibration curve of order {}: {} over {}, {}{points}; bands of {} %",
            self.fit.order(),
            self.y.column,
            self.x.column,
            counted(self.rows, "row"),
            100.0 * request.p,
        );
        let columns = ["quantity", "at", "value", "unit", "u", "ν", "remark"];
        let mut table = Table::new(caption, columns);
        for figure in figures {
            let number = |value: Option<f64>| {
                value.map_or_else(String::new, |value| {
                    FormattedValue::number(value, None).value
                })
            };
            table.push([
                Cell::text(figure.quantity.as_str()),
                Cell::from(number(figure.at)),
                Cell::estimate(figure.value, figure.ends),
                Cell::text(figure.unit.as_str()),
                Cell::from(number(figure.u)),
                Cell::from(figure.freedom.map_or_else(String::new, |of| of.to_string())),
                Cell::text(figure.remark.as_str()),
            ]);
        }
        if self.rows_left_out > 0 {
            table.note(format!(
                "{} left out: no number or no point.",
                counted(self.rows_left_out, "row")
            ));
        }
        table.note_all(self.not_measured());
        table
    }

    /// Table for programs with one row for each figure, and numbers in shortest round-trip form.
    pub fn numbers(&self, figures: &[CurveFigure]) -> Table {
        let columns = [
            "quantity",
            "at",
            "value",
            "unit",
            "low",
            "high",
            "u",
            "degrees_of_freedom",
            "remark",
            "source",
        ];
        let mut table = Table::new("Calibration curve", columns);
        for figure in figures {
            table.push([
                Cell::text(figure.quantity.as_str()),
                Cell::exact(figure.at),
                Cell::exact(figure.value),
                Cell::text(figure.unit.as_str()),
                Cell::exact(figure.ends.map(|[low, _]| low)),
                Cell::exact(figure.ends.map(|[_, high]| high)),
                Cell::exact(figure.u),
                Cell::exact(figure.freedom),
                Cell::text(figure.remark.as_str()),
                Cell::text(self.sources.join(" ")),
            ]);
        }
        table
    }

    /// JSON of [`CURVE_SCHEMA`].
    pub fn json(&self, figures: &[CurveFigure], request: &CurveRequest) -> String {
        let document = Document {
            schema: CURVE_SCHEMA,
            x: &self.x,
            y: &self.y,
            order: self.fit.order(),
            n: self.rows,
            points: self.points,
            rows_left_out: self.rows_left_out,
            p: request.p,
            readings: request.readings,
            covariance: self.fit.covariance(),
            figures,
            digest: &self.digest,
            sources: &self.sources,
            not_measured: self.not_measured(),
        };
        let text = serde_json::to_string_pretty(&document);
        format!("{}\n", text.expect("names are texts"))
    }

    fn not_measured(&self) -> Option<String> {
        not_measured(self.sources.iter().map(String::as_str))
    }
}
