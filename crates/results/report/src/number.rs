//! Formats numbers with the digits that the interval supports, without negative zeros and rounding errors.

use taceva_core::Unit;

use taceva_results::{Interval, Score, Value};

/// Numbers below this limit are rounding errors of zero, in any unit.
const ROUNDING: f64 = 1e-12;
/// Number of decimals above which a small number is written with a power of ten.
const MOST: usize = 6;
/// Least number that is always written without a power of ten.
const SMALL: f64 = 1e-4;
/// Greatest number of additional decimals for an interval end that would otherwise print as 0.
const BEYOND: usize = 3;

/// Value and interval, formatted to the digits that the interval supports.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FormattedValue {
    /// Formatted value; empty without a value.
    pub value: String,
    /// Both formatted ends of the interval; `None` without an interval.
    pub interval: Option<[String; 2]>,
    /// Reason why the value or the interval is absent; `None` if no reason is known.
    pub reason: Option<String>,
}

impl FormattedValue {
    /// Formats `value` to a twentieth of the width of `interval`, or to four digits without an interval.
    pub fn of(value: &Value, interval: Option<&Interval>) -> FormattedValue {
        let Some(number) = value.number() else {
            return FormattedValue {
                reason: value.reason().or_else(|| Some(what(value).to_owned())),
                ..FormattedValue::default()
            };
        };
        let reason = match interval {
            Some(Interval::Absent(reason)) => Some(format!("none: {reason}")),
            _ => None,
        };
        FormattedValue {
            reason,
            ..FormattedValue::number(number, interval.and_then(Interval::ends))
        }
    }

    /// Formats a number to a twentieth of the width between `ends`, or to four digits if they are absent or equal.
    ///
    /// Numbers below 10⁻¹² are rounding errors and print as 0, and zeros have no minus sign. An end other than 0 never prints as 0: such an interval has up to
    /// three more decimals, or a power of ten.
    ///
    /// ```
    /// use taceva_report::FormattedValue;
    /// assert_eq!(FormattedValue::number(-0.001, Some([-0.2, 0.2])).phrase(" N"), "0.00 N (-0.20 … 0.20)");
    /// assert_eq!(FormattedValue::number(1.4e-17, None).phrase(" s"), "0 s");
    /// ```
    pub fn number(number: f64, ends: Option<[f64; 2]>) -> FormattedValue {
        let all = ends.into_iter().flatten().chain([number]);
        let greatest = all.map(f64::abs).fold(0.0, f64::max);
        // A width as small as a rounding error counts as absent.
        let widths = ends.map(|[low, high]| (high - low) / 20.0);
        let width = widths.filter(|width| *width > greatest * 1e-9);
        let step = width.unwrap_or(number / 1e3).abs();
        let fewest = match greatest < ROUNDING || step <= 0.0 {
            true => 0,
            false => decimals(step),
        };
        let print = |number: f64, decimals: usize| match decimals > MOST && greatest < SMALL {
            true => powered(number, decimals),
            false => fixed(number, decimals),
        };
        let hides_an_end = |decimals: usize| {
            let mut all = ends.into_iter().flatten();
            all.any(|end| end.abs() >= ROUNDING && is_zero(&print(end, decimals)))
        };
        let found = (fewest..=fewest + BEYOND).find(|decimals| !hides_an_end(*decimals));
        let decimals = found.unwrap_or(fewest);
        let print_end = |end: f64| match print(end, decimals) {
            text if end.abs() >= ROUNDING && is_zero(&text) => format!("{end:.0e}"),
            text => text,
        };
        FormattedValue {
            value: print(number, decimals),
            interval: ends.map(|ends| ends.map(print_end)),
            reason: None,
        }
    }

    /// Formats a number like [`FormattedValue::number`], with at most the decimals that its first `digits` digits need.
    pub(crate) fn short(number: f64, ends: Option<[f64; 2]>, digits: usize) -> FormattedValue {
        let full = FormattedValue::number(number, ends);
        let all = ends.into_iter().flatten().chain([number]);
        let greatest = all.map(f64::abs).fold(0.0, f64::max);
        let scale = if number.abs() < ROUNDING {
            greatest
        } else {
            number.abs()
        };
        let places = digits
            .try_into()
            .map_or(1.0, |digits| 10_f64.powi(digits) / 10.0);
        let most = (0..15).find(|&decimals| scale * 10_f64.powi(decimals) >= places * (1.0 - 1e-9));
        let most = most.map_or(15, i32_to_usize);
        let has = full
            .value
            .split_once('.')
            .map_or(0, |(_, decimals)| decimals.len());
        if has <= most || full.value.contains('e') {
            return full;
        }
        // An interval needs no more digits than its greater end.
        let greater = ends.into_iter().flatten().map(f64::abs).fold(0.0, f64::max);
        let coarse = |decimals: &i32| greater * 10_f64.powi(*decimals) >= places * (1.0 - 1e-9);
        let coarse = (0..15).find(coarse).map_or(most, i32_to_usize).min(most);
        let hides_an_end = |decimals: usize| {
            let mut all = ends.into_iter().flatten();
            all.any(|end| end.abs() >= ROUNDING && is_zero(&fixed(end, decimals)))
        };
        let coarse = (coarse..=most)
            .find(|decimals| !hides_an_end(*decimals))
            .unwrap_or(most);
        FormattedValue {
            value: fixed(number, most),
            interval: ends.map(|ends| ends.map(|end| fixed(end, coarse))),
            reason: None,
        }
    }

