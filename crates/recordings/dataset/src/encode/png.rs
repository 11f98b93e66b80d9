//! PNG encoder for noisy pictures: applies the five filters of the format, then only Huffman codes.
//!
//! After filtering, a camera picture is mostly noise, without repetitions. The search for repetitions is the slow part of deflate. The search finds only
//! accidental repetitions, which make files of the simulated cameras a fifth larger. Without the search, a uniform picture shrinks to an eighth at best.

use std::borrow::Cow;

use taceva_core::{Frame, PixelFormat};

use super::deflate::Stream;
use crate::limits;

const SIGNATURE: &[u8; 8] = b"\x89PNG\r\n\x1a\n";
/// Size of a chunk without its data, bytes: length, type and checksum.
const CHUNK: usize = 12;
/// Size of the data of the header chunk `IHDR`, bytes.
const FORM: usize = 13;

/// PNG file of a frame, whose length is known before it is written.
#[derive(Debug)]
pub(crate) struct PngFile {
    form: [u8; FORM],
    filtered: Vec<u8>,
    stream: Stream,
}

impl PngFile {
    /// Plans the file of `frame`.
    ///
    /// # Errors
    /// Error message if [`decode`](crate::decode::decode) would refuse the file.
    pub(crate) fn plan(frame: &Frame) -> Result<PngFile, String> {
        let info = frame.info();
        let is_read = |side: u32| (1..=limits::IMAGE_SIDE).contains(&side);
        if !is_read(info.width) || !is_read(info.height) {
            return Err(format!(
                "a frame of {info}, expected sides of 1 to {} pixels",
                limits::IMAGE_SIDE
            ));
        }
        let bytes = frame.bytes().len() as u64;
        if bytes > limits::DECODED_BYTES {
            return Err(format!(
                "a frame of {info} in {bytes} bytes, expected at most {}",
                limits::DECODED_BYTES
            ));
        }
        let (bits, color, pixel) = match info.format {
            PixelFormat::Gray8 => (8, 0, 1),
            PixelFormat::Gray16 => (16, 0, 2),
            PixelFormat::Rgb8 => (8, 2, 3),
            PixelFormat::Rgb16 => (16, 2, 6),
            other => return Err(format!("PNG has no pixels of type {}", other.name())),
        };
        let mut form = [0; FORM];
        form[..4].copy_from_slice(&info.width.to_be_bytes());
        form[4..8].copy_from_slice(&info.height.to_be_bytes());
        // Deflate, the five filters, not interlaced.
        form[8..].copy_from_slice(&[bits, color, 0, 0, 0]);
        let filtered = filtered(&samples(frame), info.width as usize * pixel, pixel);
        let stream = Stream::plan(&filtered);
        let file = PngFile {
            form,
            filtered,
            stream,
        };
        let bytes = file.len() as u64;
        if bytes > limits::IMAGE_BYTES {
            return Err(format!(
                "a frame of {info} in a file of {bytes} bytes, expected at most {}",
                limits::IMAGE_BYTES
            ));
        }
        Ok(file)
    }

    /// Length of the file, bytes.
    pub(crate) fn len(&self) -> usize {
        SIGNATURE.len() + CHUNK + FORM + CHUNK + self.stream.len() + CHUNK
    }

    pub(crate) fn write(&self) -> Vec<u8> {
        let mut file = Vec::with_capacity(self.len() + size_of::<u64>());
        file.extend(SIGNATURE);
        chunk(&mut file, b"IHDR", |mut file| {
            file.extend(self.form);
            file
        });
        chunk(&mut file, b"IDAT", |file| {
            self.stream.write(&self.filtered, file)
        });
        chunk(&mut file, b"IEND", |file| file);
        file
    }
}

/// Appends a chunk, whose data `write` appends.
fn chunk(file: &mut Vec<u8>, kind: &[u8; 4], write: impl FnOnce(Vec<u8>) -> Vec<u8>) {
    let start = file.len();
    file.extend([0; 4]);
    file.extend(kind);
    *file = write(std::mem::take(file));
    let length = u32::try_from(file.len() - start - 8).expect("a file has at most 256 MiB");
    file[start..start + 4].copy_from_slice(&length.to_be_bytes());
    let check = crc32fast::hash(&file[start + 4..]);
    file.extend(check.to_be_bytes());
}

