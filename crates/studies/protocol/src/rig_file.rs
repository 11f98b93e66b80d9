//! Rig file: drivers, mounting and limits of the devices of a rig.

mod axes;
mod certificate;
mod changers;
mod latency;
mod operator;
mod registration;
mod sensor;
mod teach;
mod weighing;

pub(crate) use axes::Along;
pub use axes::SignedAxes;
pub use changers::RigChangers;
pub use latency::{Latency, RigLatencies};
pub use operator::RigOperator;
pub use registration::Registration;
pub use sensor::RigSensor;
pub use teach::{Jogged, Taught, TeachError};
pub use weighing::Weighing;

use serde::Deserialize;
use taceva_core::{Certificate, Instrument};

use certificate::WrittenCertificate;
use changers::WrittenChangers;
use latency::{LATENCY, UNCERTAINTY};
use operator::WrittenOperator;
use sensor::WrittenSensor;

use crate::content_id::ContentId;
use crate::limit_spec::LimitSpec;
use crate::text::{SceneError, SceneProblem, Setting, Text};

/// Greatest coordinate of `origin_mm`, in mm.
const GREATEST_PLACE_MM: f64 = 10_000.0;
/// Greatest accepted latency, in ms.
const GREATEST_LATENCY_MS: f64 = 1_000.0;
/// Greatest accepted limit, in the unit of the limit: mm, N or mm/s. Scenes have the same bound.
const GREATEST_LIMIT: f64 = 1_000.0;

/// Rig for scenes, parsed from TOML.
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
    /// True if the devices are emulated, so that recordings are not measurements.
    pub simulated: bool,
    /// Laboratory of the rig, if stated.
    pub laboratory: Option<String>,
    /// Name of the person who operates the rig, if stated.
    pub operator_name: Option<String>,
    /// Robot of the rig, if any.
    pub robot: Option<RigRobot>,
    /// Force transducer of the rig, if any.
    pub force: Option<RigForce>,
    /// Sensor of the rig, if any.
    pub sensor: Option<RigSensor>,
    /// Enabling switch, if any.
    pub operator: Option<RigOperator>,
    /// Devices that change specimen, unit or light automatically.
    pub changers: RigChangers,
    /// Limits of the rig, which may only tighten the limits of its devices.
    pub limits: LimitSpec,
    pub(crate) text: Text,
}

/// A robot and its mounting relative to the sensor.
#[derive(Clone, Debug, PartialEq)]
pub struct RigRobot {
    /// Text that selects the driver, such as `ufactory/xarm:host=192.168.1.200`.
    pub driver: Setting<String>,
    /// Body that the robot moves.
    pub carries: Carried,
    /// Position of the tip when it touches the middle of the untouched gel, in the base frame of the robot, in mm.
    pub origin_mm: Setting<[f64; 3]>,
    /// Axes of the robot base that correspond to the axes of the sensor.
    pub axes: Setting<SignedAxes>,
    /// Rotation of the tool about x, y and z of the base frame with the specimen not turned, in degrees. `None` uses that at opening of the robot.
    pub turned_deg: Option<[f64; 3]>,
    /// Delay between a pose and its stamp, in ms; `None` uses the latency that the driver states.
    pub latency_ms: Option<Setting<f64>>,
    /// Calibration certificate, if any.
    pub certificate: Option<Certificate>,
}

/// Body that a robot moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Carried {
    /// Indenter, above a resting sensor.
    Indenter,
    /// Sensor, above a resting indenter.
    Sensor,
}

