//! Codecs of chunks, and the inverse of each.

use crate::codec::{blosc, gzip, lz4_with_length, zlib, zstd};
use crate::error::Problem;
use crate::order::c_order;
use crate::scalar::shown;

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Codec {
    /// Transposition: the numbers of the array axes in their stored order, slowest first.
    Transposed(Vec<usize>),
    Gzip,
    Zlib,
    Zstd,
    Blosc,
    Lz4,
    Crc32c,
}

impl Codec {
    /// Codec with this name in zarr version 2 or 3.
    pub(crate) fn from_name(name: &str) -> Result<Codec, Problem> {
        match name.trim_start_matches("numcodecs.") {
            "gzip" => Ok(Codec::Gzip),
            "zlib" => Ok(Codec::Zlib),
            "zstd" => Ok(Codec::Zstd),
            "blosc" => Ok(Codec::Blosc),
            "lz4" => Ok(Codec::Lz4),
            "crc32c" => Ok(Codec::Crc32c),
            other => Err(Problem::unsupported(
                format!("chunks compressed by `{}`", shown(other)),
                "write it without compression, or with gzip, zlib, zstd, lz4 or blosc",
            )),
        }
    }

    /// True for compression, whose output length depends on the compressed chunk.
    pub(crate) fn is_packing(&self) -> bool {
        !matches!(self, Codec::Transposed(_) | Codec::Crc32c)
    }

    /// Reverses the codec for a chunk with the axis lengths `sides` and elements of `item_bytes` bytes. Rejects an output of more than `most` bytes.
    pub(crate) fn undo(
        &self,
        chunk: Vec<u8>,
        most: usize,
        sides: &[u64],
        item_bytes: usize,
    ) -> Result<Vec<u8>, Problem> {
        match self {
            Codec::Transposed(order) => c_order(&chunk, sides, order, item_bytes),
            Codec::Gzip => gzip(&chunk, most),
            Codec::Zlib => zlib(&chunk, most),
            Codec::Zstd => zstd(&chunk, most),
            Codec::Blosc => blosc(&chunk, most),
            Codec::Lz4 => lz4_with_length(&chunk, most),
            Codec::Crc32c => without_sum(chunk),
        }
    }
}

/// Verifies and removes the checksum (CRC-32C, little-endian) at the end of a chunk.
fn without_sum(mut chunk: Vec<u8>) -> Result<Vec<u8>, Problem> {
    let at = chunk.len() as u64;
    let Some((bytes, sum)) = chunk.split_last_chunk::<4>() else {
        return Err(Problem::damaged(at, "the end", "a checksum of 4 bytes"));
    };
    let (computed, stated) = (crc32c(bytes), u32::from_le_bytes(*sum));
    if computed != stated {
        return Err(Problem::Checksum {
            what: "a chunk".to_owned(),
            stated,
            computed,
        });
    }
    chunk.truncate(chunk.len() - 4);
    Ok(chunk)
}

/// Reversed polynomial of CRC-32C.
const CASTAGNOLI: u32 = 0x82f6_3b78;

fn crc32c(bytes: &[u8]) -> u32 {
    let mut table = [0_u32; 256];
    for (number, entry) in (0_u32..).zip(table.iter_mut()) {
        *entry = (0..8).fold(number, |sum, _| {
            if sum & 1 == 1 {
                sum >> 1 ^ CASTAGNOLI
            } else {
                sum >> 1
            }
        });
    }
    let folded = bytes.iter().fold(u32::MAX, |sum, byte| {
        let low = sum.to_le_bytes()[0];
        sum >> 8 ^ table[usize::from(low ^ byte)]
    });
    !folded
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sum_of_castagnoli_is_that_of_its_standard() {
        // Check value of CRC-32C (RFC 3720 uses the same checksum).
        assert_eq!(crc32c(b"123456789"), 0xe306_9283);
    }
}
