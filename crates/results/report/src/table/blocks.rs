//! Divides tables wider than a page of a paper into blocks of columns.

use super::room::{GAP_PT, letters_pt};
use super::{Cell, Row, Table};

/// Greatest width of a row name and of a column head, in TeX points. Wider names have several lines.
pub(crate) const NAME_PT: f64 = 62.0;
pub(crate) const HEAD_PT: f64 = 50.0;
/// Font size of values, in points. [`SMALL_SIZE`] is the size of heads and of the line below a value.
pub(crate) const VALUE_SIZE: f64 = 8.0;
pub(crate) const SMALL_SIZE: f64 = 7.0;
/// Ratio of the width of bold digits to the width of regular digits.
const BOLD: f64 = 1.2;

impl Table {
    /// Approximate width of the table, in TeX points.
    pub(super) fn width_pt(&self) -> f64 {
        let columns = 0..self.columns.len();
        columns.map(|column| self.column_pt(column)).sum()
    }

    /// Blocks of at most `width_pt`, with about equally many columns of values. Each block repeats the columns of names.
    pub(super) fn blocks(&self, width_pt: f64) -> Vec<Table> {
        let names = (0..self.columns.len())
            .take_while(|column| self.has_only_text(*column))
            .count();
        let values: Vec<usize> = (names..self.columns.len()).collect();
        if values.is_empty() || self.width_pt() <= width_pt {
            return vec![self.clone()];
        }
        let name_pt: f64 = (0..names).map(|column| self.column_pt(column)).sum();
        let widest = values.iter().map(|column| self.column_pt(*column));
        let widest = widest.fold(1.0, f64::max);
        let most = (1..values.len())
            .take_while(|count| name_pt + (*count + 1) as f64 * widest <= width_pt)
            .count()
            + 1;
        let blocks = values.len().div_ceil(most);
        let each = values.len().div_ceil(blocks);
        let parts = values.chunks(each);
        let parts = parts.map(|part| {
            let columns: Vec<usize> = (0..names).chain(part.iter().copied()).collect();
            self.of_columns(&columns)
        });
        parts.collect()
    }

    /// Table with only the selected columns.
    pub(super) fn of_columns(&self, columns: &[usize]) -> Table {
        let rows = self.rows.iter().map(|row| Row {
            cells: columns.iter().map(|at| row.cells[*at].clone()).collect(),
            ..row.clone()
        });
        Table {
            columns: columns.iter().map(|at| self.columns[*at].clone()).collect(),
            rows: rows.collect(),
            ..self.clone()
        }
    }

    fn has_only_text(&self, column: usize) -> bool {
        let mut rows = self.rows.iter();
        rows.all(|row| matches!(row.cells[column], Cell::Text(_)))
    }

    /// Width of a column and the gap next to it, in TeX points.
    fn column_pt(&self, column: usize) -> f64 {
        let head = self.columns[column].head();
        let head = letters_pt(head.plain(), SMALL_SIZE).min(HEAD_PT);
        let cells = self.rows.iter().map(|row| row.cells[column].width_pt());
        cells.fold(head, f64::max) + GAP_PT
    }
}

impl Cell {
    fn width_pt(&self) -> f64 {
        match self {
            Cell::Text(words) => letters_pt(words.plain(), VALUE_SIZE).min(NAME_PT),
            Cell::Estimate(estimate) => {
                let value = format!("{}{}", estimate.formatted.value, estimate.mark);
                let wider = if estimate.is_best { BOLD } else { 1.0 };
                let remark = estimate.remark.as_deref().unwrap_or_default();
                letters_pt(&value, VALUE_SIZE * wider).max(letters_pt(remark, SMALL_SIZE))
            }
            Cell::Number(_) | Cell::Rounded { .. } | Cell::Verdict(_) => {
                letters_pt(&self.plain(), VALUE_SIZE)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wide_table_has_blocks_of_equally_many_columns_beside_its_names() {
        let mut table = Table::new("", ["plane", "a", "b", "c", "d", "e"]);
        let values = ["0.1000"; 5].map(Cell::from);
        table.push([Cell::text("Fz")].into_iter().chain(values));
        let heads = |width_pt: f64| -> Vec<String> {
            let blocks = table.blocks(width_pt);
            let heads = blocks.iter().map(|block| {
                let names = block.columns.iter().map(|column| column.name.plain());
                names.collect::<Vec<_>>().join(" ")
            });
            heads.collect()
        };
        assert_eq!(heads(1.01 * table.width_pt()), ["plane a b c d e"]);
        assert_eq!(heads(0.9 * table.width_pt()), ["plane a b c", "plane d e"]);
        assert_eq!(heads(0.0).len(), 5);
    }
}
