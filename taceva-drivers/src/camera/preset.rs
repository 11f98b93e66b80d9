//! What is known of the camera in a sensor that people can buy, by name.

use std::sync::LazyLock;

use serde::Deserialize;
use taceva_core::{ArgSpec, DriverKey};

use super::crop::Crop;

/// The camera of one sensor; each number has its source in the file of the preset.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Preset {
    /// The name by which it is chosen: that of its file.
    #[serde(skip)]
    pub(super) name: &'static str,
    pub(super) title: String,
    /// The key of the driver that reads it.
    driver: String,
    /// How the kernel's name of the camera begins, where it is one of this machine.
    pub(super) card: Option<String>,
    /// How its pictures are sent, where it is one way.
    pub(super) pixels: Option<String>,
    /// Of the pictures that the camera sends.
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) rate_hz: f64,
    /// The shares of width and height that are cut off at each side.
    border: f64,
}

static PRESETS: LazyLock<Vec<Preset>> = LazyLock::new(|| {
    let written = [
        ("digit", include_str!("presets/digit.toml")),
        ("gelsight-mini", include_str!("presets/gelsight-mini.toml")),
        ("gelsight-r15", include_str!("presets/gelsight-r15.toml")),
    ];
    let read = |(name, text): (&'static str, &str)| {
        let preset =
            toml::from_str(text).expect("a preset is a part of the program, which its test reads");
        Preset { name, ..preset }
    };
    written.into_iter().map(read).collect()
});

impl Preset {
    /// The presets of `driver`.
    pub(super) fn of(driver: &DriverKey) -> impl Iterator<Item = &'static Preset> {
        let driver = driver.to_string();
        PRESETS.iter().filter(move |preset| preset.driver == driver)
    }

    /// The preset of `driver` that is called `name`.
    pub(super) fn named(driver: &DriverKey, name: &str) -> Option<&'static Preset> {
        Preset::of(driver).find(|preset| preset.name == name)
    }

    /// The argument that chooses one.
    pub(super) fn argument(driver: &DriverKey) -> ArgSpec {
        let titles: Vec<&str> = Preset::of(driver)
            .map(|preset| preset.title.as_str())
            .collect();
        ArgSpec::choice("preset", Preset::of(driver).map(|preset| preset.name))
            .optional()
            .help(&format!(
                "what is known of the camera in {}",
                titles.join(", ")
            ))
            .changes_facts()
    }

    /// What is cut off its pictures, where the camera sends them in this size.
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
