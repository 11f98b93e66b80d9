//! Patterns for folders: `units/*`, `week-?/unit-*`.

use std::fs;
use std::path::{Path, PathBuf};

/// True if `text` contains a wildcard of a pattern.
pub(crate) fn is_pattern(text: &str) -> bool {
    text.contains(['*', '?'])
}

/// Folders below `base` that match `pattern`, sorted by name, as paths relative to `base`.
///
/// `*` matches any characters except `/`, `?` matches one character. Only a pattern that begins with a dot matches names with a leading dot.
pub(crate) fn folders(base: &Path, pattern: &str) -> std::io::Result<Vec<String>> {
    let (root, rest) = match pattern.strip_prefix('/') {
        Some(rest) => (PathBuf::from("/"), rest),
        None => (base.to_owned(), pattern),
    };
    let start = if pattern.starts_with('/') { "/" } else { "" };
    let mut found = vec![(root, start.to_owned())];
    for part in rest.split('/').filter(|part| !part.is_empty()) {
        let mut next = Vec::new();
        for (folder, name) in found {
            if !is_pattern(part) {
                let deeper = folder.join(part);
                if deeper.is_dir() {
                    next.push((deeper, joined(&name, part)));
                }
                continue;
            }
            for entry in fs::read_dir(&folder)? {
                let entry = entry?;
                let own = entry.file_name();
                let Some(own) = own.to_str() else { continue };
                let is_hidden = own.starts_with('.') && !part.starts_with('.');
                if !is_hidden && matches(part, own) && entry.path().is_dir() {
                    next.push((entry.path(), joined(&name, own)));
                }
            }
        }
        found = next;
    }
    let mut names: Vec<String> = found.into_iter().map(|(_, name)| name).collect();
    names.sort();
    Ok(names)
}

fn joined(before: &str, name: &str) -> String {
    match before {
        "" | "/" => format!("{before}{name}"),
        _ => format!("{before}/{name}"),
    }
}

/// True if `name` matches `pattern`.
fn matches(pattern: &str, name: &str) -> bool {
    let pattern: Vec<char> = pattern.chars().collect();
    let name: Vec<char> = name.chars().collect();
    // Position of the last `*`, and the number of characters that it has matched.
    let (mut at, mut of, mut star) = (0, 0, None);
    while of < name.len() {
        match pattern.get(at) {
            Some('*') => {
                star = Some((at, of));
                at += 1;
            }
            Some(letter) if *letter == '?' || *letter == name[of] => {
                at += 1;
                of += 1;
            }
            _ => {
                let Some((place, taken)) = star else {
                    return false;
                };
                star = Some((place, taken + 1));
                at = place + 1;
                of = taken + 1;
            }
        }
    }
    pattern[at..].iter().all(|letter| *letter == '*')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_star_stands_for_any_letters_and_a_question_mark_for_one() {
        for (pattern, name, expected) in [
            ("*", "unit", true),
            ("unit-*", "unit-7", true),
            ("unit-?", "unit-17", false),
            ("*-7", "unit-7-7", true),
            ("a*b*c", "aXbYbZc", true),
            ("a*b", "a", false),
            ("unit", "units", false),
        ] {
            assert_eq!(matches(pattern, name), expected, "{pattern} {name}");
        }
    }

    #[test]
    fn folders_come_in_the_order_of_their_names_and_files_are_none() {
        let base = tempfile::tempdir().expect("a folder");
        for name in ["units/b", "units/a", "units/.hidden"] {
            fs::create_dir_all(base.path().join(name)).expect("made");
        }
        fs::write(base.path().join("units/c"), "a file").expect("written");
        let found = folders(base.path(), "units/*").expect("readable");
        assert_eq!(found, ["units/a", "units/b"]);
        assert!(
            folders(base.path(), "none/x*")
                .expect("no folder")
                .is_empty()
        );
    }
}
