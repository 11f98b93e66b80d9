//! Specification of features: kinds, grid, colour, difference from a reference, principal components.

use std::fmt;

use serde::{Deserialize, Serialize};
use taceva_core::{FeatureShape, SignalInfo};

use super::kinds::{FeatureKind, FeatureKinds};
use super::window::FrameWindow;
use crate::settings::{ModelSettings, SettingError, SettingInfo, number};

/// Colour mode of features: gray or RGB.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Color {
    /// One value per cell. RGB frames are converted to (299 R + 587 G + 114 B) / 1000, the luma of Rec. ITU-R BT.601.
    Gray,
    /// Three values per cell.
    Rgb,
}

impl Color {
    /// Number of values per cell: 1 or 3.
    pub const fn depth(self) -> usize {
        match self {
            Color::Gray => 1,
            Color::Rgb => 3,
        }
    }

    /// Name of the colour mode in settings.
    pub const fn name(self) -> &'static str {
        match self {
            Color::Gray => "gray",
            Color::Rgb => "rgb",
        }
    }
}

/// Specification of the features of a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FeatureSpec {
    /// Kinds of features computed for every cell. A model file without this entry uses pixels.
    #[serde(default, skip_serializing_if = "FeatureKinds::are_pixels")]
    pub kinds: FeatureKinds,
    /// Number of columns of cells.
    pub width: u32,
    /// Number of rows of cells.
    pub height: u32,
    /// Colour mode: gray or RGB.
    pub color: Color,
    /// True to subtract the contact-free reference frame.
    pub difference: bool,
    /// Number of principal components of the training part, which replace the values of the cells. `None` uses the values themselves.
    pub pca: Option<u32>,
    /// Number of values per taxel of signals; `None` for frames, and for signals until a recording states the number.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub channels: Option<u32>,
    /// Frames that one sample reads; `None` for its own frame only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub window: Option<FrameWindow>,
}

impl Default for FeatureSpec {
    fn default() -> FeatureSpec {
        FeatureSpec::DEFAULT
    }
}

pub(super) const INPUT: SettingInfo = SettingInfo {
    key: "input",
    accepts: "frame or signals",
    default: "the input of the recording; required if the recording has both",
    about: "the input of the model: the frames of a camera, or the signals of taxels",
};
pub(super) const KINDS: SettingInfo = SettingInfo {
    key: "features",
    accepts: "pixels, markers, gradients, statistics, or several joined by +",
    default: "pixels",
    about: "the values of every cell: brightness, displacements of markers, slopes by three lamps, or mean, spread and quantiles",
};
pub(crate) const SIZE: SettingInfo = SettingInfo {
    key: "size",
    accepts: "WIDTHxHEIGHT or one number for both, from 1 to 1024; up-to-64x48 or auto in fit, evaluate and models of scenes",
    default: "32x32, 128x96 for networks; 16x16 with markers, 8x8 with statistics",
    about: "number of cells of every frame; auto tries 1/4 to 2 times the default resolution and takes the coarsest grid within a standard error of the least error; up-to is limited to the pixels of a frame",
};
pub(super) const COLOR: SettingInfo = SettingInfo {
    key: "color",
    accepts: "gray or rgb; auto in fit, evaluate and models of scenes",
    default: "gray",
    about: "whether colour is kept; auto keeps it if frames have it",
};
pub(crate) const DIFFERENCE: SettingInfo = SettingInfo {
    key: "difference",
    accepts: "true or false; auto or in-color in fit, evaluate and models of scenes",
    default: "false",
    about: "whether the no-contact reference frame is subtracted from pixels and statistics; markers and gradients always compare with \
            it; in-color subtracts it from frames in colour if it exists",
};
const PCA: SettingInfo = SettingInfo {
    key: "pca",
    accepts: "a number of components from 1 to 65536",
    default: "all pixels",
    about: "number of principal components of the training part that replace the values of all cells",
};

impl FeatureSpec {
    /// Largest width and height.
    pub const SIDE_MAX: u32 = 1024;

    /// Largest number of principal components.
    pub const PCA_MAX: u32 = 65_536;

    /// Default features of linear models.
    pub const DEFAULT: FeatureSpec = FeatureSpec {
        kinds: FeatureKinds::PIXELS,
        width: 32,
        height: 32,
        color: Color::Gray,
        difference: false,
        pca: None,
        channels: None,
        window: None,
    };

