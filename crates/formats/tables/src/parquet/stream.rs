//! Reader of cells that hold bytes, one at a time, from Parquet pages in the encoding `PLAIN`.
//!
//! Some writers put a thousand pictures into one page. Cells of plain pages are therefore read directly from the file or from a streaming decoder. The whole
//! page is not in memory. Only blocks of snappy and LZ4 are unpacked as a whole.

use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};
use std::sync::Arc;

use parquet::basic::Type as Physical;
use parquet::file::metadata::ColumnChunkMetaData;

use super::levels::Levels;
use super::page_header::{PageHeader, PageKind};
use super::pages::Pages;
use crate::codec::{self, Codec};
use crate::error::{Place, TableError};
use crate::limits;
use crate::source::Source;

/// Number of the encoding of plain values in the Parquet format. `RLE` is that of levels.
const PLAIN: i32 = 0;
const RLE: i32 = 3;

/// Reader of a column chunk of bytes outside lists. All its data pages have the encoding `PLAIN`.
pub(super) struct Stream {
    source: Source,
    name: String,
    pages: Pages,
    highest: i16,
    page: Option<Open>,
}

/// Page that is being read.
struct Open {
    at: u64,
    body: Body,
    levels: Option<Levels>,
    /// Number of entries of the page that are not read yet, including nulls.
    entries: u64,
    bytes: u64,
}

enum Body {
    /// Uncompressed values in the file. Cells are skipped by seeking.
    File(BufReader<File>),
    Unpacked(Box<dyn Read>),
}

impl Stream {
    /// Creates the reader of the cells of `chunk`; `None` if they are not byte strings outside lists, or if a page is not `PLAIN`.
    pub(super) fn new(
        source: &Source,
        chunk: &ColumnChunkMetaData,
    ) -> Result<Option<Stream>, TableError> {
        let column = chunk.column_descr();
        if column.physical_type() != Physical::BYTE_ARRAY || column.max_rep_level() > 0 {
            return Ok(None);
        }
        let highest = column.max_def_level();
        let name = chunk.column_path().string();
        let pages = || Pages::new(source, &name, chunk, Arc::default());
        let mut all = pages()?;
        while let Some((header, _)) = all.next_header()? {
            let is_read = match header.kind {
                PageKind::Data => {
                    header.encoding == PLAIN && (highest == 0 || header.definition_encoding == RLE)
                }
                PageKind::DataV2 => header.encoding == PLAIN && header.repetition_bytes == 0,
                PageKind::Index | PageKind::Dictionary => true,
            };
            if !is_read {
                return Ok(None);
            }
        }
        Ok(Some(Stream {
            source: source.clone(),
            pages: pages()?,
            name,
            highest,
            page: None,
        }))
    }

    /// Skips `rows` rows. Only the headers of skipped pages are read.
    pub(super) fn skip(&mut self, rows: u64) -> Result<(), TableError> {
        let mut left = rows;
        while left > 0 {
            match &mut self.page {
                Some(page) if page.entries > 0 => {
                    page.pass(self.highest)
                        .map_err(|problem| self.damaged(problem))?;
                    left -= 1;
                }
                _ => {
                    let (header, begin) = self.next_data()?;
                    match u64::from(header.values) {
                        values if values <= left => left -= values,
                        _ => self.page = Some(self.open(&header, begin)?),
                    }
                }
            }
        }
        Ok(())
    }

    /// Reads the cell of the next row; `None` if the cell is null.
    pub(super) fn next(&mut self) -> Result<Option<Vec<u8>>, TableError> {
        while self.page.as_ref().is_none_or(|page| page.entries == 0) {
            let (header, begin) = self.next_data()?;
            self.page = Some(self.open(&header, begin)?);
        }
        let page = self.page.as_mut().expect("one was opened");
        let cell = page.take(self.highest).and_then(|cell| {
            if page.entries == 0 {
                page.finish()?;
            }
            Ok(cell)
        });
        cell.map_err(|problem| self.damaged(problem))
    }

    fn next_data(&mut self) -> Result<(PageHeader, u64), TableError> {
        self.page = None;
        while let Some((header, begin)) = self.pages.next_header()? {
            if matches!(header.kind, PageKind::Data | PageKind::DataV2) {
                return Ok((header, begin));
            }
        }
        Err(self
            .source
            .damaged(Place::of(&self.name), "the column ends early"))
    }

    fn open(&self, header: &PageHeader, begin: u64) -> Result<Open, TableError> {
        let io = |error| self.source.io(error);
        let mut file = BufReader::with_capacity(1 << 16, self.source.open()?);
        file.seek(SeekFrom::Start(begin)).map_err(io)?;
        if header.crc.is_some() {
            self.pages.check_sum(header, begin, &mut file)?;
            file.seek(SeekFrom::Start(begin)).map_err(io)?;
        }
        self.opened(header, begin, file).map_err(|problem| {
            let place = Place::byte(begin).in_name(&self.name);
            self.source.damaged(place, problem)
        })
    }

