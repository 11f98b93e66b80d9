//! Gathers selected rows of columns.

use std::ops::Range;

use taceva_core::Column;

/// Values of the most recently gathered rows. The next call reuses the memory.
#[derive(Clone, Debug, Default)]
pub(crate) struct Gathered {
    columns: Vec<Vec<f64>>,
}

impl Gathered {
    /// Values of each of `columns` in `rows`, which ascend, or in all rows if `rows` is `None`. Rows with a missing value are skipped. Consecutive
    /// rows without missing values are borrowed from the columns.
    pub(crate) fn rows<'a>(
        &'a mut self,
        columns: &[&'a Column],
        rows: Option<&[u32]>,
    ) -> Vec<&'a [f64]> {
        let is_full = columns.iter().all(|column| column.present().is_none());
        if is_full && rows.is_none() {
            return columns.iter().map(|column| column.values()).collect();
        }
        if let Some(range) = rows.and_then(side_by_side).filter(|_| is_full) {
            let values = columns.iter().map(|column| &column.values()[range.clone()]);
            return values.collect();
        }
        let all = columns.first().map_or(0, |column| column.len());
        let complete: Option<Vec<u32>> = (!is_full).then(|| {
            let has_all = |row: &u32| {
                let mut present = columns.iter().filter_map(|column| column.present());
                present.all(|present| present[*row as usize])
            };
            match rows {
                Some(rows) => rows.iter().copied().filter(has_all).collect(),
                None => (0..all)
                    .filter_map(|row| u32::try_from(row).ok())
                    .filter(has_all)
                    .collect(),
            }
        });
        let rows = complete.as_deref().or(rows).unwrap_or_default();
        self.columns.resize_with(columns.len(), Vec::new);
        for (gathered, column) in self.columns.iter_mut().zip(columns) {
            let values = column.values();
            gathered.clear();
            gathered.extend(rows.iter().map(|&row| values[row as usize]));
        }
        self.columns.iter().map(Vec::as_slice).collect()
    }
}

/// The rows as a range, if they are consecutive.
fn side_by_side(rows: &[u32]) -> Option<Range<usize>> {
    let (&first, &last) = (rows.first()?, rows.last()?);
    let range = first as usize..last as usize + 1;
    (range.len() == rows.len()).then_some(range)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_in_which_a_column_has_no_value_are_left_out() {
        let full = Column::full(vec![1.0, 2.0, 3.0, 4.0]);
        let partly: Column = [Some(5.0), None, Some(7.0), Some(8.0)]
            .into_iter()
            .collect();
        let mut gathered = Gathered::default();
        assert_eq!(gathered.rows(&[&full, &full], None), [full.values(); 2]);
        let expected: [&[f64]; 2] = [&[1.0, 3.0, 4.0], &[5.0, 7.0, 8.0]];
        assert_eq!(gathered.rows(&[&full, &partly], None), expected);
        let expected: [&[f64]; 2] = [&[1.0, 4.0], &[5.0, 8.0]];
        assert_eq!(gathered.rows(&[&full, &partly], Some(&[0, 1, 3])), expected);
        let expected: [&[f64]; 1] = [&[2.0, 4.0]];
        assert_eq!(gathered.rows(&[&full], Some(&[1, 3])), expected);
        assert_eq!(
            gathered.rows(&[&full], Some(&[1, 2, 3])),
            [&full.values()[1..]]
        );
        let nothing: [&[f64]; 1] = [&[]];
        assert_eq!(gathered.rows(&[&full], Some(&[])), nothing);
    }
}