    /// Settings of features that the model registry lists.
    pub const SETTINGS: &'static [SettingInfo] = &{
        let [frames, stride] = FrameWindow::SETTINGS;
        [INPUT, KINDS, SIZE, COLOR, DIFFERENCE, PCA, frames, stride]
    };

    /// Reads the features from `settings`.
    ///
    /// ```
    /// use taceva_models::{FeatureSpec, ModelSettings};
    /// let spec = FeatureSpec::from_settings(&ModelSettings::parse(["size=24x18", "pca=60"])?)?;
    /// assert_eq!((spec.width, spec.height, spec.pca), (24, 18, Some(60)));
    /// # Ok::<(), taceva_models::SettingError>(())
    /// ```
    ///
    /// # Errors
    /// [`SettingError`] for an unknown key or a value out of range.
    pub fn from_settings(settings: &ModelSettings) -> Result<FeatureSpec, SettingError> {
        FeatureSpec::DEFAULT.changed_by(settings)
    }

    /// Changes these features by `settings`.
    ///
    /// # Errors
    /// [`SettingError`] for an unknown key or a value out of range.
    pub fn changed_by(self, settings: &ModelSettings) -> Result<FeatureSpec, SettingError> {
        settings.check_keys(FeatureSpec::SETTINGS)?;
        let own = settings.value(&INPUT, self.kinds, |text| match text {
            "frame" => Some(self.kinds),
            "signals" => Some(FeatureKinds::SIGNALS),
            _ => None,
        })?;
        let kinds = settings.value(&KINDS, own, |text| {
            let kinds = FeatureKinds::parse(text)?;
            // Two settings select the input: rejects a contradiction.
            let is_signals = kinds == FeatureKinds::SIGNALS;
            let agrees = settings
                .get(INPUT.key)
                .is_none_or(|input| (input == "signals") == is_signals);
            agrees.then_some(kinds)
        })?;
        let default = self.with_kinds(kinds);
        let (width, height) = settings.value(&SIZE, (default.width, default.height), size)?;
        Ok(FeatureSpec {
            kinds,
            width,
            height,
            color: settings.value(&COLOR, default.color, |text| {
                [Color::Gray, Color::Rgb]
                    .into_iter()
                    .find(|color| color.name() == text)
            })?,
            difference: settings
                .value(&DIFFERENCE, default.difference, |text| text.parse().ok())?,
            pca: settings.value(&PCA, default.pca, |text| {
                number(text, 1..=FeatureSpec::PCA_MAX).map(Some)
            })?,
            channels: None,
            window: FrameWindow::changed_by(self.window, settings)?,
        })
    }

    /// Changes the kinds of features. Unless pixels are the only kind, the grid becomes the coarsest default grid of these kinds.
    fn with_kinds(self, kinds: FeatureKinds) -> FeatureSpec {
        let others = kinds.iter().filter(|_| !kinds.are_pixels());
        let side = others.map(FeatureKind::side).min();
        FeatureSpec {
            kinds,
            width: side.unwrap_or(self.width),
            height: side.unwrap_or(self.height),
            ..self
        }
    }

    /// Features that read the signals described by `info`, with one cell per taxel instead of the requested grid.
    #[must_use]
    pub fn of_signals(self, info: SignalInfo) -> FeatureSpec {
        FeatureSpec {
            kinds: FeatureKinds::SIGNALS,
            width: info.columns,
            height: info.rows,
            color: Color::Gray,
            channels: Some(info.channels),
            ..self
        }
    }

    /// Shape of one sample's features, before principal components.
    pub fn shape(&self) -> FeatureShape {
        let FeatureShape { depth, .. } = self.frame_shape();
        let values = self.window.map_or(1, FrameWindow::values_per_value);
        FeatureShape {
            depth: depth * values,
            ..self.frame_shape()
        }
    }

    /// Shape of the features of a single frame, or of the signals of one instant.
    pub fn frame_shape(&self) -> FeatureShape {
        FeatureShape {
            height: self.height as usize,
            width: self.width as usize,
            depth: match self.channels {
                Some(channels) => channels as usize,
                None => self.kinds.iter().map(|kind| kind.depth(self.color)).sum(),
            },
        }
    }

    /// Setting that needs the contact-free reference frame; `None` if no setting needs a reference frame.
    pub fn asks_for_reference(&self) -> Option<&'static str> {
        let by_kind = self.kinds.iter().find(|kind| kind.needs_reference());
        match by_kind {
            _ if self.difference => Some("difference=true"),
            Some(FeatureKind::Markers) => Some("features=markers"),
            Some(_) => Some("features=gradients"),
            None => None,
        }
    }

    /// True if all values are in the range of [`from_settings`](FeatureSpec::from_settings).
    pub(crate) fn is_valid(&self) -> bool {
        let sides = 1..=FeatureSpec::SIDE_MAX;
        let is_grid = match self.channels {
            None => sides.contains(&self.width) && sides.contains(&self.height),
            Some(channels) => {
                SignalInfo::new(self.height, self.width, channels, taceva_core::Unit::One).is_ok()
            }
        };
        is_grid
            && (self.kinds == FeatureKinds::SIGNALS) == self.channels.is_some()
            && self.window.is_none_or(FrameWindow::is_valid)
            && self
                .pca
                .is_none_or(|count| (1..=FeatureSpec::PCA_MAX).contains(&count))
    }
}

