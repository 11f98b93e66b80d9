//! A rig file: which drivers reach the devices of a rig, how these stand to one another, and what they may not pass.

mod axes;
mod changers;
mod latency;
mod registration;
mod teach;

pub use axes::SignedAxes;
pub use changers::RigChangers;
pub use latency::{Latency, RigLatencies};
pub use registration::Registration;
pub use teach::{Jogged, Taught, TeachError};

use serde::Deserialize;

use changers::WrittenChangers;

use crate::content_id::ContentId;
use crate::limit_spec::LimitSpec;
use crate::text::{SceneError, SceneProblem, Setting, Text};

/// The greatest coordinate of an origin, in mm.
const GREATEST_PLACE_MM: f64 = 10_000.0;
/// How long a run waits for somebody to hold the enabling switch where the file does not say, in s, and the longest that it may say.
const USUAL_PATIENCE_S: f64 = 60.0;
const GREATEST_PATIENCE_S: f64 = 86_400.0;
/// The greatest latency that is believed, in ms.
const GREATEST_LATENCY_MS: f64 = 1_000.0;
/// The greatest limit that is written, as in a scene, in mm, N or mm/s.
const GREATEST_LIMIT: f64 = 1_000.0;

/// A rig as a TOML text says it: where a scene is carried out, and not what is done there.
///
/// ```
/// use taceva_protocol::RigFile;
/// let text = r#"
/// rig_version = 1
/// [robot]
/// driver = "ufactory/xarm:host=192.168.1.200"
/// carries = "indenter"
/// origin_mm = [300.0, 0.0, 251.3]
/// axes = ["x", "y", "-z"]
/// "#;
/// let error = RigFile::parse("lab.toml", text).unwrap_err();
/// assert!(error.to_string().starts_with("lab.toml, line 7: `axes` are left-handed"));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct RigFile {
    /// Whether what answers is emulated, so that nothing that is recorded there was measured.
    pub simulated: bool,
    /// The robot.
    pub robot: Option<RigRobot>,
    /// The force transducer.
    pub force: Option<RigForce>,
    /// The sensor.
    pub sensor: Option<RigSensor>,
    /// The enabling switch and whoever holds it, where the rig has one.
    pub operator: Option<RigOperator>,
    /// What changes things there instead of hands.
    pub changers: RigChangers,
    /// Limits of the rig, which only tighten those of its devices.
    pub limits: LimitSpec,
    pub(crate) text: Text,
}

/// A robot and how it stands to the sensor.
#[derive(Clone, Debug, PartialEq)]
pub struct RigRobot {
    /// The selector of its driver.
    pub driver: Setting<String>,
    /// What it moves.
    pub carries: Carried,
    /// Where it stands in its base frame when the tip is at the middle of the untouched gel, in mm.
    pub origin_mm: Setting<[f64; 3]>,
    /// Which axis of the base each axis of the sensor is.
    pub axes: Setting<SignedAxes>,
    /// How its tool is turned in the base frame when the tip counts as not turned: about x, y and z, in degrees. Where it is not written, as
    /// it stands when it is opened.
    pub turned_deg: Option<[f64; 3]>,
    /// How long after it was true a pose is stamped, in ms; what its driver states where it is not written.
    pub latency_ms: Option<Setting<f64>>,
}

/// What a robot moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Carried {
    /// The indenter, over a sensor that rests.
    Indenter,
    /// The sensor, over an indenter that rests.
    Sensor,
}

/// A force transducer and how it stands to the sensor.
#[derive(Clone, Debug, PartialEq)]
pub struct RigForce {
    /// The selector of its driver.
    pub driver: Setting<String>,
    /// Which of its axes each axis of the sensor is: Fz above 0 presses into the gel.
    pub axes: Setting<SignedAxes>,
    /// How long after it was true a reading is stamped, in ms; what its driver states where it is not written.
    pub latency_ms: Option<Setting<f64>>,
}

