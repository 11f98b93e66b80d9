//! Scores of studies side by side: one row for each score, one column for each study. Layouts are for papers and programs.

mod caption;
mod channels;
mod column;
mod forms;
mod main;
mod mark;
mod notation;
mod values;

pub(crate) use mark::{BARRED, sign};

use taceva_core::Unit;
use taceva_metrics::{Standing, catalogue, plane_of};

use crate::compare::{Answer, CompareRequest, compare};
use crate::number::{FormattedValue, fixed};
use crate::results::{BY_GROUP, BY_POINT, Study};
use taceva_results::{Interval, ScoreLine};

/// Scores of studies side by side.
#[derive(Clone, Debug)]
pub struct ScoreTable {
    /// Names of the studies, in the given order.
    pub names: Vec<String>,
    /// Sample origin of each study: `recorded`, `simulated`, `synthetic`, `published`, `unknown` or `several`.
    pub sources: Vec<String>,
    /// Rows in catalogue order.
    pub rows: Vec<ScoreRow>,
    /// Comparison of each score between each pair of studies.
    pub answers: Vec<Answer>,
    /// Sentence on channels whose labels have different spreads; `None` without such channels.
    pub(crate) spread: Option<String>,
    /// Noun for what differs between the studies: `sensor`, `model` or `result`.
    pub(crate) noun: &'static str,
    about: Vec<caption::About>,
}

/// One score of all studies.
#[derive(Clone, Debug)]
pub struct ScoreRow {
    /// Metric, with an optional variant: `mae`, `r_spatial.within`.
    pub metric: String,
    /// Channel or plane of the score, such as `Fz` or `Fxy`.
    pub channel: String,
    /// Unit of all cells.
    pub unit: Unit,
    /// True for the score itself, false for a variant.
    pub is_headline: bool,
    /// One cell for each study; `None` for a study without the score.
    pub cells: Vec<Option<ScoreCell>>,
}

/// Score of one study.
#[derive(Clone, Debug)]
pub struct ScoreCell {
    /// Value; `None` if undefined.
    pub value: Option<f64>,
    /// Value and interval, formatted for reports.
    pub formatted: FormattedValue,
    /// Both ends of the confidence interval; `None` without an interval.
    pub ends: Option<[f64; 2]>,
    /// Method of the interval; `None` without an interval.
    pub method: Option<String>,
    /// Number of groups of the split by which the interval is computed; `None` for an interval by contact point.
    pub groups: Option<usize>,
    /// Number of clusters of contact points by which the interval is computed; `None` for an interval by group or by independent sample.
    pub points: Option<usize>,
    /// Degrees of freedom of Student's t for the interval, if the result states them.
    pub degrees_of_freedom: Option<f64>,
    /// Number of samples.
    pub n: u64,
    /// Number of samples excluded because a value is not finite.
    pub n_invalid: u64,
    /// Standing of the score in verdicts.
    pub standing: Standing,
    /// Share of predictions beyond the bounds of the model, if known.
    pub bounded_share: Option<f64>,
    /// True if the value is significantly better than all other cells of the row in verdicts, at 5 % after Holm's adjustment.
    pub is_best: bool,
}

impl ScoreTable {
    /// Table of all scores and all variants that are single numbers.
    pub fn of(studies: &[Study]) -> ScoreTable {
        ScoreTable::compared(studies, &CompareRequest::default())
    }

    /// Scores of the metrics that `request` names, or of all metrics, compared by `request`.
    pub fn compared(studies: &[Study], request: &CompareRequest) -> ScoreTable {
        ScoreTable::answered(studies, request, compare(studies, request).answers)
    }

    /// Same as [`compared`](ScoreTable::compared), but uses `answers` from an earlier comparison of `studies` by `request`.
    pub fn answered(
        studies: &[Study],
        request: &CompareRequest,
        answers: Vec<Answer>,
    ) -> ScoreTable {
        let mut rows: Vec<ScoreRow> = Vec::new();
        for (at, study) in studies.iter().enumerate() {
            for score in &study.scores {
                let is_wanted =
                    request.metrics.is_empty() || request.metrics.contains(&score.metric);
                for line in score.lines().filter(|_| is_wanted) {
                    enter(&line, at, studies, &mut rows);
                }
            }
        }
        let order = |row: &ScoreRow| {
            let metric = row.metric.split('.').next().unwrap_or_default();
            let place = catalogue::ALL.iter().position(|known| known.id == metric);
            place.unwrap_or(usize::MAX)
        };
        // Unknown metrics come last, in order of appearance.
        rows.sort_by_key(order);
        if studies.len() > 1 {
            mark_best(&mut rows, &answers);
        }
        ScoreTable {
            names: crate::names::names(studies),
            sources: studies.iter().map(|study| study.source.clone()).collect(),
            spread: spread(studies, &rows),
            noun: crate::names::noun(studies),
            about: studies.iter().map(caption::About::of).collect(),
            rows,
            answers,
        }
    }

