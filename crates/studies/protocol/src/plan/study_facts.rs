//! Facts of a study before it begins, joined from scene and descriptors and checked for contradictions.

mod gel;
mod surface;
mod wear;

use taceva_core::{
    Axes, Axis, Channel, Descriptor, DriverSource, Field, FieldSet, Footprint, FrameInfo,
    Nanometre, SkipReason,
};
use taceva_metrics::Fact;

use super::collect::{CHANNELS, SURFACE};
use crate::frame_size::FrameSize;
use crate::limits::{RigLimits, limits};
use crate::phase::PhaseInputs;
use crate::phase_kind::PhaseKind;
use crate::scene::{Scene, Study, phase_of_task};
use crate::source::{RecordingInfo, RigInfo, SourceInfo};
use crate::text::{SceneError, SceneProblem};

/// Kind of model that a study uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ModelChoice {
    None,
    Finished,
    Estimator,
}

/// Source of the sample fields.
#[derive(Clone, Debug)]
pub(crate) enum FieldSource {
    Rig {
        sensor: bool,
        robot: bool,
        force: Option<Axes>,
    },
    Recording {
        fields: FieldSet,
        channels: Vec<String>,
    },
}

/// Facts that the passes read.
#[derive(Clone, Debug)]
pub(crate) struct StudyFacts<'a> {
    pub(crate) field_source: FieldSource,
    pub(crate) opaque: Option<bool>,
    pub(crate) markers: Option<bool>,
    pub(crate) model: ModelChoice,
    /// Number of folds of a cross-validation by contact points; `None` without folds.
    pub(crate) folds: Option<u32>,
    pub(crate) units: Vec<String>,
    pub(crate) lights: Vec<String>,
    /// Requested metrics; `None` for all.
    pub(crate) wanted: Option<Vec<&'static str>>,
    /// Inputs of the phases from which presses are drawn; `None` if the study makes no presses.
    pub(crate) phase_inputs: Option<PhaseInputs<'a>>,
    pub(crate) limits: Option<RigLimits>,
    pub(crate) frame: Option<FrameInfo>,
    /// Size of stored frames; `None` stores full frames.
    pub(crate) kept_frames: Option<FrameSize>,
    pub(crate) footprint: Option<Footprint>,
    /// Frame rate, in frames per second; `None` if unknown.
    pub(crate) frame_rate: Option<f64>,
}

impl StudyFacts<'_> {
    /// Channels that the source might measure.
    pub(crate) fn all_channels(&self) -> Vec<String> {
        match &self.field_source {
            FieldSource::Rig { .. } => CHANNELS.map(str::to_owned).to_vec(),
            FieldSource::Recording { channels, .. } => channels.clone(),
        }
    }

    /// Channels that presses of phase `kind` can measure. The surface map measures a height, and other phases measure a depth.
    pub(crate) fn channels_on(&self, kind: PhaseKind) -> Vec<String> {
        let mut channels = self.all_channels();
        if !self.is_recording() {
            let foreign = if kind == PhaseKind::SurfaceMap {
                "Pz"
            } else {
                SURFACE
            };
            channels.retain(|name| name != foreign);
        }
        channels
    }

    /// Reason why `fact` is unknown; `None` if the fact is known.
    pub(crate) fn absent(&self, fact: Fact) -> Option<SkipReason> {
        let depth_max = self.footprint.and_then(|footprint| footprint.depth_max());
        let (known, name) = match fact {
            Fact::NotOpaque => {
                return (self.opaque == Some(true)).then_some(SkipReason::GelIsOpaque);
            }
            Fact::Footprint => (self.footprint.is_some(), "footprint"),
            Fact::DepthMax => (self.limits.is_some() || depth_max.is_some(), "depth_max_mm"),
            Fact::FrameSize => (self.frame.is_some(), "frame_size"),
            // The metric itself checks facts of later catalogues when it is computed.
            _ => return None,
        };
        (!known).then_some(SkipReason::FactAbsent(name))
    }

    /// True if the source is a recording.
    pub(crate) fn is_recording(&self) -> bool {
        matches!(self.field_source, FieldSource::Recording { .. })
    }
}

/// Inputs from which the facts of `study` are collected.
pub(crate) struct Gather<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) study: &'a Study,
    pub(crate) source: &'a SourceInfo,
    pub(crate) units: &'a [String],
    pub(crate) lights: &'a [String],
}

