//! Description of a driver, readable without opening its device.

mod source;

pub use source::DriverSource;

use std::collections::BTreeSet;
use std::fmt;

use super::device_facts::{ChangerFacts, Facts, ForceFacts, RobotFacts, SensorFacts};
use crate::args::{ArgError, ArgSpec, Args};
use crate::driver::DriverKind;
use crate::id::DriverKey;

/// Description of a driver before [`check`](DescriptorSpec::check) has looked for contradictions.
///
/// ```
/// use taceva_core::{ArgSpec, ArgValue, DescriptorSpec, DriverKey, DriverSource, Facts, SensorFacts};
/// let facts = Facts::Sensor(Box::new(SensorFacts::default()));
/// let spec = DescriptorSpec::new(DriverKey::fixed("org.example/digit"), "DIGIT", DriverSource::Real, facts);
/// let spec = spec.arguments([ArgSpec::whole("exposure", 1, 33).unit("ms").default(ArgValue::Whole(8))]);
/// let descriptor = spec.check()?;
/// assert_eq!(descriptor.arguments().len(), 1);
/// # Ok::<(), taceva_core::DescriptorError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct DescriptorSpec {
    /// Key by which users select the driver.
    pub key: DriverKey,
    /// Common name of the device, such as a product name.
    pub title: String,
    /// Origin of the readings: a real device, a simulation or a recording.
    pub source: DriverSource,
    /// Properties of the device, such as its rate and its limits.
    pub facts: Facts,
    /// Arguments that the driver accepts when it opens the device.
    pub arguments: Vec<ArgSpec>,
}

impl DescriptorSpec {
    /// Creates the description of a driver without arguments.
    pub fn new(
        key: DriverKey,
        title: impl Into<String>,
        source: DriverSource,
        facts: Facts,
    ) -> DescriptorSpec {
        DescriptorSpec {
            key,
            title: title.into(),
            source,
            facts,
            arguments: Vec::new(),
        }
    }

    /// Adds `arguments` to those that the driver accepts.
    #[must_use]
    pub fn arguments(mut self, arguments: impl IntoIterator<Item = ArgSpec>) -> DescriptorSpec {
        self.arguments.extend(arguments);
        self
    }

    /// Checks that all entries are possible and do not contradict each other.
    ///
    /// # Errors
    /// [`DescriptorError`] for the first contradiction.
    pub fn check(self) -> Result<Descriptor, DescriptorError> {
        let fault = self.arguments_fault().or_else(|| match &self.facts {
            Facts::Sensor(facts) => sensor_fault(facts),
            Facts::Robot(facts) => robot_fault(facts, self.source),
            Facts::Force(facts) => force_fault(facts),
            Facts::Lighting(facts) if facts.scenes.is_empty() => {
                Some("a lighting device without scenes, expected at least one".to_owned())
            }
            Facts::Lighting(facts) => scenes_fault(&facts.scenes),
            Facts::Changer(facts) => holds_fault(&facts.holds),
        });
        match fault {
            Some(problem) => Err(DescriptorError {
                key: self.key,
                problem,
            }),
            None => Ok(Descriptor { spec: self }),
        }
    }

    fn arguments_fault(&self) -> Option<String> {
        let mut keys = BTreeSet::new();
        self.arguments.iter().find_map(|spec| match spec.fault() {
            None if keys.insert(&spec.key) => None,
            None => Some(format!("argument `{}` is declared twice", spec.key)),
            fault => fault,
        })
    }
}

fn sensor_fault(facts: &SensorFacts) -> Option<String> {
    if facts.opaque == Some(true) && !facts.scenes.is_empty() {
        return Some(format!(
            "the gel is opaque, but the light around it can be set to `{}`",
            facts.scenes[0]
        ));
    }
    if let Some(frame) = facts
        .frame
        .filter(|frame| frame.byte_len().is_none_or(|len| len == 0))
    {
        return Some(format!(
            "a frame of {frame} is empty or too large for a buffer"
        ));
    }
    if let Some([width, height]) = facts.camera.filter(|sides| sides.contains(&0)) {
        return Some(format!(
            "a camera of {width}×{height} pixels, expected sides of at least 1"
        ));
    }
    let footprint = facts.footprint.and_then(|footprint| footprint.depth_max());
    let beyond = facts
        .depth_max
        .zip(footprint)
        .filter(|(limit, footprint)| limit.0 > footprint.to_millimetres());
    if let Some((limit, footprint)) = beyond {
        return Some(format!(
            "the depth limit of {limit} exceeds the depth of the footprint, {footprint}"
        ));
    }
    scenes_fault(&facts.scenes).or_else(|| {
        positive(&[
            ("rate", facts.rate.map(|rate| rate.0)),
            ("depth limit", facts.depth_max.map(|depth| depth.0)),
            ("force limit", facts.force_max.map(|force| force.0)),
            ("gel thickness", facts.gel_thickness.map(|height| height.0)),
            ("field of view", facts.field_of_view_mm2),
        ])
        .or_else(|| not_negative(&[("latency", facts.latency_ms)]))
    })
}

fn robot_fault(facts: &RobotFacts, source: DriverSource) -> Option<String> {
    if source == DriverSource::Recorded {
        return Some("a recorded robot cannot be moved".to_owned());
    }
    if let Some(workspace) = facts
        .workspace
        .filter(|workspace| !workspace.contains(&workspace.least))
    {
        return Some(format!("the workspace {workspace} is empty"));
    }
    not_negative(&[
        ("repeatability", facts.repeatability.map(|spread| spread.0)),
        ("noise of the pose", facts.pose_noise.map(|noise| noise.0)),
        ("time to stop", facts.stop_ms),
        ("latency", facts.latency_ms),
    ])
    .or_else(|| positive(&[("deceleration", facts.deceleration_mm_s2)]))
}

