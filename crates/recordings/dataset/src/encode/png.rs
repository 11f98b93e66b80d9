//! PNG encoder for noisy pictures: applies the five filters of the format, then only Huffman codes.
//!
//! After filtering, a camera picture is mostly noise, without repetitions. The search for repetitions is the slow part of deflate. The search finds only
//! accidental repetitions, which make files of the simulated cameras a fifth larger. Without the search, a uniform picture shrinks to an eighth at best.

use miniz_oxide::deflate::core::{
    CompressionStrategy, CompressorOxide, TDEFLFlush, TDEFLStatus, compress_to_output,
    create_comp_flags_from_zip_params,
};
use taceva_core::{Frame, PixelFormat};

const SIGNATURE: &[u8; 8] = b"\x89PNG\r\n\x1a\n";

/// Encodes `frame` as a PNG file.
pub(super) fn file(frame: &Frame) -> Result<Vec<u8>, String> {
    let info = frame.info();
    let (bits, color, pixel) = match info.format {
        PixelFormat::Gray8 => (8, 0, 1),
        PixelFormat::Gray16 => (16, 0, 2),
        PixelFormat::Rgb8 => (8, 2, 3),
        PixelFormat::Rgb16 => (16, 2, 6),
        other => return Err(format!("frames of type {} are not written", other.name())),
    };
    let mut header = Vec::with_capacity(13);
    header.extend(info.width.to_be_bytes());
    header.extend(info.height.to_be_bytes());
    // Deflate, the five filters, not interlaced.
    header.extend([bits, color, 0, 0, 0]);
    let row = info.width as usize * pixel;
    let pixels = zlib(&filtered(&samples(frame), row, pixel))?;
    let mut file = Vec::with_capacity(pixels.len() + 64);
    file.extend(SIGNATURE);
    for (kind, data) in [(b"IHDR", &header), (b"IDAT", &pixels), (b"IEND", &vec![])] {
        let length = u32::try_from(data.len()).map_err(|error| error.to_string())?;
        file.extend(length.to_be_bytes());
        file.extend(kind);
        file.extend(data);
        let mut check = crc32fast::Hasher::new();
        check.update(kind);
        check.update(data);
        file.extend(check.finalize().to_be_bytes());
    }
    Ok(file)
}

/// Pixel values in the byte order of PNG, high byte first.
fn samples(frame: &Frame) -> Vec<u8> {
    match frame.info().format.bytes_per_sample() {
        1 => frame.bytes().to_vec(),
        _ => frame.samples().flat_map(u16::to_be_bytes).collect(),
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
            let sizes = tried.iter().map(|byte| byte.cast_signed().unsigned_abs());
            let left: u64 = sizes.map(u64::from).sum();
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

/// Number of filters: none, left, above, the mean of both, and Paeth's choice of three, in the order of the format.
const FILTERS: u8 = 5;

/// Filters a row below `above`, for pixels of `pixel` bytes.
fn apply(filter: u8, current: &[u8], above: &[u8], pixel: usize, into: &mut [u8]) {
    for (at, into) in into.iter_mut().enumerate() {
        let left = at.checked_sub(pixel);
        let [left, corner] = [current, above].map(|row| left.map_or(0, |left| row[left]));
        let up = above[at];
        let expected = match filter {
            0 => 0,
            1 => left,
            2 => up,
            3 => left.midpoint(up),
            _ => paeth(left, up, corner),
        };
        *into = current[at].wrapping_sub(expected);
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

/// `bytes` as a zlib stream of Huffman codes.
fn zlib(bytes: &[u8]) -> Result<Vec<u8>, String> {
    /// Lowest level that compresses; the level only limits the search for repetitions.
    const LEVEL: i32 = 1;
    /// Largest window, in a stream with the header of zlib.
    const WINDOW_BITS: i32 = 15;
    let strategy = CompressionStrategy::HuffmanOnly as i32;
    let flags = create_comp_flags_from_zip_params(LEVEL, WINDOW_BITS, strategy);
    let mut compressor = CompressorOxide::new(flags);
    let mut stream = Vec::with_capacity(bytes.len() / 3);
    let (status, _) = compress_to_output(&mut compressor, bytes, TDEFLFlush::Finish, |out| {
        stream.extend_from_slice(out);
        true
    });
    match status {
        TDEFLStatus::Done => Ok(stream),
        _ => Err("the picture cannot be compressed".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use taceva_core::FrameInfo;

    use super::*;
    use crate::decode::{ChannelOrder, decode};

    /// Smooth light with noise from a linear congruential generator.
    fn noisy(width: u32, height: u32, format: PixelFormat) -> Frame {
        let info = FrameInfo {
            width,
            height,
            format,
        };
        let mut state = 7_u32;
        let length = info.byte_len().expect("small");
        let bytes = (0..length).map(|at| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let noise = (state >> 30).to_le_bytes()[0];
            (at / 97).to_le_bytes()[0].wrapping_add(noise)
        });
        Frame::new(info, bytes.collect()).expect("as long as it says")
    }

    #[test]
    fn every_frame_reads_back_bit_for_bit_by_a_decoder_of_others() {
        let formats = [
            (PixelFormat::Gray8, ChannelOrder::Gray),
            (PixelFormat::Gray16, ChannelOrder::Gray),
            (PixelFormat::Rgb8, ChannelOrder::Rgb),
            (PixelFormat::Rgb16, ChannelOrder::Rgb),
        ];
        for (format, order) in formats {
            for [width, height] in [[1, 1], [1, 9], [9, 1], [67, 41], [200, 300]] {
                let frame = noisy(width, height, format);
                let file = file(&frame).expect("written");
                let (_, read) = decode(&file, order).expect("a PNG file");
                assert_eq!(read, frame, "{} {width} {height}", format.name());
            }
        }
    }

    #[test]
    fn noise_of_two_bits_takes_little_more_than_that() {
        let frame = noisy(160, 120, PixelFormat::Gray8);
        let length = file(&frame).expect("written").len();
        // The difference of two uniform numbers of four has 2.66 bits.
        let bits = 8.0 * length as f64 / (160.0 * 120.0);
        assert!((2.0..3.1).contains(&bits), "{bits}");
    }
}
