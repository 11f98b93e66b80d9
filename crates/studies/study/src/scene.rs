//! A scene and its plans: what the text says, joined with what drivers and recordings say of themselves. No device is opened.

mod instead;
mod rig;
mod settings;
mod text;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use serde::ser::{Serialize, SerializeStruct, Serializer};
use taceva_core::FieldSet;
use taceva_dataset::{Dataset, FramesInfo, Known};
use taceva_drivers::Drivers;
use taceva_models::Models;
use taceva_protocol::{
    GratingClassifier, PhaseKind, Plan, RecordingInfo, Scene, SceneError, SceneProblem, SourceInfo,
    Study, plan,
};

use crate::classifier::SpacingClassifier;
use crate::error::StudyError;
use crate::fit::{FitRequest, Recipe};

pub use instead::Instead;
pub(crate) use rig::{RigSpec, open_switch};
pub(crate) use settings::settings_of;
pub use text::SceneText;
pub(crate) use text::read_rig_file;

/// A scene with the plan of each of its studies.
#[derive(Debug)]
pub struct PlannedScene {
    /// What the scene says, with the seed that counts.
    pub scene: Scene,
    /// Its text, as it was written.
    pub text: SceneText,
    /// Its studies, in order.
    pub studies: Vec<PlannedStudy>,
    /// The seeds that models are fitted with, one after the other; what models have of their own if empty.
    pub seeds: Vec<u64>,
    /// Whether the model or settings of it were typed: then no line of the scene is at fault for them.
    is_model_typed: bool,
}

/// One sensor of a scene, and what is done with it.
#[derive(Debug)]
pub struct PlannedStudy {
    /// What is done, what is not, and why.
    pub plan: Plan,
    pub(crate) study: Study,
    pub(crate) source: StudySource,
}

/// Where the samples of a study come from.
#[derive(Debug)]
pub(crate) enum StudySource {
    /// Devices by name.
    Rig(RigSpec),
    /// The folder of a recording.
    Recording(PathBuf),
}

impl PlannedScene {
    /// Reads what `text` says and plans it with `drivers`; `seed` stands in the place of the one that is written.
    ///
    /// # Errors
    /// [`StudyError::Scene`] with the line: see [`Scene::parse`] and [`plan`], and drivers, arguments, models and recordings that are
    /// not there.
    pub fn new(
        text: SceneText,
        drivers: &Drivers,
        seed: Option<u64>,
    ) -> Result<PlannedScene, StudyError> {
        let instead = Instead {
            seed,
            ..Instead::default()
        };
        PlannedScene::with(text, drivers, &instead)
    }

    /// The same with what `instead` says in the place of what is written.
    ///
    /// # Errors
    /// As [`new`](PlannedScene::new); [`StudyError::Request`] for settings of no model.
    pub fn with(
        text: SceneText,
        drivers: &Drivers,
        instead: &Instead,
    ) -> Result<PlannedScene, StudyError> {
        let mut scene = match &instead.rig {
            Some(_) => Scene::parse_for_rig(&text.name, &text.text)?,
            None => Scene::parse(&text.name, &text.text)?,
        };
        let written = scene.rig.as_ref();
        let written = written.map(|rig| text.folder.join(&rig.value));
        let rig = instead.rig.clone().or(written);
        let rig = rig
            .map(|path| read_rig_file(&path))
            .transpose()?
            .map(Arc::new);
        if let Some(rig) = &rig {
            rig::check_switch(rig, drivers)?;
            scene.put_on(rig)?;
        }
        scene.seed = instead.seed.unwrap_or(scene.seed);
        for study in &mut scene.studies {
            instead.exchange_model(&study.name, &mut study.model)?;
        }
        rig::check_drivers(&scene, drivers)?;
        if let Some(rig) = &rig {
            rig::check_changers(rig, drivers)?;
        }
        let mut sources = Vec::new();
        for study in &scene.studies {
            sources.push(Source::of(study, &scene, &text, drivers)?);
        }
        let mut infos = sources.iter().map(|source| source.info.clone());
        let plans = plan(&scene, |_| {
            infos.next().expect("a source was made for each study")
        })?;
        let studies = scene.studies.iter().zip(plans).zip(sources);
        let studies = studies.map(|((study, plan), source)| PlannedStudy {
            plan,
            study: study.clone(),
            source: source.source,
        });
        Ok(PlannedScene {
            studies: studies.collect(),
            scene,
            text,
            seeds: instead.seeds.clone(),
            is_model_typed: instead.model.is_some() || !instead.set.is_empty(),
        })
    }

