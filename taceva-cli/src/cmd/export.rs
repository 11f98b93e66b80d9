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
    if dataset.header().signals.is_some() {
        context.say(format_args!(
            "the numbers of taxels are not in it: signals.parquet of the dataset holds them"
        ));
    }
    output::write(None, |out| writeln!(out, "wrote    {}", shown(&args.out)))?;
    Ok(exit::DONE)
}
