//! Messages and errors on standard error, with control characters escaped.

use std::fmt::Arguments;
use std::io::Write as _;

use taceva_core::shown_lines;

/// Writes a line that begins with the name of the program.
pub(crate) fn say(words: Arguments<'_>) {
    write(&format!("taceva: {words}\n"));
}

/// Writes text of several lines. Ignores a closed standard error, because no other output exists for the message.
pub(crate) fn write(text: &str) {
    let _ = std::io::stderr().write_all(shown_lines(text).as_bytes());
}
