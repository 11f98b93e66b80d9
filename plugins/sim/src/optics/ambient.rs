//! Ambient light, which a transparent gel admits.

use std::fmt;

/// A scene of ambient light, as in the paper.
///
/// # Reference
/// TacEva (2025), robustness to lighting, scenes S1 to S4.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum AmbientLight {
    /// Light of the sensor only, as in calibration.
    #[default]
    Normal,
    /// Scene S1: diffuse light from the ceiling.
    Ceiling,
    /// Scene S2: a wide beam from the side.
    WideBeam,
    /// Scene S3: a ring of light below the sensor.
    Ring,
    /// Scene S4: a narrow spot of light.
    Spot,
}

impl AmbientLight {
    /// All scenes, the normal scene first.
    pub const ALL: [AmbientLight; 5] = [
        AmbientLight::Normal,
        AmbientLight::Ceiling,
        AmbientLight::WideBeam,
        AmbientLight::Ring,
        AmbientLight::Spot,
    ];

    /// Name of the scene in tables of results.
    pub const fn name(self) -> &'static str {
        match self {
            AmbientLight::Normal => "normal",
            AmbientLight::Ceiling => "S1",
            AmbientLight::WideBeam => "S2",
            AmbientLight::Ring => "S3",
            AmbientLight::Spot => "S4",
        }
    }

    /// Finds a scene by its name; `None` for an unknown name.
    pub fn from_name(name: &str) -> Option<AmbientLight> {
        AmbientLight::ALL
            .into_iter()
            .find(|scene| scene.name() == name)
    }
}

impl fmt::Display for AmbientLight {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_scene_is_found_by_its_name() {
        for scene in AmbientLight::ALL {
            assert_eq!(AmbientLight::from_name(scene.name()), Some(scene));
        }
        assert_eq!(AmbientLight::from_name("s1"), None);
    }
}
