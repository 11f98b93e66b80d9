//! `taceva fit`.

use std::io::{self, Write};
use std::time::Duration;
use taceva_core::{counted, shown};

use anyhow::Context as _;
use taceva_evaluate::{Effort, Fitted, fit_task, fit_validated};
use taceva_metrics::Standing;
use taceva_models::{Checkpoints, ChosenBy, FoldGroups, Foreign, SplitKind, SplitSpec};
use taceva_results::OPTIMISTIC;

use super::{Context, cache, effort, fit_request, open_seen};
use crate::args::Fit;
use crate::{exit, output};

pub(crate) fn run(args: &Fit, context: &Context) -> anyhow::Result<u8> {
    output::check_free(&args.out, args.force)?;
    output::check_all_free(&args.split_out.path, args.force)?;
    let dataset = open_seen(&args.datasets, &args.view, None)?;
    let models = context.models()?;
    let settings = args.window.on(&args.model.settings);
    let request = fit_request(&args.model.name, &settings, &args.split, &models)?;
    let checkpoints = checkpoints(args);
    let cache = cache::of(&args.cache);
    let work = context.work(cache.as_ref());
    let kept = Some(checkpoints.clone());
    let fitted = match &args.task {
        Some(task) => fit_task(&dataset, task, request, kept, work)?,
        None => {
            let planned = Effort::of_fit(&dataset, &request)?;
            effort::print(&planned, &dataset, cache.as_ref(), context);
            fit_validated(&dataset, &request, kept, work)?
        }
    };
    cache::note(cache.as_ref(), context);
    fitted.model.save(&args.out)?;
    checkpoints.remove().with_context(|| {
        let path = shown(&checkpoints.path);
        format!("the model is written, but its checkpoint {path} cannot be removed")
    })?;
    if let Some(path) = &args.split_out.path {
        output::write(Some(path), |out| {
            serde_json::to_writer_pretty(&mut *out, &fitted.manifest)?;
            writeln!(out)
        })?;
    }
    let card = fitted.model.card();
    let chosen = [
        card.feature_choice.as_ref().map(ToString::to_string),
        card.auto.as_ref().map(ToString::to_string),
    ];
    for how in chosen.into_iter().flatten() {
        context.say(format_args!("{how}"));
    }
    output::write(None, |out| summary(&fitted, args, out))?;
    Ok(exit::DONE)
}

/// Settings of checkpoints, which are written next to the model file.
fn checkpoints(args: &Fit) -> Checkpoints {
    let mut path = args.out.clone().into_os_string();
    path.push(".checkpoint");
    Checkpoints {
        path: path.into(),
        every: Duration::from_secs(args.checkpoint_every),
        foreign: if args.force {
            Foreign::Replace
        } else {
            Foreign::Refuse
        },
    }
}

