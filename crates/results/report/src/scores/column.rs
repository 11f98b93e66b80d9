//! Main scores as tables that fit the column of a paper.

use std::collections::BTreeSet;

use taceva_core::Unit;
use taceva_metrics::Better;

use super::mark::BARRED;
use super::notation::metric;
use super::{ScoreCell, ScoreRow, ScoreTable};
use crate::number::FormattedValue;
use crate::table::{Align, Cell, Column, Estimate, Row, Table, Words, latex_symbol, stacked};
use crate::table::{COLUMN_PT, GAP_PT, SMALL_SIZE, VALUE_SIZE, letters_pt};

/// Greatest number of rows in one table. Eighteen rows with intervals fill half a page.
const MOST_ROWS: usize = 18;
/// Greatest width of a row name, and of a column head, in TeX points.
const NAME_PT: f64 = 76.0;
const HEAD_PT: f64 = 47.5;

/// Line of the main table, before the division into several tables.
struct Line<'a> {
    /// Metric, if the table is grouped by metric.
    group: Option<&'a str>,
    name: Words,
    name_pt: f64,
    cells: Vec<Option<&'a ScoreCell>>,
    /// Number of samples, if shown in a column.
    n: Option<String>,
}

/// Lines, and heads of the value columns.
struct Sheet<'a> {
    heads: Vec<Words>,
    lines: Vec<Line<'a>>,
    /// True if the heads are names of studies. Long names have several lines.
    has_names: bool,
    /// True if a last column has the number of samples of each line.
    has_n: bool,
    /// Numbers of samples for the last row, one for each column; `None` without this row.
    counts: Option<Vec<String>>,
}

impl ScoreTable {
    /// Main scores as tables with intervals below the values, each of the width of a paper column.
    ///
    /// For one study, rows are channels. For several studies, columns are studies. Columns and rows that do not fit form further tables.
    pub fn for_column(&self, caption: &str) -> Vec<Table> {
        let main = self.main();
        let sheet = match main.names.len() == 1 && main.is_of_accuracy() {
            true => main.by_channel(),
            false => main.by_study(),
        };
        let (digits, room) = sheet.room();
        let columns: Vec<usize> = (0..sheet.heads.len()).collect();
        // Parts of equal width: 2 and 2 of four columns, not 3 and 1.
        let parts = columns.len().div_ceil(room).max(1);
        let columns: Vec<&[usize]> = columns
            .chunks(columns.len().div_ceil(parts).max(1))
            .collect();
        let rows: Vec<&[Line<'_>]> = sheet.lines.chunks(MOST_ROWS).collect();
        let count = columns.len() * rows.len();
        let mut tables = Vec::new();
        for lines in &rows {
            for columns in &columns {
                let mut table = sheet.table(lines, columns, digits);
                table.caption = match (count, tables.len()) {
                    (1, _) => caption.to_owned(),
                    (_, at) => numbered(caption, at + 1, count),
                };
                table.note_all(main.note());
                tables.push(table);
            }
        }
        tables
    }

    /// Sheet with one row for each channel and one column for each metric, for one study.
    fn by_channel(&self) -> Sheet<'_> {
        let mut metrics: Vec<&str> = Vec::new();
        let mut channels: Vec<(&str, Unit)> = Vec::new();
        for row in &self.rows {
            if !metrics.contains(&row.metric.as_str()) {
                metrics.push(&row.metric);
            }
            match channels.iter_mut().find(|(name, _)| *name == row.channel) {
                Some((_, unit)) if *unit == Unit::One => *unit = row.unit,
                Some(_) => {}
                None => channels.push((&row.channel, row.unit)),
            }
        }
        let cell = |metric: &str, channel: &str| {
            let mut rows = self.rows.iter();
            let row = rows.find(|row| row.metric == metric && row.channel == channel);
            row.and_then(|row| row.cells.first()?.as_ref())
        };
        let has_n = self.common_n().is_none() && self.valued().any(|cell| cell.n > 0);
        let lines = channels.iter().map(|(channel, unit)| {
            let cells: Vec<Option<&ScoreCell>> =
                metrics.iter().map(|metric| cell(metric, channel)).collect();
            let name = named(channel, *unit);
            Line {
                group: None,
                name_pt: letters_pt(name.plain(), VALUE_SIZE),
                name,
                n: has_n.then(|| counts(cells.iter().flatten().copied())),
                cells,
            }
        });
        Sheet {
            lines: lines.collect(),
            heads: metrics.iter().map(|id| directed(id)).collect(),
            has_names: false,
            has_n,
            counts: None,
        }
    }

