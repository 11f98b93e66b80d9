//! What a scene would do, study by study.

use std::io::{self, Write};

use serde::Serialize;
use taceva_protocol::Plan;
use taceva_study::PlannedScene;

use super::json;
use crate::args::ListFormat;

/// The plan of every study of `scene`.
pub(crate) fn write(
    scene: &PlannedScene,
    format: ListFormat,
    out: &mut dyn Write,
) -> io::Result<()> {
    let plans = scene.studies.iter().map(|study| &study.plan);
    if format == ListFormat::Json {
        let written = WrittenPlans {
            schema: "taceva.plans/1",
            scene: &scene.scene.name,
            seed: scene.scene.seed,
            studies: plans.collect(),
        };
        return json::write(&written, out);
    }
    writeln!(out, "scene {}, seed {}", scene.scene.name, scene.scene.seed)?;
    for plan in plans {
        write!(out, "\n{plan}")?;
    }
    Ok(())
}

#[derive(Serialize)]
struct WrittenPlans<'a> {
    schema: &'static str,
    scene: &'a str,
    seed: u64,
    studies: Vec<&'a Plan>,
}
