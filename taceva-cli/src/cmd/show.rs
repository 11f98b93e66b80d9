//! `taceva show`.

use super::open;
use crate::args::Show;
use crate::{exit, output, report};

pub(crate) fn run(args: &Show) -> anyhow::Result<u8> {
    let dataset = open(&args.dataset)?;
    output::write(None, |out| report::dataset::write(&dataset, out))?;
    Ok(exit::DONE)
}
