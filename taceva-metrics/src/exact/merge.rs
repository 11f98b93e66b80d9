//! Joining what was kept apart.

use std::collections::BTreeMap;

use crate::exact::sorted_map::SortedMap;

/// A summary whose parts can be joined, exactly; what is merged twice counts twice.
pub(crate) trait Merge {
    /// Takes over what `other` holds.
    fn merge(&mut self, other: &Self);
    /// Takes over what `other` holds, `times` over.
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
/// What `collect` would give: but that sorts first, by code of its own for each kind of iterator, which took a tenth of the time to compile.
pub(crate) fn keyed<T>(entries: impl IntoIterator<Item = (String, T)>) -> BTreeMap<String, T> {
    let mut cells = BTreeMap::new();
    for (key, entry) in entries {
        cells.insert(key, entry);
    }
    cells
}

/// Joins sums by key. A key without sums stays absent, so that equal sets have equal maps.
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
