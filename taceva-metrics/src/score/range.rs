//! Ranges of the values that a score can have.

/// Range of the possible values of a score. Intervals stay within the range, and the range determines their scale.
///
/// ```
/// use taceva_metrics::Range;
/// assert!(Range::BelowOne.holds(-3.0) && !Range::BelowOne.holds(1.5));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Range {
    /// Any number, such as a mean error or a slope.
    Any,
    /// Above 0, also in the limit of infinitely many samples: errors, areas, spreads.
    Positive,
    /// Above 0, but without an interval, because the value is the maximum of several numbers. Resampling does not show the variation of a maximum.
    Greatest,
    /// At least 0. The value can be 0 even for infinitely many samples, such as a spread minus the part from chance.
    NotNegative,
    /// Below 1, such as R² or the skill of a model.
    BelowOne,
    /// Between 0 and 1, without either end even for infinitely many samples, such as a uniformity.
    Ratio,
    /// From 0 to 1, both included: a uniformity without the part from chance.
    RatioWithEnds,
    /// Between 0 and 2: a symmetric relative error.
    BelowTwo,
    /// Share of samples, from 0 to 1.
    Share,
}

impl Range {
    /// Lower and upper end of the range; infinite on an unbounded side.
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
