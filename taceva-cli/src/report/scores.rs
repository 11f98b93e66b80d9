//! Scores of one evaluation as tables: every number for programs, one column for each channel for pages and papers.

use std::collections::BTreeSet;

use taceva_core::counted;
use taceva_report::{
    Align, Cell, Column, Estimate, FormattedValue, Table, Words, escape_markdown, latex_symbol,
    short_digests,
};
use taceva_results::{EvaluationReport, Interval, ScoreLine, Value};

use super::line::{lines, methods, read_lines, standings};
use super::number::{formatted, no_interval};

/// Table with one row for each score or variant, with all digits.
pub(super) fn every_number(report: &EvaluationReport) -> Table {
    let names = [
        "channel",
        "value",
        "unit",
        "ci95_low",
        "ci95_high",
        "method",
        "degrees_of_freedom",
        "n",
        "n_invalid",
        "definition",
        "reason",
        "standing",
        "bounded_share",
        "source",
    ];
    let columns = [Column::of_metrics()].into_iter();
    let columns = columns.chain(names.map(Column::new));
    // If there are several recordings, the rows of all recordings together come first, then the rows of each.
    let is_several = !report.by_recording.is_empty();
    let more = ["recording", "recording_digest"];
    let more = more.into_iter().filter(|_| is_several).map(Column::new);
    let mut table = Table::new("Scores", columns.chain(more));
    let all = [(&report.scores, ["all", ""])].into_iter();
    let each = report.by_recording.iter();
    let each = each.map(|own| {
        let named = [own.recording.as_str(), own.digest.as_str()];
        (&own.scores, named)
    });
    for (scores, named) in all.chain(each) {
        for line in lines(scores) {
            let named = named.into_iter().filter(|_| is_several).map(Cell::text);
            let numbers = numbers(&line, &report.subject.source).into_iter();
            table.push(numbers.chain(named));
        }
    }
    table
}

fn numbers(line: &ScoreLine<'_>, source: &str) -> [Cell; 15] {
    let ends = line.interval.and_then(Interval::ends);
    let why = match line.value.number() {
        None => formatted(line).reason.unwrap_or_default(),
        Some(_) => line
            .interval
            .and_then(no_interval)
            .map_or_else(String::new, |why| format!("interval {why}")),
    };
    let method = line.interval.and_then(Interval::method);
    [
        Cell::text(line.name.as_str()),
        Cell::text(line.channel),
        Cell::exact(line.value.number()),
        Cell::text(line.unit.symbol()),
        Cell::exact(ends.map(|ends| ends[0])),
        Cell::exact(ends.map(|ends| ends[1])),
        Cell::text(method.unwrap_or_default()),
        Cell::exact(line.interval.and_then(Interval::degrees_of_freedom)),
        Cell::Number(line.score.n.to_string()),
        Cell::Number(line.score.n_invalid.to_string()),
        Cell::text(line.score.definition.as_str()),
        Cell::text(why),
        Cell::text(match line.is_reference() {
            true => "",
            false => line.score.standing.words().unwrap_or_default(),
        }),
        Cell::exact(line.score.bounded_share),
        Cell::text(source),
    ]
}

/// Lines and channels that a table shows: lines and channels with at least one value, or all if no line has a value.
struct ShownLines<'a> {
    lines: Vec<ScoreLine<'a>>,
    channels: Vec<&'a str>,
}

