//! Rules by which scores take part in verdicts.

/// The variant of a share that says what the best constant prediction would reach.
pub(crate) const OF_CONSTANT: &str = "of_constant";

/// What decides whether scores of a metric take part in verdicts.
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
