//! Folder of a run: the scene as written, the plans, one recording for each study, and the reports.

mod difference;
mod state;

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use taceva_files::{Staged, clear_leftovers, parent_of, sync_folder};
use taceva_models::Checkpoints;

use taceva_acquire::PlannedScene;
use taceva_evaluate::{MODELS, PLANS, RECORDINGS, STATES};

use super::layout::{FIGURES, REPORTS, SCENE, STAGES, STRESS};
use crate::error::StudyError;

/// Policy for a run folder that already exists.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Existing {
    /// Rejects an existing folder.
    Refuse,
    /// Resumes the run in the folder if its plans are unchanged.
    Resume,
    /// Removes the run in the folder; rejects a folder that contains no run.
    Replace,
}

/// The folder of a run.
#[derive(Clone, Debug)]
pub struct RunFolder {
    path: PathBuf,
}

impl RunFolder {
    /// Name of the scene in the run folder at `path`; `None` if the folder has no readable scene.
    ///
    /// ```
    /// assert_eq!(taceva_study::RunFolder::scene_name("no-run".as_ref()), None);
    /// ```
    pub fn scene_name(path: &Path) -> Option<String> {
        let text = fs::read_to_string(path.join(SCENE)).ok()?;
        let scene = taceva_protocol::Scene::parse_for_rig(SCENE, &text).ok()?;
        Some(scene.name)
    }

    /// Prepares the folder at `path` for `scene`.
    ///
    /// # Errors
    /// [`StudyError::RunFolder`] if `existing` rejects the folder, if the run in the folder has other plans, or if the folder cannot be written.
    pub fn open(
        path: &Path,
        scene: &PlannedScene,
        existing: Existing,
    ) -> Result<RunFolder, StudyError> {
        let refused = |problem: String| StudyError::RunFolder {
            path: path.to_owned(),
            problem,
        };
        let failed = |error: io::Error| refused(error.to_string());
        let folder = RunFolder {
            path: path.to_owned(),
        };
        let plans = folder.plans_of(scene)?;
        let (is_run, is_there) = (path.join(PLANS).exists(), path.exists());
        match existing {
            Existing::Resume if folder.is_begun(scene)? => {
                for written in ["", REPORTS, FIGURES, RECORDINGS, STATES, MODELS, STRESS] {
                    clear_leftovers(&path.join(written));
                }
                return Ok(folder);
            }
            Existing::Resume if !is_there => {
                return Err(refused(
                    "no run to resume: the folder does not exist; start one without --resume"
                        .to_owned(),
                ));
            }
            Existing::Replace if is_run => fs::remove_dir_all(path).map_err(failed)?,
            _ if is_there && !is_empty(path).map_err(failed)? => {
                return Err(refused(match existing {
                    Existing::Refuse => {
                        "the folder exists already; use --resume to continue its run, or --force to start again"
                            .to_owned()
                    }
                    _ => "the folder holds no run; name another folder".to_owned(),
                }));
            }
            _ => {}
        }
        make(path, &scene.text.text, &format!("{plans}\n")).map_err(failed)?;
        Ok(folder)
    }

    /// Path of the run folder.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Folder of the reports of the run.
    pub fn reports(&self) -> PathBuf {
        self.path.join(REPORTS)
    }

    /// Folder of the figures of the run.
    pub fn figures(&self) -> PathBuf {
        self.path.join(FIGURES)
    }

    /// File that lists the stages of the run, and states for each if it was reused from the cache.
    pub fn stages(&self) -> PathBuf {
        self.path.join(STAGES)
    }

    /// Folder of the recording of study `number`, counted from 0.
    pub fn recording(&self, number: usize, study: &str) -> PathBuf {
        let name = format!("{}-{}", number + 1, slug(study));
        self.path.join(RECORDINGS).join(name)
    }

    /// Report file of study `number`, counted from 0, with the extension `extension`.
    pub fn report(&self, number: usize, study: &str, extension: &str) -> PathBuf {
        let name = format!("{}-{}.{extension}", number + 1, slug(study));
        self.reports().join(name)
    }

    /// File with the errors of the model of study `number`, counted from 0, under faults of pictures. Used for a scene with `[stress]`.
    pub fn stress(&self, number: usize, study: &str) -> PathBuf {
        let name = format!("{}-{}.json", number + 1, slug(study));
        self.path.join(STRESS).join(name)
    }

