//! `taceva bench`.

mod bench_recording;
mod models;
mod study;

use taceva_study::bench::{KernelRequest, kernels};

use super::Context;
use crate::args::{Bench, BenchKernels, BenchSubject};
use crate::{exit, output, report};

pub(crate) fn run(args: &Bench, context: &Context) -> anyhow::Result<u8> {
    match &args.subject {
        BenchSubject::Kernels(args) => run_kernels(args, context),
        BenchSubject::Models(args) => models::run(args, context),
        BenchSubject::Study(args) => study::run(args, context),
    }
}

fn run_kernels(args: &BenchKernels, context: &Context) -> anyhow::Result<u8> {
    let files = args.output.path.iter().chain(&args.figure.svg);
    output::check_all_free(files, args.output.force)?;
    let request = KernelRequest {
        rows: args.rows,
        rounds: args.rounds,
        seed: args.seed.value,
    };
    let bench = kernels(&request, &context.progress)?;
    output::write_as(args.output.format, args.output.path.as_deref(), |out| {
        report::kernel_bench(&bench, args.output.format, out)
    })?;
    if let Some(path) = &args.figure.svg {
        output::write(Some(path), |out| report::kernel_chart(&bench, out))?;
    }
    Ok(exit::DONE)
}
