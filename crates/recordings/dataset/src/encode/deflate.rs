//! Zlib streams of Huffman codes, without a search for repetitions. The length of a stream is known before it is written.
//!
//! Streams equal those of `miniz_oxide` with the strategy `HuffmanOnly` byte for byte, so recordings of one seed stay equal.

use super::bits::{BitWriter, Bits};
use super::huffman;

/// Size of a block, bytes. Each block has a separate Huffman code.
const BLOCK: usize = 31 * 1024 + 1;
/// Size of a block, bytes, from which a separate code is used. Shorter blocks use the fixed code of the format.
const SHORTEST_CODED: usize = 48;
/// Number of symbols of a code: 256 byte values, and the end of a block.
const SYMBOLS: usize = 257;
const END: usize = 256;
/// Zlib header: deflate with a window of 32 KiB, and check bits that make the header a multiple of 31.
const HEADER: [u8; 2] = [0x78, 0x01];

/// Planned zlib stream, not yet written.
#[derive(Debug)]
pub(super) struct Stream {
    /// Code of each block; `None` for a block that is stored uncompressed.
    blocks: Vec<Option<Coding>>,
    length: usize,
}

impl Stream {
    pub(super) fn plan(bytes: &[u8]) -> Stream {
        let mut bits = 8 * HEADER.len();
        let blocks = blocks(bytes).map(|block| {
            let (coding, length) = plan_block(block, bits + 1);
            bits += 1 + length;
            coding
        });
        let blocks = blocks.collect();
        Stream {
            blocks,
            length: bits.div_ceil(8) + size_of::<u32>(),
        }
    }

    /// Length of the stream, bytes.
    pub(super) fn len(&self) -> usize {
        self.length
    }

    /// Appends the stream to `file`. `bytes` must be the bytes for which the stream was planned.
    pub(super) fn write(&self, bytes: &[u8], file: Vec<u8>) -> Vec<u8> {
        let mut out = BitWriter::behind(file, self.length);
        out.put_bytes(&HEADER);
        let mut left = self.blocks.len();
        for (block, coding) in blocks(bytes).zip(&self.blocks) {
            left -= 1;
            out.put(Bits::new(u16::from(left == 0), 1));
            match coding {
                Some(coding) => coding.write(block, &mut out),
                None => write_stored(block, &mut out),
            }
        }
        out.put_bytes(&adler32(bytes).to_be_bytes());
        out.finish()
    }
}

/// Blocks of `bytes`. The last block is shorter than the other blocks, and may be empty.
fn blocks(bytes: &[u8]) -> impl Iterator<Item = &[u8]> {
    let whole = bytes.len() / BLOCK * BLOCK;
    bytes[..whole].chunks(BLOCK).chain([&bytes[whole..]])
}

/// Code of a block, and its length in bits, counted from the type of the block. The type begins at bit `bits` of the stream.
fn plan_block(block: &[u8], bits: usize) -> (Option<Coding>, usize) {
    let counts = counts(block);
    let coding = if block.len() < SHORTEST_CODED {
        Coding::of_format()
    } else {
        Coding::for_counts(&counts)
    };
    let coded = coding.bits(&counts);
    let held = bits % 8;
    if block.len() > 32 && (held + coded) / 8 + 1 >= block.len() {
        let padded = (held + 2).next_multiple_of(8) - held;
        (None, padded + 8 * (4 + block.len()))
    } else {
        (Some(coding), coded)
    }
}

/// Frequency of each byte in `block`, and 1 for the end of the block.
fn counts(block: &[u8]) -> [u32; SYMBOLS] {
    // Four tables, so that a count need not wait for the count of an equal neighbour.
    let mut apart = [[0_u32; 256]; 4];
    let (fours, rest) = block.as_chunks::<4>();
    for four in fours {
        for (counts, byte) in apart.iter_mut().zip(four) {
            counts[usize::from(*byte)] += 1;
        }
    }
    for byte in rest {
        apart[0][usize::from(*byte)] += 1;
    }
    let mut counts = [1; SYMBOLS];
    for (symbol, count) in counts[..END].iter_mut().enumerate() {
        *count = apart.iter().map(|counts| counts[symbol]).sum();
    }
    counts
}

/// Writes a stored block: length, complement of the length, and bytes.
fn write_stored(block: &[u8], out: &mut BitWriter) {
    const STORED: Bits = Bits::new(0, 2);
    out.put(STORED);
    let length = u16::try_from(block.len()).expect("a block has less than 32 KiB");
    out.put_bytes(&length.to_le_bytes());
    out.put_bytes(&(!length).to_le_bytes());
    out.put_bytes(block);
}

/// Huffman code of a block.
#[derive(Debug)]
struct Coding {
    /// Type of the block. For a separate code, also the lengths of its code words.
    header: Vec<Bits>,
    literals: [Bits; 256],
    end: Bits,
}

