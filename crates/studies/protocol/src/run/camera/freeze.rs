//! Detects a frozen camera, whose frames are bit-equal to earlier frames although the force on the gel changed.

use taceva_core::Frame;

use super::cycle::Cycle;
use super::moment::Moment;

/// Number of changed frames after which a camera counts as live. If an equal frame comes earlier, the camera is too coarse for this check.
const LIVE_FRAMES: u32 = 8;
/// Number of changed frames of the untouched gel after which a camera counts as noisy. A working noisy camera never takes two equal frames.
const NOISY_FRAMES: u32 = 4;
/// Number of repeats of one frame after which a coarse camera counts as frozen. The camera is coarse if it showed fewer than [`LIVE_FRAMES`] changes.
/// In addition, an earlier force change of similar size must have changed a frame.
const STUCK_REPEATS: u32 = 3;
/// Least force change that must change a frame, as a share of the greatest force change that did. The share is below 1 because forces of presses to
/// one depth vary.
const SHOWN_PART: f64 = 0.75;
/// Number of repeated older frames after which a noisy camera counts as frozen.
const NOISY_RETURNS: u32 = 3;
/// Number of repeated older frames after which any other camera counts as frozen.
const CYCLE_RETURNS: u32 = 6;
/// Largest difference from black or full scale, in steps of a pixel value, up to which a value counts as clipped.
const CLIPPED: u16 = 4;
/// Greatest share of unclipped values in a blank frame. Hot pixels of a dark frame are such values.
const SEEN_PART: f64 = 0.01;

/// Last distinct frame of a run, and the evidence that this camera does not repeat frames.
#[derive(Default)]
pub(super) struct Freeze {
    last: Option<Distinct>,
    changes: u32,
    changes_in_air: u32,
    /// Greatest force change that changed a frame, in N.
    shown_n: f64,
    cycle: Cycle,
    is_coarse: bool,
    is_noiseless: bool,
}

/// Last frame that differs from the frame before it.
struct Distinct {
    frame: Frame,
    moment: Moment,
    /// True if the tip has left the gel since the frame was captured.
    is_left: bool,
    /// Number of later frames that are equal to this frame, although tip or force changed.
    repeats: u32,
    /// True if an equal frame followed in another press, or across the contact, although a similar force change once changed a frame.
    is_seen_across: bool,
}

impl Freeze {
    /// Records that the tip left the gel.
    pub(super) fn leave(&mut self) {
        if let Some(last) = &mut self.last {
            last.is_left = true;
        }
    }

    /// True if `frame`, captured at `moment`, equals the previous frame or repeats a sequence of older frames, although the force changed.
    ///
    /// A blank frame, as from a camera in the dark, never counts as repeated.
    pub(super) fn is_frozen(&mut self, frame: &Frame, moment: Moment) -> bool {
        let Some(last) = &mut self.last else {
            self.cycle.returns(frame, moment);
            self.keep(frame, moment);
            return false;
        };
        let change_n = moment.change_n(&last.moment);
        let stays_in_air = last.moment.is_in_air && moment.is_in_air;
        if last.frame.bytes() != frame.bytes() {
            self.changes = self.changes.saturating_add(1);
            self.changes_in_air += u32::from(stays_in_air);
            self.shown_n = self.shown_n.max(change_n);
            self.keep(frame, moment);
            let allowed = match self.changes_in_air >= NOISY_FRAMES && !self.is_noiseless {
                true => NOISY_RETURNS,
                false => CYCLE_RETURNS,
            };
            return self.cycle.returns(frame, moment) >= allowed && !is_blank(frame);
        }
        self.is_noiseless |= stays_in_air;
        let is_noisy = self.changes_in_air >= NOISY_FRAMES && !self.is_noiseless;
        let is_moved = moment.is_moved_from(&last.moment);
        let is_new_force = moment.is_pressed_otherwise_than(&last.moment);
        let must_differ = match is_noisy {
            true => !stays_in_air && (last.is_left || is_moved || is_new_force),
            false => is_moved && is_new_force,
        };
        if !must_differ || is_blank(frame) {
            return false;
        }
        let is_other_press = last.is_left || last.moment.is_in_air != moment.is_in_air;
        // Between two places, a frame changes by the full force of either press.
        let contrast_n = match moment.is_beside(&last.moment) {
            true => change_n
                .max(moment.felt.normal_n)
                .max(last.moment.felt.normal_n),
            false => change_n,
        };
        let was_shown = self.changes > 0 && contrast_n >= SHOWN_PART * self.shown_n;
        last.repeats += 1;
        last.is_seen_across |= is_other_press && was_shown;
        self.is_coarse |= self.changes < LIVE_FRAMES;
        !self.is_coarse || (last.repeats >= STUCK_REPEATS && last.is_seen_across)
    }