impl<'a> Gather<'a> {
    pub(crate) fn facts(&self) -> Result<StudyFacts<'a>, SceneError> {
        match self.source {
            SourceInfo::Rig(rig) => self.of_rig(rig),
            SourceInfo::Recording(recording) => self.of_recording(recording),
        }
    }

    fn of_rig(&self, rig: &RigInfo) -> Result<StudyFacts<'a>, SceneError> {
        let (scene, study) = (self.scene, self.study);
        let sensor = rig.sensor.as_ref().and_then(Descriptor::sensor);
        let axes = rig.force.as_ref().and_then(Descriptor::force).map(|force| {
            match study.rig.as_ref().and_then(|rig| rig.force.as_ref()) {
                Some(mounted) => mounted.axes.value.measured(force.axes),
                None => force.axes,
            }
        });
        let opaque = self.opaque(sensor.and_then(|sensor| sensor.opaque))?;
        let markers = self.markers(sensor.and_then(|sensor| sensor.markers))?;
        let footprint = self.footprint(sensor.and_then(|sensor| sensor.footprint))?;
        let frame = sensor.and_then(|sensor| sensor.frame);
        self.is_mapped(rig)?;
        // Without a robot, nothing moves and no limits apply.
        let limits = match rig.robot {
            Some(_) => Some(limits(scene, study, rig)?),
            None => None,
        };
        let phase_inputs = match (&limits, footprint) {
            (Some(limits), Some(footprint)) => {
                self.depths(limits)?;
                self.workspace(rig, &footprint)?;
                self.wear(limits, &footprint, axes)?;
                Some(PhaseInputs {
                    protocol: &scene.protocol,
                    footprint,
                    depth_max: whole_nanometres_within(limits.depth_max.0),
                    units: self.units,
                    lights: self.lights,
                    markers: markers != Some(false),
                    seed: scene.seed,
                    stays_inside: !limits.simulated
                        && !study.rig.as_ref().is_some_and(|rig| rig.simulated),
                })
            }
            _ => None,
        };
        Ok(StudyFacts {
            field_source: FieldSource::Rig {
                sensor: rig.sensor.is_some(),
                robot: rig.robot.is_some(),
                force: axes,
            },
            opaque,
            markers,
            model: self.model(),
            folds: self.folds(scene.protocol.calibration.points.value)?,
            units: self.units.to_vec(),
            lights: self.lights.to_vec(),
            wanted: self.wanted(),
            phase_inputs,
            limits,
            frame,
            kept_frames: self.kept_frames(frame)?,
            footprint,
            frame_rate: sensor.and_then(|sensor| Some(sensor.rate?.0)),
        })
    }

    fn of_recording(&self, recording: &RecordingInfo) -> Result<StudyFacts<'a>, SceneError> {
        let opaque = self.opaque(recording.opaque)?;
        let named = recording.channels.iter().map(Channel::name);
        Ok(StudyFacts {
            field_source: FieldSource::Recording {
                fields: recording.fields,
                channels: named.map(str::to_owned).collect(),
            },
            opaque,
            markers: self.markers(None)?,
            model: self.model(),
            folds: self.folds(u32::MAX)?,
            units: Vec::new(),
            lights: Vec::new(),
            wanted: self.wanted(),
            phase_inputs: None,
            limits: None,
            frame: recording.frame,
            kept_frames: None,
            footprint: self.footprint(recording.footprint)?,
            frame_rate: None,
        })
    }

    /// Size of stored frames, if the scene states a size. Rejects a size greater than the frames of the sensor. If the sensor does not state its frame size,
    /// the check follows after the sensor is opened.
    fn kept_frames(&self, frame: Option<FrameInfo>) -> Result<Option<FrameSize>, SceneError> {
        let Some(kept) = self.study.frames else {
            return Ok(None);
        };
        match frame {
            Some(frame) if !kept.value.is_within(frame) => {
                let problem = SceneProblem::FramesEnlarged {
                    found: kept.value,
                    study: self.study.name.clone(),
                    frame,
                };
                Err(self.refusal(kept.at(), problem))
            }
            _ => Ok(Some(kept.value)),
        }
    }

    /// Rejects depths and thresholds of the protocol that exceed their limits.
    fn depths(&self, limits: &RigLimits) -> Result<(), SceneError> {
        let protocol = &self.scene.protocol;
        let shape = Some(("depth_min_mm", protocol.shape.depth_min_mm));
        let shape = shape.filter(|_| protocol.shape.presses.value > 0);
        let always = [
            ("depth_min_mm", protocol.calibration.depth_min_mm),
            ("depth_min_mm", protocol.spatial.depth_min_mm),
            ("depth_step_mm", protocol.repeatability.depth_step_mm),
            ("depth_step_mm", protocol.hysteresis.depth_step_mm),
        ];
        for (key, depth) in always.into_iter().chain(shape) {
            if depth.value > limits.depth_max.0 {
                let problem = SceneProblem::BeyondLimit {
                    key,
                    found: depth.value,
                    limit_key: "Pz_max_mm",
                    limit: limits.depth_max.0,
                    who: format!("study `{}`", self.study.name),
                };
                return Err(self.refusal(depth.at(), problem));
            }
        }
        let threshold = protocol.contact.threshold_n;
        if threshold.value >= limits.normal_max.0 {
            let problem = SceneProblem::BeyondLimit {
                key: "threshold_N",
                found: threshold.value,
                limit_key: "Fz_max_N",
                limit: limits.normal_max.0,
                who: format!("study `{}`", self.study.name),
            };
            return Err(self.refusal(threshold.at(), problem));
        }
        Ok(())
    }

    fn model(&self) -> ModelChoice {
        match &self.study.model {
            None => ModelChoice::None,
            Some(model) if model.file.is_some() => ModelChoice::Finished,
            Some(_) => ModelChoice::Estimator,
        }
    }

    /// Number of folds of the cross-validation that the scene asks for; `None` without folds. Rejects more folds than `points`.
    fn folds(&self, points: u32) -> Result<Option<u32>, SceneError> {
        let model = self.study.model.as_ref();
        let Some(folds) = model.and_then(|model| model.folds.as_ref()) else {
            return Ok(None);
        };
        if folds.value <= points {
            return Ok(Some(folds.value));
        }
        let problem = SceneProblem::Contradiction(format!(
            "`folds` is {}, but [protocol.calibration] presses {points} points and each fold tests at least one: expected 2 to {points}",
            folds.value
        ));
        Err(self.refusal(folds.at(), problem))
    }

    /// Ids of the requested metrics, without scores of tasks. Their names were checked during parsing.
    fn wanted(&self) -> Option<Vec<&'static str>> {
        let want = self.scene.metrics.want.as_ref()?;
        let names = want.iter().map(|name| name.value.as_str());
        let names = names.filter(|name| phase_of_task(name).is_none());
        let metrics = taceva_metrics::catalogue::select(names).unwrap_or_default();
        Some(metrics.iter().map(|metric| metric.id).collect())
    }

    fn refusal(&self, at: Option<usize>, problem: SceneProblem) -> SceneError {
        self.scene.text.error(at, problem)
    }
}

