//! Answers to comparisons of two scores.

mod words;

use taceva_core::Unit;

use super::difference::Difference;
use super::error::ComparisonError;
use super::sides::Side;
use crate::score::direction::Better;

/// Question about the difference of two scores.
///
/// ```
/// use taceva_metrics::{Better, Question, Unit};
/// let question = Question::new(Unit::Newton, Better::Lower).with_margin(0.01);
/// assert_eq!(question.margin, Some(0.01));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Question {
    /// The unit of the scores.
    pub unit: Unit,
    /// Direction in which a score is better.
    pub better: Better,
    /// Margin of equivalence, in `unit`: equivalent scores differ by less. `None` without a test of equivalence.
    pub margin: Option<f64>,
}

impl Question {
    /// Asks which of two scores in `unit` is better, without a test of equivalence.
    pub const fn new(unit: Unit, better: Better) -> Question {
        Question {
            unit,
            better,
            margin: None,
        }
    }

    /// The same question, with a test of equivalence within [`margin`](Question::margin).
    #[must_use]
    pub fn with_margin(self, margin: impl Into<Option<f64>>) -> Question {
        Question {
            margin: margin.into(),
            ..self
        }
    }
}

/// Answer to a comparison at the level of 5 %. For several comparisons in one family, call [`decide`](crate::decide) on the differences first.
///
/// ```
/// use taceva_metrics::{Better, Estimate, Question, Side, Sides, Unit, Verdict, by_intervals};
/// let difference = by_intervals(Sides {
///     a: Estimate::try_new(0.041, 0.0024, 32)?,
///     b: Estimate::try_new(0.053, 0.0032, 32)?,
/// });
/// let question = Question::new(Unit::Newton, Better::Lower);
/// let verdict = Verdict::of(difference, question);
/// assert_eq!(verdict.to_string(), "A better by 0.012 N (95 % 0.004…0.020, p = 0.005)");
/// assert_eq!(verdict.better(), Some(Side::A));
/// # Ok::<(), taceva_metrics::ComparisonError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Verdict {
    /// The scores differ.
    Differs {
        /// Difference of the scores.
        difference: Difference,
        /// The unit of the scores.
        unit: Unit,
        /// Better side. `None` if the metric has no better direction. Also `None` if values near zero are better, and the scores have opposite signs.
        better: Option<Side>,
    },
    /// No difference is shown: the true difference may be any value in the interval.
    NoDifferenceShown {
        /// Observed difference.
        difference: Difference,
        /// The unit of the scores.
        unit: Unit,
    },
    /// The scores are shown to differ by less than the margin, even if the difference is also shown to be nonzero.
    Equivalent {
        /// Observed difference.
        difference: Difference,
        /// The unit of the scores.
        unit: Unit,
        /// Margin of equivalence, which is greater than both ends of the interval in magnitude.
        margin: f64,
    },
    /// No answer, with the reason.
    Undefined(ComparisonError),
}

impl Verdict {
    /// Answer to `question` from a tested difference.
    pub fn of(difference: Result<Difference, ComparisonError>, question: Question) -> Verdict {
        match difference {
            Ok(difference) => {
                Verdict::of_difference(difference, question).unwrap_or_else(Verdict::Undefined)
            }
            Err(error) => Verdict::Undefined(error),
        }
    }

    fn of_difference(
        difference: Difference,
        question: Question,
    ) -> Result<Verdict, ComparisonError> {
        let unit = question.unit;
        if let Some(margin) = question.margin
            && difference.is_within(margin)?
        {
            return Ok(Verdict::Equivalent {
                difference,
                unit,
                margin,
            });
        }
        if difference.is_shown {
            return Ok(Verdict::Differs {
                better: better(&difference, question.better),
                difference,
                unit,
            });
        }
        Ok(Verdict::NoDifferenceShown { difference, unit })
    }

    /// Side shown to be better; `None` if no side is.
    pub fn better(&self) -> Option<Side> {
        match self {
            Verdict::Differs { better, .. } => *better,
            _ => None,
        }
    }
}

fn better(difference: &Difference, better: Better) -> Option<Side> {
    let (lower, higher) = if difference.value < 0.0 {
        (Side::A, Side::B)
    } else {
        (Side::B, Side::A)
    };
    let [a, b] = [difference.scores.a, difference.scores.b];
    match better {
        Better::Lower => Some(lower),
        Better::Higher => Some(higher),
        Better::NearZero if a >= 0.0 && b >= 0.0 => Some(lower),
        Better::NearZero if a <= 0.0 && b <= 0.0 => Some(higher),
        Better::NearZero | Better::Described => None,
    }
}
