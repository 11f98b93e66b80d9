//! From what, and how.

use std::collections::BTreeSet;

use crate::escape::html;
use crate::figures::names;
use crate::results::Study;
use crate::scores::ScoreTable;

pub(super) fn section(studies: &[Study], table: &ScoreTable) -> String {
    let mut out = String::new();
    for (study, name) in studies.iter().zip(names(studies)) {
        out += &format!("<h3>{}</h3>\n<dl>", html(&name));
        let subject = [
            ("sensor", &study.sensor),
            ("serial", &study.serial),
            ("gel", &study.gel),
            ("samples", &study.source),
        ];
        for (term, text) in subject {
            out += &entry(term, text);
        }
        for (term, text) in &study.provenance {
            // Of a run's recording other metrics are formed from the presses of the other parts.
            let text = match term.as_str() {
                "samples" => text.replace("left_out ", "of other parts of the protocol "),
                _ => text.clone(),
            };
            out += &entry(term, &text);
        }
        out += "</dl>\n";
    }
    let methods: BTreeSet<&str> = table
        .rows
        .iter()
        .flat_map(|row| row.cells.iter().flatten())
        .filter_map(|cell| cell.method.as_deref())
        .collect();
    out += "<h3>Intervals</h3>\n<p>All intervals are of 95 %, by contact point unless a line says otherwise.</p><ul>";
    for method in methods {
        out += &format!("<li>{}</li>", html(method));
    }
    out + "</ul>"
}

fn entry(term: &str, text: &str) -> String {
    format!("<dt>{}</dt><dd>{}</dd>", html(term), html(text))
}