/// Prints the number of training samples, the chosen settings, and the path of the model file.
fn summary(fitted: &Fitted, args: &Fit, out: &mut dyn Write) -> io::Result<()> {
    let card = fitted.model.card();
    writeln!(out, "model    {} on {}", card.model, card.features)?;
    if let Some(task) = &card.provenance.task {
        let (name, names) = (shown(&task.name), task.labels());
        writeln!(
            out,
            "task     {name}: {names}, in clusters of {}",
            shown(&task.cluster)
        )?;
    }
    if !card.settings.is_empty() {
        writeln!(out, "settings {}", card.settings.join(" "))?;
    }
    let counts = &fitted.manifest.counts;
    let unused = match counts.left_out {
        0 => String::new(),
        count => format!(", left out {count}"),
    };
    writeln!(
        out,
        "split    {}, seed {}: train {}, validation {}, test {}{unused}",
        fitted.manifest.split, fitted.manifest.seed, counts.train, counts.validation, counts.test
    )?;
    if let Some(note) = fitted.manifest.note.as_ref().filter(|_| !unused.is_empty()) {
        writeln!(out, "note     {}", shown(note))?;
    }
    if let Some(validation) = &card.provenance.validation {
        writeln!(
            out,
            "validated by {}, seed {}: {}, each predicted by a model that had not seen its {}",
            validation.split,
            validation.seed,
            counted(validation.samples, "sample"),
            match groups_of(&validation.split) {
                FoldGroups::Samples => "own label".to_owned(),
                by => in_words(&by),
            }
        )?;
        let neighbours = validation.neighbours.as_deref();
        let neighbours = neighbours.filter(|words| words.contains(OPTIMISTIC));
        let standing = neighbours.and_then(|_| Standing::Neighbours.phrase());
        let standing = standing.map_or_else(String::new, |phrase| format!("  {phrase}"));
        if let Some(words) = neighbours {
            writeln!(out, "warning  {words}")?;
        }
        for score in &validation.scores {
            let interval = score.interval.map_or_else(String::new, |[low, high]| {
                format!("  ({low:.4} … {high:.4})")
            });
            let (metric, channel) = (&score.metric, &score.channel);
            writeln!(
                out,
                "  {metric} {channel}  {:.4}{interval}{standing}",
                score.value
            )?;
        }
    }
    if let Some(note) = fitted.divided.neighbours.as_ref().map(ToString::to_string)
        && note.contains(OPTIMISTIC)
    {
        writeln!(out, "warning  {note}")?;
    }
    let measured = measured_on(card.choice.by, &in_words(&left_out(fitted)));
    for (channel, choice) in card.channels.iter().zip(&card.choice.channels) {
        let setting = card.choice.setting.as_deref().zip(choice.value);
        let chosen =
            setting.map_or_else(String::new, |(name, value)| format!("  {name} {value:.3e}"));
        let error = choice.rmse.map_or_else(String::new, |rmse| {
            format!("  rmse {rmse:.4} {}{measured}", channel.unit)
        });
        let edge = if choice.at_edge {
            "  (at the edge of the tried range)"
        } else {
            ""
        };
        let constant = if channel.constant_label {
            "  (constant label)"
        } else {
            ""
        };
        writeln!(
            out,
            "channel  {}{chosen}{error}{edge}{constant}",
            channel.name
        )?;
    }
    if fitted.left_out > 0 {
        writeln!(
            out,
            "left out {} without a label or a frame: see `taceva check` (TAC011)",
            counted(fitted.left_out, "sample")
        )?;
    }
    writeln!(out, "wrote    {}", shown(&args.out))
}

/// Kind of groups that `split` leaves out as a whole.
fn groups_of(split: &str) -> FoldGroups {
    match split.parse::<SplitSpec>().map(|spec| spec.kind) {
        Ok(SplitKind::Folds(folds)) => folds.by,
        Ok(SplitKind::ByColumn(by)) => FoldGroups::Column(by.column),
        Ok(SplitKind::ByBlock) => FoldGroups::Blocks,
        Ok(SplitKind::LeaveOneRecordingOut) => FoldGroups::Recordings,
        _ => FoldGroups::Points,
    }
}

/// Kind of groups that the fit left out as a whole to choose settings: the kind of its cross-validation or split, otherwise contact points.
fn left_out(fitted: &Fitted) -> FoldGroups {
    let validation = fitted.model.card().provenance.validation.as_ref();
    let by = match (validation, &fitted.divided.groups) {
        (Some(validation), _) => groups_of(&validation.split),
        (None, Some(_)) => groups_of(&fitted.manifest.split),
        (None, None) => FoldGroups::Points,
    };
    match by {
        FoldGroups::Samples => FoldGroups::Points,
        by => by,
    }
}

/// Name of a group of the kind `by`.
fn in_words(by: &FoldGroups) -> String {
    match by {
        FoldGroups::Column(name) => format!("group of `{}`", shown(name)),
        FoldGroups::Blocks => "block of time".to_owned(),
        FoldGroups::Recordings => "recording".to_owned(),
        FoldGroups::Points | FoldGroups::Detected | FoldGroups::Samples => {
            "contact point".to_owned()
        }
    }
}

/// Name of the samples whose error decided the settings.
fn measured_on(by: ChosenBy, group: &str) -> String {
    match by {
        ChosenBy::Nobody | ChosenBy::Validation | ChosenBy::Likelihood => {
            ", on the part `validation`".to_owned()
        }
        ChosenBy::LeaveOneGroupOut => format!(", with each {group} left out in turn"),
        ChosenBy::LeaveOneOut => ", with each sample left out in turn".to_owned(),
        ChosenBy::TenFolds => ", with each of ten folds left out in turn".to_owned(),
    }
}
