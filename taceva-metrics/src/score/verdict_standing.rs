//! Standing of a score: whether the score takes part in verdicts, and if not, the reason.

use std::fmt;

/// Greatest share of predictions beyond the bounds of a model. Above this share, a score describes the bounds instead of the model.
const GREATEST_BOUNDED_SHARE: f64 = 0.05;

/// Greatest skill that rounding alone may cause. Predictions that equal the constant except for rounding have a skill near 10⁻¹⁵.
const ROUNDING: f64 = 1e-9;

/// Standing of a score: whether the score takes part in verdicts, and if not, the reason. Standings are ordered from best to worst.
///
/// ```
/// use taceva_metrics::Standing;
/// assert!(Standing::SkillUnknown.takes_part() && !Standing::NoSkill.takes_part());
/// assert_eq!(Standing::ALL.into_iter().max(), Some(Standing::NoSkill));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Standing {
    /// Included in verdicts.
    #[default]
    Counts,
    /// Included in verdicts, with a mark: no evidence that the model is better than a constant prediction.
    SkillUnknown,
    /// Excluded from verdicts: more than 5 % of the predictions are beyond the bounds of the model.
    Bounded,
    /// Excluded from verdicts: test samples resemble training samples.
    Neighbours,
    /// Excluded from verdicts: the light of a scene, or the labels of repeated presses, hardly changed.
    LowStimulus,
    /// Excluded from verdicts: the interval contains the value expected by chance alone.
    NotAboveNoiseFloor,
    /// Excluded from verdicts: the score is a share, and its interval is not above the share of a constant prediction. The model may still have the
    /// smaller mean squared error.
    NotAboveConstant,
    /// Excluded from verdicts: the skill is above zero, but no interval shows that this is more than chance.
    NoInterval,
    /// Excluded from verdicts: the model is not shown to be better than a constant.
    NoSkill,
}

impl Standing {
    /// Every standing, best first.
    pub const ALL: [Standing; 9] = [
        Standing::Counts,
        Standing::SkillUnknown,
        Standing::Bounded,
        Standing::Neighbours,
        Standing::LowStimulus,
        Standing::NotAboveNoiseFloor,
        Standing::NotAboveConstant,
        Standing::NoInterval,
        Standing::NoSkill,
    ];

    /// True if a score of this standing takes part in verdicts.
    pub fn takes_part(self) -> bool {
        matches!(self, Standing::Counts | Standing::SkillUnknown)
    }

    /// Short name for files and programs; `None` for [`Standing::Counts`]. [`Standing::phrase`] returns words for readers.
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
            Standing::Neighbours => Some("neighbours in training"),
            Standing::LowStimulus => Some("low stimulus"),
            Standing::NotAboveNoiseFloor => Some("not above its noise floor"),
            Standing::NotAboveConstant => Some("not above the constant"),
            Standing::NoInterval => Some("skill not known: no interval"),
            Standing::NoSkill => Some("no skill"),
        }
    }

    /// Words for readers, printed next to a value; `None` for [`Standing::Counts`].
    ///
    /// ```
    /// use taceva_metrics::Standing;
    /// assert_eq!(Standing::NoSkill.phrase(), Some("not better than predicting the mean"));
    /// assert_eq!(Standing::Counts.phrase(), None);
    /// ```
    pub fn phrase(self) -> Option<&'static str> {
        match self {
            Standing::Counts => None,
            Standing::SkillUnknown => Some("not tested against predicting the mean"),
            Standing::Bounded => Some("predictions beyond the trained range"),
            Standing::Neighbours => Some("tested on neighbours of training samples"),
            Standing::LowStimulus => Some("stimulus hardly changed"),
            Standing::NotAboveNoiseFloor => Some("not above chance"),
            Standing::NotAboveConstant => Some("not above a constant answer"),
            Standing::NoInterval => Some("no interval to compare with predicting the mean"),
            Standing::NoSkill => Some("not better than predicting the mean"),
        }
    }

    /// Standing with these `words`; `None` for other text.
    pub fn from_words(words: &str) -> Option<Standing> {
        let mut said = Standing::ALL.into_iter();
        said.find(|standing| standing.words() == Some(words))
    }

    /// Reason for the exclusion of a score, as a sentence; `None` for an included score.
    pub fn reason(self) -> Option<&'static str> {
        match self {
            Standing::Counts | Standing::SkillUnknown => None,
            Standing::Bounded => Some(
                "predictions beyond the trained range: more than 5 % of them exceed the bounds of the model",
            ),
            Standing::Neighbours => Some(
                "tested on neighbours of training samples: tested samples resemble them, so the score is too good",
            ),
            Standing::LowStimulus => Some(
                "stimulus hardly changed: the light of some scene, or the labels of repeated presses, was almost constant",
            ),
            Standing::NotAboveNoiseFloor => Some(
                "not above chance: with this number of samples, the differences between places may be chance",
            ),
            Standing::NotAboveConstant => Some(
                "not above a constant answer: the interval of the score is not better than the score of one constant answer, such as the mean of the training labels",
            ),
            Standing::NoInterval => Some(
                "no interval to compare with predicting the mean: too few contact points were scored, or nothing varied between them",
            ),
            Standing::NoSkill => Some(
                "not better than predicting the mean: the skill of the model is not shown to be above zero",
            ),
        }
    }

    /// Step that may include the score in verdicts, as a sentence; `None` for an included score. With `is_cross_validated`, the step does not propose
    /// cross-validation.
    ///
    /// ```
    /// use taceva_metrics::Standing;
    /// let steps = [false, true].map(|is_cross_validated| Standing::NoSkill.remedy(is_cross_validated));
    /// assert!(steps[0].is_some_and(|step| step.contains("--split cv:5")));
    /// assert_eq!(steps[1], Some("More contact points would narrow the interval of the score."));
    /// assert_eq!(Standing::Counts.remedy(false), None);
    /// ```
    pub fn remedy(self, is_cross_validated: bool) -> Option<&'static str> {
        match self {
            Standing::Counts | Standing::SkillUnknown => None,
            Standing::NoSkill | Standing::NotAboveConstant => Some(match is_cross_validated {
                true => "More contact points would narrow the interval of the score.",
                false => {
                    "More contact points, or a score of every point (--split cv:5), would narrow the interval of the score."
                }
            }),
            Standing::NoInterval => Some(match is_cross_validated {
                true => {
                    "An interval needs five contact points: name them by `point_id`, or pass --independent if no two samples share a press."
                }
                false => {
                    "An interval needs five contact points: name them by `point_id`, score every point (--split cv:5), or pass \
                        --independent if no two samples share a press."
                }
            }),
            Standing::NotAboveNoiseFloor => {
                Some("More presses at each place would narrow the interval of the differences.")
            }
            Standing::Neighbours => Some(
                "Leave --split out, in `taceva fit` too: the default keeps neighbours together.",
            ),
            Standing::LowStimulus => Some("Use stronger light, or presses that differ more."),
            Standing::Bounded => Some("Fit the model on a wider range of labels."),
        }
    }

    /// Standing of a skill score whose 95 % interval starts at `low`.
    ///
    /// Without an interval (`None`) there is no evidence for or against skill, and a verdict needs evidence.
    ///
    /// ```
    /// use taceva_metrics::Standing;
    /// assert_eq!(Standing::of_skill(Some(0.25)), Standing::Counts);
    /// assert_eq!(Standing::of_skill(Some(-0.25)), Standing::NoSkill);
    /// assert_eq!(Standing::of_skill(None), Standing::NoInterval);
    /// ```
    pub fn of_skill(low: Option<f64>) -> Standing {
        match low {
            Some(low) if low > ROUNDING => Standing::Counts,
            Some(_) => Standing::NoSkill,
            None => Standing::NoInterval,
        }
    }

    /// Like [`of_skill`](Standing::of_skill), for a score with a `value`. A value of zero or less shows no skill, with or without an
    /// interval.
    ///
    /// ```
    /// use taceva_metrics::Standing;
    /// assert_eq!(Standing::of_value(None, Some(0.9)), Standing::NoInterval);
    /// assert_eq!(Standing::of_value(None, Some(-0.1)), Standing::NoSkill);
    /// ```
    pub fn of_value(low: Option<f64>, value: Option<f64>) -> Standing {
        Standing::of_skill(low.or(value.filter(|value| *value <= ROUNDING)))
    }

    /// Standing of a score with this `share` of predictions beyond the bounds of the model.
    pub(crate) fn of_bounded_share(share: f64) -> Standing {
        match share > GREATEST_BOUNDED_SHARE {
            true => Standing::Bounded,
            false => Standing::Counts,
        }
    }
}

