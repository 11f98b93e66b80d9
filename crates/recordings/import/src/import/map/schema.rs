//! Schema of a map, and checks that its types cannot express.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Deserialize;
use taceva_core::{Channel, Channels, Clock, Instrument, is_scorable};
use toml::Spanned;

use super::check::{Check, ColumnName};
use super::drop_schema::WrittenDrop;
use super::frame_schema::WrittenFrames;
use super::instruments::{WrittenInstrument, WrittenSensor};
use super::rotation::WrittenRotations;
use super::sections::{WrittenClass, WrittenJoin, WrittenMatrix, WrittenPath};
use super::signals::WrittenSignals;
use super::table_schema::WrittenTable;
use super::tasks::{TaskContext, WrittenTask};
use super::zero::{WrittenGravity, WrittenZero};
use crate::instant::zone_seconds;
use crate::open_places::open_places;

use super::{ColumnMap, IdMap, ImportMap, MatrixMap, OriginMap, TimeMap};
use taceva_dataset::internal::{RESERVED, is_attribute_name, parse_toml, shown, toml_error};
use taceva_dataset::{DatasetError, Footprint, RecordingFacts, Source};

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
struct WrittenMap {
    map_version: Spanned<u32>,
    table: Spanned<WrittenTable>,
    frame_id: Option<String>,
    #[serde(default)]
    fill: bool,
    #[serde(default)]
    source: Source,
    rotation: Option<Spanned<WrittenRotations>>,
    frame: Option<Spanned<WrittenFrames>>,
    #[serde(default)]
    columns: BTreeMap<String, Spanned<WrittenColumn>>,
    #[serde(default)]
    ids: IdMap,
    #[serde(default)]
    attributes: BTreeMap<String, Spanned<ColumnName>>,
    path: Option<Spanned<WrittenPath>>,
    #[serde(default)]
    join: Vec<Spanned<WrittenJoin>>,
    #[serde(default)]
    matrix: Vec<Spanned<WrittenMatrix>>,
    #[serde(default)]
    classes: BTreeMap<String, Spanned<WrittenClass>>,
    #[serde(default)]
    task: BTreeMap<String, Spanned<WrittenTask>>,
    signals: Option<Spanned<WrittenSignals>>,
    origin: Option<Spanned<OriginMap>>,
    time: WrittenTime,
    zero: Option<WrittenZero>,
    gravity: Option<Spanned<WrittenGravity>>,
    #[serde(default)]
    drop: WrittenDrop,
    sensor: WrittenSensor,
    force: Option<WrittenInstrument>,
    robot: Option<WrittenInstrument>,
    footprint: Option<Spanned<Footprint>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
struct WrittenColumn {
    from: ColumnName,
    unit: Spanned<String>,
    #[serde(default = "positive")]
    sign: i64,
    offset: Option<f64>,
    scale: Option<f64>,
    period: Option<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
struct WrittenTime {
    column: Option<ColumnName>,
    unit: Option<Spanned<String>>,
    zone: Option<Spanned<String>>,
    clock: Clock,
}

fn positive() -> i64 {
    1
}

/// Line, from 1, of the first gap (`"?"`) that a draft left.
fn first_open(text: &str) -> Option<u64> {
    (1..)
        .zip(text.lines())
        .find_map(|(number, line)| (open_places(line) > 0).then_some(number))
}

/// Problem with a name that is reserved and cannot be an attribute or a class.
fn refused_name(name: &str) -> String {
    match IdMap::KEYS.contains(&name) {
        true => format!("`{name}` is a key of [ids]: write this line there"),
        false => format!(
            "`{name}` is reserved or invalid: expected a letter, then letters, digits or `_`"
        ),
    }
}

/// Parses and checks the map in `text`.
pub(super) fn checked(path: &Path, text: &str) -> Result<ImportMap, DatasetError> {
    let written: WrittenMap = parse_toml(path, text)?;
    let check = Check { path, text };
    check.version(&written)?;
    let (table, form) = check.table(&written.table)?;
    let matrices = check.matrices(&written.matrix)?;
    let (channels, columns) = check.columns(&written.columns, &matrices)?;
    let is_labelled = !channels.is_empty() || !written.task.is_empty();
    if !is_labelled && written.frame.is_none() && written.signals.is_none() {
        return Err(toml_error(
            path,
            None,
            "neither [columns] nor [task] nor [frame] nor [signals]: there is nothing to import",
        ));
    }
    let attributes = written.attributes.iter();
    let attributes = attributes.map(|(name, column)| (name, column.span().start));
    let classes = written.classes.iter();
    let classes = classes.map(|(name, class)| (name, class.span().start));
    for (name, offset) in attributes.chain(classes) {
        let is_twice = written.attributes.contains_key(name) && written.classes.contains_key(name);
        let is_reference = (written.frame.as_ref())
            .is_some_and(|frames| frames.get_ref().has_reference_attribute(name));
        if is_twice || is_reference || !is_attribute_name(name) || channels.position(name).is_some()
        {
            return Err(check.at(offset, &refused_name(name)));
        }
    }
    if let Some(footprint) = &written.footprint
        && let Some(problem) = footprint.get_ref().problem()
    {
        return Err(check.at(footprint.span().start, &problem));
    }
    if let Some(line) = first_open(text) {
        return Err(toml_error(
            path,
            Some(line),
            "`\"?\"` is a value that a draft leaves open: write the value, which only your lab knows, or \"unknown\" where that is \
             accepted",
        ));
    }
    let sensor = written.sensor.facts();
    let mut facts = RecordingFacts::new(written.source, written.time.clock, sensor);
    let instruments = [
        (Instrument::Force, written.force),
        (Instrument::Robot, written.robot),
        (Instrument::Sensor, written.sensor.instrument()),
    ];
    for (instrument, stated) in instruments {
        if let Some(stated) = stated {
            let traced = check.instrument(instrument, stated)?;
            facts.traceability.push(traced);
        }
    }
    facts.footprint = written.footprint.map(Spanned::into_inner);
    let rotations = check.rotations(written.rotation, &channels, &columns)?;
    let zero = written.zero.map(|zero| check.zero(zero, &channels));
    let gravity = written
        .gravity
        .map(|gravity| check.gravity(gravity, &channels));
    let attributes = written.attributes.keys().chain(written.classes.keys());
    let context = TaskContext::new(&written.ids, attributes, written.time.column.is_some());
    Ok(ImportMap {
        rotations,
        zero: zero.transpose()?,
        gravity: gravity.transpose()?,
        frames: match written.frame {
            Some(frames) => check.frames(frames)?,
            None => Vec::new(),
        },
        time: check.time(&written.time)?,
        drop: check.drop(written.drop, &channels)?,
        path: check.path_pattern(written.path)?,
        joins: check.joins(written.join)?,
        classes: check.classes(&written.classes)?,
        tasks: check.tasks(written.task, &context)?,
        signals: written
            .signals
            .map(|signals| check.signals(signals))
            .transpose()?,
        origin: written.origin.map(Spanned::into_inner),
        table,
        form,
        frame_id: written.frame_id,
        is_filled: written.fill,
        matrices,
        channels,
        columns,
        ids: written.ids,
        attributes: written
            .attributes
            .into_iter()
            .map(|(name, column)| (name, column.into_inner().into_name()))
            .collect(),
        facts,
    })
}

impl Check<'_> {
    /// Rejects versions other than 2. For version 1, the message states the necessary changes.
    fn version(&self, written: &WrittenMap) -> Result<(), DatasetError> {
        let array = written.frame.as_ref();
        let array = array.and_then(|frames| frames.get_ref().array_name());
        let problem = match (*written.map_version.get_ref(), array) {
            (2, _) => return Ok(()),
            (1, None) => "map version 1 is no longer read: write `map_version = 2`".to_owned(),
            (1, Some(array)) => format!(
                "map version 1 is no longer read: write `map_version = 2`, and in [frame] `array = {{ file = \"{0}\" }}` instead of \
                 `array = \"{0}\"`, which now names an array in the table's own file",
                shown(array)
            ),
            (other, _) => format!("unknown map version {other}, expected 2"),
        };
        Err(self.at(written.map_version.span().start, &problem))
    }

