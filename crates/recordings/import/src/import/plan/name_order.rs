//! Detects files whose order by name differs from the order by the numbers in their names.

use std::cmp::Ordering;
use std::path::{Path, PathBuf};

/// First two neighbours in `files`, sorted by name, whose numbers are in the opposite order: 10 before 2.
pub(super) fn counted_otherwise(files: &[PathBuf]) -> Option<[&Path; 2]> {
    let mut pairs = files.windows(2);
    let pair = pairs.find(|pair| by_numbers(&pair[0], &pair[1]).is_gt())?;
    Some([&pair[0], &pair[1]])
}

/// Compares two names letter by letter. Digits at the same place are compared as numbers.
fn by_numbers(one: &Path, other: &Path) -> Ordering {
    let [one, other] = [one, other].map(|path| path.to_string_lossy());
    let (mut one, mut other) = (&*one, &*other);
    loop {
        let [own, others] = [one, other].map(|text| {
            let end = text.find(|letter: char| !letter.is_ascii_digit());
            text.split_at(end.unwrap_or(text.len()))
        });
        let order = match (own.0, others.0) {
            ("", _) | (_, "") => {
                let [mut own, mut others] = [one.chars(), other.chars()];
                let letters = (own.next(), others.next());
                (one, other) = (own.as_str(), others.as_str());
                if letters == (None, None) {
                    return Ordering::Equal;
                }
                letters.0.cmp(&letters.1)
            }
            (digits, other_digits) => {
                (one, other) = (own.1, others.1);
                let [digits, other_digits] =
                    [digits, other_digits].map(|digits| digits.trim_start_matches('0'));
                let longer = digits.len().cmp(&other_digits.len());
                longer.then_with(|| digits.cmp(other_digits))
            }
        };
        if order.is_ne() {
            return order;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_counted_otherwise_only_where_numbers_stand_in_another_order() {
        let of = |names: &[&str]| {
            let files: Vec<PathBuf> = names.iter().map(PathBuf::from).collect();
            counted_otherwise(&files).is_some()
        };
        assert!(of(&["f_1.npy", "f_10.npy", "f_2.npy"]));
        assert!(of(&["a/r10/f.npy", "a/r9/f.npy"]));
        for sound in [
            &["f_01.npy", "f_02.npy", "f_10.npy"][..],
            &["f.npy", "f1.npy", "fb.npy"],
            &["f_1.npy", "f_1b.npy", "f_2.npy"],
            &["run2_a1.npy", "run2_a2.npy", "run3_a1.npy"],
            &["f01.npy", "f1.npy"],
            &["é1.npy", "é2.npy"],
        ] {
            assert!(!of(sound), "{sound:?}");
        }
    }
}
