//! Summaries by contact point and depth, for scores that compare presses at one place.

use std::collections::BTreeMap;
use std::sync::Arc;

use taceva_core::{Batch, Labels};

use crate::exact::merge::{Merge, keyed};
use crate::exact::record::Record;
use crate::exact::sorted_map::SortedMap;

/// Key of a cell of comparable presses: a contact point, with a depth step if the metric separates depths.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct CellKey {
    point: Option<Arc<str>>,
    step: u32,
    /// Number of the copy of a contact point, because a bootstrap replicate may contain it several times; otherwise 0.
    copy: u32,
}

impl CellKey {
    /// Depth step of the cell.
    pub(crate) fn step(&self) -> u32 {
        self.step
    }

    /// Key as text for a saved state: depth step and contact point, as in `3:point 7`. Empty without a contact point.
    fn to_text(&self) -> String {
        let point = self.point.as_ref();
        point.map_or_else(String::new, |point| format!("{}:{point}", self.step))
    }

    fn from_text(text: &str) -> Option<CellKey> {
        if text.is_empty() {
            return Some(CellKey::default());
        }
        let (step, point) = text.split_once(':')?;
        let parsed = step.parse::<u32>().ok()?;
        (parsed.to_string() == step).then(|| CellKey {
            point: Some(point.into()),
            step: parsed,
            copy: 0,
        })
    }
}

/// One summary `V` for each cell of presses. Copies of a contact point share a summary, so its statistics are computed once.
///
/// One row without a contact point merges all cells permanently, because the presses cannot be grouped. The order of rows has no effect.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Cells<V> {
    cells: SortedMap<CellKey, Arc<V>>,
    named: bool,
}

impl<V> Default for Cells<V> {
    fn default() -> Cells<V> {
        Cells {
            cells: SortedMap::default(),
            named: true,
        }
    }
}

/// Access to the cell of each row of a batch.
pub(crate) struct BatchCells<'a, V> {
    cells: &'a mut Cells<V>,
    labels: Option<&'a Labels>,
}

impl<V: Merge + Clone + Default> BatchCells<'_, V> {
    /// Mutable summary of the cell of `row` at depth step `step`.
    pub(crate) fn at(&mut self, row: usize, step: u32) -> &mut V {
        let point = self.labels.and_then(|labels| labels.get(row));
        self.cells.at(point, step)
    }
}

impl<V: Merge + Clone + Default> Cells<V> {
    /// Access to the cells of `batch`. A batch without contact points merges all cells, even if few of its rows are added.
    pub(crate) fn of_batch<'a>(&'a mut self, batch: &'a Batch) -> BatchCells<'a, V> {
        self.of_labels(batch.points(), batch.rows())
    }

    /// Access to the cells of `rows` rows. `labels` has the contact point of each row; `None` merges all cells.
    pub(crate) fn of_labels<'a>(
        &'a mut self,
        labels: Option<&'a Labels>,
        rows: usize,
    ) -> BatchCells<'a, V> {
        if labels.is_none() && rows > 0 {
            self.forget_names();
        }
        BatchCells {
            cells: self,
            labels,
        }
    }

    /// True if every added row had a contact point.
    pub(crate) fn are_named(&self) -> bool {
        self.named
    }

    /// Cells in the order of their keys.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (&CellKey, &V)> {
        self.cells.iter().map(|(key, cell)| (key, cell.as_ref()))
    }

    /// Number of cells.
    pub(crate) fn len(&self) -> usize {
        self.cells.len()
    }

    /// Mutable summary of the cell of `point` at depth step `step`. `None` merges all cells.
    fn at(&mut self, point: Option<&str>, step: u32) -> &mut V {
        let key = match point {
            Some(point) if self.named => CellKey {
                point: Some(point.into()),
                step,
                copy: 0,
            },
            Some(_) => CellKey::default(),
            None => {
                self.forget_names();
                CellKey::default()
            }
        };
        Arc::make_mut(self.cells.entry(key))
    }

    /// Merges all cells into one.
    pub(crate) fn forget_names(&mut self) {
        if !self.named {
            return;
        }
        self.named = false;
        let mut all: Option<V> = None;
        for (_, cell) in &std::mem::take(&mut self.cells) {
            all.get_or_insert_default().merge(cell);
        }
        if let Some(all) = all {
            self.cells.insert(CellKey::default(), Arc::new(all));
        }
    }

    fn join(&mut self, key: &CellKey, cell: &Arc<V>, copy: u32) {
        let key = match self.named {
            true => CellKey {
                copy,
                ..key.clone()
            },
            false => CellKey::default(),
        };
        match self.cells.get_mut(&key) {
            Some(ours) => Arc::make_mut(ours).merge(cell),
            None => {
                self.cells.insert(key, Arc::clone(cell));
            }
        }
    }

    /// Converts each cell to a record, by the text of its key.
    pub(crate) fn to_records(&self, to_record: impl Fn(&V) -> Record) -> BTreeMap<String, Record> {
        let cells = self.cells.iter();
        keyed(cells.map(|(key, cell)| (key.to_text(), to_record(cell))))
    }

    /// Reads the cells of a record. Every key must have a contact point if `named`, and none otherwise.
    pub(crate) fn from_record(
        record: &Record,
        named: bool,
        read: impl Fn(&Record) -> Result<V, String>,
    ) -> Result<Cells<V>, String> {
        let cells = record.read_cells(CellKey::from_text, |record| read(record).map(Arc::new))?;
        match cells.iter().find(|(key, _)| key.point.is_some() != named) {
            Some((key, _)) => Err(format!(
                "cell `{}` does not fit a state {} locations",
                key.to_text(),
                if named { "with" } else { "without" }
            )),
            None => Ok(Cells { cells, named }),
        }
    }
}

