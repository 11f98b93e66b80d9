//! Shards: disjoint ranges of the rows of two tables.

use std::fmt;
use std::ops::Range;
use std::str::FromStr;

/// One of several shards of the rows of a table. Together, all shards contain each row once, in order.
///
/// ```
/// use taceva_evaluate::Shard;
///
/// let shards: Vec<_> = (1..=3).map(|number| Shard::new(number, 3).map(|shard| shard.rows(10))).collect::<Result<_, _>>()?;
/// assert_eq!(shards, [0..3, 3..6, 6..10]);
/// assert_eq!("2/3".parse(), Shard::new(2, 3));
/// assert!("4/3".parse::<Shard>().is_err());
/// # Ok::<(), taceva_evaluate::ShardError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    number: u32,
    of: u32,
}

/// Error for an invalid shard, with the expected form.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "`{}`: {problem}, expected K/N with K from 1 to N, such as 1/8",
    taceva_core::shown(written)
)]
pub struct ShardError {
    written: String,
    problem: &'static str,
}

impl Shard {
    /// The only shard, which contains all rows.
    pub const WHOLE: Shard = Shard { number: 1, of: 1 };

    /// Creates shard `number`, counted from 1, of `of` shards.
    ///
    /// # Errors
    /// [`ShardError`] if `of` is 0, or `number` is not in 1 to `of`.
    pub fn new(number: u32, of: u32) -> Result<Shard, ShardError> {
        let problem = match (number, of) {
            (_, 0) => "the number of shards is 0",
            (0, _) => "shard numbers begin at 1",
            (number, of) if number > of => "K is above N",
            _ => return Ok(Shard { number, of }),
        };
        Err(ShardError {
            written: format!("{number}/{of}"),
            problem,
        })
    }

    /// Number of the shard, from 1.
    pub fn number(self) -> u32 {
        self.number
    }

    /// Number of all shards.
    pub fn of(self) -> u32 {
        self.of
    }

    /// True if this is the only shard.
    pub fn is_whole(self) -> bool {
        self.of == 1
    }

    /// Range of the shard's rows in a table of `rows` rows. Empty for some shards if there are more shards than rows.
    pub fn rows(self, rows: u64) -> Range<u64> {
        let before = |number: u32| {
            let before = u128::from(rows) * u128::from(number) / u128::from(self.of);
            u64::try_from(before).unwrap_or(rows)
        };
        before(self.number - 1)..before(self.number)
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.of)
    }
}

impl FromStr for Shard {
    type Err = ShardError;

    fn from_str(text: &str) -> Result<Shard, ShardError> {
        let parts = text.split_once('/');
        let wrong = || ShardError {
            written: text.to_owned(),
            problem: "no shard",
        };
        let (number, of) = parts.ok_or_else(wrong)?;
        let number = number.trim().parse().map_err(|_| wrong())?;
        let of = of.trim().parse().map_err(|_| wrong())?;
        Shard::new(number, of)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_have_every_row_once_whatever_their_number_and_that_of_rows() {
        for rows in [0, 1, 2, 7, 100, u64::from(u32::MAX) * 5 + 3] {
            for of in [1, 2, 3, 7, 101] {
                let mut end = 0;
                for number in 1..=of {
                    let own = Shard::new(number, of).expect("a shard").rows(rows);
                    assert_eq!(own.start, end);
                    end = own.end;
                }
                assert_eq!(end, rows);
            }
        }
    }

    #[test]
    fn what_is_no_shard_is_refused_with_what_would_be() {
        for (text, problem) in [
            ("0/7", "shard numbers begin at 1"),
            ("8/7", "K is above N"),
            ("1/0", "the number of shards is 0"),
            ("7", "no shard"),
            ("-1/7", "no shard"),
            ("1/7/2", "no shard"),
            ("a/b", "no shard"),
            ("1/99999999999", "no shard"),
        ] {
            let error = text.parse::<Shard>().expect_err(text).to_string();
            assert!(error.contains(problem) && error.contains(text), "{error}");
        }
    }
}
