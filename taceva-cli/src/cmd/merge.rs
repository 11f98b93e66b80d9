//! `taceva merge`.

use taceva_evaluate::{TaskStates, merge_task_states};

use super::{Context, Usage, task_scores};
use crate::args::Merge;
use crate::{exit, output, report};

pub(crate) fn run(args: &Merge, _context: &Context) -> anyhow::Result<u8> {
    let table = super::table_scores(&args.table, args.output.format)?;
    let files = args.output.path.iter().chain(&args.state_out);
    output::check_all_free(files, args.output.force)?;
    if args.states.iter().any(|path| TaskStates::is_at(path)) {
        return of_tasks(args);
    }
    let (report, state) = taceva_evaluate::merge(&args.states)?;
    output::write_as(args.output.format, args.output.path.as_deref(), |out| {
        report::evaluation(&report, args.output.format, table, &[], out)
    })?;
    if let Some(path) = &args.state_out {
        output::write(Some(path), |out| state.write(out))?;
    }
    Ok(exit::DONE)
}

/// Merges states of tasks.
fn of_tasks(args: &Merge) -> anyhow::Result<u8> {
    if args.table.scores.is_some() {
        return Err(Usage::error(
            "--table is for scores of channels: omit it for states of tasks",
        ));
    }
    let merged = merge_task_states(&args.states)?;
    task_scores::write(&merged, &args.output, args.state_out.as_deref())?;
    Ok(exit::DONE)
}
