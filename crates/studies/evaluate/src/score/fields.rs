//! Columns of a table other than channels: contact point, scene, repeat and others.

use taceva_core::{Column, Field, FieldSet, GratingKind, Labels, Nanometre, Phase};
use taceva_import::CsvTable;

use crate::error::EvaluateError;

/// Columns of a table that are not channels, besides row keys.
pub(super) const NOT_CHANNELS: [&str; 13] = [
    "point_id",
    "scene",
    "unit_id",
    "repeat",
    "depth_step",
    "phase",
    "part",
    "kind",
    "spacing_mm",
    "zero_u_mm",
    "intensity",
    "t_s",
    "frame_sha256",
];

/// Fields that either table may contain. The truth is searched first.
const OF_EITHER: [Field; 10] = [
    Field::Point,
    Field::DepthStep,
    Field::Repeat,
    Field::Phase,
    Field::Scene,
    Field::UnitId,
    Field::Stamp,
    Field::Kind,
    Field::Intensity,
    Field::FrameDigest,
];

/// Column of the grating spacing. The truth contains the actual spacing, and the predictions contain the predicted spacing.
const SPACING: &str = "spacing_mm";

/// Location of a field.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub(super) field: Field,
    /// True if the field is in the table of the truth.
    pub(super) in_truth: bool,
    pub(super) column: usize,
}

/// Locations of all fields that either table contains.
pub(super) fn places(truth: &CsvTable, prediction: &CsvTable) -> Result<Vec<Place>, EvaluateError> {
    let mut places = Vec::new();
    let mut state = |field, in_truth, name: &str| -> Result<(), EvaluateError> {
        let table = if in_truth { truth } else { prediction };
        let column = table.position(name)?;
        places.push(Place {
            field,
            in_truth,
            column,
        });
        Ok(())
    };
    for field in OF_EITHER {
        match (truth.has(field.name()), prediction.has(field.name())) {
            (true, _) => state(field, true, field.name())?,
            (false, true) => state(field, false, field.name())?,
            (false, false) => {}
        }
    }
    if truth.has(SPACING) {
        state(Field::Spacing, true, SPACING)?;
    }
    if prediction.has(SPACING) {
        state(Field::PredictedSpacing, false, SPACING)?;
    }
    Ok(places)
}

/// Set of the fields in `places`.
pub(super) fn stated(places: &[Place]) -> FieldSet {
    let fields = places.iter().map(|place| place.field);
    FieldSet::EMPTY.with(Field::Truth).with(Field::Prediction) | fields.collect()
}

/// Names in some rows of a column; `None` for an empty cell.
///
/// # Errors
/// [`EvaluateError`] with the cell if the field has a fixed list of names and the name is not in it.
pub(super) fn labels(
    table: &CsvTable,
    field: Field,
    column: usize,
    rows: impl Iterator<Item = usize>,
) -> Result<Labels, EvaluateError> {
    let expected = |name: &str| match field {
        Field::Phase if Phase::from_name(name).is_none() => Some("expected `load` or `unload`"),
        Field::Kind if GratingKind::from_name(name).is_none() => Some("expected `line` or `dot`"),
        _ => None,
    };
    let mut labels = Labels::default();
    for row in rows {
        let name = table.cell(row, column);
        if name.is_empty() {
            labels.push_absent();
        } else if let Some(expected) = expected(name) {
            return Err(table.refuse(row, column, expected).into());
        } else {
            labels.push(name);
        }
    }
    Ok(labels)
}

/// Numbers in some rows of a column of counts or spacings. An empty cell is undefined.
///
/// # Errors
/// [`EvaluateError`] with the cell if it is not a nonnegative whole number, or not a length in a column of spacings.
pub(super) fn exact_numbers(
    table: &CsvTable,
    field: Field,
    column: usize,
    rows: impl Iterator<Item = usize>,
) -> Result<Column, EvaluateError> {
    let is_length = matches!(field, Field::Spacing | Field::PredictedSpacing);
    let mut numbers = Column::default();
    for row in rows {
        let cell = table.cell(row, column);
        let (number, expected) = if is_length {
            let length = cell.parse().ok().map(Nanometre::to_f64);
            (length, "expected a spacing in mm, such as 0.35")
        } else {
            let count = cell.strip_suffix(".0").unwrap_or(cell).parse::<u32>().ok();
            (count.map(f64::from), "expected a whole number from 0")
        };
        if number.is_none() && !cell.is_empty() {
            return Err(table.refuse(row, column, expected).into());
        }
        numbers.push(number);
    }
    Ok(numbers)
}
