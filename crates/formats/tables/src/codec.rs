//! Decompression to a known size. The output never exceeds this size, and memory is allocated only as the input fills it.

use std::io::{self, BufRead, Cursor, Read};

use mzstd::{
    DecodeError, DecodeLimits, DecodeOperation, DecoderConfig, DecoderSessionOwned, Decompressor,
};

use crate::limits;
use crate::snappy::SnappyStream;

/// Compression method.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Codec {
    /// No compression.
    Plain,
    /// The block format of snappy.
    Snappy,
    /// Gzip, in one or more members.
    Gzip,
    Brotli,
    Lz4Block,
    /// LZ4 blocks as Hadoop writes them, each after its unpacked and packed size.
    Lz4Hadoop,
    Lz4Frame,
    /// Bzip2, in one stream.
    Bzip2,
    /// Zstandard, in one frame.
    Zstd,
}

/// Maximum ratio of unpacked to packed bytes of a Snappy block. `LZ4_GROWTH` is that of an LZ4 block. A Snappy copy of 64 bytes takes 3 bytes; 255
/// bytes of LZ4 take 1 byte.
const SNAPPY_GROWTH: usize = 64;
const LZ4_GROWTH: usize = 255;
/// Window size that Zstandard needs for levels up to 19, bytes.
const ZSTD_WINDOW_BYTES: u64 = 8 << 20;

/// Unpacks `packed` to exactly `size` bytes.
///
/// # Errors
/// Error message for a wrong size, a checksum mismatch, or invalid bytes.
pub(crate) fn unpack(codec: Codec, packed: &[u8], size: usize) -> Result<Vec<u8>, String> {
    let unpacked = match codec {
        Codec::Plain => packed.to_vec(),
        Codec::Snappy => snappy(packed, size)?,
        Codec::Gzip => streamed("gzip", flate2::read::MultiGzDecoder::new(packed), size)?,
        Codec::Brotli => {
            let buffer = packed.len().clamp(64, 64 << 10);
            streamed(
                "brotli",
                brotli_decompressor::Decompressor::new(packed, buffer),
                size,
            )?
        }
        Codec::Lz4Block => lz4_block(packed, size)?,
        Codec::Lz4Hadoop => lz4_hadoop(packed, size)?,
        Codec::Lz4Frame => streamed("LZ4", lz4_flex::frame::FrameDecoder::new(packed), size)?,
        Codec::Zstd => zstd(packed, size)?,
        Codec::Bzip2 => streamed("bz2", bzip2_rs::DecoderReader::new(packed), size)?,
    };
    match unpacked.len() == size {
        true => Ok(unpacked),
        false => Err(format!(
            "decompressed to {} bytes, expected {size}",
            unpacked.len()
        )),
    }
}

/// Reader that unpacks `packed` to `size` bytes piece by piece. LZ4 and bzip2 are unpacked as a whole, up to [`limits::PAGE_BYTES`].
///
/// # Errors
/// Errors of [`unpack`]. Faults found later are errors of the returned reader.
pub(crate) fn stream(
    codec: Codec,
    mut packed: impl BufRead + 'static,
    size: u32,
) -> Result<Box<dyn Read>, String> {
    Ok(match codec {
        Codec::Plain => Box::new(packed),
        Codec::Gzip => Box::new(flate2::bufread::MultiGzDecoder::new(packed)),
        Codec::Brotli => Box::new(brotli_decompressor::Decompressor::new(packed, 64 << 10)),
        Codec::Zstd => Box::new(ZstdStream {
            packed,
            session: decompressor(u64::from(size))?.into_session(),
        }),
        Codec::Snappy => Box::new(SnappyStream::new(packed, size)?),
        Codec::Lz4Block | Codec::Lz4Hadoop | Codec::Lz4Frame | Codec::Bzip2 => {
            let mut whole = Vec::new();
            let limit = limits::PAGE_BYTES;
            let read = packed.by_ref().take(limit + 1).read_to_end(&mut whole);
            read.map_err(|error| error.to_string())?;
            if whole.len() as u64 > limit || u64::from(size) > limit {
                return Err(format!(
                    "a page of {size} bytes, at most {limit} are decompressed at once"
                ));
            }
            Box::new(Cursor::new(unpack(codec, &whole, size as usize)?))
        }
    })
}

/// Streaming decoder of Zstandard frames that verifies checksums.
struct ZstdStream<R: BufRead> {
    packed: R,
    session: DecoderSessionOwned,
}

impl<R: BufRead> Read for ZstdStream<R> {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        while !into.is_empty() && !self.session.is_finished() {
            let input = self.packed.fill_buf()?;
            let operation = match input.is_empty() {
                true => DecodeOperation::Finish,
                false => DecodeOperation::Process,
            };
            let progress = self.session.process(input, into, operation);
            let progress = progress.map_err(|failure| not_whole(&failure.error))?;
            self.packed.consume(progress.consumed);
            if progress.produced > 0 {
                return Ok(progress.produced);
            }
        }
        Ok(0)
    }
}

fn not_whole(error: &DecodeError) -> io::Error {
    io::Error::other(format!("incomplete Zstandard frame: {error}"))
}

/// Decoder of Zstandard frames of at most `size` bytes. Its window has `size` bytes, but at least the size for level 19.
fn decompressor(size: u64) -> Result<Decompressor, String> {
    let window = size.clamp(ZSTD_WINDOW_BYTES, limits::PAGE_BYTES.max(ZSTD_WINDOW_BYTES));
    let log = u8::try_from(window.next_power_of_two().ilog2()).unwrap_or(u8::MAX);
    let limits = DecodeLimits::default().with_max_window_log(log);
    let limits = limits.map_err(|error| error.to_string())?;
    let limits = limits.with_max_output_bytes(Some(size));
    Ok(Decompressor::new(
        DecoderConfig::default().with_limits(limits),
    ))
}