/// Parses columns and rows of cells, as `WIDTHxHEIGHT` or as one number for both; `None` for any other text.
pub(super) fn size(text: &str) -> Option<(u32, u32)> {
    let side = |text| number(text, 1..=FeatureSpec::SIDE_MAX);
    match text.split_once('x') {
        Some((width, height)) => Some((side(width)?, side(height)?)),
        None => side(text).map(|side| (side, side)),
    }
}

impl fmt::Display for FeatureSpec {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let FeatureSpec { width, height, .. } = self;
        match self.channels {
            Some(channels) => write!(f, "signals of {height}×{width} places of {channels}")?,
            None => write!(f, "{width}×{height} {}", self.color.name())?,
        }
        if self.channels.is_none() && !self.kinds.are_pixels() {
            write!(f, " {}", self.kinds)?;
        }
        match (self.difference, self.channels) {
            (false, _) => {}
            (true, None) => f.write_str(", difference from the reference")?,
            (true, Some(_)) => f.write_str(", difference from rest")?,
        }
        if let Some(window) = self.window {
            let (frames, stride) = (window.frames(), window.stride());
            write!(f, ", windows of {frames} frames with stride {stride}")?;
        }
        match self.pca {
            Some(count) => write!(f, ", {count} principal components"),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(words: &[&str]) -> Result<FeatureSpec, SettingError> {
        FeatureSpec::from_settings(&ModelSettings::parse(words.iter().copied())?)
    }

    #[test]
    fn one_number_gives_both_sides() {
        let spec = parse(&["size=20", "color=rgb", "difference=true"]).expect("valid");
        assert_eq!(spec.to_string(), "20×20 rgb, difference from the reference");
        assert_eq!(spec.shape().len(), 1200);
    }

    #[test]
    fn each_kind_has_a_grid_of_its_own_unless_another_is_asked_for() {
        let shape = |words: &[&str]| parse(words).expect("valid").shape();
        let sides = |words: &[&str]| (shape(words).width, shape(words).depth);
        assert_eq!(sides(&["features=pixels"]), (32, 1));
        assert_eq!(sides(&["features=markers"]), (16, 3));
        assert_eq!(sides(&["features=pixels+statistics", "color=rgb"]), (8, 24));
        assert_eq!(sides(&["features=gradients", "size=20"]), (20, 3));
        let spec = parse(&["features=markers+pixels"]).expect("valid");
        assert_eq!(spec.to_string(), "16×16 gray pixels+markers");
        assert_eq!(spec.asks_for_reference(), Some("features=markers"));
    }

    #[test]
    fn the_spec_of_an_older_file_says_nothing_of_kinds_and_means_pixels() {
        let old = r#"{"width":24,"height":18,"color":"gray","difference":true,"pca":null}"#;
        let spec: FeatureSpec = serde_json::from_str(old).expect("reads");
        assert_eq!(spec.kinds, FeatureKinds::PIXELS);
        assert_eq!(serde_json::to_string(&spec).expect("writes"), old);
        let new = parse(&["features=markers+pixels"]).expect("valid");
        let text = serde_json::to_string(&new).expect("writes");
        assert!(text.contains(r#""kinds":"pixels+markers""#), "{text}");
        assert_eq!(
            serde_json::from_str::<FeatureSpec>(&text).expect("reads"),
            new
        );
    }

    #[test]
    fn a_window_has_the_values_of_its_frames_and_their_changes_and_one_frame_is_no_window() {
        let spec = parse(&["size=4", "window=3", "stride=2"]).expect("valid");
        assert_eq!((spec.shape().depth, spec.frame_shape().depth), (5, 1));
        let words = "4×4 gray, windows of 3 frames with stride 2";
        assert_eq!(spec.to_string(), words);
        let text = serde_json::to_string(&spec).expect("writes");
        let read: FeatureSpec = serde_json::from_str(&text).expect("reads");
        assert_eq!(read, spec);
        assert_eq!(parse(&["window=1"]).expect("valid"), FeatureSpec::DEFAULT);
    }

    #[test]
    fn sizes_out_of_range_are_refused() {
        for word in [
            "size=0",
            "size=32x",
            "size=x32",
            "size=1025",
            "pca=0",
            "difference=1",
            "features=smells",
            "features=",
            "window=65",
            "stride=0",
        ] {
            assert!(
                matches!(parse(&[word]), Err(SettingError::Value { .. })),
                "{word}"
            );
        }
    }

    #[test]
    fn american_and_british_colours_are_distinguished_by_name() {
        let error = parse(&["colour=gray"]).expect_err("unknown");
        assert_eq!(
            error.to_string(),
            "`colour`: unknown key, did you mean `color`?"
        );
    }
}
