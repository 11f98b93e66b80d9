//! State of a run folder: the plans of the run, and completeness of recordings.

use std::fs;
use std::path::Path;

use taceva_acquire::PlannedScene;
use taceva_core::ErrorKind;
use taceva_dataset::Dataset;
use taceva_evaluate::{EvaluateError, PLANS};

use super::super::layout::SCENE;
use super::{RunFolder, difference, slug};
use crate::error::StudyError;

impl RunFolder {
    /// Run folder for `scene` below `parent`, named after the scene. This function does not create the folder.
    pub fn named(parent: &Path, scene: &PlannedScene) -> RunFolder {
        RunFolder {
            path: parent.join(slug(&scene.scene.name)),
        }
    }

    /// True if the folder contains a started run of `scene`. Changes nothing.
    ///
    /// # Errors
    /// [`StudyError::RunFolder`] if the run in the folder has other plans, or if its plans cannot be read.
    pub fn is_begun(&self, scene: &PlannedScene) -> Result<bool, StudyError> {
        let path = self.path.join(PLANS);
        if !path.exists() {
            return Ok(false);
        }
        let before = fs::read_to_string(&path).map_err(|error| self.refused(error.to_string()))?;
        let now = self.plans_of(scene)?;
        match difference::are_same_plans(before.trim_end(), &now) {
            true => Ok(true),
            false => Err(self.refused(self.other_plan(scene, before.trim_end(), &now))),
        }
    }

    /// Message for a folder whose run has another plan, with the first differences.
    fn other_plan(&self, scene: &PlannedScene, before: &str, now: &str) -> String {
        let text = fs::read_to_string(self.path.join(SCENE)).ok();
        let line = text.and_then(|text| difference::of_scenes(&text, &scene.text.text));
        let differences = [line, difference::of_plans(before, now)];
        let differences: Vec<String> = differences.into_iter().flatten().collect();
        let differences = match differences.as_slice() {
            [] => "the scene, seed or rig differs".to_owned(),
            differences => differences.join("; "),
        };
        format!(
            "the run in this folder has a different plan: {differences}; undo this change and use --resume, or choose another folder for the new plan"
        )
    }

    /// True if the folder contains complete recordings of every study of `scene`. Changes nothing.
    ///
    /// # Errors
    /// [`StudyError::Evaluate`] for a recording that was edited.
    pub fn is_acquired(&self, scene: &PlannedScene) -> Result<bool, StudyError> {
        for (number, study) in scene.studies.iter().enumerate() {
            match Dataset::open(&self.recording(number, &study.plan.name)) {
                Ok(_) => {}
                // The recording does not exist, was not closed, or is being made by another process.
                Err(error) if matches!(error.kind(), ErrorKind::NotFound | ErrorKind::Busy) => {
                    return Ok(false);
                }
                Err(error) => return Err(EvaluateError::from(error).into()),
            }
        }
        Ok(true)
    }

    /// Text of the plans of `scene`, for comparison with the stored plans.
    pub(super) fn plans_of(&self, scene: &PlannedScene) -> Result<String, StudyError> {
        serde_json::to_string(scene).map_err(|error| self.refused(error.to_string()))
    }

    fn refused(&self, problem: String) -> StudyError {
        StudyError::RunFolder {
            path: self.path.clone(),
            problem,
        }
    }
}
