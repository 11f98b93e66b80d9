//! `taceva evaluate`.

mod task;

use std::path::PathBuf;

use anyhow::Context as _;
use taceva_core::{Field, shown};
use taceva_dataset::{Dataset, SensorFile};
use taceva_evaluate::{DataPart, Effort, EvaluateRequest, ModelChoice, evaluate, evaluate_plan};

use super::{Context, Usage, cache, effort, fit_request, open_seen};
use crate::args::Evaluate;
use crate::{exit, output, report};

pub(crate) fn run(args: &Evaluate, context: &Context) -> anyhow::Result<u8> {
    if let Some(name) = &args.task {
        return task::run(name, args, context);
    }
    let scoring = &args.scoring;
    let table = super::table_scores(&args.table, args.output.format)?;
    super::check_free(scoring, &args.output)?;
    output::check_all_free(&args.split_out.path, args.output.force)?;
    check_folders(&args.datasets)?;
    let models = context.models()?;
    let fitted = args
        .with
        .as_deref()
        .map(|path| models.open(path))
        .transpose()?;
    if fitted.is_some() && args.split.split.is_some() {
        return Err(Usage::error(
            "--split cannot be used with --with: the model file states its split",
        ));
    }
    let dataset = open_seen(&args.datasets, &args.view, fitted.as_ref())?;
    let model = match (fitted, &args.model.name) {
        (Some(model), _) => ModelChoice::Fitted(Box::new(model)),
        (None, Some(name)) if name.contains('.') && std::path::Path::new(name).is_file() => {
            return Err(Usage::error(format!(
                "{name} is a file: use --with {name} for a fitted model"
            )));
        }
        (None, name) => {
            let name = name
                .as_deref()
                .unwrap_or_else(|| default_model(&dataset, context));
            ModelChoice::Fit(fit_request(
                name,
                &args.model.settings,
                &args.split,
                &models,
            )?)
        }
    };
    let request = EvaluateRequest {
        model,
        metrics: scoring.metrics.clone(),
        part: args.part.name.map(DataPart::from),
        sensor: scoring
            .sensor
            .as_deref()
            .map(SensorFile::read)
            .transpose()?,
        is_independent: scoring.independent,
    };
    if scoring.explain.is_wanted {
        let plan = evaluate_plan(&dataset, &request)?;
        output::write(None, |out| write!(out, "{plan}"))?;
        return Ok(exit::DONE);
    }
    context.print_plan(|| evaluate_plan(&dataset, &request))?;
    let cache = cache::of(&args.cache);
    let planned = Effort::of_evaluation(&dataset, &request)?;
    effort::print(&planned, &dataset, cache.as_ref(), context);
    let evaluated = evaluate(&dataset, &request, context.work(cache.as_ref()));
    let mut evaluated = match &args.with {
        Some(model) => evaluated.with_context(|| super::applied(model, &args.datasets))?,
        None => evaluated?,
    };
    if scoring.samples_out.is_some() {
        super::attachments::note_samples(&mut evaluated.report)?;
    }
    cache::note(cache.as_ref(), context);
    output::write_as(args.output.format, args.output.path.as_deref(), |out| {
        let channels = &args.model.settings.channels;
        report::evaluation(&evaluated.report, args.output.format, table, channels, out)
    })?;
    super::say_left_out(
        &scoring.metrics,
        &evaluated.report,
        args.output.format,
        table,
        context,
    );
    if let Some(path) = &scoring.state_out {
        output::write(Some(path), |out| evaluated.state.write(out))?;
    }
    super::Attachments::of(scoring).write(&evaluated.report, context)?;
    if let (Some(path), Some(manifest)) = (&args.split_out.path, &evaluated.manifest) {
        output::write(Some(path), |out| {
            serde_json::to_writer_pretty(&mut *out, manifest)?;
            writeln!(out)
        })?;
    }
    Ok(exit::DONE)
}

/// Fails if a table is given instead of a dataset.
fn check_folders(datasets: &[PathBuf]) -> anyhow::Result<()> {
    let is_table = |path: &&PathBuf| {
        let extension = path.extension().and_then(|extension| extension.to_str());
        let is_table = extension.is_some_and(|name| {
            ["csv", "tsv", "parquet"]
                .iter()
                .any(|known| name.eq_ignore_ascii_case(known))
        });
        is_table && path.is_file()
    };
    match datasets.iter().find(is_table) {
        Some(path) => Err(Usage::error(format!(
            "{} is a table, not a dataset; tables of predictions: `taceva score`; recordings: `taceva import FOLDER`",
            shown(path)
        ))),
        None => Ok(()),
    }
}

/// Default model: a small network for pictures, ridge regression for signals of taxels.
fn default_model(dataset: &Dataset, context: &Context) -> &'static str {
    let name = match dataset.fields().contains(Field::Frame) {
        true => "fast",
        false => "ridge",
    };
    context.say(format_args!(
        "model: {name}, because --model is not given; ridge takes seconds, default and best are more accurate"
    ));
    name
}
