//! Decides whether two scores are comparable, by their standing and by the samples that demonstrate skill.

use std::collections::BTreeSet;

use taceva_metrics::{Sides, Standing};

use crate::names::listed;
use crate::results::Study;
use taceva_results::{Interval, Score};

/// Reason why verdicts exclude one of two scores, such as `ViTacTip: not better than predicting the mean: …`; `None` if both take part.
pub(super) fn barred(scores: Sides<&Score>, names: Sides<&str>) -> Option<String> {
    let sides = [(scores.a, names.a), (scores.b, names.b)];
    let reasons: Vec<String> = sides
        .into_iter()
        .filter_map(|(score, name)| match score.standing.reason() {
            Some(reason) => Some(match &score.interval {
                Some(Interval::Absent(why))
                    if score.standing == Standing::NoInterval && is_of_clusters(why) =>
                {
                    let phrase = score.standing.phrase().unwrap_or(reason);
                    format!("{name}: {phrase}: {why}")
                }
                _ => format!("{name}: {reason}"),
            }),
            None => of_one_pair(score).map(|reason| format!("{reason} ({name})")),
        })
        .collect();
    (!reasons.is_empty()).then(|| reasons.join("; "))
}

/// True if an interval is absent for `reason` because of the contact points or groups, and not because of the metric.
pub(super) fn is_of_clusters(reason: &str) -> bool {
    reason.contains("cluster") || reason.contains("point_id")
}

/// Reason why numbers of a catalogue give no verdict: they have different samples or definitions.
pub(super) fn of_other_samples(scores: Sides<&Score>, studies: Sides<&Study>) -> Option<String> {
    let samples = [studies.a, studies.b].map(|study| study.made.samples_digest.as_deref());
    let [of_a, of_b] = samples;
    if samples == [None, None] {
        return None;
    }
    if of_a != of_b {
        let words =
            "the scores are from different samples, so they are shown side by side and not ranked";
        return Some(words.to_owned());
    }
    let [own, other] = [scores.a, scores.b].map(|score| score.definition.as_str());
    (own != other).then(|| format!("the definitions `{own}` and `{other}` differ"))
}

/// Reason why a difference between units gives no verdict: one pair of units does not represent other units.
fn of_one_pair(score: &Score) -> Option<&'static str> {
    let pairs = score.counts.iter().find(|(name, _)| name == "pairs_valid");
    pairs
        .filter(|(_, pairs)| *pairs < 2)
        .map(|_| "only one pair of units was compared")
}

/// Note that the skill of the studies comes from different samples; `None` if the samples are equal.
pub(super) fn skill_note(studies: &[Study], names: &[String]) -> Option<String> {
    let shown: Vec<(&str, String)> = studies
        .iter()
        .zip(names)
        .filter(|(study, _)| study.of_metric("skill").next().is_some())
        .map(|(study, name)| (name.as_str(), ground(study)))
        .collect();
    let grounds: BTreeSet<&str> = shown.iter().map(|(_, ground)| ground.as_str()).collect();
    (grounds.len() > 1).then(|| {
        let each: Vec<String> = shown
            .iter()
            .map(|(name, ground)| format!("{name} on {ground}"))
            .collect();
        format!(
            "skill was measured on different test parts: {}",
            listed(&each)
        )
    })
}

/// Description of the samples that demonstrate the skill of a study.
fn ground(study: &Study) -> String {
    let of = |key: &str| study.stated(key);
    let samples = study.tested_count();
    let data = of("dataset").map(|digest| {
        let short: String = digest.chars().take(SHORT).collect();
        format!("of {short}")
    });
    let split = of("split").map(|split| format!("split {split}"));
    let seed = of("seed").map(|seed| format!("seed {seed}"));
    let part = of("part").map(|part| format!("part {part}"));
    // Predictions always differ, so the description has the digest of the truth.
    let truth = study.made.truth.as_ref().map(|digest| {
        let short: String = digest.chars().take(SHORT).collect();
        format!("of the truth {short}")
    });
    let tables = truth.or_else(|| {
        of("tables").map(|tables| {
            let short: String = tables.chars().take(TABLES).collect();
            format!("of tables {short}…")
        })
    });
    let all = [samples, data, tables, split, seed, part];
    all.into_iter().flatten().collect::<Vec<_>>().join(", ")
}

/// Length of a shortened digest: `sha256:` and twelve digits.
const SHORT: usize = 19;

/// Length of a shortened list of tables: the first table with twelve digits of its digest.
const TABLES: usize = 40;
