//! Converts the columns of a file to rows of a table.

use std::collections::BTreeMap;

use taceva_core::{Channels, GratingKind, Limit, MAGNITUDE_MAX, Nanometre, Phase, is_scorable};

use super::read::Stored;
use crate::digest::Digest;
use crate::pack::Span;
use crate::table::{FrameEntry, Row, RowFrame, Table, column_of};
use crate::task::{MapEntry, Task, TaskKind, TaskLabel};

/// Columns of a file, by name.
struct Columns(BTreeMap<String, Stored>);

impl Columns {
    fn text(&mut self, name: &str, row: usize) -> Result<Option<String>, String> {
        match self.0.get_mut(name) {
            None => Ok(None),
            Some(Stored::Text(cells)) => Ok(cells[row].take()),
            Some(_) => Err(format!("column `{name}` holds numbers, expected text")),
        }
    }

    fn frame(
        &mut self,
        place: &str,
        digest: &str,
        row: usize,
    ) -> Result<Option<FrameEntry>, String> {
        let place = self.text(place, row)?;
        let digest = self.text(digest, row)?;
        frame_entry(row, place, digest)
    }

    fn view(&mut self, view: &str, row: usize) -> Result<RowFrame, String> {
        let of = |column| column_of(column, view);
        let mut frame = RowFrame::default();
        frame.source_frame = self.text(&of("source_frame"), row)?;
        frame.intensity = self.number(&of("intensity"), row)?;
        frame.frame = self.frame(&of("frame"), &of("frame_sha256"), row)?;
        Ok(frame)
    }

    fn number(&self, name: &str, row: usize) -> Result<Option<f64>, String> {
        match self.0.get(name) {
            None => Ok(None),
            Some(Stored::Number(cells)) => match cells[row] {
                Some(number) if !is_scorable(number) => Err(format!(
                    "column `{name}`, row {row}: {number:e} is not a finite number up to {MAGNITUDE_MAX:.3e}"
                )),
                cell => Ok(cell),
            },
            Some(_) => Err(format!("column `{name}` holds no numbers")),
        }
    }

    fn count(&self, name: &str, row: usize) -> Result<Option<u32>, String> {
        match self.0.get(name) {
            None => Ok(None),
            Some(Stored::Count(cells)) => cells[row]
                .map(u32::try_from)
                .transpose()
                .map_err(|_| format!("column `{name}`, row {row}: expected a count below 2^32")),
            Some(_) => Err(format!("column `{name}` holds no counts")),
        }
    }

    /// Label of a task, whose columns on disk are `names`.
    fn label(
        &mut self,
        task: &Task,
        names: &[String],
        row: usize,
    ) -> Result<Option<TaskLabel>, String> {
        let name = names.first().map_or("", String::as_str);
        if task.kind == TaskKind::Depth {
            return self.map(names, row);
        }
        if task.kind.has_classes() {
            return match self.count(name, row)? {
                Some(class) if class as usize >= task.names.len() => Err(format!(
                    "column `{name}`, row {row}: class {class}, but the task has {}, counted from 0",
                    taceva_core::counted(task.names.len(), "class")
                )),
                class => Ok(class.map(TaskLabel::Class)),
            };
        }
        let parts = names.iter().map(|name| self.number(name, row));
        let parts: Vec<Option<f64>> = parts.collect::<Result<_, _>>()?;
        if parts.iter().all(Option::is_none) {
            return Ok(None);
        }
        let parts: Option<Vec<f64>> = parts.into_iter().collect();
        match parts.and_then(|parts| TaskLabel::of_numbers(&parts)) {
            Some(label) => Ok(Some(label)),
            None => Err(format!(
                "row {row}: the {} of `{}` lacks a number",
                task.kind.name(),
                task.name
            )),
        }
    }

    /// Depth map at the place and with the digest in the columns `names`.
    fn map(&mut self, names: &[String], row: usize) -> Result<Option<TaskLabel>, String> {
        let [place, digest] = names else {
            return Ok(None);
        };
        let found = (self.text(place, row)?, self.text(digest, row)?);
        let (found_place, found_digest) = match found {
            (None, None) => return Ok(None),
            (Some(place), Some(digest)) => (place, digest),
            _ => {
                return Err(format!(
                    "row {row} has a depth map in `{place}` or a digest in `{digest}`, but not both"
                ));
            }
        };
        let span = found_place.parse::<Span>().map_err(|()| {
            format!("column `{place}`, row {row}: `{found_place}` is not a place in a pack")
        })?;
        let digest = found_digest
            .parse::<Digest>()
            .map_err(|error| format!("column `{digest}`, row {row}: {error}"))?;
        Ok(Some(TaskLabel::Map(MapEntry { span, digest })))
    }
}

