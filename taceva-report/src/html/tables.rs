//! The scores as tables that sort, theme by theme.

use taceva_core::Unit;

use crate::escape::html;
use crate::number::minus;
use crate::table::{ScoreCell, ScoreRow, ScoreTable};

/// Metrics that are read together.
const THEMES: [(&str, &str, &[&str]); 5] = [
    (
        "accuracy",
        "Accuracy",
        &[
            "mae",
            "rmse",
            "bias",
            "r2",
            "smape",
            "smape_gated",
            "mae_euclid",
            "tolerance",
            "linearity",
            "bias_level",
            "crosstalk",
        ],
    ),
    (
        "detail",
        "Finest detail and least force",
        &["sr", "minimum_detectable_force", "signal_to_repeatability"],
    ),
    ("surface", "Sensitivity", &["sensitivity", "uniformity"]),
    (
        "robustness",
        "Robustness",
        &[
            "r_spatial",
            "r_light",
            "repeatability",
            "hysteresis",
            "inter_sensor",
            "drift",
        ],
    ),
    ("camera", "Camera and field of view", &["intrinsic"]),
];

pub(super) fn section(table: &ScoreTable) -> String {
    let headlines = table.headlines();
    let mut out = String::from(
        "<p class=\"note\">Below each value its 95 % interval and n. Bold: better than every other sensor shown, at a level of 5 % after Holm's adjustment over the metric. Columns sort.</p>\n",
    );
    if table.rows.is_empty() {
        out += "<p>There is no score in these results.</p>";
    }
    let theme_of = |row: &&ScoreRow| {
        let metric = row.metric.split('.').next().unwrap_or_default();
        THEMES
            .iter()
            .position(|(_, _, metrics)| metrics.contains(&metric))
    };
    for (position, (id, title, _)) in THEMES.iter().enumerate() {
        let rows: Vec<&ScoreRow> = headlines
            .rows
            .iter()
            .filter(|row| theme_of(row) == Some(position))
            .collect();
        out += &one(id, title, &headlines.names, &rows);
    }
    let others: Vec<&ScoreRow> = headlines
        .rows
        .iter()
        .filter(|row| theme_of(row).is_none())
        .collect();
    out += &one("other", "Other", &headlines.names, &others);
    let all: Vec<&ScoreRow> = table.rows.iter().collect();
    if all.len() > headlines.rows.len() {
        out += &format!(
            "<details><summary>All {} rows: every channel and every variant</summary>\n{}</details>\n",
            all.len(),
            one("all", "Every score", &table.names, &all)
        );
    }
    out
}

fn one(id: &str, title: &str, names: &[String], rows: &[&ScoreRow]) -> String {
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
            html(&row.metric),
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
    let printed = &cell.printed;
    let Some(value) = cell.value else {
        let reason = html(printed.reason.as_deref().unwrap_or("no value"));
        return format!("<td class=\"none\" data-v=\"\">– <span class=\"ci\">{reason}</span></td>");
    };
    let shown = match cell.is_best {
        true => format!("<b>{}</b>", minus(&printed.value)),
        false => minus(&printed.value),
    };
    let invalid = match cell.n_invalid {
        0 => String::new(),
        invalid => format!(" (+{invalid} invalid)"),
    };
    let interval = match (&printed.interval, &printed.reason) {
        (Some([low, high]), _) => {
            format!("{} … {}, n = {}{invalid}", minus(low), minus(high), cell.n)
        }
        (None, Some(_)) | (None, None) => format!("no interval, n = {}{invalid}", cell.n),
    };
    let why = printed.reason.as_deref().unwrap_or_default();
    let hover = match why {
        "" => String::new(),
        why => format!(" title=\"interval {}\"", html(why)),
    };
    format!(
        "<td class=\"r\" data-v=\"{value:?}\"{hover}>{shown}<span class=\"ci\">{interval}</span></td>"
    )
}