impl Coding {
    /// Fixed code of the format, which is stored without lengths.
    fn of_format() -> Coding {
        let mut lengths = [8; 288];
        lengths[144..256].fill(9);
        lengths[256..280].fill(7);
        Coding::new(vec![Bits::new(0b01, 2)], &huffman::words(&lengths))
    }

    fn for_counts(counts: &[u32; SYMBOLS]) -> Coding {
        let lengths = huffman::lengths(counts, 15);
        Coding::new(lengths_header(&lengths), &huffman::words(&lengths))
    }

    fn new(header: Vec<Bits>, words: &[Bits]) -> Coding {
        let mut literals = [Bits::default(); 256];
        literals.copy_from_slice(&words[..END]);
        let end = words[END];
        Coding {
            header,
            literals,
            end,
        }
    }

    /// Length of a block with the symbol frequencies `counts`, bits.
    fn bits(&self, counts: &[u32; SYMBOLS]) -> usize {
        let header: usize = self.header.iter().map(|bits| usize::from(bits.count)).sum();
        let words = self.literals.iter().chain([&self.end]);
        let coded = words
            .zip(counts)
            .map(|(word, count)| usize::from(word.count) * *count as usize);
        header + coded.sum::<usize>()
    }

    fn write(&self, block: &[u8], out: &mut BitWriter) {
        for bits in &self.header {
            out.put(*bits);
        }
        out.put_words(&self.literals, block);
        out.put(self.end);
    }
}

/// Header of a block with a separate code: the lengths of its code words, compressed with another code.
fn lengths_header(lengths: &[u8; SYMBOLS]) -> Vec<Bits> {
    /// Order in which the format stores the code that compresses the lengths.
    const ORDER: [usize; 19] = [
        16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15,
    ];
    // The lengths end with one distance, which no block uses.
    let mut sizes = lengths.to_vec();
    sizes.push(0);
    let runs = runs(&sizes);
    let mut counts = [0; 19];
    for (symbol, _) in &runs {
        counts[usize::from(*symbol)] += 1;
    }
    let sizes = huffman::lengths(&counts, 7);
    let words = huffman::words(&sizes);
    let used = ORDER.iter().rposition(|symbol| sizes[*symbol] != 0);
    let used = used.map_or(4, |last| last + 1).max(4);
    let number = u16::try_from(used - 4).expect("of 19");
    // Type, 257 literals and ends, one distance.
    let mut header = vec![
        Bits::new(0b10, 2),
        Bits::new(0, 5),
        Bits::new(0, 5),
        Bits::new(number, 4),
    ];
    header.extend(
        ORDER[..used]
            .iter()
            .map(|symbol| Bits::new(sizes[*symbol].into(), 3)),
    );
    for (symbol, extra) in runs {
        header.extend([words[usize::from(symbol)], extra]);
    }
    header
}

/// Run-length encoding of `sizes`. Each symbol is a size, or a repetition with its count in the following bits.
fn runs(sizes: &[u8]) -> Vec<(u8, Bits)> {
    let mut runs = Vec::new();
    for run in sizes.chunk_by(|one, next| one == next) {
        let (size, mut left) = (run[0], run.len());
        let once = (size, Bits::default());
        let mut most = 138;
        if size != 0 {
            // A repetition repeats the previous size.
            runs.push(once);
            left -= 1;
            most = 6;
        }
        while left > 0 {
            let count = left.min(most);
            left -= count;
            let number = u16::try_from(count).expect("at most 138");
            match (size, number) {
                (_, ..3) => runs.extend(std::iter::repeat_n(once, count)),
                (0, ..11) => runs.push((17, Bits::new(number - 3, 3))),
                (0, _) => runs.push((18, Bits::new(number - 11, 7))),
                _ => runs.push((16, Bits::new(number - 3, 2))),
            }
        }
    }
    runs
}

/// Adler-32 checksum of zlib: 1 plus the sum of the bytes, and the sum of the partial sums.
fn adler32(bytes: &[u8]) -> u32 {
    const MODULUS: u32 = 65_521;
    /// Number of bytes whose sums fit into 32 bits.
    const PART: usize = 1 << 12;
    const LANES: usize = 16;
    let (mut sum, mut sums) = (1, 0);
    for part in bytes.chunks(PART) {
        let (rows, rest) = part.as_chunks::<LANES>();
        // Each lane has its own sums, so that many bytes are added at once.
        let (mut lanes, mut earlier) = ([0_u32; LANES], [0_u32; LANES]);
        for row in rows {
            for ((lane, earlier), byte) in lanes.iter_mut().zip(&mut earlier).zip(row) {
                *earlier += *lane;
                *lane += u32::from(*byte);
            }
        }
        let in_rows = u32::try_from(part.len() - rest.len()).expect("at most a part");
        sums += sum * in_rows;
        for (weight, (lane, earlier)) in (1..=16).rev().zip(lanes.iter().zip(&earlier)) {
            sum += lane;
            sums += weight * lane + 16 * earlier;
        }
        for byte in rest {
            sum += u32::from(*byte);
            sums += sum;
        }
        sum %= MODULUS;
        sums %= MODULUS;
    }
    sums << 16 | sum
}

