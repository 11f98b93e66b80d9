//! The rows of one table, read by a map.

use std::path::{Path, PathBuf};

use taceva_core::{GratingKind, Nanometre, Phase};

use super::map::{FrameNames, ImportMap};
use crate::csv_table::CsvTable;
use crate::error::{DatasetError, Place};
use crate::table::Row;
use crate::text::shown;

/// A table whose columns have been found.
pub(super) struct MappedTable<'a> {
    map: &'a ImportMap,
    table: CsvTable,
    truth: Vec<usize>,
    sample: Option<usize>,
    point_id: Vec<usize>,
    unit_id: Option<usize>,
    scene: Option<usize>,
    depth_step: Option<usize>,
    repeat: Option<usize>,
    phase: Option<usize>,
    part: Option<usize>,
    kind: Option<usize>,
    spacing: Option<usize>,
    attributes: Vec<usize>,
    time: Option<usize>,
    flags: Option<usize>,
    frame: Option<FrameCells>,
}

/// The cells that name a frame.
enum FrameCells {
    Column(usize),
    /// Texts and columns in turn.
    Pattern(Vec<PatternPart>),
    Index(usize),
}

enum PatternPart {
    Text(String),
    Cell(usize),
}

/// How a row names its frame.
pub(super) enum FrameName {
    File(String),
    Index(usize),
}

