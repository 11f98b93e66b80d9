//! The results in words.

use super::glossary::score_link;
use crate::compare::Answer;
use crate::escape::html;
use crate::figures::{listed, names};
use crate::light;
use crate::number::{minus, spaced};
use crate::results::{Score, Study};
use crate::scores::{ScoreCell, ScoreRow, ScoreTable};
use crate::spread;
use crate::tie::{best, tie};

/// The subtitle.
pub(crate) fn lead(studies: &[Study]) -> String {
    let names = names(studies);
    format!(
        "<p class=\"lead\">{}</p>{}",
        html(&listed(&names)),
        badge(studies)
    )
}

/// Whether anything was measured at all; nothing where everything was.
pub(crate) fn badge(studies: &[Study]) -> &'static str {
    let simulated = studies.iter().filter(|study| study.is_simulated()).count();
    if simulated == studies.len() {
        "<p class=\"badge\">Nothing here was measured: the samples are simulated.</p>"
    } else if simulated > 0 {
        "<p class=\"badge\">Not everything here was measured: some of the samples are simulated.</p>"
    } else {
        ""
    }
}

/// What is asked of a report first, with how it is answered.
pub(crate) const QUESTIONS: [(&str, &str, &str); 11] = [
    ("mae", "Pz", "Depth"),
    ("mae", "Pxy", "Position in the plane"),
    ("mae", "Fz", "Normal force"),
    ("mae", "Fxy", "Shear force"),
    ("sr", "line", "Fine lines"),
    ("sr", "dot", "Fine dots"),
    ("sensitivity", "Fz", "Sensitivity"),
    ("uniformity", "Fz", "Uniformity of the surface"),
    ("r_light", "Fz", "Force in changing light"),
    ("repeatability", "Pz", "Repeated depth"),
    ("hysteresis", "Fz", "Hysteresis"),
];

pub(super) fn section(studies: &[Study], table: &ScoreTable) -> String {
    let mut out = String::from("<ul class=\"verdicts\">\n");
    let mut answered = 0;
    for (metric, channel, question) in QUESTIONS {
        let row = table
            .rows
            .iter()
            .find(|row| row.metric == metric && row.channel == channel);
        if let Some(words) = row.and_then(|row| answer(studies, table, row)) {
            out += &format!(
                "<li><strong>{question}</strong> ({}): {words}</li>\n",
                score_link(metric, channel)
            );
            answered += 1;
        }
    }
    if answered == 0 {
        for row in table.headlines().rows.iter().take(8) {
            if let Some(words) = answer(studies, table, row) {
                let of = score_link(&row.metric, &row.channel);
                out += &format!("<li>{of}: {words}</li>\n");
            }
        }
    }
    out + "</ul>\n"
}

/// The verdict, and the effect of light on scores of lighting.
fn answer(studies: &[Study], table: &ScoreTable, row: &ScoreRow) -> Option<String> {
    let verdict = match studies {
        [_] => alone(row)?,
        _ => verdict(studies, table, row)?,
    };
    let light = light::words(studies, &table.names, &row.metric, &row.channel);
    Some(match light.is_empty() {
        true => verdict,
        false => format!("{verdict} {}", html(&light)),
    })
}

/// The score of a single sensor.
fn alone(row: &ScoreRow) -> Option<String> {
    let cell = row.cells.first()?.as_ref()?;
    if cell.value.is_none() {
        let reason = cell.formatted.reason.as_deref()?;
        return Some(format!("no value ({}).", html(reason)));
    }
    let why = cell.standing.reason();
    let why = why.map(|why| format!(" It claims nothing: {why}."));
    let (said, n) = (phrase(cell, row), cell.n);
    Some(format!("{said}, n = {n}.{}", why.unwrap_or_default()))
}

