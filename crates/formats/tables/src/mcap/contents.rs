//! Contents of an MCAP file, from its summary if complete, otherwise from all records.

use std::collections::BTreeMap;
use std::io::Read;

use super::chunks::Chunks;
use super::record::{self, Channel, ChunkIndex, FOOTER, HEAD, MAGIC, Statistics, code};
use crate::bytes::Bytes;
use crate::error::{Place, TableError};
use crate::limits;
use crate::message::Schema;
use crate::source::Source;

/// Message for a record that is truncated.
const CUT: &str = "a record is cut short";

/// Schemas, channels and locations of messages in an MCAP file.
#[derive(Debug, Default)]
pub(super) struct Contents {
    pub(super) schemas: BTreeMap<u16, Schema>,
    pub(super) channels: BTreeMap<u16, Channel>,
    pub(super) chunks: Vec<ChunkIndex>,
    /// Offsets of message records outside chunks, by channel.
    pub(super) loose: BTreeMap<u16, Vec<u64>>,
    /// Number of messages of each channel.
    pub(super) counts: BTreeMap<u16, u64>,
    /// Total size of the schemas and channels read so far, bytes.
    described: u64,
}

/// Reads the contents of the file of `source`. Verifies the checksums of the summary and the data.
pub(super) fn read(source: &Source) -> Result<Contents, TableError> {
    let mut chunks = Chunks::new(source)?;
    let footer_at = check_ends(source)?;
    let fields = chunks.fields(footer_at, code::FOOTER, 20)?;
    let (summary_at, crc) = record::footer(&fields)
        .ok_or_else(|| source.damaged(Place::byte(footer_at), "the footer is cut short"))?;
    let data_end = match summary_at {
        0 => footer_at,
        at => at,
    };
    let place = Place::byte(footer_at).in_name("footer");
    if data_end > footer_at || data_end < MAGIC.len() as u64 {
        let problem = format!("the summary cannot begin at byte {data_end}");
        return Err(source.damaged(place, problem));
    }
    check_data(source, &mut chunks, data_end)?;
    if summary_at != 0 {
        let summary = summary(source, summary_at, footer_at, crc)?;
        if let Some(contents) = summary {
            return Ok(contents);
        }
    }
    walk(source)
}

/// Checks the magic bytes at both ends of an MCAP file. Returns the offset of the footer.
fn check_ends(source: &Source) -> Result<u64, TableError> {
    let mut file = source.open()?;
    let least = 2 * MAGIC.len() as u64 + FOOTER;
    if source.length() < least {
        let problem = format!("{} bytes are too few for an MCAP file", source.length());
        return Err(source.damaged(Place::default(), problem));
    }
    let first = source.bytes(&mut file, 0, 8, 8)?;
    if first != MAGIC {
        return Err(source.damaged(
            Place::byte(0),
            "not an MCAP file: it does not begin with its magic bytes",
        ));
    }
    let end = source.length() - MAGIC.len() as u64;
    if source.bytes(&mut file, end, 8, 8)? != MAGIC {
        return Err(refusal(source, Place::byte(end)));
    }
    Ok(end - FOOTER)
}

/// Error for a file that was truncated or not closed, with the number of readable messages.
fn refusal(source: &Source, place: Place) -> TableError {
    match walk_to_cut(source) {
        Ok((contents, _)) => TableError::Cut {
            path: source.path().to_owned(),
            place,
            problem: "cut short or not closed: it does not end with the magic bytes of MCAP"
                .to_owned(),
            messages: contents.counts.values().sum(),
            remedy: "recover the complete messages with `mcap recover`",
        },
        Err(error) => error,
    }
}

/// Verifies the checksum over all data records, if the file states it.
fn check_data(source: &Source, chunks: &mut Chunks<'_>, data_end: u64) -> Result<(), TableError> {
    let Some(at) = data_end.checked_sub(HEAD + 4) else {
        return Ok(());
    };
    let Ok((code::DATA_END, 4)) = chunks.head(at) else {
        let problem = "the data end record is not where the footer states";
        return Err(source.damaged(Place::byte(at), problem));
    };
    let fields = chunks.fields(at, code::DATA_END, 4)?;
    let Some(crc) = Bytes::new(&fields).u32().filter(|crc| *crc != 0) else {
        return Ok(());
    };
    let mut hasher = crc32fast::Hasher::new();
    let mut data = source.open()?.take(at);
    let mut buffer = vec![0; 1 << 16];
    loop {
        match data.read(&mut buffer).map_err(|error| source.io(error))? {
            0 => break,
            count => hasher.update(&buffer[..count]),
        }
    }
    let formed = hasher.finalize();
    match formed == crc {
        true => Ok(()),
        false => {
            let problem = format!(
                "the checksum of the data is {formed:08x}, expected {crc:08x}: the file was changed after writing"
            );
            Err(source.damaged(Place::byte(at), problem))
        }
    }
}

