//! The map as it is written, and the checks that a parser of types cannot make.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Deserialize;
use taceva_core::{Channel, Channels, Clock, SourceUnit};
use toml::Spanned;

use super::{
    ArrayFrames, ColumnMap, DropRules, FrameMap, FrameNames, IdMap, ImportMap, Placeholder, TimeMap,
};
use crate::decode::ChannelOrder;
use crate::error::DatasetError;
use crate::file::check_relative;
use crate::header::{Footprint, SensorFacts, Source};
use crate::store::RecordingFacts;
use crate::table::{RESERVED, is_attribute_name};
use crate::toml_file::{line_of, parse_toml, toml_error};

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
struct WrittenMap {
    map_version: Spanned<u32>,
    table: Spanned<String>,
    #[serde(default)]
    source: Source,
    frame: Option<Spanned<WrittenFrame>>,
    #[serde(default)]
    columns: BTreeMap<String, Spanned<WrittenColumn>>,
    #[serde(default)]
    ids: IdMap,
    #[serde(default)]
    attributes: BTreeMap<String, Spanned<String>>,
    time: WrittenTime,
    #[serde(default)]
    drop: WrittenDrop,
    sensor: SensorFacts,
    footprint: Option<Spanned<Footprint>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
struct WrittenFrame {
    column: Option<String>,
    pattern: Option<String>,
    array: Option<String>,
    index: Option<String>,
    folder: Option<String>,
    channel_order: ChannelOrder,
    reference: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
struct WrittenColumn {
    from: String,
    unit: Spanned<String>,
    #[serde(default = "positive")]
    sign: i64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
struct WrittenTime {
    column: Option<String>,
    unit: Option<Spanned<String>>,
    clock: Clock,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields, default, expecting = "a table")]
struct WrittenDrop {
    column: Option<String>,
    quality_flags: Vec<String>,
    frames_named: Vec<String>,
    placeholders: BTreeMap<String, f64>,
}

fn positive() -> i64 {
    1
}

/// The map that `text` says, checked.
pub(super) fn checked(path: &Path, text: &str) -> Result<ImportMap, DatasetError> {
    let written: WrittenMap = parse_toml(path, text)?;
    let check = Check { path, text };
    check.version(&written.map_version)?;
    check.relative(written.table.get_ref(), written.table.span().start)?;
    let (channels, columns) = check.columns(&written.columns)?;
    if channels.is_empty() && written.frame.is_none() {
        return Err(toml_error(
            path,
            None,
            "neither [columns] nor [frame]: there is nothing to import",
        ));
    }
    for (name, column) in &written.attributes {
        if !is_attribute_name(name) || channels.position(name).is_some() {
            return Err(check.at(
                column.span().start,
                &format!("`{name}` is taken or no name: a letter, then letters, digits or `_`"),
            ));
        }
    }
    if let Some(footprint) = &written.footprint
        && let Some(problem) = footprint.get_ref().problem()
    {
        return Err(check.at(footprint.span().start, &problem));
    }
    Ok(ImportMap {
        frame: written.frame.map(|frame| check.frame(frame)).transpose()?,
        time: check.time(&written.time)?,
        drop: check.drop(written.drop, &channels)?,
        table: written.table.into_inner(),
        channels,
        columns,
        ids: written.ids,
        attributes: written
            .attributes
            .into_iter()
            .map(|(name, column)| (name, column.into_inner()))
            .collect(),
        facts: RecordingFacts {
            source: written.source,
            clock: written.time.clock,
            sensor: written.sensor,
            footprint: written.footprint.map(Spanned::into_inner),
            settings: BTreeMap::new(),
        },
    })
}

/// Checks what a parser of types cannot, and says where.
struct Check<'a> {
    path: &'a Path,
    text: &'a str,
}

impl Check<'_> {
    fn at(&self, offset: usize, problem: &str) -> DatasetError {
        let line = line_of(self.text.as_bytes(), offset);
        toml_error(self.path, Some(line), problem)
    }

    fn version(&self, version: &Spanned<u32>) -> Result<(), DatasetError> {
        match version.get_ref() {
            1 => Ok(()),
            other => Err(self.at(
                version.span().start,
                &format!("map version {other} is not known here, expected 1"),
            )),
        }
    }

