//! Reader of the chunks of an MCAP file, which unpacks one chunk at a time and verifies checksums.

use std::fs::File;
use std::sync::Arc;

use super::record::{self, HEAD, code};
use crate::bytes::Bytes;
use crate::codec::{Codec, unpack};
use crate::error::{Place, TableError};
use crate::growth::Growth;
use crate::limits;
use crate::source::Source;

/// Number of cached unpacked chunks. Two are needed because the times of neighbouring chunks may overlap, if several threads wrote the file.
const KEPT: usize = 2;

/// Reader of the records and chunks at given offsets of an MCAP file, with its own cursor.
pub(super) struct Chunks<'a> {
    source: &'a Source,
    file: File,
    kept: Vec<(u64, Arc<Vec<u8>>)>,
    growth: Growth,
}

impl<'a> Chunks<'a> {
    pub(super) fn new(source: &'a Source) -> Result<Chunks<'a>, TableError> {
        Ok(Chunks {
            source,
            file: source.open()?,
            kept: Vec::new(),
            growth: Growth::default(),
        })
    }

    /// Code and length of the record at the offset `at`.
    pub(super) fn head(&mut self, at: u64) -> Result<(u8, u64), TableError> {
        let head = self.source.bytes(&mut self.file, at, HEAD, HEAD)?;
        let mut bytes = Bytes::new(&head);
        let (Some(code), Some(length)) = (bytes.u8(), bytes.u64()) else {
            return Err(self
                .source
                .damaged(Place::byte(at), "a record is cut short"));
        };
        let end = at
            .checked_add(HEAD)
            .and_then(|begin| begin.checked_add(length));
        match end.is_some_and(|end| end <= self.source.length()) {
            true => Ok((code, length)),
            false => {
                let problem = format!("a record has {length} bytes, beyond the end of the file");
                Err(self.source.damaged(Place::byte(at), problem))
            }
        }
    }

    /// First `most` bytes of the fields of the record at the offset `at`. The record must have the code `expected`.
    pub(super) fn fields(
        &mut self,
        at: u64,
        expected: u8,
        most: u64,
    ) -> Result<Vec<u8>, TableError> {
        let (code, length) = self.head(at)?;
        if code != expected {
            let problem = format!("a record has the code {code:#04x}, expected {expected:#04x}");
            return Err(self.source.damaged(Place::byte(at), problem));
        }
        self.source.bytes(
            &mut self.file,
            at + HEAD,
            length.min(most),
            limits::PAGE_BYTES,
        )
    }

    /// Unpacked records of the chunk at the offset `at`.
    pub(super) fn unpacked(&mut self, at: u64) -> Result<Arc<Vec<u8>>, TableError> {
        if let Some(found) = self.kept.iter().position(|(place, _)| *place == at) {
            let kept = self.kept.remove(found);
            let bytes = Arc::clone(&kept.1);
            self.kept.push(kept);
            return Ok(bytes);
        }
        // Drops the least recently used chunk before the next is unpacked, so memory holds at most `KEPT` chunks.
        if self.kept.len() >= KEPT {
            self.kept.remove(0);
        }
        let fields = self.fields(at, code::CHUNK, u64::MAX)?;
        let bytes = Arc::new(self.unpack(at, &fields)?);
        self.kept.push((at, Arc::clone(&bytes)));
        Ok(bytes)
    }

    fn unpack(&mut self, at: u64, fields: &[u8]) -> Result<Vec<u8>, TableError> {
        let source = self.source;
        let damaged = |problem: String| source.damaged(Place::byte(at).in_name("chunk"), problem);
        let (head, begin) =
            record::chunk(fields).ok_or_else(|| damaged("the header is cut short".to_owned()))?;
        let packed = fields.get(begin..).unwrap_or_default();
        if packed.len() as u64 != head.packed {
            return Err(damaged(format!(
                "{} bytes, but its header states {}",
                packed.len(),
                head.packed
            )));
        }
        if head.unpacked > limits::PAGE_BYTES {
            let problem = format!(
                "{} decompressed bytes, at most {} are accepted",
                head.unpacked,
                limits::PAGE_BYTES
            );
            return Err(self
                .source
                .too_large(Place::byte(at).in_name("chunk"), problem));
        }
        let grown = self.growth.take(head.packed, head.unpacked);
        grown.map_err(|problem| source.too_large(Place::byte(at).in_name("chunk"), problem))?;
        let codec = match head.codec.as_str() {
            "" => Codec::Plain,
            "lz4" => Codec::Lz4Frame,
            "zstd" => Codec::Zstd,
            other => {
                let problem = format!(
                    "compressed by `{}`, expected none, lz4 or zstd",
                    crate::error::shown(other)
                );
                return Err(self
                    .source
                    .unsupported(Place::byte(at).in_name("chunk"), problem));
            }
        };
        let size = usize::try_from(head.unpacked).unwrap_or(usize::MAX);
        let bytes = unpack(codec, packed, size).map_err(damaged)?;
        let formed = crc32fast::hash(&bytes);
        match head.crc == 0 || head.crc == formed {
            true => Ok(bytes),
            false => Err(damaged(format!(
                "its checksum is {formed:08x}, expected {:08x}: the file was changed after writing",
                head.crc
            ))),
        }
    }
}