    fn columns(
        &self,
        written: &BTreeMap<String, Spanned<WrittenColumn>>,
        matrices: &[MatrixMap],
    ) -> Result<(Channels, Vec<ColumnMap>), DatasetError> {
        let mut channels = Vec::new();
        let mut by_name = BTreeMap::new();
        for matrix in matrices {
            for (position, (name, unit)) in matrix.gives.iter().enumerate() {
                let channel = Channel::named(name, unit.unit());
                let channel = channel.map_err(|error| {
                    toml_error(self.path, None, &format!("[[matrix]] gives: {error}"))
                })?;
                by_name.insert(name.clone(), ColumnMap::new(matrix.column(position), *unit));
                channels.push(channel);
            }
        }
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
            let channel = match column.period {
                Some(period) => self.periodic(channel, period, unit, offset)?,
                None => channel,
            };
            let is_negated = match column.sign {
                1 => false,
                -1 => true,
                other => {
                    return Err(self.at(offset, &format!("sign = {other}, expected 1 or -1")));
                }
            };
            let scale = column.scale.unwrap_or(1.0);
            if scale == 0.0 || !is_scorable(scale) || !is_scorable(column.offset.unwrap_or(0.0)) {
                return Err(self.at(
                    offset,
                    "`offset` and `scale` must be finite, and `scale` must not be 0",
                ));
            }
            let map = ColumnMap {
                from: column.from.clone().into_name(),
                unit,
                is_negated,
                offset: column.offset,
                scale: column.scale,
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

    fn time(&self, written: &WrittenTime) -> Result<Option<TimeMap>, DatasetError> {
        let Some(column) = &written.column else {
            return Ok(None);
        };
        let unit = written.unit.as_ref().ok_or_else(|| {
            toml_error(
                self.path,
                None,
                "[time] has a `column` but no `unit`, such as \"s\" or \"ns\"",
            )
        })?;
        self.time_of(column.clone(), unit, written.zone.as_ref())
            .map(Some)
    }

    /// Checks a time column.
    pub(super) fn time_of(
        &self,
        column: ColumnName,
        unit: &Spanned<String>,
        zone: Option<&Spanned<String>>,
    ) -> Result<TimeMap, DatasetError> {
        let zone_s = zone.map(|zone| {
            zone_seconds(zone.get_ref()).ok_or_else(|| {
                let problem = format!(
                    "`{}` is not a time zone, expected the offset of the clock from UTC: \"+02:00\", \"-05:30\", \"Z\"",
                    shown(zone.get_ref())
                );
                self.at(zone.span().start, &problem)
            })
        });
        let source_unit = self.unit(unit)?;
        if source_unit.unit() != taceva_core::Unit::Second {
            return Err(self.at(
                unit.span().start,
                &format!(
                    "`{source_unit}` is not a unit of time, expected s, ms, us or ns",
                    source_unit = unit.get_ref()
                ),
            ));
        }
        Ok(TimeMap {
            column: column.into_name(),
            unit: source_unit,
            zone_s: zone_s.transpose()?,
        })
    }
}
