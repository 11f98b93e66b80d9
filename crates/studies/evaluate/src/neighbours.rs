//! Neighbouring samples that resemble each other, found in the labels and their order: what a division at random would leak.

use std::collections::BTreeMap;

use taceva_dataset::Dataset;

use crate::note::{Neighbours, SampleOrder};
use crate::recordings;

/// Resemblance of neighbours from which on they are kept together.
const LEAST: f64 = 0.3;
/// Standard deviations of the resemblance of independent samples, which is about 1/√pairs, that it must exceed.
const DEVIATIONS: f64 = 3.5;
/// Fewest pairs of neighbours by which anything is decided.
const PAIRS_LEAST: usize = 20;
/// Resemblance below which samples are far enough apart.
const APART: f64 = 0.2;
/// The largest distance that is looked at, as a share of the samples.
const FARTHEST: usize = 10;
/// Blocks of time that a recording has at least, where it has samples for it, and at most.
const BLOCKS: [usize; 2] = [10, 40];
/// Groups from which on a column is preferred to blocks of time.
const GROUPS_LEAST: usize = 5;
/// Names of columns whose values are groups, in the order in which they are preferred.
const GROUP_NAMES: [&str; 10] = [
    "clip", "video", "episode", "take", "trial", "press", "repeat", "session", "run", "object",
];

/// Blocks of time: samples in a row.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Blocks {
    /// The block of each row.
    pub(crate) names: Vec<String>,
    /// The place of each row in time, counted in samples.
    pub(crate) places: Vec<usize>,
    /// Samples between blocks of different parts.
    pub(crate) gap: usize,
    /// Number of blocks.
    pub(crate) count: usize,
}

/// Rows in the order in which they are neighbours: segments, across which there are none.
#[derive(Debug)]
struct Sequence {
    segments: Vec<Vec<usize>>,
    order: SampleOrder,
}

/// Resemblance of neighbouring samples by the labels of a recording.
#[derive(Clone, Debug, PartialEq)]
pub enum Resemblance {
    /// Neighbours resemble each other.
    Alike(Neighbours),
    /// Neighbours resemble each other no more than random pairs do.
    Apart,
    /// Too few samples to say.
    Unknown,
}

impl Resemblance {
    /// The resemblance among `rows` of `dataset`.
    pub fn of(dataset: &Dataset, rows: &[usize]) -> Resemblance {
        let sequence = Sequence::of(dataset, rows);
        match most_alike(dataset, rows, &sequence) {
            Some((channel, ranks, resemblance)) => Resemblance::Alike(Neighbours {
                channel,
                resemblance,
                lag: sequence.lag(&ranks),
                order: sequence.order,
                column: group_column(dataset, rows, &sequence, &ranks),
            }),
            None if sequence.pairs(1).count() >= PAIRS_LEAST => Resemblance::Apart,
            None => Resemblance::Unknown,
        }
    }
}

impl Blocks {
    /// Blocks of `rows` of `dataset`, each at least twice as long as samples resemble each other, as far as their number allows it; `None` of too
    /// few samples. Rows that were added later make blocks of their own, so that those of before stay as they were.
    pub(crate) fn of(dataset: &Dataset, rows: &[usize]) -> Option<Blocks> {
        if rows.len() < BLOCKS[0] {
            return None;
        }
        let starts = recordings::sections(dataset, rows);
        let ends = starts.iter().copied().chain([rows.len()]);
        let starts = std::iter::once(0).chain(starts.iter().copied());
        let sections = starts.zip(ends).map(|(start, end)| {
            let own = &rows[start..end];
            let sequence = Sequence::of(dataset, own);
            let lag =
                most_alike(dataset, own, &sequence).map_or(0, |(_, ranks, _)| sequence.lag(&ranks));
            // So few rows that there are not several blocks are one.
            numbered(&sequence, own.len(), lag).unwrap_or_else(|| NumberedBlocks {
                numbers: vec![0; own.len()],
                places: (0..own.len()).collect(),
                gap: 0,
                count: 1,
            })
        });
        Some(Blocks::one_after_the_other(sections.collect()))
    }

