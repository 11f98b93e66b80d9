//! Preprocessing and augmentation of pictures for a network. Both depend on the kind of signal in the pictures: moving markers, or light.

use taceva_core::FeatureShape;
use taceva_network::Jitter;

use crate::features::Preprocessing;
use crate::settings::{ModelSettings, SettingError, SettingInfo, number};

/// Part of a picture that carries the touch. It sets the default preprocessing and augmentation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Appearance {
    /// Moving markers. The local mean of the pixels is subtracted, and each picture is divided by its standard deviation. Training pictures are
    /// shifted. Lengths in pixels grow in proportion to the picture's width.
    Markers,
    /// Brightness and position of light. Pictures are unchanged.
    Light,
    /// `Light` for pictures with several values per cell, such as colour. `Markers` for other pictures.
    ByPicture,
}

/// Preprocessing and augmentation of pictures of one shape, with all defaults filled in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Prepared {
    pub(super) preprocessing: Preprocessing,
    /// Largest shift of training pictures, in pixels.
    pub(super) jitter_px: usize,
    /// Standard deviation of the noise added to training pictures, after preprocessing.
    pub(super) noise: f64,
}

/// Default settings for pictures with `USUAL_WIDTH` columns.
const USUAL: Prepared = Prepared {
    preprocessing: Preprocessing {
        local_mean_px: 6.0,
        contrast: true,
    },
    jitter_px: 3,
    noise: 0.1,
};

/// Picture width, in pixels, for which the lengths of [`USUAL`] are meant.
const USUAL_WIDTH: usize = 128;

/// Settings that leave pictures unchanged.
const AS_THEY_ARE: Prepared = Prepared {
    preprocessing: Preprocessing {
        local_mean_px: 0.0,
        contrast: false,
    },
    jitter_px: 0,
    noise: 0.0,
};

/// Preprocessing and augmentation as set by the user. `None` stands for the default.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Preparation {
    appearance: Option<Appearance>,
    local_mean_px: Option<f64>,
    contrast: Option<bool>,
    jitter_px: Option<usize>,
    noise: Option<f64>,
    of_signals: bool,
}

const APPEARANCE: SettingInfo = SettingInfo {
    key: "appearance",
    accepts: "markers, light or auto",
    default: "the defaults of local_mean, contrast, jitter and noise",
    about: "which part of a picture is the signal; it sets the defaults of local_mean, contrast, jitter and noise: markers that move (a local mean of \
            6 and a jitter \
            of 3 per 128 columns), or light and place (0, false, 0 and 0); auto is light for pictures in colour",
};
const JITTER: SettingInfo = SettingInfo {
    key: "jitter",
    accepts: "a number of pixels from 0 to 100",
    default: "3; 0 for signals",
    about: "greatest shift of training pictures",
};
const NOISE: SettingInfo = SettingInfo {
    key: "noise",
    accepts: "a number from 0 to 10",
    default: "0.1",
    about: "the standard deviation of the noise added to training pictures, after preprocessing",
};
const LOCAL_MEAN: SettingInfo = SettingInfo {
    key: "local_mean",
    accepts: "a number of pixels from 0 to 100",
    default: "6; 0 for signals",
    about: "the standard deviation of the Gaussian whose mean is subtracted around each pixel; 0 subtracts nothing",
};
const CONTRAST: SettingInfo = SettingInfo {
    key: "contrast",
    accepts: "true or false",
    default: "true; false for signals",
    about: "whether each picture is divided by its standard deviation",
};

impl Preparation {
    /// Settings of preprocessing and augmentation in the model registry.
    pub(super) const SETTINGS: [SettingInfo; 5] = [APPEARANCE, JITTER, NOISE, LOCAL_MEAN, CONTRAST];

    /// Reads the settings of preprocessing and augmentation. Settings that are missing keep their defaults.
    pub(super) fn from_settings(settings: &ModelSettings) -> Result<Preparation, SettingError> {
        Ok(Preparation {
            appearance: settings.value(&APPEARANCE, None, |text| match text {
                "markers" => Some(Some(Appearance::Markers)),
                "light" => Some(Some(Appearance::Light)),
                "auto" => Some(Some(Appearance::ByPicture)),
                _ => None,
            })?,
            local_mean_px: settings.value(&LOCAL_MEAN, None, |text| {
                number(text, 0.0..=Preprocessing::LOCAL_MEAN_MAX).map(Some)
            })?,
            contrast: settings.value(&CONTRAST, None, |text| text.parse().ok().map(Some))?,
            jitter_px: settings.value(&JITTER, None, |text| number(text, 0..=100).map(Some))?,
            noise: settings.value(&NOISE, None, |text| number(text, 0.0..=10.0).map(Some))?,
            of_signals: false,
        })
    }

    /// Settings for signals of taxels. Their mean, contrast and position depend on the touch. By default, only noise is added to training samples.
    pub(super) fn of_signals(self) -> Preparation {
        Preparation {
            of_signals: true,
            ..self
        }
    }

