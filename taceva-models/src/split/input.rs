//! The columns that a division looks at.

use std::collections::BTreeMap;

use super::assign::Split;
use super::error::SplitError;
use super::part::Part;

/// What a split may look at.
///
/// # Shapes
/// Every list but `sections` has a value a row.
#[derive(Clone, Debug, Default)]
pub struct SplitInput<'a> {
    /// Number of samples.
    pub rows: usize,
    /// The contact point of each sample.
    pub points: Option<&'a [String]>,
    /// The time of each sample in s.
    pub times_s: Option<&'a [f64]>,
    /// The part that the recording itself names.
    pub parts: Option<&'a [String]>,
    /// Columns by name.
    pub columns: BTreeMap<&'a str, &'a [String]>,
    /// The recording of each sample, where several are divided.
    pub recordings: Option<&'a [String]>,
    /// Blocks of time, where there are such.
    pub blocks: Option<SplitBlocks<'a>>,
    /// The first row of each section but the first, ascending: samples that were recorded, or added, later. Chance and time divide section by
    /// section, so that samples which come later change the part of none that was there; empty: all samples are one section.
    pub sections: &'a [usize],
}

/// Blocks of time: samples in a row that stay together.
///
/// # Shapes
/// Both lists have a value a row.
#[derive(Clone, Copy, Debug)]
pub struct SplitBlocks<'a> {
    /// The block of each sample; empty of a sample in none.
    pub names: &'a [String],
    /// The place of each sample in time, counted in samples; places of samples that do not follow each other are further apart than the gap.
    pub places: &'a [usize],
    /// Samples that are left out between blocks of different parts.
    pub gap: usize,
}

impl SplitInput<'_> {
    pub(super) fn check(&self) -> Result<(), SplitError> {
        let lengths = [
            ("points", self.points.map(<[_]>::len)),
            ("times", self.times_s.map(<[_]>::len)),
            ("parts", self.parts.map(<[_]>::len)),
            ("recordings", self.recordings.map(<[_]>::len)),
            ("blocks", self.blocks.map(|blocks| blocks.names.len())),
            ("places", self.blocks.map(|blocks| blocks.places.len())),
        ];
        let columns = self
            .columns
            .iter()
            .map(|(name, column)| (*name, Some(column.len())));
        match lengths
            .into_iter()
            .chain(columns)
            .find(|(_, length)| length.is_some_and(|length| length != self.rows))
        {
            None => Ok(()),
            Some((what, found)) => Err(SplitError::Length {
                what: what.to_owned(),
                found: found.unwrap_or(0),
                rows: self.rows,
            }),
        }
    }

    /// The split without samples that stand, within the gap, beside a sample of a part that judges them: training samples beside any other part, and
    /// validation samples beside the test part.
    pub(super) fn apart(&self, split: Split) -> Split {
        let Some(SplitBlocks { places, gap, .. }) = self.blocks.filter(|blocks| blocks.gap > 0)
        else {
            return split;
        };
        let mut parts = vec![None; self.rows];
        for part in Part::ALL {
            split
                .rows(part)
                .iter()
                .for_each(|&row| parts[row] = Some(part));
        }
        let mut order: Vec<usize> = (0..self.rows).collect();
        order.sort_by_key(|&row| places[row]);
        // The last place so far, from either side, of a part that judges the training part, and of the test part.
        let mut near = vec![false; self.rows];
        let mut look = |order: &mut dyn Iterator<Item = usize>| {
            let mut last: [Option<usize>; 2] = [None, None];
            for row in order {
                let nearest = match parts[row] {
                    Some(Part::Train) => last[0],
                    Some(Part::Validation) => last[1],
                    _ => None,
                };
                near[row] |= nearest.is_some_and(|place| places[row].abs_diff(place) <= gap);
                if matches!(parts[row], Some(Part::Validation | Part::Test)) {
                    last[0] = Some(places[row]);
                }
                if parts[row] == Some(Part::Test) {
                    last[1] = Some(places[row]);
                }
            }
        };
        look(&mut order.iter().copied());
        look(&mut order.iter().rev().copied());
        let kept = parts.into_iter().zip(near);
        let mut apart = Split::of(kept.map(|(part, is_near)| part.filter(|_| !is_near)));
        apart.note = split.note;
        apart
    }
}
