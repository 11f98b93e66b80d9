//! Writes the import map of an export.

use std::fmt::Write as _;

use serde::Serialize;
use taceva_core::{Certificate, Instrument, SourceUnit, Traceability};

use super::content::Exported;
use crate::import::IdMap;
use crate::unit_suffix::UnitSuffix;
use taceva_dataset::internal::{RESERVED, column_kind, column_of, is_task_column};
use taceva_dataset::{Header, ReducedFrames, SensorFacts, Task, TaskColumn};

/// Names of the exported items, to be written in the map.
pub(super) struct Written {
    /// Value of `table`, as TOML.
    pub(super) table: String,
    /// Map entries for the pictures of each view; empty without pictures.
    pub(super) frames: Vec<WrittenFrames>,
    /// Value of `from` in `[signals]`, as TOML; `None` without signals.
    pub(super) signals: Option<String>,
    /// Maps a column name of the dataset to its name in the file.
    pub(super) names: fn(&str) -> String,
    /// Name of each channel in the file.
    pub(super) channels: Vec<String>,
}

/// Map entries for the pictures of a view.
pub(super) struct WrittenFrames {
    /// Map key and its value, which locate the pictures, as TOML.
    pub(super) key: String,
    /// File of the picture without contact.
    pub(super) reference: Option<String>,
}

/// Name of a column in a plain table, which equals its name in the dataset.
pub(super) fn bare(name: &str) -> String {
    name.to_owned()
}

/// Channel names without units.
pub(super) fn bare_channels(exported: &Exported<'_>) -> Vec<String> {
    let channels = exported.dataset.table().channels().iter();
    channels.map(|channel| channel.name().to_owned()).collect()
}

/// Text as a TOML string.
pub(super) fn quoted(text: &str) -> String {
    toml::Value::String(text.to_owned()).to_string()
}

/// Map keys for the origin of rows, with the columns that contain it.
const ORIGIN: [(&str, &str); 3] = [
    ("table", "source_table"),
    ("row", "source_row"),
    ("frame", "source_frame"),
];

