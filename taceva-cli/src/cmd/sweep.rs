//! `taceva sweep`.

mod jobs;
mod run;
mod scenes;
mod summary;
mod sweep_plan;
mod tasks;

use taceva_sweep::{TaskList, collect, show};

use super::{Context, results};
use crate::args::{Sweep, SweepCollect, SweepShow, SweepSubject};
use crate::exit;
use summary::{all_pass, folder_of, latest, print};

pub(crate) fn run(args: &Sweep, context: &Context) -> anyhow::Result<u8> {
    match &args.subject {
        None => run::run(&args.run, context),
        Some(SweepSubject::Show(args)) => shown(args, context),
        Some(SweepSubject::Status(args)) => jobs::status(&args.sweep, context),
        Some(SweepSubject::Cancel(args)) => jobs::cancel(&args.sweep, context),
        Some(SweepSubject::Collect(args)) => collected(args, context),
        Some(SweepSubject::Task(args)) => tasks::run(args, context),
    }
}

fn shown(args: &SweepShow, context: &Context) -> anyhow::Result<u8> {
    let folder = folder_of(&args.of.sweep);
    let list = latest(&args.of.sweep, &folder, context)?;
    let table = show(&folder, &list, &args.by, &args.metric)?;
    results::write(&table, &args.output, || {
        table.json("taceva.sweep-means/1.0")
    })?;
    Ok(exit::DONE)
}

fn collected(args: &SweepCollect, context: &Context) -> anyhow::Result<u8> {
    let folder = folder_of(&args.of.sweep);
    let list = match &args.tasks {
        Some(path) => TaskList::read(path)?,
        None => latest(&args.of.sweep, &folder, context)?,
    };
    let collected = collect(&folder, &list, true)?;
    print(&folder, &collected)?;
    Ok(match collected.is_whole() && all_pass(&collected) {
        true => exit::DONE,
        false => exit::CHECK_FAILED,
    })
}
