//! The folder of a run: the scene as it was read, its plans, a recording a study, and the reports.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use crate::error::StudyError;
use crate::scene::PlannedScene;

/// What is done with a folder that is there already.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Existing {
    /// It is refused.
    Refuse,
    /// The run in it goes on, if it is one of the same plans.
    Resume,
    /// The run in it is removed; a folder of anything else is refused.
    Replace,
}

/// The folder of a run.
#[derive(Clone, Debug)]
pub struct RunFolder {
    path: PathBuf,
}

/// The plans of the run: the mark by which a folder is known to be one.
const PLANS: &str = "plans.json";
/// The scene as it was written.
const SCENE: &str = "scene.toml";
const RECORDINGS: &str = "recordings";
const REPORTS: &str = "reports";

impl RunFolder {
    /// Makes the folder at `path` ready for `scene`.
    ///
    /// # Errors
    /// [`StudyError::RunFolder`] if it is there and `existing` refuses it, if the run in it has other plans, or if it cannot be written.
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
        let plans = serde_json::to_string(scene).map_err(|error| refused(error.to_string()))?;
        let folder = RunFolder {
            path: path.to_owned(),
        };
        let (is_run, is_there) = (path.join(PLANS).exists(), path.exists());
        match existing {
            Existing::Resume if is_run => {
                let before = fs::read_to_string(path.join(PLANS)).map_err(failed)?;
                if before.trim_end() != plans {
                    return Err(refused(
                        "the run there has other plans: run the same scene with the same seed, or choose another folder"
                            .to_owned(),
                    ));
                }
                return Ok(folder);
            }
            Existing::Resume if !is_there => {
                return Err(refused("there is no run to go on with".to_owned()));
            }
            Existing::Replace if is_run => fs::remove_dir_all(path).map_err(failed)?,
            _ if is_there && !is_empty(path).map_err(failed)? => {
                return Err(refused(match existing {
                    Existing::Refuse => {
                        "exists already; --resume goes on, --force begins anew".to_owned()
                    }
                    _ => "holds something that is no run".to_owned(),
                }));
            }
            _ => {}
        }
        for inner in [RECORDINGS, REPORTS] {
            fs::create_dir_all(path.join(inner)).map_err(failed)?;
        }
        write(&path.join(SCENE), &scene.text.text).map_err(failed)?;
        write(&path.join(PLANS), &format!("{plans}\n")).map_err(failed)?;
        Ok(folder)
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Where its reports are.
    pub fn reports(&self) -> PathBuf {
        self.path.join(REPORTS)
    }

    /// Where study `number`, counted from 0, is recorded.
    pub fn recording(&self, number: usize, study: &str) -> PathBuf {
        let name = format!("{}-{}", number + 1, slug(study));
        self.path.join(RECORDINGS).join(name)
    }

    /// Where the report of study `number`, counted from 0, is written in the form with this extension.
    pub fn report(&self, number: usize, study: &str, extension: &str) -> PathBuf {
        let name = format!("{}-{}.{extension}", number + 1, slug(study));
        self.reports().join(name)
    }

    /// The first path `<parent>/<scene>-<number>` that is free, counted from 1; or the last that is taken.
    pub fn numbered(parent: &Path, scene: &str, existing: Existing) -> PathBuf {
        let path = |number: u64| parent.join(format!("{}-{number}", slug(scene)));
        let free = (1..).find(|number| !path(*number).exists()).unwrap_or(1);
        match existing {
            Existing::Refuse => path(free),
            Existing::Resume | Existing::Replace => path((free - 1).max(1)),
        }
    }
}

/// A name of a person as a name of a file.
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

/// Writes a file that is absent or whole.
fn write(path: &Path, text: &str) -> io::Result<()> {
    let beside = path.with_extension("partial");
    let mut file = File::create(&beside)?;
    file.write_all(text.as_bytes())?;
    file.sync_all()?;
    fs::rename(beside, path)
}
