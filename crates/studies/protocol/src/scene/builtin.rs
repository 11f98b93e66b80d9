//! Scenes compiled into the program.

use super::Scene;
use crate::text::SceneError;

/// A scene compiled into the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BuiltinScene {
    /// Four simulated sensors, all metrics, few presses and a fast model.
    Quick,
    /// Four simulated sensors, all metrics, and the numbers of presses of the TacEva paper.
    Paper,
}

impl BuiltinScene {
    /// All built-in scenes.
    pub const ALL: [BuiltinScene; 2] = [BuiltinScene::Quick, BuiltinScene::Paper];

    /// Name of the scene on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            BuiltinScene::Quick => "quick",
            BuiltinScene::Paper => "paper",
        }
    }

    /// Finds a scene by its name; `None` for an unknown name.
    pub fn from_name(name: &str) -> Option<BuiltinScene> {
        BuiltinScene::ALL
            .into_iter()
            .find(|scene| scene.name() == name)
    }

    /// TOML text of the scene, to read, copy and edit.
    pub const fn text(self) -> &'static str {
        match self {
            BuiltinScene::Quick => include_str!("../scenes/quick.toml"),
            BuiltinScene::Paper => include_str!("../scenes/paper.toml"),
        }
    }

    /// Parses the scene.
    ///
    /// # Errors
    /// Errors of [`Scene::parse`]. A test parses every built-in scene.
    pub fn scene(self) -> Result<Scene, SceneError> {
        Scene::parse(self.name(), self.text())
    }
}
