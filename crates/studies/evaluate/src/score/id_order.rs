//! Whether rows that come block by block are paired by `id` as they stand: the same ids in both tables, each above the one before.

use std::sync::{Mutex, PoisonError};

use taceva_import::CsvTable;

use super::ids::{ID, by_length};

/// The ids of both tables, as far as blocks of them were seen, in whatever order.
#[derive(Debug)]
pub(super) struct IdOrder {
    /// Where ids stand in the truth and in the prediction.
    columns: [usize; 2],
    /// The number of each block that was seen, with its first id and its last.
    ends: Mutex<Vec<(u64, [String; 2])>>,
}

impl IdOrder {
    /// Of two tables that both have ids; `None` of others.
    pub(super) fn of(truth: &CsvTable, prediction: &CsvTable) -> Option<IdOrder> {
        let column = |table: &CsvTable| table.position(ID).ok();
        Some(IdOrder {
            columns: [column(truth)?, column(prediction)?],
            ends: Mutex::default(),
        })
    }

    /// Whether the ids of a block ascend and are the same in both tables; they have as many rows.
    pub(super) fn is_kept_in(&self, number: u64, [truth, prediction]: [&CsvTable; 2]) -> bool {
        let rows = 0..truth.rows();
        let ids = truth.text_in(self.columns[0], rows.clone());
        let others = prediction.text_in(self.columns[1], rows);
        let mut ends: Option<[&str; 2]> = None;
        for (id, other) in ids.zip(others) {
            let ascends = ends.is_none_or(|[_, last]| by_length(last, id).is_lt());
            if id != other || !ascends {
                return false;
            }
            ends = Some([ends.map_or(id, |[first, _]| first), id]);
        }
        if let Some(ends) = ends {
            let mut all = self.ends.lock().unwrap_or_else(PoisonError::into_inner);
            all.push((number, ends.map(str::to_owned)));
        }
        true
    }

    /// Whether the ids of all blocks that were seen ascend from each to the next, so that none comes twice.
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

    fn table(ids: &[&str]) -> CsvTable {
        let rows = ids.iter().map(|id| [*id, "1"]);
        CsvTable::of_cells("table.csv".as_ref(), &["id", "Fz"], rows).expect("a table")
    }

    /// Whether order is kept in blocks that are seen in this order.
    fn is_kept(blocks: &[(u64, &[&str])]) -> bool {
        let header = table(&[]);
        let order = IdOrder::of(&header, &header).expect("ids");
        let each = blocks.iter().all(|(number, ids)| {
            let block = table(ids);
            order.is_kept_in(*number, [&block, &block])
        });
        each && order.ascends()
    }

    #[test]
    fn ids_that_ascend_from_row_to_row_and_from_block_to_block_are_in_order() {
        assert!(is_kept(&[(0, &["8", "9"]), (1, &["10", "11"])]));
        assert!(is_kept(&[(1, &["s3", "s4"]), (2, &[]), (0, &["s1", "s2"])]));
        assert!(!is_kept(&[(0, &["1", "1"])]));
        assert!(!is_kept(&[(0, &["2", "1"])]));
        assert!(!is_kept(&[(0, &["1", "2"]), (1, &["2", "3"])]));
        assert!(!is_kept(&[(1, &["1", "2"]), (0, &["3", "4"])]));
    }

    #[test]
    fn other_ids_in_the_other_table_are_not_in_order() {
        let header = table(&[]);
        let order = IdOrder::of(&header, &header).expect("ids");
        assert!(!order.is_kept_in(0, [&table(&["1", "2"]), &table(&["1", "3"])]));
        let bare = CsvTable::of_cells("bare.csv".as_ref(), &["Fz"], [["1"]]);
        assert!(IdOrder::of(&header, &bare.expect("a table")).is_none());
    }
}
