//! Records the rows that a state file has counted, so that no row is counted twice.

use std::ops::Range;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use taceva_core::{by_count, counted};

/// Counted rows of one input.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Taken {
    /// Digest of the recording, or of both tables.
    input: String,
    /// Ranges of row numbers, counted from 0, end exclusive, ascending.
    rows: Vec<[usize; 2]>,
    /// Number of rows of the input, if the counted rows are a shard.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    of: Option<usize>,
}

impl Taken {
    /// Records the given rows of an input.
    pub(crate) fn rows_of(input: String, rows: &[usize]) -> Taken {
        let mut sorted = rows.to_vec();
        sorted.sort_unstable();
        let mut ranges: Vec<[usize; 2]> = Vec::new();
        for row in sorted {
            match ranges.last_mut() {
                Some([_, end]) if *end >= row => *end = row + 1,
                _ => ranges.push([row, row + 1]),
            }
        }
        Taken {
            input,
            rows: ranges,
            of: None,
        }
    }

    /// Records all rows of an input.
    pub(crate) fn all_of(input: String, rows: usize) -> Taken {
        Taken {
            input,
            rows: vec![[0, rows]],
            of: None,
        }
    }

    /// Records `rows` as a shard, which may be empty, of an input with `of` rows in total.
    pub(crate) fn part_of(input: String, rows: Range<usize>, of: usize) -> Taken {
        let ranges = match rows.is_empty() {
            true => Vec::new(),
            false => vec![[rows.start, rows.end]],
        };
        Taken {
            input,
            rows: ranges,
            of: Some(of),
        }
        .whole_or_not()
    }

    /// True if the counted rows are a shard.
    pub(crate) fn is_of_shard(&self) -> bool {
        self.of.is_some()
    }

    /// Number of counted rows, and number of rows of the input; `None` unless the counted rows are a shard.
    pub(crate) fn share(&self) -> Option<[usize; 2]> {
        // A forged state may end a range before its beginning.
        let counts = self
            .rows
            .iter()
            .map(|[begin, end]| end.saturating_sub(*begin));
        let own = counts.fold(0, usize::saturating_add);
        Some([own, self.of?])
    }

    /// Removes the number of rows of the input if all of them are counted. The result is then not a shard.
    fn whole_or_not(mut self) -> Taken {
        if let ([[0, end]], Some(of)) = (self.rows.as_slice(), self.of)
            && *end == of
        {
            self.of = None;
        }
        self
    }

    /// Adds the rows of another shard of the same input.
    fn join(&mut self, other: &Taken) {
        let mut ranges = self.rows.clone();
        ranges.extend(&other.rows);
        ranges.sort_unstable();
        self.rows.clear();
        for [begin, end] in ranges {
            match self.rows.last_mut() {
                Some([_, last]) if *last == begin => *last = end,
                _ => self.rows.push([begin, end]),
            }
        }
    }

    /// First row that `self` and `other` have both counted, and the number of such rows; `None` without such a row.
    fn shared(&self, other: &Taken) -> Option<(usize, usize)> {
        if self.input != other.input {
            return None;
        }
        let (mut own, mut their) = (self.rows.iter().peekable(), other.rows.iter().peekable());
        let (mut first, mut count) = (None, 0_usize);
        while let (Some([begin, end]), Some([other_begin, other_end])) = (own.peek(), their.peek())
        {
            let (from, to) = ((*begin).max(*other_begin), (*end).min(*other_end));
            if from < to {
                first.get_or_insert(from);
                count = count.saturating_add(to - from);
            }
            match end < other_end {
                true => own.next(),
                false => their.next(),
            };
        }
        first.map(|first| (first, count))
    }
}

/// Rows that several state files have counted, each with the path of its file.
#[derive(Debug, Default)]
pub(crate) struct AllTaken {
    taken: Vec<(PathBuf, Taken)>,
    states: Vec<(PathBuf, String)>,
}

impl AllTaken {
    /// Adds the rows of the state file at `path` with the digest `digest`. Returns an error message if some rows were already counted.
    pub(crate) fn add(&mut self, path: &Path, digest: &str, taken: &[Taken]) -> Result<(), String> {
        // Shards without rows have equal states, and counting such a shard twice is harmless.
        let is_empty = !taken.is_empty() && taken.iter().all(|taken| taken.rows.is_empty());
        let known = self.states.iter().find(|(_, known)| known == digest);
        if let Some((before, _)) = known.filter(|_| !is_empty) {
            return Err(format!(
                "the same state as {}, so its rows would count twice; name each state once",
                before.display()
            ));
        }
        for new in taken {
            for (before, old) in &self.taken {
                if let Some((first, count)) = new.shared(old) {
                    return Err(format!(
                        "{} of {} {} already in {}, from row {first} on, so {} would count twice; name each state once",
                        counted(count, "row"),
                        old.input.split(' ').next().unwrap_or_default(),
                        by_count(count, "is", "are"),
                        before.display(),
                        by_count(count, "it", "they")
                    ));
                }
            }
        }
        self.states.push((path.to_owned(), digest.to_owned()));
        let new = taken.iter().map(|taken| (path.to_owned(), taken.clone()));
        self.taken.extend(new);
        Ok(())
    }

