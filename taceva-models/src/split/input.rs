//! Columns of a recording on which a split depends.

use std::collections::BTreeMap;

use super::assign::Split;
use super::error::SplitError;
use super::part::Part;

/// Columns of a recording on which a split may depend. Missing columns are `None`.
///
/// # Shapes
/// Every list except `sections` has one value per row.
#[derive(Clone, Debug, Default)]
pub struct SplitInput<'a> {
    /// Number of samples.
    pub rows: usize,
    /// Contact point of each sample.
    pub points: Option<&'a [String]>,
    /// Time of each sample, in s.
    pub times_s: Option<&'a [f64]>,
    /// Part that the recording declares for each sample, such as `train` or `test`.
    pub parts: Option<&'a [String]>,
    /// Values of each sample in further columns, by column name.
    pub columns: BTreeMap<&'a str, &'a [String]>,
    /// Name of the recording of each sample, if there are several recordings.
    pub recordings: Option<&'a [String]>,
    /// Blocks of time, if there are any.
    pub blocks: Option<SplitBlocks<'a>>,
    /// First row of each section after the first, ascending; empty for a single section. A section is a run of rows that were recorded or added
    /// together. Random and chronological splits divide each section separately, so that samples added later do not change earlier parts.
    pub sections: &'a [usize],
}

/// Blocks of time: consecutive samples that are assigned to one part.
///
/// # Shapes
/// Both lists have one value per row.
#[derive(Clone, Copy, Debug)]
pub struct SplitBlocks<'a> {
    /// Name of each sample's block; empty for samples without a block.
    pub names: &'a [String],
    /// Position of each sample in time, counted in samples. Samples that do not follow each other in one recording are more than `gap` apart.
    pub places: &'a [usize],
    /// Number of samples left out between blocks of different parts.
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

    /// Leaves out samples that lie within `gap` samples of a later part. Training samples may not be near validation or test samples, nor validation
    /// samples near test samples.
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
        // Visits rows in both directions, with the last position of a validation or test sample, and of a test sample.
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
