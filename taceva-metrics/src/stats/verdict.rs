//! What a comparison says, in words.

use std::fmt;

use taceva_core::Unit;

use super::difference::Difference;
use super::error::ComparisonError;
use super::sides::{Side, Sides};
use crate::score::better::Better;

/// What is asked of a difference.
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
    /// Which scores are good.
    pub better: Better,
    /// How far apart scores may be and still count as equal for the purpose, in `unit`; without it equivalence is not asked.
    pub margin: Option<f64>,
}

impl Question {
    /// Which of two scores in `unit` is better, without asking for equivalence.
    pub const fn new(unit: Unit, better: Better) -> Question {
        Question {
            unit,
            better,
            margin: None,
        }
    }

    /// The same question, and whether the scores are equal within [`margin`](Question::margin).
    #[must_use]
    pub fn with_margin(self, margin: impl Into<Option<f64>>) -> Question {
        Question {
            margin: margin.into(),
            ..self
        }
    }
}

/// What a comparison says, at a level of 5 %, of a difference that [`decide`](crate::decide) decided about among those of its family.
///
/// ```
/// use taceva_core::Unit;
/// use taceva_metrics::{Better, Estimate, Question, Side, Sides, Verdict, welch};
/// let difference = welch(Sides {
///     a: Estimate::try_new(0.041, 0.0024, 32)?,
///     b: Estimate::try_new(0.053, 0.0032, 32)?,
/// });
/// let question = Question::new(Unit::Newton, Better::Lower);
/// let verdict = Verdict::of(difference, question);
/// assert_eq!(verdict.to_string(), "A better by 0.012 N (95 % 0.004…0.020, p = 0.004)");
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
        /// What was allowed: the interval lies within it.
        margin: f64,
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

impl Verdict {
    /// What it says of two that have names: `GelSight better by 0.012 N (95 % 0.004…0.020, p = 0.003)`.
    ///
    /// The p value is the adjusted one, and the interval that of the same decision.
    pub fn words(&self, names: Sides<&str>) -> String {
        match self {
            Verdict::Differs {
                difference,
                unit,
                better,
            } => {
                let p = p_value(difference.adjusted_p);
                let level = percent(difference.confidence);
                let [low, high] = difference.interval;
                let decimals = decimals(&[low, high], difference.value);
                let said = |value: f64| number(value, decimals);
                let unit = suffix(*unit);
                let Some(better) = better else {
                    let (value, low, high) = (
                        said(difference.value),
                        end(low, decimals),
                        end(high, decimals),
                    );
                    let Sides { a, b } = names;
                    return format!(
                        "{a} and {b} differ by {value}{unit} ({level} {low}…{high}, {p})"
                    );
                };
                let size = said(difference.value.abs());
                let [low, high] = if difference.value < 0.0 {
                    [-high, -low]
                } else {
                    [low, high]
                };
                let (low, high) = (end(low, decimals), end(high, decimals));
                let word = match better {
                    Side::A => "better",
                    Side::B => "worse",
                };
                format!(
                    "{} {word} by {size}{unit} ({level} {low}…{high}, {p})",
                    names.a
                )
            }
            Verdict::NoDifferenceShown { difference, unit } => {
                let [low, high] = difference.interval;
                let decimals = decimals(&[low, high], difference.value);
                let value = number(difference.value, decimals);
                let [low, high] = [low, high].map(|of| end(of, decimals));
                let unit = suffix(*unit);
                let level = percent(difference.confidence);
                format!("no difference shown (difference {value}{unit}, {level} {low}…{high})")
            }
            Verdict::Equivalent { unit, margin, .. } => {
                format!("equivalent within {margin}{}", suffix(*unit))
            }
            Verdict::Undefined(error) => format!("no answer: {error}"),
        }
    }
}

impl fmt::Display for Verdict {
    /// `A better by 0.012 N (95 % 0.004…0.020, p = 0.003)`
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.words(Sides { a: "A", b: "B" }))
    }
}

/// `95 %`, `99.72 %`: with as many digits as tell the rest of 100 to a twentieth of it.
fn percent(share: f64) -> String {
    let rest = 100.0 * (1.0 - share);
    let mut places = 1.0;
    for decimals in 0..6 {
        let rounded = (rest * places).round() / places;
        if (rounded - rest).abs() <= rest / 20.0 {
            return format!("{:.decimals$} %", 100.0 * share);
        }
        places *= 10.0;
    }
    format!("{:.6} %", 100.0 * share)
}

/// ` N`, or nothing for a ratio.
fn suffix(unit: Unit) -> String {
    match unit {
        Unit::One => String::new(),
        unit => format!(" {unit}"),
    }
}

/// The fewest decimals, up to 12, whose last is at most a tenth of the width of an interval; of one without ends, of the value. Up to three
/// more where an end that is not 0 would print as 0: the interval would contradict what is shown.
fn decimals(ends: &[f64; 2], value: f64) -> usize {
    let fewest = decimals_of_width(ends, value);
    let hides_an_end = |decimals: usize| {
        let mut ends = ends.iter();
        ends.any(|end| end.abs() > 1e-12 && is_zero(&number(*end, decimals)))
    };
    let found = (fewest..=fewest + 3).find(|decimals| !hides_an_end(*decimals));
    found.unwrap_or(fewest)
}

fn decimals_of_width([low, high]: &[f64; 2], value: f64) -> usize {
    let width = if (high - low).is_finite() {
        high - low
    } else {
        value.abs()
    };
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
    if value.is_infinite() {
        return if value < 0.0 { "−∞" } else { "∞" }.to_owned();
    }
    let size = format!("{:.decimals$}", value.abs());
    let sign = if value < 0.0 && !is_zero(&size) {
        "−"
    } else {
        ""
    };
    format!("{sign}{size}")
}

/// Whether it shows no digit but zeros.
fn is_zero(text: &str) -> bool {
    text.bytes().all(|byte| matches!(byte, b'0' | b'.'))
}

/// An end of an interval: what not even `decimals` show has a power of ten.
fn end(value: f64, decimals: usize) -> String {
    match number(value, decimals) {
        text if value.abs() > 1e-12 && is_zero(&text) => format!("{value:.0e}").replace('-', "−"),
        text => text,
    }
}

fn p_value(p: f64) -> String {
    if p < 0.001 {
        "p < 0.001".to_owned()
    } else {
        format!("p = {p:.3}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_end_of_an_interval_that_is_not_zero_never_prints_as_zero() {
        let ends = |interval: [f64; 2], value: f64| {
            let decimals = decimals(&interval, value);
            interval.map(|of| end(of, decimals))
        };
        assert_eq!(ends([0.02, 1.5], 0.8), ["0.02", "1.50"]);
        assert_eq!(ends([-1.5, -0.004], -0.8), ["−1.500", "−0.004"]);
        assert_eq!(ends([-1e-7, 1.5], 0.8), ["−1e−7", "1.5"]);
        assert_eq!(ends([0.0, 1.5], 0.8), ["0.0", "1.5"]);
        assert_eq!(ends([0.02, f64::INFINITY], 0.8), ["0.02", "∞"]);
    }
}
