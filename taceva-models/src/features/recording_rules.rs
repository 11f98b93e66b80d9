//! Feature settings that depend on the frames of a recording. A setting can limit the feature grid to one cell per pixel. Another one uses colour
//! only if frames have it. A third one subtracts a contact-free frame if frames have colour and the recording has such a frame.

use taceva_core::FrameInfo;

use super::spec::{COLOR, Color, DIFFERENCE, FeatureSpec, SIZE, size};
use crate::settings::{ModelSettings, SettingError};

/// Value of the colour setting that uses colour if the frames have colour, and otherwise gray.
const BY_FRAME: &str = "auto";

/// Value of the difference setting that subtracts the reference frame from colour frames.
const IN_COLOR: &str = "in-color";

/// Prefix of a grid size that the frame size limits to one cell per pixel.
const UP_TO: &str = "up-to-";

/// Feature settings that depend on the frames of a recording.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FeaturesByRecording {
    /// Columns and rows of the largest grid, which the frame size limits further; `None` if the grid does not depend on frames.
    most: Option<(u32, u32)>,
    /// True to use colour if frames have colour.
    color: bool,
    /// True to subtract the reference frame if frames have colour and there is a reference.
    difference: bool,
}

/// Properties of a recording's frames that features depend on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RecordedFrames {
    /// Size and format.
    pub info: FrameInfo,
    /// True if the recording has a contact-free reference frame.
    pub has_reference: bool,
}

impl FeaturesByRecording {
    /// Splits `settings` into settings that depend on frames, and the rest.
    ///
    /// ```
    /// use taceva_core::{FrameInfo, PixelFormat};
    /// use taceva_models::{FeatureSpec, FeaturesByRecording, ModelSettings, RecordedFrames};
    /// let settings = ModelSettings::parse(["size=up-to-64x48", "color=auto", "pca=9"])?;
    /// let (open, rest) = FeaturesByRecording::of(&settings)?;
    /// let asked = FeatureSpec::from_settings(&rest)?;
    /// let info = FrameInfo { width: 40, height: 60, format: PixelFormat::Rgb8 };
    /// let small = RecordedFrames { info, has_reference: false };
    /// assert_eq!(open.on(asked, Some(small)).to_string(), "40×48 rgb, 9 principal components");
    /// # Ok::<(), taceva_models::SettingError>(())
    /// ```
    ///
    /// # Errors
    /// [`SettingError::Value`] for `up-to-` without a valid size.
    pub fn of(
        settings: &ModelSettings,
    ) -> Result<(FeaturesByRecording, ModelSettings), SettingError> {
        let open = FeaturesByRecording {
            most: settings.value(&SIZE, None, |text| match text.strip_prefix(UP_TO) {
                Some(most) => size(most).map(Some),
                None => Some(None),
            })?,
            color: settings.get(COLOR.key) == Some(BY_FRAME),
            difference: settings.get(DIFFERENCE.key) == Some(IN_COLOR),
        };
        let mut rest = settings.clone();
        let all = [
            (open.most.is_some(), SIZE),
            (open.color, COLOR),
            (open.difference, DIFFERENCE),
        ];
        for (is_open, setting) in all {
            if is_open {
                rest = rest.partition(&[setting]).1;
            }
        }
        Ok((open, rest))
    }

    /// Adapts the rules to the finer grid of `closer`. If the user set no size, colour or difference, this setting also depends on the frames.
    #[must_use]
    pub fn closer(self, closer: FeatureSpec, settings: &ModelSettings) -> FeaturesByRecording {
        let is_set = |key: &str| settings.get(key).is_some();
        let own = (!is_set(SIZE.key)).then_some((closer.width, closer.height));
        FeaturesByRecording {
            most: self.most.or(own),
            color: self.color || !is_set(COLOR.key),
            difference: self.difference || !is_set(DIFFERENCE.key),
        }
    }

    /// True if the grid depends on the frames.
    pub fn leaves_grid(self) -> bool {
        self.most.is_some()
    }

