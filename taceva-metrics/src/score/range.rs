//! Ranges of quantities.

/// Range of a quantity, which limits its intervals and determines their scale.
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
    /// Above 0: errors, areas, spreads. The limit for infinitely many samples is above 0.
    Positive,
    /// Above 0, and the maximum of several numbers, so without an interval. One sample, level or pair of channels determines a maximum, and
    /// resampling does not show its variation.
    Greatest,
    /// At least 0, with 0 possible even for infinitely many samples: a spread minus the part from chance.
    NotNegative,
    /// Below 1: R², the skill of a model.
    BelowOne,
    /// Between 0 and 1, both excluded even for infinitely many samples: a uniformity.
    Ratio,
    /// From 0 to 1, both included: a uniformity without the part from chance.
    RatioWithEnds,
    /// Between 0 and 2: a symmetric relative error.
    BelowTwo,
    /// Share of samples, from 0 to 1.
    Share,
}

impl Range {
    /// Least and greatest value; infinite on an unbounded side.
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
