//! Order of keys in rows that are read block by block. If the keys ascend and are equal in both tables, rows are paired by number.

use std::sync::{Mutex, PoisonError};

use taceva_import::CsvTable;

use super::key_parts::by_length;
use super::row_key::{KeyPair, key_of};

/// Keys of both tables in the blocks that were read. Blocks may be added in any order.
#[derive(Debug)]
pub(super) struct KeyOrder {
    /// Key columns in the truth and in the predictions.
    columns: [usize; 2],
    /// Number of each block read, with its first and last key.
    ends: Mutex<Vec<(u64, [String; 2])>>,
}

impl KeyOrder {
    /// Order of `key` in two tables with these headers; `None` if a table lacks the key.
    pub(super) fn of([truth, prediction]: [&CsvTable; 2], key: &KeyPair) -> Option<KeyOrder> {
        Some(KeyOrder {
            columns: [
                truth.position(&key.truth).ok()?,
                prediction.position(&key.prediction).ok()?,
            ],
            ends: Mutex::default(),
        })
    }

    /// True if the keys of a block ascend and are equal in both tables. Both tables must have the same number of rows in the block.
    pub(super) fn is_kept_in(&self, number: u64, [truth, prediction]: [&CsvTable; 2]) -> bool {
        let rows = 0..truth.rows();
        let keys = truth.text_in(self.columns[0], rows.clone()).map(key_of);
        let others = prediction.text_in(self.columns[1], rows).map(key_of);
        let mut ends: Option<[&str; 2]> = None;
        for (key, other) in keys.zip(others) {
            let ascends = ends.is_none_or(|[_, last]| by_length(last, key).is_lt());
            if key != other || key.is_empty() || !ascends {
                return false;
            }
            ends = Some([ends.map_or(key, |[first, _]| first), key]);
        }
        if let Some(ends) = ends {
            let mut all = self.ends.lock().unwrap_or_else(PoisonError::into_inner);
            all.push((number, ends.map(str::to_owned)));
        }
        true
    }

    /// True if the keys also ascend from block to block, so that no key repeats.
    pub(super) fn ascends(self) -> bool {
        let ends = self.ends.into_inner();
        let mut ends = ends.unwrap_or_else(PoisonError::into_inner);
        ends.sort_unstable();
        ends.windows(2)
            .all(|pair| by_length(&pair[0].1[1], &pair[1].1[0]).is_lt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(keys: &[&str]) -> CsvTable {
        let rows = keys.iter().map(|key| [*key, "1"]);
        CsvTable::of_cells("table.csv".as_ref(), &["id", "Fz"], rows).expect("a table")
    }

    fn id() -> KeyPair {
        KeyPair {
            truth: "id".to_owned(),
            prediction: "id".to_owned(),
        }
    }

    /// Test helper: true if keys ascend in blocks that are added in this order.
    fn is_kept(blocks: &[(u64, &[&str])]) -> bool {
        let header = table(&[]);
        let order = KeyOrder::of([&header, &header], &id()).expect("keys");
        let each = blocks.iter().all(|(number, keys)| {
            let block = table(keys);
            order.is_kept_in(*number, [&block, &block])
        });
        each && order.ascends()
    }

    #[test]
    fn keys_that_ascend_from_row_to_row_and_from_block_to_block_are_in_order() {
        assert!(is_kept(&[(0, &["8", "9"]), (1, &["10", "11"])]));
        assert!(is_kept(&[(1, &["s3", "s4"]), (2, &[]), (0, &["s1", "s2"])]));
        assert!(is_kept(&[(0, &["1.0", "2"])]));
        assert!(!is_kept(&[(0, &["1", "1"])]));
        assert!(!is_kept(&[(0, &["", "1"])]));
        assert!(!is_kept(&[(0, &["2", "1"])]));
        assert!(!is_kept(&[(0, &["1", "2"]), (1, &["2", "3"])]));
        assert!(!is_kept(&[(1, &["1", "2"]), (0, &["3", "4"])]));
    }

    #[test]
    fn other_keys_in_the_other_table_are_not_in_order() {
        let header = table(&[]);
        let order = KeyOrder::of([&header, &header], &id()).expect("keys");
        assert!(!order.is_kept_in(0, [&table(&["1", "2"]), &table(&["1", "3"])]));
        let bare = CsvTable::of_cells("bare.csv".as_ref(), &["Fz"], [["1"]]);
        assert!(KeyOrder::of([&header, &bare.expect("a table")], &id()).is_none());
    }
}
