//! A scene and its plans, built from the text and the descriptors of drivers and recordings. Opens no device.

mod overrides;
mod rig;
mod text;
mod worn;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use serde::ser::{Serialize, SerializeStruct, Serializer};
use taceva_core::FieldSet;
use taceva_dataset::{Dataset, FramesInfo, Known};
use taceva_drivers::Drivers;
use taceva_protocol::{
    GratingClassifier, Plan, RecordingInfo, Scene, SceneError, SceneProblem, Setting, SourceInfo,
    Study, plan,
};

use crate::error::AcquireError;

pub use overrides::Overrides;
pub(crate) use rig::{
    Refused, RigSpec, check_changers, check_switch, check_taught, is_untaught, open_switch,
};
pub use text::SceneText;
pub(crate) use text::read_rig_file;

/// A scene with the plan of each of its studies.
#[derive(Debug)]
pub struct PlannedScene {
    /// Parsed scene, with the seed in use.
    pub scene: Scene,
    /// Text of the scene as the user wrote it.
    pub text: SceneText,
    /// Studies, in order.
    pub studies: Vec<PlannedStudy>,
    /// Seeds of repeated fits of the models. Empty to use each model's own seed.
    pub seeds: Vec<u64>,
    /// True if the command line names the model or its settings. Errors about these then contain no line of the scene.
    pub is_model_typed: bool,
}

/// One sensor of a scene, with its plan.
#[derive(Debug)]
pub struct PlannedStudy {
    /// Plan of the study.
    pub plan: Plan,
    /// Study of the scene, including the devices of its rig file.
    pub study: Study,
    pub(crate) source: StudySource,
}

/// Source of the samples of a study.
#[derive(Debug)]
pub(crate) enum StudySource {
    /// Devices that are named by their selectors.
    Rig(RigSpec),
    /// Folder of an existing recording.
    Recording(PathBuf),
}

impl PlannedScene {
    /// Parses `text`, and plans the scene with `drivers`. `seed` replaces the seed in the scene.
    ///
    /// # Errors
    /// [`AcquireError::Scene`] with the line, as for [`Scene::parse`] and [`plan`], and for missing drivers, arguments, models and recordings.
    pub fn new(
        text: SceneText,
        drivers: &Drivers,
        seed: Option<u64>,
    ) -> Result<PlannedScene, AcquireError> {
        let overrides = Overrides {
            seed,
            ..Overrides::default()
        };
        PlannedScene::with(text, drivers, &overrides)
    }

    /// Like [`new`](PlannedScene::new), with `overrides` instead of values in the text.
    ///
    /// # Errors
    /// Errors of [`new`](PlannedScene::new). [`AcquireError::Request`] for model settings without a model.
    pub fn with(
        text: SceneText,
        drivers: &Drivers,
        overrides: &Overrides,
    ) -> Result<PlannedScene, AcquireError> {
        let mut scene = match &overrides.rig {
            Some(_) => Scene::parse_for_rig(&text.name, &text.text)?,
            None => Scene::parse(&text.name, &text.text)?,
        };
        let written = scene.rig.as_ref();
        let written = written.map(|rig| text.folder.join(&rig.value));
        let rig = overrides.rig.clone().or(written);
        let rig = rig
            .map(|path| read_rig_file(&path))
            .transpose()?
            .map(Arc::new);
        if let Some(rig) = &rig {
            rig::check_switch(rig, drivers)?;
            scene.put_on(rig)?;
        }
        scene.seed = overrides.seed.unwrap_or(scene.seed);
        for study in &mut scene.studies {
            overrides.exchange_model(&study.name, &mut study.model)?;
        }
        rig::check_drivers(&scene, drivers)?;
        if let Some(rig) = &rig {
            rig::check_changers(rig, drivers)?;
        }
        let sources = Source::of_all(&scene, &text, drivers)?;
        let plans = plan_from(&sources, &scene)?;
        let studies = scene.studies.iter().zip(plans).zip(sources);
        let studies = studies.map(|((study, plan), source)| PlannedStudy {
            source: match source.source {
                StudySource::Rig(rig) => StudySource::Rig(rig.after(plan.wear.as_ref())),
                recording @ StudySource::Recording(_) => recording,
            },
            plan,
            study: study.clone(),
        });
        Ok(PlannedScene {
            studies: studies.collect(),
            scene,
            text,
            seeds: overrides.seeds.clone(),
            is_model_typed: overrides.model.is_some() || !overrides.set.is_empty(),
        })
    }

