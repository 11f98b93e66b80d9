//! `taceva stress`.

use std::path::Path;

use anyhow::Context as _;
use taceva_core::shown;
use taceva_evaluate::DataPart;
use taceva_report::FaultResult;
use taceva_stress::{By, StressRequest, severities, stress, stress_plan};

use super::{Context, Usage, open_seen, results};
use crate::args::{Format, Stress, StressBy, StressPart};
use crate::report::stress::{numbers, table};
use crate::{exit, output};

/// Refuses a model that is not a file: nothing is fitted here.
pub(super) fn check_model_file(path: &Path) -> anyhow::Result<()> {
    match path.is_file() {
        true => Ok(()),
        false => Err(Usage::error(format!(
            "--model {}: no such file, expected a fitted model; `taceva fit DATASET --model fast --out m.taceva` writes one",
            shown(path)
        ))),
    }
}

pub(crate) fn run(args: &Stress, context: &Context) -> anyhow::Result<u8> {
    let files = args.output.path.iter().chain(&args.svg);
    output::check_all_free(files, args.output.force)?;
    check_model_file(&args.model)?;
    let request = StressRequest {
        faults: args.faults.clone(),
        severities: severities(&args.severity)?,
        by: match args.by {
            StressBy::Stimulus => By::Stimulus,
            StressBy::Parameter => By::Parameter,
        },
        seed: args.seed.value,
        draws: args.draws,
        part: args.part.map(|part| match part {
            StressPart::Test => DataPart::Test,
            StressPart::All => DataPart::All,
        }),
    };
    let model = context.models()?.open(&args.model)?;
    let recordings = [args.dataset.clone()];
    let dataset = open_seen(&recordings, &args.view, Some(&model))?;
    let applied = || super::applied(&args.model, &recordings);
    if args.explain.is_wanted {
        let plan = stress_plan(&dataset, &model, &request).with_context(applied)?;
        output::write(None, |out| write!(out, "{plan}"))?;
        return Ok(exit::DONE);
    }
    context.print_plan(|| stress_plan(&dataset, &model, &request))?;
    let found = stress(&dataset, &model, &request, context.work(None)).with_context(applied)?;
    let written = match args.output.format {
        Format::Csv => numbers(&found),
        _ => table(&found),
    };
    let json = serde_json::to_string_pretty(&found)?;
    results::write(&written, &args.output, || format!("{json}\n"))?;
    if let Some(path) = &args.svg {
        let figure = FaultResult::read(&json)?.figure();
        output::write(Some(path), |out| out.write_all(figure.svg().as_bytes()))?;
    }
    Ok(exit::DONE)
}