    fn keep(&mut self, frame: &Frame, moment: Moment) {
        self.last = Some(Distinct {
            frame: frame.clone(),
            moment,
            is_left: false,
            repeats: 0,
            is_seen_across: false,
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

    use super::super::moment::pressed;
    use super::*;

    fn frame(pixels: [u8; 2]) -> Frame {
        let info = FrameInfo {
            width: 2,
            height: 1,
            format: PixelFormat::Gray8,
        };
        Frame::new(info, pixels.to_vec()).expect("its size")
    }

    /// A camera after nine frames of the untouched gel. The frames differ if `differ` is true, else they are equal.
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
    fn a_camera_that_freezes_before_its_eighth_change_is_found_in_its_second_press() {
        // A camera without noise shows the touch at the start, then repeats the frame after it.
        let mut freeze = Freeze::default();
        for (pixel, force_n) in [(0, 0.0), (90, 0.6), (1, 0.0)] {
            assert!(!freeze.is_frozen(&frame([pixel, 50]), pressed(force_n)));
        }
        let stuck = frame([1, 50]);
        freeze.leave();
        assert!(!freeze.is_frozen(&stuck, pressed(0.5)));
        assert!(!freeze.is_frozen(&stuck, pressed(0.9)));
        freeze.leave();
        assert!(freeze.is_frozen(&stuck, pressed(0.7)));
        assert!(!freeze.is_frozen(&frame([80, 50]), pressed(0.7)));
    }

    #[test]
    fn a_static_scene_without_contact_and_lighter_touches_than_the_camera_showed_are_not_frozen() {
        let mut freeze = Freeze::default();
        for (pixel, force_n) in [(0, 0.0), (90, 0.6), (0, 0.0)] {
            assert!(!freeze.is_frozen(&frame([pixel, 50]), pressed(force_n)));
        }
        let still = frame([0, 50]);
        for force_n in [0.0, 0.3, 0.4, 0.2, 0.0, 0.4, 0.3] {
            freeze.leave();
            assert!(!freeze.is_frozen(&still, pressed(force_n)), "{force_n}");
        }
        let mut never = Freeze::default();
        for _ in 0..20 {
            assert!(!never.is_frozen(&still, pressed(0.0)));
        }
    }

    #[test]
    fn presses_of_one_place_within_a_step_of_a_coarse_camera_are_not_frozen() {
        let mut freeze = Freeze::default();
        assert!(!freeze.is_frozen(&frame([0, 50]), pressed(0.0)));
        for force_n in [0.6, 0.8, 0.95, 0.6, 0.8] {
            assert!(!freeze.is_frozen(&frame([90, 50]), pressed(force_n)));
            freeze.leave();
        }
    }

    #[test]
    fn a_camera_that_returns_old_frames_in_turn_is_found_while_the_force_changes() {
        for (is_noiseless, allowed) in [(false, NOISY_RETURNS), (true, CYCLE_RETURNS)] {
            let mut freeze = after_nine(!is_noiseless);
            let cycled = [frame([100, 7]), frame([120, 9])];
            let mut found = None;
            for number in 0..12_u8 {
                let force_n = 0.5 + 0.2 * f64::from(number);
                let shown = &cycled[usize::from(number % 2)];
                if freeze.is_frozen(shown, pressed(force_n)) {
                    found = Some(u32::from(number));
                    break;
                }
            }
            // The first two are new.
            assert_eq!(found, Some(allowed + 1), "{is_noiseless}");
        }
    }

    #[test]
    fn old_frames_at_their_own_forces_and_in_the_air_are_no_cycle() {
        let mut freeze = after_nine(true);
        for _ in 0..10 {
            for (pixel, force_n) in [(60, 0.0), (100, 0.5), (120, 0.9), (61, 0.0)] {
                assert!(!freeze.is_frozen(&frame([pixel, 7]), pressed(force_n)));
                freeze.leave();
            }
        }
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
