//! Encoded pictures in the cells of a column. Each cell contains the bytes of an image file.

use std::fmt;
use std::path::Path;
use std::sync::Arc;

use taceva_tables::{ArrowTable, Cell, ColumnKind, LeRobot, ParquetTable, TableError};

use super::pictures::{Ended, Picture, Pictures, Visit, guarded_visit};
use super::said;
use crate::error::ImportError;
use taceva_dataset::ChannelOrder;

/// Callback that receives each row number and the bytes of its cell; `None` for an empty cell.
type VisitBytes<'v> = &'v mut dyn FnMut(u64, Option<Vec<u8>>) -> Result<(), Ended<TableError>>;

/// Table with columns of bytes.
pub(super) trait ByteColumns: Sized + fmt::Debug + Send + Sync {
    fn place(&self) -> &Path;
    fn count(&self) -> u64;
    fn cells(&self, name: &str) -> Result<Vec<Cell>, TableError>;
    fn kind_of(&self, name: &str) -> Result<ColumnKind, TableError>;
    fn visit(
        &self,
        name: &str,
        sorted: &[u64],
        each: VisitBytes<'_>,
    ) -> Result<(), Ended<TableError>>;

    /// Kind of the values of a column, or of the innermost values if the column contains lists.
    fn kind_within(&self, name: &str) -> Option<ColumnKind> {
        let mut kind = self.kind_of(name).ok()?;
        while let ColumnKind::List(element) = kind {
            kind = *element;
        }
        Some(kind)
    }

    /// Unit of the times in a column or in its lists; `None` for other columns.
    fn unit_of_times(&self, name: &str) -> Option<&'static str> {
        match self.kind_within(name)? {
            ColumnKind::Time(unit) => Some(unit),
            _ => None,
        }
    }

    /// Returns the cell, or null if the form marks the cell as missing.
    fn present(cell: Cell) -> Cell {
        cell
    }

    /// Cells of columns as texts.
    fn texts(&self, names: &[&str]) -> Result<Vec<Vec<String>>, String> {
        let texts = |name: &&str| {
            let cells = self.cells(name);
            let cells = cells.map_err(|error| said(self.place(), &error))?;
            let texts = cells
                .into_iter()
                .map(|cell| Self::present(cell).text().into_owned());
            Ok(texts.collect())
        };
        names.iter().map(texts).collect()
    }
}

/// Implements [`ByteColumns`] for a reader. The readers of all forms have the same methods, except for the getter of the path.
macro_rules! byte_columns {
    ($table:ty, $place:ident $(, $present:item)?) => {
        impl ByteColumns for $table {
            $($present)?

            fn place(&self) -> &Path {
                self.$place()
            }

            fn count(&self) -> u64 {
                self.rows()
            }

            fn cells(&self, name: &str) -> Result<Vec<Cell>, TableError> {
                self.column(name)
            }

            fn kind_of(&self, name: &str) -> Result<ColumnKind, TableError> {
                self.kind(name)
            }

            fn visit(
                &self,
                name: &str,
                sorted: &[u64],
                each: VisitBytes<'_>,
            ) -> Result<(), Ended<TableError>> {
                self.visit_bytes(name, sorted, each)
            }
        }
    };
}

byte_columns!(ParquetTable, path);
byte_columns!(ArrowTable, path);
byte_columns!(
    LeRobot,
    folder,
    // LeRobot rejects nulls among numbers, so NaN marks an absent number.
    fn present(cell: Cell) -> Cell {
        match cell {
            Cell::Number(number) if number.is_nan() => Cell::Null,
            Cell::List(cells) => Cell::List(cells.into_iter().map(Self::present).collect()),
            cell => cell,
        }
    }
);

/// Encoded pictures in a column.
#[derive(Debug)]
pub(super) struct EncodedPictures<T> {
    pub(super) table: Arc<T>,
    pub(super) column: String,
}

impl<T: ByteColumns> Pictures for EncodedPictures<T> {
    fn path(&self) -> &Path {
        self.table.place()
    }

    fn count(&self) -> u64 {
        self.table.count()
    }

    fn visit(
        &self,
        sorted: &[u64],
        _order: ChannelOrder,
        each: Visit<'_>,
    ) -> Result<(), ImportError> {
        guarded_visit(self.path(), || {
            self.table.visit(&self.column, sorted, &mut |row, bytes| {
                let bytes = bytes.ok_or_else(|| {
                    let problem = format!("row {row} has no bytes in `{}`", self.column);
                    Ended::Picture(ImportError::image(self.path(), problem))
                })?;
                each(row, Picture::Encoded(bytes)).map_err(Ended::Picture)
            })
        })
    }
}