    /// Resolves the features for `frames`. Returns `asked` if there are no frames.
    #[must_use]
    pub fn on(self, asked: FeatureSpec, frames: Option<RecordedFrames>) -> FeatureSpec {
        let Some(RecordedFrames {
            info,
            has_reference,
        }) = frames
        else {
            return asked;
        };
        let (width, height) = match self.most {
            Some((width, height)) => (width.min(info.width), height.min(info.height)),
            None => (asked.width, asked.height),
        };
        let in_color = info.format.samples() > 1;
        let color = match self.color {
            true if in_color => Color::Rgb,
            true => Color::Gray,
            false => asked.color,
        };
        FeatureSpec {
            width,
            height,
            color,
            difference: asked.difference || (self.difference && in_color && has_reference),
            ..asked
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use taceva_core::PixelFormat;

    fn of(words: &[&str]) -> Result<(FeaturesByRecording, ModelSettings), SettingError> {
        FeaturesByRecording::of(&ModelSettings::parse(words.iter().copied())?)
    }

    fn frame(width: u32, height: u32, format: PixelFormat) -> Option<RecordedFrames> {
        Some(RecordedFrames {
            info: FrameInfo {
                width,
                height,
                format,
            },
            has_reference: true,
        })
    }

    #[test]
    fn cells_are_no_more_than_pixels_and_colours_are_those_of_the_frames() {
        let (open, rest) = of(&["size=up-to-64", "color=auto", "difference=true"]).expect("valid");
        assert_eq!(rest.words().collect::<Vec<_>>(), ["difference=true"]);
        assert!(open.leaves_grid());
        let asked = FeatureSpec::from_settings(&rest).expect("valid");
        let seen = |frame| {
            let spec = open.on(asked, frame);
            (spec.width, spec.height, spec.color, spec.difference)
        };
        let large = frame(640, 480, PixelFormat::Gray8);
        assert_eq!(seen(large), (64, 64, Color::Gray, true));
        let low = frame(100, 30, PixelFormat::Rgb16);
        assert_eq!(seen(low), (64, 30, Color::Rgb, true));
        assert_eq!(open.on(asked, None), asked);
    }

    #[test]
    fn the_reference_is_subtracted_from_frames_in_colour_that_have_one() {
        let (open, rest) = of(&["difference=in-color"]).expect("valid");
        let asked = FeatureSpec::from_settings(&rest).expect("valid");
        let differs = |frames| open.on(asked, frames).difference;
        let [gray, color] = [PixelFormat::Gray8, PixelFormat::Rgb16].map(|f| frame(64, 64, f));
        assert!(!differs(gray) && differs(color));
        let without = color.map(|frames| RecordedFrames {
            has_reference: false,
            ..frames
        });
        assert!(!differs(without) && !differs(None));
    }

    #[test]
    fn what_is_set_is_not_left_to_the_frames() {
        let words = ["size=64x48", "color=gray", "difference=false"];
        let (open, rest) = of(&words).expect("valid");
        assert_eq!(open, FeaturesByRecording::default());
        assert_eq!(rest.words().count(), 3);
        let asked = FeatureSpec::from_settings(&rest).expect("valid");
        let small = frame(8, 8, PixelFormat::Rgb8);
        assert_eq!(open.on(asked, small), asked);
        assert_eq!(open.closer(asked, &rest), open);
        let none = ModelSettings::default();
        let closer = open.closer(asked, &none).on(asked, small);
        assert_eq!((closer.width, closer.color), (8, Color::Rgb));
        assert!(closer.difference);
    }

    #[test]
    fn up_to_no_size_is_refused_with_what_is_accepted() {
        for word in [
            "size=up-to-",
            "size=up-to-0",
            "size=up-to-auto",
            "size=up-to-9x",
        ] {
            let error = of(&[word]).expect_err(word).to_string();
            assert!(error.contains("up-to-64x48"), "{error}");
        }
    }
}
