//! `taceva devices`.

use taceva_drivers::devices;

use super::Context;
use crate::args::{ListFormat, Output};
use crate::{exit, output, report};

pub(crate) fn run(args: &Output<ListFormat>, context: &Context) -> anyhow::Result<u8> {
    output::check_all_free(&args.path, args.force)?;
    let listed = devices(&context.drivers(None)?);
    output::write_as(args.format, args.path.as_deref(), |out| {
        report::devices::list(&listed, args.format, out)
    })?;
    Ok(exit::DONE)
}
