//! Numbers that people set.

use std::ops::RangeInclusive;
use std::str::FromStr;

use taceva_models::{SettingError, SettingInfo, Settings};

/// The number that `settings` give for `info`, or `default`.
///
/// # Errors
/// [`SettingError::Value`] for what is no number within `range`.
pub(crate) fn number<T: FromStr + PartialOrd>(
    settings: &Settings,
    info: &SettingInfo,
    default: T,
    range: RangeInclusive<T>,
) -> Result<T, SettingError> {
    settings.value(info, default, |text| within(text, range))
}

/// The number that `settings` give for `info`, if they give one; otherwise it is chosen.
///
/// # Errors
/// As [`number`].
pub(crate) fn open<T: FromStr + PartialOrd>(
    settings: &Settings,
    info: &SettingInfo,
    range: RangeInclusive<T>,
) -> Result<Option<T>, SettingError> {
    settings.value(info, None, |text| within(text, range).map(Some))
}

fn within<T: FromStr + PartialOrd>(text: &str, range: RangeInclusive<T>) -> Option<T> {
    text.parse().ok().filter(|value| range.contains(value))
}

/// The one value that was set, or `values` to choose from.
pub(crate) fn candidates(set: Option<f64>, values: &[f64]) -> Vec<f64> {
    set.map_or_else(|| values.to_vec(), |value| vec![value])
}
