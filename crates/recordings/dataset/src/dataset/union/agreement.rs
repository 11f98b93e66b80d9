//! Differences between two recordings that prevent joining them.

use crate::header::{Footprint, Header};
use crate::task::Task;

/// Header key with different values in two recordings.
#[derive(Clone, Debug, PartialEq, Eq)]
#[doc(hidden)]
pub struct Difference {
    /// Key as in `dataset.toml`.
    pub key: &'static str,
    /// Value in the first recording.
    pub own: String,
    /// Value in the second recording.
    pub other: String,
}

/// Differences that prevent joining two recordings, in the order of their keys in the header.
pub(super) fn differences(one: &Header, other: &Header) -> impl Iterator<Item = Difference> {
    let facts = facts(one).into_iter().zip(facts(other));
    facts
        .filter(|((_, own), (_, other))| own != other)
        .map(|((key, own), (_, other))| Difference { key, own, other })
}

/// Differences that prevent adding rows to a recording, including differences of serial number, gel, clock, text columns, tasks and order of colours.
pub fn differences_of_added(one: &Header, added: &Header) -> impl Iterator<Item = Difference> {
    let more = more(one).into_iter().zip(more(added));
    let more = more.filter(|((_, own), (_, other))| own != other);
    let more = more.map(|((key, own), (_, other))| Difference { key, own, other });
    differences(one, added).chain(more)
}

fn more(header: &Header) -> [(&'static str, String); 6] {
    let mut attributes = header.attributes.clone();
    attributes.sort();
    let views = header.views.iter().map(|view| &view.frames);
    let order = header.frames.iter().chain(views);
    let order: Vec<&str> = order.map(|frames| frames.channel_order.name()).collect();
    [
        ("sensor.serial", format!("`{}`", header.sensor.serial)),
        ("sensor.gel", format!("`{}`", header.sensor.gel)),
        ("clock", format!("{:?}", header.clock).to_lowercase()),
        ("attributes", format!("[{}]", attributes.join(", "))),
        ("task", tasks(header)),
        (
            "frames.channel_order",
            match order.is_empty() {
                true => "absent".to_owned(),
                false => order.join(" and "),
            },
        ),
    ]
}

/// Definitions of the tasks as text.
fn tasks(header: &Header) -> String {
    let tasks = header.tasks.iter().map(Task::definition);
    let tasks: Vec<String> = tasks.collect();
    match tasks.is_empty() {
        true => "absent".to_owned(),
        false => tasks.join("; "),
    }
}

/// Header keys that must be equal, with their values as text.
fn facts(header: &Header) -> [(&'static str, String); 7] {
    let absent = || "absent".to_owned();
    let mut channels: Vec<String> = header
        .channels
        .iter()
        .map(|channel| match channel.period() {
            None => format!("{channel} [{}]", channel.unit()),
            Some(period) => format!("{channel} [{}, period {period}]", channel.unit()),
        })
        .collect();
    channels.sort();
    let frames = header.frames.as_ref();
    let signals = header.signals.as_ref();
    let opaque = header.sensor.opaque.known();
    [
        ("source", format!("{:?}", header.source).to_lowercase()),
        ("sensor.model", format!("`{}`", header.sensor.model)),
        (
            "sensor.opaque",
            opaque.map_or_else(|| "unknown".to_owned(), |opaque| opaque.to_string()),
        ),
        ("footprint", header.footprint.map_or_else(absent, footprint)),
        ("channels", channels.join(", ")),
        (
            "frames",
            frames.map_or_else(
                || views(header),
                |frames| match &frames.reduced {
                    None => frames.info.to_string(),
                    Some(reduced) => format!("{}, {} of {}", frames.info, reduced.by, reduced.from),
                },
            ),
        ),
        (
            "signals",
            signals.map_or_else(absent, |signals| {
                let spec = &signals.spec;
                format!("{} ({})", spec.info, spec.channels.join(", "))
            }),
        ),
    ]
}

/// Names of the views as text, if samples have several views and none is selected.
fn views(header: &Header) -> String {
    let views = header.views.iter();
    let views = views.map(|view| format!("{} {}", view.name, view.frames.info));
    let views: Vec<String> = views.collect();
    match views.is_empty() {
        true => "absent".to_owned(),
        false => views.join(" and "),
    }
}

fn footprint(footprint: Footprint) -> String {
    let sides = [
        ("radius", footprint.radius_mm),
        ("half_x", footprint.half_x_mm),
        ("half_y", footprint.half_y_mm),
        ("depth_max", footprint.depth_max_mm),
    ];
    let sides = sides
        .into_iter()
        .filter_map(|(name, length)| Some(format!("{name} {} mm", length?)));
    sides.collect::<Vec<_>>().join(", ")
}
