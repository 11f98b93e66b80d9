//! What is no result: lines on standard error, in which no letter of a foreign name is obeyed.

use std::fmt::Arguments;
use std::io::Write as _;

use taceva_core::shown_lines;

/// Writes a line, begun with the name of the program.
pub(crate) fn say(words: Arguments<'_>) {
    write(&format!("taceva: {words}\n"));
}

/// Writes text as it is laid out. Nobody is left to be told if standard error is gone.
pub(crate) fn write(text: &str) {
    let _ = std::io::stderr().write_all(shown_lines(text).as_bytes());
}
