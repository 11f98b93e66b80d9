//! Foreign text in messages: escaped by [`taceva_core::shown`] and truncated to a maximum length.

const CHARACTERS_MAX: usize = 200;

/// Escapes control characters of `text` and truncates it after 200 characters.
pub(crate) fn shown(text: &str) -> String {
    match text.char_indices().nth(CHARACTERS_MAX) {
        Some((end, _)) => format!("{}…", taceva_core::shown(&text[..end])),
        None => taceva_core::shown(text).to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn control_characters_are_written_out_and_long_text_is_cut() {
        assert_eq!(shown("a\u{1b}[31m\n"), "a\\u{1b}[31m\\n");
        assert_eq!(shown("b\u{202e}c"), "b\\u{202e}c");
        assert_eq!(shown(&"x".repeat(900)).chars().count(), 201);
    }
}
