//! Pages of a Parquet column chunk. This module checks and unpacks the pages, and the `parquet` crate decodes them.
//!
//! The page reader of this crate unpacks without C code, verifies checksums, and compares sizes with the file before it allocates.

use std::fs::File;
use std::io::{BufRead, BufReader, Read, Seek, SeekFrom};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use bytes::Bytes;
use parquet::basic::{Compression, Encoding};
use parquet::column::page::{Page, PageMetadata, PageReader};
use parquet::errors::ParquetError;
use parquet::file::metadata::ColumnChunkMetaData;

use super::page_header::{PageHeader, PageKind, read_header};
use super::values::{ValueSize, encoding, level_encoding};
use crate::codec::{Codec, unpack};
use crate::error::{Place, TableError};
use crate::limits;
use crate::source::Source;

/// Pages of one column chunk, in the order of the file.
pub(super) struct Pages {
    source: Source,
    name: String,
    file: BufReader<File>,
    /// Offset of the next page header. `end` is the offset of the end of the chunk.
    at: u64,
    end: u64,
    codec: Codec,
    values: ValueSize,
    has_nulls: bool,
    has_lists: bool,
    /// Header that was read ahead, and the offset of its page.
    peeked: Option<(PageHeader, u64)>,
    /// Number of values of all returned pages. The reader of the values shares this counter and resets it.
    handed: Arc<AtomicU64>,
    is_dictionary_read: bool,
}

impl Pages {
    /// Creates the reader of the pages of `chunk`, a chunk of the column `name`.
    pub(super) fn new(
        source: &Source,
        name: &str,
        chunk: &ColumnChunkMetaData,
        handed: Arc<AtomicU64>,
    ) -> Result<Pages, TableError> {
        let place = Place::of(name);
        if chunk.file_path().is_some() {
            let problem = "the column is in another file, which is not opened";
            return Err(source.unsupported(place, problem));
        }
        let codec = match chunk.compression_codec().into() {
            Compression::UNCOMPRESSED => Codec::Plain,
            Compression::SNAPPY => Codec::Snappy,
            Compression::GZIP(_) => Codec::Gzip,
            Compression::BROTLI(_) => Codec::Brotli,
            Compression::LZ4 => Codec::Lz4Hadoop,
            Compression::LZ4_RAW => Codec::Lz4Block,
            Compression::ZSTD(_) => Codec::Zstd,
            other => {
                let problem = format!(
                    "compressed by {other}, which is not supported; write it with snappy or zstd"
                );
                return Err(source.unsupported(place, problem));
            }
        };
        let first = [
            chunk.dictionary_page_offset(),
            Some(chunk.data_page_offset()),
        ]
        .into_iter()
        .flatten()
        // Some writers give 0 if there is no dictionary.
        .filter(|offset| *offset > 0)
        .min();
        let at = first.and_then(|offset| u64::try_from(offset).ok());
        let size = u64::try_from(chunk.compressed_size()).ok();
        let range = at
            .zip(size)
            .and_then(|(at, size)| Some((at, at.checked_add(size)?)));
        let Some((at, end)) = range.filter(|(_, end)| *end <= source.length()) else {
            let problem = format!(
                "its pages should begin at byte {} and take {} bytes, but the file has {}",
                chunk.data_page_offset(),
                chunk.compressed_size(),
                source.length()
            );
            return Err(source.damaged(place, problem));
        };
        let column = chunk.column_descr();
        Ok(Pages {
            source: source.clone(),
            name: name.to_owned(),
            file: BufReader::new(source.open()?),
            at,
            end,
            codec,
            values: ValueSize::of(column),
            has_nulls: column.max_def_level() > 0,
            has_lists: column.max_rep_level() > 0,
            peeked: None,
            handed,
            is_dictionary_read: false,
        })
    }

    /// Reads the next page header ahead. Also returns the offset of its page, at which the cursor of the file stays.
    fn header(&mut self) -> Result<Option<&(PageHeader, u64)>, TableError> {
        if self.peeked.is_some() || self.at >= self.end {
            return Ok(self.peeked.as_ref());
        }
        let at = self.at;
        self.file
            .seek(SeekFrom::Start(at))
            .map_err(|source| self.source.io(source))?;
        let mut rest = self.file.by_ref().take(self.end - at);
        let (header, length) =
            read_header(&mut rest).map_err(|problem| self.damaged(at, problem))?;
        let begin = at + length;
        let is_inside = begin
            .checked_add(u64::from(header.packed))
            .is_some_and(|end| end <= self.end);
        if !is_inside {
            let problem = format!(
                "a page of {} bytes, beyond the end of its chunk at byte {}",
                header.packed, self.end
            );
            return Err(self.damaged(at, problem));
        }
        self.peeked = Some((header, begin));
        Ok(self.peeked.as_ref())
    }

