//! Settings of support vector regression, shared by both libraries.

use crate::estimators::library::adapter::{Number, Unset};
use crate::settings::SettingInfo;

pub(crate) const LENGTH: Number = Number {
    info: SettingInfo {
        key: "length",
        accepts: "a number from 0.01 to 100",
        default: "1",
        about: "length scale of the kernel, in typical distances of a sample from the mean",
    },
    range: [0.01, 100.0],
    is_whole: false,
    unset: Unset::Is(1.0),
};
pub(crate) const TUBE: Number = Number {
    info: SettingInfo {
        key: "tube",
        accepts: "a number from 1e-6 to 0.5",
        default: "0.01",
        about: "greatest error without cost, as a share of the range of labels",
    },
    range: [1e-6, 0.5],
    is_whole: false,
    unset: Unset::Is(0.01),
};