/// Light scenes to use, the calibration scene first.
pub(crate) fn lights(
    scene: &Scene,
    study: &Study,
    source: &SourceInfo,
) -> Result<Vec<String>, SceneError> {
    let SourceInfo::Rig(rig) = source else {
        return Ok(Vec::new());
    };
    let of_lighting = rig
        .lighting
        .as_ref()
        .and_then(|descriptor| match descriptor.facts() {
            taceva_core::Facts::Lighting(facts) => Some(facts.scenes.clone()),
            _ => None,
        });
    let of_sensor = || Some(rig.sensor.as_ref()?.sensor()?.scenes.clone());
    let known = of_lighting.or_else(of_sensor).unwrap_or_default();
    let written = study
        .lighting
        .as_ref()
        .and_then(|lighting| lighting.scenes.as_ref());
    let Some(written) = written else {
        return Ok(known);
    };
    if known.is_empty() && rig.lighting.is_none() {
        // The operator sets the light, which needs a real rig.
        let is_real = |robot: &taceva_core::Descriptor| robot.source() == DriverSource::Real;
        return match rig.robot.as_ref().is_some_and(is_real) {
            true => Ok(written.value.clone()),
            false => {
                let problem = "`scenes` without a `driver` are set by hand, which needs a real robot: expected `driver`";
                let problem = SceneProblem::Contradiction(problem.to_owned());
                Err(scene.text.error(written.at(), problem))
            }
        };
    }
    match written.value.iter().find(|name| !known.contains(name)) {
        Some(stranger) => {
            let known = known.iter().map(String::as_str).collect();
            Err(scene
                .text
                .unknown_name(written.at(), "scene of light", stranger, known))
        }
        None => Ok(written.value.clone()),
    }
}

/// Axis of the transducer that measures `channel`; `None` for positions.
pub(crate) fn axis_of(channel: &str) -> Option<Axis> {
    match channel {
        "Fx" => Some(Axis::Fx),
        "Fy" => Some(Axis::Fy),
        "Fz" => Some(Axis::Fz),
        _ => None,
    }
}

/// Rounds `millimetres` down to whole nanometres.
fn whole_nanometres_within(millimetres: f64) -> Nanometre {
    let nearest = Nanometre::from_millimetres(millimetres).unwrap_or_default();
    if nearest.to_millimetres() > millimetres {
        Nanometre(nearest.0 - 1)
    } else {
        nearest
    }
}

/// Fields of samples whose values follow from the protocol, without a device.
pub(crate) const OF_THE_PROTOCOL: [Field; 6] = [
    Field::Point,
    Field::DepthStep,
    Field::Repeat,
    Field::Phase,
    Field::Kind,
    Field::Spacing,
];
