//! Plans a sweep from its file, and runs its tasks here or elsewhere.

use std::path::Path;

use taceva_dataset::internal::shell_word;
use taceva_sweep::{Condition, Estimate, Grid, SweepFile, SweepFolder, TaskList, collect};

use super::super::{Context, Usage};
use super::scenes::{self, Acquisition};
use super::summary::{all_pass, print};
use super::tasks::{Asked, carried_out, ended};
use super::{jobs, sweep_plan};
use crate::args::{SweepEngine, SweepRun};
use crate::{exit, output};

pub(super) fn run(args: &SweepRun, context: &Context) -> anyhow::Result<u8> {
    let Some(path) = &args.file else {
        return Err(Usage::error("expected `taceva sweep FILE`"));
    };
    let file = SweepFile::read(path)?;
    let only = args.only.as_deref().map(Condition::parse).transpose()?;
    let folder = match &args.out {
        Some(folder) => SweepFolder::new(folder.clone()),
        None => SweepFolder::beside(path),
    };
    let models = context.models()?;
    let scenes = scenes::planned(&file, &folder, context)?;
    let recordings = scenes::recordings(&scenes);
    let grid = Grid::of(&file, &recordings, &models)?;
    let skipped = grid.skipped;
    let mut list = TaskList::new(&file, grid)?;
    let mut wanted = list.matching(only.as_ref())?;
    if args.dry_run {
        let estimate = Estimate::of(&folder, &list, &wanted, args.retry_failed)?;
        return sweep_plan::print(&estimate, skipped, &scenes, &folder, context);
    }
    folder.make()?;
    let acquisition = Acquisition {
        folder: &folder,
        models: &models,
        cache: &args.cache,
    };
    if scenes::acquire(&scenes, &acquisition, context)? {
        // Keys need the digests of the acquired recordings.
        list = TaskList::new(&file, Grid::of(&file, &recordings, &models)?)?;
        wanted = list.matching(only.as_ref())?;
    }
    let written = list.write(&folder)?;
    match args.on {
        SweepEngine::Here => {}
        SweepEngine::Slurm => {
            return jobs::submit(args, &folder, &list, &wanted, &file.slurm, context);
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
    let ran = carried_out(&folder, &list, &wanted, asked, &models, context)?;
    let collected = collect(&folder, &list, ran.scored > 0)?;
    print(&folder, &collected)?;
    Ok(ended(&ran, &folder, &list, all_pass(&collected), context))
}

/// Prints the commands of the tasks at the positions `left`, for an external engine.
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