/// A force transducer and its mounting relative to the sensor.
#[derive(Clone, Debug, PartialEq)]
pub struct RigForce {
    /// Text that selects the driver of the transducer.
    pub driver: Setting<String>,
    /// Axes of the transducer that correspond to the axes of the sensor. A positive Fz presses into the gel.
    pub axes: Setting<SignedAxes>,
    /// Delay between a reading and its stamp, in ms; `None` uses the latency that the driver states.
    pub latency_ms: Option<Setting<f64>>,
    /// Standard uncertainty of `latency_ms`, in ms, measured by taps; `None` if unknown.
    pub latency_u_ms: Option<Setting<f64>>,
    /// Greatest change of the zero force during a press, along any axis, in N. `None` for 5 times the least force that counts as contact.
    pub zero_step_max_n: Option<f64>,
    /// Last comparison with a known weight, if any.
    pub weighing: Option<Setting<Weighing>>,
    /// Calibration certificate, if any.
    pub certificate: Option<Certificate>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a rig file")]
struct WrittenRig {
    rig_version: Setting<u32>,
    #[serde(default)]
    simulated: bool,
    laboratory: Option<Setting<String>>,
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
    certificate: Option<WrittenCertificate>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table with `driver`")]
struct WrittenForce {
    driver: Setting<String>,
    axes: Setting<[String; 3]>,
    latency_ms: Option<Setting<f64>>,
    latency_u_ms: Option<Setting<f64>>,
    #[serde(rename = "zero_step_max_N")]
    zero_step_max_n: Option<Setting<f64>>,
    weighing: Option<Setting<Weighing>>,
    certificate: Option<WrittenCertificate>,
}

impl RigFile {
    /// Parses the rig file `text`; `source_name` is its name in errors.
    ///
    /// # Errors
    /// [`SceneError`] with the line:
    ///
    /// - invalid TOML, or an unknown key, with the most similar known key;
    /// - axes that form no right-handed frame;
    /// - a certificate of another instrument, or a certificate that contradicts itself;
    /// - an `[operator]` without switch and name;
    /// - a place, latency, patience or limit out of range.
    pub fn parse(source_name: &str, text: &str) -> Result<RigFile, SceneError> {
        let text = Text::new(source_name, text)?;
        let written: WrittenRig = text.read()?;
        let check = Check { text: &text };
        check.version(&written.rig_version)?;
        let laboratory = check.name("laboratory", written.laboratory)?;
        let mut person = written.operator;
        let operator_name = person.as_mut().and_then(|person| person.name.take());
        let operator_name = check.name("name", operator_name)?;
        let switch = person.map(|person| person.switch(&check, operator_name.is_some()));
        let operator = switch.transpose()?.flatten();
        let changers = written.changers.check(&text)?;
        check.limits(&written.limits)?;
        let robot = written.robot.map(|robot| check.robot(robot)).transpose()?;
        let force = written.force.map(|force| check.force(force)).transpose()?;
        let sensor = written.sensor;
        let sensor = sensor.map(|sensor| sensor.check(&check)).transpose()?;
        Ok(RigFile {
            simulated: written.simulated,
            laboratory,
            operator_name,
            robot,
            force,
            sensor,
            operator,
            changers,
            limits: written.limits,
            text,
        })
    }

    /// Name of the file in errors.
    pub fn name(&self) -> &str {
        self.text.source_name()
    }

    /// Digest of the text. A changed file counts as a different rig.
    pub fn digest(&self) -> ContentId {
        ContentId::of_text(self.text.whole())
    }

    /// Time to wait for a person to hold the enabling switch, in s; 0 without a switch.
    pub fn patience_s(&self) -> f64 {
        let operator = self.operator.as_ref();
        operator.map_or(0.0, |operator| operator.patience_s)
    }

    /// Error for `problem` at the byte offset `at` of the file.
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

    /// Name of a person or a laboratory, if written. Rejects an empty name.
    fn name(&self, key: &str, name: Option<Setting<String>>) -> Result<Option<String>, SceneError> {
        match name {
            Some(name) if name.value.trim().is_empty() => {
                self.refuse(name.at(), format!("`{key}` is empty, expected a name"))
            }
            name => Ok(name.map(|name| name.value)),
        }
    }

    fn limits(&self, limits: &LimitSpec) -> Result<(), SceneError> {
        let mut named = limits.named().into_iter();
        named.try_for_each(|(key, limit)| self.limit(key, limit))
    }

    fn limit(&self, key: &'static str, limit: Option<Setting<f64>>) -> Result<(), SceneError> {
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
            certificate,
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
            latency_ms: self.latency(LATENCY, latency_ms)?,
            certificate: self.certificate(Instrument::Robot, certificate)?,
        })
    }

    fn force(&self, force: WrittenForce) -> Result<RigForce, SceneError> {
        self.limit("zero_step_max_N", force.zero_step_max_n)?;
        Ok(RigForce {
            driver: force.driver,
            axes: self.axes(force.axes)?,
            latency_ms: self.latency(LATENCY, force.latency_ms)?,
            latency_u_ms: self.latency(UNCERTAINTY, force.latency_u_ms)?,
            zero_step_max_n: force.zero_step_max_n.map(|step| step.value),
            weighing: self.weighing(force.weighing)?,
            certificate: self.certificate(Instrument::Force, force.certificate)?,
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
        // NaN is outside every range.
        let is_inside = |number: &f64| (-greatest..=greatest).contains(number);
        match numbers.value.iter().find(|number| !is_inside(number)) {
            None => Ok(()),
            Some(found) => self.refuse(
                numbers.at(),
                format!("`{key}` is {found}, expected three numbers from -{greatest} to {greatest} {unit}"),
            ),
        }
    }

    fn latency(
        &self,
        key: &str,
        latency: Option<Setting<f64>>,
    ) -> Result<Option<Setting<f64>>, SceneError> {
        let Some(written) = latency else {
            return Ok(None);
        };
        let found = written.value;
        if (0.0..=GREATEST_LATENCY_MS).contains(&found) {
            return Ok(latency);
        }
        self.refuse(
            written.at(),
            format!("`{key}` is {found}, expected 0 to {GREATEST_LATENCY_MS} ms"),
        )
    }
}
