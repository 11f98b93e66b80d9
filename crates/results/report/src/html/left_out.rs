//! Skipped scores and remarks.

use maud::{Markup, html};

use crate::markup::{heads, scroll};
use crate::names::{names, noun};
use crate::results::Study;

/// Number of skipped scores and remarks, and their rows.
pub(super) fn section(studies: &[Study]) -> (usize, Markup) {
    let mut rows: Vec<Markup> = Vec::new();
    for (study, name) in studies.iter().zip(names(studies)) {
        let mut row = |kind: &str, what: &str, why: &str| {
            rows.push(html! {
                tr { th scope="row" { (name) } td { (kind) } td.wrap { (what) } td.wrap.long { (why) } } "\n"
            });
        };
        for skip in &study.skipped {
            row("skipped", &skip.what, &skip.reason);
        }
        for score in &study.scores {
            let what = format!("{} {}", score.metric, score.channel);
            if let Some(reason) = score.value.reason() {
                row("no value", &what, &reason);
            }
            for flag in &score.flags {
                row("flag", &what, flag);
            }
        }
        for note in &study.notes {
            row("note", "", note);
        }
    }
    if rows.is_empty() {
        let nothing = "Nothing was skipped, every score has a value, and no remark was made.";
        return (0, html! { p { (nothing) } });
    }
    let table = html! {
        table.sorts {
            thead { tr { (heads([noun(studies), "kind", "what", "why"])) } }
            tbody { @for row in &rows { (row) } }
        }
    };
    (rows.len(), scroll("What was left out", &table))
}
