//! Presets of the cameras in commercial sensors, by name.

use std::sync::LazyLock;

use serde::Deserialize;
use taceva_core::{ArgSpec, DriverKey};

use super::crop::Crop;

/// Known settings of the camera in one commercial sensor. The file of the preset cites the source of each number.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Preset {
    /// Name of the preset and stem of its file.
    #[serde(skip)]
    pub(super) name: &'static str,
    pub(super) title: String,
    /// Key of the driver that opens this camera.
    driver: String,
    /// First letters of the camera's name in the kernel; `None` for a network camera.
    pub(super) card: Option<String>,
    /// Pixel format, if the camera has only one; `None` otherwise.
    pub(super) pixels: Option<String>,
    /// Width and height of the camera's images, pixels.
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) rate_hz: f64,
    /// Fraction of the width and of the height that is cropped at each side.
    border: f64,
    /// True if the zoom control of the camera sets LEDs of the sensor.
    #[serde(default)]
    pub(super) leds: bool,
}

static PRESETS: LazyLock<Vec<Preset>> = LazyLock::new(|| {
    let written = [
        ("digit", include_str!("presets/digit.toml")),
        ("gelsight-mini", include_str!("presets/gelsight-mini.toml")),
        ("gelsight-r15", include_str!("presets/gelsight-r15.toml")),
    ];
    let read = |(name, text): (&'static str, &str)| {
        let preset =
            toml::from_str(text).expect("an embedded preset is valid TOML, as a test checks");
        Preset { name, ..preset }
    };
    written.into_iter().map(read).collect()
});

impl Preset {
    /// Presets whose cameras `driver` opens.
    pub(super) fn of(driver: &DriverKey) -> impl Iterator<Item = &'static Preset> {
        let driver = driver.to_string();
        PRESETS.iter().filter(move |preset| preset.driver == driver)
    }

    /// Preset with this `name` among the presets of `driver`; `None` if there is none.
    pub(super) fn named(driver: &DriverKey, name: &str) -> Option<&'static Preset> {
        Preset::of(driver).find(|preset| preset.name == name)
    }

    /// Driver argument that selects one of the presets of `driver`.
    pub(super) fn argument(driver: &DriverKey) -> ArgSpec {
        let titles: Vec<&str> = Preset::of(driver)
            .map(|preset| preset.title.as_str())
            .collect();
        ArgSpec::choice("preset", Preset::of(driver).map(|preset| preset.name))
            .optional()
            .help(&format!(
                "known settings of the camera in {}",
                titles.join(", ")
            ))
            .changes_facts()
    }

    /// Crop of this preset for a camera image of `width` by `height` pixels.
    pub(super) fn crop(&self, width: u32, height: u32) -> Crop {
        Crop::border(width, height, self.border)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_preset_is_of_a_driver_and_gives_pictures() {
        assert_eq!(PRESETS.len(), 3);
        for preset in PRESETS.iter() {
            let key: DriverKey = preset.driver.parse().expect("a key");
            assert_eq!(Preset::named(&key, preset.name), Some(preset));
            assert!(
                preset.rate_hz > 0.0 && (0.0..0.5).contains(&preset.border),
                "{preset:?}"
            );
            assert!(preset.width > 0 && preset.height > 0, "{preset:?}");
        }
    }
}
