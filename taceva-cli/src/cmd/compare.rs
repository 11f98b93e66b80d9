//! `taceva compare`.

mod tasks;

use std::collections::BTreeMap;

use taceva_report::{
    CompareRequest, Comparison, OVERVIEW_WIDTH, RequestError, ScoreTable, compare,
};

use super::{Context, Usage, results};
use crate::args::{Compare, Format, TableScores};
use crate::{exit, output, report};

pub(crate) fn run(args: &Compare, context: &Context) -> anyhow::Result<u8> {
    if let Some(code) = tasks::run(args)? {
        return Ok(code);
    }
    let table = super::table_scores(&args.table, args.output.format)?;
    let files = args.output.path.iter().chain(&args.page.path);
    output::check_all_free(files, args.output.force)?;
    results::check_distinct(&args.results)?;
    let folder = args.catalogue.as_deref();
    let sensors = folder.map(|folder| super::catalogue::sensors(Some(folder)));
    let sensors = sensors.transpose()?;
    let found = results::find_among(&args.results, sensors.as_deref())?;
    let results::Found { studies, missing } = found;
    if studies.len() < 2 {
        return Err(Usage::error(
            "one result: expected at least two; `taceva catalogue list` names sensors to compare with",
        ));
    }
    for line in results::aliases(&args.results) {
        context.say(format_args!("{line}"));
    }
    for line in missing {
        context.say(format_args!(
            "{line}: compared by the intervals of both, not sample by sample"
        ));
    }
    let request = CompareRequest {
        metrics: args.metrics.clone(),
        margins: args
            .margins
            .iter()
            .map(|word| margin(word))
            .collect::<anyhow::Result<BTreeMap<_, _>>>()?,
        seed: args.seed.value,
    };
    let request = request.resolved(&studies).map_err(|error| {
        let option = match error {
            RequestError::Margin(_) => "--margin",
            _ => "--metrics",
        };
        Usage::error(format!("{option} {error}"))
    })?;
    for line in request.absent(&studies) {
        context.say(format_args!("--metrics {line}"));
    }
    let scores = studies.iter().flat_map(|study| &study.scores);
    results::check_channels(scores, &args.channels)?;
    let comparison = compare(&studies, &request);
    if table == TableScores::Main {
        let scores = ScoreTable::compared(&studies, &request).of_channels(&args.channels);
        output::write_as(args.output.format, args.output.path.as_deref(), |out| {
            report::main_scores(
                &scores,
                args.output.format,
                results::width(&args.output),
                out,
            )
        })?;
    } else if args.output.format == Format::Tex {
        results::write(&comparison.table(), &args.output, || comparison.json())?;
    } else if matches!(args.output.format, Format::Json | Format::Csv) {
        let scores = ScoreTable::answered(&studies, &request, comparison.answers.clone());
        let scores = scores.of_channels(&args.channels);
        let table = scores.comparison_table(&comparison, &studies, &request, args.all);
        results::write(&table, &args.output, || {
            scores.comparison_json(&comparison, &studies, &request, args.all)
        })?;
    } else {
        let scores = ScoreTable::answered(&studies, &request, comparison.answers.clone());
        let scores = scores.of_channels(&args.channels);
        let values = scores.side_by_side(&studies, &request, args.all);
        let answers = |width: Option<usize>| answers(&comparison, args, width);
        results::write_values(&values, answers, &args.output)?;
    }
    if let Some(path) = &args.page.path {
        let page = comparison.page(&studies);
        output::write(Some(path), |out| out.write_all(page.as_bytes()))?;
    }
    Ok(exit::DONE)
}

/// Text that states which results are comparable, then all answers, wrapped to `width` characters if given.
fn answers(comparison: &Comparison, args: &Compare, width: Option<usize>) -> String {
    let narrow = width.map(|width| width.min(OVERVIEW_WIDTH));
    match (args.output.format, args.all) {
        (Format::Md, _) => comparison.markdown(),
        (_, true) => comparison.text_within(narrow.unwrap_or(OVERVIEW_WIDTH)),
        (_, false) => comparison.overview(narrow),
    }
}

/// Parses a margin, `METRIC[.CHANNEL]=NUMBER`.
fn margin(word: &str) -> anyhow::Result<(String, f64)> {
    let number = |(name, number): (&str, &str)| Some((name.to_owned(), number.parse().ok()?));
    word.split_once('=')
        .and_then(number)
        .filter(|(_, number): &(String, f64)| number.is_finite() && *number > 0.0)
        .ok_or_else(|| {
            Usage::error(format!(
                "--margin `{}`: expected METRIC[.CHANNEL]=NUMBER with a number above 0, such as mae.Fz=0.01",
                taceva_report::escape_terminal(word)
            ))
        })
}
