//! `taceva export`.

use taceva_core::shown;
use taceva_dataset::internal::quoted;
use taceva_import::ExportPlan;

use super::{Context, open};
use crate::args::Export;
use crate::{exit, output};

pub(crate) fn run(args: &Export, context: &Context) -> anyhow::Result<u8> {
    let dataset = open(&args.dataset)?;
    let plan = ExportPlan::new(&dataset, args.format.into())?;
    let report = plan.run(&args.out, context.jobs, &context.progress)?;
    for what in &report.left_out {
        context.say(format_args!("left out: {what}"));
    }
    output::write(None, |out| {
        writeln!(out, "wrote    {}", shown(&args.out))?;
        writeln!(out, "samples  {}", report.samples)?;
        if report.pictures > 0 {
            let anew = match report.encoded_anew {
                0 => "in their original bytes".to_owned(),
                anew => format!("{anew} of them re-encoded, with the same pixels"),
            };
            writeln!(out, "pictures {}, {anew}", report.pictures)?;
        }
        match report.is_importable {
            true => writeln!(
                out,
                "again    taceva import {0} --map {1} --out DATASET",
                quoted(&args.out),
                quoted(&report.map)
            ),
            false => writeln!(
                out,
                "again    import is not possible: it needs a picture of each sample"
            ),
        }
    })?;
    Ok(exit::DONE)
}
