//! Adapter to a library model: a registry entry, numeric settings and functions that call the library.

use std::collections::BTreeSet;

use taceva_core::{ErrorKind, ModelError, TrainingSet};

use crate::estimators::discriminant::VALUES_MAX;
use crate::estimators::library::{
    LibraryLearner, LibraryModel, LibraryPredictor, LibrarySettings, LibraryTask, LoadedPredictor,
    library_estimator,
};
use crate::settings::{ModelSettings, SettingError, SettingInfo};
use crate::training::fit::ModelEstimator;

/// Adapter to one estimator of a library.
pub(crate) struct Adapter {
    pub(crate) model: LibraryModel,
    pub(crate) numbers: &'static [Number],
    /// True for classifiers.
    pub(crate) is_classifier: bool,
    /// Rejects training sets that the library does not support.
    pub(crate) check: fn(&TrainingSet<'_>) -> Result<(), ModelError>,
    /// Fits the library's estimator with the given values of the settings.
    pub(crate) fit: fn(&Numbers<'_>, &LibraryTask<'_>) -> LoadedPredictor,
}

/// A numeric setting of an adapter.
pub(crate) struct Number {
    pub(crate) info: SettingInfo,
    /// Smallest and largest valid value.
    pub(crate) range: [f64; 2],
    pub(crate) is_whole: bool,
    pub(crate) unset: Unset,
}

/// Default of a numeric setting.
#[derive(Clone, Copy)]
pub(crate) enum Unset {
    /// A fixed value.
    Is(f64),
    /// Candidate values, that of the simplest model last. Each channel uses the value with the smallest held-out error.
    ChosenAmong(&'static [f64]),
}

/// Values of an adapter's settings; `None` for a setting chosen by held-out error.
pub(crate) struct Numbers<'a> {
    adapter: &'a Adapter,
    values: &'a [Option<f64>],
}

/// Accepts every training set.
pub(crate) fn any(_: &TrainingSet<'_>) -> Result<(), ModelError> {
    Ok(())
}

/// Accepts training sets in which each channel has at most `VALUES_MAX` distinct labels, for the classifier `name`.
pub(crate) fn few_labels(name: &str, training: &TrainingSet<'_>) -> Result<(), ModelError> {
    let channels = training.targets.channels.as_slice();
    for (position, channel) in channels.iter().enumerate() {
        let labels = training.targets.values.iter().skip(position);
        let labels: BTreeSet<u64> = labels
            .step_by(channels.len())
            .map(|label| label.to_bits())
            .collect();
        let values = labels.len();
        if values > VALUES_MAX {
            return Err(ModelError::new(
                ErrorKind::InvalidArgument,
                format!(
                    "`{channel}` has {values} values in the training part, {name} accepts at most {VALUES_MAX} classes: for continuous \
                        labels choose another model, such as linfa/elastic-net"
                ),
            ));
        }
    }
    Ok(())
}

impl Adapter {
    /// Builds the estimator from `settings`.
    ///
    /// # Errors
    /// [`SettingError`] for an unknown key or a value out of range.
    pub(crate) fn estimator(
        &'static self,
        settings: &ModelSettings,
    ) -> Result<Box<dyn ModelEstimator>, SettingError> {
        settings.check_keys(self.model.info.settings)?;
        let common = LibrarySettings::from_settings(settings)?;
        let values = self.numbers.iter().map(|number| number.of(settings));
        Ok(library_estimator(Learner {
            adapter: self,
            settings: common,
            values: values.collect::<Result<_, _>>()?,
        }))
    }
}

impl Number {
    /// Value of the setting in `settings` or its default; `None` if it is to be chosen by held-out error.
    fn of(&self, settings: &ModelSettings) -> Result<Option<f64>, SettingError> {
        let [least, greatest] = self.range;
        let read = |text: &str| {
            let value: f64 = match self.is_whole {
                true => f64::from(text.parse::<u32>().ok()?),
                false => text.parse().ok()?,
            };
            (least..=greatest).contains(&value).then_some(Some(value))
        };
        let default = match self.unset {
            Unset::Is(value) => Some(value),
            Unset::ChosenAmong(_) => None,
        };
        settings.value(&self.info, default, read)
    }
}

impl Numbers<'_> {
    /// Value of the setting `number`; NaN if it is chosen by held-out error.
    pub(crate) fn real(&self, number: &Number) -> f64 {
        let mut numbers = self.adapter.numbers.iter();
        let place = numbers.position(|known| known.info.key == number.info.key);
        let value = place.and_then(|place| self.values.get(place).copied().flatten());
        value.unwrap_or(f64::NAN)
    }

    /// Value of the integer setting `number`.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "read as a whole number of 32 bits"
    )]
    #[cfg(feature = "smartcore")]
    pub(crate) fn whole(&self, number: &Number) -> u32 {
        self.real(number) as u32
    }
}

/// An adapter with the values of its settings.
struct Learner {
    adapter: &'static Adapter,
    settings: LibrarySettings,
    values: Vec<Option<f64>>,
}

impl LibraryLearner for Learner {
    fn model(&self) -> &'static LibraryModel {
        &self.adapter.model
    }

    fn settings(&self) -> LibrarySettings {
        self.settings
    }

    fn candidates(&self) -> Option<(&'static str, Vec<f64>)> {
        let mut numbers = self.adapter.numbers.iter().zip(&self.values);
        numbers.find_map(|(number, set)| match number.unset {
            Unset::Is(_) => None,
            Unset::ChosenAmong(tried) => {
                let values = set.map_or_else(|| tried.to_vec(), |value| vec![value]);
                Some((number.info.key, values))
            }
        })
    }

    fn is_classifier(&self) -> bool {
        self.adapter.is_classifier
    }

    fn check(&self, training: &TrainingSet<'_>) -> Result<(), ModelError> {
        (self.adapter.check)(training)
    }

    fn fit(&self, task: &LibraryTask<'_>) -> Result<Box<dyn LibraryPredictor>, ModelError> {
        let numbers = Numbers {
            adapter: self.adapter,
            values: &self.values,
        };
        (self.adapter.fit)(&numbers, task)
    }
}
