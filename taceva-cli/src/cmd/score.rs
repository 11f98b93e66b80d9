//! `taceva score`.

use anyhow::Context as _;
use taceva_core::{SourceUnit, Unit};
use taceva_study::{ScoreRequest, Scoring};

use super::{Context, Usage};
use crate::args::Score;
use crate::{exit, output, report};

pub(crate) fn run(args: &Score, context: &Context) -> anyhow::Result<u8> {
    let asked = &args.scoring;
    super::check_free(asked, &args.output)?;
    let request = ScoreRequest {
        truth: args.truth.clone(),
        prediction: args.pred.clone(),
        units: args
            .units
            .iter()
            .map(|word| unit(word))
            .collect::<anyhow::Result<_>>()?,
        sensor: asked.sensor.clone(),
        metrics: asked.metrics.clone(),
        allow_invalid: args.allow_invalid,
        jobs: context.jobs,
    };
    let scoring = Scoring::read(request)?;
    if asked.explain.is_wanted {
        output::write(None, |out| write!(out, "{}", scoring.plan()))?;
        return Ok(exit::DONE);
    }
    context.print_plan(|| Ok(scoring.plan()))?;
    let mut scored = scoring.run(&context.progress)?;
    let attachments = super::Attachments::of(asked);
    if attachments.is_any() {
        scored.report.samples = Some(scoring.samples()?);
    }
    if asked.samples_out.is_some() {
        super::attachments::note_samples(&mut scored.report)?;
    }
    output::write_as(args.output.format, args.output.path.as_deref(), |out| {
        report::evaluation(&scored.report, args.output.format, out)
    })?;
    attachments.write(&scored.report, context)?;
    if let Some(path) = &asked.state_out {
        output::write(Some(path), |out| scored.state.write(out))?;
    }
    Ok(exit::DONE)
}

/// `NAME=UNIT`: a unit that values are kept in, since tables of scores are not converted.
fn unit(word: &str) -> anyhow::Result<(String, Unit)> {
    let (name, symbol) = word
        .split_once('=')
        .with_context(|| format!("`{}`: expected NAME=UNIT", taceva_core::shown(word)))
        .map_err(|error| Usage::error(error.to_string()))?;
    let unit = Unit::from_symbol(symbol).ok_or_else(|| {
        let kept: Vec<&str> = Unit::ALL.iter().map(|unit| unit.symbol()).collect();
        let hint = match SourceUnit::parse(symbol) {
            Ok(source) => format!("; convert {symbol} to {} first", source.unit()),
            Err(_) => String::new(),
        };
        Usage::error(format!(
            "`{}`: expected a unit among {}{hint}",
            taceva_core::shown(word),
            kept.join(", ")
        ))
    })?;
    Ok((name.to_owned(), unit))
}
