//! Rules for the standing of scores in verdicts.

/// Variant with the share that the best constant prediction reaches.
pub(crate) const OF_CONSTANT: &str = "of_constant";

/// Rule for the standing of a metric's scores in verdicts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum VerdictRule {
    /// Skill of the channels.
    Channels,
    /// The score itself, which is the skill.
    Skill,
    /// Share of a constant prediction.
    Share,
    /// Skill of the channels and share of a constant prediction.
    ShareBesideConstant,
}