    /// Opens the page at the cursor of `file`. Version 2 of a data page has unpacked levels first. Version 1 has packed levels after their length.
    fn opened(
        &self,
        header: &PageHeader,
        begin: u64,
        mut file: BufReader<File>,
    ) -> Result<Open, String> {
        let is_v2 = header.kind == PageKind::DataV2;
        let levels = if is_v2 { header.definition_bytes } else { 0 };
        let rest = |size: u32| {
            size.checked_sub(levels)
                .ok_or("the levels are longer than their page")
        };
        let (packed, unpacked) = (rest(header.packed)?, rest(header.unpacked)?);
        let mut definitions = is_v2
            .then(|| read_exactly(&mut file, levels.into()))
            .transpose()?;
        let codec = match header.is_packed || !is_v2 {
            true => self.pages.codec(),
            false => Codec::Plain,
        };
        let mut page = Open {
            at: begin,
            body: body(codec, file, packed, unpacked)?,
            levels: None,
            entries: header.values.into(),
            bytes: unpacked.into(),
        };
        if self.highest > 0 {
            if definitions.is_none() {
                let length = page.number()?;
                definitions = Some(page.read(length)?);
            }
            page.levels = definitions.map(|bytes| Levels::new(bytes, self.highest));
        }
        Ok(page)
    }

    fn damaged(&self, problem: String) -> TableError {
        let at = self.page.as_ref().map(|page| page.at);
        let place = at.map_or_else(Place::default, Place::byte);
        self.source.damaged(place.in_name(&self.name), problem)
    }
}

/// Reader of the values of a page.
fn body(codec: Codec, file: BufReader<File>, packed: u32, unpacked: u32) -> Result<Body, String> {
    if codec == Codec::Plain {
        return match packed == unpacked {
            true => Ok(Body::File(file)),
            false => Err(format!("{packed} uncompressed bytes, expected {unpacked}")),
        };
    }
    Ok(Body::Unpacked(codec::stream(
        codec,
        file.take(packed.into()),
        unpacked,
    )?))
}

impl Open {
    /// Reads the next cell; `None` if it is null.
    fn take(&mut self, highest: i16) -> Result<Option<Vec<u8>>, String> {
        match self.is_null(highest)? {
            true => Ok(None),
            false => {
                let length = self.number()?;
                self.read(length).map(Some)
            }
        }
    }

    /// Reads the page to its end after the last cell, because some codecs store a checksum there.
    fn finish(&mut self) -> Result<(), String> {
        match &mut self.body {
            Body::Unpacked(reader) if self.bytes == 0 => reader
                .read(&mut [0])
                .map(drop)
                .map_err(|error| error.to_string()),
            _ => Ok(()),
        }
    }

    /// Skips the next cell.
    fn pass(&mut self, highest: i16) -> Result<(), String> {
        if self.is_null(highest)? {
            return Ok(());
        }
        let length = self.number()?;
        self.announce(length)?;
        let passed = match &mut self.body {
            Body::File(file) => {
                let step = i64::from(length);
                file.seek_relative(step).map(|()| u64::from(length))
            }
            Body::Unpacked(reader) => {
                std::io::copy(&mut reader.take(length.into()), &mut std::io::sink())
            }
        };
        match passed {
            Ok(passed) if passed == u64::from(length) => Ok(()),
            Ok(_) => Err("the page is cut short".to_owned()),
            Err(error) => Err(error.to_string()),
        }
    }

    fn is_null(&mut self, highest: i16) -> Result<bool, String> {
        self.entries -= 1;
        match &mut self.levels {
            None => Ok(false),
            Some(levels) => match levels.next() {
                Some(level) => Ok(level < u32::from(highest.cast_unsigned())),
                None => Err("there are fewer levels than values".to_owned()),
            },
        }
    }

    fn number(&mut self) -> Result<u32, String> {
        let bytes = self.read(4)?;
        let bytes: [u8; 4] = bytes.try_into().map_err(|_| "the page is cut short")?;
        Ok(u32::from_le_bytes(bytes))
    }

    fn read(&mut self, length: u32) -> Result<Vec<u8>, String> {
        self.announce(length)?;
        match &mut self.body {
            Body::File(file) => read_exactly(file, length.into()),
            Body::Unpacked(reader) => read_exactly(reader, length.into()),
        }
    }

    /// Subtracts `length` from the remaining bytes of the page. Fails if fewer bytes remain.
    fn announce(&mut self, length: u32) -> Result<(), String> {
        let left = self.bytes.checked_sub(length.into());
        self.bytes = left.ok_or_else(|| {
            format!(
                "a cell of {length} bytes, but the page has only {} left",
                self.bytes
            )
        })?;
        match u64::from(length) <= limits::CELL_BYTES {
            true => Ok(()),
            false => Err(format!(
                "a cell of {length} bytes, at most {} are accepted",
                limits::CELL_BYTES
            )),
        }
    }
}

/// Reads `length` bytes. Memory grows with the bytes present, not with the stated length.
fn read_exactly(reader: &mut impl Read, length: u64) -> Result<Vec<u8>, String> {
    let most = usize::try_from(length.min(1 << 20)).unwrap_or(0);
    let mut bytes = Vec::with_capacity(most);
    let read = reader.take(length).read_to_end(&mut bytes);
    match read {
        Ok(read) if read as u64 == length => Ok(bytes),
        Ok(_) => Err("the page is cut short".to_owned()),
        Err(error) => Err(error.to_string()),
    }
}
