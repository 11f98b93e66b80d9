//! `taceva evaluate`.

use taceva_dataset::SensorFile;
use taceva_evaluate::{DataPart, Effort, EvaluateRequest, ModelChoice, evaluate, evaluate_plan};

use super::{Context, Usage, cache, effort, fit_request, open_seen};
use crate::args::Evaluate;
use crate::{exit, output, report};

pub(crate) fn run(args: &Evaluate, context: &Context) -> anyhow::Result<u8> {
    let scoring = &args.scoring;
    super::check_free(scoring, &args.output)?;
    if let Some(path) = &args.split_out.path {
        output::check_free(path, args.output.force)?;
    }
    let models = context.models()?;
    let model = match (&args.with, &args.model.name) {
        (Some(path), _) => ModelChoice::Fitted(Box::new(models.open(path)?)),
        (None, Some(name)) if name.contains('.') && std::path::Path::new(name).is_file() => {
            return Err(Usage::error(format!(
                "{name} is a file: use --with {name} for a fitted model"
            )));
        }
        (None, Some(name)) => ModelChoice::Fit(fit_request(
            name,
            &args.model.settings,
            &args.split,
            &models,
        )?),
        (None, None) => {
            return Err(Usage::error(
                "either --model NAME or --with MODEL is needed",
            ));
        }
    };
    if args.with.is_some() && args.split.split.is_some() {
        return Err(Usage::error(
            "--split cannot be used with --with: a fitted model knows its own split",
        ));
    }
    let fitted = match &model {
        ModelChoice::Fitted(model) => Some(&**model),
        ModelChoice::Fit(_) => None,
    };
    let dataset = open_seen(&args.datasets, &args.view, fitted)?;
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
    let mut evaluated = evaluate(&dataset, &request, context.work(cache.as_ref()))?;
    if scoring.samples_out.is_some() {
        super::attachments::note_samples(&mut evaluated.report)?;
    }
    cache::note(cache.as_ref(), context);
    output::write_as(args.output.format, args.output.path.as_deref(), |out| {
        report::evaluation(&evaluated.report, args.output.format, out)
    })?;
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
