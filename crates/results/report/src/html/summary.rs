//! Text summary of the results.

use maud::{Markup, html};
use taceva_core::counted;

use crate::compare::{Answer, QUESTIONS};
use crate::light;
use crate::markup::score_link;
use crate::names::{listed, names};
use crate::number::{minus, spaced};
use crate::results::Study;
use crate::scores::{ScoreCell, ScoreRow, ScoreTable};
use crate::spread;
use crate::tie::{best, tie};
use crate::training::{NO_VERDICT, is_demonstration};
use taceva_results::{Score, not_measured};

/// Subtitle of the page.
pub(crate) fn lead(studies: &[Study]) -> Markup {
    html! { p.lead { (listed(&names(studies))) } (badge(studies)) }
}

/// Badge for samples that were not measured; empty if all samples were measured.
pub(crate) fn badge(studies: &[Study]) -> Markup {
    let words = not_measured(studies.iter().map(|study| study.source.as_str()));
    html! {
        @if let Some(words) = words { p.badge { (words) } }
    }
}

pub(super) fn section(studies: &[Study], table: &ScoreTable) -> Markup {
    let asked = QUESTIONS
        .into_iter()
        .filter_map(|(metric, channel, question)| {
            let mut rows = table.rows.iter();
            let row = rows.find(|row| row.metric == metric && row.channel == channel)?;
            let words = answer(studies, table, row)?;
            let of = score_link(metric, channel);
            Some(html! { li { strong { (question) } " (" (of) "): " (words) } "\n" })
        });
    let mut lines: Vec<Markup> = asked.collect();
    if lines.is_empty() {
        let headlines = table.headlines();
        let first = headlines.rows.iter().take(8);
        lines.extend(first.filter_map(|row| {
            let words = answer(studies, table, row)?;
            let of = score_link(&row.metric, &row.channel);
            Some(html! { li { (of) ": " (words) } "\n" })
        }));
    }
    html! { ul.verdicts { @for line in &lines { (line) } } "\n" }
}

/// Verdict on a row of scores; for lighting scores, followed by the effect of light. `None` without a value.
fn answer(studies: &[Study], table: &ScoreTable, row: &ScoreRow) -> Option<Markup> {
    let verdict = match studies {
        [study] => alone(study, row)?,
        _ => verdict(studies, table, row)?,
    };
    let light = light::words(studies, &table.names, &row.metric, &row.channel);
    Some(html! { (verdict) @if !light.is_empty() { " " (light) } })
}

/// Score of a single sensor.
fn alone(study: &Study, row: &ScoreRow) -> Option<Markup> {
    let cell = row.cells.first()?.as_ref()?;
    if cell.value.is_none() {
        let reason = cell.formatted.reason.as_deref()?;
        return Some(html! { "no value (" (reason) ")." });
    }
    let score = study.score(&row.metric, &row.channel);
    let sample = score.and_then(|score| study.dominant(score));
    Some(html! {
        (phrase(cell, row)) ", n = " (cell.n) @if let Some(groups) = cell.groups { " of " (counted(groups, "group")) } "."
        @if let Some(why) = cell.standing.reason() { " Not used in verdicts: " (why) "." }
        @if let Some(sample) = sample { " Its " (sample) ": look at its data and its labels." }
        @if let Some(remedy) = cell.standing.remedy(study.made.folds.is_some()) { " " (remedy) }
    })
}

