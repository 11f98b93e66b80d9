//! Values side by side for readers: scores, published facts, and short words for absent values.

mod origins;
mod programs;

use taceva_core::Unit;
use taceva_metrics::{Better, Standing};
use taceva_results::full_name;

use super::column::named;
use super::main::is_main;
use super::mark::{BARRED, UNPROVEN};
use super::{ScoreCell, ScoreRow, ScoreTable};
use crate::compare::{CompareRequest, QUESTIONS};
use crate::names::listed;
use crate::results::Study;
use crate::table::{Align, Cell, Column, Estimate, Table, Words};

/// Text for a number or fact that an entry of the catalogue lacks.
const NOT_THERE: &str = "not in the catalogue";
/// Words and marks whose notes list no scores, because the table shows the words and marks themselves.
const SEEN: [&str; 4] = [UNPROVEN, NOT_THERE, "not scored", "unknown"];

/// Line of the table: a score or a fact of each study.
struct Line<'a> {
    name: Words,
    /// Name without unit and direction: `mae Fz`.
    quantity: String,
    /// Unit; empty for shares and text.
    unit: String,
    /// Row of the score; `None` for a fact.
    row: Option<&'a ScoreRow>,
    cells: Vec<Option<Cell>>,
    /// Word on the comparability of the published numbers; empty for fewer than two numbers.
    origins: &'static str,
}

impl Line<'_> {
    /// Name and unit without a direction: `mae Fz (N)`.
    fn key(&self) -> String {
        match self.unit.as_str() {
            "" => self.quantity.clone(),
            unit => format!("{} ({unit})", self.quantity),
        }
    }
}

/// Explanation of a word or a mark.
struct Note {
    word: &'static str,
    reason: String,
    /// Scores that have the word or the mark of the note, by study.
    places: Vec<(String, Vec<String>)>,
}

#[derive(Default)]
struct Notes(Vec<Note>);

impl ScoreTable {
    /// Values of `studies` side by side: one row for each score or published fact, one column for each study.
    ///
    /// The rows are the main scores and the scores of the most important questions; with `is_all`, all scores. If `request` names metrics, the rows
    /// are their scores. Of the variants, only those that answers compare have a row. A short word replaces an absent value, and a note states the
    /// reason.
    ///
    /// ```
    /// use taceva_report::{CompareRequest, ScoreTable, catalogue};
    /// let sensors = ["GelSight", "MagicTac"];
    /// let sensors = sensors.map(|name| catalogue::find(name).expect("there").as_study());
    /// let request = CompareRequest::default();
    /// let table = ScoreTable::compared(&sensors, &request).side_by_side(&sensors, &request, false);
    /// let row = table.rows.iter().map(|row| row.plain()).find(|row| row[0] == "mae Fz (N) ↓");
    /// assert_eq!(row.expect("there")[1..], ["0.0361", "0.0544", "one source"]);
    /// ```
    pub fn side_by_side(&self, studies: &[Study], request: &CompareRequest, is_all: bool) -> Table {
        let asked = self.asked(request, is_all);
        let (lines, notes) = asked.lines(studies, request);
        let columns = self.names.iter();
        let columns = columns.map(|name| Column::new(name.as_str()).align(Align::Right));
        let first = [Column::new("quantity").align(Align::Left)].into_iter();
        let has_origins = lines.iter().any(|line| !line.origins.is_empty());
        let last = has_origins.then(|| Column::new("origins").align(Align::Left));
        let columns = first.chain(columns).chain(last);
        let mut table = Table::new(asked.captioned("Values"), columns);
        for line in lines {
            let name = [Cell::Text(line.name)].into_iter();
            let cells = line.cells.into_iter().flatten();
            let origins = has_origins.then(|| Cell::text(line.origins));
            table.push(name.chain(cells).chain(origins));
        }
        table.note_all(notes.0.iter().map(Note::sentence));
        table.note_all(has_origins.then_some(origins::LEGEND));
        table.note_all(test_parts(studies, &self.names));
        if studies.iter().any(|study| study.source == "published") {
            table.note(
                "Source, conditions and date of each published number: taceva catalogue show NAME.",
            );
        }
        table
    }

