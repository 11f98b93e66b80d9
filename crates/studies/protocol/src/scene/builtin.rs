//! Scenes that are compiled in.

use super::Scene;
use crate::text::SceneError;

/// A scene that is compiled in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BuiltinScene {
    /// Four simulated sensors, all metrics, small counts and a light model.
    Quick,
    /// Four simulated sensors, all metrics, the counts of the paper.
    Paper,
}

impl BuiltinScene {
    /// Every one.
    pub const ALL: [BuiltinScene; 2] = [BuiltinScene::Quick, BuiltinScene::Paper];

    /// What a person types.
    pub const fn name(self) -> &'static str {
        match self {
            BuiltinScene::Quick => "quick",
            BuiltinScene::Paper => "paper",
        }
    }

    /// The scene written as `name`.
    pub fn from_name(name: &str) -> Option<BuiltinScene> {
        BuiltinScene::ALL
            .into_iter()
            .find(|scene| scene.name() == name)
    }

    /// Its TOML, to be read, copied and changed.
    pub const fn text(self) -> &'static str {
        match self {
            BuiltinScene::Quick => include_str!("../scenes/quick.toml"),
            BuiltinScene::Paper => include_str!("../scenes/paper.toml"),
        }
    }

    /// The scene.
    ///
    /// # Errors
    /// As [`Scene::parse`]; a test reads every one.
    pub fn scene(self) -> Result<Scene, SceneError> {
        Scene::parse(self.name(), self.text())
    }
}
