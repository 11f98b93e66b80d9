//! Standing of scores in verdicts, the same rule for every output.
//!
//! A verdict is a claim: a bold face, a rank, a place on a radar, an answer of a comparison, a choice or an acceptance. A model that
//! predicts the same for every input has perfect repeatability, linearity and robustness to light. Its scores are valid numbers, but
//! no evidence.

use taceva_core::Field;

use crate::evaluate::entry::Entry;
use crate::evaluate::metric::Metric;
use crate::score::flag::Flag;
use crate::score::value::UndefinedReason;
use crate::score::verdict_rule::{OF_CONSTANT, VerdictRule};
use crate::score::verdict_standing::Standing;
use crate::score::{Interval, Score};

impl Standing {
    /// Standing of a score of `metric` computed from `channels`. `skill_of` returns the standing of a channel's skill.
    ///
    /// A metric of the truth alone always counts. A score of several channels gets the worst standing of these channels.
    pub fn of_channels<'a>(
        metric: &Metric,
        channels: impl IntoIterator<Item = &'a str>,
        skill_of: impl Fn(&str) -> Standing,
    ) -> Standing {
        if metric.needs.fields.contains(Field::PredictedSpacing) {
            // `of_share` decides where the share of the best constant prediction is known.
            return Standing::SkillUnknown;
        }
        if !metric.reads_predictions() {
            return Standing::Counts;
        }
        let standings = channels.into_iter().map(skill_of);
        standings.max().unwrap_or(Standing::SkillUnknown)
    }
}

/// Sets the standing of every score in `entries`, from the skill scores among them and from its own values and flags.
pub(crate) fn set_standings(entries: &mut [Entry]) {
    let skills: Vec<(String, Standing)> = entries
        .iter()
        .filter(|entry| entry.metric.verdict == VerdictRule::Skill)
        .map(|entry| (entry.channel.clone(), of_skill_score(&entry.score)))
        .collect();
    for entry in entries {
        let standing = of_score(entry.metric, &entry.channel, &entry.score, &skills);
        entry.score.standing = standing;
    }
}

fn of_skill_score(skill: &Score) -> Standing {
    Standing::of_value(low_end(skill), skill.value.scalar())
}

/// Lower end of the interval of a score; `None` without an interval. A value at an end of its range in every cluster is its own lower end.
fn low_end(score: &Score) -> Option<f64> {
    match score.interval {
        // A value at the end of its range in every cluster, as for a model without errors, is its own lower end.
        Interval::Undefined(UndefinedReason::AtEnd) => score.value.scalar(),
        interval => interval.ends().map(|[low, _]| low),
    }
}

/// Channels from which the score called `channel` is computed.
pub(crate) fn channels(channel: &str, score: &Score) -> Vec<String> {
    match score.of.is_empty() {
        true => vec![channel.to_owned()],
        false => score.of.clone(),
    }
}

fn of_score(
    metric: &Metric,
    channel: &str,
    score: &Score,
    skills: &[(String, Standing)],
) -> Standing {
    if metric.verdict == VerdictRule::Share {
        return of_share(score);
    }
    let channels = channels(channel, score);
    let of_channel = |name: &str| {
        let mut skills = skills.iter().rev();
        let found = skills.find(|(channel, _)| channel == name);
        found.map(|(_, standing)| *standing)
    };
    let skill = Standing::of_channels(metric, channels.iter().map(String::as_str), |name| {
        of_channel(name).unwrap_or(Standing::SkillUnknown)
    });
    let bounded = score
        .bounded_share
        .map_or(Standing::Counts, Standing::of_bounded_share);
    let stimulus = match score.flags.contains(&Flag::LowStimulus) {
        true => Standing::LowStimulus,
        false => Standing::Counts,
    };
    skill
        .max(bounded)
        .max(stimulus)
        .max(beside_constant(metric, score))
        .max(beside_chance(metric, score))
}

/// Standing of a score against chance. The interval of the variant that decides must exclude the metric's value under chance alone.
fn beside_chance(metric: &Metric, score: &Score) -> Standing {
    let (Some(chance), Some(name)) = (metric.chance, metric.decided_by) else {
        return Standing::Counts;
    };
    let interval = score.variant(name).and_then(|variant| variant.interval);
    let ends = interval.and_then(|interval| interval.ends());
    match ends {
        Some([low, high]) if low > chance || high < chance => Standing::Counts,
        _ if score.value.scalar().is_none() => Standing::Counts,
        _ => Standing::NotAboveNoiseFloor,
    }
}

/// Standing of a share within a tolerance: a score counts if its interval is above the share of a constant prediction. If this share is unknown,
/// skill alone decides.
fn beside_constant(metric: &Metric, score: &Score) -> Standing {
    match (metric.verdict, of_share(score)) {
        (VerdictRule::ShareBesideConstant, Standing::NoSkill) => Standing::NotAboveConstant,
        (VerdictRule::ShareBesideConstant, Standing::NoInterval) => Standing::NoInterval,
        _ => Standing::Counts,
    }
}

/// Standing of a share of correct predictions: the score shows skill if its interval is above the share of a constant prediction.
fn of_share(score: &Score) -> Standing {
    let of_constant = score
        .variant(OF_CONSTANT)
        .and_then(|variant| variant.value.scalar());
    match of_constant {
        None => Standing::SkillUnknown,
        Some(constant) => {
            let above = |share: f64| share - constant;
            Standing::of_value(low_end(score).map(above), score.value.scalar().map(above))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue;

    #[test]
    fn a_score_of_several_channels_has_the_worst_of_their_standings() {
        let skill_of = |name: &str| match name {
            "Px" => Standing::Counts,
            "Py" => Standing::NoSkill,
            _ => Standing::SkillUnknown,
        };
        let mae = catalogue::find("mae").expect("known");
        let of = |channels: &[&str]| Standing::of_channels(mae, channels.iter().copied(), skill_of);
        assert_eq!(of(&["Px"]), Standing::Counts);
        assert_eq!(of(&["Px", "Py"]), Standing::NoSkill);
        assert_eq!(of(&["Px", "Fz"]), Standing::SkillUnknown);
    }

    #[test]
    fn metrics_of_the_truth_alone_always_count() {
        let of_truth: Vec<&str> = catalogue::ALL
            .into_iter()
            .filter(|metric| {
                let standing = Standing::of_channels(metric, ["Pz"], |_| Standing::NoSkill);
                standing == Standing::Counts
            })
            .map(|metric| metric.id)
            .collect();
        let expected = [
            "sensitivity",
            "uniformity",
            "hysteresis",
            "inter_sensor",
            "intrinsic",
        ];
        assert_eq!(of_truth, expected);
    }

    #[test]
    fn robustness_alone_reads_predictions_beyond_the_bounds() {
        let unbounded = catalogue::ALL.into_iter();
        let unbounded = unbounded.filter(|metric| metric.reads_unbounded_predictions());
        let ids: Vec<&str> = unbounded.map(|metric| metric.id).collect();
        assert_eq!(ids, ["r_spatial", "r_light"]);
    }
}
