//! Least-recently-used cache with a limit in bytes.

use std::collections::BTreeMap;
use std::sync::Arc;

/// Values by key. The least recently used values are removed first.
#[derive(Debug)]
pub(crate) struct Cache<K, T> {
    most_bytes: u64,
    bytes: u64,
    turn: u64,
    /// For each key: the turn of the last use, the size in bytes, and the value.
    values: BTreeMap<K, (u64, u64, Arc<T>)>,
    by_turn: BTreeMap<u64, K>,
}

impl<K: Ord + Clone, T> Cache<K, T> {
    pub(crate) fn new(most_bytes: u64) -> Cache<K, T> {
        Cache {
            most_bytes,
            bytes: 0,
            turn: 0,
            values: BTreeMap::new(),
            by_turn: BTreeMap::new(),
        }
    }

    pub(crate) fn get(&mut self, key: &K) -> Option<Arc<T>> {
        self.turn += 1;
        let (turn, _, value) = self.values.get_mut(key)?;
        if let Some(key) = self.by_turn.remove(turn) {
            self.by_turn.insert(self.turn, key);
        }
        *turn = self.turn;
        Some(Arc::clone(value))
    }

    /// Stores a value of `bytes` bytes. Removes the least recently used values above the limit, but never the newest value.
    pub(crate) fn keep(&mut self, key: K, bytes: u64, value: Arc<T>) {
        self.turn += 1;
        self.by_turn.insert(self.turn, key.clone());
        self.bytes += bytes;
        if let Some((turn, bytes, _)) = self.values.insert(key, (self.turn, bytes, value)) {
            self.by_turn.remove(&turn);
            self.bytes -= bytes;
        }
        while self.bytes > self.most_bytes && self.values.len() > 1 {
            let Some((_, oldest)) = self.by_turn.pop_first() else {
                break;
            };
            if let Some((_, bytes, _)) = self.values.remove(&oldest) {
                self.bytes -= bytes;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_one_that_nobody_asked_for_longest_is_dropped_first() {
        let mut kept = Cache::new(10);
        kept.keep('a', 4, Arc::new(1));
        kept.keep('b', 4, Arc::new(2));
        assert_eq!(kept.get(&'a').as_deref(), Some(&1));
        kept.keep('c', 4, Arc::new(3));
        assert_eq!(kept.get(&'b'), None);
        assert_eq!(kept.get(&'a').as_deref(), Some(&1));
        kept.keep('d', 40, Arc::new(4));
        assert_eq!(
            kept.get(&'d').as_deref(),
            Some(&4),
            "larger than all may be"
        );
        assert_eq!(kept.get(&'a'), None);
        kept.keep('d', 1, Arc::new(5));
        assert_eq!(
            (kept.bytes, kept.values.len(), kept.by_turn.len()),
            (1, 1, 1)
        );
    }
}
