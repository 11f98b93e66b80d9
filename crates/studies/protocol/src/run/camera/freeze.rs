//! Detects a frozen camera: a frame that repeats the one before to the last bit although the force on the gel changed.

use taceva_core::{Frame, Pose};

use crate::run::load_limit::Felt;
use crate::run::tip::Tip;
use crate::run::way::distance;

/// Number of changed frames after which a camera counts as live. An earlier repeat shows a camera that is too coarse to be checked.
const LIVE_FRAMES: u32 = 8;
/// Number of changed frames of the untouched gel after which a camera counts as noisy. Then no two of its frames are equal.
const NOISY_FRAMES: u32 = 4;
/// Least change of the force that changes the frame of any camera, in multiples of the least force in the air.
const FORCE_STEPS: f64 = 5.0;
/// Distance of a sample from black or from full scale, up to which it shows nothing.
const CLIPPED: u16 = 4;
/// Greatest part of the samples of a blank frame that are not clipped, as of hot pixels.
const SEEN_PART: f64 = 0.01;
/// Least way of the tip that changes the frame of a camera without noise, in mm. A gel at rest may creep under it unseen.
const MOVED_MM: f64 = 0.05;

/// State of the tip at a frame.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Moment {
    felt: Felt,
    pose: Pose,
    /// True from a retreat to the next search: a light touch is not in the air, whatever its force.
    is_in_air: bool,
    /// Least force that counts as contact in the air, in N.
    air_n: f64,
}

impl Moment {
    /// The present state of `tip`.
    pub(super) fn of(tip: &Tip<'_>) -> Moment {
        Moment {
            felt: tip.felt,
            pose: tip.at,
            is_in_air: tip.contact_mm.is_none(),
            air_n: tip.pace.air_n,
        }
    }

    /// True if the force changed so far since `earlier` that every camera shows it.
    fn is_pressed_otherwise_than(&self, earlier: &Moment) -> bool {
        let normal_n = self.felt.normal_n - earlier.felt.normal_n;
        let shear_n = self.felt.shear_n - earlier.felt.shear_n;
        normal_n.hypot(shear_n) > FORCE_STEPS * self.air_n
    }
}

/// Last distinct frame of a run, and the evidence that this camera does not repeat frames.
#[derive(Default)]
pub(super) struct Freeze {
    last: Option<Distinct>,
    changes: u32,
    changes_in_air: u32,
    is_coarse: bool,
    is_noiseless: bool,
}

/// Frame that differs from the one before it.
struct Distinct {
    frame: Frame,
    moment: Moment,
    /// True if the tip left the gel since.
    is_left: bool,
}

impl Freeze {
    /// Notes that the tip left the gel.
    pub(super) fn leave(&mut self) {
        if let Some(last) = &mut self.last {
            last.is_left = true;
        }
    }

    /// True if `frame`, captured at `moment`, repeats the one before although the force changed.
    ///
    /// A blank frame, as of a camera in the dark, is never counted as a repeat.
    pub(super) fn is_frozen(&mut self, frame: &Frame, moment: Moment) -> bool {
        let Some(last) = &self.last else {
            self.keep(frame, moment);
            return false;
        };
        let stays_in_air = last.moment.is_in_air && moment.is_in_air;
        if last.frame.bytes() != frame.bytes() {
            self.changes = self.changes.saturating_add(1);
            self.changes_in_air += u32::from(stays_in_air);
            self.keep(frame, moment);
            return false;
        }
        self.is_noiseless |= stays_in_air;
        let is_noisy = self.changes_in_air >= NOISY_FRAMES && !self.is_noiseless;
        let is_moved = distance(&last.moment.pose, &moment.pose) > MOVED_MM;
        let is_new_force = moment.is_pressed_otherwise_than(&last.moment);
        let must_differ = match is_noisy {
            true => !stays_in_air && (last.is_left || is_moved || is_new_force),
            false => is_moved && is_new_force,
        };
        if !must_differ || is_blank(frame) {
            return false;
        }
        self.is_coarse |= self.changes < LIVE_FRAMES;
        !self.is_coarse
    }

    fn keep(&mut self, frame: &Frame, moment: Moment) {
        self.last = Some(Distinct {
            frame: frame.clone(),
            moment,
            is_left: false,
        });
    }
}

/// True if all pixels are equal, or nearly all samples are dark or saturated.
fn is_blank(frame: &Frame) -> bool {
    let format = frame.info().format;
    let mut pixels = frame
        .bytes()
        .chunks_exact(format.samples() * format.bytes_per_sample());
    let first = pixels.next();
    if pixels.all(|pixel| Some(pixel) == first) {
        return true;
    }
    let greatest = format.full_scale() - CLIPPED;
    let (mut seen, mut all) = (0_u32, 0_u32);
    for sample in frame.samples() {
        seen += u32::from(sample > CLIPPED && sample < greatest);
        all += 1;
    }
    f64::from(seen) <= SEEN_PART * f64::from(all)
}

