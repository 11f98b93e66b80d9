//! Differences between frames. Equal parts become zero and compress well.

use taceva_core::{Frame, FrameError};

use crate::digest::{Digest, PartsDigest};

/// Subtracts `first` from `frame`, value by value with wrapping. Both frames must have the same size and format.
pub(crate) fn less(frame: &Frame, first: &Frame) -> Result<Frame, FrameError> {
    mixed(frame, first, u8::wrapping_sub, u16::wrapping_sub)
}

/// Inverse of [`less`]: restores the frame from its `difference` to `first`.
pub(crate) fn plus(difference: &Frame, first: &Frame) -> Result<Frame, FrameError> {
    mixed(difference, first, u8::wrapping_add, u16::wrapping_add)
}

fn mixed(
    frame: &Frame,
    first: &Frame,
    bytes: impl Fn(u8, u8) -> u8,
    words: impl Fn(u16, u16) -> u16,
) -> Result<Frame, FrameError> {
    let mixed = match frame.info().format.bytes_per_sample() {
        1 => {
            // A shorter first frame gives too few bytes, which are refused below.
            let shared = frame.bytes().len().min(first.bytes().len());
            let mut mixed = frame.bytes()[..shared].to_vec();
            for (own, other) in mixed.iter_mut().zip(first.bytes()) {
                *own = bytes(*own, *other);
            }
            mixed
        }
        _ => {
            let pairs = frame.samples().zip(first.samples());
            let words = pairs.map(|(own, other)| words(own, other));
            words.flat_map(u16::to_le_bytes).collect()
        }
    };
    Frame::new(frame.info(), mixed)
}

/// Digest of a difference stored as `bytes`, relative to the frame with digest `first`. The same bytes relative to another first frame are a different picture.
pub(crate) fn digest(first: Digest, bytes: &[u8]) -> Digest {
    let mut digest = PartsDigest::default();
    digest.part(b"taceva.difference/1");
    digest.fixed(first.as_bytes());
    digest.part(bytes);
    digest.finish()
}

#[cfg(test)]
mod tests {
    use taceva_core::{FrameInfo, PixelFormat};

    use super::*;

    #[test]
    fn a_difference_and_its_first_frame_give_the_frame_back() {
        for format in [PixelFormat::Gray8, PixelFormat::Rgb16] {
            let info = FrameInfo {
                width: 16,
                height: 16,
                format,
            };
            let frame = |factor: usize| {
                let bytes = (0..info.byte_len().expect("small"))
                    .map(|at| (at * factor % 251).to_le_bytes()[0]);
                Frame::new(info, bytes.collect()).expect("whole")
            };
            let (one, other) = (frame(7), frame(113));
            let difference = less(&one, &other).expect("alike");
            assert_ne!(difference, one);
            assert_eq!(plus(&difference, &other).expect("alike"), one);
        }
    }

    #[test]
    fn the_same_difference_to_another_frame_has_another_digest() {
        let [a, b] = [b"a", b"b"].map(|bytes| Digest::of(bytes));
        assert_eq!(digest(a, b"x"), digest(a, b"x"));
        assert_ne!(digest(a, b"x"), digest(b, b"x"));
        assert_ne!(digest(a, b"x"), digest(a, b"y"));
    }
}
