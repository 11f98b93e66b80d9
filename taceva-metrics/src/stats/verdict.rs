//! What a comparison says, in words.

use std::fmt;

use taceva_core::Unit;

use super::difference::Difference;
use super::error::ComparisonError;
use super::sides::Side;
use crate::metric::Better;

/// How seldom chance may look like an answer: what the intervals of 95 % leave.
const LEVEL: f64 = 0.05;

/// What is asked of a difference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Question {
    /// The unit of the scores.
    pub unit: Unit,
    /// Which scores are good.
    pub better: Better,
    /// How far apart scores may be and still count as equal for the purpose, in `unit`; without it equivalence is not asked.
    pub margin: Option<f64>,
}

/// What a comparison says, at a level of 5 %.
///
/// ```
/// use taceva_core::Unit;
/// use taceva_metrics::{Better, Estimate, Question, Side, Sides, Verdict, welch};
/// let difference = welch(Sides {
///     a: Estimate::try_new(0.041, 0.0024, 32)?,
///     b: Estimate::try_new(0.053, 0.0032, 32)?,
/// });
/// let question = Question { unit: Unit::Newton, better: Better::Lower, margin: None };
/// let verdict = Verdict::of(difference, question);
/// assert_eq!(verdict.to_string(), "A lower by 0.012 N (95 % 0.004…0.020, p = 0.004)");
/// assert_eq!(verdict.better(), Some(Side::A));
/// # Ok::<(), taceva_metrics::ComparisonError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Verdict {
    /// The scores differ.
    Differs {
        /// By how much.
        difference: Difference,
        /// The unit of the scores.
        unit: Unit,
        /// Which one is better; none if that is a matter of nearness to zero and they lie on both sides of it.
        better: Option<Side>,
    },
    /// They may be equal, and may differ by anything inside the interval.
    NoDifferenceShown {
        /// By how much they differ here.
        difference: Difference,
        /// The unit of the scores.
        unit: Unit,
    },
    /// They are so near to each other that it makes no difference, even where a difference can be shown.
    Equivalent {
        /// By how much they differ here.
        difference: Difference,
        /// The unit of the scores.
        unit: Unit,
        /// What was allowed.
        margin: f64,
        /// The p value of being further apart than that.
        p: f64,
    },
    /// There is no answer.
    Undefined(ComparisonError),
}

impl Verdict {
    /// The answer that `difference` gives to `question`.
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
        if let Some(margin) = question.margin {
            let p = difference.equivalence_p(margin)?;
            if p < LEVEL {
                return Ok(Verdict::Equivalent {
                    difference,
                    unit,
                    margin,
                    p,
                });
            }
        }
        if difference.p < LEVEL {
            return Ok(Verdict::Differs {
                difference,
                unit,
                better: better(&difference, question.better),
            });
        }
        Ok(Verdict::NoDifferenceShown { difference, unit })
    }

    /// Which one is shown to be better.
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

impl fmt::Display for Verdict {
    /// `A lower by 0.012 N (95 % 0.004…0.020, p = 0.003)`
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Verdict::Differs {
                difference, unit, ..
            } => {
                let [low, high] = difference.interval;
                let (direction, [low, high]) = if difference.value < 0.0 {
                    ("lower", [-high, -low])
                } else {
                    ("higher", [low, high])
                };
                let decimals = decimals(high - low);
                let size = number(difference.value.abs(), decimals);
                let [low, high] = [low, high].map(|end| number(end, decimals));
                let (unit, p) = (suffix(*unit), p_value(difference.p));
                write!(f, "A {direction} by {size}{unit} (95 % {low}…{high}, {p})")
            }
            Verdict::NoDifferenceShown { difference, unit } => {
                let [low, high] = difference.interval;
                let decimals = decimals(high - low);
                let numbers = [difference.value, low, high].map(|value| number(value, decimals));
                let ([value, low, high], unit) = (numbers, suffix(*unit));
                write!(
                    f,
                    "no difference shown (difference {value}{unit}, 95 % {low}…{high})"
                )
            }
            Verdict::Equivalent { unit, margin, .. } => {
                write!(f, "equivalent within {margin}{}", suffix(*unit))
            }
            Verdict::Undefined(error) => write!(f, "no answer: {error}"),
        }
    }
}

/// ` N`, or nothing for a ratio.
fn suffix(unit: Unit) -> String {
    match unit {
        Unit::One => String::new(),
        unit => format!(" {unit}"),
    }
}

/// The fewest decimals, up to 12, whose last is at most a tenth of `width`.
fn decimals(width: f64) -> usize {
    let mut place = 1.0;
    for decimals in 0..12 {
        if place <= width / 10.0 {
            return decimals;
        }
        place /= 10.0;
    }
    12
}

/// With a true minus sign, and none before a zero.
fn number(value: f64, decimals: usize) -> String {
    let size = format!("{:.decimals$}", value.abs());
    let zero = size.bytes().all(|byte| matches!(byte, b'0' | b'.'));
    let sign = if value < 0.0 && !zero { "−" } else { "" };
    format!("{sign}{size}")
}

fn p_value(p: f64) -> String {
    if p < 0.001 {
        "p < 0.001".to_owned()
    } else {
        format!("p = {p:.3}")
    }
}
