//! Provenance section.

use std::collections::BTreeSet;

use maud::{Markup, html};

use super::methods::clusters;
use crate::markup::terms;
use crate::names::names;
use crate::results::Study;
use crate::scores::ScoreTable;

pub(super) fn section(studies: &[Study], table: &ScoreTable) -> Markup {
    let methods: BTreeSet<&str> = table
        .rows
        .iter()
        .flat_map(|row| row.cells.iter().flatten())
        .filter_map(|cell| cell.method.as_deref())
        .collect();
    html! {
        @for (study, name) in studies.iter().zip(names(studies)) {
            h3 { (name) } "\n"
            dl {
                (terms([("sensor", &study.sensor), ("serial", &study.serial), ("gel", &study.gel), ("samples", &study.source)]))
                (terms(study.provenance.iter().map(|(term, text)| (term, of_parts(term, text)))))
            } "\n"
        }
        h3 { "Intervals" } "\n"
        p { "All intervals are of 95 %, over " (clusters(studies)) " unless a line says otherwise." }
        ul { @for method in methods { li { (method) } } }
    }
}

/// Renames left-out samples, which belong to other parts of the protocol, for other metrics.
fn of_parts(term: &str, text: &str) -> String {
    match term {
        "samples" => text.replace("left_out ", "of other parts of the protocol "),
        _ => text.to_owned(),
    }
}
