//! Encodes the newest frame to JPEG on a separate thread, which may be slower than the camera.

use std::borrow::Cow;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use image::codecs::jpeg::JpegEncoder;
use image::{ExtendedColorType, ImageEncoder};
use taceva_core::Frame;

use crate::overlay::Overlay;
use crate::sight::Sight;

/// Minimum interval between pictures. Fifteen pictures a second appear as motion.
const PERIOD: Duration = Duration::from_nanos(1_000_000_000 / 15);
/// Minimum interval between pictures with predictions. Every frame of an irregular stream of 30 frames a second becomes a picture.
const PREDICTED_PERIOD: Duration = Duration::from_millis(16);
/// Maximum side of a picture, pixels.
const SIDE_MAX: usize = 960;
const QUALITY: u8 = 80;

/// Newest frame that was offered, and newest encoded picture.
#[derive(Default)]
pub(crate) struct Frames {
    newest: Mutex<Newest>,
    came: Condvar,
    shown: Mutex<Shown>,
    encoded: Condvar,
}

#[derive(Default)]
struct Newest {
    frame: Option<Frame>,
    /// Predictions for the offered frame.
    overlay: Option<Overlay>,
    /// Time at which the last encoding began.
    taken: Option<Instant>,
}

#[derive(Default)]
struct Shown {
    number: u64,
    jpeg: Option<Arc<[u8]>>,
    overlay: Option<Arc<Overlay>>,
    sight: Option<Sight>,
    /// Time at which saturation and sharpness were last measured.
    looked: Option<Instant>,
}

/// Encoded picture for a browser.
pub(crate) struct Picture {
    pub(crate) number: u64,
    pub(crate) jpeg: Arc<[u8]>,
    /// Predictions for the frame of the picture.
    pub(crate) overlay: Option<Arc<Overlay>>,
}

impl Frames {
    /// Offers `frame` and its predictions to the encoder. Skips the frame if the last encoding began too recently.
    pub(crate) fn offer(&self, frame: &Frame, overlay: Option<Overlay>) {
        let mut newest = lock(&self.newest);
        let period = match overlay {
            None => PERIOD,
            Some(_) => PREDICTED_PERIOD,
        };
        if newest.taken.is_some_and(|taken| taken.elapsed() < period) {
            return;
        }
        newest.frame = Some(frame.clone());
        newest.overlay = overlay;
        drop(newest);
        self.came.notify_one();
    }

    /// Waits up to `patience` for a new frame and encodes the newest frame.
    pub(crate) fn encode_next(&self, patience: Duration) {
        let waited = self
            .came
            .wait_timeout_while(lock(&self.newest), patience, |newest| {
                newest.frame.is_none()
            });
        let (mut newest, _) = waited.unwrap_or_else(PoisonError::into_inner);
        let Some(frame) = newest.frame.take() else {
            return;
        };
        let overlay = newest.overlay.take();
        newest.taken = Some(Instant::now());
        drop(newest);
        let jpeg = encode(&frame);
        let mut shown = lock(&self.shown);
        shown.number += 1;
        shown.jpeg = jpeg.map(Arc::from);
        shown.overlay = overlay.map(Arc::new);
        let is_seen = shown.looked.is_some_and(|looked| looked.elapsed() < PERIOD);
        drop(shown);
        self.encoded.notify_all();
        // After the picture: saturation and sharpness need no faster update.
        if !is_seen {
            let sight = Sight::of(&frame);
            let mut shown = lock(&self.shown);
            (shown.sight, shown.looked) = (Some(sight), Some(Instant::now()));
        }
    }

    /// Waits up to `patience` for a picture with a number above `after`; `None` if none arrives.
    pub(crate) fn next(&self, after: u64, patience: Duration) -> Option<Picture> {
        let waited = self
            .encoded
            .wait_timeout_while(lock(&self.shown), patience, |shown| shown.number <= after);
        let (shown, _) = waited.unwrap_or_else(PoisonError::into_inner);
        let jpeg = shown.jpeg.clone().filter(|_| shown.number > after)?;
        Some(Picture {
            number: shown.number,
            jpeg,
            overlay: shown.overlay.clone(),
        })
    }

