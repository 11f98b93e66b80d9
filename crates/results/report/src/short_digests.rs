//! Shortens digests for display.

/// Returns `text` with each digest shortened from 64 to 12 digits.
#[must_use]
pub fn short_digests(text: &str) -> String {
    const DIGITS: usize = 64;
    const SHOWN: usize = 12;
    let mut short = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find(|digit: char| digit.is_ascii_hexdigit()) {
        let (before, from) = rest.split_at(at);
        let end = from.find(|digit: char| !digit.is_ascii_hexdigit());
        let (digits, after) = from.split_at(end.unwrap_or(from.len()));
        short.push_str(before);
        match digits.len() {
            DIGITS => short.extend([&digits[..SHOWN], "…"]),
            _ => short.push_str(digits),
        }
        rest = after;
    }
    short.push_str(rest);
    short
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digests_are_shown_by_their_first_digits_and_other_words_whole() {
        let digest = "0f".repeat(32);
        let text = format!(
            "bench 2, parameters {digest}, seed 7, faded Ünter {}",
            &digest[1..]
        );
        let expected = format!(
            "bench 2, parameters 0f0f0f0f0f0f…, seed 7, faded Ünter {}",
            &digest[1..]
        );
        assert_eq!(short_digests(&text), expected);
    }
}
