//! Patch for data layout version 5, which HDF5 2.0 writes for filtered chunks. `hdf5-pure` does not support version 5, so 5 is replaced by 4.
//!
//! Both versions have the same message. Only the width of chunk sizes in an index differs, which the header of the index states.

use super::lookup3::lookup3;

/// Type of the data layout message.
const DATA_LAYOUT: u8 = 8;
/// Greatest type number of a header message in the format specification of HDF5 4.0.
const LAST_MESSAGE: u8 = 0x18;
/// Flag of an object header that stores the creation order. `THRESHOLDS` and `TIMES` flag attribute thresholds and times.
const ORDERED: u8 = 4;
const THRESHOLDS: u8 = 16;
const TIMES: u8 = 32;
/// Size of the checksum at the end of a block, bytes.
const CHECKSUM: usize = 4;

/// Lowers version 5 of the data layout messages in one complete block of an object header to version 4. The checksum of the block is updated. A block
/// with a wrong checksum is unchanged.
pub(super) fn lower(block: &mut [u8]) {
    let places = layouts(block);
    let Some(end) = block
        .len()
        .checked_sub(CHECKSUM)
        .filter(|_| !places.is_empty())
    else {
        return;
    };
    if block[end..] != lookup3(&block[..end]).to_le_bytes() {
        return;
    }
    for place in places {
        block[place] = 4;
    }
    let sum = lookup3(&block[..end]);
    block[end..].copy_from_slice(&sum.to_le_bytes());
}

/// Offsets of the version bytes of layout messages of version 5 in `block`.
fn layouts(block: &[u8]) -> Vec<usize> {
    match block {
        [b'O', b'H', b'D', b'R', 2, flags, ..] => {
            let optional = |flag, bytes| if flags & flag == 0 { 0 } else { bytes };
            let start = 6 + optional(TIMES, 16) + optional(THRESHOLDS, 4) + (1 << (flags & 3));
            walk(block, start, 4 + optional(ORDERED, 2)).unwrap_or_default()
        }
        // A continuation block does not repeat the flags.
        [b'O', b'C', b'H', b'K', ..] => walk(block, 4, 4)
            .or_else(|| walk(block, 4, 6))
            .unwrap_or_default(),
        _ => Vec::new(),
    }
}

/// Offsets of the version bytes among messages that begin at `start`, each after a head of `head` bytes. `None` if the messages do not fill the block exactly.
fn walk(block: &[u8], start: usize, head: usize) -> Option<Vec<usize>> {
    let end = block.len().checked_sub(CHECKSUM)?;
    let (mut at, mut places) = (start, Vec::new());
    while at + head <= end {
        let length = usize::from(u16::from_le_bytes([block[at + 1], block[at + 2]]));
        let body = at + head;
        if block[at] > LAST_MESSAGE || body + length > end {
            return None;
        }
        if block[at] == DATA_LAYOUT && length > 1 && block[body] == 5 {
            places.push(body);
        }
        at = body + length;
    }
    (at <= end).then_some(places)
}

#[cfg(test)]
mod tests {
    use super::super::structures::header;
    use super::*;

    /// Builds a continuation block of an object header for a test. Each message has a head of `head` bytes.
    fn continuation(messages: &[(u8, Vec<u8>)], head: usize) -> Vec<u8> {
        let mut block = b"OCHK".to_vec();
        for (number, body) in messages {
            let length = u8::try_from(body.len()).expect("short");
            block.extend([*number, length, 0, 0]);
            block.resize(block.len() + head - 4, 0xff);
            block.extend(body);
        }
        let sum = lookup3(&block);
        block.extend(sum.to_le_bytes());
        block
    }

    fn messages(version: u8) -> Vec<(u8, Vec<u8>)> {
        vec![
            (1, vec![2, 1, 0, 0]),
            (DATA_LAYOUT, vec![version, 2, 1, 2, 3]),
            (0x0c, vec![5; 9]),
        ]
    }

    #[test]
    fn version_5_becomes_4_with_the_checksum_of_4_in_headers_and_continuations() {
        let mut block = header(&messages(5));
        lower(&mut block);
        assert_eq!(block, header(&messages(4)));
        for head in [4, 6] {
            let mut block = continuation(&messages(5), head);
            lower(&mut block);
            assert_eq!(block, continuation(&messages(4), head), "{head}");
        }
    }

    #[test]
    fn blocks_that_are_damaged_or_cut_and_other_bytes_stay_as_they_are() {
        let whole = header(&messages(5));
        let cut = (0..whole.len()).map(|end| whole[..end].to_vec());
        let flipped = (6..whole.len()).map(|place| {
            let mut bytes = whole.clone();
            bytes[place] ^= 1;
            bytes
        });
        for bytes in cut
            .chain(flipped)
            .chain([header(&messages(6)), vec![5; 90]])
        {
            let mut lowered = bytes.clone();
            lower(&mut lowered);
            assert_eq!(lowered, bytes);
        }
    }
}
