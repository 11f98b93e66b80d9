//! Merging of summaries.

use std::collections::BTreeMap;

use crate::exact::sorted_map::SortedMap;

/// Summary with an exact merge. Merging the same summary twice counts its samples twice.
pub(crate) trait Merge {
    /// Adds `other`.
    fn merge(&mut self, other: &Self);
    /// Adds `other` `times` times.
    fn merge_times(&mut self, other: &Self, times: u32) {
        (0..times).for_each(|_| self.merge(other));
    }
}

impl<T: Merge> Merge for Vec<T> {
    fn merge(&mut self, other: &Vec<T>) {
        for (part, other) in self.iter_mut().zip(other) {
            part.merge(other);
        }
    }
}

impl<T: Merge, const N: usize> Merge for [T; N] {
    fn merge(&mut self, other: &[T; N]) {
        for (part, other) in self.iter_mut().zip(other) {
            part.merge(other);
        }
    }
}

/// Map from entries. The last entry of a name replaces earlier entries.
///
/// Unlike `collect`, the function has no separate sorting code for each type of iterator, which took a tenth of the compile time.
pub(crate) fn keyed<T>(entries: impl IntoIterator<Item = (String, T)>) -> BTreeMap<String, T> {
    let mut cells = BTreeMap::new();
    for (key, entry) in entries {
        cells.insert(key, entry);
    }
    cells
}

/// Merges sums by key. A key without sums is omitted, so equal sets have equal maps.
pub(crate) fn merge_cells<K: Ord + Clone, T: Merge + Clone>(
    ours: &mut SortedMap<K, T>,
    theirs: &SortedMap<K, T>,
) {
    for (key, theirs) in theirs {
        match ours.get_mut(key) {
            Some(ours) => ours.merge(theirs),
            None => {
                ours.insert(key.clone(), theirs.clone());
            }
        }
    }
}
