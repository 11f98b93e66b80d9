//! Seeds in a sweep file: a list, or a range.

use crate::limits::MOST_TASKS;

/// Greatest seed. Tables store signed 64-bit numbers.
const GREATEST: u64 = i64::MAX.unsigned_abs();
const EXPECTED: &str = "expected a list such as [1, 2, 3], or a range such as \"1-5\"";

/// Parses seeds; the error is a message.
pub(crate) fn seeds(written: &toml::Value) -> Result<Vec<u64>, String> {
    match written {
        toml::Value::Array(list) => list.iter().map(one).collect(),
        toml::Value::String(text) => range(text),
        toml::Value::Integer(seed) if *seed >= 0 => Err(format!(
            "`seeds = {seed}`: {EXPECTED}; for one seed write [{seed}]"
        )),
        _ => Err(format!("`seeds`: {EXPECTED}")),
    }
}

fn one(written: &toml::Value) -> Result<u64, String> {
    let seed = written.as_integer();
    seed.and_then(|seed| u64::try_from(seed).ok())
        .ok_or_else(|| format!("`seeds`: {written}: expected whole numbers from 0 to {GREATEST}"))
}

fn range(text: &str) -> Result<Vec<u64>, String> {
    let ends = text.split_once('-');
    let ends = ends.and_then(|(first, last)| {
        let (first, last): (u64, u64) = (first.trim().parse().ok()?, last.trim().parse().ok()?);
        (first <= last).then_some((first, last))
    });
    let (first, last) = ends.ok_or_else(|| format!("`seeds = \"{text}\"`: {EXPECTED}"))?;
    if last > GREATEST {
        return Err(format!(
            "`seeds = \"{text}\"`: expected whole numbers from 0 to {GREATEST}"
        ));
    }
    // Counted first, so that too many seeds are rejected before they are allocated.
    match last - first {
        span if span < MOST_TASKS => Ok((first..=last).collect()),
        span => Err(format!(
            "the seeds alone make {} tasks for each model, expected at most {MOST_TASKS}",
            span + 1
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str) -> Result<Vec<u64>, String> {
        let table: toml::Table = format!("seeds = {text}").parse().expect(text);
        seeds(&table["seeds"])
    }

    #[test]
    fn a_list_and_a_range_are_seeds() {
        assert_eq!(of("[3, 1]"), Ok(vec![3, 1]));
        assert_eq!(of("\"2-4\""), Ok(vec![2, 3, 4]));
        assert_eq!(of("[9223372036854775807]"), Ok(vec![GREATEST]));
    }

    #[test]
    fn what_is_neither_is_refused_with_what_would_be() {
        for (text, message) in [
            ("3", "for one seed write [3]"),
            ("-3", "expected a list"),
            ("[-1]", "expected whole numbers from 0"),
            ("[1.5]", "expected whole numbers from 0"),
            ("\"5-1\"", "expected a list"),
            (
                "\"9223372036854775808-9223372036854775809\"",
                "to 9223372036854775807",
            ),
            ("\"0-18446744073709551615\"", "to 9223372036854775807"),
            ("true", "expected a list"),
        ] {
            let error = of(text).expect_err(text);
            assert!(error.contains(message), "{text}: {error}");
        }
    }
}
