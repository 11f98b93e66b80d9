//! Checks of the studies of a scene and their devices.

use std::collections::BTreeSet;

use taceva_core::shown;

use super::document::{WrittenScene, WrittenStudy};
use super::recording::WrittenRecording;
use super::{Check, Checked};
use crate::frame_size::FrameSize;
use crate::limit_spec::LimitSpec;
use crate::scene::devices::{DeviceSpec, ModelSpec, SensorSpec};
use crate::scene::metrics::ReportSpec;
use crate::scene::study::Study;
use crate::text::Setting;
use crate::text::{SceneError, SceneProblem};

/// Name of the table of the sensor in a scene.
const SENSOR: &str = "[sensor]";
/// Greatest number of folds of a cross-validation. More folds cost more trainings, and hardly increase the training part of each.
const FOLDS_MAX: u64 = 20;

impl Check<'_> {
    pub(super) fn studies(&self, written: &WrittenScene) -> Result<Vec<Study>, SceneError> {
        if written.study.is_empty() {
            let alone = WrittenStudy {
                name: written.name.clone(),
                sensor: None,
                robot: None,
                force: None,
                lighting: None,
                limits: LimitSpec::default(),
                model: None,
                recording: WrittenRecording::default(),
            };
            return Ok(vec![self.study(written, &alone)?]);
        }
        let mut names = BTreeSet::new();
        let mut studies = Vec::new();
        for study in &written.study {
            self.name("a study", &study.value.name)?;
            if !names.insert(study.value.name.value.as_str()) {
                let problem = SceneProblem::Twice {
                    what: "studies",
                    name: study.value.name.value.clone(),
                };
                return self.refuse(study.value.name.at(), problem);
            }
            studies.push(self.study(written, &study.value)?);
        }
        Ok(studies)
    }

    /// Builds a study, with the tables of the scene as defaults.
    fn study(&self, scene: &WrittenScene, study: &WrittenStudy) -> Result<Study, SceneError> {
        let of_rig = Setting::default_of(SensorSpec::default());
        let sensor = match study.sensor.as_ref().or(scene.sensor.as_ref()) {
            Some(sensor) => sensor,
            None if self.is_named_elsewhere() => &of_rig,
            None => {
                let problem = format!(
                    "`{}` has no sensor: expected [sensor] with `driver` or `dataset`",
                    study.name.value
                );
                return self.refuse(study.name.at(), SceneProblem::Incomplete(problem));
            }
        };
        self.sensor(sensor)?;
        if scene.rig.is_some() {
            let devices = [&study.robot, &study.force, &scene.robot, &scene.force];
            self.no_device(sensor.value.driver.as_ref(), devices)?;
        }
        self.limits(&study.limits)?;
        self.tightened(&study.limits, &scene.limits)?;
        let lighting = study.lighting.as_ref().or(scene.lighting.as_ref());
        let scenes = lighting.and_then(|lighting| lighting.scenes.as_ref());
        self.distinct("scenes of light", scenes)?;
        if lighting.is_some_and(|lighting| lighting.driver.is_none()) && scenes.is_none() {
            let problem = format!(
                "`{}` has a light without `driver` and `scenes`: expected [lighting] with `driver`, or with `scenes` that are set by hand",
                study.name.value
            );
            return self.refuse(study.name.at(), SceneProblem::Incomplete(problem));
        }
        let model = study.model.as_ref().or(scene.model.as_ref());
        if let Some(model) = model {
            self.one_of(
                model.at(),
                "[model]",
                "name",
                &model.value.name,
                "file",
                &model.value.file,
            )?;
            self.folds(&model.value, &scene.report)?;
            self.split(&model.value)?;
        }
        let own = self.frames(&study.recording)?;
        if let (Some(dataset), Some(frames)) = (&sensor.value.dataset, &own)
            && study.sensor.is_some()
        {
            let problem = format!(
                "`frames` cannot apply to the recording `{}`, whose frames are already stored: use `driver`, or remove `frames`",
                shown(&dataset.value)
            );
            return self.contradiction(frames.at(), &problem);
        }
        Ok(Study {
            name: study.name.value.clone(),
            sensor: sensor.value.clone(),
            robot: study.robot.as_ref().or(scene.robot.as_ref()).cloned(),
            force: study.force.as_ref().or(scene.force.as_ref()).cloned(),
            lighting: lighting.cloned(),
            limits: study.limits.or(scene.limits),
            model: model.map(|model| model.value.clone()),
            frames: own.or(self.frames(&scene.recording)?),
            rig: None,
            wear: None,
        })
    }

    /// Rejects a split together with a fitted model, which has its own split. Rejects a split together with folds.
    fn split(&self, model: &ModelSpec) -> Checked {
        let Some(split) = &model.split else {
            return Ok(());
        };
        if model.file.is_some() {
            let problem = "`split` divides the samples of a fit, and `file` names a fitted model, which brings its own split: remove one of them";
            return self.contradiction(split.at(), problem);
        }
        if model.folds.is_some() {
            let problem = "`folds` tests every contact point, so `split` would have no effect: remove one of them";
            return self.contradiction(split.at(), problem);
        }
        Ok(())
    }

    /// Checks the number of folds of `model`. Rejects folds together with a fitted model, and in a run that stores its model.
    fn folds(&self, model: &ModelSpec, report: &ReportSpec) -> Checked {
        let Some(folds) = &model.folds else {
            return Ok(());
        };
        self.count("folds", folds, 2, FOLDS_MAX)?;
        if model.file.is_some() {
            let problem = "`folds` fits a model for each fold, and `file` names a fitted model: remove one of them";
            return self.contradiction(folds.at(), problem);
        }
        match report.keeps_models() {
            true => self.contradiction(
                folds.at(),
                "`folds` fits a model for each fold, so the run has no single model to keep: remove `keep = [\"models\"]`, and fit one with \
                 `taceva fit RECORDING`",
            ),
            false => Ok(()),
        }
    }

    /// Size of stored frames in `recording`, if set.
    fn frames(
        &self,
        recording: &WrittenRecording,
    ) -> Result<Option<Setting<FrameSize>>, SceneError> {
        let Some(written) = &recording.frames else {
            return Ok(None);
        };
        match FrameSize::parse(&written.value.0) {
            Some(size) => Ok(Some(written.clone().map(|_| size))),
            None => {
                let found = shown(&written.value.0).to_string();
                self.refuse(written.at(), SceneProblem::FrameSize { found })
            }
        }
    }

    fn sensor(&self, sensor: &Setting<SensorSpec>) -> Checked {
        let SensorSpec {
            driver,
            dataset,
            units,
            footprint,
            ..
        } = &sensor.value;
        self.one_of(sensor.at(), SENSOR, "driver", driver, "dataset", dataset)?;
        self.distinct("units", units.as_ref())?;
        match footprint {
            Some(written) => written
                .value
                .footprint(None)
                .map(drop)
                .or_else(|problem| self.contradiction(written.at(), &problem)),
            None => Ok(()),
        }
    }

    fn one_of<T>(
        &self,
        at: Option<usize>,
        table: &str,
        first: &str,
        one: &Option<Setting<T>>,
        second: &str,
        other: &Option<Setting<T>>,
    ) -> Checked {
        match (one, other) {
            (Some(_), Some(other)) => {
                let problem = format!("{table} has `{first}` and `{second}`: expected one of them");
                self.contradiction(other.at(), &problem)
            }
            (None, None) if table == SENSOR && self.is_named_elsewhere() => Ok(()),
            (None, None) => {
                let problem = format!("{table} has neither `{first}` nor `{second}`");
                self.refuse(at, SceneProblem::Incomplete(problem))
            }
            _ => Ok(()),
        }
    }

    /// Rejects a scene that names both devices and a rig file. The rig file names the devices.
    fn no_device(
        &self,
        sensor: Option<&Setting<String>>,
        devices: [&Option<DeviceSpec>; 4],
    ) -> Checked {
        let named = devices.into_iter().flatten().map(|device| &device.driver);
        match sensor.into_iter().chain(named).next() {
            None => Ok(()),
            Some(driver) => self.contradiction(
                driver.at(),
                "the scene has both `rig` and `driver`: remove `driver`, since the rig file names the devices",
            ),
        }
    }

    /// Checks a list of names: not empty, each name valid and unique.
    fn distinct(&self, what: &'static str, names: Option<&Setting<Vec<String>>>) -> Checked {
        let Some(names) = names else { return Ok(()) };
        let mut seen = BTreeSet::new();
        for name in &names.value {
            self.name(what, &names.clone().map(|_| name.clone()))?;
            if !seen.insert(name) {
                let name = name.clone();
                return self.refuse(names.at(), SceneProblem::Twice { what, name });
            }
        }
        if names.value.is_empty() {
            let problem = format!("the list of {what} is empty");
            return self.contradiction(names.at(), &problem);
        }
        Ok(())
    }
}