    /// Scores without variants, for a page of a paper. Scores of planes replace the scores of their axes.
    #[must_use]
    pub fn headlines(&self) -> ScoreTable {
        let has = |metric: &str, channel: &str| {
            let mut rows = self.rows.iter();
            rows.any(|row| row.metric == metric && row.channel == channel)
        };
        let is_kept = |row: &&ScoreRow| {
            let plane = plane_of(&row.channel);
            row.is_headline && plane.is_none_or(|plane| !has(&row.metric, plane))
        };
        ScoreTable {
            names: self.names.clone(),
            sources: self.sources.clone(),
            rows: self.rows.iter().filter(is_kept).cloned().collect(),
            answers: self.answers.clone(),
            spread: self.spread.clone(),
            noun: self.noun,
            about: self.about.clone(),
        }
    }
}

/// Enters the score `line` of the study at position `at` into its row.
fn enter(line: &ScoreLine<'_>, at: usize, studies: &[Study], rows: &mut Vec<ScoreRow>) {
    let is_mine = |row: &ScoreRow| {
        let is_named = row.metric == line.name && row.channel == line.channel;
        // A score without a value has no unit, and joins the row of scores with a value.
        let has_value = line.value.number().is_some();
        is_named && (row.unit == line.unit || !has_value || row.is_without_value())
    };
    let found = rows.iter().position(is_mine).unwrap_or_else(|| {
        rows.push(ScoreRow {
            metric: line.name.clone(),
            channel: line.channel.to_owned(),
            unit: line.unit,
            is_headline: line.is_headline,
            cells: vec![None; studies.len()],
        });
        rows.len() - 1
    });
    let row = &mut rows[found];
    if row.is_without_value() {
        row.unit = line.unit;
    }
    let method = line.interval.and_then(Interval::method);
    let clusters = |by: &str| {
        let is_by = method.is_some_and(|method| method.contains(by));
        line.interval.filter(|_| is_by).and_then(Interval::clusters)
    };
    row.cells[at] = Some(ScoreCell {
        value: line.value.number(),
        formatted: FormattedValue::of(line.value, line.interval),
        ends: line.interval.and_then(Interval::ends),
        method: method.map(|method| studies[at].method_named(method)),
        groups: clusters(BY_GROUP),
        points: clusters(BY_POINT),
        degrees_of_freedom: line.interval.and_then(Interval::degrees_of_freedom),
        n: line.score.n,
        n_invalid: line.score.n_invalid,
        standing: line
            .score
            .standing_of(line.name.split_once('.').map(|(_, name)| name)),
        bounded_share: line.score.bounded_share,
        is_best: false,
    });
}

impl ScoreRow {
    fn is_without_value(&self) -> bool {
        let mut cells = self.cells.iter().flatten();
        cells.all(|cell| cell.value.is_none())
    }
}

impl ScoreCell {
    /// True if the cell has a value that takes part in verdicts.
    pub fn takes_part(&self) -> bool {
        self.value.is_some() && self.standing.takes_part()
    }

    /// Remark on the standing: `not better than predicting the mean`, `predictions beyond the trained range (12 %)`; `None` without a remark.
    pub fn remark(&self) -> Option<String> {
        let words = self.standing.phrase().filter(|_| self.value.is_some())?;
        let share = self
            .bounded_share
            .filter(|_| self.standing == Standing::Bounded);
        Some(match share {
            Some(share) => format!("{words} ({} %)", fixed(100.0 * share, 0)),
            None => words.to_owned(),
        })
    }
}

/// Sentence on mean absolute errors whose labels have different spreads.
fn spread(studies: &[Study], rows: &[ScoreRow]) -> Option<String> {
    let errors = rows
        .iter()
        .filter(|row| row.metric == "mae" && row.is_headline);
    let errors: Vec<_> = errors
        .map(|row| (row.metric.as_str(), row.channel.as_str()))
        .collect();
    crate::spread::note(studies, &crate::names::names(studies), &errors)
}

/// Marks the best cell of each row, if it is significantly better than all other cells in verdicts.
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
