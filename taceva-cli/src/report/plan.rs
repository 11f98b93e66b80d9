//! The plan of a scene, study by study.

use std::io::{self, Write};

use taceva_acquire::PlannedScene;

use super::json;
use crate::args::ListFormat;

/// Writes the plan of every study of `scene`.
pub(crate) fn write(
    scene: &PlannedScene,
    format: ListFormat,
    out: &mut dyn Write,
) -> io::Result<()> {
    if format == ListFormat::Json {
        return json::write(scene, out);
    }
    writeln!(out, "scene {}, seed {}", scene.scene.name, scene.scene.seed)?;
    for study in &scene.studies {
        write!(out, "\n{}", study.plan)?;
    }
    Ok(())
}