    /// Value, unit and interval in one phrase, `0.55 mm (0.34 … 0.76)`, or the reason why the value is absent.
    pub fn phrase(&self, unit: &str) -> String {
        match (&self.interval, &self.reason) {
            _ if self.value.is_empty() => self.reason.clone().unwrap_or_default(),
            (Some([low, high]), _) => format!("{}{unit} ({low} … {high})", self.value),
            (None, _) => format!("{}{unit}", self.value),
        }
    }
}

/// Score in one phrase: `0.55 mm (0.34 … 0.76)`, or the reason why the value is absent.
pub fn with_interval(score: &Score) -> String {
    FormattedValue::of(&score.value, score.interval.as_ref()).phrase(&spaced(score.unit))
}

/// Unit after a space, ` N`; empty for a ratio.
pub fn spaced(unit: Unit) -> String {
    match unit {
        Unit::One => String::new(),
        unit => format!(" {unit}"),
    }
}

/// Number with `decimals` decimals, without a minus sign if all digits are 0.
pub(crate) fn fixed(number: f64, decimals: usize) -> String {
    unsigned_zero(format!("{number:.decimals$}"))
}

/// Number with three digits, a typographic minus and no trailing zeros, for figures. Rounding errors become 0.
pub(crate) fn numeral(number: f64) -> String {
    match number.abs() < ROUNDING {
        true => "0".to_owned(),
        false => significant(number),
    }
}

/// Number with three significant digits at any magnitude, as for probabilities.
pub(crate) fn significant(number: f64) -> String {
    let size = number.abs();
    if size <= 0.0 {
        return "0".to_owned();
    }
    let text = if !(SMALL..1e5).contains(&size) {
        format!("{number:.2e}")
    } else {
        let decimals = (0..8).find(|&decimals| size * 10_f64.powi(decimals) >= 100.0);
        let text = fixed(number, decimals.map_or(8, i32_to_usize));
        // Zeros from rounding show precision: 0.9997 becomes 1.000, and 1 stays 1.
        let is_exact = text
            .parse::<f64>()
            .is_ok_and(|shown| (shown - number).abs() <= size * 1e-9);
        match is_exact && text.contains('.') {
            true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
            false => text,
        }
    };
    match text.strip_prefix('-') {
        Some(size) => format!("−{size}"),
        None => text,
    }
}

/// Replaces hyphens by the typographic minus.
pub(crate) fn minus(text: &str) -> String {
    text.replace('-', "−")
}

/// Number with a power of ten, rounded to `decimals` decimals.
fn powered(number: f64, decimals: usize) -> String {
    let zeros = (0..).find(|&zeros| number.abs() * 10_f64.powi(zeros) >= 1.0 || zeros > 12);
    let zeros = zeros.map_or(0, i32_to_usize);
    match decimals.checked_sub(zeros) {
        Some(digits) if number.abs() > 0.0 => unsigned_zero(format!("{number:.digits$e}")),
        _ => "0".to_owned(),
    }
}

fn unsigned_zero(text: String) -> String {
    match text.strip_prefix('-') {
        Some(size) if is_zero(size) => size.to_owned(),
        _ => text,
    }
}

/// True if all digits before a power of ten are zeros.
fn is_zero(text: &str) -> bool {
    let digits = text.split('e').next().unwrap_or_default();
    !digits.contains(|letter| ('1'..='9').contains(&letter))
}

fn i32_to_usize(number: i32) -> usize {
    number.unsigned_abs() as usize
}

fn what(value: &Value) -> &'static str {
    match value {
        Value::Map(_) => "a map: see --format json",
        Value::Curve(_) => "a curve: see --format json",
        Value::Matrix(_) => "a matrix: see --format json",
        _ => "",
    }
}

