//! Readings of a channel: its predictions, or their errors.

use taceva_core::{Unit, shown};
use taceva_import::{CsvTable, ImportError};
use taceva_results::Samples;

use crate::args::{Gauge, GaugeResponse};
use crate::cmd::Usage;
use crate::cmd::quantity::{self, Quantity};

/// Columns of the readings of one channel.
pub(super) struct Response {
    pub(super) channel: String,
    pub(super) unit: Option<Unit>,
    prediction: usize,
    /// Column of the truth; `None` if the readings are predictions.
    truth: Option<usize>,
}

/// Readings of the channels that the arguments name, otherwise of all channels with a prediction.
pub(super) fn of(
    table: &CsvTable,
    args: &Gauge,
    tolerance: Option<&Quantity>,
) -> anyhow::Result<Vec<Response>> {
    let names = match args.channels.is_empty() {
        true => usual(table, tolerance)?,
        false => args.channels.clone(),
    };
    let responses = names.iter();
    responses
        .map(|name| checked(table, name, args, tolerance))
        .collect()
}

/// Readings of the channel called `name`. Fails if their unit is not the unit of the tolerance.
fn checked(
    table: &CsvTable,
    name: &str,
    args: &Gauge,
    tolerance: Option<&Quantity>,
) -> anyhow::Result<Response> {
    let response = Response::of(table, name, args.response, tolerance)?;
    match (tolerance, response.unit) {
        (Some(tolerance), Some(unit)) if tolerance.unit != unit => Err(Usage::error(format!(
            "--tolerance {}: channel {} is in {}, expected a width in this unit",
            shown(&tolerance.written),
            shown(name),
            unit.symbol()
        ))),
        // Cells of a column without a unit are not converted.
        (Some(tolerance), _) if quantity::unit_of_six(name).is_none() && tolerance.is_converted => {
            Err(Usage::error(format!(
                "--tolerance {}: the unit of channel {} is unknown, expected a width in {} for readings in this unit",
                shown(&tolerance.written),
                shown(name),
                tolerance.unit.symbol()
            )))
        }
        _ => Ok(response),
    }
}

/// Default channels in the unit of the tolerance: channels with a prediction, otherwise the contact channels in the table.
fn usual(table: &CsvTable, tolerance: Option<&Quantity>) -> anyhow::Result<Vec<String>> {
    let names = || table.names().iter().map(String::as_str);
    let is_of_six = |name: &&str| quantity::unit_of_six(name).is_some();
    let mut found: Vec<&str> = names()
        .filter_map(|of| of.strip_suffix(Samples::PREDICTED))
        .collect();
    if found.is_empty() {
        found = names().filter(is_of_six).collect();
    }
    if let Some(tolerance) = tolerance {
        found.retain(|name| quantity::unit_of_six(name).is_none_or(|unit| unit == tolerance.unit));
    }
    if found.is_empty() {
        let known: Vec<String> = names().map(|name| shown(name).to_string()).collect();
        let unit = tolerance.map_or_else(String::new, |of| format!(" in {}", of.unit.symbol()));
        return Err(Usage::error(format!(
            "{}: no channel{unit}: add --channels with one of the columns {}",
            shown(table.path()),
            known.join(", ")
        )));
    }
    Ok(found.into_iter().map(str::to_owned).collect())
}

impl Response {
    /// Readings of the channel called `name`. A channel other than the six contact channels has the unit of the tolerance.
    fn of(
        table: &CsvTable,
        name: &str,
        kind: Option<GaugeResponse>,
        tolerance: Option<&Quantity>,
    ) -> Result<Response, ImportError> {
        let predicted = format!("{name}{}", Samples::PREDICTED);
        let is_predicted = table.has(&predicted);
        let is_error = match kind {
            Some(kind) => kind == GaugeResponse::Error,
            None => is_predicted && table.has(name),
        };
        let readings = match is_error || is_predicted {
            true => predicted.as_str(),
            false => name,
        };
        Ok(Response {
            channel: name.to_owned(),
            unit: quantity::unit_of_six(name).or(tolerance.map(|of| of.unit)),
            prediction: table.position(readings)?,
            truth: is_error.then(|| table.position(name)).transpose()?,
        })
    }

    /// Kind of the readings, as written in results.
    pub(super) fn name(&self) -> &'static str {
        match self.truth {
            Some(_) => "error",
            None => "prediction",
        }
    }

    /// True if the readings are errors.
    pub(super) fn is_error(&self) -> bool {
        self.truth.is_some()
    }

    /// Column of the readings, for messages.
    pub(super) fn column(&self) -> usize {
        self.prediction
    }

    /// Reading of a row; `None` for an empty cell.
    pub(super) fn reading(&self, table: &CsvTable, row: usize) -> Result<Option<f64>, ImportError> {
        let prediction = table.number(row, self.prediction)?;
        let (Some(prediction), Some(truth)) = (prediction, self.truth) else {
            return Ok(prediction);
        };
        Ok(table.number(row, truth)?.map(|truth| prediction - truth))
    }
}
