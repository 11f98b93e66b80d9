//! Overview of the sensors: main scores and radar charts.

use maud::{Markup, html};

use super::figures::radars;
use super::tables::table;
use crate::figure::Figure;
use crate::results::Study;
use crate::scores::{ScoreRow, ScoreTable};
use crate::training::unequal_models;

/// Main table and radar charts; `None` if both are absent.
pub(super) fn section(studies: &[Study], table: &ScoreTable, figures: &[Figure]) -> Option<Markup> {
    let main = table.main();
    let rows: Vec<&ScoreRow> = main.rows.iter().collect();
    let radars = radars(figures);
    (!rows.is_empty() || radars.is_some()).then(|| {
        html! {
            @if let Some(words) = unequal_models(studies) { p.note { (words) } "\n" }
            (self::table("main", "Main scores", &main.names, &rows))
            @if let Some(radars) = &radars { (radars) }
        }
    })
}
