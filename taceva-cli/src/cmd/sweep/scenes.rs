//! Scenes of a sweep. Scenes are planned with the sweep and acquired once, before any task.

mod acquire;

use taceva_acquire::{PlannedScene, SceneText};
use taceva_core::{counted, shown};
use taceva_drivers::Drivers;
use taceva_models::Suggestion;
use taceva_protocol::BuiltinScene;
use taceva_study::RunFolder;
use taceva_sweep::{SceneRecording, SceneTime, SweepFile, SweepFolder};

use super::super::Context;
use crate::progress::spoken;

pub(super) use acquire::{Acquisition, acquire};

pub(super) struct SweepScene {
    /// Name of the scene in the sweep file.
    named: String,
    planned: PlannedScene,
    drivers: Drivers,
    run: RunFolder,
    /// True if all recordings of the scene are complete.
    is_acquired: bool,
}

/// Plans the scenes of `file` and reads their state in `folder`. Opens no device and changes no file.
///
/// # Errors
/// For a scene that does not exist, is not valid, is not fully simulated, or shares its folder with another scene.
pub(super) fn planned(
    file: &SweepFile,
    folder: &SweepFolder,
    context: &Context,
) -> anyhow::Result<Vec<SweepScene>> {
    let mut scenes: Vec<SweepScene> = Vec::with_capacity(file.scenes.len());
    for named in &file.scenes {
        let scene = SweepScene::of(named, file, folder, context)?;
        let other = scenes
            .iter()
            .find(|other| other.run.path() == scene.run.path());
        if let Some(other) = other {
            let problem = format!(
                "`{}` and `{}` would be acquired into one folder, {}: give one of the scenes another `name`",
                shown(&other.named),
                shown(&scene.named),
                shown(scene.run.path())
            );
            return Err(file.wrong("scenes", problem).into());
        }
        scenes.push(scene);
    }
    Ok(scenes)
}

/// Recordings of all `scenes`, whether or not they exist already.
pub(super) fn recordings(scenes: &[SweepScene]) -> Vec<SceneRecording> {
    scenes.iter().flat_map(SweepScene::recordings).collect()
}

impl SweepScene {
    fn of(
        named: &str,
        file: &SweepFile,
        folder: &SweepFolder,
        context: &Context,
    ) -> anyhow::Result<SweepScene> {
        let wrong =
            |problem: String| file.wrong("scenes", format!("`{}`: {problem}", shown(named)));
        // A file of that name comes first, as for `taceva run`.
        let path = file.folder().join(named);
        let text = match (path.is_file(), BuiltinScene::from_name(named)) {
            (true, _) => SceneText::read(&path)?,
            (false, Some(builtin)) => SceneText::builtin(builtin),
            (false, None) => return Err(wrong(unknown(named, file)).into()),
        };
        let drivers = context.drivers(Some(path.as_path()))?;
        let planned = PlannedScene::new(text, &drivers, None)?;
        planned.check_simulated(&drivers).map_err(|error| {
            wrong(format!(
                "{error}; a sweep acquires only scenes of the simulated bench: run the scene with `taceva run`, and name its recordings under `datasets`"
            ))
        })?;
        let run = RunFolder::named(&folder.scenes(), &planned);
        let is_begun = run.is_begun(&planned).map_err(|error| {
            wrong(format!(
                "{error}, or remove that folder to acquire the scene again"
            ))
        })?;
        Ok(SweepScene {
            named: named.to_owned(),
            is_acquired: is_begun && run.is_acquired(&planned)?,
            planned,
            drivers,
            run,
        })
    }

    fn recordings(&self) -> impl Iterator<Item = SceneRecording> + '_ {
        let studies = self.planned.studies.iter().enumerate();
        studies.map(|(number, study)| {
            let study = &study.plan.name;
            let path = self.run.recording(number, study);
            SceneRecording::new(&self.planned.scene.name, study, path)
        })
    }

    /// Number of presses in all studies of the scene.
    fn presses(&self) -> u64 {
        let studies = self.planned.studies.iter();
        studies.map(|study| study.plan.cost.presses).sum()
    }

    /// Text on the work for the scene and on its duration, estimated from earlier times in `folder`.
    pub(super) fn words(&self, folder: &SweepFolder) -> String {
        let name = shown(&self.planned.scene.name);
        let recordings = counted(self.planned.studies.len(), "recording");
        if self.is_acquired {
            return format!("{name}: {recordings}, already acquired");
        }
        let presses = self.presses();
        let time = match SceneTime::estimate(folder, presses) {
            Some(time) => format!("about {}, before the first task", spoken(time)),
            None => {
                let studies = self.planned.studies.iter();
                let minutes: f64 = studies.map(|study| study.plan.cost.minutes).sum();
                format!(
                    "{:.0} min of motion on a rig; the simulated bench runs faster",
                    minutes.ceil()
                )
            }
        };
        let presses = counted(presses, "press");
        format!("{name}: {recordings} to be acquired, {presses}, {time}")
    }
}

/// Error message for an unknown name of a scene, with a suggestion.
fn unknown(named: &str, file: &SweepFile) -> String {
    let builtin = BuiltinScene::ALL.map(BuiltinScene::name);
    let suggestion = match Suggestion::of(named, builtin).nearest() {
        Some(nearest) => format!("; did you mean `{nearest}`?"),
        None => String::new(),
    };
    format!(
        "no such scene in {}, expected a file or one of {}{suggestion}",
        shown(file.folder()),
        builtin.join(", ")
    )
}
