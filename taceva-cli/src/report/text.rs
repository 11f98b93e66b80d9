//! An evaluation as text: subject, scores, skipped metrics, and provenance.

use std::io::{self, Write};

use taceva_core::{Limit, PressOutcome};
use taceva_metrics::Better;
use taceva_report::{Align, Column, Table, escape_terminal, short_digests};
use taceva_results::{EvaluationReport, ScoreLine, not_measured};

use super::line::{flags, limits, methods, pictures, read_lines, remedies, standings};
use super::number::formatted;
use super::{groups, recordings, tasks};

pub(super) fn write(report: &EvaluationReport, out: &mut dyn Write) -> io::Result<()> {
    heading(report, out)?;
    let mut last = String::new();
    let mut table = by_cell(["metric", "channel", "value", "unit", "95 % interval", "n"]);
    for line in read_lines(&report.scores) {
        // The name of a metric is printed once, above its channels.
        let name = match last == line.name {
            true => String::new(),
            false => line.shown_name(),
        };
        table.push(cells(name, &line));
        last = line.name;
    }
    out.write_all(table.text().as_bytes())?;
    over_seeds(report, out)?;
    recordings::write(report, out)?;
    groups::write(report, out)?;
    tasks::write(report, out)?;
    footer(report, out)
}

/// Cells of a table row that begins with `name`.
fn cells(name: String, line: &ScoreLine<'_>) -> [String; 6] {
    let formatted = formatted(line);
    let interval = formatted
        .interval
        .map(|[low, high]| format!("{low} … {high}"));
    let n = match (line.is_headline, line.score.n_invalid) {
        (false, _) => String::new(),
        (true, 0) => line.score.n.to_string(),
        (true, invalid) => format!("{} (+{invalid} invalid)", line.score.n),
    };
    [
        name,
        line.channel.to_owned(),
        match formatted.value.is_empty() {
            true => "–".to_owned(),
            false => formatted.value,
        },
        unit(line.unit.symbol()),
        interval.or(formatted.reason).unwrap_or_default(),
        n,
    ]
}

/// Writes the variation of scores over training seeds. Intervals by contact point do not include this variation.
pub(super) fn over_seeds(report: &EvaluationReport, out: &mut dyn Write) -> io::Result<()> {
    let Some(over) = &report.over_seeds else {
        return Ok(());
    };
    let seeds: Vec<String> = over.seeds.iter().map(ToString::to_string).collect();
    writeln!(
        out,
        "\nover the seeds {} of the training, each on the same presses",
        seeds.join(", ")
    )?;
    let number = |value: f64| format!("{value:.3}");
    let mut table = by_cell([
        "metric",
        "channel",
        "mean",
        "unit",
        "95 % interval of the mean",
        "standard deviation",
    ]);
    for score in &over.scores {
        let [low, high] = score.interval.map(number);
        table.push([
            Better::named(&score.metric),
            score.channel.clone(),
            number(score.mean),
            unit(score.unit.symbol()),
            format!("{low} … {high}"),
            number(score.standard_deviation),
        ]);
    }
    out.write_all(table.text().as_bytes())
}

