//! Counts with their nouns, in the singular or plural.

use std::fmt;

/// Text of `count` and `noun`, such as `3 entries`. The noun is in the plural unless the count is 1.
///
/// ```
/// use taceva_core::counted;
/// assert_eq!(counted(1_u64, "contact point"), "1 contact point");
/// assert_eq!(counted(0_usize, "press"), "0 presses");
/// assert_eq!(counted(3_u32, "entry"), "3 entries");
/// ```
pub fn counted<N>(count: N, noun: &str) -> String
where
    N: fmt::Display + PartialEq + From<u8>,
{
    if count == N::from(1_u8) {
        return format!("{count} {noun}");
    }
    let consonant = |stem: &&str| !stem.ends_with(['a', 'e', 'i', 'o', 'u']);
    match noun.strip_suffix('y').filter(consonant) {
        Some(stem) => format!("{count} {stem}ies"),
        None if noun.ends_with(['s', 'x']) || noun.ends_with("ch") => format!("{count} {noun}es"),
        None => format!("{count} {noun}s"),
    }
}

/// Returns `one` if `count` is 1, otherwise `many`.
///
/// ```
/// use taceva_core::{by_count, counted};
/// let said = |rows: u64| format!("{} {} left out", counted(rows, "row"), by_count(rows, "is", "are"));
/// assert_eq!(said(1), "1 row is left out");
/// assert_eq!(said(2), "2 rows are left out");
/// ```
pub fn by_count<N, T>(count: N, one: T, many: T) -> T
where
    N: PartialEq + From<u8>,
{
    if count == N::from(1_u8) { one } else { many }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_thing_has_no_plural_and_every_other_number_has_one() {
        for (one, many) in [
            ("sample", "samples"),
            ("press", "presses"),
            ("entry", "entries"),
            ("day", "days"),
            ("batch", "batches"),
            ("box", "boxes"),
        ] {
            assert_eq!(counted(1_usize, one), format!("1 {one}"));
            for count in [0_u64, 2, 11, 21, 1001] {
                assert_eq!(counted(count, one), format!("{count} {many}"));
            }
        }
    }
}