/// A sensor of a rig.
#[derive(Clone, Debug, PartialEq)]
pub struct RigSensor {
    /// The selector of its driver.
    pub driver: Setting<String>,
    /// How long after it was true a frame is stamped, in ms; what its driver states where it is not written.
    pub latency_ms: Option<Setting<f64>>,
}

/// The person at a rig, and what that person holds.
#[derive(Clone, Debug, PartialEq)]
pub struct RigOperator {
    /// The selector of the enabling switch: released, the robot is halted.
    pub enable: Setting<String>,
    /// How long a run waits for somebody to hold it, in s.
    pub patience_s: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a rig file")]
struct WrittenRig {
    rig_version: Setting<u32>,
    #[serde(default)]
    simulated: bool,
    robot: Option<WrittenRobot>,
    force: Option<WrittenForce>,
    sensor: Option<WrittenSensor>,
    operator: Option<WrittenOperator>,
    #[serde(default)]
    changers: WrittenChangers,
    #[serde(default)]
    limits: LimitSpec,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table with `driver`")]
struct WrittenRobot {
    driver: Setting<String>,
    carries: Carried,
    origin_mm: Setting<[f64; 3]>,
    axes: Setting<[String; 3]>,
    turned_deg: Option<Setting<[f64; 3]>>,
    latency_ms: Option<Setting<f64>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table with `driver`")]
struct WrittenForce {
    driver: Setting<String>,
    axes: Setting<[String; 3]>,
    latency_ms: Option<Setting<f64>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table with `driver`")]
struct WrittenSensor {
    driver: Setting<String>,
    latency_ms: Option<Setting<f64>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table with `enable`")]
struct WrittenOperator {
    enable: Setting<String>,
    patience_s: Option<Setting<f64>>,
}

impl RigFile {
    /// The rig that `text` says; `source_name` is what errors call it.
    ///
    /// # Errors
    /// [`SceneError`] with the line: no TOML, an unknown key with the nearest known one, axes that are no right-handed frame, a place or
    /// a latency that is none, a limit that is none.
    pub fn parse(source_name: &str, text: &str) -> Result<RigFile, SceneError> {
        let text = Text::new(source_name, text)?;
        let written: WrittenRig = text.read()?;
        let check = Check { text: &text };
        check.version(&written.rig_version)?;
        let operator = written
            .operator
            .map(|operator| check.operator(operator))
            .transpose()?;
        let changers = written.changers.check(&text)?;
        check.limits(&written.limits)?;
        let robot = written.robot.map(|robot| check.robot(robot)).transpose()?;
        let force = written.force.map(|force| check.force(force)).transpose()?;
        let sensor = match written.sensor {
            Some(WrittenSensor { driver, latency_ms }) => Some(RigSensor {
                driver,
                latency_ms: check.latency(latency_ms)?,
            }),
            None => None,
        };
        Ok(RigFile {
            simulated: written.simulated,
            robot,
            force,
            sensor,
            operator,
            changers,
            limits: written.limits,
            text,
        })
    }

    /// The name by which errors call it.
    pub fn name(&self) -> &str {
        self.text.source_name()
    }

    /// The digest of its text: a file with another text counts as another rig.
    pub fn digest(&self) -> ContentId {
        ContentId::of_text(self.text.whole())
    }

    /// How long a run waits for somebody to hold the enabling switch, in s; nothing is waited for where there is none.
    pub fn patience_s(&self) -> f64 {
        let operator = self.operator.as_ref();
        operator.map_or(0.0, |operator| operator.patience_s)
    }

    /// `problem`, at the byte `at` of it.
    pub fn error(&self, at: Option<usize>, problem: SceneProblem) -> SceneError {
        self.text.error(at, problem)
    }
}

struct Check<'a> {
    text: &'a Text,
}

impl Check<'_> {
    fn refuse<T>(&self, at: Option<usize>, problem: String) -> Result<T, SceneError> {
        Err(self.text.error(at, SceneProblem::Contradiction(problem)))
    }