/// Pixel values in the byte order of PNG, high byte first.
fn samples(frame: &Frame) -> Cow<'_, [u8]> {
    match frame.info().format.bytes_per_sample() {
        1 => Cow::Borrowed(frame.bytes()),
        _ => Cow::Owned(frame.samples().flat_map(u16::to_be_bytes).collect()),
    }
}

/// Filtered rows, each preceded by the number of its filter. Each row uses the filter with the smallest sum of magnitudes.
fn filtered(samples: &[u8], row: usize, pixel: usize) -> Vec<u8> {
    let mut filtered = Vec::with_capacity(samples.len() + samples.len() / row.max(1) + 1);
    let nothing = vec![0; row];
    let mut above: &[u8] = &nothing;
    let mut tried = vec![0; row];
    let mut least = vec![0; row];
    for current in samples.chunks_exact(row.max(1)) {
        let mut best = (u64::MAX, 0);
        for filter in 0..FILTERS {
            apply(filter, current, above, pixel, &mut tried);
            let left = magnitude(&tried);
            if left < best.0 {
                best = (left, filter);
                std::mem::swap(&mut tried, &mut least);
            }
        }
        filtered.push(best.1);
        filtered.extend_from_slice(&least);
        above = current;
    }
    filtered
}

/// Sum of the magnitudes of `bytes`, read as signed numbers.
fn magnitude(bytes: &[u8]) -> u64 {
    /// Number of magnitudes whose sum fits into 32 bits.
    const PART: usize = 1 << 24;
    let parts = bytes.chunks(PART).map(|part| {
        let magnitudes = part.iter().map(|byte| (*byte).min(byte.wrapping_neg()));
        magnitudes.map(u32::from).sum::<u32>()
    });
    parts.map(u64::from).sum()
}

/// Number of filters: none, left, above, the mean of both, and Paeth's choice of three, in the order of the format.
const FILTERS: u8 = 5;

/// Applies filter number `filter` to the row `current` below the row `above`. A pixel has `pixel` bytes.
fn apply(filter: u8, current: &[u8], above: &[u8], pixel: usize, into: &mut [u8]) {
    match filter {
        0 => into.copy_from_slice(current),
        1 => predict(current, above, pixel, into, |left, _, _| left),
        2 => predict(current, above, pixel, into, |_, up, _| up),
        3 => predict(current, above, pixel, into, |left, up, _| left.midpoint(up)),
        _ => predict(current, above, pixel, into, paeth),
    }
}

/// Subtracts from each byte of a row the prediction `expected`, computed from the bytes to the left, above, and above left. Bytes outside the picture
/// are zero.
fn predict(
    current: &[u8],
    above: &[u8],
    pixel: usize,
    into: &mut [u8],
    expected: impl Fn(u8, u8, u8) -> u8,
) {
    let pixel = pixel.min(current.len());
    let (first, rest) = into.split_at_mut(pixel);
    for ((into, own), up) in first.iter_mut().zip(current).zip(above) {
        *into = own.wrapping_sub(expected(0, *up, 0));
    }
    // Slices side by side, so that many bytes are filtered at once.
    let own = current[pixel..].iter().zip(current);
    let others = above[pixel..].iter().zip(above);
    for ((into, (own, left)), (up, corner)) in rest.iter_mut().zip(own).zip(others) {
        *into = own.wrapping_sub(expected(*left, *up, *corner));
    }
}

