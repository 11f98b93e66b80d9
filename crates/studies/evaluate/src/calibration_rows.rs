//! Rows of a recording that the plan of its run uses to fit the model.

use std::fs;
use std::path::Path;

use serde::Deserialize;
use taceva_core::shown;
use taceva_dataset::{Dataset, JoinedRecording};

use crate::error::EvaluateError;
use crate::run_layout::{PLANS, RECORDINGS};

/// Text about the split of the plan, for a model card. A later evaluation repeats the split by this text.
pub(crate) const NOTE: &str =
    "divided among the calibration presses of the run, as its plan does; all others are left out";

/// Rows that a run divides into training, validation and test parts, and the seed of this division.
pub(crate) struct PlannedRows {
    /// Row numbers, ascending.
    pub(crate) rows: Vec<usize>,
    /// Seed of the scene.
    pub(crate) seed: u64,
}

/// Fields read from `plans.json`, schema `taceva.plans/1`.
#[derive(Deserialize)]
struct Plans {
    seed: u64,
    studies: Vec<Planned>,
}

#[derive(Deserialize)]
struct Planned {
    #[serde(default)]
    presses: Vec<Press>,
}

#[derive(Deserialize)]
struct Press {
    id: String,
    phases: Vec<String>,
}

impl PlannedRows {
    /// Rows of `dataset` that its run divides into training, validation and test parts. `None` if the dataset is not a recording of a run, or if the
    /// run's plan divides no rows.
    ///
    /// # Errors
    /// [`EvaluateError::RunFolder`] if the plan next to the recording cannot be read.
    pub(crate) fn of(dataset: &Dataset) -> Result<Option<PlannedRows>, EvaluateError> {
        match dataset.recordings() {
            [] => PlannedRows::of_recording(dataset),
            joined => PlannedRows::of_joined(joined),
        }
    }

    /// Planned rows of joined recordings; `None` if no recording has a plan. All rows of a recording without a plan are divided.
    fn of_joined(joined: &[JoinedRecording]) -> Result<Option<PlannedRows>, EvaluateError> {
        let mut all = PlannedRows {
            rows: Vec::new(),
            seed: 0,
        };
        let mut is_planned = false;
        for own in joined {
            let first = own.rows().start;
            let Some(planned) = PlannedRows::of_recording(own.dataset())? else {
                all.rows.extend(own.rows());
                continue;
            };
            if !is_planned {
                all.seed = planned.seed;
            }
            is_planned = true;
            all.rows.extend(planned.rows.iter().map(|row| first + row));
        }
        Ok(is_planned.then_some(all))
    }

    fn of_recording(dataset: &Dataset) -> Result<Option<PlannedRows>, EvaluateError> {
        let Ok(path) = dataset.path().canonicalize() else {
            return Ok(None);
        };
        let Some((plans, number)) = plans_of(&path) else {
            return Ok(None);
        };
        let refused = |problem: String| EvaluateError::RunFolder {
            path: plans.clone(),
            problem,
        };
        let text = fs::read_to_string(&plans).map_err(|error| refused(error.to_string()))?;
        let read: Plans = serde_json::from_str(&text)
            .map_err(|error| refused(shown(&error.to_string()).to_string()))?;
        let study = number.checked_sub(1).and_then(|at| read.studies.get(at));
        let Some(study) = study else {
            return Ok(None);
        };
        let calibrates = |press: &&Press| press.phases.iter().any(|phase| phase == "calibration");
        let presses = study.presses.iter().filter(calibrates);
        let presses: std::collections::BTreeSet<&str> =
            presses.map(|press| press.id.as_str()).collect();
        let samples = dataset.table().samples().iter().enumerate();
        let rows: Vec<usize> = samples
            .filter(|(_, sample)| {
                let press = sample
                    .split_once('/')
                    .map_or(sample.as_str(), |(press, _)| press);
                presses.contains(press)
            })
            .map(|(row, _)| row)
            .collect();
        let seed = read.seed;
        Ok((!rows.is_empty()).then_some(PlannedRows { rows, seed }))
    }
}

/// Plans file of the run that made the recording at `path`, and number of the study in this run, counted from 1.
fn plans_of(path: &Path) -> Option<(std::path::PathBuf, usize)> {
    let recordings = path
        .parent()
        .filter(|folder| folder.ends_with(RECORDINGS))?;
    let plans = recordings.parent()?.join(PLANS);
    let (number, _) = path.file_name()?.to_str()?.split_once('-')?;
    plans.is_file().then_some((plans, number.parse().ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_recording_is_known_by_its_place_in_the_folder_of_a_run() {
        let run = tempfile::tempdir().expect("a folder");
        let recording = run.path().join("recordings/3-gelsight");
        fs::create_dir_all(&recording).expect("made");
        assert!(plans_of(&recording).is_none(), "no plans");
        fs::write(run.path().join(PLANS), "{}").expect("written");
        let (plans, number) = plans_of(&recording).expect("of a run");
        assert_eq!((plans, number), (run.path().join(PLANS), 3));
        assert!(plans_of(run.path()).is_none());
    }
}
