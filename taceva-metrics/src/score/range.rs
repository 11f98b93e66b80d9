//! Range of the values of a quantity.

/// Range of the values of a quantity, which bounds its intervals and determines their scale.
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
    /// Above 0: errors, areas, spreads. Infinitely many samples do not give 0.
    Positive,
    /// Above 0, and the greatest of several numbers, so without an interval. One sample, level or pair of channels determines it, and
    /// resampling does not show its variation.
    Greatest,
    /// From 0, and 0 possible even for infinitely many samples: a spread without its part by chance.
    NotNegative,
    /// Below 1: R², the skill of a model.
    BelowOne,
    /// Between 0 and 1, which infinitely many samples would not reach: a uniformity.
    Ratio,
    /// From 0 to 1, both included: a uniformity without its part by chance.
    RatioWithEnds,
    /// Between 0 and 2: a symmetric relative error.
    BelowTwo,
    /// Share of counted samples, from 0 to 1.
    Share,
}

impl Range {
    /// Least and greatest value; infinite without a bound.
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

    /// True if `value` is in the range or at one of its ends.
    #[must_use]
    pub fn holds(self, value: f64) -> bool {
        let [low, high] = self.ends();
        (low..=high).contains(&value)
    }
}
