//! Escapes text from files, devices and users for display, because it may contain characters that control a terminal.

use std::ffi::OsStr;
use std::fmt;

/// A name or a path on one line for display, with control characters and invisible characters escaped.
///
/// Messages print ids, file names and other text from outside the program through this type. Machine-readable output (JSON, CSV, journals, headers)
/// contains such text without these escapes.
///
/// ```
/// use taceva_core::shown;
/// assert_eq!(shown("gel\u{1b}[2J\u{202e}7\n").to_string(), "gel\\u{1b}[2J\\u{202e}7\\n");
/// assert_eq!(shown("µ-Geräte 触覚").to_string(), "µ-Geräte 触覚");
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Shown<'a>(&'a OsStr);

/// Escapes the name or path `text` for a message.
pub fn shown<T: AsRef<OsStr> + ?Sized>(text: &T) -> Shown<'_> {
    Shown(text.as_ref())
}

impl fmt::Display for Shown<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = self.0.to_string_lossy();
        if !text.contains(is_obeyed) {
            return f.pad(&text);
        }
        let mut written = String::with_capacity(text.len() + 8);
        for letter in text.chars() {
            push_shown(&mut written, letter);
        }
        f.pad(&written)
    }
}

/// Escapes control characters and invisible characters in text of several lines, except line feeds and tabs.
///
/// Programs call this function last, on composed text that goes to a terminal.
pub fn shown_lines(text: &str) -> String {
    let mut written = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '\n' | '\t' => written.push(letter),
            _ => push_shown(&mut written, letter),
        }
    }
    written
}

fn push_shown(written: &mut String, letter: char) {
    match is_obeyed(letter) {
        false => written.push(letter),
        true if matches!(letter, '\n' | '\r' | '\t') => written.extend(letter.escape_default()),
        true => written.extend(letter.escape_unicode()),
    }
}

/// Escapes `text` for a paragraph or a table cell of Markdown. The result is one line without markup.
///
/// ```
/// assert_eq!(taceva_core::markdown("a|b\n<i>*x*"), "a\\|b &lt;i>\\*x\\*");
/// ```
pub fn markdown(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '\n' | '\r' | '\t' => escaped.push(' '),
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '\\' | '|' | '*' | '_' | '`' | '[' | ']' | '~' | '#' | '!' => {
                escaped.extend(['\\', letter]);
            }
            _ if is_obeyed(letter) => {}
            _ => escaped.push(letter),
        }
    }
    escaped
}

/// True for characters that control the display or are invisible: control characters (C0 and C1), direction marks, line separators and zero-width
/// characters. With these characters, two different names can look the same.
pub fn is_obeyed(letter: char) -> bool {
    letter.is_control()
        || matches!(letter,
            // A soft hyphen, an Arabic mark of direction, a Mongolian mark without width.
            '\u{ad}' | '\u{61c}' | '\u{180e}'
            // Zero width, and marks of direction.
            | '\u{200b}'..='\u{200f}'
            // Separators of lines and paragraphs, and overrides of direction.
            | '\u{2028}'..='\u{202e}'
            // Invisible operators, isolates of direction, and older shaping controls.
            | '\u{2060}'..='\u{206f}'
            // The mark of byte order, annotations, and noncharacters.
            | '\u{feff}' | '\u{fff9}'..='\u{fffb}' | '\u{fffe}' | '\u{ffff}'
            // Tags, which spell invisible words.
            | '\u{e0000}'..='\u{e007f}')
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    #[test]
    fn nothing_that_a_terminal_obeys_is_left_of_any_letter() {
        for letter in '\0'..=char::MAX {
            let text = letter.to_string();
            let written = shown(&text).to_string();
            assert!(!written.contains(is_obeyed), "{letter:?}");
            assert_eq!(written == text, !is_obeyed(letter), "{letter:?}");
        }
    }

    #[test]
    fn letters_of_every_writing_are_left_alone() {
        for text in ["µ-Geräte", "触覚センサ", "חיישן", "مستشعر", "a\u{301}", "𝒻"]
        {
            assert_eq!(shown(text).to_string(), text);
        }
    }

    #[test]
    fn the_marks_that_turn_writing_are_each_written_out() {
        let marks = [
            '\u{61c}', '\u{200e}', '\u{200f}', '\u{202a}', '\u{202e}', '\u{2066}', '\u{2069}',
        ];
        for mark in marks {
            let text = format!("a{mark}b");
            let written = format!("a\\u{{{:x}}}b", u32::from(mark));
            assert_eq!(shown(&text).to_string(), written);
        }
    }

    #[test]
    fn a_name_stays_on_its_line_and_a_text_keeps_its_lines() {
        assert_eq!(shown("a\nb\tc\r").to_string(), "a\\nb\\tc\\r");
        assert_eq!(shown_lines("a\nb\tc\r\u{9b}"), "a\nb\tc\\r\\u{9b}");
    }

    #[test]
    fn paths_are_shown_by_the_same_rule_and_fill_their_columns() {
        assert_eq!(shown(Path::new("a\u{1b}/b")).to_string(), "a\\u{1b}/b");
        assert_eq!(format!("{:<4}|", shown("ab")), "ab  |");
    }
}
