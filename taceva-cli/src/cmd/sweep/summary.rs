//! Summary of the results of a sweep.

use std::path::Path;

use taceva_report::{Cell, Column, Table};
use taceva_sweep::{Collected, SweepFolder, TaskList};

use super::super::Context;
use crate::output;

/// Folder of results: the named folder, or the folder next to the named file.
pub(super) fn folder_of(named: &Path) -> SweepFolder {
    match named.is_dir() {
        true => SweepFolder::new(named.to_owned()),
        false => SweepFolder::beside(named),
    }
}

/// Tasks of the last call. Prints a message if the sweep file has changed since that call.
pub(super) fn latest(
    named: &Path,
    folder: &SweepFolder,
    context: &Context,
) -> anyhow::Result<TaskList> {
    let list = TaskList::latest(folder)?;
    if named.is_file() && !list.is_of(named) {
        let named = taceva_core::shown(named);
        context.say(format_args!(
            "{named} has changed since its tasks were listed, so these are the earlier tasks; taceva sweep {named} --dry-run lists the present tasks"
        ));
    }
    Ok(list)
}

/// True if every tested sensor unit meets its limits, or if there are no limits.
pub(super) fn all_pass(collected: &Collected) -> bool {
    collected.units.iter().all(|unit| unit.is_passed)
}

/// Prints the counts and the paths of the results.
pub(super) fn print(folder: &SweepFolder, collected: &Collected) -> anyhow::Result<()> {
    let path = taceva_core::shown(folder.path()).to_string();
    output::write(None, |out| {
        writeln!(
            out,
            "tasks    {} scored, {} failed, {} missing",
            collected.scored, collected.failed, collected.missing
        )?;
        if collected.is_of_tables {
            return match collected.is_whole() {
                true => writeln!(
                    out,
                    "scores   {path}/score.json\ndigest   {}",
                    collected.digest
                ),
                false => writeln!(out, "scores   follow when every shard is scored"),
            };
        }
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
    let columns = ["recording", "serial", "model", "verdict", "limits not met"];
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
