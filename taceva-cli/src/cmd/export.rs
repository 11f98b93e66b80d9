//! `taceva export`.

use taceva_core::shown;
use taceva_dataset::export_hugging_face;

use super::{Context, open};
use crate::args::{Export, ExportForm};
use crate::{exit, output};

pub(crate) fn run(args: &Export, context: &Context) -> anyhow::Result<u8> {
    let dataset = open(&args.dataset)?;
    match args.format {
        ExportForm::Huggingface => export_hugging_face(&dataset, &args.out, &context.progress)?,
    }
    output::write(None, |out| writeln!(out, "wrote    {}", shown(&args.out)))?;
    Ok(exit::DONE)
}
