//! Facts of a dataset, one on a line: its content, its origin, and the instruments that measured its labels.

use std::io::{self, Write};

use taceva_core::{Traceability, counted};
use taceva_dataset::{Dataset, Header, RecordedSessions, Source};

pub(crate) fn write(dataset: &Dataset, out: &mut dyn Write) -> io::Result<()> {
    let header = dataset.header();
    let sensor = &header.sensor;
    writeln!(
        out,
        "sensor    {}, serial number {}, gel {}",
        sensor.model, sensor.serial, sensor.gel
    )?;
    writeln!(out, "holds     {}", content(header))?;
    let labels = header.channels.iter();
    let labels = labels.map(|channel| format!("{} in {}", channel.name(), channel.unit()));
    writeln!(out, "labels    {}", listed(labels))?;
    let presses = header.presses.iter();
    let presses = presses.map(|(outcome, count)| format!("{count} {outcome}"));
    if !header.presses.is_empty() {
        writeln!(out, "presses   {}", listed(presses))?;
    }
    writeln!(out, "origin    {}", origin(dataset))?;
    for traced in &header.traceability {
        writeln!(out, "measured  {}", instrument(traced))?;
    }
    if header.traceability.is_empty() {
        writeln!(
            out,
            "measured  by instruments that the dataset does not state"
        )?;
    }
    for (name, value) in &header.settings {
        writeln!(out, "setting   {name} = {value}")?;
    }
    if let Some(sessions) = RecordedSessions::of(dataset.path()) {
        writeln!(out, "sessions  {}", sessions.note)?;
    }
    for warning in &header.warnings {
        writeln!(out, "warning   {warning}")?;
    }
    writeln!(out, "digest    {}", dataset.digest())
}

fn content(header: &Header) -> String {
    let samples = counted(header.table.rows, "sample");
    match &header.frames {
        Some(frames) => format!(
            "{samples}, {} of {}",
            counted(frames.count, "frame"),
            frames.info
        ),
        None => format!("{samples} without frames"),
    }
}

/// Origin of the samples, with the days of the recording if they are known.
fn origin(dataset: &Dataset) -> String {
    let header = dataset.header();
    let made = match header.source {
        Source::Recorded => "measured",
        Source::Simulated => "simulated: nothing was measured",
        Source::Synthetic => "artificial numbers of a test",
    };
    let days = header.days(dataset.table().t_s()).map(|days| {
        let (first, last) = days.into_inner();
        match first == last {
            true => format!(", on {first}"),
            false => format!(", from {first} to {last}"),
        }
    });
    format!("{made}{}", days.unwrap_or_default())
}

/// Instrument with its certificate, driver and serial number.
fn instrument(traced: &Traceability) -> String {
    let driver = traced.driver.as_ref();
    let driver = driver.map(|driver| format!("; read by {driver}"));
    let serial = traced.serial.as_ref();
    let serial = serial.map(|serial| format!(", which read the serial number {serial}"));
    format!(
        "{traced}{}{}",
        driver.unwrap_or_default(),
        serial.unwrap_or_default()
    )
}

fn listed(words: impl Iterator<Item = String>) -> String {
    let words: Vec<String> = words.collect();
    match words.is_empty() {
        true => "none".to_owned(),
        false => words.join(", "),
    }
}
