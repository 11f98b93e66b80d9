//! Scores as tables that sort.

use taceva_core::Unit;

use super::glossary::metric_link;
use crate::escape::html;
use crate::number::minus;
use crate::scores::{ScoreCell, ScoreRow};

/// A table that sorts; nothing without rows. `id` is a word, `title` plain text.
pub(super) fn table(id: &str, title: &str, names: &[String], rows: &[&ScoreRow]) -> String {
    if rows.is_empty() {
        return String::new();
    }
    let mut out = format!(
        "<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"{title}\"><table class=\"sorts\" id=\"table-{id}\"><caption>{title}</caption><thead><tr>\
         <th scope=\"col\">metric</th><th scope=\"col\">channel</th><th scope=\"col\">unit</th>"
    );
    for name in names {
        out += &format!("<th scope=\"col\" class=\"r\">{}</th>", html(name));
    }
    out += "</tr></thead><tbody>\n";
    for row in rows {
        let unit = match row.unit {
            Unit::One => "",
            unit => unit.symbol(),
        };
        out += &format!(
            "<tr><th scope=\"row\">{}</th><td>{}</td><td>{unit}</td>",
            metric_link(&row.metric),
            html(&row.channel)
        );
        for value in &row.cells {
            out += &cell(value.as_ref());
        }
        out += "</tr>\n";
    }
    out + "</tbody></table></div>\n"
}

fn cell(cell: Option<&ScoreCell>) -> String {
    let Some(cell) = cell else {
        return "<td class=\"none\" data-v=\"\">–</td>".to_owned();
    };
    let formatted = &cell.formatted;
    let Some(value) = cell.value else {
        let reason = html(formatted.reason.as_deref().unwrap_or("no value"));
        return format!("<td class=\"none\" data-v=\"\">– <span class=\"ci\">{reason}</span></td>");
    };
    let shown = match cell.is_best {
        true => format!("<b>{}</b>", minus(&formatted.value)),
        false => minus(&formatted.value),
    };
    let invalid = match cell.n_invalid {
        0 => String::new(),
        invalid => format!(" (+{invalid} invalid)"),
    };
    let interval = match (&formatted.interval, &formatted.reason) {
        (Some([low, high]), _) => {
            let (low, high, n) = (minus(low), minus(high), cell.n);
            // Where it is broken, it is behind the comma.
            format!("{low}\u{a0}…\u{a0}{high}, n\u{a0}=\u{a0}{n}{invalid}")
        }
        (None, Some(_)) | (None, None) => format!("no interval, n = {}{invalid}", cell.n),
    };
    // On a line of its own: beside the interval it would make the column wide.
    let remark = cell.remark().map_or_else(String::new, |remark| {
        format!("<span class=\"ci\">{}</span>", html(&remark))
    });
    let why = formatted.reason.as_deref().unwrap_or_default();
    let hover = match why {
        "" => String::new(),
        why => format!(" title=\"interval {}\"", html(why)),
    };
    format!(
        "<td class=\"r\" data-v=\"{value:?}\"{hover}>{shown}<span class=\"ci\">{interval}</span>{remark}</td>"
    )
}
