//! Header of the first video stream.

use super::chunk::{Chunk, Chunks};
use crate::error::VideoError;
use crate::limits;
use crate::source::Source;

/// Header of a video stream.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct StreamHeader {
    /// Index among all streams, from 0.
    pub(super) number: u8,
    /// Four letters of the codec.
    pub(crate) codec: [u8; 4],
    /// Width, pixels.
    pub(crate) width: u32,
    /// Height, pixels.
    pub(crate) height: u32,
    /// Frame period as a fraction: `scale` / `rate` seconds.
    pub(super) scale: u32,
    pub(super) rate: u32,
}

/// Reads the first video stream in the list of headers; `None` without a video stream.
pub(super) fn read(source: &Source, headers: &Chunk) -> Result<Option<StreamHeader>, VideoError> {
    let mut chunks = headers.list(source)?;
    let mut number = 0;
    while let Some(chunk) = chunks.next()? {
        if chunk.list_kind(source)?.as_ref() != Some(b"strl") {
            continue;
        }
        if let Some(stream) = read_stream(source, chunk.list(source)?, number)? {
            return Ok(Some(stream));
        }
        number += 1;
        // Chunk names have two digits for a stream.
        if number == 100 {
            break;
        }
    }
    Ok(None)
}

fn read_stream(
    source: &Source,
    mut chunks: Chunks<'_>,
    number: u8,
) -> Result<Option<StreamHeader>, VideoError> {
    let mut header = None;
    while let Some(chunk) = chunks.next()? {
        match (&chunk.id.0, header) {
            (b"strh", None) => {
                let bytes = read_whole(source, &chunk, 28)?;
                if &bytes[..4] != b"vids" {
                    return Ok(None);
                }
                header = Some((number_at(&bytes, 20), number_at(&bytes, 24)));
            }
            (b"strf", Some((scale, rate))) => {
                let bytes = read_whole(source, &chunk, 20)?;
                let mut codec = [0; 4];
                codec.copy_from_slice(&bytes[16..20]);
                // A negative height means rows from top to bottom.
                let height = i32::from_le_bytes([bytes[8], bytes[9], bytes[10], bytes[11]]);
                let (width, height) = (number_at(&bytes, 4), height.unsigned_abs());
                for side in [width, height] {
                    if side == 0 || side > limits::SIDE {
                        let problem = format!(
                            "frames of {width}×{height}, expected sides of 1 to {}",
                            limits::SIDE
                        );
                        return Err(source.damaged(chunk.body + 4, problem));
                    }
                }
                return Ok(Some(StreamHeader {
                    number,
                    codec,
                    width,
                    height,
                    scale,
                    rate,
                }));
            }
            _ => {}
        }
    }
    Ok(None)
}

/// Reads the content of a chunk of at least `least` bytes.
fn read_whole(source: &Source, chunk: &Chunk, least: u64) -> Result<Vec<u8>, VideoError> {
    if chunk.size < least {
        let problem = format!(
            "{} of {} bytes, expected {least} or more",
            chunk.id, chunk.size
        );
        return Err(source.damaged(chunk.at, problem));
    }
    source.read(
        chunk.body,
        chunk.size,
        "bytes of a stream's header",
        limits::HEADER_BYTES,
    )
}

/// Little-endian integer at offset `at`, which the caller has checked.
fn number_at(bytes: &[u8], at: usize) -> u32 {
    u32::from_le_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]])
}