    fn version(&self, version: &Setting<u32>) -> Result<(), SceneError> {
        match version.value {
            1 => Ok(()),
            other => Err(self
                .text
                .error(version.at(), SceneProblem::RigVersion(other))),
        }
    }

    fn operator(&self, operator: WrittenOperator) -> Result<RigOperator, SceneError> {
        let WrittenOperator { enable, patience_s } = operator;
        if let Some(patience) = &patience_s
            && !(patience.value > 0.0 && patience.value <= GREATEST_PATIENCE_S)
        {
            let problem = SceneProblem::Range {
                key: "patience_s",
                found: patience.value,
                above: 0.0,
                greatest: GREATEST_PATIENCE_S,
            };
            return Err(self.text.error(patience.at(), problem));
        }
        let patience_s = patience_s.map_or(USUAL_PATIENCE_S, |patience| patience.value);
        Ok(RigOperator { enable, patience_s })
    }

    fn limits(&self, limits: &LimitSpec) -> Result<(), SceneError> {
        for (key, limit) in limits.named() {
            if let Some(limit) = limit
                && !(limit.value > 0.0 && limit.value <= GREATEST_LIMIT)
            {
                let problem = SceneProblem::Range {
                    key,
                    found: limit.value,
                    above: 0.0,
                    greatest: GREATEST_LIMIT,
                };
                return Err(self.text.error(limit.at(), problem));
            }
        }
        Ok(())
    }

    fn robot(&self, robot: WrittenRobot) -> Result<RigRobot, SceneError> {
        let WrittenRobot {
            driver,
            carries,
            origin_mm,
            axes,
            turned_deg,
            latency_ms,
        } = robot;
        self.within("origin_mm", "mm", &origin_mm, GREATEST_PLACE_MM)?;
        if let Some(turned) = &turned_deg {
            self.within("turned_deg", "degrees", turned, 360.0)?;
        }
        Ok(RigRobot {
            driver,
            carries,
            origin_mm,
            axes: self.axes(axes)?,
            turned_deg: turned_deg.map(|turned| turned.value),
            latency_ms: self.latency(latency_ms)?,
        })
    }

    fn force(&self, force: WrittenForce) -> Result<RigForce, SceneError> {
        Ok(RigForce {
            driver: force.driver,
            axes: self.axes(force.axes)?,
            latency_ms: self.latency(force.latency_ms)?,
        })
    }

    fn axes(&self, axes: Setting<[String; 3]>) -> Result<Setting<SignedAxes>, SceneError> {
        let at = axes.at();
        match SignedAxes::read(axes.value.clone()) {
            Ok(read) => Ok(axes.map(|_| read)),
            Err(problem) => self.refuse(at, problem),
        }
    }

    fn within(
        &self,
        key: &str,
        unit: &str,
        numbers: &Setting<[f64; 3]>,
        greatest: f64,
    ) -> Result<(), SceneError> {
        // NaN is in no range.
        let is_inside = |number: &f64| (-greatest..=greatest).contains(number);
        match numbers.value.iter().find(|number| !is_inside(number)) {
            None => Ok(()),
            Some(found) => self.refuse(
                numbers.at(),
                format!("`{key}` holds {found}, expected three numbers from -{greatest} to {greatest} {unit}"),
            ),
        }
    }

    fn latency(&self, latency: Option<Setting<f64>>) -> Result<Option<Setting<f64>>, SceneError> {
        let Some(written) = latency else {
            return Ok(None);
        };
        let found = written.value;
        if (0.0..=GREATEST_LATENCY_MS).contains(&found) {
            return Ok(latency);
        }
        self.refuse(
            written.at(),
            format!("`latency_ms` is {found}, expected 0 to {GREATEST_LATENCY_MS} ms"),
        )
    }
}
