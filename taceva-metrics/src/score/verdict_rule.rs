//! Rules that decide whether verdicts include the scores of a metric.

/// Name of the variant with the share that a constant prediction reaches.
pub(crate) const OF_CONSTANT: &str = "of_constant";

/// Rule that decides whether verdicts include the scores of a metric.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum VerdictRule {
    /// The skill of the model on the channels of the score decides.
    Channels,
    /// The score itself decides, because it is the skill.
    Skill,
    /// The score must exceed the share of a constant prediction.
    Share,
    /// The skill of the model and the share of a constant prediction decide together.
    ShareBesideConstant,
}
