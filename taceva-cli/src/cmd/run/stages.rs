//! What is said of stages that were found.

use serde::Serialize;
use taceva_study::{Cache, RunFolder, StageRecord};

use super::Context;
use crate::output;

/// Schema `taceva.stages/1`.
#[derive(Serialize)]
struct Stages {
    schema: &'static str,
    stages: Vec<StageRecord>,
}

/// Says what was found, and writes the stages into the folder of the run, where no report depends on them.
pub(super) fn tell(cache: &Cache, folder: &RunFolder, context: &Context) -> anyhow::Result<()> {
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
