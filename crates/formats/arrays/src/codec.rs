//! Decompressors of whole buffers. Each decompressor limits its output, in bytes, and fails above the limit.

mod blosc;
mod shuffle;

pub(crate) use blosc::blosc;

use std::fmt::Display;

use mzstd::{DecodeError, DecodeLimits, DecoderConfig, Decompressor};

use crate::error::Problem;
use crate::inflate::{Wrapping, inflated_at_most};

/// Window size that zstd needs for levels up to 19, bytes.
const ZSTD_WINDOW_BYTES: usize = 8 << 20;

/// Decompresses a zlib stream and verifies its checksum.
pub(crate) fn zlib(packed: &[u8], most: usize) -> Result<Vec<u8>, Problem> {
    inflated_at_most(packed, most, Wrapping::Zlib).map(|(bytes, _)| bytes)
}

/// Decompresses a gzip file (RFC 1952). Verifies its checksum and length.
pub(crate) fn gzip(packed: &[u8], most: usize) -> Result<Vec<u8>, Problem> {
    let cut = || {
        Problem::damaged(
            packed.len() as u64,
            "the end",
            "a header or trailer of gzip",
        )
    };
    let [0x1f, 0x8b, 8, flags, _, _, _, _, _, _, rest @ ..] = packed else {
        return Err(Problem::damaged(0, "not gzip data", "a gzip header"));
    };
    let mut rest = rest;
    if flags & 4 != 0 {
        let (length, behind) = rest.split_first_chunk::<2>().ok_or_else(cut)?;
        rest = behind
            .get(usize::from(u16::from_le_bytes(*length))..)
            .ok_or_else(cut)?;
    }
    // The name and the comment end with a zero byte.
    for flag in [8, 16] {
        if flags & flag != 0 {
            let end = rest.iter().position(|byte| *byte == 0).ok_or_else(cut)?;
            rest = &rest[end + 1..];
        }
    }
    if flags & 2 != 0 {
        rest = rest.get(2..).ok_or_else(cut)?;
    }
    let (bytes, used) = inflated_at_most(rest, most, Wrapping::Raw)?;
    let trailer = rest
        .get(used..used + 8)
        .and_then(|trailer| trailer.split_first_chunk::<4>());
    let (sum, length) = trailer.ok_or_else(cut)?;
    let (stated, computed) = (u32::from_le_bytes(*sum), crc32fast::hash(&bytes));
    if stated != computed
        || (bytes.len() & 0xffff_ffff) as u64
            != u64::from(u32::from_le_bytes([
                length[0], length[1], length[2], length[3],
            ]))
    {
        return Err(Problem::Checksum {
            what: "the compressed data of gzip".to_owned(),
            stated,
            computed,
        });
    }
    Ok(bytes)
}

/// Decompresses zstd frames. Verifies their checksums if present.
pub(crate) fn zstd(packed: &[u8], most: usize) -> Result<Vec<u8>, Problem> {
    // A stream without frames has no bytes.
    if packed.is_empty() {
        return Ok(Vec::new());
    }
    let window = most.max(ZSTD_WINDOW_BYTES).next_power_of_two();
    let log = u8::try_from(window.ilog2()).unwrap_or(u8::MAX);
    let wrong =
        |problem: &dyn Display| Problem::damaged(0, format!("not a zstd frame: {problem}"), "one");
    let limits = DecodeLimits::default().with_max_window_log(log);
    let limits = limits.map_err(|error| wrong(&error))?;
    let limits = limits.with_max_output_bytes(Some(most as u64));
    let mut decoder = Decompressor::new(DecoderConfig::default().with_limits(limits));
    let mut bytes = Vec::new();
    match decoder.decompress_into(packed, &mut bytes) {
        Ok(_) => Ok(bytes),
        Err(DecodeError::ChecksumMismatch { expected, computed }) => Err(Problem::Checksum {
            what: "a zstd frame".to_owned(),
            stated: expected,
            computed,
        }),
        Err(DecodeError::OutputLimitExceeded { .. }) => Err(Problem::damaged(
            0,
            format!("more than {most} bytes"),
            "at most the size of a chunk",
        )),
        Err(error) => Err(wrong(&error)),
    }
}

/// Unpacks one LZ4 block, whose output must fill `bytes`.
pub(crate) fn lz4(packed: &[u8], bytes: &mut [u8]) -> Result<(), Problem> {
    let expected = bytes.len();
    match lz4_flex::block::decompress_into(packed, bytes) {
        Ok(made) if made == expected => Ok(()),
        Ok(made) => Err(Problem::damaged(
            0,
            format!("an LZ4 block unpacks to {made} bytes"),
            format!("{expected}"),
        )),
        Err(error) => Err(Problem::damaged(
            0,
            format!("not an LZ4 block: {error}"),
            format!("{expected} bytes"),
        )),
    }
}

/// Unpacks an LZ4 block. Four bytes with the unpacked length precede the block.
pub(crate) fn lz4_with_length(packed: &[u8], most: usize) -> Result<Vec<u8>, Problem> {
    let length = packed.split_first_chunk::<4>();
    let (length, block) =
        length.ok_or_else(|| Problem::damaged(0, "the end", "the length of an LZ4 block"))?;
    let length = usize::try_from(u32::from_le_bytes(*length)).unwrap_or(usize::MAX);
    if length > most {
        return Err(Problem::damaged(
            0,
            format!("an LZ4 block states {length} bytes"),
            format!("at most {most}"),
        ));
    }
    let mut bytes = vec![0; length];
    lz4(block, &mut bytes)?;
    Ok(bytes)
}
