//! Submits tasks as jobs of a scheduler.

use std::path::{Path, PathBuf};

use taceva_core::{counted, shown};
use taceva_dataset::internal::shell_word;
use taceva_sweep::{
    SlurmSpec, Submitted, SweepFolder, TaskList, collect, queue_of, scripts,
    submit as submit_scripts,
};

use super::super::{Context, Usage};
use super::summary::{folder_of, latest, print};
use crate::args::SweepRun;
use crate::{exit, output};

/// Submits the tasks at the positions `wanted` that have no result yet.
pub(super) fn submit(
    args: &SweepRun,
    folder: &SweepFolder,
    list: &TaskList,
    wanted: &[usize],
    spec: &SlurmSpec,
    context: &Context,
) -> anyhow::Result<u8> {
    let left = list.without_result(folder, wanted, args.retry_failed)?;
    if left.is_empty() {
        let collected = collect(folder, list, false)?;
        print(folder, &collected)?;
        return Ok(match collected.failed {
            0 => exit::DONE,
            _ => exit::CHECK_FAILED,
        });
    }
    let submission = scripts(folder, list, &left, spec, &options(args, context))?;
    let submitted = submit_scripts(folder, &submission)?;
    output::write(None, |out| {
        writeln!(
            out,
            "submitted {} in {}: {}; collected by {}",
            counted(submission.tasks, "task"),
            counted(submission.jobs, "job"),
            submitted.arrays.join(", "),
            submitted.collect.as_deref().unwrap_or("no job")
        )?;
        writeln!(out, "scripts   {}", shown(&folder.slurm()))
    })?;
    context.say(format_args!(
        "taceva sweep status {} shows the progress",
        shown(folder.path())
    ));
    Ok(exit::DONE)
}

/// Options of this call that jobs need too.
fn options(args: &SweepRun, context: &Context) -> String {
    let mut words = String::new();
    for folder in &context.plugins.folders {
        let folder = absolute(folder).to_string_lossy().into_owned();
        words.push_str(&format!(" --plugin-dir {}", shell_word(&folder)));
    }
    for id in &context.plugins.trusted {
        words.push_str(&format!(" --trust {}", shell_word(&id.to_string())));
    }
    if args.retry_failed {
        words.push_str(" --retry-failed");
    }
    if args.cache.no_cache {
        words.push_str(" --no-cache");
    }
    if let Some(cache) = &args.cache.cache {
        let cache = absolute(cache).to_string_lossy().into_owned();
        words.push_str(&format!(" --cache {}", shell_word(&cache)));
    }
    words
}

pub(super) fn status(named: &Path, context: &Context) -> anyhow::Result<u8> {
    let folder = folder_of(named);
    let list = latest(named, &folder, context)?;
    let counts = list.counts(&folder)?;
    let submitted = Submitted::read(&folder)?;
    let jobs = submitted.as_ref().map(queue_of).transpose()?;
    output::write(None, |out| {
        writeln!(
            out,
            "tasks    {}: {} scored, {} failed, {} left",
            list.tasks.len(),
            counts.scored,
            counts.failed,
            counts.left
        )?;
        match &jobs {
            None => writeln!(out, "jobs     none were submitted"),
            Some(jobs) if jobs.is_empty() => writeln!(out, "jobs     none are left"),
            Some(jobs) => jobs.iter().try_for_each(|job| {
                writeln!(out, "job      {} {} {}", job.id, job.state, job.place)
            }),
        }
    })?;
    Ok(exit::DONE)
}

pub(super) fn cancel(named: &Path, context: &Context) -> anyhow::Result<u8> {
    let folder = folder_of(named);
    let submitted = Submitted::read(&folder)?
        .ok_or_else(|| Usage::error(format!("{}: no jobs were submitted", shown(folder.path()))))?;
    submitted.cancel()?;
    context.say(format_args!(
        "cancelled; results are kept, and the sweep can be submitted again now"
    ));
    Ok(exit::DONE)
}

/// Absolute form of a path, for a job.
fn absolute(path: &Path) -> PathBuf {
    std::path::absolute(path).unwrap_or_else(|_| path.to_owned())
}
