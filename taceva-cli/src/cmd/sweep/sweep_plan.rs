//! Plan and cost of a sweep.

use taceva_sweep::{Estimate, SweepFolder};

use super::super::Context;
use super::scenes::SweepScene;
use crate::amount::bytes;
use crate::progress::spoken;
use crate::{exit, output};

/// Prints the number of tasks, the cost of tasks without a result, and the scenes to acquire first.
pub(super) fn print(
    estimate: &Estimate,
    skipped: usize,
    scenes: &[SweepScene],
    folder: &SweepFolder,
    context: &Context,
) -> anyhow::Result<u8> {
    let workers = u32::try_from(context.jobs.get()).unwrap_or(1);
    let time = estimate.time.map_or_else(
        || "unknown: nothing was measured yet".to_owned(),
        |time| format!("about {} with {workers} at once", spoken(time / workers)),
    );
    let disk = estimate.bytes.map_or_else(
        || "unknown: nothing was measured yet".to_owned(),
        |count| {
            format!(
                "about {}, without the features that tasks share",
                bytes(count)
            )
        },
    );
    output::write(None, |out| {
        writeln!(
            out,
            "tasks    {}, {skipped} combinations left out",
            estimate.tasks
        )?;
        writeln!(out, "found    {}", estimate.found)?;
        writeln!(out, "failed   {}", estimate.failed)?;
        writeln!(out, "time     {time}")?;
        writeln!(out, "disk     {disk}")?;
        let mut scenes = scenes.iter();
        scenes.try_for_each(|scene| writeln!(out, "scene    {}", scene.words(folder)))
    })?;
    Ok(exit::DONE)
}
