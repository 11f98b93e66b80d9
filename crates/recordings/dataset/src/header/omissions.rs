//! Data in the source folder that the import did not use.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// Data that the import left out, for readers of the dataset.
///
/// File names are relative to the source folder. The first 64 names are kept, and further files are counted together under `…`.
///
/// ```
/// use taceva_dataset::LeftOut;
///
/// let mut left_out = LeftOut::default();
/// assert!(left_out.is_empty());
/// left_out.rows.insert("join ft".into(), 3);
/// left_out.frames.insert("clip.mp4".into(), 12);
/// assert!(!left_out.is_empty());
/// ```
#[non_exhaustive]
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct LeftOut {
    /// Number of images beside the tables that no row uses.
    #[serde(skip_serializing_if = "is_zero")]
    pub images: u64,
    /// Number of unused columns whose names are not stored, because there are more than 256 or the names are too long.
    #[serde(skip_serializing_if = "is_zero")]
    pub columns: u64,
    /// Number of table rows excluded by each rule. Several rules may exclude the same row.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub rows: BTreeMap<String, u64>,
    /// Number of rows of each joined table that match no row of the main table, whether kept or dropped.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub joined_rows: BTreeMap<String, u64>,
    /// Number of rows of each joined table that `skip` excludes.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub skipped_rows: BTreeMap<String, u64>,
    /// Number of frames in each array or clip that no row of the dataset uses.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub frames: BTreeMap<String, u64>,
    /// Number of array chunks that were never written and have their fill value, by file and array.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub absent_chunks: BTreeMap<String, u64>,
}

/// Maximum number of stored names of one kind.
const NAMED: usize = 64;
/// Name under which items beyond [`NAMED`] are counted together.
const OTHERS: &str = "…";

impl LeftOut {
    /// True if nothing was left out.
    pub fn is_empty(&self) -> bool {
        *self == LeftOut::default()
    }

    /// Sum of these omissions and `other`, the omissions of an import that added rows.
    #[must_use]
    pub fn and(mut self, other: LeftOut) -> LeftOut {
        self.images += other.images;
        self.columns += other.columns;
        for (counts, added) in [
            (&mut self.rows, other.rows),
            (&mut self.joined_rows, other.joined_rows),
            (&mut self.skipped_rows, other.skipped_rows),
            (&mut self.frames, other.frames),
            (&mut self.absent_chunks, other.absent_chunks),
        ] {
            for (name, count) in added {
                add(counts, &name, count);
            }
        }
        self
    }
}

/// Adds `count` to the count of `name`, or to the common count of further names if the maximum number of names is reached.
pub fn add(counts: &mut BTreeMap<String, u64>, name: &str, count: u64) {
    if count == 0 {
        return;
    }
    let is_named = counts.len() < NAMED || counts.contains_key(name);
    let name = if is_named { name } else { OTHERS };
    *counts.entry(name.to_owned()).or_default() += count;
}

fn is_zero(count: &u64) -> bool {
    *count == 0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_left_out_before_rows_were_added_is_still_counted() {
        let mut before = LeftOut {
            images: 2,
            ..LeftOut::default()
        };
        before.rows.insert("frame".into(), 3);
        let mut added = before.clone();
        added.frames.insert("clip.mp4".into(), 4);
        let both = before.and(added);
        assert_eq!(
            (both.images, both.rows["frame"], both.frames["clip.mp4"]),
            (4, 6, 4)
        );
    }

    #[test]
    fn of_many_files_the_first_are_named_and_nothing_is_lost() {
        let mut counts = BTreeMap::new();
        for file in 0..200 {
            add(&mut counts, &format!("clip_{file:03}.mp4"), 2);
        }
        add(&mut counts, "clip_000.mp4", 1);
        add(&mut counts, "none.mp4", 0);
        assert_eq!(counts.values().sum::<u64>(), 401);
        assert_eq!((counts.len(), counts["clip_000.mp4"]), (NAMED + 1, 3));
        assert_eq!(counts[OTHERS], 2 * (200 - 64));
    }
}
