//! What the results say, in words.

use taceva_metrics::Better;

use super::glossary::score_link;
use crate::escape::html;
use crate::figures::{listed, names};
use crate::number::{minus, spaced};
use crate::results::{Score, Study};
use crate::table::{ScoreCell, ScoreRow, ScoreTable};
use crate::tie::tie;

/// What stands below the title.
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
    ("uniformity", "Fz", "Evenness of the surface"),
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

fn answer(studies: &[Study], table: &ScoreTable, row: &ScoreRow) -> Option<String> {
    let known: Vec<(usize, &ScoreCell, f64)> = row
        .cells
        .iter()
        .enumerate()
        .filter_map(|(at, cell)| cell.as_ref().and_then(|cell| Some((at, cell, cell.value?))))
        .collect();
    let barred = barred(&known, table);
    let better = studies
        .iter()
        .find_map(|study| study.score(&row.metric, &row.channel))
        .map(Score::better)?;
    let phrase = |cell: &ScoreCell| phrase(cell, row);
    if studies.len() == 1 {
        return Some(match known.first() {
            Some((_, cell, _)) => {
                let why = cell
                    .standing
                    .reason()
                    .map(|why| format!(" It claims nothing: {why}."));
                format!(
                    "{}, n = {}.{}",
                    phrase(cell),
                    cell.n,
                    why.unwrap_or_default()
                )
            }
            None => {
                let cell = row.cells.first()?.as_ref()?;
                format!("no value ({}).", html(cell.printed.reason.as_deref()?))
            }
        });
    }
    let known: Vec<(usize, &ScoreCell, f64)> = known
        .into_iter()
        .filter(|(_, cell, _)| cell.takes_part())
        .collect();
    if known.is_empty() && !barred.is_empty() {
        return Some(format!("no verdict.{barred}"));
    }
    let best = known.iter().copied().reduce(|best, next| match better {
        Better::Higher if next.2 > best.2 => next,
        Better::Lower if next.2 < best.2 => next,
        Better::NearZero if next.2.abs() < best.2.abs() => next,
        _ => best,
    })?;
    let name = html(&table.names[best.0]);
    let verdict = if known.len() < 2 {
        match barred.is_empty() {
            true => "alone has a value".to_owned(),
            false => "alone has a value that takes part".to_owned(),
        }
    } else if best.1.is_best {
        match barred.is_empty() {
            true => "is shown to be better than every other sensor".to_owned(),
            false => "is shown to be better than every other sensor that takes part".to_owned(),
        }
    } else if let Some(tie) = tie(studies, &table.names, &row.metric, &row.channel) {
        return Some(format!("{}.{}{barred}", html(&tie), without(row, table)));
    } else {
        let rivals = rivals(best.0, &known, (table, row));
        format!("has the best value, but is not shown to be better than {rivals}")
    };
    Some(format!(
        "{name} {verdict}, with {}.{}{barred}",
        phrase(best.1),
        without(row, table)
    ))
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
fn barred(known: &[(usize, &ScoreCell, f64)], table: &ScoreTable) -> String {
    let barred = known.iter().filter(|(_, cell, _)| !cell.takes_part());
    let barred: Vec<String> = barred
        .filter_map(|(at, cell, _)| {
            let remark = cell.remark()?;
            Some(format!("{} ({})", html(&table.names[*at]), html(&remark)))
        })
        .collect();
    match barred.is_empty() {
        true => String::new(),
        false => format!(" No part in verdicts: {}.", listed(&barred)),
    }
}

/// Those that the best is not shown to be better than.
fn rivals(
    best: usize,
    known: &[(usize, &ScoreCell, f64)],
    (table, row): (&ScoreTable, &ScoreRow),
) -> String {
    let loses = |at: usize| {
        table.answers.iter().any(|answer| {
            let is_of_row = answer.metric == row.metric && answer.channel == row.channel;
            let of_both = [answer.sides.a, answer.sides.b];
            is_of_row && of_both.contains(&at) && answer.better() == Some(best)
        })
    };
    let rivals = known.iter().filter(|(at, _, _)| *at != best && !loses(*at));
    let rivals: Vec<String> = rivals.map(|(at, _, _)| html(&table.names[*at])).collect();
    listed(&rivals)
}

fn phrase(cell: &ScoreCell, row: &ScoreRow) -> String {
    let unit = spaced(row.unit);
    let value = minus(&cell.printed.value);
    let value = match &cell.printed.interval {
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
