//! `taceva plan`.

use std::path::Path;

use super::{Context, scene};
use crate::args::PlanArgs;
use crate::{exit, output, report};

pub(crate) fn run(args: &PlanArgs, context: &Context) -> anyhow::Result<u8> {
    let listing = &args.listing;
    if let Some(path) = listing.path.as_deref() {
        output::check_free(path, listing.force)?;
    }
    let drivers = context.drivers(Some(Path::new(&args.scene.scene)))?;
    let planned = scene::planned(&args.scene, &drivers)?;
    scene::tell_cost(&planned, Path::new("."), context)?;
    output::write_as(listing.format, listing.path.as_deref(), |out| {
        report::plan::write(&planned, listing.format, out)
    })?;
    Ok(exit::DONE)
}
