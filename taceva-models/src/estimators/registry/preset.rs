//! Presets: short names for a model with settings. Users choose a preset by the time they have.

use std::fmt;

use crate::features::FeatureSpec;
use crate::settings::ModelSettings;

/// Name for a model with settings. Cards, reports and results files state the model and its settings, so results stay reproducible
/// if a preset changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Preset {
    /// Name of the preset on the command line.
    pub name: &'static str,
    /// Name of the model.
    pub model: &'static str,
    /// Settings as keys and values. Explicit settings of the user override them.
    pub settings: &'static [(&'static str, &'static str)],
}

/// With [`DIFFERENCE`] and [`APPEARANCE`], adapts a preset to the recording. Colour frames use colours minus the contact-free frame, with light as
/// signal. Gray frames use markers.
const COLOR: (&str, &str) = ("color", "auto");
const DIFFERENCE: (&str, &str) = ("difference", "in-color");
const APPEARANCE: (&str, &str) = ("appearance", "auto");

const FAST: Preset = Preset {
    name: "fast",
    model: "cnn",
    settings: &[
        ("size", "up-to-80x60"),
        ("epochs", "170"),
        COLOR,
        DIFFERENCE,
        APPEARANCE,
    ],
};

/// Preset `default`: the small network. [`Auto`](crate::Auto) also tries this network.
pub(crate) const DEFAULT: Preset = Preset {
    name: "default",
    model: "cnn",
    settings: &[("size", "up-to-128x96"), COLOR, DIFFERENCE, APPEARANCE],
};

const BEST: Preset = Preset {
    name: "best",
    model: "cnn-ensemble",
    settings: DEFAULT.settings,
};

/// All presets, the fastest first. Their costs and accuracies are in docs/models.md.
pub const PRESETS: &[Preset] = &[FAST, DEFAULT, BEST];

impl Preset {
    /// Finds the preset `name`; `None` for an unknown name.
    pub fn named(name: &str) -> Option<&'static Preset> {
        PRESETS.iter().find(|preset| preset.name == name)
    }

    /// Settings of the preset and `given` together. A setting in `given` overrides the preset.
    #[must_use]
    pub fn changed_by(&self, given: ModelSettings) -> ModelSettings {
        given.or(self.settings)
    }

    /// Settings of the preset for the model only, without the settings for features.
    pub(crate) fn of_model(&self) -> ModelSettings {
        let all = self.changed_by(ModelSettings::default());
        all.partition(FeatureSpec::SETTINGS).1
    }
}

/// Formats the preset as `fast: cnn size=up-to-80x60`.
impl fmt::Display for Preset {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.name, self.model)?;
        let mut settings = self.settings.iter();
        settings.try_for_each(|(key, value)| write!(f, " {key}={value}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::models::Models;

    #[test]
    fn every_preset_is_a_model_with_settings_that_it_takes_and_no_model_has_its_name() {
        let models = Models::builtin();
        for preset in PRESETS {
            let none = ModelSettings::default();
            let (model, settings) = models.asked(preset.name, none).expect("known");
            assert_eq!(model.name(), preset.model);
            let (_, settings) = crate::FeaturesByRecording::of(&settings).expect("valid");
            let (features, own) = settings.partition(crate::FeatureSpec::SETTINGS);
            model.features().changed_by(&features).expect("valid");
            model.estimator(&own).expect("valid");
            assert!(crate::find(preset.name).is_err(), "{preset}");
        }
    }

    #[test]
    fn what_a_person_sets_goes_before_what_a_preset_says() {
        let given = ModelSettings::parse(["jitter=0", "seed=3"]).expect("pairs");
        let (model, settings) = Models::builtin().asked("fast", given).expect("known");
        assert_eq!(model.name(), "cnn");
        let words: Vec<String> = settings.words().collect();
        assert_eq!(
            words,
            [
                "appearance=auto",
                "color=auto",
                "difference=in-color",
                "epochs=170",
                "jitter=0",
                "seed=3",
                "size=up-to-80x60"
            ]
        );
    }

    #[test]
    fn a_misspelt_preset_is_refused_with_the_nearest_name() {
        let error = Models::builtin()
            .asked("fats", ModelSettings::default())
            .map(drop)
            .expect_err("misspelt");
        assert_eq!(
            error.to_string(),
            "no model is called `fats`, did you mean `fast`?"
        );
    }
}
