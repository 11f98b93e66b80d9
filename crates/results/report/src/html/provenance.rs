//! Provenance section.

use std::collections::BTreeMap;

use maud::{Markup, html};

use super::methods::clusters;
use crate::markup::terms;
use crate::names::names;
use crate::results::Study;
use crate::scores::ScoreTable;
use taceva_results::described_method;

pub(super) fn section(studies: &[Study], table: &ScoreTable) -> Markup {
    let methods = methods(table);
    html! {
        @for (study, name) in studies.iter().zip(names(studies)) {
            h3 { (name) } "\n"
            dl {
                (terms([("sensor", &study.sensor), ("serial", &study.serial), ("gel", &study.gel), ("samples", &study.source)]))
                (terms(study.provenance.iter().map(|(term, text)| (term, of_parts(study, term, text)))))
            } "\n"
        }
        h3 { "Intervals" } "\n"
        p { "All intervals are of 95 %, over " (clusters(studies)) " unless a line says otherwise." }
        ul { @for method in &methods { li { (method) } } }
    }
}

/// Methods of intervals, each with its metrics if methods differ: `jackknife by point_id, G=20, logarithmic (mae, rmse)`.
fn methods(table: &ScoreTable) -> Vec<String> {
    let mut methods: BTreeMap<String, Vec<&str>> = BTreeMap::new();
    for row in &table.rows {
        for cell in row.cells.iter().flatten() {
            if let Some(method) = &cell.method {
                let metrics = methods.entry(described_method(method, cell.n)).or_default();
                if !metrics.contains(&row.metric.as_str()) {
                    metrics.push(&row.metric);
                }
            }
        }
    }
    let is_one = methods.len() == 1;
    let named = |(method, metrics): (String, Vec<&str>)| match is_one {
        true => method,
        false => format!("{method} ({})", metrics.join(", ")),
    };
    methods.into_iter().map(named).collect()
}

/// Text of a provenance entry. In the entry `samples`, replaces `left_out` by readable words. In a recording of presses, these samples belong to
/// other phases of the protocol.
fn of_parts(study: &Study, term: &str, text: &str) -> String {
    let left_out = match study.made.presses {
        0 => "left out ",
        _ => "of other parts of the protocol ",
    };
    match term {
        "samples" => text.replace("left_out ", left_out),
        _ => text.to_owned(),
    }
}