fn force_fault(facts: &ForceFacts) -> Option<String> {
    if facts.axes.is_empty() {
        return Some(
            "a force transducer that measures no component, expected at least one".to_owned(),
        );
    }
    positive(&[
        ("rate", facts.rate.map(|rate| rate.0)),
        ("greatest force", facts.force_max.map(|force| force.0)),
        ("resolution", facts.resolution.map(|step| step.0)),
    ])
    .or_else(|| {
        not_negative(&[
            ("noise", facts.noise.map(|noise| noise.0)),
            ("latency", facts.latency_ms),
        ])
    })
}

fn scenes_fault(scenes: &[String]) -> Option<String> {
    let mut seen = BTreeSet::new();
    scenes
        .iter()
        .find(|scene| scene.is_empty() || !seen.insert(*scene))
        .map(|scene| format!("the scene {scene:?} is empty or named twice"))
}

fn holds_fault(holds: &[String]) -> Option<String> {
    let mut seen = BTreeSet::new();
    holds
        .iter()
        .find(|name| name.is_empty() || !seen.insert(*name))
        .map(|name| format!("the name {name:?} in `holds` is empty or listed twice"))
}

fn positive(named: &[(&str, Option<f64>)]) -> Option<String> {
    named.iter().find_map(|&(name, value)| {
        value
            .filter(|value| !(*value > 0.0 && value.is_finite()))
            .map(|value| format!("a {name} of {value}, expected a number above 0"))
    })
}

fn not_negative(named: &[(&str, Option<f64>)]) -> Option<String> {
    named.iter().find_map(|&(name, value)| {
        value
            .filter(|value| !(*value >= 0.0 && value.is_finite()))
            .map(|value| format!("a {name} of {value}, expected 0 or more"))
    })
}

/// Checked description of a driver. Planning reads the description and does not open the device.
///
/// ```
/// use taceva_core::{DescriptorSpec, DriverKey, DriverSource, Facts, RobotFacts};
/// let facts = Facts::Robot(RobotFacts::default());
/// let spec = DescriptorSpec::new(DriverKey::fixed("org.example/arm"), "an arm", DriverSource::Real, facts);
/// let descriptor = spec.check()?;
/// assert!(descriptor.robot().is_some() && descriptor.sensor().is_none());
/// # Ok::<(), taceva_core::DescriptorError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Descriptor {
    spec: DescriptorSpec,
}

impl Descriptor {
    /// Key by which users select the driver.
    pub fn key(&self) -> &DriverKey {
        &self.spec.key
    }

    /// Common name of the device, such as a product name.
    pub fn title(&self) -> &str {
        &self.spec.title
    }

    /// Kind of device that the driver opens.
    pub fn kind(&self) -> DriverKind {
        self.spec.facts.kind()
    }

    /// Origin of the readings: a real device, a simulation or a recording.
    pub fn source(&self) -> DriverSource {
        self.spec.source
    }

    /// Properties of the device, such as its rate and its limits.
    pub fn facts(&self) -> &Facts {
        &self.spec.facts
    }

    /// Properties of the sensor; `None` if the driver opens another kind of device.
    pub fn sensor(&self) -> Option<&SensorFacts> {
        match self.facts() {
            Facts::Sensor(facts) => Some(facts),
            _ => None,
        }
    }

    /// Properties of the robot; `None` if the driver opens another kind of device.
    pub fn robot(&self) -> Option<&RobotFacts> {
        match self.facts() {
            Facts::Robot(facts) => Some(facts),
            _ => None,
        }
    }

    /// Properties of the force transducer; `None` if the driver opens another kind of device.
    pub fn force(&self) -> Option<&ForceFacts> {
        match self.facts() {
            Facts::Force(facts) => Some(facts),
            _ => None,
        }
    }

    /// Properties of the changer; `None` if the driver opens another kind of device.
    pub fn changer(&self) -> Option<&ChangerFacts> {
        match self.facts() {
            Facts::Changer(facts) => Some(facts),
            _ => None,
        }
    }

    /// Arguments that the driver accepts when it opens the device.
    pub fn arguments(&self) -> &[ArgSpec] {
        &self.spec.arguments
    }

    /// Parses `text` as arguments of this driver and checks their values.
    ///
    /// # Errors
    /// The errors of [`Args::parse`].
    pub fn args(&self, text: &str) -> Result<Args, ArgError> {
        Args::parse(self.arguments(), text)
    }

    /// Returns an editable copy of the description, which must be checked again.
    pub fn to_spec(&self) -> DescriptorSpec {
        self.spec.clone()
    }
}

/// Error for a driver whose description has contradictory entries. The cause is a bug in the driver.
///
/// ```
/// use taceva_core::{DescriptorSpec, DriverKey, DriverSource, Facts, LightingFacts};
/// let facts = Facts::Lighting(LightingFacts::default());
/// let spec = DescriptorSpec::new(DriverKey::fixed("room/lamp"), "a lamp", DriverSource::Real, facts);
/// let error = spec.check().unwrap_err();
/// assert_eq!(error.to_string(), "the driver `room/lamp` contradicts itself: a lighting device without scenes, expected at least one");
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DescriptorError {
    key: DriverKey,
    problem: String,
}

impl fmt::Display for DescriptorError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "the driver `{}` contradicts itself: {}",
            self.key, self.problem
        )
    }
}

impl std::error::Error for DescriptorError {}

#[cfg(test)]
mod tests;