impl<V: Merge + Clone + Default> Merge for Cells<V> {
    fn merge(&mut self, other: &Cells<V>) {
        self.merge_times(other, 1);
    }

    fn merge_times(&mut self, other: &Cells<V>, times: u32) {
        if !other.named && times > 0 {
            self.forget_names();
        }
        for copy in 0..times {
            for (key, cell) in &other.cells {
                self.join(key, cell, copy);
            }
        }
    }
}

/// Adds `other` × `times` to `count`, limited to the greatest `u64`.
pub(crate) fn add_times(count: &mut u64, other: u64, times: u32) {
    *count = count.saturating_add(other.saturating_mul(u64::from(times)));
}

#[cfg(test)]
mod tests {
    use taceva_core::{Channel, Channels, Column};

    use super::*;
    use crate::exact::moments::Moments;

    fn cells(rows: &[(Option<&str>, u32, f64)]) -> Cells<Moments> {
        let mut cells = Cells::default();
        for &(point, step, value) in rows {
            let cell: &mut Moments = cells.at(point, step);
            cell.add(value);
        }
        cells
    }

    #[test]
    fn one_row_without_location_makes_all_cells_one_whenever_it_comes() {
        let rows = [(Some("a"), 0, 1.0), (Some("b"), 2, 2.0), (None, 0, 4.0)];
        let first = cells(&rows);
        let last: Vec<_> = rows.into_iter().rev().collect();
        assert_eq!(first, cells(&last));
        assert_eq!((first.len(), first.are_named()), (1, false));
        let mut merged = cells(&rows[..2]);
        merged.merge(&cells(&rows[2..]));
        assert_eq!(merged, first);
        let mut other_way = cells(&rows[2..]);
        other_way.merge(&cells(&rows[..2]));
        assert_eq!(other_way, first);
    }

    #[test]
    fn a_batch_without_locations_makes_all_cells_one_even_if_none_of_its_rows_count() {
        let channels = Channels::new([Channel::FZ]).expect("one");
        let batch = |rows: usize| {
            let [truth, prediction] = [0, 1].map(|_| Column::full(vec![0.5; rows]));
            Batch::from_columns(channels.clone(), vec![truth], vec![prediction], None)
        };
        let mut named = cells(&[(Some("a"), 0, 1.0), (Some("b"), 2, 2.0)]);
        let _ = named.of_batch(&batch(0));
        assert_eq!((named.len(), named.are_named()), (2, true));
        let _ = named.of_batch(&batch(3));
        assert_eq!((named.len(), named.are_named()), (1, false));
    }

    #[test]
    fn a_location_drawn_twice_stands_there_twice() {
        let mut drawn = Cells::default();
        drawn.merge_times(&cells(&[(Some("a"), 0, 1.0)]), 2);
        drawn.merge_times(&cells(&[(Some("b"), 0, 1.0)]), 0);
        assert_eq!(drawn.len(), 2);
        assert!(drawn.iter().all(|(_, cell)| cell.n == 1));
    }

    #[test]
    fn a_key_is_read_as_it_was_written_and_no_other_way() {
        for (point, step) in [("", 0), ("3:4", 7), ("point:", u32::MAX)] {
            let key = CellKey {
                point: Some(point.into()),
                step,
                copy: 0,
            };
            assert_eq!(CellKey::from_text(&key.to_text()), Some(key));
        }
        for text in ["a", "+1:a", "01:a", ":a", "4294967296:a"] {
            assert_eq!(CellKey::from_text(text), None, "{text}");
        }
    }
}
