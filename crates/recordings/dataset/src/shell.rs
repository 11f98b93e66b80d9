//! Quoting for a shell.

/// `text` as one shell word, quoted if necessary.
///
/// ```
/// use taceva_dataset::internal::shell_word;
///
/// assert_eq!(shell_word("which.sweep"), "which.sweep");
/// assert_eq!(shell_word("it's; rm x"), r"'it'\''s; rm x'");
/// ```
pub fn shell_word(text: &str) -> String {
    let is_plain = |letter: char| letter.is_alphanumeric() || "/:.,_-+@%".contains(letter);
    if !text.is_empty() && text.chars().all(is_plain) {
        text.to_owned()
    } else {
        format!("'{}'", text.replace('\'', r"'\''"))
    }
}
