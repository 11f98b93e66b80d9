//! `taceva compare`.

use std::collections::{BTreeMap, BTreeSet};

use taceva_core::shown;
use taceva_metrics::{Better, catalogue};
use taceva_report::{CompareRequest, Comparison, OVERVIEW_WIDTH, ScoreTable, Study, compare};

use super::{Context, Usage, results};
use crate::args::{Compare, Format, TableScores};
use crate::{exit, output, report};

pub(crate) fn run(args: &Compare, context: &Context) -> anyhow::Result<u8> {
    let table = super::table_scores(&args.table, args.output.format)?;
    for path in args.output.path.iter().chain(&args.page.path) {
        output::check_free(path, args.output.force)?;
    }
    results::check_distinct(&args.results)?;
    let results::Found { studies, missing } = results::find_all(&args.results)?;
    if studies.len() < 2 {
        return Err(Usage::error(
            "one result: expected at least two; `taceva catalogue list` names sensors to compare with",
        ));
    }
    for line in missing {
        context.say(format_args!(
            "{line}: compared by the intervals of both, not sample by sample"
        ));
    }
    let mut metrics = Vec::new();
    for name in &args.metrics {
        let meant = named("--metrics", name, &studies)?;
        if !meant.iter().any(|metric| is_scored(metric, &studies)) {
            context.say(format_args!(
                "--metrics {}: no result has such a score; they have {}",
                shown(name),
                scored(&studies)
            ));
        }
        metrics.extend(meant);
    }
    let request = CompareRequest {
        metrics,
        margins: args
            .margins
            .iter()
            .map(|word| margin(word, &studies))
            .collect::<anyhow::Result<BTreeMap<_, _>>>()?,
        seed: args.seed.value,
    };
    let comparison = compare(&studies, &request);
    if table == TableScores::Main {
        let scores = ScoreTable::compared(&studies, &request);
        output::write_as(args.output.format, args.output.path.as_deref(), |out| {
            report::main_scores(
                &scores,
                args.output.format,
                results::width(&args.output),
                out,
            )
        })?;
    } else if matches!(args.output.format, Format::Text | Format::Md) {
        let scores = ScoreTable::answered(&studies, &request, comparison.answers.clone());
        let values = scores.side_by_side(&studies, &request, args.all);
        let answers = |width: Option<usize>| answers(&comparison, args, width);
        results::write_values(&values, answers, &args.output)?;
    } else {
        results::write(&comparison.table(), &args.output, || comparison.json())?;
    }
    if let Some(path) = &args.page.path {
        let page = comparison.page(&studies);
        output::write(Some(path), |out| out.write_all(page.as_bytes()))?;
    }
    Ok(exit::DONE)
}

/// Comparability and answers, folded to the width of the terminal if there is one.
fn answers(comparison: &Comparison, args: &Compare, width: Option<usize>) -> String {
    let narrow = width.map(|width| width.min(OVERVIEW_WIDTH));
    match (args.output.format, args.all) {
        (Format::Md, _) => comparison.markdown(),
        (_, true) => comparison.text_within(narrow.unwrap_or(OVERVIEW_WIDTH)),
        (_, false) => comparison.overview(narrow),
    }
}

/// The metrics that `name` of a metric, a group or a score of the results means; `option` is where it was typed.
fn named(option: &str, name: &str, studies: &[Study]) -> anyhow::Result<Vec<String>> {
    if is_scored(name, studies) {
        return Ok(vec![name.to_owned()]);
    }
    let found =
        catalogue::select([name]).map_err(|error| Usage::error(format!("{option} {error}")))?;
    let is_group = found.len() > 1;
    // Metrics of a group that have no better direction are not compared.
    let compared = found
        .iter()
        .filter(|metric| !is_group || metric.better != Better::Described);
    Ok(compared.map(|metric| metric.id.to_owned()).collect())
}

/// True if a result has a score of `metric`.
fn is_scored(metric: &str, studies: &[Study]) -> bool {
    let mut studies = studies.iter();
    studies.any(|study| study.of_metric(metric).next().is_some())
}

/// The metrics of all results, as a list.
fn scored(studies: &[Study]) -> String {
    let scores = studies.iter().flat_map(|study| &study.scores);
    let metrics: BTreeSet<&str> = scores.map(|score| score.metric.as_str()).collect();
    let metrics: Vec<String> = metrics
        .iter()
        .map(|metric| shown(metric).to_string())
        .collect();
    match metrics.is_empty() {
        true => "none".to_owned(),
        false => metrics.join(", "),
    }
}

/// `METRIC[.CHANNEL]=NUMBER` of a score that a result has.
fn margin(word: &str, studies: &[Study]) -> anyhow::Result<(String, f64)> {
    let number = |(name, number): (&str, &str)| Some((name.to_owned(), number.parse().ok()?));
    let (name, number) = word
        .split_once('=')
        .and_then(number)
        .filter(|(_, number): &(String, f64)| number.is_finite() && *number > 0.0)
        .ok_or_else(|| {
            Usage::error(format!(
                "--margin `{}`: expected METRIC[.CHANNEL]=NUMBER with a number above 0, such as mae.Fz=0.01",
                shown(word)
            ))
        })?;
    let metric = name.split('.').next().unwrap_or_default();
    if !is_scored(metric, studies) {
        named("--margin", metric, studies)?;
        return Err(Usage::error(format!(
            "--margin `{}`: no result has a score of {metric}; they have {}",
            shown(word),
            scored(studies)
        )));
    }
    let channels = studies.iter().flat_map(|study| study.of_metric(metric));
    let channels: BTreeSet<String> = channels
        .map(|score| format!("{metric}.{}", score.channel))
        .collect();
    if name != metric && !channels.contains(&name) {
        let channels: Vec<String> = channels
            .iter()
            .map(|name| shown(name).to_string())
            .collect();
        return Err(Usage::error(format!(
            "--margin `{}`: no result has such a score; expected {metric} or one of {}",
            shown(word),
            channels.join(", ")
        )));
    }
    Ok((name, number))
}
