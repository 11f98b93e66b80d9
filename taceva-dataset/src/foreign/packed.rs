//! Several values in one cell: `[0.1, 0.2]`, `1 2 3`, `1;2;3`, lists in lists; and numbers as NumPy prints them.

/// The most levels of lists within lists.
const DEEPEST: usize = 16;

/// The value at `index` in `cell`, a position for each level from the outermost list inwards; the error says why there is none.
pub(crate) fn item<'a>(cell: &'a str, index: &[usize]) -> Result<&'a str, String> {
    let mut found = cell.trim();
    for (depth, position) in index.iter().enumerate() {
        if depth > 0 && !found.starts_with(['[', '(']) {
            return Err(format!("`{found}` is one value, where a list is expected"));
        }
        let parts = parts(found)?;
        if parts.contains(&"...") {
            return Err(
                "`...` stands for values that are not there: the array was cut when it was printed"
                    .to_owned(),
            );
        }
        found = parts.get(*position).copied().ok_or_else(|| {
            let count = parts.len();
            format!("there is no value [{position}] among the {count} of this cell, counted from 0")
        })?;
    }
    Ok(plain(found))
}

/// A number without the type that NumPy 2 prints around it: `np.float64(1.5)`.
pub(crate) fn plain(cell: &str) -> &str {
    let inner = cell
        .strip_prefix("np.")
        .and_then(|rest| rest.strip_suffix(')'))
        .and_then(|rest| rest.split_once('('));
    match inner {
        Some((kind, number))
            if ["float", "int", "uint"]
                .iter()
                .any(|of| kind.starts_with(of)) =>
        {
            number.trim()
        }
        _ => cell,
    }
}

/// The values of the outermost list, or of a cell without brackets.
fn parts(cell: &str) -> Result<Vec<&str>, String> {
    let inside = ["[]", "()"].iter().find_map(|pair| {
        let (open, close) = pair.split_at(1);
        cell.strip_prefix(open)?.strip_suffix(close)
    });
    let inside = inside.unwrap_or(cell).trim();
    if inside.is_empty() {
        return Ok(Vec::new());
    }
    // Between semicolons a comma belongs to a number, which then is none that is read.
    let semicolons = ends(inside, |letter| letter == ';')?;
    let separators = match semicolons.is_empty() {
        true => ends(inside, |letter| letter == ',')?,
        false => semicolons,
    };
    let separators = match separators.is_empty() {
        false => separators,
        true => ends(inside, char::is_whitespace)?,
    };
    let mut parts = Vec::with_capacity(separators.len() + 1);
    let mut begins = 0;
    for (at, width) in separators {
        parts.push(inside[begins..at].trim());
        begins = at + width;
    }
    parts.push(inside[begins..].trim());
    // Several blanks are one separator.
    let is_blank_apart = !inside.contains([',', ';']);
    parts.retain(|part| !(is_blank_apart && part.is_empty()));
    Ok(parts)
}

/// Where separators stand outside of every bracket, and how many bytes they have.
fn ends(text: &str, is_separator: impl Fn(char) -> bool) -> Result<Vec<(usize, usize)>, String> {
    let mut depth = 0_usize;
    let mut found = Vec::new();
    for (at, letter) in text.char_indices() {
        match letter {
            '[' | '(' => depth += 1,
            ']' | ')' => {
                depth = depth
                    .checked_sub(1)
                    .ok_or("a bracket is closed that was not opened")?;
            }
            _ if depth == 0 && is_separator(letter) => found.push((at, letter.len_utf8())),
            _ => {}
        }
        if depth > DEEPEST {
            return Err(format!("lists lie more than {DEEPEST} deep"));
        }
    }
    match depth {
        0 => Ok(found),
        _ => Err("a bracket is opened and never closed".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_is_found_behind_every_separator_and_in_lists_of_lists() {
        for (cell, index, expected) in [
            ("[0.0, 0.3, 2.0]", &[2][..], "2.0"),
            ("1;2;3", &[1], "2"),
            ("  1   2\t3 ", &[2], "3"),
            ("[[1, 2], [3, 4]]", &[1, 0], "3"),
            ("(1,2)", &[0], "1"),
            ("[1, , 3]", &[1], ""),
            ("[np.float64(1.5), 2]", &[0], "1.5"),
            ("[[1 2]\n [3 4]]", &[1, 1], "4"),
            ("7", &[0], "7"),
            ("[1,5; 2,5]", &[1], "2,5"),
        ] {
            assert_eq!(item(cell, index).as_deref(), Ok(expected), "{cell}");
        }
    }

    #[test]
    fn what_is_not_there_or_not_closed_is_said() {
        for (cell, index, expected) in [
            ("[1, 2]", &[2][..], "no value [2] among the 2"),
            ("[1. 2. ... 8. 9.]", &[1], "`...` stands for values"),
            ("[1, 2, 3]", &[1, 0], "`2` is one value"),
            ("", &[0], "no value [0] among the 0"),
            ("[1, [2, 3]", &[0], "never closed"),
            ("1]", &[0], "not opened"),
            (&"[".repeat(40), &[0], "deep"),
        ] {
            let problem = item(cell, index).expect_err(cell);
            assert!(problem.contains(expected), "{cell}: {problem}");
        }
    }

    #[test]
    fn a_number_stands_without_the_type_that_numpy_prints() {
        assert_eq!(plain("np.float64(1700000000.0)"), "1700000000.0");
        assert_eq!(plain("np.int32(-3)"), "-3");
        assert_eq!(plain("np.array(1)"), "np.array(1)");
        assert_eq!(plain("2.5"), "2.5");
    }
}
