//! `taceva predict`.

use std::collections::BTreeSet;
use std::io::{self, Write};

use anyhow::Context as _;
use taceva_core::shown;
use taceva_evaluate::{AtBound, DataPart, Predicted, labelled_for, predict};

use super::{Context, Usage, cache, open_seen};
use crate::args::Predict;
use crate::{exit, output};

pub(crate) fn run(args: &Predict, context: &Context) -> anyhow::Result<u8> {
    output::check_free(&args.out, args.force)?;
    let files = [
        Some(&args.out),
        args.truth_out.as_ref(),
        args.deviations_out.as_ref(),
    ];
    let files: Vec<_> = files.into_iter().flatten().collect();
    let distinct: BTreeSet<_> = files.iter().collect();
    if distinct.len() < files.len() {
        return Err(Usage::error(
            "two of --out, --truth-out and --deviations-out name the same file, expected different files",
        ));
    }
    let files = args.truth_out.iter().chain(&args.deviations_out);
    output::check_all_free(files, args.force)?;
    let model = context.models()?.open(&args.with)?;
    let dataset = open_seen(&args.datasets, &args.view, Some(&model))?;
    let labelled = labelled_for(&dataset, &model);
    let labelled = labelled.with_context(|| super::applied(&args.with, &args.datasets))?;
    let dataset = labelled.unwrap_or(dataset);
    if args.deviations_out.is_some() && !model.regressor().knows_deviations() {
        return Err(Usage::error(format!(
            "--deviations-out: a model of {} estimates no standard deviations; gaussian-process does",
            model.card().model
        )));
    }
    let cache = cache::of(&args.cache);
    let work = context.work(cache.as_ref());
    let predicted = predict(&dataset, &model, args.part.name.map(DataPart::from), work);
    let predicted = predicted.with_context(|| super::applied(&args.with, &args.datasets))?;
    cache::note(cache.as_ref(), context);
    output::write(Some(&args.out), |out| match args.unbounded {
        true => predicted.write_unbounded_predictions(out),
        false => predicted.write_predictions(out),
    })?;
    if let Some(path) = &args.truth_out {
        output::write(Some(path), |out| predicted.write_truth(out))?;
    }
    if let Some(path) = &args.deviations_out {
        output::write(Some(path), |out| predicted.write_deviations(out).map(drop))?;
    }
    output::write(None, |out| {
        writeln!(
            out,
            "wrote    {}: {} predictions of the part `{}`",
            shown(&args.out),
            predicted.rows(),
            predicted.part()
        )?;
        beyond(&predicted, args.unbounded, out)?;
        args.truth_out.iter().try_for_each(|path| {
            writeln!(
                out,
                "wrote    {}: the truth of the same samples",
                shown(path)
            )
        })
    })?;
    Ok(exit::DONE)
}

/// Prints the numbers of pictures outside the training data and of predictions beyond the bounds of the model.
fn beyond(predicted: &Predicted, is_unbounded: bool, out: &mut dyn Write) -> io::Result<()> {
    let rows = predicted.rows();
    if let Some(count) = predicted.outside().filter(|count| *count > 0) {
        writeln!(
            out,
            "outside  {count} of {rows} samples are unlike those of the fit (distance > 1)"
        )?;
    }
    let whether = if is_unbounded { "beyond" } else { "clipped to" };
    for AtBound {
        channel,
        bound,
        count,
        ..
    } in predicted.at_bounds()
    {
        writeln!(
            out,
            "bounds   {} {whether} the bound of {bound:.2} {}: {count} of {rows}",
            channel.name(),
            channel.unit()
        )?;
    }
    Ok(())
}