    /// Plans of the studies with `points` calibration points instead of those of the scene.
    ///
    /// # Errors
    /// [`AcquireError::Scene`] if these presses cannot be planned.
    pub fn plans_with(&self, points: u32, drivers: &Drivers) -> Result<Vec<Plan>, AcquireError> {
        let mut scene = self.scene.clone();
        scene.protocol.calibration.points = Setting::default_of(points);
        let sources = Source::of_all(&scene, &self.text, drivers)?;
        Ok(plan_from(&sources, &scene)?)
    }
}

/// Plans of the studies of `scene`, each with its source.
fn plan_from(sources: &[Source], scene: &Scene) -> Result<Vec<Plan>, SceneError> {
    let mut infos = sources.iter().map(|source| source.info.clone());
    plan(scene, |_| {
        infos.next().expect("a source was made for each study")
    })
}

/// Source of the samples of a study, for the planner and the run.
struct Source {
    info: SourceInfo,
    source: StudySource,
}

impl Source {
    /// Source of each study of `scene`, in order.
    fn of_all(
        scene: &Scene,
        text: &SceneText,
        drivers: &Drivers,
    ) -> Result<Vec<Source>, AcquireError> {
        let studies = scene.studies.iter();
        let sources = studies.map(|study| Source::of(study, scene, text, drivers));
        sources.collect()
    }

    fn of(
        study: &Study,
        scene: &Scene,
        text: &SceneText,
        drivers: &Drivers,
    ) -> Result<Source, AcquireError> {
        let Some(dataset) = &study.sensor.dataset else {
            let rig = study.rig.as_ref();
            let folder = rig.and_then(|rig| Path::new(rig.name()).parent());
            let spec = RigSpec::new(study, scene.seed, folder.unwrap_or(&text.folder));
            let info = spec
                .info(study, drivers)
                .map_err(|(at, problem)| match rig {
                    Some(rig) => AcquireError::from(rig.error(at, problem)),
                    None => text.error(at, problem),
                })?;
            return Ok(Source {
                info: SourceInfo::Rig(Box::new(info)),
                source: StudySource::Rig(spec),
            });
        };
        let path = text.folder.join(&dataset.value);
        let info = recording(&path).map_err(|error| {
            let problem = SceneProblem::Contradiction(error.to_string());
            text.error(dataset.at(), problem)
        })?;
        Ok(Source {
            info: SourceInfo::Recording(info),
            source: StudySource::Recording(path),
        })
    }
}

/// Contents of the recording at `path`.
fn recording(path: &Path) -> Result<RecordingInfo, AcquireError> {
    let dataset = Dataset::open(path)?;
    let header = dataset.header();
    let footprint = header
        .footprint
        .as_ref()
        .map(|footprint| footprint.to_core());
    let fields: FieldSet = dataset.table().fields();
    Ok(RecordingInfo {
        fields,
        channels: dataset.table().channels().clone(),
        opaque: match header.sensor.opaque {
            Known::Is(opaque) => Some(opaque),
            Known::Unknown => None,
        },
        footprint: footprint.transpose().map_err(AcquireError::Request)?,
        frame: header.frames.as_ref().map(FramesInfo::of_camera),
    })
}

/// Serialises the plan of every study, with the schema `taceva.plans/1`.
impl Serialize for PlannedScene {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let plans: Vec<&Plan> = self.studies.iter().map(|study| &study.plan).collect();
        let gratings = &self.scene.protocol.gratings;
        let (classified_by, set) = (gratings.classified_by.value, &gratings.set.value);
        let is_classified_otherwise = classified_by != GratingClassifier::default();
        let rig = self
            .studies
            .iter()
            .find_map(|study| study.study.rig.as_ref());
        let operator = rig.and_then(|rig| rig.operator_name.as_ref());
        let fields = 4
            + 2 * usize::from(is_classified_otherwise)
            + usize::from(rig.is_some())
            + usize::from(operator.is_some());
        let mut scene = serializer.serialize_struct("PlannedScene", fields)?;
        scene.serialize_field("schema", "taceva.plans/1")?;
        scene.serialize_field("scene", &self.scene.name)?;
        scene.serialize_field("seed", &self.scene.seed)?;
        scene.serialize_field("studies", &plans)?;
        // Results depend on the classifier, so another classifier makes another plan.
        if is_classified_otherwise {
            scene.serialize_field("gratings_classified_by", &classified_by)?;
            scene.serialize_field("gratings_set", set)?;
        }
        // A recording of one rig cannot be resumed on another rig.
        if let Some(rig) = rig {
            scene.serialize_field("rig", &rig.digest().to_string())?;
        }
        // A recording names one operator, which the digest alone does not show.
        if let Some(operator) = operator {
            scene.serialize_field("operator", operator)?;
        }
        scene.end()
    }
}
