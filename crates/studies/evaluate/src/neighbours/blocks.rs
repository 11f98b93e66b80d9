//! Blocks of time, each longer than the time over which its samples resemble each other.

use taceva_dataset::Dataset;

use super::most_alike;
use super::sequence::Sequence;
use crate::recordings;

/// Minimum and maximum number of blocks in a recording with enough samples.
const BLOCKS: [usize; 2] = [10, 40];

/// Blocks of time: consecutive samples.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Blocks {
    /// Name of the block of each row.
    pub(crate) names: Vec<String>,
    /// Position of each row in time, counted in samples.
    pub(crate) places: Vec<usize>,
    /// Number of samples left out between blocks of different parts.
    pub(crate) gap: usize,
    /// Number of blocks.
    pub(crate) count: usize,
}

impl Blocks {
    /// Blocks of `rows` of `dataset`, if possible at least twice as long as the lag over which samples resemble each other. `None` if there are too few
    /// samples. Added rows form their own blocks, so that earlier blocks do not change.
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
            // Too few rows for several blocks form one block.
            numbered(&sequence, own.len(), lag).unwrap_or_else(|| NumberedBlocks {
                numbers: vec![0; own.len()],
                places: (0..own.len()).collect(),
                gap: 0,
                count: 1,
            })
        });
        Some(Blocks::one_after_the_other(sections.collect()))
    }

    /// Joins the blocks of consecutive sections. Samples of different sections are not neighbours.
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

/// Blocks of a section of rows, by number.
#[derive(Debug)]
struct NumberedBlocks {
    /// Block number of each row, counted from 0.
    numbers: Vec<usize>,
    places: Vec<usize>,
    gap: usize,
    count: usize,
}

/// Blocks of the `rows` rows of `sequence`, whose samples resemble each other over `lag` samples. `None` if there are too few samples.
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
        // Blocks of equal length, without a short remainder.
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
        // The first row of the second section is not a neighbour of the last row of the first.
        assert!(both.places[900] - both.places[899] > both.gap);
    }
}
