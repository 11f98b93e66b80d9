//! `taceva curve`.

mod proving;

use std::collections::{BTreeSet, HashMap};
use std::num::NonZeroUsize;

use anyhow::anyhow;
use taceva_core::{Unit, shown};
use taceva_evaluate::read_table;
use taceva_import::{CsvTable, ImportError};
use taceva_metrology::curve::{CurveFit, CurveRow, CurveUndefined, Indication};
use taceva_report::{CalibrationCurve, CurveAxis, CurveFigure, CurveRequest, Table};
use taceva_results::Samples;

use super::quantity::{Quantity, unit_of_six};
use super::{Context, Usage, origin, results};
use crate::args::{Curve, Format};
use crate::{exit, output};

/// Usual column of contact points in tables of samples.
const POINT: &str = "point_id";
/// Least reference value for relative errors, as a share of the greatest.
const LEAST_SHARE: f64 = 0.2;
/// Default number of reference values at which bands are computed.
const BANDS: u8 = 5;

pub(crate) fn run(args: &Curve, context: &Context) -> anyhow::Result<u8> {
    output::check_all_free(&args.output.path, args.output.force)?;
    let found = fitted(args, context.jobs)?;
    let written = match args.output.format {
        Format::Csv => found.numbers(),
        _ => found.table(),
    };
    results::write(&written, &args.output, || found.json())?;
    Ok(exit::DONE)
}

/// Fitted curve with the figures that the arguments request.
pub(crate) struct Fitted {
    curve: CalibrationCurve,
    request: CurveRequest,
    figures: Vec<CurveFigure>,
}

impl Fitted {
    pub(crate) fn table(&self) -> Table {
        self.curve.table(&self.figures, &self.request)
    }

    pub(crate) fn numbers(&self) -> Table {
        self.curve.numbers(&self.figures)
    }

    pub(crate) fn json(&self) -> String {
        self.curve.json(&self.figures, &self.request)
    }
}

/// Fits the curve to the readings in the table of the arguments.
pub(crate) fn fitted(args: &Curve, jobs: NonZeroUsize) -> anyhow::Result<Fitted> {
    let (table, digest) = read_table(&args.table, jobs)?;
    let [x, y] = [axis(&table, &args.x)?, axis(&table, &args.y)?];
    let read = readings(&table, [&x, &y], args)?;
    let fit = CurveFit::of(&read.rows, usize::from(args.order));
    let fit = fit.map_err(|error| refused(error, &table, args))?;
    let series = args.iso376.as_deref();
    let series = series.map(|column| proving::of(&table, [&x, &y], column));
    let request = CurveRequest {
        p: args.band,
        at: places(args, &read.rows),
        readings: args.readings,
        is_simultaneous: args.simultaneous,
        inverted: inverted(args, &y)?,
        detects: args.detect,
        proving: series.transpose()?,
        indicated_points: read.points.map(|_| points_of(indicated(&read.rows))),
        indications: args.iso7500.then(|| {
            let rows = indicated(&read.rows);
            rows.map(|row| Indication::new(row.y, row.x)).collect()
        }),
    };
    let curve = CalibrationCurve {
        x: x.named(&table),
        y: y.named(&table),
        fit,
        rows: read.rows.len(),
        points: read.points,
        rows_left_out: read.left_out,
        sources: origin::of(&table)?,
        digest: digest.to_string(),
    };
    let figures = curve.figures(&request);
    Ok(Fitted {
        figures: figures.map_err(|error| refused(error, &table, args))?,
        curve,
        request,
    })
}

/// Column of an axis, and the unit of its channel.
struct Axis {
    column: usize,
    unit: Option<Unit>,
}

impl Axis {
    fn named(&self, table: &CsvTable) -> CurveAxis {
        CurveAxis {
            column: table.names()[self.column].clone(),
            unit: self.unit.map_or("", |unit| unit.symbol()).to_owned(),
        }
    }
}