#[cfg(test)]
mod tests {
    use taceva_core::{FrameInfo, PixelFormat};

    use super::*;

    fn frame(pixels: [u8; 2]) -> Frame {
        let info = FrameInfo {
            width: 2,
            height: 1,
            format: PixelFormat::Gray8,
        };
        Frame::new(info, pixels.to_vec()).expect("its size")
    }

    /// Tip on a gel of 2 N/mm, under this force.
    fn pressed(normal_n: f64) -> Moment {
        let mut pose = Pose::default();
        pose.position.z.0 = normal_n / 2.0;
        Moment {
            felt: Felt {
                normal_n,
                ..Felt::default()
            },
            pose,
            is_in_air: normal_n < 0.01,
            air_n: 0.02,
        }
    }

    /// A camera after nine frames of the untouched gel that differ, or repeat.
    fn after_nine(differ: bool) -> Freeze {
        let mut freeze = Freeze::default();
        for number in 0..9 {
            let pixel = if differ { number } else { 0 };
            assert!(!freeze.is_frozen(&frame([pixel, 50]), pressed(0.0)));
        }
        freeze
    }

    #[test]
    fn a_frame_that_repeats_under_another_force_is_frozen_and_under_the_same_it_is_not() {
        let mut freeze = after_nine(true);
        let first = frame([100, 7]);
        assert!(!freeze.is_frozen(&first, pressed(0.5)));
        assert!(!freeze.is_frozen(&first, pressed(0.55)));
        assert!(freeze.is_frozen(&first, pressed(0.65)));
        // It stays frozen until a frame differs.
        assert!(freeze.is_frozen(&first, pressed(0.9)));
        assert!(!freeze.is_frozen(&frame([100, 8]), pressed(0.9)));
    }

    #[test]
    fn a_camera_that_freezes_is_found_at_the_next_touch_with_the_same_force() {
        let mut freeze = after_nine(true);
        let first = frame([100, 7]);
        assert!(!freeze.is_frozen(&first, pressed(0.5)));
        freeze.leave();
        assert!(freeze.is_frozen(&first, pressed(0.5)));
    }

    #[test]
    fn a_force_that_creeps_under_a_resting_tip_may_leave_the_frame_of_a_camera_without_noise() {
        let mut freeze = Freeze::default();
        for number in 0..9 {
            let moment = pressed(0.1 * f64::from(number));
            assert!(!freeze.is_frozen(&frame([number, 50]), moment));
        }
        let crept = Moment {
            pose: pressed(0.8).pose,
            ..pressed(0.6)
        };
        assert!(!freeze.is_frozen(&frame([8, 50]), crept));
        assert!(freeze.is_frozen(&frame([8, 50]), pressed(0.6)));
    }

    #[test]
    fn a_camera_without_noise_or_in_the_dark_may_repeat_a_frame() {
        // Two depths look alike to a camera of coarse steps.
        let mut coarse = after_nine(false);
        let touched = frame([90, 50]);
        assert!(!coarse.is_frozen(&touched, pressed(0.5)));
        for force_n in [0.9, 0.5, 0.9] {
            assert!(!coarse.is_frozen(&touched, pressed(force_n)));
        }
        let mut dark = after_nine(true);
        for force_n in [0.5, 0.9] {
            assert!(!dark.is_frozen(&frame([0, 0]), pressed(force_n)));
        }
    }

    #[test]
    fn a_frame_of_one_colour_or_of_hot_pixels_in_the_dark_may_repeat() {
        let mut hot = vec![1; 400];
        hot[7] = 90;
        let of = |format, width, bytes| {
            let info = FrameInfo {
                width,
                height: 1,
                format,
            };
            Frame::new(info, bytes).expect("its size")
        };
        for blank in [
            of(PixelFormat::Gray8, 400, hot),
            of(PixelFormat::Rgb8, 2, [10, 20, 30].repeat(2)),
        ] {
            let mut freeze = after_nine(true);
            for force_n in [0.5, 0.9] {
                assert!(!freeze.is_frozen(&blank, pressed(force_n)), "{blank:?}");
            }
        }
    }

    #[test]
    fn light_touches_are_no_evidence_that_a_camera_is_noisy() {
        let light = |force_n| Moment {
            is_in_air: false,
            ..pressed(force_n)
        };
        let mut freeze = Freeze::default();
        for number in 0..9 {
            assert!(!freeze.is_frozen(&frame([number, 50]), light(0.005)));
        }
        // Two equal touches look alike to a camera without noise.
        freeze.leave();
        assert!(!freeze.is_frozen(&frame([8, 50]), light(0.03)));
    }
}
