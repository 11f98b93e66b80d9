//! Escapes external text for messages by [`taceva_core::shown`], and shortens long texts and lists.

use std::path::Path;

const SHOWN_CHARACTERS: usize = 80;

/// `text` with control characters escaped, cut after 80 characters.
pub fn shown(text: &str) -> String {
    match text.char_indices().nth(SHOWN_CHARACTERS) {
        Some((end, _)) => format!("{}…", taceva_core::shown(&text[..end])),
        None => taceva_core::shown(text).to_string(),
    }
}

/// `path` with control characters escaped.
pub fn shown_path(path: &Path) -> String {
    taceva_core::shown(path).to_string()
}

/// List of names for a message: the first few names, then the number of further names.
pub fn listed(names: &[String]) -> String {
    const LISTED: usize = 64;
    let shown: Vec<String> = names.iter().map(|name| shown(name)).collect();
    first_names(&shown, LISTED)
}

/// First `most` of `names`, unchanged, then the number of the remaining names.
pub fn first_names(names: &[impl AsRef<str>], most: usize) -> String {
    let first: Vec<&str> = names.iter().take(most).map(AsRef::as_ref).collect();
    let first = first.join(", ");
    match names.len().saturating_sub(most) {
        0 => first,
        more => format!("{first} and {more} more"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn control_characters_are_written_out_and_long_text_is_cut() {
        assert_eq!(shown("a\u{1b}[31m\n"), "a\\u{1b}[31m\\n");
        assert_eq!(shown(&"x".repeat(100)).chars().count(), 81);
    }

    #[test]
    fn names_beyond_the_limit_are_counted() {
        assert_eq!(first_names(&["a", "b"], 2), "a, b");
        assert_eq!(first_names(&["a", "b", "c", "d"], 2), "a, b and 2 more");
    }
}