    fn relative(&self, written: &str, offset: usize) -> Result<(), DatasetError> {
        check_relative(written)
            .map_err(|problem| self.at(offset, &format!("`{written}`: {problem}")))
    }

    fn unit(&self, unit: &Spanned<String>) -> Result<SourceUnit, DatasetError> {
        SourceUnit::parse(unit.get_ref())
            .map_err(|error| self.at(unit.span().start, &error.to_string()))
    }

    fn columns(
        &self,
        written: &BTreeMap<String, Spanned<WrittenColumn>>,
    ) -> Result<(Channels, Vec<ColumnMap>), DatasetError> {
        let mut channels = Vec::new();
        let mut by_name = BTreeMap::new();
        for (name, column) in written {
            let offset = column.span().start;
            let column = column.get_ref();
            let unit = self.unit(&column.unit)?;
            if RESERVED.contains(&name.as_str()) {
                return Err(self.at(
                    offset,
                    &format!("`{name}` is the name of an id, not of a channel"),
                ));
            }
            let channel = Channel::named(name, unit.unit())
                .map_err(|error| self.at(offset, &error.to_string()))?;
            let is_negated = match column.sign {
                1 => false,
                -1 => true,
                other => {
                    return Err(self.at(offset, &format!("sign = {other}, expected 1 or -1")));
                }
            };
            let map = ColumnMap {
                from: column.from.clone(),
                unit,
                is_negated,
            };
            by_name.insert(name.clone(), map);
            channels.push(channel);
        }
        let channels = Channels::new(channels)
            .map_err(|error| toml_error(self.path, None, &error.to_string()))?;
        let columns = channels
            .iter()
            .filter_map(|channel| by_name.remove(channel.name()))
            .collect();
        Ok((channels, columns))
    }

    fn frame(&self, written: Spanned<WrittenFrame>) -> Result<FrameMap, DatasetError> {
        let offset = written.span().start;
        let written = written.into_inner();
        let names = match (
            written.column,
            written.pattern,
            written.array,
            written.index,
        ) {
            (Some(column), None, None, None) => FrameNames::Column(column),
            (None, Some(pattern), None, None) => {
                self.relative(&pattern, offset)?;
                FrameNames::Pattern(pattern)
            }
            (None, None, Some(file), Some(index)) => {
                self.relative(&file, offset)?;
                FrameNames::Array(ArrayFrames { file, index })
            }
            _ => {
                return Err(self.at(
                    offset,
                    "frames are named by `column`, by `pattern`, or by `array` and `index`: expected one of the three",
                ));
            }
        };
        let reference = Some(written.reference).filter(|path| path != "unknown");
        for path in reference.iter().chain(&written.folder) {
            self.relative(path, offset)?;
        }
        Ok(FrameMap {
            names,
            folder: written.folder,
            channel_order: written.channel_order,
            reference,
        })
    }

    fn time(&self, written: &WrittenTime) -> Result<Option<TimeMap>, DatasetError> {
        let Some(column) = &written.column else {
            return Ok(None);
        };
        let unit = written.unit.as_ref().ok_or_else(|| {
            toml_error(
                self.path,
                None,
                "[time] has a `column` and no `unit`, such as \"s\" or \"ns\"",
            )
        })?;
        let source_unit = self.unit(unit)?;
        if source_unit.unit() != taceva_core::Unit::Second {
            return Err(self.at(
                unit.span().start,
                &format!(
                    "`{source_unit}` is no unit of time",
                    source_unit = unit.get_ref()
                ),
            ));
        }
        Ok(Some(TimeMap {
            column: column.clone(),
            unit: source_unit,
        }))
    }

    fn drop(&self, written: WrittenDrop, channels: &Channels) -> Result<DropRules, DatasetError> {
        let stranger = written
            .placeholders
            .keys()
            .find(|name| channels.position(name).is_none());
        if let Some(name) = stranger {
            return Err(toml_error(
                self.path,
                None,
                &format!("[drop.placeholders] names `{name}`, which is no channel of [columns]"),
            ));
        }
        Ok(DropRules {
            flag_column: written.column.unwrap_or_else(|| "quality_flags".to_owned()),
            quality_flags: written.quality_flags,
            frames_named: written.frames_named,
            placeholders: written
                .placeholders
                .into_iter()
                .map(|(channel, number)| Placeholder { channel, number })
                .collect(),
        })
    }
}
