//! The scene that was named: a file, or one that is built in.

use std::path::Path;

use taceva_drivers::Drivers;
use taceva_protocol::BuiltinScene;
use taceva_study::{PlannedScene, SceneText};

use super::Usage;
use crate::args::SceneArgs;

/// The scene of `args`, planned with `drivers`.
pub(super) fn planned(args: &SceneArgs, drivers: &Drivers) -> anyhow::Result<PlannedScene> {
    Ok(PlannedScene::new(text(&args.scene)?, drivers, args.seed)?)
}

/// A file of that name comes first, so that nobody's scene is hidden by a built-in one.
fn text(named: &str) -> anyhow::Result<SceneText> {
    let path = Path::new(named);
    if path.is_file() {
        return Ok(SceneText::read(path)?);
    }
    if let Some(builtin) = BuiltinScene::from_name(named) {
        return Ok(SceneText::builtin(builtin));
    }
    if path.extension().is_none() && path.components().count() == 1 {
        let known = BuiltinScene::ALL.map(BuiltinScene::name).join(", ");
        return Err(Usage::error(format!(
            "`{named}`: no such scene, expected a file or one of {known}"
        )));
    }
    Ok(SceneText::read(path)?)
}
