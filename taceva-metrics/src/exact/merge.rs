//! Merging of separate summaries.

use std::collections::BTreeMap;

use crate::exact::sorted_map::SortedMap;

/// A summary that merges exactly; merging the same summary twice counts it twice.
pub(crate) trait Merge {
    /// Adds `other`.
    fn merge(&mut self, other: &Self);
    /// Adds `other` as often as `times`.
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

/// Entries by name; of equal names the last one stays.
///
/// Like `collect`, which would sort first with separate code for each kind of iterator: a tenth of the compile time.
pub(crate) fn keyed<T>(entries: impl IntoIterator<Item = (String, T)>) -> BTreeMap<String, T> {
    let mut cells = BTreeMap::new();
    for (key, entry) in entries {
        cells.insert(key, entry);
    }
    cells
}

/// Merges sums by key. A key without sums stays absent, so equal sets have equal maps.
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
