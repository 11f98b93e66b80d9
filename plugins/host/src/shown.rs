//! Foreign text in messages: escaped as [`taceva_core::shown`] does, and cut to a greatest length.

const CHARACTERS_MAX: usize = 200;

/// `text` with what a terminal would obey written out, cut after 200 characters.
pub(crate) fn shown(text: &str) -> String {
    match text.char_indices().nth(CHARACTERS_MAX) {
        Some((end, _)) => format!("{}…", taceva_core::shown(&text[..end])),
        None => taceva_core::shown(text).to_string(),
    }
}

/// The candidate most like `wrong`, if one is like it at all.
pub(crate) fn nearest<'a>(
    wrong: &str,
    candidates: impl IntoIterator<Item = &'a str>,
) -> Option<&'a str> {
    let folded = wrong.to_lowercase();
    let likeness = |candidate: &str| strsim::jaro_winkler(&folded, &candidate.to_lowercase());
    candidates
        .into_iter()
        .map(|candidate| (likeness(candidate), candidate))
        .filter(|(likeness, _)| *likeness > 0.75)
        .max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(a.1)))
        .map(|(_, candidate)| candidate)
}

/// `, did you mean …?`, or what would be accepted.
pub(crate) fn suggestion(wrong: &str, accepted: &[&str]) -> String {
    match nearest(wrong, accepted.iter().copied()) {
        Some(nearest) => format!("did you mean `{nearest}`?"),
        None => format!("expected one of `{}`", accepted.join("`, `")),
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

    #[test]
    fn a_typing_mistake_finds_its_word_and_a_stranger_all_of_them() {
        let words = ["linux-x86_64", "macos-aarch64"];
        assert_eq!(
            suggestion("linux-x64", &words),
            "did you mean `linux-x86_64`?"
        );
        assert_eq!(
            suggestion("beos", &words),
            "expected one of `linux-x86_64`, `macos-aarch64`"
        );
    }
}
