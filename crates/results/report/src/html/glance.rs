//! The sensors side by side: the scores that a paper shows first, and radars.

use maud::{Markup, html};

use super::figures::radars;
use super::tables::table;
use crate::figure::Figure;
use crate::scores::{ScoreRow, ScoreTable};

/// The main table and the radars; nothing where there is neither.
pub(super) fn section(table: &ScoreTable, figures: &[Figure]) -> Option<Markup> {
    let main = table.main();
    let rows: Vec<&ScoreRow> = main.rows.iter().collect();
    let radars = radars(figures);
    (!rows.is_empty() || radars.is_some()).then(|| {
        html! {
            (self::table("main", "Main scores", &main.names, &rows))
            @if let Some(radars) = &radars { (radars) }
        }
    })
}
