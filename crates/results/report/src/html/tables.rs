//! Sortable tables of scores.

use maud::{Markup, html};
use taceva_core::Unit;

use crate::markup::metric_link;
use crate::markup::{heads, right_heads, scroll};
use crate::number::minus;
use crate::scores::{ScoreCell, ScoreRow};

/// Sortable table; empty without rows. `id` is a single word.
pub(super) fn table(id: &str, title: &str, names: &[String], rows: &[&ScoreRow]) -> Markup {
    let unit = |row: &ScoreRow| match row.unit {
        Unit::One => "",
        unit => unit.symbol(),
    };
    let table = html! {
        table.sorts id={ "table-" (id) } {
            caption { (title) }
            thead { tr { (heads(["metric", "channel", "unit"])) (right_heads(names)) } }
            tbody {
                @for row in rows {
                    tr {
                        th scope="row" { (metric_link(&row.metric)) } td { (row.channel) } td { (unit(row)) }
                        @for value in &row.cells { (cell(value.as_ref())) }
                    } "\n"
                }
            }
        }
    };
    html! { @if !rows.is_empty() { (scroll(title, &table)) } }
}

fn cell(cell: Option<&ScoreCell>) -> Markup {
    let Some(cell) = cell else {
        return html! { td.none data-v="" { "–" } };
    };
    let formatted = &cell.formatted;
    let Some(value) = cell.value else {
        let reason = formatted.reason.as_deref().unwrap_or("no value");
        return html! { td.none data-v="" { "– " span.ci { (reason) } } };
    };
    let shown = minus(&formatted.value);
    let invalid = match cell.n_invalid {
        0 => String::new(),
        invalid => format!(" (+{invalid} invalid)"),
    };
    let interval = match &formatted.interval {
        Some([low, high]) => {
            let (low, high, n) = (minus(low), minus(high), cell.n);
            // Lines break only after the comma.
            format!("{low}\u{a0}…\u{a0}{high}, n\u{a0}=\u{a0}{n}{invalid}")
        }
        None => format!("no interval, n = {}{invalid}", cell.n),
    };
    let why = formatted.reason.as_deref().filter(|why| !why.is_empty());
    html! {
        td.r data-v=(format_args!("{value:?}")) title=[why.map(|why| format!("interval {why}"))] {
            @if cell.is_best { b { (shown) } } @else { (shown) }
            span.ci { (interval) }
            // On its own line, to keep the column narrow.
            @if let Some(remark) = cell.remark() { span.ci { (remark) } }
        }
    }
}