    /// Skips the page whose header was read ahead.
    fn pass(&mut self) {
        if let Some((header, begin)) = self.peeked.take() {
            self.at = begin + u64::from(header.packed);
        }
    }

    /// Returns the next header of a page of any type, and the offset of the page. Skips the page.
    pub(super) fn next_header(&mut self) -> Result<Option<(PageHeader, u64)>, TableError> {
        let found = self.header()?.cloned();
        self.pass();
        Ok(found)
    }

    pub(super) fn codec(&self) -> Codec {
        self.codec
    }

    /// Verifies the checksum of the page at the cursor of `file`, which begins at `begin`.
    pub(super) fn check_sum(
        &self,
        header: &PageHeader,
        begin: u64,
        file: &mut impl BufRead,
    ) -> Result<(), TableError> {
        let mut hasher = crc32fast::Hasher::new();
        let mut rest = file.take(header.packed.into());
        loop {
            let bytes = rest.fill_buf().map_err(|error| self.source.io(error))?;
            if bytes.is_empty() {
                break;
            }
            hasher.update(bytes);
            let length = bytes.len();
            rest.consume(length);
        }
        self.compare_sum(header, begin, hasher.finalize())
    }

    fn compare_sum(&self, header: &PageHeader, begin: u64, formed: u32) -> Result<(), TableError> {
        match header.crc.filter(|crc| *crc != formed) {
            None => Ok(()),
            Some(crc) => {
                let problem = format!(
                    "the checksum of the page is {formed:08x}, expected {crc:08x}: the file was changed after writing"
                );
                Err(self.damaged(begin, problem))
            }
        }
    }

    fn next_page(&mut self) -> Result<Option<Page>, TableError> {
        loop {
            let Some((header, begin)) = self.header()?.cloned() else {
                return Ok(None);
            };
            if header.kind == PageKind::Index {
                self.pass();
                continue;
            }
            let page = self.page(&header, begin)?;
            self.pass();
            return Ok(Some(page));
        }
    }

    fn page(&mut self, header: &PageHeader, begin: u64) -> Result<Page, TableError> {
        let limit = limits::PAGE_BYTES;
        if u64::from(header.packed.max(header.unpacked)) > limit {
            let problem = format!(
                "a page of {} bytes, {} decompressed; at most {limit} are accepted: write it with fewer rows per group",
                header.packed, header.unpacked
            );
            return Err(self
                .source
                .too_large(Place::byte(begin).in_name(&self.name), problem));
        }
        let mut packed = vec![0; header.packed as usize];
        self.file
            .seek(SeekFrom::Start(begin))
            .and_then(|_| self.file.read_exact(&mut packed))
            .map_err(|source| self.source.io(source))?;
        if header.crc.is_some() {
            self.compare_sum(header, begin, crc32fast::hash(&packed))?;
        }
        let bytes = self
            .unpacked(header, packed)
            .map_err(|problem| self.damaged(begin, problem))?;
        self.checked(header, bytes)
            .map_err(|problem| self.damaged(begin, problem))
    }

    /// Unpacks a page. In a data page of version 2, uncompressed levels precede the packed bytes.
    fn unpacked(&self, header: &PageHeader, packed: Vec<u8>) -> Result<Vec<u8>, String> {
        let size = header.unpacked as usize;
        if header.kind != PageKind::DataV2 {
            return match self.codec {
                Codec::Plain if packed.len() == size => Ok(packed),
                codec => self.unpack(codec, &packed, size),
            };
        }
        let levels = (header.definition_bytes as usize)
            .checked_add(header.repetition_bytes as usize)
            .filter(|levels| *levels <= packed.len() && *levels <= size)
            .ok_or("the levels are longer than their page")?;
        let is_packed = header.is_packed && self.codec != Codec::Plain && size > levels;
        if !is_packed {
            return match packed.len() == size {
                true => Ok(packed),
                false => Err(format!(
                    "{} uncompressed bytes, expected {size}",
                    packed.len()
                )),
            };
        }
        let values = self.unpack(self.codec, &packed[levels..], size - levels)?;
        let mut whole = packed;
        whole.truncate(levels);
        whole.extend_from_slice(&values);
        Ok(whole)
    }

