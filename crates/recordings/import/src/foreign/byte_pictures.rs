//! Encoded pictures in the cells of a column, each the bytes of a picture file.

use std::fmt;
use std::path::Path;
use std::sync::Arc;

use taceva_tables::{ArrowTable, Cell, ColumnKind, LeRobot, ParquetTable, TableError};

use super::pictures::{Ended, Picture, Pictures, Visit, guarded_visit};
use super::said;
use crate::error::ImportError;
use taceva_dataset::ChannelOrder;

/// Callback that receives the bytes of each cell.
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

    /// Kind of a column's values, or of the innermost values of its lists.
    fn kind_within(&self, name: &str) -> Option<ColumnKind> {
        let mut kind = self.kind_of(name).ok()?;
        while let ColumnKind::List(element) = kind {
            kind = *element;
        }
        Some(kind)
    }

    /// Unit of the times in a column, or in its lists.
    fn unit_of_times(&self, name: &str) -> Option<&'static str> {
        match self.kind_within(name)? {
            ColumnKind::Time(unit) => Some(unit),
            _ => None,
        }
    }

    /// The cell, or null if the form marks it as absent.
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

/// The readers of all forms have the same methods, except for the getter of the path.
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
    // LeRobot reads no null among numbers, so NaN alone marks an absent one.
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
