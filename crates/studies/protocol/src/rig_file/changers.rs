//! What changes things on a rig instead of hands: the table `[changers]` of a rig file.

use std::time::Duration;

use serde::Deserialize;

use crate::text::{SceneError, SceneProblem, Setting, Text};

/// How long a change may take where the file does not say, in s, and the longest that it may say.
const USUAL_CHANGE_S: f64 = 60.0;
const GREATEST_CHANGE_S: f64 = 3_600.0;

/// The devices of a rig that bring things into place; what none of them holds is changed by hand.
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
    /// The selector of the changer that mounts specimens on the robot.
    pub specimen: Option<Setting<String>>,
    /// The selector of the changer that puts units of the sensor under the robot.
    pub unit: Option<Setting<String>>,
    /// The selector of the lighting, in the place of the one that a scene names.
    pub light: Option<Setting<String>>,
    /// How long one change of a specimen or a unit may take.
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
    /// What it says, if its patience is one.
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
