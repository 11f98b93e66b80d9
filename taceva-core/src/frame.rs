//! Pictures of the gel. A [`Frame`] owns its pixels, and a [`FrameMut`] borrows a buffer.

mod info;

pub use info::{FrameInfo, PixelFormat};

use std::fmt;

/// A frame that owns its pixels, stored row by row from the top, without padding.
///
/// ```
/// use taceva_core::{Frame, FrameInfo, PixelFormat};
/// let info = FrameInfo { width: 2, height: 1, format: PixelFormat::Gray8 };
/// let frame = Frame::new(info, vec![0, 255])?;
/// assert_eq!(frame.samples().collect::<Vec<_>>(), [0, 255]);
/// # Ok::<(), taceva_core::FrameError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Frame {
    info: FrameInfo,
    bytes: Vec<u8>,
}

impl Frame {
    /// Frame with the pixels `bytes`.
    ///
    /// # Shapes
    /// `bytes`: height × width × samples per pixel × bytes per sample.
    /// # Errors
    /// [`FrameError`] if `bytes` has another length.
    pub fn new(info: FrameInfo, bytes: Vec<u8>) -> Result<Frame, FrameError> {
        check_len(info, bytes.len())?;
        Ok(Frame { info, bytes })
    }

    /// Size and pixel format of the frame.
    pub fn info(&self) -> FrameInfo {
        self.info
    }

    /// Pixels, row by row from the top, without padding.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// Returns the pixel buffer without copying the pixels.
    pub fn into_bytes(self) -> Vec<u8> {
        self.bytes
    }

    /// All samples row by row, the samples of a pixel side by side; 8-bit samples are widened to 16 bits.
    pub fn samples(&self) -> impl Iterator<Item = u16> + '_ {
        let width = self.info.format.bytes_per_sample();
        self.bytes.chunks_exact(width).map(|sample| match *sample {
            [low, high] => u16::from_le_bytes([low, high]),
            [byte] => u16::from(byte),
            _ => 0,
        })
    }
}

/// Intensity steps of 16 bits per intensity step of 8 bits.
const STEPS_OF_16_BIT: u64 = 256;

impl Frame {
    /// Mean luma of all pixels, on the 8-bit scale from 0 to 255; 0 for a frame without pixels. The luma is (299 R + 587 G + 114 B) / 1000.
    ///
    /// The mean is rounded once, from an exact sum, for up to 35 · 10⁹ 8-bit pixels or 137 · 10⁶ 16-bit pixels.
    ///
    /// ```
    /// use taceva_core::{Frame, FrameInfo, PixelFormat};
    /// let info = FrameInfo { width: 2, height: 1, format: PixelFormat::Rgb8 };
    /// let frame = Frame::new(info, vec![255, 0, 0, 0, 0, 255])?;
    /// assert_eq!(frame.mean_luma(), 255.0 * (299.0 + 114.0) / 2000.0);
    /// # Ok::<(), taceva_core::FrameError>(())
    /// ```
    pub fn mean_luma(&self) -> f64 {
        let (sum, pixels, steps) = match self.info.format {
            PixelFormat::Gray8 => (
                1000 * self.bytes.iter().map(|byte| u64::from(*byte)).sum::<u64>(),
                self.bytes.len(),
                1,
            ),
            PixelFormat::Rgb8 => (
                weighted(self.bytes.iter().map(|byte| u64::from(*byte))),
                self.bytes.len() / 3,
                1,
            ),
            PixelFormat::Gray16 => (
                1000 * self.samples().map(u64::from).sum::<u64>(),
                self.bytes.len() / 2,
                STEPS_OF_16_BIT,
            ),
            PixelFormat::Rgb16 => (
                weighted(self.samples().map(u64::from)),
                self.bytes.len() / 6,
                STEPS_OF_16_BIT,
            ),
        };
        if pixels == 0 {
            return 0.0;
        }
        sum as f64 / (pixels as u64 * 1000 * steps) as f64
    }
}

/// Sum of 299 R + 587 G + 114 B over all pixels. `samples` are the red, green and blue sample of each pixel in turn.
fn weighted(samples: impl Iterator<Item = u64>) -> u64 {
    let mut sums = [0; 3];
    for (position, sample) in samples.enumerate() {
        sums[position % 3] += sample;
    }
    let [red, green, blue] = sums;
    299 * red + 587 * green + 114 * blue
}