/// Table with the rows of `columns`.
pub(super) fn assemble(
    columns: BTreeMap<String, Stored>,
    channels: &Channels,
    attributes: &[String],
    views: &[&str],
    tasks: &[Task],
) -> Result<Table, String> {
    let rows = columns.values().map(Stored::len).max().unwrap_or(0);
    if rows > 0 {
        let missing = channels
            .iter()
            .find(|channel| !columns.contains_key(channel.name()));
        if let Some(channel) = missing {
            return Err(format!("no column `{channel}`"));
        }
    }
    let mut columns = Columns(columns);
    let table = Table::new(channels.clone(), attributes.to_vec());
    let table = table.with_views(views.iter().copied());
    let mut table = table.with_tasks(tasks.iter().cloned());
    let labels: Vec<(Task, Vec<String>)> = table
        .tasks()
        .iter()
        .map(|own| (own.task().clone(), own.task().columns()))
        .collect();
    for row in 0..rows {
        let frame = columns.frame("frame", "frame_sha256", row)?;
        let own = views.iter().map(|view| columns.view(view, row));
        let own: Vec<RowFrame> = own.collect::<Result<_, _>>()?;
        table.push(Row {
            sample: columns
                .text("sample", row)?
                .ok_or_else(|| format!("row {row} has no sample name"))?,
            point_id: columns.text("point_id", row)?,
            unit_id: columns.text("unit_id", row)?,
            scene: columns.text("scene", row)?,
            depth_step: columns.count("depth_step", row)?,
            repeat: columns.count("repeat", row)?,
            phase: known(columns.text("phase", row)?, Phase::from_name)
                .ok_or_else(|| format!("row {row}: column `phase` has an unknown word"))?,
            limited_by: known(columns.text("limited_by", row)?, Limit::from_name)
                .ok_or_else(|| format!("row {row}: column `limited_by` has an unknown word"))?,
            zero_u_mm: columns.number("zero_u_mm", row)?,
            source_table: columns.text("source_table", row)?,
            source_row: columns.count("source_row", row)?,
            source_frame: columns.text("source_frame", row)?,
            part: columns.text("part", row)?,
            t_s: columns.number("t_s", row)?,
            kind: known(columns.text("kind", row)?, GratingKind::from_name)
                .ok_or_else(|| format!("row {row}: column `kind` has an unknown word"))?,
            spacing: columns
                .number("spacing_mm", row)?
                .map(|length| {
                    Nanometre::from_millimetres(length)
                        .ok_or_else(|| format!("row {row}: {length} mm is not a valid spacing"))
                })
                .transpose()?,
            intensity: columns.number("intensity", row)?,
            truth: channels
                .iter()
                .map(|channel| columns.number(channel.name(), row))
                .collect::<Result<_, _>>()?,
            attributes: attributes
                .iter()
                .map(|name| columns.text(name, row))
                .collect::<Result<_, _>>()?,
            frame,
            views: own,
            tasks: labels
                .iter()
                .map(|(task, names)| columns.label(task, names, row))
                .collect::<Result<_, _>>()?,
        });
    }
    Ok(table)
}

/// Parses the name in a cell, which may be empty; `None` for an unknown name.
fn known<T>(name: Option<String>, of: impl Fn(&str) -> Option<T>) -> Option<Option<T>> {
    name.map_or(Some(None), |name| of(&name).map(Some))
}

fn frame_entry(
    row: usize,
    path: Option<String>,
    digest: Option<String>,
) -> Result<Option<FrameEntry>, String> {
    match (path, digest) {
        (None, None) => Ok(None),
        (Some(path), Some(digest)) => {
            let digest: Digest = digest
                .parse()
                .map_err(|error| format!("row {row}: {error}"))?;
            Ok(Some(FrameEntry::at(path, digest)))
        }
        _ => Err(format!(
            "row {row} has a frame without digest or a digest without frame"
        )),
    }
}
