//! Tables: typed columns and cells, with a renderer for each format.

mod blocks;
mod cell;
mod column;
mod csv;
mod html;
mod json;
mod latex;
mod markdown;
mod room;
mod terminal;
mod text;
mod words;

pub(crate) use blocks::{HEAD_PT, NAME_PT, SMALL_SIZE, VALUE_SIZE};
pub use cell::{Cell, Estimate};
pub use column::{Align, Column, Direction};
pub use latex::{Layout, number as latex_number, symbol as latex_symbol};
pub(crate) use room::{COLUMN_PT, GAP_PT, letters_pt, stacked};
pub use words::Words;

use taceva_metrics::Better;

/// Table with heads and rows.
///
/// # Shapes
/// Every row has one cell for each column.
///
/// ```
/// use taceva_report::{Column, Table};
/// let mut table = Table::new("Models", [Column::new("model"), Column::new("fit").unit("s")]);
/// table.push(["ridge", "0.25"]);
/// assert_eq!(table.csv(), "model,fit (s)\nridge,0.25\n");
/// assert_eq!(table.markdown(), "| model | fit (s) |\n|---|---:|\n| ridge | 0.25 |\n");
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Table {
    /// Title; omitted in text and LaTeX if empty.
    pub caption: String,
    /// Columns, from left to right.
    pub columns: Vec<Column>,
    /// Rows, from top to bottom.
    pub rows: Vec<Row>,
    /// Remarks below the rows.
    pub notes: Vec<Words>,
}

/// Row of a table.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Row {
    /// One cell for each column.
    pub cells: Vec<Cell>,
    /// Better direction of this row, for a column of [`Direction::OfRows`]; `None` for no direction.
    pub better: Option<Better>,
    /// True if LaTeX separates this row from the previous row.
    pub begins_group: bool,
    /// Heading above this row, only in LaTeX, such as the metric of the following rows.
    pub heading: Option<Words>,
}

impl Row {
    /// Text of each cell without markup.
    pub fn plain(&self) -> Vec<String> {
        self.cells.iter().map(Cell::plain).collect()
    }
}

impl Table {
    /// Table without rows.
    pub fn new<C: Into<Column>>(
        caption: impl Into<String>,
        columns: impl IntoIterator<Item = C>,
    ) -> Table {
        Table {
            caption: caption.into(),
            columns: columns.into_iter().map(Into::into).collect(),
            ..Table::default()
        }
    }

    /// Adds a row. A column of [`Direction::OfMetrics`] determines the better direction of the row.
    pub fn push<C: Into<Cell>>(&mut self, cells: impl IntoIterator<Item = C>) {
        let cells: Vec<Cell> = cells.into_iter().map(Into::into).collect();
        let column = self.column_of(Direction::OfMetrics);
        let metric = column.and_then(|column| cells.get(column));
        let better = metric.and_then(|cell| Better::of(&cell.plain()));
        self.push_directed(better, cells);
    }

    /// Adds a row with the better direction `better`.
    pub fn push_directed<C: Into<Cell>>(
        &mut self,
        better: Option<Better>,
        cells: impl IntoIterator<Item = C>,
    ) {
        self.rows.push(Row {
            cells: cells.into_iter().map(Into::into).collect(),
            better,
            ..Row::default()
        });
    }

    /// Adds a remark below the rows.
    pub fn note(&mut self, words: impl Into<Words>) {
        self.notes.push(words.into());
    }

    /// Adds remarks below the rows.
    pub fn note_all(&mut self, all: impl IntoIterator<Item = impl Into<Words>>) {
        all.into_iter().for_each(|words| self.note(words));
    }

    /// Position of the first column with this direction; `None` if there is no such column.
    fn column_of(&self, direction: Direction) -> Option<usize> {
        let mut columns = self.columns.iter();
        columns.position(|column| column.direction == direction)
    }

    /// True if a column is right-aligned, by its setting or because all its non-empty cells are numbers.
    fn is_right(&self, column: usize) -> bool {
        match self.columns[column].align {
            Align::Left => false,
            Align::Right => true,
            Align::Auto | Align::ByCell => {
                let cells = || self.rows.iter().map(|row| &row.cells[column]);
                cells().all(|cell| cell.is_number() || cell.is_blank())
                    && cells().any(Cell::is_number)
            }
        }
    }

    /// Words of a row for readers, with the direction sign after the cell that names the row.
    fn words_of(&self, row: &Row) -> Vec<Words> {
        let cells = self.columns.iter().zip(&row.cells);
        let cells = cells.map(|(column, cell)| {
            let better = row.better.filter(|_| column.direction.is_by_row());
            cell.words().directed(better)
        });
        cells.collect()
    }

    /// Column heads and cells for programs, with the direction as a word in a column `better`.
    fn for_programs(&self) -> (Vec<String>, Vec<Vec<Cell>>) {
        let directed = self.columns.iter();
        let directed = directed.map(|column| column.direction.is_by_row());
        let directed: Vec<bool> = directed.collect();
        let mut head = Vec::new();
        for (column, is_directed) in self.columns.iter().zip(&directed) {
            head.push(column.title());
            head.extend(is_directed.then(|| "better".to_owned()));
        }
        let row = |row: &Row| {
            let mut cells = Vec::new();
            for (cell, is_directed) in row.cells.iter().zip(&directed) {
                cells.push(cell.clone());
                let word = row.better.map_or("", Better::name);
                cells.extend(is_directed.then(|| Cell::text(word)));
            }
            cells
        };
        (head, self.rows.iter().map(row).collect())
    }
}

#[cfg(test)]
mod tests;
