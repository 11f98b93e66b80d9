//! Rust sources as text, for tests of source rules.

use std::fs;
use std::path::{Path, PathBuf};

/// Every Rust file below `folder`, in path order; empty if there is no such folder.
///
/// # Panics
/// If an entry of the folder cannot be read, which ends the test.
pub fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).into_iter().flatten() {
        let path = entry.expect("readable").path();
        if path.is_dir() {
            found.extend(rust_files(&path));
        } else if path.extension().is_some_and(|end| end == "rs") {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// Code without the unit tests at its end.
///
/// ```
/// let code = "pub struct A;\n\n#[cfg(test)]\nmod tests {\n    struct B;\n}\n";
/// assert_eq!(taceva_tests::source::without_tests(code), "pub struct A;\n\n");
/// ```
pub fn without_tests(code: &str) -> &str {
    let end = code.find("#[cfg(test)]\nmod ").unwrap_or(code.len());
    &code[..end]
}

/// Code with a space in place of each comment, string and character literal.
///
/// ```
/// let code = "let a = \"told\"; // deal";
/// assert_eq!(taceva_tests::source::without_text(code), "let a =  ;  ");
/// ```
pub fn without_text(code: &str) -> String {
    let mut left = String::new();
    let mut rest = code;
    while let Some(letter) = rest.chars().next() {
        let skipped = length_of_text(rest, left.chars().last());
        if skipped > 0 {
            left.push(' ');
            rest = &rest[skipped..];
        } else {
            left.push(letter);
            rest = &rest[letter.len_utf8()..];
        }
    }
    left
}

/// Length in bytes of the comment, string or character literal at the start of `code`. The character `before` precedes it.
fn length_of_text(code: &str, before: Option<char>) -> usize {
    if code.starts_with("//") {
        return code.find('\n').unwrap_or(code.len());
    }
    if code.starts_with("/*") {
        return code.find("*/").map_or(code.len(), |end| end + 2);
    }
    let is_in_word = before.is_some_and(|letter| letter.is_alphanumeric() || letter == '_');
    let hashes = code
        .strip_prefix('r')
        .map(|after| after.len() - after.trim_start_matches('#').len());
    if let Some(hashes) = hashes.filter(|_| !is_in_word)
        && code[1 + hashes..].starts_with('"')
    {
        let end = format!("\"{}", "#".repeat(hashes));
        let start = hashes + 2;
        return code[start..]
            .find(&end)
            .map_or(code.len(), |at| start + at + end.len());
    }
    match code.chars().next() {
        Some('"') => end_of_quote(code, '"').unwrap_or(code.len()),
        // A lifetime has no closing quotation mark so near.
        Some('\'') => end_of_quote(code, '\'')
            .filter(|end| code[..*end].chars().count() == 3 || code.starts_with("'\\"))
            .unwrap_or(0),
        _ => 0,
    }
}

/// Byte position after the string or character literal at the start of `code`, which the quote `mark` encloses; `None` if it has no end.
fn end_of_quote(code: &str, mark: char) -> Option<usize> {
    let mut is_escaped = false;
    for (at, letter) in code.char_indices().skip(1) {
        match letter {
            _ if is_escaped => is_escaped = false,
            '\\' => is_escaped = true,
            _ if letter == mark => return Some(at + letter.len_utf8()),
            _ => {}
        }
    }
    None
}
