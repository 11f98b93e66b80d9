//! Index of the messages of a topic in an MCAP file, sorted by log time.

use std::collections::BTreeSet;

use super::chunks::Chunks;
use super::contents::{self, Contents};
use super::record::{self, code};
use crate::bytes::Bytes;
use crate::error::{Place, TableError};
use crate::limits;
use crate::message::Entry;
use crate::source::Source;

/// All messages of `channels`, sorted by time, then by position in the file.
///
/// If the indices of the file and its statistics state different numbers of messages, all records are read instead.
pub(super) fn index(
    source: &Source,
    contents: &Contents,
    channels: &BTreeSet<u16>,
) -> Result<Vec<Entry>, TableError> {
    let count = |contents: &Contents| {
        channels
            .iter()
            .filter_map(|channel| contents.counts.get(channel))
            .sum::<u64>()
    };
    let mut entries = gather(source, contents, channels)?;
    if entries.len() as u64 != count(contents) {
        let walked = contents::walk(source)?;
        entries = gather(source, &walked, channels)?;
        if entries.len() as u64 != count(contents) {
            let problem = format!(
                "{} messages, but the statistics state {}",
                entries.len(),
                count(contents)
            );
            return Err(source.damaged(Place::of("summary"), problem));
        }
    }
    // Locations are unique, so this order equals a stable sort, without its memory.
    entries
        .sort_unstable_by_key(|entry| (entry.log_time, entry.chunk.unwrap_or(entry.at), entry.at));
    Ok(entries)
}

fn gather(
    source: &Source,
    contents: &Contents,
    channels: &BTreeSet<u16>,
) -> Result<Vec<Entry>, TableError> {
    let mut chunks = Chunks::new(source)?;
    let mut entries = Vec::new();
    let mut add = |entry: Entry| {
        if entries.len() >= limits::MESSAGES {
            let problem = format!("more than {} messages of one topic", limits::MESSAGES);
            return Err(source.too_large(Place::byte(entry.at), problem));
        }
        entries.push(entry);
        Ok(())
    };
    for chunk in &contents.chunks {
        if chunk.indices.is_empty() {
            scan(source, &mut chunks, chunk.at, channels, &mut add)?;
            continue;
        }
        for (channel, at) in chunk
            .indices
            .iter()
            .filter(|(channel, _)| channels.contains(channel))
        {
            let fields = chunks.fields(*at, code::MESSAGE_INDEX, u64::MAX)?;
            let damaged =
                |problem: &str| source.damaged(Place::byte(*at).in_name("message index"), problem);
            let (of, places) =
                record::message_index(&fields).ok_or_else(|| damaged("it is cut short"))?;
            if of != *channel {
                return Err(damaged("it belongs to another channel"));
            }
            for (log_time, place) in places {
                add(Entry {
                    log_time,
                    chunk: Some(chunk.at),
                    at: place,
                })?;
            }
        }
    }
    for (_, places) in contents
        .loose
        .iter()
        .filter(|(channel, _)| channels.contains(channel))
    {
        for at in places {
            let fields = chunks.fields(*at, code::MESSAGE, 22)?;
            let (head, _) = record::message(&fields)
                .ok_or_else(|| source.damaged(Place::byte(*at), "a message is cut short"))?;
            add(Entry {
                log_time: head.log_time,
                chunk: None,
                at: *at,
            })?;
        }
    }
    Ok(entries)
}

/// Indexes the messages of the chunk at the offset `chunk`, whose message indices are missing.
fn scan(
    source: &Source,
    chunks: &mut Chunks<'_>,
    chunk: u64,
    channels: &BTreeSet<u16>,
    add: &mut impl FnMut(Entry) -> Result<(), TableError>,
) -> Result<(), TableError> {
    let records = chunks.unpacked(chunk)?;
    let mut bytes = Bytes::new(&records);
    while !bytes.rest().is_empty() {
        let at = bytes.at() as u64;
        let cut = || {
            source.damaged(
                Place::byte(chunk),
                format!("the record at byte {at} of the chunk is cut short"),
            )
        };
        let (code, fields) = record::next(&mut bytes).ok_or_else(cut)?;
        if code == code::MESSAGE {
            let (head, _) = record::message(fields).ok_or_else(cut)?;
            if channels.contains(&head.channel) {
                add(Entry {
                    log_time: head.log_time,
                    chunk: Some(chunk),
                    at,
                })?;
            }
        }
    }
    Ok(())
}
