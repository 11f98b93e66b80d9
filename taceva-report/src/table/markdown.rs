//! For pages: a row a score, a column a study.

use taceva_metrics::Better;

use super::{ScoreCell, ScoreTable};
use crate::escape::markdown as escape;

/// A table as Markdown; a value is bold where it is shown to be better than all others of its row.
pub fn markdown(table: &ScoreTable) -> String {
    let names: Vec<String> = table.names.iter().map(|name| escape(name)).collect();
    let mut out = format!("| metric | channel | unit | {} |\n", names.join(" | "));
    out += &format!("|---|---|---{}|\n", "|---:".repeat(names.len()));
    for row in &table.rows {
        let cells: Vec<String> = row
            .cells
            .iter()
            .map(|cell| self::cell(cell.as_ref()))
            .collect();
        out += &format!(
            "| {} | {} | {} | {} |\n",
            escape(&Better::named(&row.metric)),
            escape(&row.channel),
            row.unit,
            cells.join(" | ")
        );
    }
    out
}

fn cell(cell: Option<&ScoreCell>) -> String {
    let Some(cell) = cell else {
        return "–".to_owned();
    };
    let printed = &cell.printed;
    if printed.value.is_empty() {
        return escape(printed.reason.as_deref().unwrap_or("–"));
    }
    let value = match cell.is_best {
        true => format!("**{}**", printed.value),
        false => printed.value.clone(),
    };
    let value = match &printed.interval {
        Some([low, high]) => format!("{value} ({low} … {high})"),
        None => value,
    };
    match cell.remark() {
        Some(remark) => format!("{value}, {remark}"),
        None => value,
    }
}
