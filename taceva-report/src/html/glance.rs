//! The sensors side by side: the scores that a paper shows first, and radars.

use super::figures::one as figure;
use super::tables::table;
use super::themes::is_radar;
use crate::figure::Figure;
use crate::scores::{ScoreRow, ScoreTable};

/// The main table and the radars; nothing where there is neither.
pub(super) fn section(table: &ScoreTable, figures: &[Figure]) -> Option<String> {
    let main = table.main();
    let rows: Vec<&ScoreRow> = main.rows.iter().collect();
    let mut out = self::table("main", "Main scores", &main.names, &rows);
    let radars: String = figures
        .iter()
        .filter(|drawn| is_radar(drawn))
        .map(figure)
        .collect();
    if !radars.is_empty() {
        out += &format!("<div class=\"radars\">\n{radars}</div>\n");
    }
    (!out.is_empty()).then_some(out)
}
