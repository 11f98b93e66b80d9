//! Collects times of a join by time: spans, time differences, and signs of a wrong lag, unit, order or tolerance.

use super::candidates::Candidates;
use crate::import::map::Pick;
use crate::import::warning::ImportWarning;

/// Minimum number of rows for a warning about a join.
const LEAST: u64 = 10;
/// A time difference above `FAR` times the usual step and above `FAR_S`, s, is a match across a pause.
const FAR: f64 = 3.0;
const FAR_S: f64 = 0.05;
/// Maximum absolute lag that a delay of the pictures can explain, s.
const DELAY_S: f64 = 0.1;
/// Maximum difference of times that count as equal, s. In a regular clock, `REGULAR` is this difference as a fraction of the step.
const EQUAL_S: f64 = 1e-6;
const REGULAR: f64 = 0.01;
/// Maximum relative difference between a ratio of times and the factor of a unit.
const FACTOR: f64 = 0.01;
/// Inverse of the maximum fraction of rows out of order. A larger fraction means a table in another order.
const SWAPPED: u64 = 10;

/// Row of a main table with its time.
#[derive(Clone, Copy, Debug)]
pub(super) struct TimedRow {
    pub(super) row: usize,
    pub(super) time_s: f64,
    pub(super) lag_s: f64,
    pub(super) pick: Pick,
    /// Time difference of the match, s; `None` without a match.
    pub(super) gap_s: Option<f64>,
}

/// First and last time, s.
#[derive(Clone, Copy, Debug)]
struct Span {
    first_s: f64,
    last_s: f64,
}

/// Times of all rows that a join compares, with the differences to the matched rows.
#[derive(Clone, Debug, Default)]
pub(super) struct Timing {
    rows: u64,
    /// First and last time of the rows of the main tables, s, on the clock of the joined table.
    own: Option<Span>,
    joined: Option<Span>,
    /// Maximum time difference of a match, s.
    pub(super) greatest_gap_s: Option<f64>,
    /// Number of rows with a match across a pause of the joined table.
    far: u64,
    /// Longest usual step among the joined tables of the rows counted in `far`, s.
    usual_s: f64,
    lagged: Lagged,
    /// The last two rows added.
    recent: [Option<TimedRow>; 2],
    /// Number of rows that are earlier than the previous row, while the next row is later than both.
    swapped: u64,
    first_swapped: Option<usize>,
}

/// Rows whose lag is too long for a delay of pictures. Counts of these rows that find an equal joined time without the lag, with it, or after another
/// shift.
#[derive(Clone, Debug, Default)]
struct Lagged {
    rows: u64,
    without_lag: u64,
    with_lag: u64,
    /// Number of rows with an equal time in the joined table after a shift by whole steps, and therefore by chance.
    by_chance: u64,
}

impl Span {
    fn union(one: Option<Span>, other: Option<Span>) -> Option<Span> {
        let spans = [one, other].into_iter().flatten();
        spans.reduce(|one, other| Span {
            first_s: one.first_s.min(other.first_s),
            last_s: one.last_s.max(other.last_s),
        })
    }
}

impl Timing {
    /// Adds a row of the main table that was matched among `candidates`.
    pub(super) fn add(&mut self, row: TimedRow, candidates: &Candidates) {
        self.rows += 1;
        let shown_s = row.time_s + row.lag_s;
        let own = Span {
            first_s: shown_s,
            last_s: shown_s,
        };
        self.own = Span::union(self.own, Some(own));
        let ends = candidates.by_time.first().zip(candidates.by_time.last());
        let joined = ends.map(|(first, last)| Span {
            first_s: first.0,
            last_s: last.0,
        });
        self.joined = Span::union(self.joined, joined);
        let gaps = [self.greatest_gap_s, row.gap_s];
        self.greatest_gap_s = gaps.into_iter().flatten().reduce(f64::max);
        if let Some(usual_s) = candidates.usual_s {
            // A row that is held until the next one is valid at any distance.
            let is_far = |gap_s: f64| gap_s > (FAR * usual_s).max(FAR_S);
            if row.pick != Pick::Before && row.gap_s.is_some_and(is_far) {
                self.far += 1;
                self.usual_s = self.usual_s.max(usual_s);
            }
            self.lagged.add(&row, candidates, usual_s);
        }
        if let [Some(before), Some(last)] = &self.recent
            && last.time_s < before.time_s
            && row.time_s > before.time_s
        {
            self.swapped += 1;
            self.first_swapped = self.first_swapped.or(Some(last.row));
        }
        self.recent = [self.recent[1], Some(row)];
    }