    /// Refuses a model that is to be fitted and that this program does not have, or a setting that it does not take.
    ///
    /// Apart from [`new`](PlannedScene::new), because a plan can be read where it cannot be run.
    ///
    /// # Errors
    /// [`StudyError::Scene`] with the line.
    pub fn check_models(&self, models: &Models) -> Result<(), StudyError> {
        for planned in &self.studies {
            let (Some(model), false) = (&planned.study.model, planned.plan.fits.is_empty()) else {
                continue;
            };
            let request = planned.fit_request(self.scene.seed, models);
            if let (Some(name), Some(request)) = (&model.name, request) {
                let refused = |error: StudyError| {
                    if self.is_model_typed {
                        return error;
                    }
                    let problem = SceneProblem::Contradiction(error.to_string());
                    self.text.error(name.at(), problem)
                };
                let (request, recipe) = request
                    .and_then(|request| Recipe::of(&request).map(|recipe| (request, recipe)))
                    .map_err(refused)?;
                if let Some(seed) = self.seeds.first() {
                    request.with_seed(*seed)?;
                }
                self.check_kept(planned, &format!("model `{}`", name.value), recipe.cells())?;
            }
        }
        let classifier = self.classifier(models)?;
        let pressed_on_boards =
            |planned: &&PlannedStudy| planned.plan.phases.contains(&PhaseKind::Gratings);
        for planned in self.studies.iter().filter(pressed_on_boards) {
            self.check_kept(planned, "the classifier of gratings", classifier.cells())?;
        }
        Ok(())
    }

    /// Refuses frames that are kept smaller than what a model looks at, which would be found out after the last press.
    fn check_kept(
        &self,
        planned: &PlannedStudy,
        who: &str,
        cells: Option<[u32; 2]>,
    ) -> Result<(), StudyError> {
        let kept = planned
            .study
            .frames
            .filter(|_| planned.plan.cost.frames > 0);
        let (Some(kept), Some(cells)) = (kept, cells) else {
            return Ok(());
        };
        if kept.value.holds(cells) {
            return Ok(());
        }
        let [least_width, least_height] = cells;
        let problem = SceneProblem::FramesTooSmall {
            found: kept.value,
            who: format!("{who} of study `{}`", planned.plan.name),
            least_width,
            least_height,
        };
        Err(self.text.error(kept.at(), problem))
    }

    /// The classifier of the spacings of gratings.
    ///
    /// # Errors
    /// [`StudyError::Scene`] with the line of settings that it does not take, or of a model that is not there.
    pub(crate) fn classifier(&self, models: &Models) -> Result<SpacingClassifier, StudyError> {
        let gratings = &self.scene.protocol.gratings;
        SpacingClassifier::of(gratings, models).map_err(|error| {
            let problem = SceneProblem::Contradiction(error.to_string());
            self.text.error(gratings.set.at(), problem)
        })
    }
}

impl PlannedStudy {
    /// The fit that the scene asks for, if it asks for one; contact points are kept whole.
    ///
    /// `seed` is that of the scene, by which samples are divided; what a model draws it draws from a setting of its own.
    pub(crate) fn fit_request(
        &self,
        seed: u64,
        models: &Models,
    ) -> Option<Result<FitRequest, StudyError>> {
        let model = self.study.model.as_ref()?;
        let name = model.name.as_ref()?;
        let request = || {
            let (model, settings) = models.asked(&name.value, settings_of(&model.set)?)?;
            Ok(FitRequest {
                model,
                settings,
                channels: self.plan.channels.clone(),
                split: None,
                seed,
            })
        };
        Some(request())
    }

    /// The file of the finished model that the scene names, relative to its folder.
    pub(crate) fn model_file(&self) -> Option<&str> {
        let model = self.study.model.as_ref()?;
        Some(model.file.as_ref()?.value.as_str())
    }
}

/// The source of the samples of a study, for the planner and for the run.
struct Source {
    info: SourceInfo,
    source: StudySource,
}

impl Source {
    fn of(
        study: &Study,
        scene: &Scene,
        text: &SceneText,
        drivers: &Drivers,
    ) -> Result<Source, StudyError> {
        let Some(dataset) = &study.sensor.dataset else {
            let rig = study.rig.as_ref();
            let folder = rig.and_then(|rig| Path::new(rig.name()).parent());
            let spec = RigSpec::new(study, scene.seed, folder.unwrap_or(&text.folder));
            let info = spec
                .info(study, drivers)
                .map_err(|(at, problem)| match rig {
                    Some(rig) => StudyError::from(rig.error(at, problem)),
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

/// What the recording at `path` holds.
fn recording(path: &Path) -> Result<RecordingInfo, StudyError> {
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
        footprint: footprint.transpose().map_err(StudyError::Request)?,
        frame: header.frames.as_ref().map(FramesInfo::of_camera),
    })
}

/// Schema `taceva.plans/1`: the plan of every study.
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
        let fields = 4 + 2 * usize::from(is_classified_otherwise) + usize::from(rig.is_some());
        let mut scene = serializer.serialize_struct("PlannedScene", fields)?;
        scene.serialize_field("schema", "taceva.plans/1")?;
        scene.serialize_field("scene", &self.scene.name)?;
        scene.serialize_field("seed", &self.scene.seed)?;
        scene.serialize_field("studies", &plans)?;
        // Results depend on it, so that a run with another classifier is another run.
        if is_classified_otherwise {
            scene.serialize_field("gratings_classified_by", &classified_by)?;
            scene.serialize_field("gratings_set", set)?;
        }
        // What was recorded on one rig is not gone on with on another.
        if let Some(rig) = rig {
            scene.serialize_field("rig", &rig.digest().to_string())?;
        }
        scene.end()
    }
}

impl From<SceneError> for StudyError {
    fn from(error: SceneError) -> StudyError {
        StudyError::Scene(Box::new(error))
    }
}
