//! Which values a quantity can have at all.

/// Which values a quantity can have: what its intervals never leave, and on which scale they are formed.
///
/// ```
/// use taceva_metrics::Range;
/// assert!(Range::BelowOne.holds(-3.0) && !Range::BelowOne.holds(1.5));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Range {
    /// Any number: a mean error, a slope.
    Any,
    /// Above 0: errors, areas, spreads. Infinitely many samples would not give 0.
    Positive,
    /// Above 0, and the greatest of several numbers: one sample, level or pair of channels decides it, and resampling does not show
    /// how far it would move with others. It has no interval.
    Greatest,
    /// From 0 on, and 0 even of infinitely many samples: a spread from which chance was taken.
    NotNegative,
    /// Below 1: R², the skill of a model.
    BelowOne,
    /// Between 0 and 1, neither of which infinitely many samples would give: a uniformity.
    Ratio,
    /// From 0 to 1, both included: a uniformity from which chance was taken.
    RatioWithEnds,
    /// Between 0 and 2: a symmetric relative error.
    BelowTwo,
    /// A share of samples that were counted, from 0 to 1.
    Share,
}

impl Range {
    /// The least and the greatest value, infinite where there is none.
    #[must_use]
    pub fn ends(self) -> [f64; 2] {
        match self {
            Range::Any => [f64::NEG_INFINITY, f64::INFINITY],
            Range::Positive | Range::Greatest | Range::NotNegative => [0.0, f64::INFINITY],
            Range::BelowOne => [f64::NEG_INFINITY, 1.0],
            Range::Ratio | Range::RatioWithEnds | Range::Share => [0.0, 1.0],
            Range::BelowTwo => [0.0, 2.0],
        }
    }

    /// Whether `value` is one of them, or an end.
    #[must_use]
    pub fn holds(self, value: f64) -> bool {
        let [low, high] = self.ends();
        (low..=high).contains(&value)
    }
}