    /// Preprocessing and augmentation for pictures of `shape`. Defaults replace settings that the user left out.
    pub(super) fn of(self, shape: FeatureShape) -> Prepared {
        let usual = match self.appearance {
            _ if self.of_signals => Prepared {
                noise: USUAL.noise,
                ..AS_THEY_ARE
            },
            None => USUAL,
            Some(Appearance::ByPicture) if shape.depth == 1 => markers(shape.width),
            Some(Appearance::Markers) => markers(shape.width),
            Some(Appearance::Light | Appearance::ByPicture) => AS_THEY_ARE,
        };
        let Preprocessing {
            local_mean_px,
            contrast,
        } = usual.preprocessing;
        Prepared {
            preprocessing: Preprocessing {
                local_mean_px: self.local_mean_px.unwrap_or(local_mean_px),
                contrast: self.contrast.unwrap_or(contrast),
            },
            jitter_px: self.jitter_px.unwrap_or(usual.jitter_px),
            noise: self.noise.unwrap_or(usual.noise),
        }
    }
}

impl Prepared {
    /// Random shifts of training pictures. The labels remain unchanged.
    pub(super) fn jitter(&self) -> Jitter {
        Jitter {
            pixels: self.jitter_px,
            label_per_pixel: Vec::new(),
        }
    }
}

/// Settings of [`USUAL`] for pictures of `width` columns. Lengths in pixels are proportional to `width`.
fn markers(width: usize) -> Prepared {
    let share = width as f64 / USUAL_WIDTH as f64;
    Prepared {
        preprocessing: Preprocessing {
            // Limited to the range of the setting.
            local_mean_px: (share * USUAL.preprocessing.local_mean_px)
                .min(Preprocessing::LOCAL_MEAN_MAX),
            ..USUAL.preprocessing
        },
        // Rounds half up.
        jitter_px: (2 * USUAL.jitter_px * width + USUAL_WIDTH) / (2 * USUAL_WIDTH),
        noise: USUAL.noise,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Settings for test pictures of this width and depth, in order: local mean, contrast, jitter, noise. `words` are `key=value` settings.
    fn of(words: &[&str], width: usize, depth: usize) -> (f64, bool, usize, f64) {
        let settings = ModelSettings::parse(words.iter().copied()).expect("pairs");
        let preparation = Preparation::from_settings(&settings).expect("valid");
        said(preparation.of(shape(width, depth)))
    }

    fn shape(width: usize, depth: usize) -> FeatureShape {
        FeatureShape {
            height: 48,
            width,
            depth,
        }
    }

    fn said(prepared: Prepared) -> (f64, bool, usize, f64) {
        let Preprocessing {
            local_mean_px,
            contrast,
        } = prepared.preprocessing;
        (local_mean_px, contrast, prepared.jitter_px, prepared.noise)
    }

    #[test]
    fn markers_are_prepared_in_proportion_to_the_grid_and_as_usual_at_128_columns() {
        let usual = of(&[], 128, 1);
        assert_eq!(of(&[], 64, 1), usual);
        assert_eq!(of(&["appearance=markers"], 128, 1), usual);
        assert_eq!(of(&["appearance=markers"], 64, 1), (3.0, true, 2, 0.1));
        assert_eq!(of(&["appearance=markers"], 32, 3), (1.5, true, 1, 0.1));
        assert_eq!(of(&["appearance=markers"], 8, 1), (0.375, true, 0, 0.1));
    }

    #[test]
    fn pictures_in_colour_are_left_as_they_are_where_that_is_left_open() {
        let light = (0.0, false, 0, 0.0);
        assert_eq!(of(&["appearance=light"], 64, 1), light);
        assert_eq!(of(&["appearance=auto"], 64, 3), light);
        assert_eq!(of(&["appearance=auto"], 64, 1), (3.0, true, 2, 0.1));
        // Without the setting, colours change nothing.
        assert_eq!(of(&[], 64, 3), of(&[], 64, 1));
    }

    #[test]
    fn what_a_person_sets_goes_before_what_a_picture_is() {
        let words = ["appearance=auto", "jitter=1", "noise=0.02"];
        assert_eq!(of(&words, 64, 3), (0.0, false, 1, 0.02));
        let words = ["appearance=light", "local_mean=2", "contrast=true"];
        assert_eq!(of(&words, 64, 1), (2.0, true, 0, 0.0));
    }

    #[test]
    fn signals_are_left_as_they_are_whatever_is_said_of_pictures() {
        for words in [&[][..], &["appearance=auto"], &["appearance=markers"]] {
            let settings = ModelSettings::parse(words.iter().copied()).expect("pairs");
            let preparation = Preparation::from_settings(&settings).expect("valid");
            let prepared = preparation.of_signals().of(shape(10, 1));
            assert_eq!(said(prepared), (0.0, false, 0, 0.1), "{words:?}");
        }
    }

    #[test]
    fn an_appearance_of_another_name_is_refused_with_those_there_are() {
        let settings = ModelSettings::parse(["appearance=dark"]).expect("pairs");
        let error = Preparation::from_settings(&settings).expect_err("no such");
        assert!(
            error.to_string().contains("markers, light or auto"),
            "{error}"
        );
    }
}