    /// Blocks of rows behind each other, which are no neighbours.
    fn one_after_the_other(sections: Vec<NumberedBlocks>) -> Blocks {
        let gap = sections.iter().map(|own| own.gap).max().unwrap_or(0);
        let mut all = Blocks {
            gap,
            ..Blocks::default()
        };
        let mut place = 0;
        for own in sections {
            let first = all.count;
            let last = own.places.iter().max().map_or(0, |last| last + 1);
            all.names.extend(
                own.numbers
                    .iter()
                    .map(|number| format!("block {}", first + number + 1)),
            );
            all.places.extend(own.places.iter().map(|own| place + own));
            all.count += own.count;
            place += last + gap + 1;
        }
        all
    }
}

/// Pairs of positions among `rows` that are neighbours.
pub(crate) fn pairs(dataset: &Dataset, rows: &[usize]) -> Vec<[usize; 2]> {
    Sequence::of(dataset, rows).pairs(1).collect()
}

/// Blocks of a section of rows, by number.
#[derive(Debug)]
struct NumberedBlocks {
    /// The number of the block of each row, from 0.
    numbers: Vec<usize>,
    places: Vec<usize>,
    gap: usize,
    count: usize,
}

/// Blocks of the `rows` rows of `sequence`, which resemble each other for `lag` samples; `None` of too few.
fn numbered(sequence: &Sequence, rows: usize, lag: usize) -> Option<NumberedBlocks> {
    let [least, most] = BLOCKS;
    let longest = rows / least;
    if longest < 1 {
        return None;
    }
    let length = (2 * lag).max(rows.div_ceil(most)).clamp(1, longest);
    let mut blocks = NumberedBlocks {
        numbers: vec![0; rows],
        places: vec![0; rows],
        gap: lag.min(length / 2),
        count: 0,
    };
    let mut place = 0;
    for segment in &sequence.segments {
        // As long as each other: the last one is no rest.
        let own = segment.len().div_ceil(length).max(1);
        for (at, &position) in segment.iter().enumerate() {
            blocks.numbers[position] = blocks.count + at * own / segment.len();
            blocks.places[position] = place + at;
        }
        blocks.count += own;
        place += segment.len() + blocks.gap + 1;
    }
    Some(blocks)
}