/// Text of the map for an export with the names `written`.
pub(super) fn text(exported: &Exported<'_>, written: &Written) -> String {
    let header = exported.dataset.header();
    let table = exported.dataset.table();
    let has = |name: &str| exported.columns.iter().any(|column| column.name == name);
    let mut text = String::from(
        "# Restores the dataset: taceva import FOLDER --map FOLDER/map.toml --out DATASET\n",
    );
    // Writing to a string never fails.
    let mut line = |words: std::fmt::Arguments<'_>| {
        let _ = text.write_fmt(format_args!("{words}\n"));
    };
    line(format_args!("map_version = 2"));
    let source = format!("{:?}", header.source).to_lowercase();
    line(format_args!("source = {}", quoted(&source)));
    line(format_args!(
        "table = {}   # {}",
        written.table,
        taceva_core::counted(table.rows(), "row")
    ));
    let rotations = header.rotations.iter().map(|channels| {
        let channels: Vec<String> = channels.iter().map(|name| quoted(name)).collect();
        format!("[{}]", channels.join(", "))
    });
    let rotations: Vec<String> = rotations.collect();
    if !rotations.is_empty() {
        line(format_args!("rotation = [{}]", rotations.join(", ")));
    }
    for (pictures, frame) in exported.pictures.iter().zip(&written.frames) {
        let reference = frame.reference.as_deref().unwrap_or("unknown");
        match pictures.view() {
            None => line(format_args!("\n[frame]")),
            Some(view) => line(format_args!("\n[[frame]]\nname = {}", quoted(&view))),
        }
        line(format_args!(
            "{}\nchannel_order = {}",
            frame.key,
            quoted(pictures.order.name())
        ));
        line(format_args!("reference = {}", quoted(reference)));
        if let Some(ReducedFrames { from, by, .. }) = pictures.reduced() {
            line(format_args!(
                "# The frames were reduced before recording: {by}, from {from}."
            ));
        }
    }
    if !table.channels().is_empty() {
        line(format_args!("\n[columns]"));
    }
    for (channel, from) in table.channels().iter().zip(&written.channels) {
        // The name may contain the lab's unit, such as `gap_m`, but the exported values are converted.
        let unit = SourceUnit::parse(channel.unit().symbol()).ok();
        let is_contradicted = unit.is_some_and(|unit| {
            let suffix = UnitSuffix::of(from);
            suffix.is_some_and(|suffix| suffix.contradiction(&unit).is_some())
        });
        let scale = if is_contradicted { ", scale = 1" } else { "" };
        let period = channel.period_in_unit();
        let period = period.map_or_else(String::new, |period| format!(", period = {period}"));
        line(format_args!(
            "{} = {{ from = {}, unit = {}{scale}{period} }}",
            channel.name(),
            quoted(from),
            quoted(channel.unit().symbol())
        ));
    }
    line(format_args!("\n[ids]"));
    for id in IdMap::KEYS.into_iter().filter(|id| has(id)) {
        line(format_args!("{id} = {}", quoted(&(written.names)(id))));
    }
    line(format_args!("\n[origin]"));
    for (key, column) in ORIGIN.into_iter().filter(|(_, column)| has(column)) {
        line(format_args!("{key} = {}", quoted(&(written.names)(column))));
    }
    let views = table.views().iter().map(|view| {
        let column = column_of("source_frame", view.name());
        has(&column).then(|| format!("{} = {}", view.name(), quoted(&(written.names)(&column))))
    });
    let views: Vec<String> = views.flatten().collect();
    if !views.is_empty() {
        line(format_args!("frames = {{ {} }}", views.join(", ")));
    }
    line(format_args!(
        "\n[time]\nclock = {}",
        quoted(&header.clock.to_string())
    ));
    if has("t_s") {
        line(format_args!(
            "column = {}\nunit = \"s\"",
            quoted(&(written.names)("t_s"))
        ));
    }
    let attributes = exported.columns.iter().map(|column| column.name);
    let attributes: Vec<&str> = attributes
        .filter(|name| {
            !RESERVED.contains(&column_kind(name))
                && !is_task_column(name)
                && table.channels().position(name).is_none()
        })
        .collect();
    if !attributes.is_empty() {
        line(format_args!("\n[attributes]"));
    }
    for name in attributes {
        line(format_args!("{name} = {}", quoted(&(written.names)(name))));
    }
    let tasks = table.tasks().iter().map(TaskColumn::task);
    let is_there = |task: &&Task| super::tasks::columns(task).iter().all(|column| has(column));
    for task in tasks.filter(is_there) {
        line(format_args!(
            "\n{}",
            super::tasks::section(task, written.names)
        ));
    }
    if let (Some(from), Some(signals)) = (&written.signals, &header.signals) {
        let info = signals.spec.info;
        let names: Vec<String> = signals
            .spec
            .channels
            .iter()
            .map(|name| quoted(name))
            .collect();
        line(format_args!(
            "\n[signals]\nfrom = {from}\nunit = {}",
            quoted(info.unit.symbol())
        ));
        line(format_args!(
            "places = [{}, {}]\nchannels = [{}]",
            info.rows,
            info.columns,
            names.join(", ")
        ));
        line(format_args!("order = \"place-first\""));
        let rest = signals
            .spec
            .rest
            .iter()
            .map(|[first, last]| format!("\"{first}..{last}\""));
        let rest: Vec<String> = rest.collect();
        if !rest.is_empty() {
            line(format_args!("rest = [{}]", rest.join(", ")));
        }
    }
    text + &facts(header)
}

/// Instruments of the labels and of the sensor, serialised as sections of the map.
#[derive(Serialize)]
struct Devices<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    force: Option<Device<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    robot: Option<Device<'a>>,
    sensor: Sensor<'a>,
}

#[derive(Serialize)]
struct Device<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    driver: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    serial: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    certificate: Option<&'a Certificate>,
}

#[derive(Serialize)]
struct Sensor<'a> {
    #[serde(flatten)]
    facts: &'a SensorFacts,
    #[serde(skip_serializing_if = "Option::is_none")]
    certificate: Option<&'a Certificate>,
}

/// The only entry for `instrument`; `None` without an entry, and for several entries, which no map can state.
fn only(of: &[Traceability], instrument: Instrument) -> Option<&Traceability> {
    let mut of = of.iter().filter(|of| of.instrument == instrument);
    of.next().filter(|_| of.next().is_none())
}

/// Map sections of instruments, sensor and footprint, with the facts of `header`.
fn facts(header: &Header) -> String {
    let words = "texts, numbers and truth values can be written as TOML";
    let device = |instrument| {
        only(&header.traceability, instrument).map(|traced| Device {
            driver: traced.driver.as_deref(),
            serial: traced.serial.as_deref(),
            certificate: traced.certificate.as_ref(),
        })
    };
    let sensor = only(&header.traceability, Instrument::Sensor);
    let devices = Devices {
        force: device(Instrument::Force),
        robot: device(Instrument::Robot),
        sensor: Sensor {
            facts: &header.sensor,
            certificate: sensor.and_then(|traced| traced.certificate.as_ref()),
        },
    };
    let mut text = format!("\n{}", toml::to_string(&devices).expect(words));
    if let Some(footprint) = header.footprint {
        text += &format!(
            "\n[footprint]\n{}",
            toml::to_string(&footprint).expect(words)
        );
    }
    text
}
