//! Foreign text in messages: by the rule of [`taceva_core::shown`], and long texts and lists are cut.

use std::path::Path;

const SHOWN_CHARACTERS: usize = 80;

/// `text` with what a terminal would obey written out, cut after 80 characters.
pub fn shown(text: &str) -> String {
    match text.char_indices().nth(SHOWN_CHARACTERS) {
        Some((end, _)) => format!("{}…", taceva_core::shown(&text[..end])),
        None => taceva_core::shown(text).to_string(),
    }
}

/// `path` with what a terminal would obey written out.
pub fn shown_path(path: &Path) -> String {
    taceva_core::shown(path).to_string()
}

/// The candidate most like `wrong`, if one is like it at all.
pub fn nearest<'a>(wrong: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let folded = wrong.to_lowercase();
    candidates
        .into_iter()
        .map(|candidate| {
            (
                strsim::jaro_winkler(&folded, &candidate.to_lowercase()),
                candidate,
            )
        })
        .filter(|(likeness, _)| *likeness > 0.75)
        .max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(a.1)))
        .map(|(_, candidate)| candidate)
}

/// Names that a message lists; the others are counted.
pub fn listed(names: &[String]) -> String {
    const LISTED: usize = 64;
    let shown: Vec<String> = names.iter().take(LISTED).map(|name| shown(name)).collect();
    match names.len().saturating_sub(LISTED) {
        0 => shown.join(", "),
        more => format!("{} and {more} more", shown.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn control_characters_are_written_out_and_long_text_is_cut() {
        assert_eq!(shown("a\u{1b}[31m\n"), "a\\u{1b}[31m\\n");
        assert_eq!(shown(&"x".repeat(100)).chars().count(), 81);
    }

    #[test]
    fn the_nearest_name_is_found_and_a_stranger_is_not() {
        let names = ["depth_step", "sample", "Fz_N"];
        assert_eq!(nearest("depht_step", names), Some("depth_step"));
        assert_eq!(nearest("fz_n", names), Some("Fz_N"));
        assert_eq!(nearest("quux", names), None);
    }
}
