//! `taceva plan`.

use std::path::Path;

use super::{Context, scene};
use crate::args::PlanArgs;
use crate::{exit, output, report};

pub(crate) fn run(args: &PlanArgs, context: &Context) -> anyhow::Result<u8> {
    let to = &args.output;
    if let Some(path) = to.path.as_deref() {
        output::check_free(path, to.force)?;
    }
    let drivers = context.drivers(Some(Path::new(&args.scene.scene)))?;
    let planned = scene::planned(&args.scene, &drivers)?;
    scene::print_cost(&planned, Path::new("."), context)?;
    output::write_as(to.format, to.path.as_deref(), |out| {
        report::plan::write(&planned, to.format, out)
    })?;
    Ok(exit::DONE)
}