impl<'a> ShownLines<'a> {
    fn of(report: &'a EvaluationReport) -> ShownLines<'a> {
        let mut lines = read_lines(&report.scores);
        let valued = lines.iter().filter(|line| has_value(line));
        let valued: BTreeSet<String> = valued.map(|line| line.name.clone()).collect();
        let is_all = valued.is_empty();
        lines.retain(|line| is_all || valued.contains(&line.name));
        let mut channels: Vec<&str> = Vec::new();
        for line in &lines {
            if (is_all || has_value(line)) && !channels.contains(&line.channel) {
                channels.push(line.channel);
            }
        }
        ShownLines { lines, channels }
    }

    fn holds(&self, line: &ScoreLine<'_>) -> bool {
        let mut lines = self.lines.iter();
        lines.any(|own| own.name == line.name) && self.channels.contains(&line.channel)
    }
}

/// True if the value is neither undefined nor inapplicable.
fn has_value(line: &ScoreLine<'_>) -> bool {
    !matches!(line.value, Value::Undefined(_) | Value::NotApplicable(_))
}

/// Table with one row for each metric and one column for each channel, as in papers. The caption names scores without a value.
pub(super) fn by_channel(report: &EvaluationReport) -> Table {
    let ShownLines { lines, channels } = ShownLines::of(report);
    let mut rows: Vec<(String, Vec<Option<Estimate>>)> = Vec::new();
    for line in lines {
        let at = rows.iter().position(|(name, _)| *name == line.name);
        let at = at.unwrap_or_else(|| {
            rows.push((line.name.clone(), vec![None; channels.len()]));
            rows.len() - 1
        });
        let column = channels.iter().position(|known| *known == line.channel);
        if let Some(column) = column {
            rows[at].1[column] = Some(estimate(&line));
        }
    }
    let columns = channels.iter().map(|name| {
        let words = Words::name(*name).latex(latex_symbol(name));
        Column::new(words).align(Align::Right)
    });
    let metric = Column::of_metrics().align(Align::Left);
    let mut table = Table::new(caption(report), [metric].into_iter().chain(columns));
    for (name, cells) in rows {
        let cells = cells.into_iter().map(Option::unwrap_or_default);
        let name = Cell::Text(Words::name(name));
        table.push([name].into_iter().chain(cells.map(Cell::Estimate)));
    }
    table
}

/// Same as [`by_channel`], with the caption below the table.
pub(super) fn for_pages(report: &EvaluationReport) -> Table {
    let mut table = by_channel(report);
    let caption = std::mem::take(&mut table.caption);
    table.note(Words::new(caption).markdown(caption_with(report, escape_markdown)));
    table
}

/// Value of a line with its unit and interval, or the reason why there is no value.
fn estimate(line: &ScoreLine<'_>) -> Estimate {
    let FormattedValue {
        value,
        interval,
        reason,
    } = formatted(line);
    let unit = match (value.is_empty(), line.unit.symbol()) {
        (true, _) | (_, "1") => String::new(),
        _ => line.unit.to_string(),
    };
    Estimate {
        formatted: FormattedValue {
            reason: reason.filter(|_| value.is_empty()),
            value,
            interval,
        },
        unit,
        ..Estimate::default()
    }
}

/// Caption of the table.
fn caption(report: &EvaluationReport) -> String {
    caption_with(report, str::to_owned)
}

/// Caption of the table, in which `foreign` escapes the name of the sensor.
fn caption_with(report: &EvaluationReport, foreign: impl Fn(&str) -> String) -> String {
    let subject = &report.subject;
    let n = report.scores.iter().map(|score| score.n).max().unwrap_or(0);
    let provenance = &report.provenance;
    let methods = methods(report, &foreign);
    let intervals = match methods.is_empty() {
        true => "No intervals".to_owned(),
        false => format!("95 % intervals: {}", methods.join("; ")),
    };
    let shown = ShownLines::of(report);
    let all = read_lines(&report.scores).into_iter();
    let left_out = all.filter(|line| line.is_headline && !shown.holds(line));
    let left_out: Vec<String> = left_out
        .map(|line| format!("{} {}", line.name, foreign(line.channel)))
        .collect();
    let left_out = match left_out.is_empty() {
        true => String::new(),
        false => format!(" No value: {}.", left_out.join(", ")),
    };
    let model = provenance.model.as_ref();
    let model = model.map_or_else(String::new, |model| format!(" Model: {}.", model.name));
    let split = provenance.split.as_ref();
    // Left-out samples of a protocol belong to other phases.
    let unused = provenance.samples.get("left_out");
    let unused = unused.filter(|_| provenance.presses.is_empty());
    let unused = unused.map(|count| format!(", with {} in no part", counted(*count, "sample")));
    let unused = unused.unwrap_or_default();
    let split = split.map_or_else(String::new, |split| format!(" Split: {split}{unused}."));
    let neighbours = provenance.neighbours.as_ref();
    let neighbours = neighbours.map_or_else(String::new, |found| format!(" Note: {found}."));
    let recordings = provenance.recordings.iter();
    let recordings: Vec<String> = recordings
        .map(|own| format!("{} ({})", foreign(&own.name), short_digests(&own.digest)))
        .collect();
    let recordings = match recordings.is_empty() {
        true => String::new(),
        false => format!(" Recordings: {}.", recordings.join(", ")),
    };
    let subject = match subject.source.as_str() {
        "unknown" => "Scores of two tables".to_owned(),
        source if subject.sensor == "unknown" => format!("Unnamed sensor ({source} samples)"),
        source => format!("{} ({source} samples)", foreign(&subject.sensor)),
    };
    let standings: String = standings(&report.scores)
        .iter()
        .map(|standing| format!(" Excluded from verdicts, fully or partly: {standing}."))
        .collect();
    format!(
        "{subject}, n = {n}.{recordings}{model}{split}{neighbours} {intervals}.{standings}{left_out} TacEva {}.",
        provenance.taceva
    )
}