    /// All lines, and notes that explain words and marks.
    fn lines(&self, studies: &[Study], request: &CompareRequest) -> (Vec<Line<'_>>, Notes) {
        let mut notes = Notes::default();
        let rows = self.rows.iter();
        let mut lines: Vec<Line<'_>> = rows.map(|row| self.line(row, &mut notes)).collect();
        if let Some(counts) = self.counts() {
            let cells = counts.into_iter().map(|count| Some(Cell::text(count)));
            lines.push(fact_line("samples", "", cells.collect()));
        }
        if request.metrics.is_empty() {
            enter_facts(studies, &mut lines);
        }
        for line in &mut lines {
            line.origins = origins::of(studies, &line.quantity);
            for (at, (study, name)) in studies.iter().zip(&self.names).enumerate() {
                if line.cells[at].is_none() {
                    let (word, reason) = absence(study, line.row, at);
                    notes.add(word, &reason, name, &line.key());
                    line.cells[at] = Some(Cell::text(word));
                }
            }
        }
        (lines, notes)
    }

    /// Rows that `request` selects.
    fn asked(&self, request: &CompareRequest, is_all: bool) -> ScoreTable {
        let headlines = self.headlines();
        let is_any = is_all || !request.metrics.is_empty();
        let is_first = !is_any && headlines.rows.iter().any(is_asked_first);
        let rows = headlines.rows.iter();
        let rows = rows.filter(|row| !is_first || is_asked_first(row));
        let rows = rows.flat_map(|row| [Some(row), self.compared_row(row)]);
        let rows = rows.flatten().cloned().collect();
        ScoreTable { rows, ..headlines }
    }

    /// Row of the variant that answers compare in place of `row`; `None` if they compare `row` itself.
    fn compared_row(&self, row: &ScoreRow) -> Option<&ScoreRow> {
        let mut answers = self.answers.iter();
        let variant = answers.find_map(|answer| {
            let is_of_row = answer.metric == row.metric && answer.channel == row.channel;
            answer.decided_by.as_deref().filter(|_| is_of_row)
        })?;
        let name = full_name(&row.metric, Some(variant));
        let mut rows = self.rows.iter();
        rows.find(|own| own.metric == name && own.channel == row.channel)
    }

    /// Line of a score, with notes on the marks of its values.
    fn line<'a>(&self, row: &'a ScoreRow, notes: &mut Notes) -> Line<'a> {
        let channel = named(&row.channel, row.unit);
        let quantity = format!("{} {}", row.metric, row.channel);
        let key = format!("{} {}", row.metric, channel.plain());
        let mut cells = Vec::new();
        for (at, cell) in row.cells.iter().enumerate() {
            let cell = cell.as_ref().filter(|cell| cell.value.is_some());
            cells.push(cell.map(|cell| {
                let mark = cell.mark();
                if let Some(reason) = cell.standing.phrase() {
                    notes.add(mark, reason, &self.names[at], &key);
                }
                value(cell, &self.sources[at], mark)
            }));
        }
        Line {
            name: row.named(&channel),
            quantity,
            unit: match row.unit {
                Unit::One => String::new(),
                unit => unit.to_string(),
            },
            row: Some(row),
            cells,
            origins: "",
        }
    }
}

impl Notes {
    /// Adds the score `key` of the study `name` to the explanation of `word`.
    fn add(&mut self, word: &'static str, reason: &str, name: &str, key: &str) {
        let mut notes = self.0.iter();
        let found = notes.position(|note| note.word == word && note.reason == reason);
        let found = found.unwrap_or_else(|| {
            self.0.push(Note {
                word,
                reason: reason.to_owned(),
                places: Vec::new(),
            });
            self.0.len() - 1
        });
        let places = &mut self.0[found].places;
        match places.iter().position(|(known, _)| known == name) {
            Some(at) => places[at].1.push(key.to_owned()),
            None => places.push((name.to_owned(), vec![key.to_owned()])),
        }
    }
}

impl Note {
    /// Sentence of the note: `skipped: the sensor keeps light out (GelSight: r_light Fz).`
    fn sentence(&self) -> String {
        let reason = &self.reason;
        let is_untested = Standing::SkillUnknown.phrase() == Some(reason.as_str());
        if self.word == UNPROVEN && is_untested {
            return "‡: no test shows whether the predictions behind the number are better than the mean of the labels; verdicts use the number like others.".to_owned();
        }
        let word = match self.word {
            BARRED => "†, excluded from verdicts",
            UNPROVEN => "‡, compared with a reservation",
            word => word,
        };
        if SEEN.contains(&self.word) {
            return format!("{word}: {reason}.");
        }
        let places = self.places.iter();
        let places = places.map(|(name, scores)| format!("{name}: {}", scores.join(", ")));
        let places: Vec<String> = places.collect();
        format!("{word}: {reason} ({}).", places.join("; "))
    }
}