/// A writable frame in the caller's buffer.
///
/// ```
/// use taceva_core::{FrameInfo, FrameMut, PixelFormat};
/// let info = FrameInfo { width: 2, height: 1, format: PixelFormat::Gray8 };
/// let mut bytes = [0; 2];
/// FrameMut::new(info, &mut bytes)?.bytes_mut().fill(7);
/// assert_eq!(bytes, [7, 7]);
/// # Ok::<(), taceva_core::FrameError>(())
/// ```
#[derive(Debug)]
pub struct FrameMut<'a> {
    info: FrameInfo,
    bytes: &'a mut [u8],
}

impl<'a> FrameMut<'a> {
    /// Writable frame in the buffer `bytes`.
    ///
    /// # Errors
    /// [`FrameError`] if the length of `bytes` differs from the length of the frame.
    pub fn new(info: FrameInfo, bytes: &'a mut [u8]) -> Result<FrameMut<'a>, FrameError> {
        check_len(info, bytes.len())?;
        Ok(FrameMut { info, bytes })
    }

    /// Size and pixel format of the frame.
    pub fn info(&self) -> FrameInfo {
        self.info
    }

    /// Writable pixels, row by row from the top, without padding.
    pub fn bytes_mut(&mut self) -> &mut [u8] {
        self.bytes
    }
}

fn check_len(info: FrameInfo, found: usize) -> Result<(), FrameError> {
    match info.byte_len() {
        Some(expected) if expected == found => Ok(()),
        expected => Err(FrameError {
            info,
            expected,
            found,
        }),
    }
}

/// Error for a buffer whose length differs from the length of its frame.
///
/// ```
/// use taceva_core::{Frame, FrameInfo, PixelFormat};
/// let info = FrameInfo { width: 2, height: 1, format: PixelFormat::Gray8 };
/// assert!(Frame::new(info, vec![0]).is_err());
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FrameError {
    info: FrameInfo,
    expected: Option<usize>,
    found: usize,
}

impl fmt::Display for FrameError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.expected {
            Some(expected) => {
                write!(
                    f,
                    "a frame of {} takes {expected} bytes, found {}",
                    self.info, self.found
                )
            }
            None => write!(
                f,
                "a frame of {} is larger than the address space",
                self.info
            ),
        }
    }
}

impl std::error::Error for FrameError {}

#[cfg(test)]
mod tests {
    use super::*;

    const TINY: FrameInfo = FrameInfo {
        width: 2,
        height: 1,
        format: PixelFormat::Gray16,
    };

    #[test]
    fn sixteen_bit_samples_are_little_endian() {
        let frame = Frame::new(TINY, vec![0x34, 0x12, 0xff, 0x00]).expect("four bytes");
        assert_eq!(frame.samples().collect::<Vec<_>>(), [0x1234, 0x00ff]);
    }

    #[test]
    fn the_mean_luma_of_sixteen_bits_is_in_steps_of_eight() {
        let frame = Frame::new(TINY, vec![0x00, 0x80, 0x00, 0x40]).expect("four bytes");
        assert_eq!(frame.mean_luma().to_bits(), 96.0_f64.to_bits());
        let colour = FrameInfo {
            format: PixelFormat::Rgb16,
            ..TINY
        };
        let white = Frame::new(colour, [0x00, 0xff].repeat(6)).expect("twelve bytes");
        assert_eq!(white.mean_luma().to_bits(), 255.0_f64.to_bits());
        let nothing = FrameInfo { width: 0, ..TINY };
        assert_eq!(
            Frame::new(nothing, Vec::new())
                .expect("no byte")
                .mean_luma()
                .to_bits(),
            0.0_f64.to_bits()
        );
    }

    #[test]
    fn a_buffer_of_another_length_is_refused() {
        let error = Frame::new(TINY, vec![0; 3]).expect_err("one byte short");
        assert_eq!(
            error.to_string(),
            "a frame of 2×1 gray16 takes 4 bytes, found 3"
        );
        assert!(FrameMut::new(TINY, &mut [0; 5]).is_err());
    }

    #[test]
    fn a_frame_beyond_the_address_space_has_no_length() {
        let info = FrameInfo {
            width: u32::MAX,
            height: u32::MAX,
            format: PixelFormat::Rgb16,
        };
        assert_eq!(info.byte_len(), None);
        assert!(Frame::new(info, Vec::new()).is_err());
    }
}
