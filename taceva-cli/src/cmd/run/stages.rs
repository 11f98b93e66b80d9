//! List of the stages of a run, which states the stages reused from the cache.

use serde::Serialize;
use taceva_evaluate::{Cache, StageRecord};
use taceva_study::RunFolder;

use super::Context;
use crate::output;

/// Content of the JSON with the schema `taceva.stages/1`.
#[derive(Serialize)]
struct Stages {
    schema: &'static str,
    stages: Vec<StageRecord>,
}

/// Writes the stages into the folder of the run, and prints them with `-v`. Reports do not depend on the stages.
pub(super) fn write(cache: &Cache, folder: &RunFolder, context: &Context) -> anyhow::Result<()> {
    let stages = cache.stages();
    for record in &stages {
        let done = if record.reused { "reused" } else { "done" };
        let (stage, study) = (record.stage.name(), &record.study);
        context.say_more(format_args!("{study}: {stage} {done} {}", record.key));
    }
    let stages = Stages {
        schema: "taceva.stages/1",
        stages,
    };
    output::write(Some(&folder.stages()), |out| {
        serde_json::to_writer_pretty(&mut *out, &stages)?;
        writeln!(out)
    })
}
