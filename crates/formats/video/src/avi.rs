//! AVI files. The chunks are read to find the packets of the video stream, and checked against the indices if there are any.
//!
//! Chunks state their kind and size, so a file without an index is readable too. An index that contradicts the chunks is an error, because either can be wrong.

mod chunk;
mod header;
mod index;

use crate::error::VideoError;
use crate::limits;
use crate::packets::Packet;
use crate::source::Source;

use chunk::{Chunk, ChunkId, Chunks};
use header::StreamHeader;
use index::Index;

/// Video stream of an AVI file.
#[derive(Debug)]
pub(crate) struct Avi {
    pub(crate) stream: StreamHeader,
    /// Packets in the order of file and presentation. An empty packet marks a frame that was lost in recording, and is skipped as in other readers. The times
    /// of the other packets show the gap.
    pub(crate) packets: Vec<Packet>,
    /// Time of each packet, in frame periods of the stream.
    places: Vec<u64>,
}

/// True if a file that begins with `start` is an AVI file.
pub(crate) fn is_avi(start: &[u8]) -> bool {
    start.starts_with(b"RIFF") && start.get(8..12) == Some(b"AVI ")
}

impl Avi {
    /// Reads the headers and all chunks.
    pub(crate) fn read(source: &Source) -> Result<Avi, VideoError> {
        let mut walk = Walk {
            source,
            stream: None,
            packets: Vec::new(),
            index: Index::default(),
            chunks_left: limits::CHUNKS,
        };
        let mut parts = Chunks::new(source, 0, source.length());
        while let Some(part) = parts.next()? {
            // Data after the last part is not AVI. Some writers leave padding there.
            if part.id != ChunkId(*b"RIFF") {
                break;
            }
            walk.count()?;
            walk.part(&part)?;
        }
        let Some(stream) = walk.stream else {
            return Err(source.damaged(12, "the file describes no video stream"));
        };
        walk.index.check(source, &walk.packets)?;
        let presented = (0..)
            .zip(walk.packets)
            .filter(|(_, packet)| packet.size > 0);
        let (places, packets) = presented.unzip();
        Ok(Avi {
            stream,
            packets,
            places,
        })
    }

    /// True if the packets of the stream are JPEG files.
    pub(crate) fn is_motion_jpeg(&self) -> bool {
        matches!(
            self.stream.codec.to_ascii_uppercase().as_slice(),
            b"MJPG" | b"JPEG"
        )
    }

    /// Name of the codec, or its four letters. Uncompressed video has zeros in place of letters.
    pub(crate) fn codec(&self) -> String {
        let letters = self.stream.codec;
        let name = match letters.to_ascii_uppercase().as_slice() {
            b"H264" | b"X264" | b"AVC1" => "H.264",
            b"HEVC" | b"H265" => "HEVC",
            b"XVID" | b"DIVX" | b"DX50" | b"FMP4" | b"MP4V" => "MPEG-4 part 2",
            b"FFV1" => "FFV1",
            b"HFYU" => "Huffyuv",
            [0, 0, 0, 0] => "raw pixels",
            _ => return format!("`{}`", letters.escape_ascii()),
        };
        name.to_owned()
    }

    /// Time of each packet, in s; `None` if the file states no rate.
    pub(crate) fn times_s(&self) -> Option<Vec<f64>> {
        let StreamHeader { scale, rate, .. } = self.stream;
        if scale == 0 || rate == 0 {
            return None;
        }
        let seconds = |place: &u64| *place as f64 * f64::from(scale) / f64::from(rate);
        Some(self.places.iter().map(seconds).collect())
    }
}

/// State of reading the chunks of an AVI file.
struct Walk<'a> {
    source: &'a Source,
    stream: Option<StreamHeader>,
    packets: Vec<Packet>,
    index: Index,
    chunks_left: u64,
}

impl Walk<'_> {
    fn count(&mut self) -> Result<(), VideoError> {
        self.chunks_left = self
            .chunks_left
            .checked_sub(1)
            .ok_or_else(|| VideoError::TooLarge {
                path: self.source.path().to_owned(),
                what: "chunks of an AVI file",
                found: limits::CHUNKS + 1,
                limit: limits::CHUNKS,
            })?;
        Ok(())
    }

    /// Reads one RIFF part of the file. The first part is `AVI `; `AVIX` parts follow after about each GiB.
    fn part(&mut self, part: &Chunk) -> Result<(), VideoError> {
        if part.size == 0 {
            return Err(self.source.damaged(
                part.at,
                "the size of the recording is 0: the recording was never closed; `ffmpeg -i OLD -c copy NEW` recovers its frames",
            ));
        }
        let first_packet = self.packets.len();
        let mut chunks = part.list(self.source)?;
        let mut packets_at = None;
        while let Some(chunk) = chunks.next()? {
            self.count()?;
            match (&chunk.id.0, chunk.list_kind(self.source)?.as_ref()) {
                (b"LIST", Some(b"hdrl")) if self.stream.is_none() => {
                    self.stream = header::read(self.source, &chunk)?;
                }
                (b"LIST", Some(b"movi")) => {
                    packets_at.get_or_insert(chunk.body);
                    self.movie(&chunk, true)?;
                }
                (b"idx1", _) => {
                    let base = packets_at.ok_or_else(|| {
                        self.source
                            .damaged(chunk.at, "the index precedes its frames")
                    })?;
                    let number = self.stream.as_ref().map_or(0, |stream| stream.number);
                    let packets = &self.packets[first_packet..];
                    index::check_idx1(self.source, &chunk, base, number, packets)?;
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// Reads the packets of a list. `is_whole` is true for the list of all packets, false for a record inside it.
    fn movie(&mut self, list: &Chunk, is_whole: bool) -> Result<(), VideoError> {
        let Some(number) = self.stream.as_ref().map(|stream| stream.number) else {
            return Err(self
                .source
                .damaged(list.at, "frames precede the header of their stream"));
        };
        let mut chunks = list.list(self.source)?;
        while let Some(chunk) = chunks.next()? {
            self.count()?;
            if chunk.id.is_picture_of(number) {
                if self.packets.len() as u64 == limits::FRAMES {
                    return Err(VideoError::TooLarge {
                        path: self.source.path().to_owned(),
                        what: "frames of a clip",
                        found: limits::FRAMES + 1,
                        limit: limits::FRAMES,
                    });
                }
                self.packets.push(Packet {
                    offset: chunk.body,
                    size: chunk.size,
                });
            } else if chunk.id.is_index_of(number) {
                self.index.add(self.source, &chunk)?;
            } else if is_whole && chunk.list_kind(self.source)?.as_ref() == Some(b"rec ") {
                self.movie(&chunk, false)?;
            }
        }
        Ok(())
    }
}
