//! Tables: typed columns and cells, and one renderer for each format.

mod cell;
mod column;
mod csv;
mod html;
mod json;
mod latex;
mod markdown;
mod text;
mod words;

pub use cell::{Cell, Estimate};
pub use column::{Align, Column, Direction};
pub use latex::{Layout, number as latex_number, symbol as latex_symbol};
pub use words::Words;

use taceva_metrics::Better;

/// Rows of cells below the heads of columns.
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
    /// The title; text and LaTeX leave an empty one out.
    pub caption: String,
    /// The columns.
    pub columns: Vec<Column>,
    /// The rows.
    pub rows: Vec<Row>,
    /// Remarks below the rows.
    pub notes: Vec<Words>,
}

/// One row of a table.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Row {
    /// A cell for each column.
    pub cells: Vec<Cell>,
    /// Whether lower or higher values of this row are better; used with a column of [`Direction::OfRows`].
    pub better: Option<Better>,
    /// Whether LaTeX sets this row apart from the one above it.
    pub begins_group: bool,
}

impl Row {
    /// What each cell says, without markup.
    pub fn plain(&self) -> Vec<String> {
        self.cells.iter().map(Cell::plain).collect()
    }
}

impl Table {
    /// A table without rows.
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

    /// Adds a row. In a table with a column of [`Direction::OfMetrics`] the direction is that of the metric.
    pub fn push<C: Into<Cell>>(&mut self, cells: impl IntoIterator<Item = C>) {
        let cells: Vec<Cell> = cells.into_iter().map(Into::into).collect();
        let column = self.column_of(Direction::OfMetrics);
        let metric = column.and_then(|column| cells.get(column));
        let better = metric.and_then(|cell| Better::of(&cell.plain()));
        self.push_directed(better, cells);
    }

    /// Adds a row of which lower or higher numbers are better, as `better` says.
    pub fn push_directed<C: Into<Cell>>(
        &mut self,
        better: Option<Better>,
        cells: impl IntoIterator<Item = C>,
    ) {
        self.rows.push(Row {
            cells: cells.into_iter().map(Into::into).collect(),
            better,
            begins_group: false,
        });
    }

    /// Adds a remark below the rows.
    pub fn note(&mut self, words: impl Into<Words>) {
        self.notes.push(words.into());
    }

    /// The position of the first column with such a direction.
    fn column_of(&self, direction: Direction) -> Option<usize> {
        let mut columns = self.columns.iter();
        columns.position(|column| column.direction == direction)
    }

    /// Whether the numbers of a column stand to the right: as it says, or because it holds at least one number and nothing but numbers.
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

    /// The words of a row as people read them: with the sign of the direction behind the cell that names what the row is of.
    fn words_of(&self, row: &Row) -> Vec<Words> {
        let cells = self.columns.iter().zip(&row.cells);
        let cells = cells.map(|(column, cell)| {
            let better = row.better.filter(|_| column.direction.is_by_row());
            cell.words().directed(better)
        });
        cells.collect()
    }

    /// The heads of the columns and the cells of every row as programs read them: the direction is a word in a column `better`.
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
