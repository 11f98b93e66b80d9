//! Tasks carried out here, or handed to a scheduler.

use std::path::Path;

use taceva_core::shown;
use taceva_models::Models;
use taceva_study::Cache;
use taceva_sweep::{
    Condition, Estimate, Grid, Ran, Runner, SweepFile, SweepFolder, TaskList, collect, shell_word,
};

use super::super::{Context, Usage, cache};
use super::jobs;
use super::summary::{all_pass, print};
use crate::args::{CacheArgs, SweepEngine, SweepRun, SweepTask};
use crate::cmd::cache::amount::bytes;
use crate::progress::spoken;
use crate::{exit, output};

pub(super) fn run(args: &SweepRun, context: &Context) -> anyhow::Result<u8> {
    let Some(path) = &args.file else {
        return Err(Usage::error("the file of the sweep is missing"));
    };
    let file = SweepFile::read(path)?;
    let only = args.only.as_deref().map(Condition::parse).transpose()?;
    let models = context.models()?;
    let grid = Grid::of(&file, &models)?;
    let skipped = grid.skipped;
    let list = TaskList::new(&file, grid)?;
    let wanted = list.matching(only.as_ref())?;
    let folder = match &args.out {
        Some(folder) => SweepFolder::new(folder.clone()),
        None => SweepFolder::beside(path),
    };
    if args.dry_run {
        let estimate = Estimate::of(&folder, &list, &wanted, args.retry_failed)?;
        return planned(&estimate, skipped, context);
    }
    folder.make()?;
    let written = list.write(&folder)?;
    match args.on {
        SweepEngine::Here => {}
        SweepEngine::Slurm => {
            return jobs::submit(args, (&folder, &list), (&wanted, &file.slurm), context);
        }
        SweepEngine::List => {
            let left = list.without_result(&folder, &wanted, args.retry_failed)?;
            return listed(&left, &written, &folder);
        }
    }
    let asked = Asked {
        cache: &args.cache,
        retry_failed: args.retry_failed,
    };
    let ran = carried_out((&folder, &list), (&wanted, asked), &models, context)?;
    let collected = collect(&folder, &list, ran.scored > 0)?;
    print(&folder, &collected)?;
    Ok(ended(&ran, (&folder, &list), all_pass(&collected), context))
}

/// How tasks are to be carried out.
struct Asked<'a> {
    cache: &'a CacheArgs,
    retry_failed: bool,
}

/// Carries out the tasks at `wanted` in this process.
fn carried_out(
    (folder, list): (&SweepFolder, &TaskList),
    (wanted, asked): (&[usize], Asked<'_>),
    models: &Models,
    context: &Context,
) -> anyhow::Result<Ran> {
    let cache = cache_of(asked.cache, folder);
    let runner = Runner {
        list,
        folder,
        models,
        cache: cache.as_ref(),
        jobs: context.jobs,
        retry_failed: asked.retry_failed,
        progress: &context.progress,
    };
    let ran = runner.run(wanted)?;
    cache::note(cache.as_ref(), context);
    Ok(ran)
}

/// Prints how the tasks at `left` are carried out by an engine that is none of ours.
fn listed(left: &[usize], list: &Path, folder: &SweepFolder) -> anyhow::Result<u8> {
    let [list, folder] = [list, folder.path()].map(|path| shell_word(&path.to_string_lossy()));
    output::write(None, |out| {
        for at in left {
            writeln!(out, "taceva sweep task {folder} --tasks {list} --at {at}")?;
        }
        writeln!(out, "taceva sweep collect {folder} --tasks {list}")
    })?;
    Ok(exit::DONE)
}

/// A job of a scheduler.
pub(super) fn tasks(args: &SweepTask, context: &Context) -> anyhow::Result<u8> {
    let list = TaskList::read(&args.tasks)?;
    let folder = SweepFolder::new(args.folder.clone());
    if let Some(at) = args.at.iter().find(|at| **at >= list.tasks.len()) {
        return Err(Usage::error(format!(
            "--at {at}: the list has the tasks 0 to {}",
            list.tasks.len() - 1
        )));
    }
    let models = context.models()?;
    let asked = Asked {
        cache: &args.cache,
        retry_failed: args.retry_failed,
    };
    let ran = carried_out((&folder, &list), (&args.at, asked), &models, context)?;
    Ok(ended(&ran, (&folder, &list), true, context))
}

/// Names what failed; the exit code.
fn ended(
    ran: &Ran,
    (folder, list): (&SweepFolder, &TaskList),
    is_passed: bool,
    context: &Context,
) -> u8 {
    for (at, reason) in &ran.failed {
        let task = &list.tasks[*at];
        let seed = match list.is_of_tables() {
            true => String::new(),
            false => format!(", seed {}", task.seed),
        };
        context.say(format_args!(
            "failed: {} of {}{seed}: {} ({})",
            task.configuration(),
            shown(&task.dataset),
            shown(reason),
            shown(&folder.log(&task.key))
        ));
    }
    if ran.is_stopped {
        context.say(format_args!("stopped; the same command goes on from here"));
        return exit::STOPPED;
    }
    match ran.failed.is_empty() && is_passed {
        true => exit::DONE,
        false => exit::CHECK_FAILED,
    }
}

/// What tasks have in common, in the folder of the sweep unless another is named.
fn cache_of(args: &CacheArgs, folder: &SweepFolder) -> Option<Cache> {
    let named = CacheArgs {
        cache: Some(args.cache.clone().unwrap_or_else(|| folder.cache())),
        no_cache: args.no_cache,
    };
    cache::of(&named).map(Cache::of_many)
}

fn planned(estimate: &Estimate, skipped: usize, context: &Context) -> anyhow::Result<u8> {
    let workers = u32::try_from(context.jobs.get()).unwrap_or(1);
    let time = estimate.time.map_or_else(
        || "unknown: nothing was measured yet".to_owned(),
        |time| format!("about {} with {workers} at once", spoken(time / workers)),
    );
    let disk = estimate.bytes.map_or_else(
        || "unknown: nothing was measured yet".to_owned(),
        |count| {
            format!(
                "about {}, features that tasks share not counted",
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
        writeln!(out, "disk     {disk}")
    })?;
    Ok(exit::DONE)
}