/// Reads at most `size + 1` bytes from `decoder`, so that the caller detects an excess. An error names the format `name`.
fn streamed(name: &str, decoder: impl Read, size: usize) -> Result<Vec<u8>, String> {
    let mut unpacked = Vec::new();
    decoder
        .take(size as u64 + 1)
        .read_to_end(&mut unpacked)
        .map_err(|error| format!("incomplete {name}: {error}"))?;
    Ok(unpacked)
}

fn snappy(packed: &[u8], size: usize) -> Result<Vec<u8>, String> {
    let wrong = |error: snap::Error| format!("incomplete Snappy block: {error}");
    let announced = snap::raw::decompress_len(packed).map_err(wrong)?;
    if announced != size {
        return Err(format!(
            "{} bytes of Snappy announce {announced} unpacked bytes, expected {size}",
            packed.len()
        ));
    }
    if size > packed.len().saturating_mul(SNAPPY_GROWTH) {
        return Err(format!(
            "{} bytes of Snappy cannot hold {size}",
            packed.len()
        ));
    }
    snap::raw::Decoder::new()
        .decompress_vec(packed)
        .map_err(wrong)
}

fn lz4_block(packed: &[u8], size: usize) -> Result<Vec<u8>, String> {
    if size > packed.len().saturating_mul(LZ4_GROWTH) {
        return Err(format!("{} bytes of LZ4 cannot hold {size}", packed.len()));
    }
    let mut unpacked = vec![0; size];
    let length = lz4_flex::block::decompress_into(packed, &mut unpacked)
        .map_err(|error| format!("incomplete LZ4 block: {error}"))?;
    unpacked.truncate(length);
    Ok(unpacked)
}

fn lz4_hadoop(packed: &[u8], size: usize) -> Result<Vec<u8>, String> {
    let mut unpacked = Vec::new();
    let mut rest = packed;
    while let Some((sizes, after)) = rest.split_first_chunk::<8>() {
        let [a, b, c, d, e, f, g, h] = *sizes;
        let whole = u32::from_be_bytes([a, b, c, d]) as usize;
        let part = u32::from_be_bytes([e, f, g, h]) as usize;
        let block = after.get(..part).ok_or("an LZ4 block is cut short")?;
        if whole > size - unpacked.len() {
            return Err(format!("LZ4 blocks hold more than {size} bytes"));
        }
        unpacked.extend_from_slice(&lz4_block(block, whole)?);
        rest = &after[part..];
    }
    match rest.is_empty() {
        true => Ok(unpacked),
        false => Err("bytes after the last LZ4 block".to_owned()),
    }
}

fn zstd(packed: &[u8], size: usize) -> Result<Vec<u8>, String> {
    // A stream without frames has no bytes.
    if packed.is_empty() {
        return Ok(Vec::new());
    }
    let mut unpacked = Vec::new();
    let decoded = decompressor(size as u64)?.decompress_into(packed, &mut unpacked);
    decoded.map_err(|error| not_whole(&error).to_string())?;
    Ok(unpacked)
}

/// Unpacks a message that is one Zstandard frame of at most `most` bytes.
///
/// # Errors
/// Error message about the invalid frame.
pub(crate) fn zstandard_message(packed: &[u8], most: u64) -> Result<Vec<u8>, String> {
    let mut unpacked = Vec::new();
    let decoded = decompressor(most)?.decompress_into(packed, &mut unpacked);
    decoded.map_err(|error| not_whole(&error).to_string())?;
    Ok(unpacked)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_block_that_cannot_hold_what_it_announces_is_refused_before_it_is_unpacked() {
        let bomb = [0xff, 0xff, 0xff, 0xff, 0x0f, 0];
        for codec in [Codec::Snappy, Codec::Lz4Block] {
            let problem = unpack(codec, &bomb, u32::MAX as usize).expect_err("too much");
            assert!(problem.contains("4294967295"), "{problem}");
        }
    }

    #[test]
    fn another_size_than_announced_is_an_error() {
        assert_eq!(unpack(Codec::Plain, b"abc", 3), Ok(b"abc".to_vec()));
        assert!(unpack(Codec::Plain, b"abc", 2).is_err());
        let mut packed = Vec::new();
        flate2::read::GzEncoder::new(&[7_u8; 1000][..], flate2::Compression::fast())
            .read_to_end(&mut packed)
            .expect("packs");
        assert_eq!(unpack(Codec::Gzip, &packed, 1000), Ok(vec![7; 1000]));
        assert_eq!(
            unpack(Codec::Gzip, &packed, 999),
            Err("decompressed to 1000 bytes, expected 999".to_owned())
        );
        assert!(unpack(Codec::Gzip, &packed[..packed.len() - 1], 1000).is_err());
    }

    #[test]
    fn blocks_of_hadoop_are_joined() {
        let mut packed = Vec::new();
        for part in [&b"force "[..], b"and torque"] {
            let block = lz4_flex::block::compress(part);
            packed.extend_from_slice(&u32::try_from(part.len()).expect("short").to_be_bytes());
            packed.extend_from_slice(&u32::try_from(block.len()).expect("short").to_be_bytes());
            packed.extend_from_slice(&block);
        }
        assert_eq!(
            unpack(Codec::Lz4Hadoop, &packed, 16),
            Ok(b"force and torque".to_vec())
        );
        assert!(unpack(Codec::Lz4Hadoop, &packed, 15).is_err());
        assert!(unpack(Codec::Lz4Hadoop, &packed[..packed.len() - 1], 16).is_err());
    }
}
