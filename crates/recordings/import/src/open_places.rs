//! Finds the gaps (`"?"`) of a drafted map.

/// Mark for a value that a draft leaves to the lab.
pub const OPEN: &str = "\"?\"";

/// Returns `line` without its comment. A `#` within quotes does not begin a comment.
pub fn code(line: &str) -> &str {
    let (mut is_quoted, mut is_escaped) = (false, false);
    let end = line.char_indices().find(|(_, letter)| {
        is_quoted ^= *letter == '"' && !is_escaped;
        is_escaped = is_quoted && *letter == '\\' && !is_escaped;
        *letter == '#' && !is_quoted
    });
    end.map_or(line, |(at, _)| &line[..at])
}

/// Number of gaps (`"?"`) in `map`, not counting comments.
pub fn open_places(map: &str) -> usize {
    map.lines()
        .map(|line| code(line).matches(OPEN).count())
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_in_comments_are_not_open() {
        let map =
            "# Replace every \"?\"\nmodel = \"?\"\n# or: Fz = { from = \"f\", unit = \"?\" }\n";
        assert_eq!(open_places(map), 1);
        assert_eq!(
            open_places("Fz = { from = \"?\", unit = \"?\" }   # \"?\"\n"),
            2
        );
        assert_eq!(code("a = \"#\" # b"), "a = \"#\" ");
        assert_eq!(code(r#"a = "\"" # b"#), r#"a = "\"" "#);
    }
}