    /// Sheet with one row for each score and one column for each study. A last row has the numbers of samples if they differ.
    fn by_study(&self) -> Sheet<'_> {
        let mut lines = Vec::new();
        for row in &self.rows {
            let channel = named(&row.channel, row.unit);
            lines.push(Line {
                group: Some(&row.metric),
                name_pt: letters_pt(channel.plain(), VALUE_SIZE),
                name: row.named(&channel),
                cells: row.cells.iter().map(Option::as_ref).collect(),
                n: None,
            });
        }
        Sheet {
            heads: self.names.iter().map(Words::new).collect(),
            lines,
            has_names: true,
            has_n: false,
            counts: self.counts(),
        }
    }

    /// Numbers of samples of each study, if they differ between studies or scores.
    pub(super) fn counts(&self) -> Option<Vec<String>> {
        let of = |at: usize| {
            let cells = self.rows.iter().filter_map(|row| row.cells[at].as_ref());
            counts(cells.filter(|cell| cell.value.is_some()))
        };
        let is_wanted = self.common_n().is_none() && self.valued().any(|cell| cell.n > 0);
        is_wanted.then(|| (0..self.names.len()).map(of).collect())
    }

    /// Note on bold and marked values and on different label spreads, in one paragraph.
    fn note(&self) -> Option<Words> {
        let mut sentences = Vec::new();
        if self.valued().any(|cell| cell.is_best) {
            sentences.push(format!(
                "Bold: better than every other {} at a level of 5 % after Holm's adjustment.",
                self.noun
            ));
        } else if self.names.len() > 1 {
            sentences.push(format!(
                "None is shown to be better than every other {} at a level of 5 % after Holm's adjustment.",
                self.noun
            ));
        }
        sentences.extend(self.legend(BARRED));
        if self.rows.iter().any(|row| row.metric == "repeatability") {
            sentences.push("σ rep: repeatability.".to_owned());
        }
        for (about, name) in self.about.iter().zip(&self.names) {
            let of = if self.names.len() > 1 {
                format!("{name}: ")
            } else {
                String::new()
            };
            sentences.extend(about.optimistic.iter().map(|note| format!("{of}{note}.")));
        }
        if self.spread.is_some() {
            sentences.push(format!(
                "The labels of the {}s differ more than twofold in spread, which may explain part of a difference between scores.",
                self.noun
            ));
        }
        (!sentences.is_empty()).then(|| Words::new(sentences.join(" ")))
    }
}

impl ScoreRow {
    /// Channel with its unit. The metric is above the channel in LaTeX, and before it in other formats.
    pub(super) fn named(&self, channel: &Words) -> Words {
        let plain = format!("{} {}", self.metric, channel.plain());
        let plain = Better::of(&self.metric).map_or(plain.clone(), |better| better.beside(&plain));
        Words::new(plain).latex(channel.in_latex())
    }
}