fn heading(report: &EvaluationReport, out: &mut dyn Write) -> io::Result<()> {
    let subject = &report.subject;
    let provenance = &report.provenance;
    if let Some(neighbours) = &provenance.neighbours {
        writeln!(out, "{}", escape_terminal(neighbours))?;
    }
    if subject.source == "unknown" {
        writeln!(out, "Scores of two tables")?;
    } else {
        let gel = short_digests(&subject.gel);
        let known = |words: &str, name: &str| match name {
            "unknown" => String::new(),
            name => format!("{words} {}   ", escape_terminal(name)),
        };
        let (serial, gel) = (known("serial", &subject.serial), known("gel", &gel));
        let sensor = match subject.sensor.as_str() {
            "unknown" => "unnamed sensor".to_owned(),
            sensor => escape_terminal(sensor),
        };
        writeln!(out, "{sensor}   {serial}{gel}{}", subject.source)?;
    }
    if let Some(words) = not_measured([subject.source.as_str()]) {
        writeln!(out, "{words}")?;
    }
    if let Some(model) = &provenance.model {
        let settings: Vec<String> = model
            .settings
            .iter()
            .map(|(key, value)| format!("{key}={value}"))
            .collect();
        writeln!(out, "model {}   {}", model.name, settings.join(" "))?;
    }
    if let Some(split) = &provenance.split {
        let parts: Vec<String> = provenance
            .samples
            .iter()
            .map(|(part, count)| format!("{} {count}", part.replace('_', " ")))
            .collect();
        let seed = provenance
            .seed
            .map_or_else(String::new, |seed| format!(", seed {seed}"));
        let made = provenance.predicted_once();
        let made = made.unwrap_or_else(|| parts.join(", "));
        writeln!(out, "split {split}{seed}: {made}")?;
    }
    let part = provenance.part.as_ref();
    if let Some(part) = part.filter(|_| provenance.cross_validation().is_none()) {
        writeln!(out, "scored on the part `{part}`")?;
    }
    writeln!(out)
}

fn footer(report: &EvaluationReport, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out)?;
    for method in methods(report, str::to_owned) {
        writeln!(out, "intervals  {}", escape_terminal(&method))?;
    }
    for limit in limits(&report.scores) {
        writeln!(out, "limit      {limit}")?;
    }
    for flag in flags(&report.scores) {
        writeln!(out, "flag       {flag}")?;
    }
    for standing in standings(&report.scores) {
        writeln!(out, "standing   {standing}")?;
    }
    for remedy in remedies(report) {
        writeln!(out, "remedy     {remedy}")?;
    }
    for picture in pictures(&report.scores) {
        writeln!(out, "in JSON    {picture}")?;
    }
    for skipped in &report.skipped {
        writeln!(out, "skipped    {}: {}", skipped.what, skipped.reason)?;
    }
    for note in &report.provenance.notes {
        writeln!(out, "note       {}", escape_terminal(note))?;
    }
    for edit in &report.provenance.edits {
        writeln!(out, "edited     {}", escape_terminal(edit))?;
    }
    if let Some(presses) = presses(report) {
        writeln!(out, "presses    {presses}")?;
    }
    if let Some(dataset) = &report.provenance.dataset {
        writeln!(out, "dataset    {dataset}")?;
    }
    if let Some(model) = &report.provenance.model {
        writeln!(out, "model      {}", model.digest)?;
    }
    for (role, digest) in &report.provenance.tables {
        writeln!(out, "{role:<10} {digest}")?;
    }
    writeln!(
        out,
        "frames     {} decoded",
        report.provenance.frames_decoded
    )
}

/// Text on the outcomes of the presses; `None` if the recording has no presses of a protocol.
pub(super) fn presses(report: &EvaluationReport) -> Option<String> {
    let counts = report.provenance.press_counts();
    let all: u64 = counts.values().sum();
    let ways = counts.iter().map(|(outcome, count)| match outcome {
        PressOutcome::Complete => format!("{count} complete"),
        PressOutcome::Limited(limit) => format!("{count} ended by the limit of {}", words(*limit)),
        PressOutcome::NoContact => format!("{count} without contact"),
        other => format!("{count} {}", other.name()),
    });
    let ways: Vec<String> = ways.collect();
    (all > 0).then(|| format!("{all}: {}", ways.join(", ")))
}

fn words(limit: Limit) -> &'static str {
    match limit {
        Limit::Depth => "depth",
        Limit::NormalForce => "normal force",
        Limit::ShearForce => "shear",
        other => other.name(),
    }
}

fn unit(symbol: &str) -> String {
    if symbol == "1" {
        String::new()
    } else {
        symbol.to_owned()
    }
}

/// Table without caption, with right-aligned numbers.
fn by_cell<const N: usize>(names: [&str; N]) -> Table {
    let columns = names.map(|name| Column::new(name).align(Align::ByCell));
    Table::new("", columns)
}