/// Reads the contents of a file from its summary; `None` if the summary is incomplete.
fn summary(
    source: &Source,
    begin: u64,
    footer_at: u64,
    crc: u32,
) -> Result<Option<Contents>, TableError> {
    // The checksum covers the footer up to the checksum itself.
    let summed = footer_at - begin + HEAD + 16;
    let mut file = source.open()?;
    let all = source.bytes(&mut file, begin, summed, limits::DESCRIPTION_BYTES)?;
    let formed = crc32fast::hash(&all);
    if crc != 0 && crc != formed {
        let problem = format!(
            "the checksum of the summary is {formed:08x}, expected {crc:08x}: the file was changed after writing"
        );
        return Err(source.damaged(Place::byte(begin), problem));
    }
    let length = all.len() - usize::try_from(HEAD + 16).unwrap_or(0);
    let mut bytes = Bytes::new(&all[..length]);
    let mut contents = Contents::default();
    let mut statistics: Option<Statistics> = None;
    while !bytes.rest().is_empty() {
        let at = begin + bytes.at() as u64;
        let read = match record::next(&mut bytes) {
            Some((code::CHUNK_INDEX, fields)) => match record::chunk_index(fields) {
                Some(index) if index.end().is_none_or(|end| end > begin) => {
                    Err("a chunk begins after the summary")
                }
                Some(index) => {
                    contents.chunks.push(index);
                    Ok(())
                }
                None => Err(CUT),
            },
            Some((code::STATISTICS, fields)) => record::statistics(fields)
                .ok_or(CUT)
                .map(|read| statistics = Some(read)),
            Some((code, fields)) => contents.describe(code, fields),
            None => Err(CUT),
        };
        read.map_err(|problem| source.damaged(Place::byte(at).in_name("summary"), problem))?;
    }
    let Some(statistics) = statistics else {
        return Ok(None);
    };
    let is_whole = statistics.schemas as usize == contents.schemas.len()
        && statistics.channels as usize == contents.channels.len()
        && statistics.chunks as usize == contents.chunks.len()
        && statistics.chunks > 0
        && statistics
            .of_channel
            .values()
            .try_fold(0_u64, |sum, count| sum.checked_add(*count))
            == Some(statistics.messages)
        && contents
            .chunks
            .iter()
            .all(|chunk| !chunk.indices.is_empty());
    contents.counts = statistics.of_channel;
    contents.chunks.sort_by_key(|chunk| chunk.at);
    Ok(is_whole.then_some(contents))
}

/// Reads the contents of a file from all records up to the end of the data. Unpacks every chunk once.
pub(super) fn walk(source: &Source) -> Result<Contents, TableError> {
    let end = source.length() - MAGIC.len() as u64;
    walk_records(source, end, false).map(|(contents, _)| contents)
}

/// Reads the contents of a truncated file from its complete records. Also returns the end offset of these records.
pub(super) fn walk_to_cut(source: &Source) -> Result<(Contents, u64), TableError> {
    walk_records(source, source.length(), true)
}

fn walk_records(source: &Source, end: u64, is_to_cut: bool) -> Result<(Contents, u64), TableError> {
    let mut chunks = Chunks::new(source)?;
    let mut contents = Contents::default();
    let mut loose = 0_usize;
    let mut at = MAGIC.len() as u64;
    while at < end {
        let (code, length) = match chunks.head(at) {
            // No record has the code 0. A file system leaves zeros after the last stored bytes.
            Ok((0, _)) | Err(TableError::Damaged { .. }) if is_to_cut => break,
            head => head?,
        };
        let damaged = |problem: &str| source.damaged(Place::byte(at), problem);
        match code {
            code::DATA_END => break,
            code::SCHEMA | code::CHANNEL => {
                let fields = chunks.fields(at, code, limits::DESCRIPTION_BYTES)?;
                contents.describe(code, &fields).map_err(damaged)?;
            }
            code::MESSAGE => {
                let fields = chunks.fields(at, code, 22)?;
                let (head, _) = record::message(&fields).ok_or_else(|| damaged(CUT))?;
                contents.loose.entry(head.channel).or_default().push(at);
                *contents.counts.entry(head.channel).or_default() += 1;
                loose += 1;
                if loose > limits::MESSAGES {
                    let problem = format!("more than {} messages outside chunks", limits::MESSAGES);
                    return Err(source.too_large(Place::byte(at), problem));
                }
            }
            code::CHUNK => {
                let records = chunks.unpacked(at)?;
                let mut bytes = Bytes::new(&records);
                while !bytes.rest().is_empty() {
                    let inside = bytes.at();
                    let read = match record::next(&mut bytes) {
                        Some((code::MESSAGE, fields)) => {
                            record::message(fields).ok_or(CUT).map(|(head, _)| {
                                *contents.counts.entry(head.channel).or_default() += 1;
                            })
                        }
                        Some((code, fields)) => contents.describe(code, fields),
                        None => Err(CUT),
                    };
                    read.map_err(|problem| {
                        damaged(&format!("{problem}, at byte {inside} of the chunk"))
                    })?;
                }
                contents.chunks.push(ChunkIndex {
                    at,
                    length: HEAD + length,
                    indices: BTreeMap::new(),
                });
            }
            _ => {}
        }
        at += HEAD + length;
    }
    Ok((contents, at))
}

impl Contents {
    /// Stores a schema or a channel. Ignores other records.
    fn describe(&mut self, code: u8, fields: &[u8]) -> Result<(), &'static str> {
        if !matches!(code, code::SCHEMA | code::CHANNEL) {
            return Ok(());
        }
        self.described += fields.len() as u64;
        if self.described > limits::DESCRIPTION_BYTES {
            return Err("too many schemas and channels");
        }
        if code == code::SCHEMA {
            let (id, schema) = record::schema(fields).ok_or(CUT)?;
            self.schemas.insert(id, schema);
        } else {
            let (id, channel) = record::channel(fields).ok_or(CUT)?;
            self.channels.insert(id, channel);
        }
        Ok(())
    }
}
