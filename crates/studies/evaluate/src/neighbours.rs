//! Detects neighbouring samples that resemble each other, from labels and their order. With such samples, a random division would leak information between
//! parts.

mod blocks;
mod sequence;

use std::collections::BTreeMap;

use taceva_dataset::Dataset;

use crate::note::Neighbours;
pub(crate) use blocks::Blocks;
use sequence::Sequence;

/// Minimum resemblance at which a division does not separate neighbours: 0 for independent, 1 for equal neighbours.
const LEAST: f64 = 0.3;
/// Minimum resemblance, in standard deviations of the resemblance of independent samples. One standard deviation is about 1/√pairs.
const DEVIATIONS: f64 = 3.5;
/// Minimum number of pairs of neighbours for any decision.
const PAIRS_LEAST: usize = 20;
/// Minimum number of groups for which a column is preferred to blocks of time.
const GROUPS_LEAST: usize = 5;
/// Parts of the names of columns whose values are groups, in order of preference. The last part is the most general.
const GROUP_NAMES: [&str; 12] = [
    "clip", "video", "episode", "take", "trial", "press", "grasp", "repeat", "session", "run",
    "object", "group",
];

/// Resemblance of neighbouring samples, computed from the labels of a recording.
#[derive(Clone, Debug, PartialEq)]
pub enum Resemblance {
    /// Neighbours resemble each other.
    Alike(Neighbours),
    /// Neighbours resemble each other no more than random pairs do.
    Apart,
    /// There are too few samples to decide.
    Unknown,
}

impl Resemblance {
    /// Resemblance of neighbours among `rows` of `dataset`.
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

/// Pairs of neighbouring indices into `rows`.
pub(crate) fn pairs(dataset: &Dataset, rows: &[usize]) -> Vec<[usize; 2]> {
    Sequence::of(dataset, rows).pairs(1).collect()
}

/// Channel with the greatest resemblance of neighbours, with its ranks and its resemblance; `None` if no channel reaches the minimum.
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

/// Minimum resemblance for this number of pairs, which independent samples do not reach.
fn least(pairs: usize) -> f64 {
    LEAST.max(DEVIATIONS / (pairs as f64).sqrt())
}

/// Resemblance of the rank pairs, and number of pairs. The resemblance is 1 − d/e. Here d is the mean squared difference of the pairs, and e its
/// expected value for independent ranks. `None` if all ranks are equal.
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

/// Rank of each label, from 0 to 1. Ranks give outliers little weight. Equal labels have their mean rank.
fn ranks(labels: &[Option<f64>]) -> Vec<Option<f64>> {
    let mut order: Vec<(f64, usize)> = labels
        .iter()
        .enumerate()
        // -0 and 0 count as equal.
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

/// Position in the order of preference of a column whose name indicates groups; 0 is preferred most. `None` for any other name.
pub(crate) fn preference(name: &str) -> Option<usize> {
    let name = name.to_lowercase();
    GROUP_NAMES.iter().position(|known| name.contains(known))
}

/// Column whose values are groups of neighbours, if any: groups of consecutive rows, whose last sample does not resemble the first sample of the next
/// group.
fn group_column(
    dataset: &Dataset,
    rows: &[usize],
    sequence: &Sequence,
    ranks: &[Option<f64>],
) -> Option<String> {
    let table = dataset.table();
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

/// Number of groups among `values`; `None` if the values form no groups.
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
    use crate::note::SampleOrder;

    fn in_a_row(rows: usize) -> Sequence {
        Sequence {
            segments: vec![(0..rows).collect()],
            order: SampleOrder::Table,
        }
    }

    /// Test numbers from −1 to 1 from a linear congruential generator.
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
        // Thirty short pieces of one slow walk: each piece continues the one before.
        let pieces: Vec<String> = (0..900).map(|row| format!("clip {}", row / 30)).collect();
        let pieces: Vec<&str> = pieces.iter().map(String::as_str).collect();
        let walk: Vec<Option<f64>> = walk(900).into_iter().map(Some).collect();
        assert_eq!(groups_in_rows(&pieces, &in_a_row(900), &ranks(&walk)), None);
    }
}
