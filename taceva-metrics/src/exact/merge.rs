//! Merging of summaries of samples.

use std::collections::BTreeMap;

use crate::exact::sorted_map::SortedMap;

/// Summary with an exact merge. Merging the same summary twice counts its samples twice.
pub(crate) trait Merge {
    /// Adds the samples of `other`.
    fn merge(&mut self, other: &Self);
    /// Adds the samples of `other` `times` times.
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

/// Collects entries into a map. The last entry of a name replaces earlier entries.
///
/// Calls of `collect` would compile sorting code for each type of iterator, a tenth of the compile time.
pub(crate) fn keyed<T>(entries: impl IntoIterator<Item = (String, T)>) -> BTreeMap<String, T> {
    let mut cells = BTreeMap::new();
    for (key, entry) in entries {
        cells.insert(key, entry);
    }
    cells
}

/// Merges the sums `theirs` into `ours`, key by key. A key in `theirs` alone is copied.
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