    /// Checkpoint file of an unfinished training of study `number`, counted from 0.
    pub(crate) fn checkpoint(&self, number: usize, study: &str) -> PathBuf {
        let name = format!("{}-{}.checkpoint", number + 1, slug(study));
        self.path.join(name)
    }

    /// Common prefix of the names of the state files of study `number`, counted from 0.
    pub(crate) fn states(&self, number: usize, study: &str) -> PathBuf {
        let name = format!("{}-{}", number + 1, slug(study));
        self.path.join(STATES).join(name)
    }

    /// Model file of study `number`, counted from 0, for a scene that stores its models.
    pub(crate) fn model(&self, number: usize, study: &str) -> PathBuf {
        let name = format!("{}-{}.taceva", number + 1, slug(study));
        self.path.join(MODELS).join(name)
    }

    /// Removes the files that only a resumed run needs. Call it after the reports are written.
    ///
    /// # Errors
    /// [`StudyError::RunFolder`] with the path that cannot be removed.
    pub fn close(&self, scene: &PlannedScene) -> Result<(), StudyError> {
        for (number, study) in scene.studies.iter().enumerate() {
            let path = self.checkpoint(number, &study.plan.name);
            let removed = Checkpoints::at(path.clone()).remove();
            removed.map_err(|error| StudyError::RunFolder {
                path,
                problem: error.to_string(),
            })?;
        }
        Ok(())
    }

    /// Removes the folder of a run that recorded nothing, so that the user can repeat the command after fixing the error. Returns true if the folder was
    /// removed.
    pub fn remove_if_untouched(&self) -> bool {
        let is_untouched = [RECORDINGS, REPORTS, FIGURES, STATES]
            .iter()
            .all(|inner| is_empty(&self.path.join(inner)).unwrap_or(false));
        is_untouched && fs::remove_dir_all(&self.path).is_ok()
    }

    /// First free path `<parent>/<scene>-<number>`, counted from 1. For `Resume` and `Replace`, the path with the number before it.
    pub fn numbered(parent: &Path, scene: &str, existing: Existing) -> PathBuf {
        let path = |number: u64| parent.join(format!("{}-{number}", slug(scene)));
        let free = (1..).find(|number| !path(*number).exists()).unwrap_or(1);
        match existing {
            Existing::Refuse => path(free),
            Existing::Resume | Existing::Replace => path((free - 1).max(1)),
        }
    }
}

/// Converts a name to a part of a file name that is valid on all systems.
fn slug(name: &str) -> String {
    let letters = name.chars().map(|letter| {
        if letter.is_alphanumeric() || "-_".contains(letter) {
            letter
        } else {
            '-'
        }
    });
    let slug: String = letters.take(60).collect();
    slug.to_lowercase()
}

fn is_empty(path: &Path) -> io::Result<bool> {
    Ok(fs::read_dir(path)?.next().is_none())
}

/// Creates the folder of a run under a temporary name, and renames it, so that no incomplete folder is ever visible at `path`.
fn make(path: &Path, scene: &str, plans: &str) -> io::Result<()> {
    fs::create_dir_all(parent_of(path))?;
    let staged = Staged::beside(path)?;
    for inner in [RECORDINGS, REPORTS, FIGURES, STATES] {
        fs::create_dir_all(staged.path().join(inner))?;
    }
    for (name, text) in [(SCENE, scene), (PLANS, plans)] {
        let mut file = File::create(staged.path().join(name))?;
        file.write_all(text.as_bytes())?;
        file.sync_all()?;
    }
    // After a power cut, a folder must not exist without its files.
    sync_folder(staged.path())?;
    if path.exists() {
        // Fails unless the folder is empty, as the rename would.
        fs::remove_dir(path)?;
    }
    staged.put_in_place()
}

#[cfg(test)]
mod tests {
    use taceva_drivers::Drivers;

    use super::*;
    use taceva_acquire::SceneText;

    const SCENE_TEXT: &str = "scene_version = 1\nname = \"My gel, twice\"\n\
                              sensor = { dataset = \"recording\" }\n";

