//! From what, and how, and what the metrics mean.

use std::collections::BTreeSet;

use taceva_metrics::{Better, catalogue};

use crate::escape::html;
use crate::figures::names;
use crate::results::Study;
use crate::table::ScoreTable;

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
            out += &entry(term, text);
        }
        out += "</dl>\n";
    }
    let methods: BTreeSet<&str> = table
        .rows
        .iter()
        .flat_map(|row| row.cells.iter().flatten())
        .filter_map(|cell| cell.method.as_deref())
        .collect();
    out += "<h3>Intervals</h3>\n<p>All intervals are of 95 %; contact points are what may vary, not samples.</p><ul>";
    for method in methods {
        out += &format!("<li>{}</li>", html(method));
    }
    out += "</ul>\n<h3>What the metrics mean</h3>\n<dl>";
    for metric in catalogue::ALL {
        let mut rows = table.rows.iter();
        if rows.any(|row| row.metric == metric.id) {
            let better = match metric.better {
                Better::Lower => "lower is better",
                Better::Higher => "higher is better",
                Better::NearZero => "near zero is better",
                _ => "describes",
            };
            out += &format!(
                "<dt>{} <code>{}</code></dt><dd>{} ({better}; {})</dd>",
                html(metric.title),
                metric.id,
                html(metric.documentation),
                html(metric.reference)
            );
        }
    }
    out + "</dl>"
}

fn entry(term: &str, text: &str) -> String {
    format!("<dt>{}</dt><dd>{}</dd>", html(term), html(text))
}
