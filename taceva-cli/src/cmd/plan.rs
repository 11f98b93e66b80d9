//! `taceva plan`.

use taceva_drivers::Drivers;

use super::{Context, scene};
use crate::args::PlanArgs;
use crate::{exit, output, report};

pub(crate) fn run(args: &PlanArgs, _context: &Context) -> anyhow::Result<u8> {
    let listing = &args.listing;
    if let Some(path) = listing.path.as_deref() {
        output::check_free(path, listing.force)?;
    }
    let planned = scene::planned(&args.scene, &Drivers::builtin()?)?;
    output::write(listing.path.as_deref(), |out| {
        report::plan::write(&planned, listing.format, out)
    })?;
    Ok(exit::DONE)
}