    /// Test scene of a recording without samples in `folder`. The recording is created if it is absent.
    fn scene(folder: &Path, seed: u64) -> PlannedScene {
        let recording = folder.join("recording");
        if !recording.exists() {
            let sensor = taceva_dataset::SensorFacts::new("drawn")
                .with_serial("1")
                .with_gel("1");
            let facts = taceva_dataset::RecordingFacts::new(
                taceva_dataset::Source::Synthetic,
                taceva_core::Clock::Unknown,
                sensor,
            );
            let spec = taceva_dataset::RecordingSpec::new(
                facts,
                taceva_core::Channels::new([taceva_core::Channel::FZ]).expect("one"),
            );
            let recorder = taceva_dataset::Recorder::create(&recording, &spec).expect("new");
            recorder.close().expect("closed");
        }
        let text = SceneText {
            name: "s.toml".to_owned(),
            text: SCENE_TEXT.to_owned(),
            folder: folder.to_owned(),
        };
        let drivers = Drivers::builtin().expect("consistent");
        PlannedScene::new(text, &drivers, Some(seed)).expect("a plan")
    }

    #[test]
    fn a_folder_of_something_else_is_never_touched() {
        let folder = tempfile::tempdir().expect("a folder");
        let scene = scene(folder.path(), 1);
        let mine = folder.path().join("mine");
        fs::create_dir(&mine).expect("made");
        fs::write(mine.join("notes"), "mine").expect("written");
        for existing in [Existing::Refuse, Existing::Resume, Existing::Replace] {
            assert!(
                RunFolder::open(&mine, &scene, existing).is_err(),
                "{existing:?}"
            );
        }
        assert_eq!(fs::read(mine.join("notes")).expect("there"), b"mine");
    }

    #[test]
    fn a_run_goes_on_with_its_own_plans_only() {
        let folder = tempfile::tempdir().expect("a folder");
        let run = folder.path().join("deep/run");
        let [own, other] = [1, 2].map(|seed| scene(folder.path(), seed));
        assert!(RunFolder::open(&run, &own, Existing::Resume).is_err());
        RunFolder::open(&run, &own, Existing::Refuse).expect("made");
        assert!(RunFolder::open(&run, &own, Existing::Refuse).is_err());
        RunFolder::open(&run, &own, Existing::Resume).expect("goes on");
        let refused = RunFolder::open(&run, &other, Existing::Resume).expect_err("other plans");
        assert!(
            refused
                .to_string()
                .contains("a different plan: seed was 1 and is now 2; undo this change"),
            "{refused}"
        );
        RunFolder::open(&run, &other, Existing::Replace).expect("begun anew");
        RunFolder::open(&run, &other, Existing::Resume).expect("goes on");
    }

    #[test]
    fn a_run_that_goes_on_clears_what_an_interruption_left_half_written() {
        let folder = tempfile::tempdir().expect("a folder");
        let run = folder.path().join("run");
        let scene = scene(folder.path(), 1);
        let opened = RunFolder::open(&run, &scene, Existing::Refuse).expect("made");
        let inner = [
            &run,
            &opened.reports(),
            &opened.figures(),
            &run.join("recordings"),
        ]
        .map(|folder| folder.join(".taceva-staged-a1b2c3"));
        let halves = &inner;
        for half in halves {
            fs::create_dir(half).expect("made");
            fs::write(half.join(".taceva-temporary"), "").expect("written");
            fs::write(half.join("half"), "half").expect("written");
        }
        RunFolder::open(&run, &scene, Existing::Resume).expect("goes on");
        for half in halves {
            assert!(!half.exists(), "{half:?}");
        }
    }

    #[test]
    fn a_run_that_recorded_nothing_leaves_no_folder_and_any_other_stays() {
        let folder = tempfile::tempdir().expect("a folder");
        let run = folder.path().join("run");
        let scene = scene(folder.path(), 1);
        let opened = RunFolder::open(&run, &scene, Existing::Refuse).expect("made");
        assert!(opened.remove_if_untouched() && !run.exists());
        let opened = RunFolder::open(&run, &scene, Existing::Refuse).expect("made again");
        fs::create_dir(run.join("recordings/.1-gel.partial")).expect("made");
        assert!(!opened.remove_if_untouched() && run.exists());
    }

    #[test]
    fn runs_of_a_scene_are_numbered() {
        let folder = tempfile::tempdir().expect("a folder");
        let scene = scene(folder.path(), 1);
        let numbered = |existing| RunFolder::numbered(folder.path(), &scene.scene.name, existing);
        for number in 1..3 {
            let path = numbered(Existing::Refuse);
            assert!(
                path.ends_with(format!("my-gel--twice-{number}")),
                "{path:?}"
            );
            RunFolder::open(&path, &scene, Existing::Refuse).expect("made");
            assert_eq!(numbered(Existing::Resume), path);
        }
    }
}