/// True for the main scores and for scores of the most important questions.
fn is_asked_first(row: &ScoreRow) -> bool {
    let mut questions = QUESTIONS.iter();
    let is_question = questions.any(|(metric, ..)| *metric == row.metric);
    is_main(row) || is_question || row.metric == "intrinsic"
}

/// Value with its interval. Published values are not rounded; only trailing zeros are removed.
fn value(cell: &ScoreCell, source: &str, mark: &'static str) -> Cell {
    let mut formatted = cell.formatted.clone();
    if let Some(value) = cell.value.filter(|_| source == "published") {
        formatted.value = value.to_string();
    }
    Cell::Estimate(Estimate {
        formatted,
        mark,
        ..Estimate::default()
    })
}

/// A line of a fact.
fn fact_line(quantity: &str, unit: &str, cells: Vec<Option<Cell>>) -> Line<'static> {
    let metric = quantity.split(' ').next().unwrap_or_default();
    let mut line = Line {
        name: Words::default(),
        quantity: quantity.to_owned(),
        unit: unit.to_owned(),
        row: None,
        cells,
        origins: "",
    };
    let key = line.key();
    line.name = Words::new(Better::of(metric).map_or(key.clone(), |better| better.beside(&key)));
    line
}

/// Sentences on the tested samples of each study; studies with one text share a sentence.
fn test_parts(studies: &[Study], names: &[String]) -> Vec<String> {
    let text = |study: &Study| {
        let known = [study.tested_count(), study.tested_part()];
        known.into_iter().flatten().collect::<Vec<_>>().join(", ")
    };
    let texts: Vec<String> = studies.iter().map(text).collect();
    let known = taceva_core::distinct(texts.iter().filter(|text| !text.is_empty()));
    let sentences = known.into_iter().map(|text| {
        let alike = texts.iter().zip(names).filter(|(own, _)| *own == text);
        let names: Vec<String> = alike.map(|(_, name)| name.clone()).collect();
        format!("Tested on {text}: {}.", listed(&names))
    });
    sentences.collect()
}

/// Adds the facts of `studies` to the lines. Several facts with one name share a cell.
fn enter_facts(studies: &[Study], lines: &mut Vec<Line<'_>>) {
    for (at, study) in studies.iter().enumerate() {
        for fact in &study.facts {
            let is_same = |line: &Line<'_>| line.quantity == fact.name && line.unit == fact.unit;
            let found = lines.iter().position(is_same);
            let found = found.unwrap_or_else(|| {
                lines.push(fact_line(&fact.name, &fact.unit, vec![None; studies.len()]));
                lines.len() - 1
            });
            let line = &mut lines[found];
            let known = line.cells[at].take();
            line.cells[at] = Some(match known {
                None => Cell::text(fact.value.as_str()),
                Some(score) if line.row.is_some() => score,
                Some(known) => Cell::text(format!("{}; {}", known.plain(), fact.value)),
            });
        }
    }
}

/// Short word for an absent value, and the reason for its absence.
fn absence(study: &Study, row: Option<&ScoreRow>, at: usize) -> (&'static str, String) {
    let published = || {
        let reason = "the entry has none; a publication may have one";
        (NOT_THERE, reason.to_owned())
    };
    let Some(row) = row else {
        let reason = "the result does not state it; `taceva catalogue show NAME` may";
        return match study.source.as_str() {
            "published" => published(),
            _ => ("unknown", reason.to_owned()),
        };
    };
    let cell = row.cells.get(at).and_then(Option::as_ref);
    if let Some(reason) = cell.and_then(|cell| cell.formatted.reason.as_deref()) {
        return match reason.split_once(": ") {
            Some(("undefined", reason)) => ("undefined", reason.to_owned()),
            Some(("not applicable", reason)) => ("not applicable", reason.to_owned()),
            _ => ("in JSON", reason.to_owned()),
        };
    }
    let metric = row.metric.split('.').next().unwrap_or_default();
    let what = format!("metric:{metric}");
    let skip = study.skipped.iter().find(|skip| skip.what == what);
    if let Some(skip) = skip {
        return ("skipped", skip.reason.clone());
    }
    match study.source.as_str() {
        "published" => published(),
        _ => ("not scored", "the result has no such score".to_owned()),
    }
}
