//! Notes of a comparison for its reader.

use std::collections::{BTreeMap, BTreeSet};

use taceva_metrics::{Better, catalogue};
use taceva_results::{Interval, not_measured};

use super::{Answer, CompareRequest, comparability};
use crate::names::listed;
use crate::results::Study;
use crate::training::demonstration;

/// All notes. `unpaired` contains the reasons why predictions of the same truth were not compared sample by sample.
pub(super) fn notes(
    studies: &[Study],
    names: &[String],
    answers: &[Answer],
    unpaired: Vec<String>,
    request: &CompareRequest,
) -> Vec<String> {
    let demonstration = demonstration(studies);
    let is_asked = |metric: &str| {
        request.metrics.is_empty() || request.metrics.iter().any(|asked| asked == metric)
    };
    let skill = is_asked("skill").then(|| comparability::skill_note(studies, names));
    demonstration
        .map(|words| words.trim_end_matches('.').to_owned())
        .into_iter()
        .chain(skill.flatten())
        .chain(unmeasured(studies))
        .chain(without_intervals(studies, names, answers, is_asked))
        .chain(trainings(names, answers))
        .chain(unpaired)
        .chain(unknown(studies, request))
        .collect()
}

/// Notes on measured studies without a tested difference. Their scores of the metrics that `is_asked` selects all lack intervals for one reason.
fn without_intervals(
    studies: &[Study],
    names: &[String],
    answers: &[Answer],
    is_asked: impl Fn(&str) -> bool,
) -> Vec<String> {
    let mut by_reason: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    for (at, (study, name)) in studies.iter().zip(names).enumerate() {
        // Exact predictions have no interval, but are compared sample by sample.
        let is_tested = answers.iter().any(|answer| {
            answer.difference.is_some() && [answer.sides.a, answer.sides.b].contains(&at)
        });
        if is_tested || study.source == "published" {
            continue;
        }
        let scores = study.scores.iter().filter(|score| {
            score.value.number().is_some()
                && score.better() != Better::Described
                && is_asked(&score.metric)
        });
        let reasons: BTreeSet<Option<&str>> = scores
            .map(|score| match &score.interval {
                Some(Interval::Absent(reason)) => Some(reason.as_str()),
                _ => None,
            })
            .collect();
        if let (1, Some(Some(reason))) = (reasons.len(), reasons.first()) {
            by_reason.entry(*reason).or_default().push(name.clone());
        }
    }
    let notes = by_reason.into_iter().map(|(reason, names)| {
        let remedy = match comparability::is_of_clusters(reason) {
            true => {
                "; an interval needs at least five contact points or groups, or samples that are declared independent"
            }
            false => "",
        };
        format!(
            "no score of {} has an interval, so no difference is tested: {reason}{remedy}",
            listed(&names)
        )
    });
    notes.collect()
}

/// Note that samples are simulated, synthetic or of unknown origin; `None` if all are measured.
fn unmeasured(studies: &[Study]) -> Option<String> {
    let words = not_measured(studies.iter().map(|study| study.source.as_str()))?;
    Some(words.trim_end_matches('.').to_owned())
}

/// Note on metrics that are not compared, because their better direction is unknown.
fn unknown(studies: &[Study], request: &CompareRequest) -> Option<String> {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for study in studies {
        let metrics = study.scores.iter().map(|score| score.metric.as_str());
        let unknown = metrics.filter(|metric| catalogue::find(metric).is_none());
        for metric in unknown.collect::<BTreeSet<&str>>() {
            *counts.entry(metric).or_default() += 1;
        }
    }
    let shared = counts.into_iter().filter(|(_, count)| *count > 1);
    let shared: Vec<String> = shared.map(|(metric, _)| metric.to_owned()).collect();
    (request.metrics.is_empty() && !shared.is_empty()).then(|| {
        format!(
            "{} not compared: this version of TacEva does not know which values are better",
            listed(&shared)
        )
    })
}

/// Note on differences that depend on a single training of a model with a random seed. Names the option for more seeds.
fn trainings(names: &[String], answers: &[Answer]) -> Option<String> {
    let shown = answers.iter().filter(|answer| answer.better().is_some());
    let drawn: BTreeSet<&str> = shown.flat_map(|answer| answer.drawn(names)).collect();
    let drawn: Vec<String> = drawn.into_iter().map(str::to_owned).collect();
    (!drawn.is_empty()).then(|| {
        format!(
            "differences come from one training of {}: another seed changes them, and no interval includes this variation. For scenes, repeat `taceva run` with --seeds 1-3. For recordings, evaluate with --set seed=2 too",
            listed(&drawn)
        )
    })
}