#[cfg(test)]
mod tests {
    use miniz_oxide::deflate::core::{
        CompressionStrategy, CompressorOxide, TDEFLFlush, compress_to_output,
        create_comp_flags_from_zip_params,
    };

    use super::*;

    /// Stream of `miniz_oxide` without a search for repetitions.
    fn expected(bytes: &[u8]) -> Vec<u8> {
        let strategy = CompressionStrategy::HuffmanOnly as i32;
        let mut compressor =
            CompressorOxide::new(create_comp_flags_from_zip_params(1, 15, strategy));
        let mut stream = Vec::new();
        compress_to_output(&mut compressor, bytes, TDEFLFlush::Finish, |out| {
            stream.extend_from_slice(out);
            true
        });
        stream
    }

    fn assert_same(bytes: &[u8], about: &str) {
        let stream = Stream::plan(bytes);
        let written = stream.write(bytes, Vec::new());
        assert_eq!(
            written.len(),
            stream.len(),
            "{about}, {} bytes",
            bytes.len()
        );
        assert!(written == expected(bytes), "{about}, {} bytes", bytes.len());
    }

    /// Bytes that `make` computes, each from 24 bits of a linear congruential generator.
    fn bytes(length: usize, make: impl Fn(u32) -> u8) -> Vec<u8> {
        let mut state = 7_u32;
        let mut next = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            make(state >> 8)
        };
        (0..length).map(|_| next()).collect()
    }

    const LENGTHS: [usize; 15] = [
        0, 1, 2, 31, 32, 33, 47, 48, 49, 1_000, 31_744, 31_745, 31_746, 31_790, 100_000,
    ];

    #[test]
    fn streams_equal_those_of_another_program_byte_for_byte() {
        let low = |byte: u32| byte.to_le_bytes()[0];
        for length in LENGTHS {
            assert_same(&bytes(length, |_| 200), "one byte");
            assert_same(&bytes(length, low), "noise, which no code shortens");
            for bits in 1..8 {
                assert_same(
                    &bytes(length, |even| low(even) >> bits),
                    "noise of a few bits",
                );
            }
            for step in [1, 2, 3, 5, 9] {
                let rare = |even: u32| low(even.leading_zeros() * step);
                assert_same(&bytes(length, rare), "half as many of each further byte");
                let sparse = |even: u32| low(even.leading_zeros() * step) ^ low(even & 1) << 7;
                assert_same(&bytes(length, sparse), "gaps between bytes");
            }
        }
    }

    #[test]
    fn blocks_that_a_code_just_shortens_equal_too() {
        for length in 48..300 {
            let noise = bytes(length, |even| even.to_le_bytes()[0] >> 2);
            assert_same(&noise, "noise of six bits");
        }
    }

    #[test]
    fn words_that_would_be_longer_than_the_format_allows_equal_too() {
        // Counts that grow like Fibonacci numbers give the deepest tree. The first count is the end of the block.
        let mut deep = Vec::new();
        let (mut one, mut next) = (1, 2);
        for byte in 0..20 {
            deep.extend(std::iter::repeat_n(byte, one));
            (one, next) = (next, one + next);
        }
        assert_same(&deep, "Fibonacci");
        let wide: Vec<u8> = deep.iter().map(|byte| byte * 12).collect();
        assert_same(&wide, "Fibonacci, with gaps");
    }

    #[test]
    fn lengths_whose_words_would_be_longer_than_the_format_allows_equal_too() {
        // Numbers of bytes that occur once, twice, four times and so on. The code of their lengths would have words of 8 bits; the format allows 7.
        let numbers = [5, 1, 0, 111, 10, 27, 2, 0, 16, 4];
        let powers: Vec<usize> = (0..10)
            .zip(numbers)
            .flat_map(|(power, number)| std::iter::repeat_n(1_usize << power, number))
            .collect();
        // Equal lengths are apart, because a run of them has its own symbol.
        let apart: Vec<u8> = (0..176_u8)
            .flat_map(|byte| std::iter::repeat_n(byte, powers[usize::from(byte) * 43 % 176]))
            .collect();
        assert_same(&apart, "lengths in words of 8 bits");
    }

    #[test]
    fn the_checksum_is_that_of_zlib() {
        assert_eq!(adler32(b"Wikipedia"), 0x11E6_0398);
        let long = vec![255; 100_003];
        let (_, sum) = expected(&long)
            .split_last_chunk::<4>()
            .map(|(a, b)| (a.len(), *b))
            .expect("a sum");
        assert_eq!(adler32(&long).to_be_bytes(), sum);
    }
}