/// Finds the column called `word`. `truth.Fz` and `prediction.Fz` select columns of a table of samples.
fn axis(table: &CsvTable, word: &str) -> Result<Axis, ImportError> {
    let predicted = word.strip_prefix("prediction.");
    let predicted = predicted.map(|name| format!("{name}{}", Samples::PREDICTED));
    let truth = word.strip_prefix("truth.").map(str::to_owned);
    let name = match predicted.or(truth) {
        Some(name) if !table.has(word) => name,
        _ => word.to_owned(),
    };
    let channel = name.strip_suffix(Samples::PREDICTED).unwrap_or(&name);
    Ok(Axis {
        column: table.position(&name)?,
        unit: unit_of_six(channel),
    })
}

/// Readings and reference values of the rows that have both.
struct Readings {
    rows: Vec<CurveRow>,
    points: Option<usize>,
    left_out: usize,
}

fn readings(table: &CsvTable, axes: [&Axis; 2], args: &Curve) -> Result<Readings, ImportError> {
    let usual = Some(POINT).filter(|name| table.has(name) && !args.independent);
    let point = args.point.as_deref().or(usual);
    let point = point.map(|name| table.position(name)).transpose()?;
    let mut numbers: HashMap<&str, u64> = HashMap::new();
    let (mut rows, mut left_out) = (Vec::new(), 0);
    for row in 0..table.rows() {
        let [x, y] = axes.map(|axis| table.number(row, axis.column));
        let label = point.map(|column| table.cell(row, column));
        let (Some(x), Some(y), false) = (x?, y?, label == Some("")) else {
            left_out += 1;
            continue;
        };
        let read = CurveRow::new(x, y);
        rows.push(match label {
            Some(label) => {
                let next = numbers.len() as u64;
                read.of_point(*numbers.entry(label).or_insert(next))
            }
            None => read,
        });
    }
    Ok(Readings {
        rows,
        points: point.map(|_| numbers.len()),
        left_out,
    })
}

/// Reference values at which bands are computed.
fn places(args: &Curve, rows: &[CurveRow]) -> Vec<f64> {
    if !args.at.is_empty() {
        return args.at.clone();
    }
    let x = || rows.iter().map(|row| row.x);
    let low = x().fold(f64::INFINITY, f64::min);
    let high = x().fold(f64::NEG_INFINITY, f64::max);
    let share = |step: u8| f64::from(step) / f64::from(BANDS - 1);
    let place = |step: u8| low + share(step) * (high - low);
    (0..BANDS).map(place).collect()
}

/// Rows whose reference value is at least a fifth of the greatest.
fn indicated(rows: &[CurveRow]) -> impl Iterator<Item = &CurveRow> {
    let greatest = rows.iter().map(|row| row.x).fold(0.0, f64::max);
    rows.iter()
        .filter(move |row| row.x >= LEAST_SHARE * greatest)
}

/// Number of distinct contact points of `rows`.
fn points_of<'r>(rows: impl Iterator<Item = &'r CurveRow>) -> usize {
    rows.filter_map(|row| row.point)
        .collect::<BTreeSet<u64>>()
        .len()
}

/// Readings to invert, converted to the unit of y.
fn inverted(args: &Curve, y: &Axis) -> anyhow::Result<Vec<f64>> {
    let mut readings = Vec::with_capacity(args.invert.len());
    for word in &args.invert {
        let reading = Quantity::read("--invert", word)?;
        if let Some(unit) = y.unit.filter(|unit| *unit != reading.unit) {
            return Err(Usage::error(format!(
                "--invert {}: the readings are in {}, expected a reading in this unit",
                shown(&reading.written),
                unit.symbol()
            )));
        }
        // Cells of a column without a unit are not converted.
        if y.unit.is_none() && reading.is_converted {
            return Err(Usage::error(format!(
                "--invert {}: the unit of column {} is unknown, expected a reading in {} for readings in this unit",
                shown(&reading.written),
                shown(&args.y),
                reading.unit.symbol()
            )));
        }
        readings.push(reading.value);
    }
    Ok(readings)
}

/// Error about the arguments, or about the rows of a table.
fn refused(error: CurveUndefined, table: &CsvTable, args: &Curve) -> anyhow::Error {
    match error {
        CurveUndefined::Probability(_) => Usage::error(format!("--band: {error}")),
        _ => anyhow!(
            "{}, {} over {}: {error}",
            shown(table.path()),
            shown(&args.y),
            shown(&args.x)
        ),
    }
}
