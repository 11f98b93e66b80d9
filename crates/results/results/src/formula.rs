//! Escapes CSV cells that a spreadsheet would evaluate as a formula.

/// Returns the text of a CSV cell, with an apostrophe before a text that begins like a formula.
///
/// [`unescape_csv`] removes the apostrophe, so that programs read the original names:
///
/// ```
/// use taceva_results::{escape_csv, unescape_csv};
/// assert_eq!(escape_csv("=1+1"), "'=1+1");
/// assert_eq!(unescape_csv(&escape_csv("'=1+1")), "'=1+1");
/// ```
pub fn escape_csv(text: &str) -> String {
    match begins_like_a_formula(text) {
        true => format!("'{text}"),
        false => text.to_owned(),
    }
}

/// Original text of a cell that [`escape_csv`] has written.
pub fn unescape_csv(cell: &str) -> &str {
    match cell.strip_prefix('\'') {
        Some(text) if begins_like_a_formula(text) => text,
        _ => cell,
    }
}

/// True if the text, without leading apostrophes, begins with a sign such as `=` or `＝`, a tab or a line break.
fn begins_like_a_formula(text: &str) -> bool {
    text.trim_start_matches('\'')
        .starts_with(['=', '+', '-', '@', '\t', '\r', '\n', '＝', '＋', '－', '＠'])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_that_begin_like_a_formula_are_words() {
        let cells = ["=1+1", "+1", "-x", "@x", "plain"].map(escape_csv);
        assert_eq!(cells, ["'=1+1", "'+1", "'-x", "'@x", "plain"]);
    }

    #[test]
    fn whatever_a_name_is_a_cell_gives_it_back() {
        let odd = ["'", "''", "'=x", "''=x", "it's", "'\t"];
        for text in naughty_strings::BLNS.iter().chain(&odd) {
            let cell = escape_csv(text);
            assert_eq!(unescape_csv(&cell), *text);
            assert!(
                !cell.starts_with(['=', '+', '-', '@', '\t', '\r', '\n']),
                "{text:?}"
            );
        }
    }
}
