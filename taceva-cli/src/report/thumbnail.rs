//! Frames as small pictures for a page.

use image::codecs::jpeg::JpegEncoder;
use image::{ExtendedColorType, ImageEncoder};
use taceva_core::Frame;

/// The longest side of a small picture, in pixels.
const SIDE: u32 = 176;
/// Of 100: fine enough for an eye, a tenth of the size of the frame.
const QUALITY: u8 = 82;

/// The media type of what [`thumbnail`] makes.
pub(crate) const MEDIA_TYPE: &str = "image/jpeg";

/// `frame` as JPEG of at most 176 pixels a side, each the mean of what it covers, from black at its darkest to white at its brightest.
pub(crate) fn thumbnail(frame: &Frame) -> anyhow::Result<Vec<u8>> {
    let info = frame.info();
    let channels = info.format.samples();
    let samples: Vec<u16> = frame.samples().collect();
    let step = info.width.max(info.height).div_ceil(SIDE).max(1);
    let (width, height) = (info.width / step, info.height / step);
    let row = usize::try_from(info.width)? * channels;
    let step = usize::try_from(step)?;
    let mut means = Vec::new();
    for y in 0..usize::try_from(height)? {
        for x in 0..usize::try_from(width)? {
            for channel in 0..channels {
                let mut sum = 0_u64;
                for line in 0..step {
                    let start = (y * step + line) * row + x * step * channels + channel;
                    let covered = samples[start..].iter().step_by(channels).take(step);
                    sum += covered.map(|sample| u64::from(*sample)).sum::<u64>();
                }
                means.push(sum / (step * step) as u64);
            }
        }
    }
    let low = means.iter().min().copied().unwrap_or(0);
    let high = means.iter().max().copied().unwrap_or(1).max(low + 1);
    let bytes: Result<Vec<u8>, _> = means
        .into_iter()
        .map(|mean| u8::try_from((mean - low) * 255 / (high - low)))
        .collect();
    let color = match channels {
        1 => ExtendedColorType::L8,
        _ => ExtendedColorType::Rgb8,
    };
    let mut jpeg = Vec::new();
    JpegEncoder::new_with_quality(&mut jpeg, QUALITY).write_image(&bytes?, width, height, color)?;
    Ok(jpeg)
}
