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
    output::write(listing.path.as_deref(), |out| {
        report::plan::write(&planned, listing.format, out)
    })?;
    Ok(exit::DONE)
}
