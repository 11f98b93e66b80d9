//! Text of a scene and its location, used to report lines and resolve relative paths.

use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};

use taceva_dataset::internal::quoted;
use taceva_protocol::{BuiltinScene, GREATEST_SCENE, RigFile, SceneError, SceneProblem};

use crate::error::AcquireError;

/// A scene as the user wrote it.
#[derive(Clone, Debug)]
pub struct SceneText {
    /// Name for errors: path of the file, or name of a built-in scene.
    pub name: String,
    /// Text in TOML format.
    pub text: String,
    /// Base folder of relative paths.
    pub folder: PathBuf,
}

impl SceneText {
    /// Text of a built-in scene.
    pub fn builtin(scene: BuiltinScene) -> SceneText {
        SceneText {
            name: scene.name().to_owned(),
            text: scene.text().to_owned(),
            folder: PathBuf::from("."),
        }
    }

    /// Reads the scene in the file at `path`.
    ///
    /// # Errors
    /// [`AcquireError::Scene`] if the file cannot be read.
    pub fn read(path: &Path) -> Result<SceneText, AcquireError> {
        let name = path.display().to_string();
        let text = read_text(path, "scene")?;
        let folder = path.parent().unwrap_or(Path::new("")).to_owned();
        Ok(SceneText { name, text, folder })
    }

    /// Error for `problem`, at the line that contains the byte offset `at`.
    pub fn error(&self, at: Option<usize>, problem: SceneProblem) -> AcquireError {
        let line = at.map(|at| {
            let before = self.text.bytes().take(at);
            1 + before.filter(|byte| *byte == b'\n').count() as u64
        });
        AcquireError::from(SceneError {
            source_name: self.name.clone(),
            line,
            problem: Box::new(problem),
        })
    }
}

/// Reads the rig file at `path`.
///
/// # Errors
/// [`AcquireError::Scene`] if the file cannot be read or is invalid.
pub(crate) fn read_rig_file(path: &Path) -> Result<RigFile, AcquireError> {
    let text = read_text(path, "rig")?;
    Ok(RigFile::parse(&path.display().to_string(), &text)?)
}

/// Reads a file of the kind that `taceva init` writes for this `subject`.
fn read_text(path: &Path, subject: &str) -> Result<String, AcquireError> {
    let mut text = String::new();
    // One byte beyond the limit is enough to detect a longer text.
    let most = GREATEST_SCENE as u64 + 1;
    let read = File::open(path).and_then(|file| file.take(most).read_to_string(&mut text));
    match read {
        Ok(_) => Ok(text),
        Err(error) => {
            let remedy = match error.kind() {
                ErrorKind::NotFound => format!(
                    ": `taceva init {subject} --out {}` writes one",
                    quoted(path)
                ),
                _ => String::new(),
            };
            Err(AcquireError::from(SceneError {
                source_name: path.display().to_string(),
                line: None,
                problem: Box::new(SceneProblem::Syntax(format!("{error}{remedy}"))),
            }))
        }
    }
}
