//! Tasks that run in this process.

use taceva_core::shown;
use taceva_evaluate::Cache;
use taceva_models::Models;
use taceva_sweep::{Ran, Runner, SweepFolder, TaskList};

use super::super::{Context, Usage, cache};
use crate::args::{CacheArgs, SweepTask};
use crate::exit;

/// Options for running tasks.
pub(super) struct Asked<'a> {
    pub(super) cache: &'a CacheArgs,
    pub(super) retry_failed: bool,
}

/// Runs the tasks at the positions `wanted` in this process.
pub(super) fn carried_out(
    folder: &SweepFolder,
    list: &TaskList,
    wanted: &[usize],
    asked: Asked<'_>,
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

/// Executes `taceva sweep task`, which a job of a scheduler calls.
pub(super) fn run(args: &SweepTask, context: &Context) -> anyhow::Result<u8> {
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
    let ran = carried_out(&folder, &list, &args.at, asked, &models, context)?;
    Ok(ended(&ran, &folder, &list, true, context))
}

/// Prints the failed tasks, and returns the exit code.
pub(super) fn ended(
    ran: &Ran,
    folder: &SweepFolder,
    list: &TaskList,
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
        context.say(format_args!(
            "stopped; the same command continues from here"
        ));
        return exit::STOPPED;
    }
    match ran.failed.is_empty() && is_passed {
        true => exit::DONE,
        false => exit::CHECK_FAILED,
    }
}

/// Cache that tasks share: the named cache, or otherwise a cache in the folder of the sweep.
fn cache_of(args: &CacheArgs, folder: &SweepFolder) -> Option<Cache> {
    let named = CacheArgs {
        cache: Some(args.cache.clone().unwrap_or_else(|| folder.cache())),
        no_cache: args.no_cache,
    };
    cache::of(&named).map(Cache::of_many)
}