impl<'a> MappedTable<'a> {
    pub(super) fn open(map: &'a ImportMap, path: &Path) -> Result<MappedTable<'a>, DatasetError> {
        let table = CsvTable::read(path)?;
        let find = |name: &String| table.position(name);
        let find_optional = |name: &Option<String>| name.as_ref().map(find).transpose();
        let ids = &map.ids;
        let has_flags = !map.drop.quality_flags.is_empty();
        Ok(MappedTable {
            map,
            truth: map
                .columns
                .iter()
                .map(|column| find(&column.from))
                .collect::<Result<_, _>>()?,
            sample: find_optional(&ids.sample)?,
            point_id: ids.point_id.iter().map(find).collect::<Result<_, _>>()?,
            unit_id: find_optional(&ids.unit_id)?,
            scene: find_optional(&ids.scene)?,
            depth_step: find_optional(&ids.depth_step)?,
            repeat: find_optional(&ids.repeat)?,
            phase: find_optional(&ids.phase)?,
            part: find_optional(&ids.part)?,
            kind: find_optional(&ids.kind)?,
            spacing: find_optional(&ids.spacing_mm)?,
            attributes: map
                .attributes
                .values()
                .map(find)
                .collect::<Result<_, _>>()?,
            time: map
                .time
                .as_ref()
                .map(|time| find(&time.column))
                .transpose()?,
            flags: has_flags.then(|| find(&map.drop.flag_column)).transpose()?,
            frame: map
                .frame
                .as_ref()
                .map(|frame| FrameCells::find(&frame.names, &table))
                .transpose()?,
            table,
        })
    }

    /// The columns of the table that the map mentions nowhere.
    pub(super) fn unmentioned(&self) -> impl Iterator<Item = String> {
        let single = [
            self.sample,
            self.unit_id,
            self.scene,
            self.depth_step,
            self.repeat,
            self.phase,
            self.part,
            self.kind,
            self.spacing,
            self.time,
            self.flags,
        ];
        let mut mentioned: Vec<usize> = single.into_iter().flatten().collect();
        mentioned.extend(
            self.truth
                .iter()
                .chain(&self.point_id)
                .chain(&self.attributes),
        );
        match &self.frame {
            Some(FrameCells::Column(column) | FrameCells::Index(column)) => mentioned.push(*column),
            Some(FrameCells::Pattern(parts)) => {
                mentioned.extend(parts.iter().filter_map(|part| match part {
                    PatternPart::Cell(column) => Some(*column),
                    PatternPart::Text(_) => None,
                }));
            }
            None => {}
        }
        let names = self.table.names().iter().enumerate();
        names
            .filter(move |(position, _)| !mentioned.contains(position))
            .map(|(_, name)| name.clone())
    }

    pub(super) fn rows(&self) -> usize {
        self.table.rows()
    }

    /// The folder of the table.
    pub(super) fn folder(&self) -> PathBuf {
        taceva_durable::parent_of(self.table.path()).to_owned()
    }

    /// The rules that leave the row out.
    pub(super) fn drop_reasons(&self, row: usize) -> Vec<String> {
        let rules = &self.map.drop;
        let cell = self.flags.map_or("", |column| self.table.cell(row, column));
        let mut reasons: Vec<String> = rules
            .quality_flags
            .iter()
            .filter(|flag| {
                cell.split([';', ' ', '\t'])
                    .any(|found| found == flag.as_str())
            })
            .cloned()
            .collect();
        if let Some(FrameCells::Column(column)) = self.frame {
            let name = self.table.cell(row, column);
            if rules.frames_named.iter().any(|known| known == name) {
                reasons.push(format!("frame `{}`", shown(name)));
            }
        }
        let is_placeholder = |rule: &super::map::Placeholder| {
            let position = self.map.channels.position(&rule.channel);
            let number = position.map(|position| self.table.number(row, self.truth[position]));
            matches!(number, Some(Ok(Some(number))) if number.partial_cmp(&rule.number).is_some_and(std::cmp::Ordering::is_eq))
        };
        if !rules.placeholders.is_empty() && rules.placeholders.iter().all(is_placeholder) {
            reasons.push("placeholders".to_owned());
        }
        reasons
    }

    /// The labels of a row; `number` is its place among the rows of all tables.
    pub(super) fn row(&self, row: usize, number: u64) -> Result<Row, DatasetError> {
        let text = |column: Option<usize>| {
            column
                .map(|column| self.table.cell(row, column))
                .filter(|cell| !cell.is_empty())
                .map(str::to_owned)
        };
        let sample = match self.sample {
            None => number.to_string(),
            Some(column) => text(Some(column))
                .ok_or_else(|| self.wrong(row, column, "empty, expected the name of the sample"))?,
        };
        Ok(Row {
            sample,
            point_id: self.point_id(row),
            unit_id: text(self.unit_id),
            scene: text(self.scene),
            depth_step: self.count(row, self.depth_step)?,
            repeat: self.count(row, self.repeat)?,
            phase: self.phase(row)?,
            limited_by: None,
            part: text(self.part),
            t_s: self.time(row)?,
            kind: self.kind(row)?,
            spacing: self.spacing(row)?,
            intensity: None,
            truth: self.truth(row)?,
            attributes: self
                .attributes
                .iter()
                .map(|column| text(Some(*column)))
                .collect(),
            frame: None,
        })
    }

    /// That another row has the name of this one.
    pub(super) fn duplicate(&self, row: usize, name: &str) -> DatasetError {
        let column = self.sample.unwrap_or(usize::MAX);
        DatasetError::Table {
            place: self.table.place(row, column),
            problem: format!("`{}` is the name of an earlier row", shown(name)),
        }
    }

    /// How the row names its frame, and where; `None` if the map has no frames.
    pub(super) fn frame_name(
        &self,
        row: usize,
    ) -> Result<Option<(FrameName, Place)>, DatasetError> {
        let Some(cells) = &self.frame else {
            return Ok(None);
        };
        let (name, column) = match cells {
            FrameCells::Column(column) => (
                FrameName::File(self.table.cell(row, *column).to_owned()),
                *column,
            ),
            FrameCells::Pattern(parts) => (FrameName::File(self.filled(row, parts)), usize::MAX),
            FrameCells::Index(column) => {
                let index = self.count(row, Some(*column))?.ok_or_else(|| {
                    self.wrong(row, *column, "empty, expected the position of a frame")
                })?;
                (FrameName::Index(index as usize), *column)
            }
        };
        Ok(Some((name, self.table.place(row, column))))
    }

    fn filled(&self, row: usize, parts: &[PatternPart]) -> String {
        parts
            .iter()
            .map(|part| match part {
                PatternPart::Text(text) => text.as_str(),
                PatternPart::Cell(column) => self.table.cell(row, *column),
            })
            .collect()
    }

    fn point_id(&self, row: usize) -> Option<String> {
        let cells: Vec<&str> = self
            .point_id
            .iter()
            .map(|column| self.table.cell(row, *column))
            .collect();
        let is_named = !cells.is_empty() && cells.iter().all(|cell| !cell.is_empty());
        is_named.then(|| cells.join(":"))
    }

    fn truth(&self, row: usize) -> Result<Vec<Option<f64>>, DatasetError> {
        self.truth
            .iter()
            .zip(&self.map.columns)
            .map(|(column, map)| {
                let number = self.table.number_in_unit(row, *column, &map.unit)?;
                let Some(converted) = number else {
                    return Ok(None);
                };
                // A difference from zero, so that no −0 appears where the sign of 0 is turned.
                Ok(Some(if map.is_negated {
                    0.0 - converted
                } else {
                    converted
                }))
            })
            .collect()
    }

    fn time(&self, row: usize) -> Result<Option<f64>, DatasetError> {
        match (self.time, &self.map.time) {
            (Some(column), Some(map)) => self.table.number_in_unit(row, column, &map.unit),
            _ => Ok(None),
        }
    }

    fn phase(&self, row: usize) -> Result<Option<Phase>, DatasetError> {
        let Some(column) = self.phase else {
            return Ok(None);
        };
        match self.table.cell(row, column) {
            "" => Ok(None),
            name => Phase::from_name(name)
                .map(Some)
                .ok_or_else(|| self.wrong(row, column, "expected `load` or `unload`")),
        }
    }

    fn kind(&self, row: usize) -> Result<Option<GratingKind>, DatasetError> {
        let Some(column) = self.kind else {
            return Ok(None);
        };
        match self.table.cell(row, column) {
            "" => Ok(None),
            name => GratingKind::from_name(name)
                .map(Some)
                .ok_or_else(|| self.wrong(row, column, "expected `line` or `dot`")),
        }
    }

    fn spacing(&self, row: usize) -> Result<Option<Nanometre>, DatasetError> {
        let Some(column) = self.spacing else {
            return Ok(None);
        };
        match self.table.cell(row, column) {
            "" => Ok(None),
            text => match text.parse::<Nanometre>() {
                Ok(spacing) if spacing > Nanometre(0) => Ok(Some(spacing)),
                _ => Err(self.wrong(row, column, "expected a spacing in mm, such as 0.35")),
            },
        }
    }

    /// A count, also where a spreadsheet made `3.0` of it.
    fn count(&self, row: usize, column: Option<usize>) -> Result<Option<u32>, DatasetError> {
        let Some(column) = column else {
            return Ok(None);
        };
        let cell = self.table.cell(row, column);
        if cell.is_empty() {
            return Ok(None);
        }
        let digits = cell.strip_suffix(".0").unwrap_or(cell);
        digits
            .parse()
            .map(Some)
            .map_err(|_| self.wrong(row, column, "expected a whole number from 0"))
    }

    fn wrong(&self, row: usize, column: usize, expected: &str) -> DatasetError {
        let cell = self.table.cell(row, column);
        DatasetError::Table {
            place: self.table.place(row, column),
            problem: if cell.is_empty() {
                expected.to_owned()
            } else {
                format!("`{}`: {expected}", shown(cell))
            },
        }
    }
}

impl FrameCells {
    fn find(names: &FrameNames, table: &CsvTable) -> Result<FrameCells, DatasetError> {
        match names {
            FrameNames::Column(name) => Ok(FrameCells::Column(table.position(name)?)),
            FrameNames::Array(array) => Ok(FrameCells::Index(table.position(&array.index)?)),
            FrameNames::Pattern(pattern) => {
                let mut parts = Vec::new();
                let mut rest = pattern.as_str();
                while let Some((text, after)) = rest.split_once('{') {
                    let (name, after) =
                        after.split_once('}').ok_or_else(|| DatasetError::Path {
                            place: None,
                            written: pattern.clone(),
                            problem: "a `{` is never closed".to_owned(),
                        })?;
                    parts.push(PatternPart::Text(text.to_owned()));
                    parts.push(PatternPart::Cell(table.position(name)?));
                    rest = after;
                }
                parts.push(PatternPart::Text(rest.to_owned()));
                Ok(FrameCells::Pattern(parts))
            }
        }
    }
}
