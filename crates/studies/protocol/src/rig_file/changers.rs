//! Table `[changers]` of a rig file: devices that change specimen, unit and light.

use std::time::Duration;

use serde::Deserialize;

use crate::text::{SceneError, SceneProblem, Setting, Text};

/// Default time for a change of specimen or unit, in s.
const USUAL_CHANGE_S: f64 = 60.0;
/// Greatest accepted time for a change, in s.
const GREATEST_CHANGE_S: f64 = 3_600.0;

/// Changers of a rig. The operator makes changes for which there is no changer.
///
/// ```
/// use taceva_protocol::RigFile;
/// let text = r#"
/// rig_version = 1
/// [changers]
/// specimen = "org.example.carousel/carousel:port=/dev/ttyUSB0"
/// "#;
/// let rig = RigFile::parse("lab.toml", text)?;
/// assert!(rig.changers.specimen.is_some() && rig.changers.unit.is_none());
/// assert_eq!(rig.changers.patience.as_secs(), 60);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct RigChangers {
    /// Selector of the driver of the changer that mounts specimens on the robot, if any.
    pub specimen: Option<Setting<String>>,
    /// Selector of the driver of the changer that places sensor units under the robot, if any.
    pub unit: Option<Setting<String>>,
    /// Selector of the driver of the lighting, if any. This lighting replaces the lighting of the scene.
    pub light: Option<Setting<String>>,
    /// Longest time to wait for a change of specimen or unit.
    pub patience: Duration,
}

impl Default for RigChangers {
    fn default() -> RigChangers {
        RigChangers {
            specimen: None,
            unit: None,
            light: None,
            patience: Duration::from_secs_f64(USUAL_CHANGE_S),
        }
    }
}

#[derive(Default, Deserialize)]
#[serde(
    deny_unknown_fields,
    expecting = "a table with `specimen`, `unit` or `light`"
)]
pub(super) struct WrittenChangers {
    specimen: Option<Setting<String>>,
    unit: Option<Setting<String>>,
    light: Option<Setting<String>>,
    patience_s: Option<Setting<f64>>,
}

impl WrittenChangers {
    /// Checks the range of `patience_s`.
    pub(super) fn check(self, text: &Text) -> Result<RigChangers, SceneError> {
        let patience_s = match self.patience_s {
            None => USUAL_CHANGE_S,
            Some(patience) if patience.value > 0.0 && patience.value <= GREATEST_CHANGE_S => {
                patience.value
            }
            Some(patience) => {
                let problem = SceneProblem::Range {
                    key: "patience_s",
                    found: patience.value,
                    above: 0.0,
                    greatest: GREATEST_CHANGE_S,
                };
                return Err(text.error(patience.at(), problem));
            }
        };
        Ok(RigChangers {
            specimen: self.specimen,
            unit: self.unit,
            light: self.light,
            patience: Duration::from_secs_f64(patience_s),
        })
    }
}
