//! Escapes text from devices and files so that it cannot control the terminal.

/// Returns `text` with control characters replaced by their escapes, such as `\n`.
pub(crate) fn shown(text: &str) -> String {
    let mut shown = String::with_capacity(text.len());
    for letter in text.chars() {
        if letter.is_control() {
            shown.extend(letter.escape_default());
        } else {
            shown.push(letter);
        }
    }
    shown
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn control_characters_are_written_out_and_the_rest_is_kept() {
        assert_eq!(shown("größe\u{1b}[2J\n"), "größe\\u{1b}[2J\\n");
    }
}
