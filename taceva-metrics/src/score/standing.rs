//! Whether a score takes part in verdicts: the one rule that every output asks and none repeats.
//!
//! A verdict is a claim: a bold face, a rank, a place on a radar, an answer of a comparison, a choice or an acceptance. A model that
//! answers the same whatever it sees repeats itself perfectly, follows a line without an error and is moved by no light: its scores
//! are numbers, and claim nothing.

use std::fmt;

use taceva_core::Field;

use crate::evaluate::evaluation::Entry;
use crate::families::resolution::OF_CONSTANT;
use crate::metric::{Formula, Metric};
use crate::score::flag::Flag;
use crate::score::value::UndefinedReason;
use crate::score::{Interval, Score};

/// The share of predictions brought back to their bounds from which on a score is of the bounds rather than of the model.
pub const GREATEST_BOUNDED_SHARE: f64 = 0.05;

/// Up to here a skill is rounding: predictions that equal the constant but for their last bits reach 10⁻¹⁵.
const ROUNDING: f64 = 1e-9;

/// Whether a score takes part in verdicts, and if not, why; of two, the greater one is the worse.
///
/// ```
/// use taceva_metrics::Standing;
/// assert!(Standing::SkillUnknown.takes_part() && !Standing::NoSkill.takes_part());
/// assert_eq!(Standing::ALL.into_iter().max(), Some(Standing::NoSkill));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Standing {
    /// It takes part.
    #[default]
    Counts,
    /// It takes part and is marked: nothing shows whether the model does better than a constant.
    SkillUnknown,
    /// It takes no part: more than [`GREATEST_BOUNDED_SHARE`] of its predictions lie beyond the bounds of the model.
    Bounded,
    /// It takes no part: in some scene the light hardly changed, so that its robustness to light says little.
    LowStimulus,
    /// It takes no part: a share of good answers whose interval does not lie above the share that the constant of the skill score reaches,
    /// though the model may be nearer in the mean square.
    NotAboveConstant,
    /// It takes no part: the model is not shown to do better than a constant.
    NoSkill,
}

impl Standing {
    /// Every standing, the best first.
    pub const ALL: [Standing; 6] = [
        Standing::Counts,
        Standing::SkillUnknown,
        Standing::Bounded,
        Standing::LowStimulus,
        Standing::NotAboveConstant,
        Standing::NoSkill,
    ];

    /// Whether a score of this standing takes part in verdicts.
    pub fn takes_part(self) -> bool {
        matches!(self, Standing::Counts | Standing::SkillUnknown)
    }

    /// The words for it in every output; none where a score simply counts.
    ///
    /// ```
    /// use taceva_metrics::Standing;
    /// assert_eq!(Standing::NoSkill.words(), Some("no skill"));
    /// assert_eq!(Standing::Counts.words(), None);
    /// ```
    pub fn words(self) -> Option<&'static str> {
        match self {
            Standing::Counts => None,
            Standing::SkillUnknown => Some("skill unknown"),
            Standing::Bounded => Some("bounded"),
            Standing::LowStimulus => Some("low stimulus"),
            Standing::NotAboveConstant => Some("not above the constant"),
            Standing::NoSkill => Some("no skill"),
        }
    }

    /// The standing that is said in `words`.
    pub fn from_words(words: &str) -> Option<Standing> {
        let mut said = Standing::ALL.into_iter();
        said.find(|standing| standing.words() == Some(words))
    }

    /// Why a score of this standing takes no part, in a sentence; none where it does.
    pub fn reason(self) -> Option<&'static str> {
        match self {
            Standing::Counts | Standing::SkillUnknown => None,
            Standing::Bounded => {
                Some("bounded: more than 5 % of its predictions lie beyond the bounds of the model")
            }
            Standing::LowStimulus => Some("low stimulus: in some scene the light hardly changed"),
            Standing::NotAboveConstant => Some(
                "not above the constant: its interval does not lie above the share that a constant answer reaches",
            ),
            Standing::NoSkill => {
                Some("no skill: the model is not shown to do better than a constant")
            }
        }
    }

    /// What a skill score says whose interval of 95 % begins at `low`.
    ///
    /// Without an interval there is no evidence, and a verdict needs evidence: no skill is shown then.
    pub fn of_skill(low: Option<f64>) -> Standing {
        match low {
            Some(low) if low > ROUNDING => Standing::Counts,
            _ => Standing::NoSkill,
        }
    }

    /// What a share of predictions that were, or would have been, brought back to the bounds of the model says.
    pub fn of_bounded_share(share: f64) -> Standing {
        match share > GREATEST_BOUNDED_SHARE {
            true => Standing::Bounded,
            false => Standing::Counts,
        }
    }

    /// The standing of a score of `metric` that is made of `channels`, whose skill is what `skill_of` says of each.
    ///
    /// Metrics of the truth alone always count; a score of several channels has the worst of their standings.
    pub fn of_channels<'a>(
        metric: &Metric,
        channels: impl IntoIterator<Item = &'a str>,
        skill_of: impl Fn(&str) -> Standing,
    ) -> Standing {
        if metric.needs.fields.contains(Field::PredictedSpacing) {
            // Whoever knows the share of the best constant answer says more.
            return Standing::SkillUnknown;
        }
        if !metric.reads_predictions() {
            return Standing::Counts;
        }
        let standings = channels.into_iter().map(skill_of);
        standings.max().unwrap_or(Standing::SkillUnknown)
    }
}

