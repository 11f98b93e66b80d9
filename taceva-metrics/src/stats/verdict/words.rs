//! Answer of a comparison in words, with a number of digits that suits the width of the interval.

use std::fmt;

use taceva_core::Unit;

use super::Verdict;
use crate::stats::p_value::p_words;
use crate::stats::sides::{Side, Sides};

impl Verdict {
    /// Answer in words, with the names of both sides: `GelSight better by 0.012 N (95 % 0.004…0.020, p = 0.003)`.
    ///
    /// The p value is adjusted for the family, and the interval belongs to the same decision.
    pub fn words(&self, names: Sides<&str>) -> String {
        match self {
            Verdict::Differs {
                difference,
                unit,
                better,
            } => {
                let p = p_words(difference.adjusted_p);
                let level = percent(difference.confidence);
                let [low, high] = difference.interval;
                let decimals = decimals(&[low, high], difference.value);
                let said = |value: f64| apart(value, decimals);
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
                let value = apart(difference.value, decimals);
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
    /// Answer in words, with the names A and B: `A better by 0.012 N (95 % 0.004…0.020, p = 0.003)`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.words(Sides { a: "A", b: "B" }))
    }
}

/// Confidence as text, such as `95 %` or `99.72 %`. The digits suffice for a relative error of at most 5 % in 100 % − confidence.
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

/// Unit after a number, such as ` N`; empty for a ratio.
fn suffix(unit: Unit) -> String {
    match unit {
        Unit::One => String::new(),
        unit => format!(" {unit}"),
    }
}

/// Fewest decimals, up to 12, whose last place is at most a tenth of an interval's width. An asymmetric interval has twice the distance from the
/// value to its nearer end as width, an infinite interval the magnitude of the value. If a nonzero end would print as 0 and contradict the verdict,
/// up to three decimals are added.
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
    let nearer = 2.0 * (high - value).min(value - low);
    let width = match (high - low).is_finite() {
        true if nearer > 0.0 => nearer,
        true => high - low,
        false => value.abs(),
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

/// Number as text with a true minus sign; zero has no sign.
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

/// True if all digits of `text` are zeros.
fn is_zero(text: &str) -> bool {
    text.bytes().all(|byte| matches!(byte, b'0' | b'.'))
}

/// Difference as text. A nonzero difference gets enough decimals to show one digit, for any width of its interval.
fn apart(value: f64, decimals: usize) -> String {
    let mut texts = (decimals..=12).map(|decimals| number(value, decimals));
    let shown = texts.find(|text| !is_zero(text));
    shown.unwrap_or_else(|| number(value, decimals))
}

/// End of an interval as text. A value too small for `decimals` is written with a power of ten.
fn end(value: f64, decimals: usize) -> String {
    match number(value, decimals) {
        text if value.abs() > 1e-12 && is_zero(&text) => format!("{value:.0e}").replace('-', "−"),
        text => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_difference_that_is_not_zero_never_prints_as_zero() {
        let shown = |interval: [f64; 2], value: f64| apart(value, decimals(&interval, value));
        assert_eq!(shown([-32.0, 70.0], -0.0898), "−0.1");
        assert_eq!(shown([-32.0, 70.0], 9.8), "10");
        assert_eq!(shown([-32.0, 70.0], 0.0), "0");
    }

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
        assert_eq!(ends([-0.9, 11.6], 0.487), ["−0.9", "11.6"]);
        assert_eq!(ends([0.02, f64::INFINITY], 0.8), ["0.02", "∞"]);
    }
}