    /// Adds the times of another main table.
    pub(super) fn add_table(&mut self, other: Timing) {
        self.rows += other.rows;
        self.own = Span::union(self.own, other.own);
        self.joined = Span::union(self.joined, other.joined);
        let gaps = [self.greatest_gap_s, other.greatest_gap_s];
        self.greatest_gap_s = gaps.into_iter().flatten().reduce(f64::max);
        self.far += other.far;
        self.usual_s = self.usual_s.max(other.usual_s);
        self.lagged.rows += other.lagged.rows;
        self.lagged.without_lag += other.lagged.without_lag;
        self.lagged.with_lag += other.lagged.with_lag;
        self.lagged.by_chance += other.lagged.by_chance;
    }

    /// First row whose time is out of order, and the number of such rows; `None` if no rows or too many rows are out of order.
    pub(super) fn swapped(&self) -> Option<(usize, u64)> {
        let first = self.first_swapped?;
        (self.swapped * SWAPPED <= self.rows).then_some((first, self.swapped))
    }

    /// Time spans of the main tables and of the joined table `join` in words, with a hint if their units seem to differ.
    pub(super) fn spans(&self, join: &str) -> Option<String> {
        let (own, joined) = self.own.zip(self.joined)?;
        let is_near = |ratio: f64| (ratio - 1.0).abs() < FACTOR;
        let ratio = own.last_s / joined.last_s;
        let factors = [1e3, 1e6, 1e9];
        let larger = factors.iter().find(|factor| is_near(ratio / *factor));
        let smaller = factors.iter().find(|factor| is_near(ratio * *factor));
        let unit = match (larger, smaller) {
            (Some(factor), _) => {
                format!("; times of rows are {factor} times those of the join: correct a `unit`")
            }
            (None, Some(factor)) => {
                format!("; times of the join are {factor} times those of rows: correct a `unit`")
            }
            (None, None) => String::new(),
        };
        Some(format!(
            "times of the rows plus `lag_ms` are {:.3} to {:.3} s, times of `{join}` are {:.3} to {:.3} s{unit}",
            own.first_s, own.last_s, joined.first_s, joined.last_s
        ))
    }

    /// Warnings about the lag, the tolerance and the matches of `join`; `matched` is the number of rows with a match. Few matches cause a warning
    /// only if `most_unused`, that is, if most joined rows are unused. Single presses match few rows of a stream.
    pub(super) fn warnings(
        &self,
        join: &str,
        matched: u64,
        most_unused: bool,
    ) -> Vec<ImportWarning> {
        let mut warnings = Vec::new();
        let join_name = || join.to_owned();
        if self.far > 0 {
            let most_ms = 1e3 * (FAR * self.usual_s).max(FAR_S);
            warnings.push(ImportWarning::JoinPause {
                join: join_name(),
                rows: self.far,
                farthest_ms: format!("{:.0}", 1e3 * self.greatest_gap_s.unwrap_or_default()),
                usual_ms: format!("{:.1}", 1e3 * self.usual_s),
                tolerance_ms: format!("{most_ms:.0}"),
            });
        }
        if self.lagged.is_of_one_clock() {
            warnings.push(ImportWarning::JoinLag {
                join: join_name(),
                rows: self.lagged.rows,
                equal: self.lagged.without_lag,
            });
        }
        if self.rows >= LEAST && 2 * matched < self.rows && most_unused {
            warnings.extend(self.spans(join).map(|spans| ImportWarning::JoinFew {
                join: join_name(),
                rows: self.rows,
                matched,
                spans,
            }));
        }
        warnings
    }
}

impl Lagged {
    fn add(&mut self, row: &TimedRow, candidates: &Candidates, usual_s: f64) {
        if row.lag_s.abs() <= DELAY_S {
            return;
        }
        let has = |time_s: f64, within_s: f64| {
            let times = &candidates.by_time;
            let at = times.partition_point(|(time, _)| *time < time_s - within_s);
            times
                .get(at)
                .is_some_and(|(time, _)| *time <= time_s + within_s)
        };
        let near_s = (REGULAR * usual_s).max(5.0 * EQUAL_S);
        let mut steps = [-2.0, -1.0, 1.0, 2.0].into_iter();
        self.rows += 1;
        self.without_lag += u64::from(has(row.time_s, EQUAL_S));
        self.with_lag += u64::from(has(row.time_s + row.lag_s, EQUAL_S));
        self.by_chance += u64::from(steps.any(|step| has(row.time_s + step * usual_s, near_s)));
    }

    /// True if the lag is probably wrong. Nearly all rows find an equal joined time without it; at most half find one with it, or after a shift by
    /// whole steps.
    fn is_of_one_clock(&self) -> bool {
        self.rows >= LEAST
            && 10 * self.without_lag >= 9 * self.rows
            && 2 * self.with_lag <= self.rows
            && 2 * self.by_chance <= self.rows
    }
}
