//! `taceva bench decode`.

use std::path::Path;

use taceva_dataset::Dataset;
use taceva_evaluate::FitRequest;
use taceva_import::write_as_jpeg;
use taceva_report::{DecodeBench, DecodeRow, ScaledError, decode_bench};
use taceva_study::bench::{DecodeTrial, DecodeTrials, ErrorChange, TrialError, decode};

use super::super::{Context, open, results};
use super::models::{error, machine, recording, request};
use super::pressed::Pressed;
use crate::args::BenchDecode;
use crate::{exit, output};

/// The JPEG quality of frames that are encoded for the benchmark.
const QUALITY: u8 = 95;

pub(super) fn run(args: &BenchDecode, context: &Context) -> anyhow::Result<u8> {
    for path in args.output.path.iter().chain(&args.figure.svg) {
        output::check_free(path, args.output.force)?;
    }
    let known = context.models()?;
    let request = request(&args.model, &args.split, &known)?;
    // Before the bench presses anything.
    request.check()?;
    let bench = match &args.dataset {
        Some(path) => {
            let name = path.file_name().unwrap_or(path.as_os_str());
            race(&open(path)?, &name.to_string_lossy(), &request, context)?
        }
        None => {
            let pressed = Pressed::new(args.quick, args.split.seed.value, (context, &known))?;
            let path = pressed.folder().join("as-jpeg");
            write_as_jpeg(&pressed.dataset, &path, QUALITY, &context.progress)?;
            let mut bench = race(&open(&path)?, "simulated bench", &request, context)?;
            bench.note = format!(
                "The bench records PNG; for this benchmark its frames were rounded to 8 bits and encoded as JPEG of quality {QUALITY}."
            );
            bench
        }
    };
    results::write(&bench.table(), &args.output, || bench.json())?;
    if let Some(path) = &args.figure.svg {
        draw(&bench, path)?;
    }
    Ok(exit::DONE)
}

fn race(
    dataset: &Dataset,
    name: &str,
    request: &FitRequest,
    context: &Context,
) -> anyhow::Result<DecodeBench> {
    let DecodeTrials {
        split,
        train,
        test,
        rows,
    } = decode(dataset.path(), request, context.work(None))?;
    let recording = recording(dataset, name, (split, train, test));
    let model = request.model.name().to_owned();
    let mut bench = DecodeBench::new(machine(context), recording, model);
    bench.settings = request.settings.words().collect::<Vec<_>>().join(" ");
    bench.rows = rows.into_iter().map(row).collect();
    Ok(bench)
}

fn row(trial: DecodeTrial) -> DecodeRow {
    let scaled = |(own, change): (TrialError, Option<ErrorChange>)| ScaledError {
        error: error(own),
        change: change.map(|change| change.value),
        change_ci95: change.and_then(|change| change.ci95),
    };
    DecodeRow {
        denominator: trial.scale.denominator(),
        width: trial.frame.width,
        height: trial.frame.height,
        decode_s: trial.decode_s,
        errors: trial.errors.into_iter().map(scaled).collect(),
        failed: trial.failed,
    }
}

fn draw(bench: &DecodeBench, path: &Path) -> anyhow::Result<()> {
    let figure = decode_bench(bench)
        .ok_or_else(|| anyhow::anyhow!("no scale could be scored: nothing to draw"))?;
    output::write(Some(path), |out| out.write_all(figure.svg().as_bytes()))
}
