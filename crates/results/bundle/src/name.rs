//! Rules for the names and the number of the files in a bundle.

use std::collections::BTreeMap;

use taceva_core::counted;

use crate::error::{BundleError, Damage};
use crate::layout::{MOST_FILES, MOST_NAME, MOST_PARTS};

/// Rule of names.
pub(crate) const RULE: &str = "names lead to files inside the bundle";

/// The fault of a name in a bundle; `None` for a valid relative path.
pub(crate) fn fault(name: &str) -> Option<String> {
    if name.len() > MOST_NAME {
        return Some(format!(
            "a name of {} bytes, expected at most {MOST_NAME}",
            name.len()
        ));
    }
    let is_plain = |letter: char| letter.is_ascii_graphic() && !"\\:*?\"<>|".contains(letter);
    if let Some(letter) = name.chars().find(|letter| !is_plain(*letter)) {
        return Some(format!(
            "the character U+{:04X}, which not every system keeps in a name; expected ASCII without spaces and `\\:*?\"<>|`",
            u32::from(letter)
        ));
    }
    let parts: Vec<&str> = name.split('/').collect();
    if parts.iter().any(|part| ["", ".", ".."].contains(part)) {
        return Some(
            "a path that leads out of the bundle, expected a path inside the bundle, without `..`"
                .to_owned(),
        );
    }
    // Windows drops a final dot, so that two names would become equal.
    if parts.iter().any(|part| part.ends_with('.')) {
        return Some(
            "a folder or file name that ends in a dot, expected another ending".to_owned(),
        );
    }
    (parts.len() > MOST_PARTS).then(|| {
        format!(
            "a path of {} parts, expected at most {MOST_PARTS}",
            parts.len()
        )
    })
}

/// Rejects too many files, or more than `most` bytes.
pub(crate) fn check_amount(files: usize, bytes: u64, most: u64) -> Result<(), BundleError> {
    let rule = "a bundle is not too large to read";
    let refused = |problem: String| Err(BundleError::Damaged(Damage::new(".", rule, problem)));
    if files > MOST_FILES {
        return refused(format!("more than {}", counted(MOST_FILES as u64, "file")));
    }
    if bytes > most {
        return refused(format!("more than {most} bytes; --most raises the limit"));
    }
    Ok(())
}

/// Rejects two names, of files or folders, that differ only in case, because some file systems cannot store both.
pub(crate) fn check_case<'a>(names: impl Iterator<Item = &'a String>) -> Result<(), BundleError> {
    let mut known: BTreeMap<String, &str> = BTreeMap::new();
    for name in names {
        let folders = name.match_indices('/').map(|(at, _)| at);
        for end in folders.chain([name.len()]) {
            let own = &name[..end];
            let other = known.insert(own.to_lowercase(), own);
            if let Some(other) = other.filter(|other| *other != own) {
                let problem = format!("differs from `{other}` in upper and lower case only");
                let rule = "names differ in more than upper and lower case";
                return Err(BundleError::Damaged(Damage::new(own, rule, problem)));
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_that_leads_out_of_the_bundle_or_is_read_in_two_ways_is_refused() {
        for name in [
            "../x",
            "a/../x",
            "/x",
            "a//x",
            "",
            ".",
            "a\\x",
            "c:x",
            "a\u{202e}x",
            "caf\u{e9}",
            "cafe\u{301}",
            "\u{fffd}",
            "a b",
            "a.",
        ] {
            assert!(fault(name).is_some(), "{name:?}");
        }
        assert!(fault(&"x".repeat(256)).is_some());
        assert!(fault(&["x"; 9].join("/")).is_some());
        for name in ["states/0.json", ".eval_results/taceva.yaml"] {
            assert_eq!(fault(name), None);
        }
    }
}
