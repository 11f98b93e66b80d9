//! Map sorted by key. Each pair of key and value types produces far less machine code than with a `BTreeMap`.

use std::borrow::Borrow;
use std::slice;

/// Greatest number of entries of a run, a sorted array of entries. A longer run is split.
const RUN: usize = 128;

/// Map of entries in ascending order of keys, stored in sorted arrays (runs) of 1 to [`RUN`] entries.
#[derive(Clone, Debug)]
pub(crate) struct SortedMap<K, V> {
    runs: Vec<Vec<(K, V)>>,
    /// Run of the latest change. Keys mostly arrive in order, so searches begin there.
    latest: usize,
}

impl<K, V> Default for SortedMap<K, V> {
    fn default() -> SortedMap<K, V> {
        SortedMap {
            runs: Vec::new(),
            latest: 0,
        }
    }
}

/// Position of a key, or the position at which to insert the key.
struct Place {
    run: usize,
    at: usize,
    is_taken: bool,
}

impl<K, V> SortedMap<K, V> {
    /// Entries in ascending order.
    pub(crate) fn iter(&self) -> Iter<'_, K, V> {
        Iter {
            runs: self.runs.iter(),
            entries: [].iter(),
        }
    }

    /// Values in the order of their keys.
    pub(crate) fn values(&self) -> impl Iterator<Item = &V> {
        self.iter().map(|(_, value)| value)
    }

    /// Number of entries.
    pub(crate) fn len(&self) -> usize {
        self.runs.iter().map(Vec::len).sum()
    }

    /// True if there are no entries.
    pub(crate) fn is_empty(&self) -> bool {
        self.runs.is_empty()
    }
}

impl<K: Ord, V> SortedMap<K, V> {
    fn place<Q: Ord + ?Sized>(&self, key: &Q) -> Place
    where
        K: Borrow<Q>,
    {
        let begins = |run: usize| self.runs[run][0].0.borrow() <= key;
        let (mut run, mut above) = (0, self.runs.len());
        let (latest, next) = (self.latest, self.latest + 1);
        if latest < above {
            match begins(latest) {
                true if next < above && !begins(next) => (run, above) = (latest, next),
                true => run = latest,
                false => above = latest,
            }
        }
        while above > run + 1 {
            let middle = usize::midpoint(run, above);
            match begins(middle) {
                true => run = middle,
                false => above = middle,
            }
        }
        let entries = self.runs.get(run).map_or(&[][..], Vec::as_slice);
        let (mut at, mut end) = (0, entries.len());
        while at < end {
            let middle = usize::midpoint(at, end);
            match entries[middle].0.borrow() < key {
                true => at = middle + 1,
                false => end = middle,
            }
        }
        let is_taken = entries.get(at).is_some_and(|(own, _)| own.borrow() == key);
        Place { run, at, is_taken }
    }

    /// Value of `key`; `None` if the map lacks the key.
    pub(crate) fn get<Q: Ord + ?Sized>(&self, key: &Q) -> Option<&V>
    where
        K: Borrow<Q>,
    {
        let Place { run, at, is_taken } = self.place(key);
        is_taken.then(|| &self.runs[run][at].1)
    }

    /// Mutable value of `key`; `None` if the map lacks the key.
    pub(crate) fn get_mut<Q: Ord + ?Sized>(&mut self, key: &Q) -> Option<&mut V>
    where
        K: Borrow<Q>,
    {
        let Place { run, at, is_taken } = self.place(key);
        self.latest = run;
        is_taken.then(|| &mut self.runs[run][at].1)
    }

    /// Adds an entry. Returns false and adds nothing if the map has the key already.
    pub(crate) fn insert(&mut self, key: K, value: V) -> bool {
        let place = self.place(&key);
        if !place.is_taken {
            [self.latest, _] = self.put(&place, key, value);
        }
        !place.is_taken
    }

    /// Mutable value of `key`. Inserts the default if the map lacks the key.
    pub(crate) fn entry(&mut self, key: K) -> &mut V
    where
        V: Default,
    {
        let Place {
            mut run,
            mut at,
            is_taken,
        } = self.place(&key);
        if !is_taken {
            [run, at] = self.put(&Place { run, at, is_taken }, key, V::default());
        }
        self.latest = run;
        &mut self.runs[run][at].1
    }

    /// Inserts an entry at `place`. Returns the indices of its run and of the entry in the run.
    fn put(&mut self, place: &Place, key: K, value: V) -> [usize; 2] {
        let &Place { run, at, .. } = place;
        let entry = (key, value);
        let Some(entries) = self.runs.get_mut(run) else {
            self.runs.push(vec![entry]);
            return [run, at];
        };
        entries.insert(at, entry);
        if entries.len() <= RUN {
            return [run, at];
        }
        let upper = entries.split_off(RUN / 2);
        self.runs.insert(run + 1, upper);
        match at.checked_sub(RUN / 2) {
            Some(at) => [run + 1, at],
            None => [run, at],
        }
    }
}

/// Equality by entries, because the runs depend on the order of insertion.
impl<K: PartialEq, V: PartialEq> PartialEq for SortedMap<K, V> {
    fn eq(&self, other: &SortedMap<K, V>) -> bool {
        let mut others = other.iter();
        for (key, value) in self {
            match others.next() {
                Some((other_key, other)) if key == other_key && value == other => {}
                _ => return false,
            }
        }
        others.next().is_none()
    }
}

impl<'a, K, V> IntoIterator for &'a SortedMap<K, V> {
    type Item = (&'a K, &'a V);
    type IntoIter = Iter<'a, K, V>;
    fn into_iter(self) -> Iter<'a, K, V> {
        self.iter()
    }
}

/// Entries of a [`SortedMap`] in ascending order.
pub(crate) struct Iter<'a, K, V> {
    runs: slice::Iter<'a, Vec<(K, V)>>,
    entries: slice::Iter<'a, (K, V)>,
}

impl<'a, K, V> Iterator for Iter<'a, K, V> {
    type Item = (&'a K, &'a V);

    fn next(&mut self) -> Option<(&'a K, &'a V)> {
        if self.entries.as_slice().is_empty() {
            self.entries = self.runs.next()?.iter();
        }
        let (key, value) = self.entries.next()?;
        Some((key, value))
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use taceva_core::random::SplitMix64;

    use super::*;

    #[test]
    fn entries_are_those_of_a_tree_whatever_order_they_come_in() {
        let mut random = SplitMix64::new(7);
        for keys in [0, 1, RUN, RUN + 1, 3000] {
            let (mut sorted, mut tree) = (SortedMap::default(), BTreeMap::new());
            for step in 0..keys {
                let key = random.below(2000);
                assert_eq!(sorted.insert(key, step), !tree.contains_key(&key));
                tree.entry(key).or_insert(step);
                *sorted.entry(key / 3) += 1;
                *tree.entry(key / 3).or_default() += 1;
            }
            assert!(sorted.iter().eq(tree.iter()) && sorted.len() == tree.len());
            assert!((0..2000).all(|key| sorted.get(&key) == tree.get(&key)));
            let mut ascending = SortedMap::default();
            tree.into_iter().for_each(|(key, value)| {
                ascending.insert(key, value);
            });
            assert_eq!(ascending, sorted);
        }
    }
}
