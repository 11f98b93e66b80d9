//! `taceva score`.

mod task;

use anyhow::Context as _;
use taceva_core::{SourceUnit, Unit};
use taceva_evaluate::{
    Period, ScoreRequest, ScoreTables, Scored, Scoring, Shard, score_in_one_pass,
};

use super::{Context, Usage};
use crate::args::{Format, Score};
use crate::{exit, output, report};

/// Beginnings of notes on columns without a stated unit.
const UNSTATED: [&str; 2] = [
    "scored as a channel with the unit 1",
    "as angles in radians do, but are scored as degrees",
];

pub(crate) fn run(args: &Score, context: &Context) -> anyhow::Result<u8> {
    if !args.task.tasks.is_empty() {
        return task::run(args, context);
    }
    let asked = &args.scoring;
    let table = super::table_scores(&args.table, args.output.format)?;
    super::check_free(asked, &args.output)?;
    let request = ScoreRequest {
        truth: args.truth.clone(),
        prediction: args.pred.clone(),
        units: args
            .units
            .iter()
            .map(|word| unit(word))
            .collect::<anyhow::Result<_>>()?,
        periods: args
            .periods
            .iter()
            .map(|word| period(word))
            .collect::<anyhow::Result<_>>()?,
        key: args.key.clone(),
        is_independent: asked.independent,
        sensor: asked.sensor.clone(),
        metrics: asked.metrics.clone(),
        allow_invalid: args.allow_invalid,
        jobs: context.jobs,
    };
    let attachments = super::Attachments::of(asked);
    let scored = match scores_alone(args, context) && !attachments.is_any() {
        true => score_in_one_pass(&request, &context.progress)?,
        false => None,
    };
    let in_parts = args.shard.is_some() || ScoreTables::are_in_parts(&request);
    let scored = match (scored, in_parts && !attachments.is_any()) {
        (Some(scored), _) => Some(scored),
        (None, true) => by_shard(&request, args, context)?,
        (None, false) => whole(request, args, attachments.is_any(), context)?,
    };
    let Some(mut scored) = scored else {
        return Ok(exit::DONE);
    };
    if asked.samples_out.is_some() {
        super::attachments::note_samples(&mut scored.report)?;
    }
    say_units(args, &scored, context);
    output::write_as(args.output.format, args.output.path.as_deref(), |out| {
        report::evaluation(&scored.report, args.output.format, table, &[], out)
    })?;
    super::say_left_out(
        &asked.metrics,
        &scored.report,
        args.output.format,
        table,
        context,
    );
    attachments.write(&scored.report, context)?;
    if let Some(path) = &asked.state_out {
        output::write(Some(path), |out| scored.state.write(out))?;
    }
    Ok(exit::DONE)
}

/// Prints notes on unstated units, unless the scores are printed as text, which contains all notes.
fn say_units(args: &Score, scored: &Scored, context: &Context) {
    let output = &args.output;
    if matches!(output.format, Format::Text) && output.path.is_none() {
        return;
    }
    let notes = scored.report.provenance.notes.iter();
    for note in notes.filter(|note| UNSTATED.iter().any(|words| note.contains(words))) {
        context.say(format_args!("{}", taceva_report::escape_terminal(note)));
    }
}

/// True if only scores and state of all rows are requested, without a shard or a plan. A plan needs the number of rows first.
fn scores_alone(args: &Score, context: &Context) -> bool {
    args.shard.is_none() && !args.scoring.explain.is_wanted && !context.verbose
}

/// Scores tables that fit in memory; `None` if only the plan is requested.
fn whole(
    request: ScoreRequest,
    args: &Score,
    with_samples: bool,
    context: &Context,
) -> anyhow::Result<Option<Scored>> {
    let scoring = Scoring::read(request)?;
    if args.scoring.explain.is_wanted {
        output::write(None, |out| write!(out, "{}", scoring.plan()))?;
        return Ok(None);
    }
    context.print_plan(|| Ok(scoring.plan()))?;
    let mut scored = scoring.run(&context.progress)?;
    if with_samples {
        scored.report.samples = Some(scoring.samples()?);
    }
    Ok(Some(scored))
}

/// Scores a shard of tables of any length, or all of their rows; `None` if only the plan is requested.
fn by_shard(
    request: &ScoreRequest,
    args: &Score,
    context: &Context,
) -> anyhow::Result<Option<Scored>> {
    let shard = args.shard.unwrap_or(Shard::WHOLE);
    let tables = ScoreTables::scan(request)?;
    if args.scoring.explain.is_wanted {
        let plan = tables.plan(request, shard)?;
        output::write(None, |out| write!(out, "{plan}"))?;
        return Ok(None);
    }
    context.print_plan(|| tables.plan(request, shard))?;
    Ok(Some(tables.score(request, shard, &context.progress)?))
}

/// Parses `NAME=UNIT`. Rejects a unit with a conversion, because `score` converts no tables.
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

/// Parses `NAME=PERIOD`, the period of an angle.
fn period(word: &str) -> anyhow::Result<(String, Period)> {
    let parts = word.split_once('=');
    let read = parts.and_then(|(name, period)| Some((name.to_owned(), period.parse().ok()?)));
    read.with_context(|| {
        format!(
            "`{}`: expected NAME=PERIOD, such as yaw=360 in degrees or yaw=2pi in radians",
            taceva_core::shown(word)
        )
    })
    .map_err(|error| Usage::error(error.to_string()))
}