/// Number of decimals that resolve a step of `step`, from 0 to 15.
fn decimals(step: f64) -> usize {
    let found = (0..15).find(|&decimals| 10_f64.powi(-decimals) <= step);
    found.map_or(15, i32_to_usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn phrase(number: f64, ends: Option<[f64; 2]>) -> String {
        FormattedValue::number(number, ends).phrase("")
    }

    #[test]
    fn a_step_is_shown_with_the_decimals_it_needs() {
        assert_eq!(
            [20.0, 1.0, 0.5, 0.1, 0.0004, 0.0].map(decimals),
            [0, 0, 1, 1, 4, 15]
        );
    }

    #[test]
    fn a_short_number_has_no_more_digits_than_asked_for() {
        let short = |number, ends, digits| FormattedValue::short(number, ends, digits).phrase("");
        assert_eq!(
            short(0.036_12, Some([0.0354, 0.0371]), 3),
            "0.0361 (0.0354 … 0.0371)"
        );
        assert_eq!(
            short(0.036_12, Some([0.0354, 0.0371]), 2),
            "0.036 (0.035 … 0.037)"
        );
        assert_eq!(
            short(1069.3, Some([1069.1, 1069.5]), 3),
            "1069 (1069 … 1070)"
        );
        // A wide interval needs fewer digits than there is room for.
        assert_eq!(short(0.5, Some([-9.0, 10.0]), 3), "0.5 (-9.0 … 10.0)");
        assert_eq!(short(0.0, Some([-0.5, 0.5]), 2), "0.00 (-0.50 … 0.50)");
        assert_eq!(short(2.34e-7, None, 3), "2.340e-7");
        assert_eq!(
            short(0.009_14, Some([0.0055, 0.0152]), 2),
            "0.0091 (0.0055 … 0.0152)"
        );
    }

    #[test]
    fn no_minus_stands_before_a_zero() {
        assert_eq!(
            [-0.0, -0.004, 0.004].map(|number| fixed(number, 2)),
            ["0.00"; 3]
        );
        assert_eq!(fixed(-0.006, 2), "-0.01");
        assert_eq!(phrase(-0.002, Some([-0.5, 0.3])), "0.00 (-0.50 … 0.30)");
        assert_eq!(phrase(-0.0, None), "0");
        assert_eq!([-0.0, -1e-15, -0.02].map(numeral), ["0", "0", "−0.02"]);
    }

    #[test]
    fn what_rounding_leaves_of_zero_is_zero() {
        assert_eq!(phrase(1.4e-17, None), "0");
        assert_eq!(phrase(1.4e-17, Some([1.2e-17, 1.6e-17])), "0 (0 … 0)");
        assert_eq!(phrase(0.0, Some([-1e-15, 1e-15])), "0 (0 … 0)");
    }

    #[test]
    fn an_end_of_an_interval_that_is_not_zero_never_prints_as_zero() {
        assert_eq!(phrase(0.8, Some([0.02, 10.0])), "0.80 (0.02 … 10.00)");
        assert_eq!(
            phrase(-0.002, Some([-0.5, -0.001])),
            "-0.002 (-0.500 … -0.001)"
        );
        assert_eq!(phrase(40.0, Some([-80.0, -1e-7])), "40 (-80 … -1e-7)");
        assert_eq!(phrase(0.8, Some([0.0, 10.0])), "0.8 (0.0 … 10.0)");
    }

    #[test]
    fn an_interval_as_narrow_as_rounding_asks_for_no_digits() {
        assert_eq!(
            phrase(0.001, Some([0.001, 0.001 + 1e-18])),
            "0.001000 (0.001000 … 0.001000)"
        );
        assert_eq!(phrase(0.25, Some([0.25, 0.25])), "0.2500 (0.2500 … 0.2500)");
    }

    #[test]
    fn small_numbers_have_a_power_of_ten_and_others_none() {
        assert_eq!(
            phrase(2.34e-7, Some([2.1e-7, 2.6e-7])),
            "2.34e-7 (2.10e-7 … 2.60e-7)"
        );
        assert_eq!(
            phrase(2.34e-7, Some([-1e-9, 4.6e-7])),
            "2.34e-7 (-1e-9 … 4.60e-7)"
        );
        assert_eq!(
            phrase(0.012_345_67, Some([0.012_345_6, 0.012_345_8])),
            "0.01234567 (0.01234560 … 0.01234580)"
        );
        assert_eq!(phrase(6.53, Some([6.1, 6.9])), "6.53 (6.10 … 6.90)");
    }

    #[test]
    fn numerals_have_three_digits_and_no_idle_zeros() {
        let formatted = [0.0, 12.0, 0.5, -0.012_34, 1234.4, 0.000_01, -250_000.0].map(numeral);
        assert_eq!(
            formatted,
            ["0", "12", "0.5", "−0.0123", "1234", "1.00e-5", "−2.50e5"]
        );
        assert_eq!(
            [0.9961, 0.9997, 1.0, 9.96].map(numeral),
            ["0.996", "1.000", "1", "9.96"]
        );
        assert_eq!(significant(3e-20), "3.00e-20");
    }
}