impl fmt::Display for Standing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.words().unwrap_or("counts"))
    }
}

impl Metric {
    /// Whether predictions of channels enter it.
    pub fn reads_predictions(&self) -> bool {
        self.needs.fields.contains(Field::Prediction)
    }

    /// Whether it reads predictions as the model gives them, and not brought back to the bounds of the model: robustness would be that of
    /// the bounds otherwise.
    pub fn reads_unbounded_predictions(&self) -> bool {
        matches!(self.formula, Formula::Spatial | Formula::Lighting)
    }
}

/// Gives each of `entries` the standing that the skill scores and the bounded shares among them determine.
pub(crate) fn judge(entries: &mut [Entry]) {
    let skills: Vec<(String, Standing)> = entries
        .iter()
        .filter(|entry| matches!(entry.metric.formula, Formula::Skill))
        .map(|entry| (entry.channel.clone(), of_skill_score(&entry.score)))
        .collect();
    for entry in entries {
        let standing = of_score(entry.metric, &entry.channel, &entry.score, &skills);
        entry.score.standing = standing;
    }
}

fn of_skill_score(skill: &Score) -> Standing {
    Standing::of_skill(low_end(skill))
}

/// Where the interval of a score begins.
fn low_end(score: &Score) -> Option<f64> {
    match score.interval {
        // A model that errs nowhere leaves nothing that could vary.
        Interval::Undefined(UndefinedReason::AtEnd) => score.value.scalar(),
        interval => interval.ends().map(|[low, _]| low),
    }
}

/// The channels that a score called `channel` is made of.
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
    if matches!(metric.formula, Formula::Resolution) {
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
    let of_tolerance = match metric.formula {
        Formula::Tolerance => match of_share(score) {
            Standing::NoSkill => Standing::NotAboveConstant,
            // Without a constant that is known, skill alone decides.
            _ => Standing::Counts,
        },
        _ => Standing::Counts,
    };
    let is_low = score.flags.contains(&Flag::LowStimulus);
    let light = if is_low {
        Standing::LowStimulus
    } else {
        Standing::Counts
    };
    [skill, bounded, of_tolerance, light]
        .into_iter()
        .max()
        .unwrap_or_default()
}

/// A share of right answers shows skill where its interval lies above what a constant answer would reach.
fn of_share(score: &Score) -> Standing {
    let of_constant = score
        .variant(OF_CONSTANT)
        .and_then(|variant| variant.value.scalar());
    match of_constant {
        None => Standing::SkillUnknown,
        Some(constant) => Standing::of_skill(low_end(score).map(|low| low - constant)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue;

    #[test]
    fn the_words_of_a_standing_lead_back_to_it() {
        for standing in Standing::ALL {
            let back = standing.words().and_then(Standing::from_words);
            assert_eq!(back, standing.words().map(|_| standing));
        }
        assert_eq!(Standing::from_words("counts"), None);
    }

    #[test]
    fn what_takes_no_part_has_a_reason_and_what_does_has_none() {
        for standing in Standing::ALL {
            assert_eq!(standing.reason().is_none(), standing.takes_part());
        }
    }

    #[test]
    fn an_interval_that_begins_at_zero_shows_no_skill_and_none_at_all_neither() {
        let said = [Some(-0.1), Some(0.0), Some(1e-12), Some(0.001), None].map(Standing::of_skill);
        let (none, some) = (Standing::NoSkill, Standing::Counts);
        assert_eq!(said, [none, none, none, some, none]);
    }

    #[test]
    fn five_percent_are_not_yet_bounded() {
        assert_eq!(Standing::of_bounded_share(0.05), Standing::Counts);
        assert_eq!(Standing::of_bounded_share(0.0501), Standing::Bounded);
    }

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
