//! Whether a picture shows a touch: what changed between two frames, whatever noise there is in each pixel.

use taceva_core::Frame;

/// Parts along each side of a picture whose mean brightness is compared: small enough for a gentle touch, large enough to average noise.
const PARTS: usize = 8;
/// Frames whose mean is one picture: a gentle touch changes little, and small cameras hiss.
pub(super) const FRAMES: u32 = 4;
/// A touch changes some part by so many times what changes in the air.
const CHANGES: f64 = 2.0;
/// And by so much of the numbers of a pixel, of 255.
const LEAST: f64 = 0.25;

/// The mean brightness of every part over a few frames, row by row, in steps of a pixel of 8 bits.
pub(super) struct Picture(Vec<f64>);

impl Picture {
    /// Of `frames`, which come from one sensor.
    pub(super) fn of(frames: &[Frame]) -> Picture {
        let mut sums = vec![0.0; PARTS * PARTS];
        let mut count = 0.0_f64;
        for frame in frames {
            count += 1.0;
            for (sum, mean) in sums.iter_mut().zip(means(frame)) {
                *sum += mean;
            }
        }
        Picture(sums.into_iter().map(|sum| sum / count.max(1.0)).collect())
    }
}

/// The greatest change of a part between two pictures.
pub(super) fn change(one: &Picture, other: &Picture) -> f64 {
    let changes = one.0.iter().zip(&other.0);
    let changes = changes.map(|(one, other)| (one - other).abs());
    changes.fold(0.0, f64::max)
}

/// Whether a change in contact stands out of the one that is there in the air.
pub(super) fn shows(in_contact: f64, in_air: f64) -> bool {
    in_contact > (CHANGES * in_air).max(LEAST)
}

/// The mean brightness of every part of `frame`, row by row, in steps of a pixel of 8 bits.
pub(in crate::run) fn means(frame: &Frame) -> Vec<f64> {
    let info = frame.info();
    let (width, height) = (info.width as usize, info.height as usize);
    let samples = info.format.samples();
    let scale = match info.format.bytes_per_sample() {
        1 => 1.0,
        _ => 257.0,
    };
    let mut sums = vec![(0.0, 0_u32); PARTS * PARTS];
    for (place, sample) in frame.samples().enumerate() {
        let pixel = place / samples;
        let (row, column) = (pixel / width, pixel % width);
        let part = (row * PARTS / height) * PARTS + column * PARTS / width;
        sums[part].0 += f64::from(sample) / scale;
        sums[part].1 += 1;
    }
    // A picture of fewer pixels than parts leaves some without any.
    let mean = |(sum, count): (f64, u32)| {
        if count == 0 {
            0.0
        } else {
            sum / f64::from(count)
        }
    };
    sums.into_iter().map(mean).collect()
}

#[cfg(test)]
mod tests {
    use taceva_core::{FrameInfo, PixelFormat};

    use super::*;

    /// A picture of 40 by 32 pixels whose pixels hiss, with a bright spot of so many steps.
    fn picture(seed: u32, spot: u8) -> Picture {
        let info = FrameInfo {
            width: 40,
            height: 32,
            format: PixelFormat::Gray8,
        };
        let hiss = |place: u32| {
            let mixed = (place + 1).wrapping_mul(2_654_435_761).rotate_left(seed) >> 13;
            u8::try_from(mixed % 7).expect("below 7")
        };
        let bytes = (0..40 * 32).map(|place: u32| {
            let (x, y) = (place % 40, place / 40);
            let is_spot = (18..23).contains(&x) && (14..18).contains(&y);
            100 + hiss(place) + if is_spot { spot } else { 0 }
        });
        Picture::of(&[Frame::new(info, bytes.collect()).expect("its size")])
    }

    #[test]
    fn a_small_spot_stands_out_of_noise_and_noise_does_not() {
        let in_air = change(&picture(3, 0), &picture(8, 0));
        let again = change(&picture(3, 0), &picture(11, 0));
        let touched = change(&picture(3, 0), &picture(15, 40));
        assert!(in_air > 0.0 && !shows(again, in_air), "{in_air} {again}");
        assert!(shows(touched, in_air), "{in_air} {touched}");
        // Nothing changes in the pictures of a camera that froze.
        assert!(!shows(change(&picture(3, 0), &picture(3, 0)), 0.0));
    }
}