/// Who is best of several sensors.
fn verdict(studies: &[Study], table: &ScoreTable, row: &ScoreRow) -> Option<String> {
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
        return Some(format!("no verdict.{barred}"));
    }
    let which: Vec<usize> = known.iter().map(|known| known.at).collect();
    let spread = html(&spread::words(
        (studies, &table.names),
        &which,
        &row.metric,
        &row.channel,
    ));
    if let Some(tie) = tie(studies, &table.names, &row.metric, &row.channel) {
        let answers = table.answers.iter();
        let answers = answers.filter(|of| of.metric == row.metric && of.channel == row.channel);
        let answers: Vec<&Answer> = answers.collect();
        let unbeaten = tie.unbeaten(&answers, which, &table.names);
        return Some(format!(
            "{}{spread}{}.{beside}",
            html(&tie.words),
            html(&unbeaten)
        ));
    }
    let (at, _) = best(known.iter().map(|known| (known.at, known.value)), better)?;
    let best = known.iter().find(|known| known.at == at)?;
    let rivals = rivals(at, &known, (table, row));
    let that_takes_part = match barred.is_empty() {
        true => "",
        false => " that takes part",
    };
    let verdict = if known.len() < 2 {
        format!("alone has a value{that_takes_part}")
    } else if rivals.is_empty() {
        format!("is shown to be better than every other sensor{that_takes_part}")
    } else {
        format!("has the best value, but is not shown to be better than {rivals}")
    };
    let (name, value) = (html(&table.names[at]), phrase(best.cell, row));
    Some(format!("{name} {verdict}, with {value}{spread}.{beside}"))
}

/// A cell that has a value.
struct Known<'a> {
    at: usize,
    cell: &'a ScoreCell,
    value: f64,
}

/// Those that have no value: ` No value: GelSightWM.`
fn without(row: &ScoreRow, table: &ScoreTable) -> String {
    let missing = row.cells.iter().zip(&table.names);
    let missing = missing.filter(|(cell, _)| cell.as_ref().is_none_or(|cell| cell.value.is_none()));
    let missing: Vec<String> = missing.map(|(_, name)| html(name)).collect();
    match missing.len() {
        0 => String::new(),
        _ => format!(" No value: {}.", listed(&missing)),
    }
}

/// Those whose value claims nothing, and why: ` Takes no part: GelSightWM (no skill).`
fn barred(known: &[Known<'_>], table: &ScoreTable) -> String {
    let barred = known.iter().filter(|known| !known.cell.takes_part());
    let barred: Vec<String> = barred
        .filter_map(|known| {
            let (name, remark) = (&table.names[known.at], known.cell.remark()?);
            Some(format!("{} ({})", html(name), html(&remark)))
        })
        .collect();
    match barred.is_empty() {
        true => String::new(),
        false => format!(" No part in verdicts: {}.", listed(&barred)),
    }
}

/// Those that the best is not shown to be better than.
fn rivals(best: usize, known: &[Known<'_>], (table, row): (&ScoreTable, &ScoreRow)) -> String {
    let loses = |at: usize| {
        table.answers.iter().any(|answer| {
            let is_of_row = answer.metric == row.metric && answer.channel == row.channel;
            let of_both = [answer.sides.a, answer.sides.b];
            is_of_row && of_both.contains(&at) && answer.better() == Some(best)
        })
    };
    let rivals = known.iter().map(|known| known.at);
    let rivals = rivals.filter(|at| *at != best && !loses(*at));
    let rivals: Vec<String> = rivals.map(|at| html(&table.names[at])).collect();
    listed(&rivals)
}

fn phrase(cell: &ScoreCell, row: &ScoreRow) -> String {
    let unit = spaced(row.unit);
    let value = minus(&cell.formatted.value);
    let value = match &cell.formatted.interval {
        Some([low, high]) => {
            let [low, high] = [low, high].map(|end| minus(end));
            format!(
                "<span class=\"nb\">{value}{unit}</span> <span class=\"nb\">({low} … {high})</span>"
            )
        }
        None => format!("{value}{unit}"),
    };
    match cell.remark() {
        Some(remark) => format!("{value}, {}", html(&remark)),
        None => value,
    }
}
