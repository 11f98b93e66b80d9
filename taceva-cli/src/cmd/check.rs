//! `taceva check`.

use taceva_study::{CheckRequest, Severity, check, check_plan};

use super::{Context, open};
use crate::args::Check;
use crate::{exit, output, report};

pub(crate) fn run(args: &Check, context: &Context) -> anyhow::Result<u8> {
    if let Some(path) = args.output.path.as_deref() {
        output::check_free(path, args.output.force)?;
    }
    let dataset = open(&args.dataset)?;
    let request = CheckRequest {
        only: args.only.clone(),
        split: args.split.split.clone(),
        seed: args.split.seed.value,
        jobs: context.jobs,
    };
    if args.explain.is_wanted {
        let plan = check_plan(&dataset, &request)?;
        output::write(None, |out| write!(out, "{plan}"))?;
        return Ok(exit::DONE);
    }
    let findings = check(&dataset, &request, &context.progress)?;
    output::write_as(args.output.format, args.output.path.as_deref(), |out| {
        report::findings(&findings, args.output.format, out)
    })?;
    Ok(match findings.worst() {
        Some(Severity::Error) => exit::CHECK_FAILED,
        _ => exit::DONE,
    })
}
