//! Natural order of file names: `frame2` before `frame10`.

use std::cmp::Ordering;

/// Compares names part by part: digits as numbers, other text byte by byte. Ties are compared by bytes.
pub(crate) fn compare(first: &str, second: &str) -> Ordering {
    let (mut left, mut right) = (first, second);
    while !left.is_empty() && !right.is_empty() {
        let (left_part, left_rest) = split(left);
        let (right_part, right_rest) = split(right);
        let order = match (number(left_part), number(right_part)) {
            (Some(left), Some(right)) => left.len().cmp(&right.len()).then_with(|| left.cmp(right)),
            _ => left_part.cmp(right_part),
        };
        if order.is_ne() {
            return order;
        }
        (left, right) = (left_rest, right_rest);
    }
    left.len().cmp(&right.len()).then_with(|| first.cmp(second))
}

/// Splits `text` after its leading run, which contains either only digits or no digit.
fn split(text: &str) -> (&str, &str) {
    let digits = text.starts_with(|letter: char| letter.is_ascii_digit());
    let end = text
        .find(|letter: char| letter.is_ascii_digit() != digits)
        .unwrap_or(text.len());
    text.split_at(end)
}

/// Digits of `part` without leading zeros; `None` if `part` starts with another character. A longer result is a larger number.
fn number(part: &str) -> Option<&str> {
    part.starts_with(|letter: char| letter.is_ascii_digit())
        .then(|| part.trim_start_matches('0'))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_in_names_count_as_numbers_however_long() {
        let mut names = [
            "b1.png",
            "a10.png",
            "a2.png",
            "a002.png",
            "a",
            "a1-10",
            "a1-9",
            "a99999999999999999999999",
            "a100000000000000000000000",
        ];
        names.sort_by(|first, second| compare(first, second));
        assert_eq!(
            names,
            [
                "a",
                "a1-9",
                "a1-10",
                "a002.png",
                "a2.png",
                "a10.png",
                "a99999999999999999999999",
                "a100000000000000000000000",
                "b1.png",
            ]
        );
    }

    #[test]
    fn the_order_is_total() {
        let names = ["", "0", "00", "a0", "a", "0a", "a01b2", "a1b02", "a1b2"];
        for first in names {
            for second in names {
                assert_eq!(compare(first, second), compare(second, first).reverse());
                assert_eq!(compare(first, second).is_eq(), first == second);
            }
        }
    }
}