impl Sheet<'_> {
    /// Greatest number of digits that fit the columns of one table, and the number of columns.
    fn room(&self) -> (usize, usize) {
        let [three, two] = [3, 2].map(|digits| self.columns_of(digits));
        match two > three && three < self.heads.len() {
            true => (2, two),
            false => (3, three),
        }
    }

    /// Number of value columns that fit a table if values have `digits` digits.
    fn columns_of(&self, digits: usize) -> usize {
        let names = self.lines.iter().map(|line| line.name_pt);
        let name = names.fold(20.0, f64::max).min(NAME_PT);
        let n = if self.has_n { 30.0 } else { 0.0 };
        let cells = self
            .lines
            .iter()
            .flat_map(|line| line.cells.iter().flatten());
        let widest = cells.map(|cell| {
            let shown = estimate(Some(cell), digits).formatted;
            let [low, high] = shown.interval.unwrap_or_default();
            let below = letters_pt(&format!("[{low}, {high}]"), SMALL_SIZE);
            letters_pt(&shown.value, VALUE_SIZE).max(below)
        });
        let heads = self.heads.iter();
        let heads = heads.map(|head| letters_pt(head.plain(), SMALL_SIZE).min(HEAD_PT));
        let widest = widest.chain(heads).fold(10.0, f64::max) + GAP_PT;
        let mut count = 1;
        let mut used = name + n + 2.0 * widest;
        while used <= COLUMN_PT && count < self.heads.len() {
            count += 1;
            used += widest;
        }
        count
    }

    /// Table of the selected lines and columns, with values of `digits` digits.
    fn table(&self, lines: &[Line<'_>], columns: &[usize], digits: usize) -> Table {
        let share = (COLUMN_PT - NAME_PT) / columns.len().max(1) as f64 - GAP_PT;
        let heads = columns.iter().map(|at| {
            let head = self.heads[*at].clone();
            match self.has_names {
                true => {
                    let latex = stacked(head.plain(), share.max(HEAD_PT), SMALL_SIZE, 'r');
                    head.latex(latex)
                }
                false => head,
            }
        });
        let n = self.has_n.then(|| Words::new("n").latex("$n$"));
        let heads = heads
            .chain(n)
            .map(|head| Column::new(head).align(Align::Right));
        let first = [Column::new("").align(Align::Left)].into_iter();
        let mut table = Table::new("", first.chain(heads));
        let mut last = None;
        for line in lines {
            let heading = line.group.filter(|group| last != Some(*group));
            last = line.group;
            let cells = columns.iter().map(|at| {
                let cell = line.cells.get(*at).copied().flatten();
                Cell::Estimate(estimate(cell, digits))
            });
            let name = [Cell::Text(line.name.clone())].into_iter();
            let n = line.n.clone().map(Cell::Number);
            table.rows.push(Row {
                cells: name.chain(cells).chain(n).collect(),
                begins_group: heading.is_some() && !table.rows.is_empty(),
                heading: heading.map(directed),
                ..Row::default()
            });
        }
        if let Some(counts) = &self.counts {
            let counts = columns.iter().map(|at| Cell::Number(counts[*at].clone()));
            let name = [Cell::text(Words::new("n").latex("$n$"))].into_iter();
            table.rows.push(Row {
                cells: name.chain(counts).collect(),
                begins_group: true,
                ..Row::default()
            });
        }
        table
    }
}

/// `caption` with the number of the table, if there are several tables.
fn numbered(caption: &str, at: usize, count: usize) -> String {
    format!("{}, part {at} of {count}.", caption.trim_end_matches('.'))
}

/// Channel with its unit: `$F_{z}$ (N)`.
pub(super) fn named(channel: &str, unit: Unit) -> Words {
    let unit = match unit {
        Unit::One => String::new(),
        unit => format!(" ({unit})"),
    };
    let plain = format!("{channel}{unit}");
    let latex = match latex_symbol(channel) {
        symbol if symbol.starts_with('$') => format!("{symbol}{}", crate::escape::latex(&unit)),
        _ => stacked(&plain, NAME_PT, VALUE_SIZE, 'l'),
    };
    Words::new(plain).latex(latex)
}

/// Metric with the sign of its direction.
fn directed(id: &str) -> Words {
    let latex = Better::of(id).map_or("", |better| match better {
        Better::Lower => " $\\downarrow$",
        Better::Higher => " $\\uparrow$",
        Better::NearZero => " $\\to$0",
        _ => "",
    });
    Words::new(Better::named(id)).latex(format!("{}{latex}", metric(id)))
}

/// Number of samples behind some cells: `20`, or a range, `18–20`.
fn counts<'a>(cells: impl Iterator<Item = &'a ScoreCell>) -> String {
    let counts: BTreeSet<u64> = cells.map(|cell| cell.n).filter(|n| *n > 0).collect();
    match (counts.first(), counts.last()) {
        (Some(least), Some(most)) if least == most => least.to_string(),
        (Some(least), Some(most)) => format!("{least}–{most}"),
        _ => "–".to_owned(),
    }
}

/// Value with its interval, both with at most `digits` digits.
fn estimate(cell: Option<&ScoreCell>, digits: usize) -> Estimate {
    let Some((cell, value)) = cell.and_then(|cell| Some((cell, cell.value?))) else {
        return Estimate::default();
    };
    Estimate {
        formatted: FormattedValue::short(value, cell.ends, digits),
        mark: if cell.takes_part() { "" } else { BARRED },
        is_best: cell.is_best,
        ..Estimate::default()
    }
}
