//! The scores of studies side by side: a row a score, a column a study; and its forms for papers and programs.

mod forms;
mod main;
mod notation;

use taceva_core::Unit;
use taceva_metrics::{Standing, catalogue};

use crate::compare::{Answer, CompareRequest, compare};
use crate::number::{FormattedValue, fixed};
use crate::results::Study;
use taceva_results::{Interval, Score, Value};

/// The scores of studies side by side.
#[derive(Clone, Debug)]
pub struct ScoreTable {
    /// The names of the studies, in their order.
    pub names: Vec<String>,
    /// Where the samples of each come from: `recorded`, `simulated`, `synthetic`, `published`, `unknown` or `several`.
    pub sources: Vec<String>,
    /// The rows, in the order of the catalogue.
    pub rows: Vec<ScoreRow>,
    /// How each score compares between each two studies.
    pub answers: Vec<Answer>,
    /// Which channels have labels of different spread, in a sentence; none where all are alike.
    pub(crate) spread: Option<String>,
}

/// One score of every study.
#[derive(Clone, Debug)]
pub struct ScoreRow {
    /// The metric, with the name of the variant: `mae`, `r_spatial.within`.
    pub metric: String,
    /// The channel or plane.
    pub channel: String,
    /// The unit that all cells have.
    pub unit: Unit,
    /// Whether it is the score itself and not one of its variants.
    pub is_headline: bool,
    /// One cell for each study; `None` for a study without the score.
    pub cells: Vec<Option<ScoreCell>>,
}

/// A score of one study.
#[derive(Clone, Debug)]
pub struct ScoreCell {
    /// The number itself, if there is one.
    pub value: Option<f64>,
    /// Value and interval as they are printed.
    pub formatted: FormattedValue,
    /// Both ends of its interval.
    pub ends: Option<[f64; 2]>,
    /// How the interval was found.
    pub method: Option<String>,
    /// Degrees of freedom of Student's t that the ends were made with, where the result says so.
    pub degrees_of_freedom: Option<f64>,
    /// How many samples it is computed from.
    pub n: u64,
    /// Samples left out because a value was no usable number.
    pub n_invalid: u64,
    /// Whether it takes part in verdicts.
    pub standing: Standing,
    /// Which share of its predictions lie beyond the bounds of the model, where that is known.
    pub bounded_share: Option<f64>,
    /// Whether it is shown to be better than every other cell of its row that takes part, at a level of 5 % after Holm's adjustment.
    pub is_best: bool,
}

impl ScoreTable {
    /// Every score and every variant that is one number.
    pub fn of(studies: &[Study]) -> ScoreTable {
        let mut rows: Vec<ScoreRow> = Vec::new();
        for (at, study) in studies.iter().enumerate() {
            for score in &study.scores {
                for line in lines(score) {
                    line.enter(at, studies.len(), &mut rows);
                }
            }
        }
        let order = |row: &ScoreRow| {
            let metric = row.metric.split('.').next().unwrap_or_default();
            let place = catalogue::ALL.iter().position(|known| known.id == metric);
            place.unwrap_or(usize::MAX)
        };
        // Metrics that nobody knows come last, in the order in which they were met.
        rows.sort_by_key(order);
        let answers = compare(studies, &CompareRequest::default()).answers;
        if studies.len() > 1 {
            mark_best(&mut rows, &answers);
        }
        ScoreTable {
            names: crate::names::names(studies),
            sources: studies.iter().map(|study| study.source.clone()).collect(),
            spread: spread(studies, &rows),
            rows,
            answers,
        }
    }

    /// The scores themselves, of planes where there are any, without variants: what fits a page of a paper.
    #[must_use]
    pub fn headlines(&self) -> ScoreTable {
        const IN_PLANES: [(&str, &str); 4] =
            [("Px", "Pxy"), ("Py", "Pxy"), ("Fx", "Fxy"), ("Fy", "Fxy")];
        let has = |metric: &str, channel: &str| {
            let mut rows = self.rows.iter();
            rows.any(|row| row.metric == metric && row.channel == channel)
        };
        let is_kept = |row: &&ScoreRow| {
            let plane = IN_PLANES
                .iter()
                .find(|(channel, _)| *channel == row.channel);
            row.is_headline && plane.is_none_or(|(_, plane)| !has(&row.metric, plane))
        };
        ScoreTable {
            names: self.names.clone(),
            sources: self.sources.clone(),
            rows: self.rows.iter().filter(is_kept).cloned().collect(),
            answers: self.answers.clone(),
            spread: self.spread.clone(),
        }
    }
}