impl fmt::Display for Standing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.words().unwrap_or("counts"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_words_of_a_standing_lead_back_to_it() {
        for standing in Standing::ALL {
            let back = standing.words().and_then(Standing::from_words);
            assert_eq!(back, standing.words().map(|_| standing));
        }
        assert_eq!(Standing::from_words("counts"), None);
    }

    #[test]
    fn what_takes_no_part_has_a_reason_that_begins_with_its_phrase() {
        for standing in Standing::ALL {
            assert_eq!(standing.reason().is_none(), standing.takes_part());
            let phrase = standing.phrase().unwrap_or_default();
            assert_eq!(phrase.is_empty(), standing == Standing::Counts);
            for is_cross_validated in [false, true] {
                let remedy = standing.remedy(is_cross_validated);
                assert_eq!(remedy.is_none(), standing.takes_part());
                let asks = remedy.is_some_and(|step| step.contains("cv:5"));
                assert!(!(asks && is_cross_validated), "{standing}");
            }
            let reason = standing.reason();
            assert!(reason.is_none_or(|reason| reason.starts_with(&format!("{phrase}: "))));
        }
    }

    #[test]
    fn a_remedy_names_the_quantity_that_it_changes() {
        for standing in Standing::ALL {
            for remedy in
                [false, true].map(|is_cross_validated| standing.remedy(is_cross_validated))
            {
                let words = remedy.unwrap_or_default();
                assert!(!words.ends_with(" this."), "{words}");
            }
        }
        let remedy = Standing::NoSkill.remedy(false).unwrap_or_default();
        assert!(
            remedy.ends_with("narrow the interval of the score."),
            "{remedy}"
        );
    }

    #[test]
    fn an_interval_that_begins_at_zero_shows_no_skill_and_without_one_it_is_not_known() {
        let said = [Some(-0.1), Some(0.0), Some(1e-12), Some(0.001), None].map(Standing::of_skill);
        let (none, some) = (Standing::NoSkill, Standing::Counts);
        assert_eq!(said, [none, none, none, some, Standing::NoInterval]);
        let of_values = [Some(0.9), Some(0.0), Some(-2.0), None];
        let said = of_values.map(|value| Standing::of_value(None, value));
        let unknown = Standing::NoInterval;
        assert_eq!(said, [unknown, none, none, unknown]);
    }

    #[test]
    fn five_percent_are_not_yet_bounded() {
        assert_eq!(Standing::of_bounded_share(0.05), Standing::Counts);
        assert_eq!(Standing::of_bounded_share(0.0501), Standing::Bounded);
    }
}