impl Sequence {
    /// `rows` of `dataset` as positions among them. Where times go back, as from clip to clip, a segment begins; where they go back all the time,
    /// the table is in no order, and that of times counts.
    fn of(dataset: &Dataset, rows: &[usize]) -> Sequence {
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

    /// Pairs of positions that stand `lag` samples apart in one segment.
    fn pairs(&self, lag: usize) -> impl Iterator<Item = [usize; 2]> {
        self.segments.iter().flat_map(move |segment| {
            let later = segment.iter().skip(lag);
            segment.iter().zip(later).map(|(one, other)| [*one, *other])
        })
    }

    /// The resemblance of samples to those `lag` later, with the number of pairs.
    fn resemblance(&self, ranks: &[Option<f64>], lag: usize) -> Option<(f64, usize)> {
        let pairs = self.pairs(lag);
        let both = pairs.filter_map(|[one, other]| Some([ranks[one]?, ranks[other]?]));
        resemblance(both)
    }

    /// Samples after which the ranks hardly resemble each other.
    fn lag(&self, ranks: &[Option<f64>]) -> usize {
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

/// The rows of one recording in segments of ascending times.
fn in_time(mut recording: Vec<usize>, times: &[f64]) -> Vec<Vec<usize>> {
    let goes_back = |pair: &[usize]| times[pair[1]] < times[pair[0]];
    let backwards = recording.windows(2).filter(|pair| goes_back(pair)).count();
    // Of rows in no order every second step goes back.
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

/// The channel whose neighbours resemble each other most, its ranks, and how much; `None` where no channel shows it.
fn most_alike(
    dataset: &Dataset,
    rows: &[usize],
    sequence: &Sequence,
) -> Option<(String, Vec<Option<f64>>, f64)> {
    let table = dataset.table();
    let mut most: Option<(String, Vec<Option<f64>>, f64)> = None;
    for (position, channel) in table.channels().iter().enumerate() {
        let truth = table.truth(position);
        let labels: Vec<Option<f64>> = rows.iter().map(|&row| truth.get(row)).collect();
        let ranks = ranks(&labels);
        let Some((resemblance, pairs)) = sequence.resemblance(&ranks, 1) else {
            continue;
        };
        let is_alike = pairs >= PAIRS_LEAST && resemblance >= least(pairs);
        if is_alike
            && most
                .as_ref()
                .is_none_or(|(_, _, before)| resemblance > *before)
        {
            most = Some((channel.name().to_owned(), ranks, resemblance));
        }
    }
    most
}

/// The resemblance that independent samples do not reach in so many pairs.
fn least(pairs: usize) -> f64 {
    LEAST.max(DEVIATIONS / (pairs as f64).sqrt())
}

/// One minus the mean squared difference of pairs of ranks, over that of ranks that do not depend on each other; `None` of ranks that are all the
/// same.
fn resemblance(pairs: impl Iterator<Item = [f64; 2]>) -> Option<(f64, usize)> {
    let (mut count, mut apart, mut sum, mut squares) = (0_usize, 0.0, 0.0, 0.0);
    for [one, other] in pairs {
        count += 1;
        apart += (one - other).powi(2);
        sum += one + other;
        squares += one * one + other * other;
    }
    let numbers = 2.0 * count as f64;
    let variance = squares / numbers - (sum / numbers).powi(2);
    (variance > 1e-12).then(|| (1.0 - apart / count as f64 / (2.0 * variance), count))
}

/// The rank of each label from 0 to 1, equal labels with the mean of theirs: no outlier decides.
fn ranks(labels: &[Option<f64>]) -> Vec<Option<f64>> {
    let mut order: Vec<(f64, usize)> = labels
        .iter()
        .enumerate()
        // -0 and 0 are one label.
        .filter_map(|(at, label)| Some((label.filter(|label| label.is_finite())? + 0.0, at)))
        .collect();
    order.sort_by(|(one, _), (other, _)| one.total_cmp(other));
    let count = order.len().max(1) as f64;
    let mut ranks = vec![None; labels.len()];
    let mut before = 0.0;
    for equal in order.chunk_by(|(one, _), (other, _)| one.total_cmp(other).is_eq()) {
        let own = equal.len() as f64;
        let rank = (before + (own - 1.0) / 2.0) / count;
        equal.iter().for_each(|(_, at)| ranks[*at] = Some(rank));
        before += own;
    }
    ranks
}

/// The column whose values are groups of neighbours: each stands in a row, there are several, and the last of one does not resemble the first of the
/// next.
fn group_column(
    dataset: &Dataset,
    rows: &[usize],
    sequence: &Sequence,
    ranks: &[Option<f64>],
) -> Option<String> {
    let table = dataset.table();
    let preference = |name: &str| {
        let name = name.to_lowercase();
        GROUP_NAMES.iter().position(|known| name.contains(known))
    };
    let names = table.attribute_names().iter().map(String::as_str);
    let mut found: Vec<(usize, usize, &str)> = Vec::new();
    for name in names {
        let Some(preference) = preference(name) else {
            continue;
        };
        let Some(cells) = table.as_text(name) else {
            continue;
        };
        let values: Option<Vec<&str>> = rows.iter().map(|&row| cells[row].as_deref()).collect();
        if let Some(groups) = values.and_then(|values| groups_in_rows(&values, sequence, ranks)) {
            found.push((preference, groups, name));
        }
    }
    found.sort_unstable();
    found.first().map(|(_, _, name)| (*name).to_owned())
}

/// The number of groups that `values` make, if they are such.
fn groups_in_rows(values: &[&str], sequence: &Sequence, ranks: &[Option<f64>]) -> Option<usize> {
    let mut sizes: BTreeMap<&str, usize> = BTreeMap::new();
    values
        .iter()
        .for_each(|value| *sizes.entry(value).or_default() += 1);
    let groups = sizes.len();
    let changes = || {
        sequence
            .pairs(1)
            .filter(|[one, other]| values[*one] != values[*other])
    };
    let runs = changes().count() + sequence.segments.len();
    if groups < GROUPS_LEAST || runs * 2 > values.len() {
        return None;
    }
    let across = changes().filter_map(|[one, other]| Some([ranks[one]?, ranks[other]?]));
    match resemblance(across) {
        Some((resemblance, pairs)) if pairs >= PAIRS_LEAST && resemblance >= least(pairs) => None,
        _ => Some(groups),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn in_a_row(rows: usize) -> Sequence {
        Sequence {
            segments: vec![(0..rows).collect()],
            order: SampleOrder::Table,
        }
    }

    /// Numbers from −1 to 1 of a linear congruential sequence.
    fn noise(rows: usize) -> Vec<f64> {
        let mut state = 7_u64;
        let next = |_| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            f64::from(u32::try_from(state >> 32).expect("32 bits")) / 2_147_483_648.0 - 1.0
        };
        (0..rows).map(next).collect()
    }

    fn walk(rows: usize) -> Vec<f64> {
        let mut at = 0.0;
        let step = |step: f64| {
            at += step;
            at
        };
        noise(rows).into_iter().map(step).collect()
    }

    fn found(labels: &[f64], sequence: &Sequence) -> f64 {
        let labels: Vec<Option<f64>> = labels.iter().copied().map(Some).collect();
        let (resemblance, _) = sequence.resemblance(&ranks(&labels), 1).expect("pairs");
        resemblance
    }

    #[test]
    fn neighbours_of_a_walk_resemble_each_other_and_those_of_noise_do_not() {
        let sequence = in_a_row(900);
        assert!(found(&walk(900), &sequence) > 0.95);
        assert!(found(&noise(900), &sequence).abs() < least(899));
        // One outlier changes nothing.
        let mut spiked = noise(900);
        spiked[10] = 1e9;
        assert!(found(&spiked, &sequence).abs() < least(899));
    }

    #[test]
    fn samples_are_apart_where_a_slow_wave_has_passed_a_quarter() {
        let wave: Vec<Option<f64>> = (0..1000_u32)
            .map(|row| Some((f64::from(row) * std::f64::consts::TAU / 100.0).sin()))
            .collect();
        let lag = in_a_row(1000).lag(&ranks(&wave));
        assert!((15..=35).contains(&lag), "{lag}");
    }

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

    #[test]
    fn blocks_are_long_enough_and_at_least_ten() {
        let of = |rows: usize, lag: usize| numbered(&in_a_row(rows), rows, lag).expect("blocks");
        assert_eq!((of(900, 90).count, of(900, 90).gap), (10, 45));
        assert_eq!((of(4000, 10).count, of(4000, 10).gap), (40, 10));
        assert_eq!(of(12, 1).count, 12);
        assert!(numbered(&in_a_row(9), 9, 1).is_none());
        let both = Blocks::one_after_the_other(vec![of(900, 90), of(40, 2)]);
        let names = [0, 899, 900, 939].map(|row| both.names[row].as_str());
        assert_eq!(names, ["block 1", "block 10", "block 11", "block 20"]);
        // The first of the second section is no neighbour of the last of the first.
        assert!(both.places[900] - both.places[899] > both.gap);
    }

    #[test]
    fn groups_stand_in_a_row_and_differ_where_they_meet() {
        let clips: Vec<String> = (0..200).map(|row| format!("clip {}", row / 20)).collect();
        let clips: Vec<&str> = clips.iter().map(String::as_str).collect();
        let independent: Vec<Option<f64>> = noise(200).into_iter().map(Some).collect();
        let sequence = in_a_row(200);
        assert_eq!(
            groups_in_rows(&clips, &sequence, &ranks(&independent)),
            Some(10)
        );
        let turns: Vec<String> = (0..200).map(|row| format!("{}", row % 10)).collect();
        let turns: Vec<&str> = turns.iter().map(String::as_str).collect();
        assert_eq!(
            groups_in_rows(&turns, &sequence, &ranks(&independent)),
            None
        );
        // Thirty short pieces of one slow walk: the end of each is the beginning of the next.
        let pieces: Vec<String> = (0..900).map(|row| format!("clip {}", row / 30)).collect();
        let pieces: Vec<&str> = pieces.iter().map(String::as_str).collect();
        let walk: Vec<Option<f64>> = walk(900).into_iter().map(Some).collect();
        assert_eq!(groups_in_rows(&pieces, &in_a_row(900), &ranks(&walk)), None);
    }
}
