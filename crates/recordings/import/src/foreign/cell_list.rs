//! Lists in one cell: `[0.1, 0.2]`, `1 2 3`, `1;2;3`, `["a", "b, c"]`, nested lists, and numbers as NumPy prints them.

use std::borrow::Cow;

/// Maximum depth of nested lists.
const DEEPEST: usize = 16;

/// Element of the list in a cell.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Value<'a> {
    /// Text of the value, without quotes.
    pub(crate) text: Cow<'a, str>,
    is_quoted: bool,
}

impl Value<'_> {
    /// True for an unquoted JSON `null`.
    pub(crate) fn is_null(&self) -> bool {
        !self.is_quoted && self.text == "null"
    }
}

/// Same as [`item`], but a quoted text loses its quotes.
pub(crate) fn value<'a>(cell: &'a str, index: &[usize]) -> Result<Value<'a>, String> {
    let found = item(cell, index)?;
    Ok(match unquoted(found) {
        Some(text) => Value {
            text,
            is_quoted: true,
        },
        None => Value {
            text: Cow::Borrowed(found),
            is_quoted: false,
        },
    })
}

/// Writes a text as an element of a list. Quotes the text if it could be read as several elements or as another value.
pub(crate) fn member(text: String) -> String {
    let is_special = |letter: char| letter.is_whitespace() || "[](),;\"'\\".contains(letter);
    match text.as_str() {
        "" | "null" | "..." => quoted(&text),
        other if other.contains(is_special) => quoted(&text),
        _ => text,
    }
}

fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

/// Element at `index` of the list in `cell`, with one position per list level, the outermost first. The error states why the element does not exist.
pub(crate) fn item<'a>(cell: &'a str, index: &[usize]) -> Result<&'a str, String> {
    let mut found = cell.trim();
    for (depth, position) in index.iter().enumerate() {
        if depth > 0 && !found.starts_with(['[', '(']) {
            return Err(format!("`{found}` is a single value, expected a list"));
        }
        let parts = parts(found)?;
        if parts.contains(&"...") {
            return Err(
                "`...` replaces values: the array was shortened when it was printed".to_owned(),
            );
        }
        found = parts.get(*position).copied().ok_or_else(|| {
            let count = parts.len();
            format!("there is no value [{position}] among the {count} of this cell, counted from 0")
        })?;
    }
    Ok(plain(found))
}

/// Number without the type name that NumPy 2 prints around it: `np.float64(1.5)`.
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

/// Text between quotes, if `value` is quoted.
fn unquoted(value: &str) -> Option<Cow<'_, str>> {
    if quoted_bytes(value)? != value.len() {
        return None;
    }
    let inside = &value[1..value.len() - 1];
    if !inside.contains('\\') {
        return Some(Cow::Borrowed(inside));
    }
    let json = match value.starts_with('"') {
        true => serde_json::from_str(value).ok(),
        false => None,
    };
    Some(Cow::Owned(json.unwrap_or_else(|| unescaped(inside))))
}

/// Text printed by Python, with its escape sequences resolved.
fn unescaped(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    let mut letters = text.chars();
    while let Some(letter) = letters.next() {
        if letter != '\\' {
            plain.push(letter);
            continue;
        }
        match letters.next() {
            Some('n') => plain.push('\n'),
            Some('r') => plain.push('\r'),
            Some('t') => plain.push('\t'),
            Some(same @ ('\\' | '\'' | '"')) => plain.push(same),
            Some(other) => plain.extend(['\\', other]),
            None => plain.push('\\'),
        }
    }
    plain
}

/// Length of the quoted text at the beginning of `text`, in bytes, quotes included. `None` if `text` does not begin with a quote, or if more text follows
/// directly.
fn quoted_bytes(text: &str) -> Option<usize> {
    let mut letters = text.char_indices();
    let (_, quote) = letters
        .next()
        .filter(|(_, letter)| matches!(letter, '"' | '\''))?;
    let mut is_escaped = false;
    for (at, letter) in letters {
        if is_escaped {
            is_escaped = false;
        } else if letter == '\\' {
            is_escaped = true;
        } else if letter == quote {
            let end = at + 1;
            let next = text[end..].chars().next();
            let is_end = next.is_none_or(|next| next.is_whitespace() || "[](),;".contains(next));
            return is_end.then_some(end);
        }
    }
    None
}

