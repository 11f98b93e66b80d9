//! The last writer before a terminal or a file: no control character in a name reaches the terminal.
//!
//! Messages already escape names by [`taceva_core::shown`]. This module escapes all output again.

use std::io::{self, Write};

use taceva_core::{is_obeyed, shown_lines};

/// Kind of output, which decides how control characters are escaped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    /// Text. Control characters become `\u{1b}`, except line feeds and tabs.
    Words,
    /// JSON. Control characters become `\u001b`, which programs read as the same character.
    Json,
    /// Table for programs. Unchanged in files; on a terminal, escaped like text.
    Table,
}

/// Writer that escapes control characters.
pub(crate) struct Guard<W: Write> {
    out: W,
    form: Form,
    /// First bytes of a character that is not yet complete.
    begun: Vec<u8>,
}

impl<W: Write> Guard<W> {
    /// Creates a writer to `out` for [`Form::Words`] or [`Form::Json`].
    pub(crate) fn new(out: W, form: Form) -> Guard<W> {
        Guard {
            out,
            form,
            begun: Vec::new(),
        }
    }

    /// Writes the rest, and returns the inner writer.
    pub(crate) fn finish(mut self) -> io::Result<W> {
        let rest = String::from_utf8_lossy(&std::mem::take(&mut self.begun)).into_owned();
        self.pass(&rest)?;
        self.out.flush()?;
        Ok(self.out)
    }

    fn pass(&mut self, text: &str) -> io::Result<()> {
        let is_stopped = |letter: char| is_obeyed(letter) && !matches!(letter, '\n' | '\t');
        if !text.contains(is_stopped) {
            return self.out.write_all(text.as_bytes());
        }
        let written = match self.form {
            Form::Words | Form::Table => shown_lines(text),
            Form::Json => escaped(text),
        };
        self.out.write_all(written.as_bytes())
    }
}

impl<W: Write> Write for Guard<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let mut whole = std::mem::take(&mut self.begun);
        whole.extend_from_slice(bytes);
        let end = whole_letters(&whole);
        self.begun = whole.split_off(end);
        let text = String::from_utf8_lossy(&whole);
        self.pass(&text)?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

/// Number of bytes that form complete characters. At most three further bytes belong to an incomplete character.
fn whole_letters(bytes: &[u8]) -> usize {
    match std::str::from_utf8(bytes) {
        Err(error) if error.error_len().is_none() => error.valid_up_to(),
        _ => bytes.len(),
    }
}

/// JSON with escaped control characters. Line breaks are unchanged, because they occur only outside strings.
fn escaped(json: &str) -> String {
    let mut written = String::with_capacity(json.len() + 16);
    for letter in json.chars() {
        match is_obeyed(letter) && !matches!(letter, '\n' | '\t') {
            false => written.push(letter),
            true => {
                for unit in letter.encode_utf16(&mut [0; 2]) {
                    written.push_str(&format!("\\u{unit:04x}"));
                }
            }
        }
    }
    written
}

#[cfg(test)]
mod tests {
    use super::*;

    const HOSTILE: &str = "a\u{1b}[2J\u{9b}\u{202e}\u{2066}\u{e0041}\u{200b}é\n\tb";

    fn through(form: Form, text: &str, step: usize) -> String {
        let mut guard = Guard::new(Vec::new(), form);
        for piece in text.as_bytes().chunks(step) {
            guard.write_all(piece).expect("a buffer takes it");
        }
        let bytes = guard.finish().expect("a buffer takes it");
        String::from_utf8(bytes).expect("text")
    }

    #[test]
    fn words_are_written_out_however_they_come() {
        for step in 1..9 {
            let written = through(Form::Words, HOSTILE, step);
            assert_eq!(
                written,
                "a\\u{1b}[2J\\u{9b}\\u{202e}\\u{2066}\\u{e0041}\\u{200b}é\n\tb"
            );
        }
    }

    #[test]
    fn json_means_what_it_meant() {
        let json = serde_json::to_string(HOSTILE).expect("text");
        let written = through(Form::Json, &json, 5);
        assert!(!written.contains(is_obeyed), "{written}");
        let read: String = serde_json::from_str(&written).expect("still JSON");
        assert_eq!(read, HOSTILE);
    }
}
