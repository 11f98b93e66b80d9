//! Runs the checks: collects the evidence, applies every check, and builds the report.

use std::num::NonZeroUsize;
use taceva_core::shown;

use taceva_core::{Field, Progress, SkipReason, Skipped, counted};
use taceva_dataset::{Dataset, Pass, RecordedSessions};

use crate::checks::{ALL, blank, damaged_frames, depth_maps, leakage, unseen_classes};
use crate::depth_facts::DepthFacts;
use crate::evidence::{Evidence, FrameFacts};
use crate::finding::{Check, CheckReport, Finding};
use crate::signal_facts::SignalFacts;
use taceva_evaluate::EvaluateError;
use taceva_evaluate::Plan;
use taceva_evaluate::{Divided, require_samples, scored_by_default, scored_of_task};

/// Options of a run of checks.
#[derive(Clone, Debug)]
pub struct CheckRequest {
    /// Codes or names of the checks to run; empty for all.
    pub only: Vec<String>,
    /// Split to check for leakage, in text form; `None` for the default split.
    pub split: Option<String>,
    /// Seed of the split.
    pub seed: u64,
    /// Number of threads.
    pub jobs: NonZeroUsize,
}

/// Planned steps of [`check`](fn@crate::check). Reads no frame.
///
/// # Errors
/// [`EvaluateError::Request`] for a code that does not exist.
pub fn check_plan(dataset: &Dataset, request: &CheckRequest) -> Result<Plan, EvaluateError> {
    let seen = dataset.views().first().map(|view| dataset.seen(view));
    let seen = seen.filter(|_| dataset.view().is_none()).transpose()?;
    let views = dataset.views().len().max(1);
    let dataset = seen.as_ref().unwrap_or(dataset);
    let (wanted, skipped) = wanted(dataset, &request.only)?;
    let mut plan = Plan {
        skipped,
        ..Plan::default()
    };
    plan.step(
        "read",
        format!(
            "{} of {}",
            counted(dataset.table().rows(), "row"),
            shown(&dataset.path())
        ),
    );
    if reads(dataset, &wanted, Field::Signals) {
        let rows = counted(dataset.table().rows(), "row");
        plan.step("read", format!("the signals of {rows}"));
    }
    if reads(dataset, &wanted, Field::Frame) {
        plan.step(
            "decode",
            counted(
                views * dataset.table().frames().iter().flatten().count(),
                "frame",
            ),
        );
    }
    for check in wanted {
        plan.step(
            "look",
            format!("{} {}: {}", check.code, check.name, check.looks_for),
        );
    }
    Ok(plan)
}

/// Checks `dataset` for defects, using the pictures of the selected view.
///
/// # Errors
/// [`EvaluateError`] if a code does not exist, the split cannot be made, or a frame is damaged.
pub(crate) fn check_seen(
    dataset: &Dataset,
    request: &CheckRequest,
    progress: &dyn Progress,
) -> Result<CheckReport, EvaluateError> {
    require_samples(dataset)?;
    let (mut wanted, mut skipped) = wanted(dataset, &request.only)?;
    let divided = match Divided::of(dataset, request.split.as_deref(), request.seed) {
        // No split was requested, and this recording has none: checks of splits are skipped.
        Err(EvaluateError::Split(error)) if request.split.is_none() => {
            wanted.retain(|check| {
                let reads_split = check.code == leakage::CHECK.code;
                if reads_split {
                    skipped.push(Skipped::new(
                        format!("check:{}", check.code),
                        SkipReason::NoSplit(error.to_string()),
                    ));
                }
                !reads_split
            });
            None
        }
        divided => Some(divided?),
    };
    let folds = match request.split {
        None => match scored_by_default(dataset, request.seed) {
            Err(EvaluateError::Split(_)) => None,
            folds => folds?,
        },
        Some(_) => None,
    };
    let (frames, reference) = if reads(dataset, &wanted, Field::Frame) {
        look(dataset, request.jobs, progress)?
    } else {
        Default::default()
    };
    let damaged = match wanted
        .iter()
        .any(|check| check.code == damaged_frames::CHECK.code)
    {
        true => damaged(dataset, request.jobs, progress)?,
        false => Vec::new(),
    };
    let signals = match reads(dataset, &wanted, Field::Signals) {
        true => SignalFacts::of(dataset, progress)?,
        false => None,
    };
    let reads_maps = wanted
        .iter()
        .any(|check| check.code == depth_maps::CHECK.code);
    let maps = match reads_maps {
        true => DepthFacts::of_tasks(dataset, progress)?,
        false => Vec::new(),
    };
    let sessions = RecordedSessions::of(dataset.path());
    let tasks = dataset.tasks().iter();
    let clusters: Vec<_> = tasks.map(|own| dataset.clusters_of(own.task())).collect();
    let of_tasks = match wanted
        .iter()
        .any(|check| check.code == unseen_classes::CHECK.code)
    {
        true => of_tasks(dataset, request, divided.as_ref())?,
        false => Vec::new(),
    };
    let evidence = Evidence {
        header: dataset.header(),
        table: dataset.table(),
        clusters: &clusters,
        divided: divided.as_ref(),
        is_split_named: request.split.is_some(),
        scored: folds.as_ref().or(divided.as_ref()),
        of_tasks: &of_tasks,
        frames: &frames,
        reference: reference.as_ref(),
        signals: signals.as_ref(),
        maps: &maps,
        damaged: &damaged,
        sessions: sessions.as_ref(),
    };
    let mut findings: Vec<Finding> = wanted
        .iter()
        .flat_map(|check| {
            (check.find)(&evidence)
                .into_iter()
                .map(|found| Finding::new(check, found))
        })
        .collect();
    // Stable, so that findings of one severity stay in the order of their codes.
    findings.sort_by_key(|finding| std::cmp::Reverse(finding.severity));
    Ok(CheckReport {
        schema: "taceva.check/1",
        dataset: dataset.digest().to_string(),
        samples: dataset.table().rows(),
        frames_decoded: frames.iter().flatten().count() as u64,
        looked_for: wanted.iter().map(|check| check.code).collect(),
        findings,
        skipped,
    })
}