/// A number of a score, or the reason why there is none.
struct Line<'a> {
    metric: String,
    score: &'a Score,
    value: &'a Value,
    unit: Unit,
    interval: Option<&'a Interval>,
    is_headline: bool,
}

/// The score and its variants that are one number; maps and curves are for figures.
fn lines(score: &Score) -> Vec<Line<'_>> {
    let mut lines = vec![Line {
        metric: score.metric.clone(),
        score,
        value: &score.value,
        unit: score.unit,
        interval: score.interval.as_ref(),
        is_headline: true,
    }];
    let is_one =
        |value: &Value| !matches!(value, Value::Map(_) | Value::Curve(_) | Value::Matrix(_));
    let numbers = score
        .variants
        .iter()
        .filter(|variant| is_one(&variant.value));
    lines.extend(numbers.map(|variant| Line {
        metric: format!("{}.{}", score.metric, variant.name),
        score,
        value: &variant.value,
        unit: variant.unit,
        interval: variant.interval.as_ref(),
        is_headline: false,
    }));
    lines
}

impl Line<'_> {
    fn enter(&self, at: usize, studies: usize, rows: &mut Vec<ScoreRow>) {
        let is_mine = |row: &ScoreRow| {
            let is_named = row.metric == self.metric && row.channel == self.score.channel;
            // What has no value has no unit either, and stands in the row of those that have.
            let has_value = self.value.number().is_some();
            is_named && (row.unit == self.unit || !has_value || row.is_without_value())
        };
        let found = rows.iter().position(is_mine).unwrap_or_else(|| {
            rows.push(ScoreRow {
                metric: self.metric.clone(),
                channel: self.score.channel.clone(),
                unit: self.unit,
                is_headline: self.is_headline,
                cells: vec![None; studies],
            });
            rows.len() - 1
        });
        let row = &mut rows[found];
        if row.is_without_value() {
            row.unit = self.unit;
        }
        row.cells[at] = Some(ScoreCell {
            value: self.value.number(),
            formatted: FormattedValue::of(self.value, self.interval),
            ends: self.interval.and_then(Interval::ends),
            method: self.interval.and_then(Interval::method).map(str::to_owned),
            degrees_of_freedom: self.interval.and_then(Interval::degrees_of_freedom),
            n: self.score.n,
            n_invalid: self.score.n_invalid,
            standing: self
                .score
                .standing_of(self.metric.split_once('.').map(|(_, name)| name)),
            bounded_share: self.score.bounded_share,
            is_best: false,
        });
    }
}

impl ScoreRow {
    fn is_without_value(&self) -> bool {
        let mut cells = self.cells.iter().flatten();
        cells.all(|cell| cell.value.is_none())
    }
}

impl ScoreCell {
    /// Whether it has a value that takes part in verdicts.
    pub fn takes_part(&self) -> bool {
        self.value.is_some() && self.standing.takes_part()
    }

    /// What a reader must know of its standing, in words: `no skill`, `bounded (12 %)`; none of a cell that simply counts.
    pub fn remark(&self) -> Option<String> {
        let words = self.standing.words().filter(|_| self.value.is_some())?;
        let share = self
            .bounded_share
            .filter(|_| self.standing == Standing::Bounded);
        Some(match share {
            Some(share) => format!("{words} ({} %)", fixed(100.0 * share, 0)),
            None => words.to_owned(),
        })
    }
}

/// Which mean absolute errors are of labels of different spread.
fn spread(studies: &[Study], rows: &[ScoreRow]) -> Option<String> {
    let errors = rows
        .iter()
        .filter(|row| row.metric == "mae" && row.is_headline);
    let errors: Vec<_> = errors
        .map(|row| (row.metric.as_str(), row.channel.as_str()))
        .collect();
    crate::spread::note(studies, &crate::names::names(studies), &errors)
}

/// Marks the cell of each row that is shown to be better than all others that take part.
fn mark_best(rows: &mut [ScoreRow], answers: &[Answer]) {
    for row in rows.iter_mut().filter(|row| row.is_headline) {
        let is_of_row =
            |answer: &&Answer| answer.metric == row.metric && answer.channel == row.channel;
        let of_row: Vec<&Answer> = answers.iter().filter(is_of_row).collect();
        let valued = row.cells.iter().flatten().filter(|cell| cell.takes_part());
        let rivals = valued.count().saturating_sub(1);
        for (at, cell) in row.cells.iter_mut().enumerate() {
            let wins = of_row.iter().filter(|answer| answer.better() == Some(at));
            if let Some(cell) = cell {
                cell.is_best = rivals > 0 && cell.takes_part() && wins.count() == rivals;
            }
        }
    }
}
