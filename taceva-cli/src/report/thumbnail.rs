//! Thumbnails of frames for a page.

use image::codecs::jpeg::JpegEncoder;
use image::{ExtendedColorType, ImageEncoder};
use taceva_core::Frame;

/// Longest side of a thumbnail, pixels.
const SIDE: u32 = 176;
/// JPEG quality, 0 to 100. At this quality, files have a tenth of the size without a visible difference.
const QUALITY: u8 = 82;

/// Media type of a [`thumbnail`].
pub(crate) const MEDIA_TYPE: &str = "image/jpeg";

/// Converts `frame` to a JPEG of at most 176 pixels a side by area averages. Stretches brightness to the full range.
pub(crate) fn thumbnail(frame: &Frame) -> anyhow::Result<Vec<u8>> {
    let small = Small::of(frame);
    let low = small.means.iter().min().copied().unwrap_or(0);
    let high = small.means.iter().max().copied().unwrap_or(1).max(low + 1);
    small.jpeg(|mean| (mean - low) * 255 / (high - low))
}

/// Frame of at most 176 pixels a side.
#[derive(Clone, Debug)]
pub(crate) struct Small {
    width: u32,
    height: u32,
    channels: usize,
    /// Area averages, row by row, in grey levels of the camera.
    pub(crate) means: Vec<i64>,
}

impl Small {
    /// Reduces `frame` by an integer factor.
    pub(crate) fn of(frame: &Frame) -> Small {
        let info = frame.info();
        let channels = info.format.samples();
        let samples: Vec<u16> = frame.samples().collect();
        let step = info.width.max(info.height).div_ceil(SIDE).max(1);
        let (width, height) = (info.width / step, info.height / step);
        let row = info.width as usize * channels;
        let step = step as usize;
        let mut means = Vec::new();
        for y in 0..height as usize {
            for x in 0..width as usize {
                for channel in 0..channels {
                    let mut sum = 0_i64;
                    for line in 0..step {
                        let start = (y * step + line) * row + x * step * channels + channel;
                        let covered = samples[start..].iter().step_by(channels).take(step);
                        sum += covered.map(|sample| i64::from(*sample)).sum::<i64>();
                    }
                    means.push(sum / (step * step) as i64);
                }
            }
        }
        Small {
            width,
            height,
            channels,
            means,
        }
    }

    /// Frame of the same size with the values `means`.
    pub(crate) fn with_means(&self, means: Vec<i64>) -> Small {
        Small {
            means,
            ..self.clone()
        }
    }

    /// True if both frames have the same size and channels.
    pub(crate) fn is_like(&self, other: &Small) -> bool {
        let shape = |small: &Small| (small.width, small.height, small.channels);
        shape(self) == shape(other)
    }

    /// Encodes the frame as JPEG. `level` maps each value to the range from 0 to 255.
    pub(crate) fn jpeg(&self, level: impl Fn(i64) -> i64) -> anyhow::Result<Vec<u8>> {
        let bytes: Result<Vec<u8>, _> = self
            .means
            .iter()
            .map(|mean| u8::try_from(level(*mean)))
            .collect();
        let color = match self.channels {
            1 => ExtendedColorType::L8,
            _ => ExtendedColorType::Rgb8,
        };
        let mut jpeg = Vec::new();
        JpegEncoder::new_with_quality(&mut jpeg, QUALITY).write_image(
            &bytes?,
            self.width,
            self.height,
            color,
        )?;
        Ok(jpeg)
    }
}