/// Elements of the outermost list, or of a cell without brackets.
fn parts(cell: &str) -> Result<Vec<&str>, String> {
    let inside = ["[]", "()"].iter().find_map(|pair| {
        let (open, close) = pair.split_at(1);
        cell.strip_prefix(open)?.strip_suffix(close)
    });
    let inside = inside.unwrap_or(cell).trim();
    if inside.is_empty() {
        return Ok(Vec::new());
    }
    // Between semicolons, a comma belongs to a number, which is then rejected.
    let semicolons = ends(inside, |letter| letter == ';')?;
    let separators = match semicolons.is_empty() {
        true => ends(inside, |letter| letter == ',')?,
        false => semicolons,
    };
    let is_blank_apart = separators.is_empty();
    let separators = match is_blank_apart {
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
    // Consecutive blanks are one separator.
    parts.retain(|part| !(is_blank_apart && part.is_empty()));
    Ok(parts)
}

/// Offset and length of each separator outside brackets and quotes, bytes.
fn ends(text: &str, is_separator: impl Fn(char) -> bool) -> Result<Vec<(usize, usize)>, String> {
    let mut depth = 0_usize;
    let mut found = Vec::new();
    // True where a value may begin, so that an apostrophe within a word opens no quoted text.
    let mut is_begin = true;
    let mut quoted_until = 0;
    for (at, letter) in text.char_indices() {
        if at < quoted_until {
            continue;
        }
        if is_begin && let Some(length) = quoted_bytes(&text[at..]) {
            quoted_until = at + length;
            continue;
        }
        is_begin = match letter {
            '[' | '(' | ',' | ';' => true,
            _ => is_begin && letter.is_whitespace(),
        };
        match letter {
            '[' | '(' => depth += 1,
            ']' | ')' => {
                depth = depth
                    .checked_sub(1)
                    .ok_or("a closing bracket has no opening bracket")?;
            }
            _ if depth == 0 && is_separator(letter) => found.push((at, letter.len_utf8())),
            _ => {}
        }
        if depth > DEEPEST {
            return Err(format!("lists are nested more than {DEEPEST} deep"));
        }
    }
    match depth {
        0 => Ok(found),
        _ => Err("an opening bracket has no closing bracket".to_owned()),
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
    fn a_text_in_quotes_is_one_value_whatever_it_holds() {
        for (cell, index, expected) in [
            (r#"["soft", "cube, red"]"#, &[1][..], "cube, red"),
            (r#"["a;b","c"]"#, &[0], "a;b"),
            (r#"["a]b", "(c"]"#, &[1], "(c"),
            (r#"[["a, b", "c"], ["d"]]"#, &[0, 0], "a, b"),
            (r#"["a\"b\\", "\u00e9"]"#, &[0], "a\"b\\"),
            (r#"["a\"b\\", "\u00e9"]"#, &[1], "é"),
            (r#"["soft cube"]"#, &[0], "soft cube"),
            (r#"[""]"#, &[0], ""),
            (r#"["null", null]"#, &[0], "null"),
            ("['1,5','2']", &[0], "1,5"),
            ("['it\\'s', 'b']", &[0], "it's"),
            ("['soft' 'cube, red']", &[1], "cube, red"),
            ("it's, 'n' b, don't", &[2], "don't"),
            ("'tis don't, so", &[0], "'tis don't"),
            ("\"1\",\"2\"", &[1], "2"),
        ] {
            let found = value(cell, index).map(|found| found.text);
            assert_eq!(found.as_deref(), Ok(expected), "{cell}");
        }
        let is_null = |cell| value(cell, &[0]).map(|found| found.is_null());
        assert_eq!(is_null("[null]"), Ok(true));
        assert_eq!(is_null(r#"["null"]"#), Ok(false));
    }

    #[test]
    fn a_member_of_a_list_reads_back_as_the_text_that_it_was() {
        for text in [
            "soft",
            "cube, red",
            "a;b",
            "",
            "null",
            "...",
            "it's",
            "a\"b\\c",
            "[1]",
            "a b",
            "1,5",
            "np.float64(1)",
            "é\n",
        ] {
            for other in ["x", "y z"] {
                let [one, two] = [text, other].map(|text| member(text.to_owned()));
                let cell = format!("[{one}, {two}]");
                let found = value(&cell, &[0]).map(|found| found.text);
                assert_eq!(found.as_deref(), Ok(text), "{cell}");
            }
        }
        assert_eq!(member("soft".to_owned()), "soft");
        assert_eq!(member("1.5".to_owned()), "1.5");
    }

    #[test]
    fn what_is_not_there_or_not_closed_is_said() {
        for (cell, index, expected) in [
            ("[1, 2]", &[2][..], "no value [2] among the 2"),
            ("[1. 2. ... 8. 9.]", &[1], "`...` replaces values"),
            ("[1, 2, 3]", &[1, 0], "`2` is a single value"),
            ("", &[0], "no value [0] among the 0"),
            ("[1, [2, 3]", &[0], "no closing bracket"),
            ("1]", &[0], "no opening bracket"),
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