/// Division used to score each task with classes. A task with a single cluster has no division and cannot be evaluated.
fn of_tasks(
    dataset: &Dataset,
    request: &CheckRequest,
    named: Option<&Divided>,
) -> Result<Vec<Option<Divided>>, EvaluateError> {
    let tasks = dataset.tasks().iter().map(|own| own.task());
    let divided = tasks.map(|task| match (&request.split, task.kind) {
        (Some(_), _) => Ok(named.cloned()),
        (None, kind) if !kind.has_classes() => Ok(None),
        (None, _) => match scored_of_task(dataset, task, request.seed) {
            Err(EvaluateError::Split(_) | EvaluateError::Request(_)) => Ok(None),
            divided => divided,
        },
    });
    divided.collect()
}

/// True if `dataset` has `field`, and any of `wanted` reads this field of every sample.
fn reads(dataset: &Dataset, wanted: &[&Check], field: Field) -> bool {
    let of_all = |check: &&&Check| check.code == blank::CHECK.code;
    let mut checks = wanted.iter();
    dataset.fields().contains(field)
        && checks.any(|check| check.reads == Some(field) || of_all(&check))
}

type Wanted = (Vec<&'static Check>, Vec<Skipped>);

fn wanted(dataset: &Dataset, only: &[String]) -> Result<Wanted, EvaluateError> {
    let is_called =
        |check: &Check, word: &str| check.code.eq_ignore_ascii_case(word) || check.name == word;
    if let Some(unknown) = only
        .iter()
        .find(|word| !ALL.iter().any(|check| is_called(check, word)))
    {
        let known: Vec<&str> = ALL.iter().map(|check| check.code).collect();
        return Err(EvaluateError::Request(format!(
            "unknown check `{}`, expected one of {}",
            shown(unknown),
            known.join(", ")
        )));
    }
    let fields = dataset.fields();
    let mut skipped = Vec::new();
    let mut skip =
        |check: &Check, reason| skipped.push(Skipped::new(format!("check:{}", check.code), reason));
    let mut kept = Vec::new();
    for check in ALL {
        if !only.is_empty() && !only.iter().any(|word| is_called(check, word)) {
            continue;
        }
        match check.reads.filter(|field| !fields.contains(*field)) {
            None => kept.push(check),
            // Missing taxels are mentioned only if a check of them was requested.
            Some(Field::Signals) if only.is_empty() => {}
            Some(absent) => skip(check, SkipReason::FieldAbsent(absent)),
        }
    }
    Ok((kept, skipped))
}

/// Rows whose pictures can be decoded although they are damaged, with a description of the damage.
fn damaged(
    dataset: &Dataset,
    jobs: NonZeroUsize,
    progress: &dyn Progress,
) -> Result<Vec<(usize, String)>, EvaluateError> {
    let rows = dataset.all_rows();
    let pass = Pass::new(&rows, jobs, progress);
    let mut damaged = Vec::new();
    dataset.map_rows(
        pass,
        "read to the end",
        |row| dataset.damage_inside(row),
        |row, found| {
            damaged.extend(found.map(|problem| (row, problem)));
            Ok(())
        },
    )?;
    Ok(damaged)
}

type Looked = (Vec<Option<FrameFacts>>, Option<FrameFacts>);

fn look(
    dataset: &Dataset,
    jobs: NonZeroUsize,
    progress: &dyn Progress,
) -> Result<Looked, EvaluateError> {
    let reference = dataset.reference()?;
    let framed = |row: &usize| dataset.table().frames()[*row].is_some();
    let rows: Vec<usize> = dataset.all_rows().into_iter().filter(framed).collect();
    let mut facts = vec![None; dataset.table().rows()];
    dataset.map_frames(
        Pass::new(&rows, jobs, progress),
        |_, frame| FrameFacts::of(&frame, reference.as_ref()),
        |row, found| {
            facts[row] = Some(found);
            Ok(())
        },
    )?;
    Ok((
        facts,
        reference.map(|reference| FrameFacts::of(&reference, None)),
    ))
}
