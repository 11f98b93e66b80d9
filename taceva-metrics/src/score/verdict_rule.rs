//! Rules for the standing of scores in verdicts.

/// Variant of a share: the share that the best constant prediction reaches.
pub(crate) const OF_CONSTANT: &str = "of_constant";

/// Rule for the standing of a metric's scores in verdicts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum VerdictRule {
    /// The skill of its channels.
    Channels,
    /// The score itself: it is the skill.
    Skill,
    /// The share of a constant prediction alone.
    Share,
    /// The skill of its channels and the share of a constant prediction.
    ShareBesideConstant,
}