    /// Unpacks `packed` to `size` bytes. Blocks of the older LZ4 codec have Hadoop frames, which some writers omit.
    fn unpack(&self, codec: Codec, packed: &[u8], size: usize) -> Result<Vec<u8>, String> {
        match (codec, unpack(codec, packed, size)) {
            (Codec::Lz4Hadoop, Err(problem)) => unpack(Codec::Lz4Frame, packed, size)
                .or_else(|_| unpack(Codec::Lz4Block, packed, size))
                .map_err(|_| problem),
            (_, unpacked) => unpacked,
        }
    }

    /// Builds a page from the unpacked `bytes`, after a check that the counts in the header fit them.
    fn checked(&mut self, header: &PageHeader, bytes: Vec<u8>) -> Result<Page, String> {
        let encoding = encoding(header.encoding)?;
        let buf = Bytes::from(bytes);
        let num_values = header.values;
        if header.kind == PageKind::Dictionary {
            if std::mem::replace(&mut self.is_dictionary_read, true) {
                return Err("the chunk has a second dictionary".to_owned());
            }
            self.values.check_dictionary(num_values, buf.len())?;
            return Ok(Page::DictionaryPage {
                buf,
                num_values,
                encoding,
                is_sorted: false,
            });
        }
        let is_of_dictionary = matches!(
            encoding,
            Encoding::RLE_DICTIONARY | Encoding::PLAIN_DICTIONARY
        );
        if is_of_dictionary && !self.is_dictionary_read {
            return Err("the chunk has dictionary values but no dictionary".to_owned());
        }
        let values = u64::from(num_values);
        let handed = self.handed.fetch_add(values, Ordering::Relaxed);
        if self.has_lists && handed.saturating_add(values) > limits::ROW_LEVELS {
            let limit = limits::ROW_LEVELS;
            return Err(format!(
                "rows of more than {limit} numbers are not accepted"
            ));
        }
        if encoding == Encoding::PLAIN && !self.has_nulls {
            self.values.check_plain(num_values, buf.len())?;
        }
        Ok(match header.kind {
            PageKind::DataV2 => Page::DataPageV2 {
                buf,
                num_values,
                encoding,
                num_nulls: header.nulls,
                num_rows: header.rows,
                def_levels_byte_len: header.definition_bytes,
                rep_levels_byte_len: header.repetition_bytes,
                is_compressed: false,
                statistics: None,
            },
            _ => Page::DataPage {
                buf,
                num_values,
                encoding,
                def_level_encoding: level_encoding(header.definition_encoding, self.has_nulls)?,
                rep_level_encoding: level_encoding(header.repetition_encoding, self.has_lists)?,
                statistics: None,
            },
        })
    }

    fn damaged(&self, at: u64, problem: impl Into<String>) -> TableError {
        self.source
            .damaged(Place::byte(at).in_name(&self.name), problem)
    }
}

/// Wraps an error of this crate for the `parquet` crate, which requested the page.
fn outer(error: TableError) -> ParquetError {
    ParquetError::External(Box::new(error))
}

impl Iterator for Pages {
    type Item = Result<Page, ParquetError>;

    fn next(&mut self) -> Option<Self::Item> {
        self.get_next_page().transpose()
    }
}

impl PageReader for Pages {
    fn get_next_page(&mut self) -> Result<Option<Page>, ParquetError> {
        self.next_page().map_err(outer)
    }

    fn peek_next_page(&mut self) -> Result<Option<PageMetadata>, ParquetError> {
        loop {
            let Some((header, _)) = self.header().map_err(outer)? else {
                return Ok(None);
            };
            let values = header.values as usize;
            let rows = header.rows as usize;
            match header.kind {
                PageKind::Index => self.pass(),
                PageKind::Dictionary => {
                    return Ok(Some(PageMetadata {
                        num_rows: None,
                        num_levels: None,
                        is_dict: true,
                    }));
                }
                PageKind::Data => {
                    return Ok(Some(PageMetadata {
                        num_rows: None,
                        num_levels: Some(values),
                        is_dict: false,
                    }));
                }
                PageKind::DataV2 => {
                    return Ok(Some(PageMetadata {
                        num_rows: Some(rows),
                        num_levels: Some(values),
                        is_dict: false,
                    }));
                }
            }
        }
    }

    fn skip_next_page(&mut self) -> Result<(), ParquetError> {
        self.header().map_err(outer)?;
        self.pass();
        Ok(())
    }
}
