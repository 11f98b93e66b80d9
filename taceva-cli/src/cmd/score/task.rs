//! `taceva score --task`.

use std::collections::BTreeMap;
use std::str::FromStr;

use taceva_core::shown;
use taceva_evaluate::{ScoreRequest, Shard, TaskRequest, TaskRule, task_states};

use super::super::{Context, Usage, origin, task_scores};
use crate::args::Score;
use crate::{exit, output};

pub(super) fn run(args: &Score, context: &Context) -> anyhow::Result<u8> {
    let (state_out, page) = (&args.scoring.state_out, &args.scoring.page);
    let files = args.output.path.iter().chain(state_out).chain(&page.path);
    output::check_all_free(files, args.output.force)?;
    let request = TaskRequest {
        tables: ScoreRequest {
            key: args.key.clone(),
            allow_invalid: args.allow_invalid,
            jobs: context.jobs,
            ..ScoreRequest::of_tables(&args.truth, &args.pred)
        },
        tasks: args.task.tasks.clone(),
        rules: rules(args)?,
        cluster: args.task.cluster.clone(),
        shard: args.shard.unwrap_or(Shard::WHOLE),
    };
    let mut states = task_states(&request)?;
    // The truth of depth maps is a dataset, which states its origin.
    if states.sources.is_empty() {
        states.sources.insert(origin::beside(&args.truth)?);
    }
    let state_out = state_out.as_deref();
    let report = match args.task.program {
        Some(program) => {
            task_scores::write_as_published(program, &states, &args.output, state_out)?
        }
        None => task_scores::write(&states, &args.output, state_out)?,
    };
    task_scores::write_page(&report, page, None)?;
    Ok(exit::DONE)
}

/// Threshold and debounce of each task, by its name.
fn rules(args: &Score) -> anyhow::Result<BTreeMap<String, TaskRule>> {
    let mut rules: BTreeMap<String, TaskRule> = BTreeMap::new();
    for word in &args.task.thresholds {
        let (name, limit) =
            read::<f64>("--threshold", word, "a number", |limit| limit.is_finite())?;
        let known = &mut rules.entry(name).or_default().threshold;
        set_once(known, limit, "--threshold", word)?;
    }
    for word in &args.task.debounces {
        let (name, count) = read::<u32>(
            "--debounce",
            word,
            "a number of frames, 1 or more",
            |count| *count > 0,
        )?;
        let known = &mut rules.entry(name).or_default().debounce;
        set_once(known, count, "--debounce", word)?;
    }
    Ok(rules)
}

/// Sets `known`. Fails if an earlier word of `option` set it.
fn set_once<T>(known: &mut Option<T>, value: T, option: &str, word: &str) -> anyhow::Result<()> {
    match known.replace(value) {
        None => Ok(()),
        Some(_) => Err(Usage::error(format!(
            "{option} `{}`: given twice for this task, expected once",
            shown(word)
        ))),
    }
}

/// Parses `NAME=VALUE`.
fn read<T: FromStr>(
    option: &str,
    word: &str,
    expected: &str,
    is_allowed: impl Fn(&T) -> bool,
) -> anyhow::Result<(String, T)> {
    let parts = word.split_once('=');
    let read = parts.and_then(|(name, value)| Some((name.to_owned(), value.parse().ok()?)));
    let read = read.filter(|(name, value)| !name.is_empty() && is_allowed(value));
    read.ok_or_else(|| {
        Usage::error(format!(
            "{option} `{}`: expected NAME=VALUE with the name of a task and {expected}",
            shown(word)
        ))
    })
}
