//! Facts of a dataset, one on a line: its content, its origin, and the instruments that measured its labels.

use std::io::{self, Write};

use taceva_core::{Instrument, Traceability, counted, shown};
use taceva_dataset::{Dataset, Header, RecordedSessions, Source, Task};

pub(crate) fn write(dataset: &Dataset, out: &mut dyn Write) -> io::Result<()> {
    let header = dataset.header();
    let mut line = |name: &str, words: &str| writeln!(out, "{name:<10}{}", shown(words));
    let sensor = &header.sensor;
    let (model, serial, gel) = (&sensor.model, &sensor.serial, &sensor.gel);
    line(
        "sensor",
        &format!("{model}, serial number {serial}, gel {gel}"),
    )?;
    line("holds", &content(header))?;
    let labels = header.channels.iter();
    let labels = labels.map(|channel| format!("{} in {}", channel.name(), channel.unit()));
    line("labels", &listed(labels))?;
    for own in dataset.tasks() {
        line("task", &task(own.task()))?;
    }
    if !header.presses.is_empty() {
        let presses = header.presses.iter();
        let presses = presses.map(|(outcome, count)| format!("{count} {outcome}"));
        line("presses", &listed(presses))?;
    }
    line("origin", &origin(dataset))?;
    for traced in &header.traceability {
        line("measured", &instrument(traced))?;
    }
    if header.traceability.is_empty() {
        line("measured", "by instruments that the dataset does not state")?;
    } else {
        for instrument in not_stated(header) {
            let words = format!("{instrument}: no certificate; the dataset does not state it");
            line("measured", &words)?;
        }
    }
    let by = [("laboratory", "at"), ("operator", "by")];
    for (name, word) in by {
        if let Some(value) = header.settings.get(name) {
            line("recorded", &format!("{word} {value}"))?;
        }
    }
    for (name, value) in &header.settings {
        if by.iter().all(|(of_person, _)| of_person != name) {
            line("setting", &format!("{name} = {value}"))?;
        }
    }
    if let Some(sessions) = RecordedSessions::of(dataset.path()) {
        line("sessions", &sessions.note)?;
    }
    for warning in &header.warnings {
        line("warning", warning)?;
    }
    line("digest", &dataset.digest().to_string())
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

/// Task with its classes and the column that states its clusters.
fn task(task: &Task) -> String {
    let classes = match task.names.is_empty() {
        true => String::new(),
        false => format!(" of {}", task.names.join(", ")),
    };
    format!(
        "{} = {}{classes}, clusters by `{}`",
        task.name,
        task.kind.name(),
        task.cluster
    )
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

/// Instruments of labels that the dataset does not name.
fn not_stated(header: &Header) -> impl Iterator<Item = Instrument> {
    let of_labels = [Instrument::Force, Instrument::Robot].into_iter();
    of_labels.filter(move |instrument| {
        let mut labels = header.channels.iter();
        let is_stated = (header.traceability.iter()).any(|of| of.instrument == *instrument);
        !is_stated && labels.any(|label| instrument.unit_of(label.name()).is_some())
    })
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