/// Verdict on the best of several sensors.
fn verdict(studies: &[Study], table: &ScoreTable, row: &ScoreRow) -> Option<Markup> {
    let score = |at: usize| studies.get(at)?.score(&row.metric, &row.channel);
    let known = row.cells.iter().enumerate();
    let known: Vec<Known<'_>> = known
        .filter_map(|(at, cell)| {
            let cell = cell.as_ref()?;
            Some(Known {
                at,
                cell,
                value: cell.value?,
            })
        })
        .collect();
    let better = (0..studies.len()).find_map(score).map(Score::better)?;
    let barred = barred(&known, table);
    let beside = format!("{}{barred}", without(row, table));
    let known = known.into_iter().filter(|known| known.cell.takes_part());
    let known: Vec<Known<'_>> = known.collect();
    if known.is_empty() && !barred.is_empty() {
        return Some(html! { "no verdict." (barred) });
    }
    let which: Vec<usize> = known.iter().map(|known| known.at).collect();
    let spread = spread::words(studies, &table.names, &which, &row.metric, &row.channel);
    if let Some(tie) = tie(studies, &table.names, &row.metric, &row.channel) {
        let answers = table.answers.iter();
        let answers = answers.filter(|of| of.metric == row.metric && of.channel == row.channel);
        let answers: Vec<&Answer> = answers.collect();
        let unbeaten = tie.unbeaten(&answers, which, &table.names);
        return Some(html! { (tie.words) (spread) (unbeaten) "." (beside) });
    }
    let (at, _) = best(known.iter().map(|known| (known.at, known.value)), better)?;
    let best = known.iter().find(|known| known.at == at)?;
    let rivals = rivals(at, &known, table, row);
    let that_takes_part = match barred.is_empty() {
        true => "",
        false => " that takes part",
    };
    let verdict = if known.len() < 2 {
        format!("is the only {} with a value{that_takes_part}", table.noun)
    } else if is_demonstration(studies, &row.metric) {
        format!("has the best value, but {NO_VERDICT}")
    } else if rivals.is_empty() {
        format!(
            "is shown to be better than every other {}{that_takes_part}",
            table.noun
        )
    } else {
        format!("has the best value, but is not shown to be better than {rivals}")
    };
    let (name, value) = (&table.names[at], phrase(best.cell, row));
    Some(html! { (name) " " (verdict) ", with " (value) (spread) "." (beside) })
}

/// Known value of one study.
struct Known<'a> {
    at: usize,
    cell: &'a ScoreCell,
    value: f64,
}

/// Sensors without a value: ` No value: GelSightWM.`
fn without(row: &ScoreRow, table: &ScoreTable) -> String {
    let missing = row.cells.iter().zip(&table.names);
    let missing = missing.filter(|(cell, _)| cell.as_ref().is_none_or(|cell| cell.value.is_none()));
    let missing: Vec<String> = missing.map(|(_, name)| name.clone()).collect();
    match missing.len() {
        0 => String::new(),
        _ => format!(" No value: {}.", listed(&missing)),
    }
}

/// Sensors that are excluded from verdicts, with the reason: ` Excluded from verdicts: GelSightWM (not better than predicting the mean).`
fn barred(known: &[Known<'_>], table: &ScoreTable) -> String {
    let barred = known.iter().filter(|known| !known.cell.takes_part());
    let barred: Vec<String> = barred
        .filter_map(|known| {
            let (name, remark) = (&table.names[known.at], known.cell.remark()?);
            Some(format!("{name} ({remark})"))
        })
        .collect();
    match barred.is_empty() {
        true => String::new(),
        false => format!(" Excluded from verdicts: {}.", listed(&barred)),
    }
}

/// Text on the sensors over which the best sensor is not significantly better.
fn rivals(best: usize, known: &[Known<'_>], table: &ScoreTable, row: &ScoreRow) -> String {
    let loses = |at: usize| {
        table.answers.iter().any(|answer| {
            let is_of_row = answer.metric == row.metric && answer.channel == row.channel;
            let of_both = [answer.sides.a, answer.sides.b];
            is_of_row && of_both.contains(&at) && answer.better() == Some(best)
        })
    };
    let rivals = known.iter().map(|known| known.at);
    let rivals = rivals.filter(|at| *at != best && !loses(*at));
    let rivals: Vec<String> = rivals.map(|at| table.names[at].clone()).collect();
    listed(&rivals)
}

fn phrase(cell: &ScoreCell, row: &ScoreRow) -> Markup {
    let (value, unit) = (minus(&cell.formatted.value), spaced(row.unit));
    html! {
        @if let Some([low, high]) = &cell.formatted.interval {
            span.nb { (value) (unit) } " " span.nb { "(" (minus(low)) " … " (minus(high)) ")" }
        } @else {
            (value) (unit)
        }
        @if let Some(remark) = cell.remark() { ", " (remark) }
    }
}
