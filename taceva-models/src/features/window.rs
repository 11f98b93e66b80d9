//! Windows of frames: a sample reads its own frame and earlier frames.

use serde::{Deserialize, Serialize};

use crate::settings::{ModelSettings, SettingError, SettingInfo, number};

/// Frames that one sample reads: its own frame, and earlier frames of the same sequence. No later frame is read.
///
/// ```
/// use taceva_models::FrameWindow;
/// let window = FrameWindow::new(3, 2).expect("several frames");
/// // The sequence has no frame before the first, so the first is repeated.
/// assert_eq!(window.places(3).collect::<Vec<_>>(), [3, 1, 0]);
/// assert_eq!(FrameWindow::new(1, 1), None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FrameWindow {
    frames: u32,
    stride: u32,
}

const FRAMES: SettingInfo = SettingInfo {
    key: "window",
    accepts: "a number of frames from 1 to 64",
    default: "1",
    about: "number of frames of every sample of a task: its own and earlier frames of its cluster, side by side, and their differences",
};
const STRIDE: SettingInfo = SettingInfo {
    key: "stride",
    accepts: "a number of frames from 1 to 1000",
    default: "1",
    about: "number of frames from one frame of a window to the next",
};

impl FrameWindow {
    /// Settings of a window that the model registry lists.
    pub(super) const SETTINGS: [SettingInfo; 2] = [FRAMES, STRIDE];

    /// Greatest number of frames.
    pub const FRAMES_MAX: u32 = 64;

    /// Greatest stride: the number of frames between consecutive frames of a window.
    pub const STRIDE_MAX: u32 = 1000;

    /// Window of `frames` frames, each `stride` frames after the previous frame; `None` for a single frame and for numbers out of range.
    pub fn new(frames: u32, stride: u32) -> Option<FrameWindow> {
        let window = FrameWindow { frames, stride };
        window.is_valid().then_some(window)
    }

    /// Reads the window from `settings`. For a setting without a value, `default` gives the value.
    pub(super) fn changed_by(
        default: Option<FrameWindow>,
        settings: &ModelSettings,
    ) -> Result<Option<FrameWindow>, SettingError> {
        let [frames, stride] = default.map_or([1, 1], |window| [window.frames, window.stride]);
        let frames = settings.value(&FRAMES, frames, |text| {
            number(text, 1..=FrameWindow::FRAMES_MAX)
        })?;
        let stride = settings.value(&STRIDE, stride, |text| {
            number(text, 1..=FrameWindow::STRIDE_MAX)
        })?;
        Ok(FrameWindow::new(frames, stride))
    }

    /// Number of frames.
    pub fn frames(self) -> u32 {
        self.frames
    }

    /// Number of frames from one frame of the window to the next.
    pub fn stride(self) -> u32 {
        self.stride
    }

    /// Positions in the sequence of the frames that the sample at position `place` reads, newest first. The first frame replaces missing earlier
    /// frames.
    pub fn places(self, place: usize) -> impl Iterator<Item = usize> {
        let back = move |frame: u32| frame as usize * self.stride as usize;
        (0..self.frames).map(move |frame| place.saturating_sub(back(frame)))
    }

    /// Appends the features of a window to `into`. For each cell, the values in every frame come first, the newest frame leading. The changes from
    /// each frame to the next newer frame follow, the newest change first.
    ///
    /// # Shapes
    /// `frames`: the features of each frame, the newest first, each `[cells, depth]`.
    pub fn join(self, frames: &[&[f32]], depth: usize, into: &mut Vec<f32>) {
        let cells = frames.first().map_or(0, |frame| frame.len() / depth.max(1));
        for cell in 0..cells {
            let own = || cell * depth..(cell + 1) * depth;
            for frame in frames {
                into.extend_from_slice(&frame[own()]);
            }
            for pair in frames.windows(2) {
                let values = pair[0][own()].iter().zip(&pair[1][own()]);
                into.extend(values.map(|(newer, older)| newer - older));
            }
        }
    }

    /// Number of values that a window has for each value of a single frame.
    pub(super) fn values_per_value(self) -> usize {
        2 * self.frames as usize - 1
    }

    /// True if the window has several frames, and the number of frames and the stride are in range.
    pub(super) fn is_valid(self) -> bool {
        (2..=FrameWindow::FRAMES_MAX).contains(&self.frames)
            && (1..=FrameWindow::STRIDE_MAX).contains(&self.stride)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_stand_side_by_side_in_each_cell_with_their_changes_after_them() {
        let window = FrameWindow::new(2, 1).expect("two frames");
        let mut joined = Vec::new();
        // Two cells of two values.
        let (now, before) = ([1.0, 2.0, 3.0, 4.0], [1.0, 1.0, 1.0, 8.0]);
        window.join(&[&now, &before], 2, &mut joined);
        let first = [1.0, 2.0, 1.0, 1.0, 0.0, 1.0];
        let second = [3.0, 4.0, 1.0, 8.0, 2.0, -4.0];
        assert_eq!(joined, [first, second].concat());
        assert_eq!(joined.len(), 4 * window.values_per_value());
    }
}
