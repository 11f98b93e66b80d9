//! Escapes text of a plugin for a terminal.

use taceva_core::is_obeyed;

/// Escapes the control characters of `text` except line feeds, so that no terminal executes them.
pub(crate) fn plain(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '\n' => plain.push('\n'),
            _ if is_obeyed(character) => {
                plain.extend(character.escape_unicode());
            }
            _ => plain.push(character),
        }
    }
    plain
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_terminal_would_obey_is_written_out() {
        assert_eq!(
            plain("a\u{1b}[2Jb\u{202e}c\nd\0"),
            "a\\u{1b}[2Jb\\u{202e}c\nd\\u{0}"
        );
    }
}
