//! Reader of cells that hold bytes, in one row group. Pages in the encoding `PLAIN` are streamed, and other pages are decoded as a whole.

use parquet::file::metadata::RowGroupMetaData;

use super::assembly::Assembly;
use super::column_path::Found;
use super::stream::Stream;
use crate::cell::Cell;
use crate::error::TableError;
use crate::source::Source;

/// Reader of cells that hold bytes, in one row group, one cell after another.
pub(super) enum Cells {
    Stream(Box<Stream>),
    Assembly(Assembly),
}

impl Cells {
    pub(super) fn new(
        source: &Source,
        group: &RowGroupMetaData,
        found: &Found,
    ) -> Result<Cells, TableError> {
        let chunk = found
            .leaf_of_bytes()
            .and_then(|column| group.columns().get(column));
        let stream = match chunk {
            Some(chunk) => Stream::new(source, chunk)?,
            None => None,
        };
        Ok(match stream {
            Some(stream) => Cells::Stream(Box::new(stream)),
            None => Cells::Assembly(Assembly::new(source, group, found.column())?),
        })
    }

    pub(super) fn skip(&mut self, rows: u64) -> Result<(), TableError> {
        match self {
            Cells::Stream(stream) => stream.skip(rows),
            Cells::Assembly(assembly) => assembly.skip(usize::try_from(rows).unwrap_or(usize::MAX)),
        }
    }

    pub(super) fn next(
        &mut self,
        source: &Source,
        found: &Found,
        row: u64,
    ) -> Result<Option<Vec<u8>>, TableError> {
        let assembly = match self {
            Cells::Stream(stream) => return stream.next(),
            Cells::Assembly(assembly) => assembly,
        };
        let row = usize::try_from(row).unwrap_or(usize::MAX);
        let mut cell = Cell::Null;
        assembly.read(source, 1, &mut |read| {
            cell = found.inside(source, row, read)?;
            Ok(())
        })?;
        match cell {
            Cell::Null => Ok(None),
            Cell::Bytes(bytes) => Ok(Some(bytes)),
            Cell::Text(text) => Ok(Some(text.into_bytes())),
            _ => Err(source.mismatch(found.name(), "it holds no bytes")),
        }
    }
}
