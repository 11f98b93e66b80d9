//! Table of a sweep: one row for each task, metric and channel.

mod rows;

use std::collections::BTreeSet;
use std::path::Path;

use taceva_results::{Score, escape_csv};
use taceva_tables::{Cell, ParquetWriter, WrittenColumn, WrittenKind};

use crate::analysis::{Found, Loaded};
use crate::error::SweepError;
use rows::{head, scored, without_scores};

/// Table with typed columns. The same tasks and results give the same bytes in every file format.
pub(crate) struct TidyTable {
    columns: Vec<(String, WrittenKind)>,
    rows: Vec<Vec<Cell>>,
}

impl TidyTable {
    /// Table of all tasks, in list order.
    pub(crate) fn of(loaded: &[Loaded<'_>]) -> TidyTable {
        let settings: BTreeSet<&str> = loaded
            .iter()
            .flat_map(|one| one.task.settings.keys().map(String::as_str))
            .collect();
        let text = |name: &str| (name.to_owned(), WrittenKind::Text);
        let mut columns: Vec<_> = [
            "key",
            "dataset",
            "dataset_digest",
            "source",
            "sensor",
            "serial",
            "model",
        ]
        .map(text)
        .into();
        // The prefix separates a setting from a column of the same name.
        columns.extend(settings.iter().map(|name| text(&format!("set.{name}"))));
        columns.push(text("split"));
        columns.push(("seed".to_owned(), WrittenKind::Integer));
        if loaded.iter().any(|one| one.task.labels.is_some()) {
            columns.push(text("task"));
        }
        columns.extend(["status", "part", "metric", "channel", "unit", "better"].map(text));
        columns.extend(["value", "low", "high"].map(|name| (name.to_owned(), WrittenKind::Number)));
        columns.push(("n".to_owned(), WrittenKind::Integer));
        columns.extend(["by", "reason"].map(text));
        let mut table = TidyTable {
            columns,
            rows: Vec::new(),
        };
        for one in loaded {
            table.push_task(one, &settings);
        }
        table
    }

    fn push_task(&mut self, one: &Loaded<'_>, settings: &BTreeSet<&str>) {
        let result = match &one.found {
            Found::Result(result) => result,
            Found::Failed(reason) => {
                let head = head(one.task, settings, ["", "", ""]);
                self.rows.push(without_scores(head, "failed", reason));
                return;
            }
            Found::Missing => {
                let head = head(one.task, settings, ["", "", ""]);
                self.rows
                    .push(without_scores(head, "missing", "no result yet"));
                return;
            }
        };
        let head = head(
            one.task,
            settings,
            [&result.source, &result.sensor, &result.serial],
        );
        for error in &result.validation {
            let row = Score::of_number("rmse", &error.channel, error.rmse, error.unit);
            self.rows.push(scored(
                head.clone(),
                one.task,
                "validation",
                &row,
                &result.chosen_by,
            ));
        }
        for score in &result.scores {
            self.rows
                .push(scored(head.clone(), one.task, "test", score, ""));
        }
    }

    /// CSV text of the table. Numbers have their shortest form that reads back exactly.
    pub(crate) fn csv(&self) -> Vec<u8> {
        let mut out = Vec::new();
        let line = |out: &mut Vec<u8>, cells: Vec<String>| {
            out.extend(cells.join(",").into_bytes());
            out.push(b'\n');
        };
        line(
            &mut out,
            self.columns.iter().map(|(name, _)| field(name)).collect(),
        );
        for row in &self.rows {
            let cells = row.iter().map(|cell| match cell {
                Cell::Text(text) => field(text),
                Cell::Number(number) => format!("{number:?}"),
                Cell::Integer(number) => number.to_string(),
                _ => String::new(),
            });
            line(&mut out, cells.collect());
        }
        out
    }

    /// Writes a Parquet file to `path`, which must not exist.
    pub(crate) fn write_parquet(&self, path: &Path) -> Result<(), SweepError> {
        let columns = self.columns.iter();
        let columns = columns.map(|(name, kind)| WrittenColumn::new(name.as_str(), kind.clone()));
        let columns: Vec<WrittenColumn> = columns.collect();
        let mut writer = ParquetWriter::create(path, &columns, &[])?;
        for row in &self.rows {
            writer.push(row.clone())?;
        }
        Ok(writer.finish()?)
    }
}

/// Converts text to a CSV cell, with quotes if necessary. Escapes text that a spreadsheet would read as a formula.
fn field(text: &str) -> String {
    let text = escape_csv(text);
    match text.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text,
    }
}
