//! `taceva merge`.

use super::Context;
use crate::args::Merge;
use crate::{exit, output, report};

pub(crate) fn run(args: &Merge, _context: &Context) -> anyhow::Result<u8> {
    let table = super::table_scores(&args.table, args.output.format)?;
    let files = args.output.path.iter().chain(&args.state_out);
    output::check_all_free(files, args.output.force)?;
    let (report, state) = taceva_evaluate::merge(&args.states)?;
    output::write_as(args.output.format, args.output.path.as_deref(), |out| {
        report::evaluation(&report, args.output.format, table, &[], out)
    })?;
    if let Some(path) = &args.state_out {
        output::write(Some(path), |out| state.write(out))?;
    }
    Ok(exit::DONE)
}
