//! Table of a recording as Arrow columns.

use taceva_core::shown;
use taceva_dataset::{Dataset, Table, TaskColumn, TaskKind, TaskLabel};

use pyo3::prelude::*;
use pyo3::types::PyCapsule;

use crate::arrow::{self, ArrowColumn, Cells};

/// Table of `dataset`: one row for each sample, one column for each label in its unit, and all other non-empty columns.
pub(crate) fn stream<'py>(py: Python<'py>, dataset: &Dataset) -> PyResult<Bound<'py, PyCapsule>> {
    let table = dataset.table();
    let mut columns = Vec::new();
    for name in Table::NAMES
        .into_iter()
        .chain(table.attribute_names().iter().map(String::as_str))
    {
        let unit: &[(&str, &str)] = match name {
            "t_s" => &[("unit", "s")],
            "spacing_mm" | "zero_u_mm" => &[("unit", "mm")],
            _ => &[],
        };
        let cells = cells(table, name).filter(|cells| !cells.are_absent());
        if let Some(cells) = cells {
            columns.push(ArrowColumn::new(name, cells, unit)?);
        }
    }
    for own in table.tasks() {
        for (part, name) in own.task().columns().iter().enumerate() {
            columns.push(ArrowColumn::new(
                name,
                of_task(own, part, table.rows()),
                &[],
            )?);
        }
    }
    for (position, channel) in table.channels().iter().enumerate() {
        let truth = table.truth(position);
        let labels = (0..table.rows()).map(|row| truth.get(row)).collect();
        let unit = [("unit", channel.unit().symbol())];
        columns.push(ArrowColumn::new(
            channel.name(),
            Cells::Numbers(labels),
            &unit,
        )?);
    }
    let digest = dataset.digest().to_string();
    let path = shown(dataset.path()).to_string();
    let metadata = [
        ("taceva.sensor", dataset.header().sensor.model.as_str()),
        (
            "taceva.source",
            &taceva_evaluate::subject_of(dataset).source,
        ),
        ("taceva.digest", &digest),
        ("taceva.path", &path),
    ];
    arrow::stream(py, table.rows(), columns, &metadata)
}

/// Column of a task's labels. For poses and places, it has the numbers with index `part`. For depth maps, it has the
/// places of the maps if `part` is 0, else their digests. For other tasks, it has the names of classes.
fn of_task(own: &TaskColumn, part: usize, rows: usize) -> Cells {
    match own.task().kind {
        TaskKind::Pose | TaskKind::Place => {
            let number = |row: usize| match own.label(row)? {
                TaskLabel::Pose(pose) => Some(pose[part]),
                TaskLabel::Place(place) => Some(place[part]),
                _ => None,
            };
            Cells::Numbers((0..rows).map(number).collect())
        }
        TaskKind::Depth => {
            let text = |row: usize| match own.label(row)? {
                TaskLabel::Map(entry) if part == 0 => Some(entry.to_string()),
                TaskLabel::Map(entry) => Some(entry.digest().to_string()),
                _ => None,
            };
            Cells::Texts((0..rows).map(text).collect())
        }
        _ => Cells::Texts(
            (0..rows)
                .map(|row| own.class(row).map(str::to_owned))
                .collect(),
        ),
    }
}

/// Cells of the column called `name`; `None` for an unknown name.
fn cells(table: &Table, name: &str) -> Option<Cells> {
    Some(match name {
        "depth_step" => Cells::Counts(table.depth_step().to_vec()),
        "repeat" => Cells::Counts(table.repeat().to_vec()),
        "source_row" => Cells::Counts(table.source_row().to_vec()),
        "t_s" => Cells::Numbers(table.t_s().to_vec()),
        "zero_u_mm" => Cells::Numbers(table.zero_u_mm().to_vec()),
        "intensity" => Cells::Numbers(table.intensity().to_vec()),
        "spacing_mm" => {
            let spacing = table.spacing().iter();
            Cells::Numbers(
                spacing
                    .map(|spacing| spacing.map(|spacing| spacing.to_millimetres()))
                    .collect(),
            )
        }
        name => Cells::Texts(table.as_text(name)?),
    })
}
