//! `taceva sweep`.

mod jobs;
mod run;

use std::path::Path;

use taceva_report::{Cell, Column, Table};
use taceva_sweep::{Collected, SweepFolder, TaskList, collect, show};

use super::{Context, results};
use crate::args::{Sweep, SweepCollect, SweepShow, SweepSubject};
use crate::{exit, output};

pub(crate) fn run(args: &Sweep, context: &Context) -> anyhow::Result<u8> {
    match &args.subject {
        None => run::run(&args.run, context),
        Some(SweepSubject::Show(args)) => shown(args),
        Some(SweepSubject::Status(args)) => jobs::status(&args.sweep),
        Some(SweepSubject::Cancel(args)) => jobs::cancel(&args.sweep, context),
        Some(SweepSubject::Collect(args)) => collected(args),
        Some(SweepSubject::Task(args)) => run::tasks(args, context),
    }
}

/// The folder of results: the one that is named, or the one beside the file that is named.
fn folder_of(named: &Path) -> SweepFolder {
    match named.is_dir() {
        true => SweepFolder::new(named.to_owned()),
        false => SweepFolder::beside(named),
    }
}

fn shown(args: &SweepShow) -> anyhow::Result<u8> {
    let folder = folder_of(&args.of.sweep);
    let list = TaskList::latest(&folder)?;
    let table = show(&folder, &list, &args.by, &args.metric)?;
    results::write(&table, &args.output, || {
        table.json("taceva.sweep-means/1.0")
    })?;
    Ok(exit::DONE)
}

fn collected(args: &SweepCollect) -> anyhow::Result<u8> {
    let folder = folder_of(&args.of.sweep);
    let list = match &args.tasks {
        Some(path) => TaskList::read(path)?,
        None => TaskList::latest(&folder)?,
    };
    let collected = collect(&folder, &list, true)?;
    print(&folder, &collected)?;
    Ok(match collected.is_whole() && all_pass(&collected) {
        true => exit::DONE,
        false => exit::CHECK_FAILED,
    })
}

fn all_pass(collected: &Collected) -> bool {
    collected.units.iter().all(|unit| unit.is_passed)
}

/// What there is now, and where.
fn print(folder: &SweepFolder, collected: &Collected) -> anyhow::Result<()> {
    let path = taceva_core::shown(folder.path()).to_string();
    output::write(None, |out| {
        writeln!(
            out,
            "tasks    {} scored, {} failed, {} missing",
            collected.scored, collected.failed, collected.missing
        )?;
        writeln!(out, "table    {path}/table.csv")?;
        writeln!(out, "digest   {}", collected.digest)?;
        writeln!(out, "page     {path}/page.html")?;
        if !collected.units.is_empty() {
            write!(out, "\n{}", units(collected).text())?;
        }
        Ok(())
    })
}

fn units(collected: &Collected) -> Table {
    let columns = ["recording", "serial", "model", "verdict", "limits not kept"];
    let mut table = Table::new("", columns.map(Column::new));
    for unit in &collected.units {
        table.push([
            Cell::text(unit.dataset.as_str()),
            Cell::text(unit.serial.as_str()),
            Cell::text(unit.task.as_str()),
            Cell::Verdict(unit.is_passed),
            Cell::text(unit.broken.join("; ")),
        ]);
    }
    table
}