/// Neighbour nearest to left + above − corner; the first of equally near neighbours.
fn paeth(left: u8, above: u8, corner: u8) -> u8 {
    let [a, b, c] = [left, above, corner].map(i16::from);
    let plane = a + b - c;
    let [to_left, to_above, to_corner] = [a, b, c].map(|near| (plane - near).abs());
    if to_left <= to_above && to_left <= to_corner {
        left
    } else if to_above <= to_corner {
        above
    } else {
        corner
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use taceva_core::FrameInfo;

    use super::*;
    use crate::decode::{ChannelOrder, decode};

    /// Frame whose bytes `make` computes from their index and a byte of a linear congruential generator.
    fn made(info: FrameInfo, make: impl Fn(usize, u8) -> u8) -> Frame {
        let mut state = 7_u32;
        let length = info.byte_len().expect("small");
        let bytes = (0..length).map(|at| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            make(at, state.to_be_bytes()[0])
        });
        Frame::new(info, bytes.collect()).expect("as long as it says")
    }

    /// Frame with slowly varying brightness and two bits of noise.
    fn noisy(width: u32, height: u32, format: PixelFormat) -> Frame {
        let info = FrameInfo {
            width,
            height,
            format,
        };
        made(info, |at, noise| {
            (at / 97).to_le_bytes()[0].wrapping_add(noise >> 6)
        })
    }

    /// PNG file of `frame`. Asserts that the file has its planned length.
    fn written(frame: &Frame) -> Vec<u8> {
        let planned = PngFile::plan(frame).expect("planned");
        let file = planned.write();
        assert_eq!(file.len(), planned.len());
        file
    }

    const FORMATS: [(PixelFormat, ChannelOrder); 4] = [
        (PixelFormat::Gray8, ChannelOrder::Gray),
        (PixelFormat::Gray16, ChannelOrder::Gray),
        (PixelFormat::Rgb8, ChannelOrder::Rgb),
        (PixelFormat::Rgb16, ChannelOrder::Rgb),
    ];

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn any_frame_is_given_back_by_a_decoder_of_others(
            (format, order) in prop::sample::select(FORMATS.to_vec()),
            (width, height) in (1..160_u32, 1..90_u32),
            repeated in prop::collection::vec(any::<u8>(), 1..400),
            noisy_bits in any::<u8>(),
        ) {
            let info = FrameInfo { width, height, format };
            let frame = made(info, |at, noise| {
                repeated[at % repeated.len()].wrapping_add(noise & noisy_bits)
            });
            let (_, read) = decode(&written(&frame), order).expect("a PNG file");
            prop_assert!(read == frame, "{}", info);
        }
    }

    #[test]
    fn frames_that_would_not_be_read_again_are_refused() {
        for (width, height) in [(0, 1), (1, 0), (0, 0), (16_385, 1), (1, 16_385)] {
            let info = FrameInfo {
                width,
                height,
                format: PixelFormat::Gray8,
            };
            let bytes = vec![0; info.byte_len().expect("small")];
            let frame = Frame::new(info, bytes).expect("as long as it says");
            let problem = PngFile::plan(&frame).expect_err("not read");
            let expected = format!("a frame of {info}, expected sides of 1 to 16384 pixels");
            assert_eq!(problem, expected);
        }
        let widest = noisy(16_384, 1, PixelFormat::Gray8);
        let (_, read) = decode(&written(&widest), ChannelOrder::Gray).expect("a PNG file");
        assert_eq!(read, widest);
    }

    #[test]
    fn every_frame_reads_back_bit_for_bit_by_a_decoder_of_others() {
        for (format, order) in FORMATS {
            for [width, height] in [[1, 1], [1, 9], [9, 1], [67, 41], [200, 300]] {
                let frame = noisy(width, height, format);
                let file = written(&frame);
                let (_, read) = decode(&file, order).expect("a PNG file");
                assert_eq!(read, frame, "{} {width} {height}", format.name());
            }
        }
    }

    #[test]
    fn noise_of_two_bits_takes_little_more_than_that() {
        let frame = noisy(160, 120, PixelFormat::Gray8);
        let length = written(&frame).len();
        // The difference of two uniform numbers of four has 2.66 bits.
        let bits = 8.0 * length as f64 / (160.0 * 120.0);
        assert!((2.0..3.1).contains(&bits), "{bits}");
    }
}
