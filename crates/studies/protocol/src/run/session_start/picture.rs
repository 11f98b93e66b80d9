//! Detects a touch by the change between frames, relative to the pixel noise.

use taceva_core::Frame;

/// Numbers of parts along each side of a frame. The mean brightness of each part is compared. Large parts average out the noise in the gentle touch
/// of a ball. Small parts separate the light and dark sides of the grooves of a board.
const SIDES: [usize; 3] = [8, 32, 128];
/// Least change of mean brightness by which a touch shows in a part, in steps of an 8-bit pixel, for each of [`SIDES`].
const LEAST: [f64; SIDES.len()] = [0.25, 0.5, 2.0];
/// Number of averaged frames, because a gentle touch changes little and small cameras are noisy.
pub(super) const FRAMES: u32 = 4;
/// Least ratio that shows a touch: the greatest brightness change of a part in contact, divided by the greatest in the air.
const CHANGES: f64 = 2.0;

/// Mean brightness of every part of the frame, over its pixels and several frames, in steps of an 8-bit pixel. For each of [`SIDES`], row by row.
pub(super) struct Picture([Vec<f64>; SIDES.len()]);

impl Picture {
    /// Averages `frames` of one sensor.
    pub(super) fn of(frames: &[Frame]) -> Picture {
        let count = frames.len().max(1) as f64;
        Picture(SIDES.map(|side| {
            let mut sums = vec![0.0; side * side];
            for frame in frames {
                for (sum, mean) in sums.iter_mut().zip(means(frame, side)) {
                    *sum += mean / count;
                }
            }
            sums
        }))
    }

    /// Greatest brightness change of a part between this average and `other`, for each of [`SIDES`].
    pub(super) fn change(&self, other: &Picture) -> Change {
        let mut changes = [0.0; SIDES.len()];
        for (change, (one, other)) in changes.iter_mut().zip(self.0.iter().zip(&other.0)) {
            let parts = one
                .iter()
                .zip(other)
                .map(|(one, other)| (one - other).abs());
            *change = parts.fold(0.0, f64::max);
        }
        Change(changes)
    }
}

/// Greatest brightness change of a part of the frame between two averages, in steps of an 8-bit pixel, for each of [`SIDES`].
#[derive(Clone, Copy)]
pub(super) struct Change([f64; SIDES.len()]);

impl Change {
    /// Changes for the part size at which this change, in contact, most exceeds the change `in_air`.
    pub(super) fn against(&self, in_air: &Change) -> Seen {
        let stands_out = |place: &usize| self.0[*place] / threshold(in_air, *place);
        let places = 0..SIDES.len();
        let place = places.max_by(|one, other| stands_out(one).total_cmp(&stands_out(other)));
        let place = place.unwrap_or_default();
        Seen {
            place,
            in_contact: self.0[place],
            in_air: in_air.0[place],
        }
    }
}

/// Least brightness change in contact that shows a touch, in steps of an 8-bit pixel, for the part size `SIDES[place]`.
fn threshold(in_air: &Change, place: usize) -> f64 {
    (CHANGES * in_air.0[place]).max(LEAST[place])
}

/// Greatest brightness changes in contact and in the air, for parts of one size.
#[derive(Clone, Copy)]
pub(super) struct Seen {
    place: usize,
    /// Greatest brightness change of a part in contact, in steps of an 8-bit pixel.
    pub(super) in_contact: f64,
    /// Greatest brightness change of a part in the air, in steps of an 8-bit pixel.
    pub(super) in_air: f64,
}

impl Seen {
    /// True if the change in contact exceeds [`LEAST`], and exceeds the change in the air by more than the factor [`CHANGES`].
    pub(super) fn shows(&self) -> bool {
        self.in_contact > (CHANGES * self.in_air).max(LEAST[self.place])
    }

    /// Greatest brightness change that remains after contact, if it exceeds the mean of those in contact and in the air. Gels recover slowly.
    pub(super) fn stays(&self, after: &Change) -> Option<f64> {
        let after = after.0[self.place];
        (2.0 * after > self.in_contact + self.in_air).then_some(after)
    }
}

/// Mean brightness over the pixels of every part of `frame`, row by row, in steps of an 8-bit pixel. The frame has `side` parts along each side.
pub(in crate::run) fn means(frame: &Frame, side: usize) -> Vec<f64> {
    let info = frame.info();
    let (width, height) = (info.width as usize, info.height as usize);
    let samples = info.format.samples();
    let scale = match info.format.bytes_per_sample() {
        1 => 1.0,
        _ => 257.0,
    };
    let mut sums = vec![(0.0, 0_u32); side * side];
    for (place, sample) in frame.samples().enumerate() {
        let pixel = place / samples;
        let (row, column) = (pixel / width, pixel % width);
        let part = (row * side / height) * side + column * side / width;
        sums[part].0 += f64::from(sample) / scale;
        sums[part].1 += 1;
    }
    // With fewer pixels than parts, some parts are empty.
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

    /// Average of a noisy frame of 40 by 32 pixels with a spot that is brighter by `spot` steps.
    fn picture(seed: u32, spot: u8) -> Picture {
        drawn(seed, |x, y| {
            let is_spot = (18..23).contains(&x) && (14..18).contains(&y);
            if is_spot { spot } else { 0 }
        })
    }

    /// Average of a noisy frame of 40 by 32 pixels. The pixel at x and y is brighter by `brighter(x, y)` steps.
    fn drawn(seed: u32, brighter: impl Fn(u32, u32) -> u8) -> Picture {
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
            100 + hiss(place) + brighter(x, y)
        });
        Picture::of(&[Frame::new(info, bytes.collect()).expect("its size")])
    }

    #[test]
    fn a_small_spot_stands_out_of_noise_and_noise_does_not() {
        let air = picture(3, 0);
        let in_air = air.change(&picture(8, 0));
        let again = air.change(&picture(11, 0));
        assert!(!again.against(&in_air).shows());
        let seen = air.change(&picture(15, 40)).against(&in_air);
        assert!(seen.shows());
        assert_eq!(seen.stays(&again), None);
        assert!(seen.stays(&air.change(&picture(19, 38))).is_some());
        // A frozen camera shows no change.
        let frozen = air.change(&picture(3, 0));
        assert!(!frozen.against(&frozen).shows());
    }

    #[test]
    fn the_grooves_of_a_board_stand_out_though_their_light_and_dark_cancel_in_large_parts() {
        let flat = drawn(3, |_, _| 20);
        let in_air = flat.change(&drawn(8, |_, _| 20));
        // A large part has four rows of pixels.
        let grooves = |_, y: u32| if y.is_multiple_of(2) { 40 } else { 0 };
        let touched = flat.change(&drawn(11, grooves));
        assert!(touched.0[0] < threshold(&in_air, 0));
        assert!(touched.against(&in_air).shows());
    }
}
