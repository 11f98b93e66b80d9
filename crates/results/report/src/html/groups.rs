//! Errors of each group of the split.

use maud::{Markup, html};
use taceva_results::{GroupErrors, group_errors};

use crate::markup::{heads, scroll};
use crate::names::{names, noun};
use crate::number::numeral;
use crate::results::Study;

/// Number of groups, and the section with their errors. `None` if no study has a split by a column with few groups.
pub(super) fn section(studies: &[Study]) -> Option<(usize, Markup)> {
    let mut count = 0;
    let mut rows: Vec<Markup> = Vec::new();
    for (study, name) in studies.iter().zip(names(studies)) {
        let groups = of(study);
        count += groups.len();
        for own in &groups {
            for error in &own.errors {
                rows.push(html! {
                    tr {
                        th scope="row" { (name) } td.wrap { (own.group) } td { (error.channel) }
                        td { (numeral(error.mae)) } td { (error.unit) } td { (error.n) }
                    } "\n"
                });
            }
        }
    }
    let table = html! {
        table.sorts {
            thead { tr { (heads([noun(studies), "group", "channel", "mae", "unit", "n"])) } }
            tbody { @for row in &rows { (row) } }
        }
    };
    let body = html! {
        p.note { "Mean absolute errors without intervals, because an interval needs several groups." } "\n"
        (scroll("Errors of each group", &table))
    };
    (!rows.is_empty()).then_some((count, body))
}

/// Errors of the groups of `study`; empty for blocks of time, or without samples.
fn of(study: &Study) -> Vec<GroupErrors> {
    let is_column = study
        .made
        .group
        .as_deref()
        .is_some_and(|group| group != "block of time");
    match study.samples.as_ref().filter(|_| is_column) {
        Some(samples) => group_errors(samples, &study.scores),
        None => Vec::new(),
    }
}