    /// True if all states belong to shards of one input.
    pub(crate) fn is_of_shards_of_one_input(&self) -> bool {
        let mut taken = self.taken.iter().map(|(_, taken)| taken);
        let first = taken.next();
        first.is_some_and(|first| {
            first.is_of_shard()
                && taken.all(|other| first.input == other.input && first.of == other.of)
        })
    }

    /// Counted rows. Inputs are in the order in which they were added, and shards of one input are merged.
    pub(crate) fn into_taken(self) -> Vec<Taken> {
        let mut all: Vec<Taken> = Vec::new();
        for (_, taken) in self.taken {
            let is_same = |known: &&mut Taken| {
                known.is_of_shard() && known.of == taken.of && known.input == taken.input
            };
            match all.iter_mut().find(is_same) {
                Some(known) => known.join(&taken),
                None => all.push(taken),
            }
        }
        all.into_iter().map(Taken::whole_or_not).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn taken(input: &str, rows: &[usize]) -> Taken {
        Taken::rows_of(input.to_owned(), rows)
    }

    #[test]
    fn rows_are_kept_as_ranges_in_order() {
        assert_eq!(
            taken("a", &[7, 1, 2, 0, 5, 5]).rows,
            [[0, 3], [5, 6], [7, 8]]
        );
    }

    #[test]
    fn forged_ranges_have_a_share_without_a_panic() {
        let forged = Taken {
            input: "x".to_owned(),
            rows: vec![[5, 2], [0, usize::MAX], [0, usize::MAX]],
            of: Some(9),
        };
        assert_eq!(forged.share(), Some([usize::MAX, 9]));
    }

    #[test]
    fn shared_rows_are_found_wherever_ranges_meet_and_never_between_inputs() {
        let one = taken("a", &[0, 1, 2, 8, 9]);
        assert_eq!(one.shared(&taken("a", &[2, 3, 9, 10])), Some((2, 2)));
        assert_eq!(one.shared(&taken("a", &[3, 4, 5, 6, 7, 10])), None);
        assert_eq!(one.shared(&taken("b", &[0])), None);
    }

    #[test]
    fn shards_join_to_the_whole_in_any_order_and_empty_ones_are_not_the_same_twice() {
        let part = |rows| Taken::part_of("x".to_owned(), rows, 5);
        let mut all = AllTaken::default();
        for (at, rows) in [3..5, 0..0, 0..0, 0..3].into_iter().enumerate() {
            let path = PathBuf::from(format!("{at}.state"));
            let digest = format!("{rows:?}");
            assert_eq!(all.add(&path, &digest, &[part(rows)]), Ok(()));
        }
        assert_eq!(all.into_taken(), [Taken::all_of("x".to_owned(), 5)]);
        let mut some = AllTaken::default();
        for rows in [3..4, 0..2] {
            let digest = format!("{rows:?}");
            assert_eq!(some.add(Path::new("a"), &digest, &[part(rows)]), Ok(()));
        }
        let taken = some.into_taken();
        assert_eq!(taken[0].share(), Some([3, 5]));
        assert_eq!(taken[0].rows, [[0, 2], [3, 4]]);
    }

    #[test]
    fn what_was_taken_is_refused_with_the_file_that_took_it() {
        let mut all = AllTaken::default();
        let path = Path::new;
        assert_eq!(
            all.add(path("a.state"), "1", &[taken("x", &[0, 1])]),
            Ok(())
        );
        assert_eq!(all.add(path("b.state"), "2", &[taken("x", &[2])]), Ok(()));
        let same = all.add(path("c.state"), "1", &[]).expect_err("the same");
        assert!(same.contains("the same state as a.state"), "{same}");
        let rows = all.add(path("c.state"), "3", &[taken("x", &[1, 2])]);
        let rows = rows.expect_err("rows again");
        assert!(
            rows.contains(
                "1 row of x is already in a.state, from row 1 on, so it would count twice"
            ),
            "{rows}"
        );
    }
}
