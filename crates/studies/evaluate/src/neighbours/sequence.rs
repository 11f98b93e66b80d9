//! Order of rows that defines which rows are neighbours.

use taceva_dataset::Dataset;

use super::{PAIRS_LEAST, resemblance};
use crate::note::SampleOrder;
use crate::recordings;

/// Resemblance below which samples count as independent.
const APART: f64 = 0.2;
/// Divisor of the number of samples that gives the largest tried lag.
const FARTHEST: usize = 10;

/// Rows ordered by time, or in table order if times are missing. Rows of different segments are not neighbours.
#[derive(Debug)]
pub(super) struct Sequence {
    pub(super) segments: Vec<Vec<usize>>,
    pub(super) order: SampleOrder,
}

impl Sequence {
    /// Orders `rows` of `dataset`, as indices into `rows`. A new segment begins if the time decreases, as between clips. If the time decreases in many places,
    /// the table is unordered, and rows are sorted by time.
    pub(super) fn of(dataset: &Dataset, rows: &[usize]) -> Sequence {
        let names = recordings::names(dataset, rows);
        let table = dataset.table();
        let times: Option<Vec<f64>> = rows.iter().map(|&row| table.t_s()[row]).collect();
        let times = times.filter(|times| times.iter().all(|time| time.is_finite()));
        let is_new = |at: usize| {
            names
                .as_ref()
                .is_some_and(|names| names[at] != names[at - 1])
        };
        let mut of_recordings: Vec<Vec<usize>> = Vec::new();
        for at in 0..rows.len() {
            match of_recordings.last_mut() {
                Some(last) if !is_new(at) => last.push(at),
                _ => of_recordings.push(vec![at]),
            }
        }
        let Some(times) = times else {
            return Sequence {
                segments: of_recordings,
                order: SampleOrder::Table,
            };
        };
        let segments = of_recordings
            .into_iter()
            .flat_map(|recording| in_time(recording, &times))
            .collect();
        Sequence {
            segments,
            order: SampleOrder::Time,
        }
    }

    /// Pairs of positions that are `lag` samples apart in one segment.
    pub(super) fn pairs(&self, lag: usize) -> impl Iterator<Item = [usize; 2]> {
        self.segments.iter().flat_map(move |segment| {
            let later = segment.iter().skip(lag);
            segment.iter().zip(later).map(|(one, other)| [*one, *other])
        })
    }

    /// Resemblance of samples to the samples `lag` positions later, and the number of pairs; `None` if all ranks are equal.
    pub(super) fn resemblance(&self, ranks: &[Option<f64>], lag: usize) -> Option<(f64, usize)> {
        let pairs = self.pairs(lag);
        let both = pairs.filter_map(|[one, other]| Some([ranks[one]?, ranks[other]?]));
        resemblance(both)
    }

    /// Minimum lag, in samples, at which the ranks hardly resemble each other.
    pub(super) fn lag(&self, ranks: &[Option<f64>]) -> usize {
        let farthest = (ranks.len() / FARTHEST).max(1);
        let mut lag = 1;
        while lag < farthest {
            match self.resemblance(ranks, lag) {
                Some((resemblance, pairs)) if resemblance >= APART && pairs >= PAIRS_LEAST => {
                    lag += (lag / 4).max(1);
                }
                _ => return lag,
            }
        }
        farthest
    }
}

/// Rows of one recording in segments of ascending times.
fn in_time(mut recording: Vec<usize>, times: &[f64]) -> Vec<Vec<usize>> {
    let goes_back = |pair: &[usize]| times[pair[1]] < times[pair[0]];
    let backwards = recording.windows(2).filter(|pair| goes_back(pair)).count();
    // In unordered rows, every second step goes back.
    if backwards * 8 > recording.len() {
        recording.sort_by(|one, other| times[*one].total_cmp(&times[*other]));
        return vec![recording];
    }
    let mut segments: Vec<Vec<usize>> = Vec::new();
    for position in recording {
        match segments.last_mut() {
            Some(segment)
                if segment
                    .last()
                    .is_none_or(|last| times[position] >= times[*last]) =>
            {
                segment.push(position);
            }
            _ => segments.push(vec![position]),
        }
    }
    segments
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_that_start_anew_begin_a_segment_and_shuffled_rows_are_put_in_order() {
        let times: Vec<f64> = (0..30_u32).map(|row| f64::from(row % 10)).collect();
        let clips = in_time((0..30).collect(), &times);
        assert_eq!(clips.iter().map(Vec::len).collect::<Vec<_>>(), [10, 10, 10]);
        let shuffled: Vec<f64> = (0..30_u32).map(|row| f64::from(row * 7 % 30)).collect();
        let sorted = in_time((0..30).collect(), &shuffled);
        assert_eq!(sorted.len(), 1);
        assert!(sorted[0].is_sorted_by(|one, other| shuffled[*one] <= shuffled[*other]));
    }
}