    /// Saturation and sharpness of the last measured frame; `None` before the first measurement.
    pub(crate) fn sight(&self) -> Option<Sight> {
        lock(&self.shown).sight
    }
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Encodes `frame` as JPEG, subsampled if large; `None` if the encoder fails.
fn encode(frame: &Frame) -> Option<Vec<u8>> {
    let info = frame.info();
    let [width, height] = [info.width, info.height].map(|side| side as usize);
    let step = width.max(height).div_ceil(SIDE_MAX).max(1);
    let (depth, bytes) = (info.format.samples(), info.format.bytes_per_sample());
    let row = width * depth * bytes;
    let pixels = match step == 1 && bytes == 1 {
        true => Cow::Borrowed(frame.bytes()),
        false => {
            let mut pixels = Vec::with_capacity(frame.bytes().len() / (step * step * bytes));
            for line in frame.bytes().chunks_exact(row.max(1)).step_by(step) {
                for pixel in line.chunks_exact(depth * bytes).step_by(step) {
                    // Numbers of 16 bits are little-endian: the high byte is the last.
                    pixels.extend(pixel.iter().skip(bytes - 1).step_by(bytes));
                }
            }
            Cow::Owned(pixels)
        }
    };
    let sides = [width, height].map(|side| u32::try_from(side.div_ceil(step)).ok());
    let [Some(width), Some(height)] = sides else {
        return None;
    };
    let colour = match depth {
        1 => ExtendedColorType::L8,
        _ => ExtendedColorType::Rgb8,
    };
    let mut jpeg = Vec::new();
    JpegEncoder::new_with_quality(&mut jpeg, QUALITY)
        .write_image(&pixels, width, height, colour)
        .ok()?;
    Some(jpeg)
}

#[cfg(test)]
mod tests {
    use taceva_core::{FrameInfo, PixelFormat};

    use super::*;

    #[test]
    fn frames_of_every_format_and_size_become_pictures_that_a_screen_has_room_for() {
        for (format, width, height, expected) in [
            (PixelFormat::Gray8, 7, 5, (7, 5)),
            (PixelFormat::Rgb16, 6, 4, (6, 4)),
            (PixelFormat::Rgb8, 1921, 4, (641, 2)),
        ] {
            let info = FrameInfo {
                width,
                height,
                format,
            };
            let pixels = vec![77; info.byte_len().expect("small")];
            let frame = Frame::new(info, pixels).expect("whole");
            let jpeg = encode(&frame).expect("encoded");
            let read = image::load_from_memory(&jpeg).expect("a picture");
            assert_eq!((read.width(), read.height()), expected);
        }
    }

    #[test]
    fn whoever_offers_never_waits_and_whoever_looks_gets_the_newest_once() {
        let frames = Frames::default();
        let info = FrameInfo {
            width: 2,
            height: 2,
            format: PixelFormat::Gray8,
        };
        for level in 0..5 {
            frames.offer(&Frame::new(info, vec![level; 4]).expect("whole"), None);
        }
        frames.encode_next(Duration::ZERO);
        let Picture { number, .. } = frames.next(0, Duration::ZERO).expect("one");
        assert_eq!(number, 1);
        assert!(frames.next(number, Duration::ZERO).is_none());
        frames.encode_next(Duration::ZERO);
        assert!(frames.next(number, Duration::ZERO).is_none());
    }

    #[test]
    fn a_picture_is_shown_with_what_was_predicted_of_it_and_of_no_other() {
        let frames = Frames::default();
        let info = FrameInfo {
            width: 2,
            height: 2,
            format: PixelFormat::Gray8,
        };
        let frame = Frame::new(info, vec![90; 4]).expect("whole");
        let overlay = |stamp_s| Some(Overlay::new(stamp_s, Vec::new()));
        frames.offer(&frame, overlay(1.0));
        frames.offer(&frame, overlay(2.0));
        frames.encode_next(Duration::ZERO);
        let shown = |after| frames.next(after, Duration::ZERO).expect("one").overlay;
        assert_eq!(shown(0).map(|overlay| overlay.stamp_s), Some(2.0));
        // A later frame without a prediction has none.
        std::thread::sleep(PERIOD);
        frames.offer(&frame, None);
        frames.encode_next(Duration::ZERO);
        assert_eq!(shown(1), None);
    }
}
