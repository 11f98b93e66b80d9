//! Guesses the unit of a column of times.

use super::{Role, are_counts};

/// Lower limit of times since 1970, s; a day in 2001.
const UNIX_S: f64 = 1e9;
/// Upper limit of present times since 1970, s; a day in 2039.
const UNIX_END_S: f64 = 2.2e9;
/// Maximum step between rows with times since 1970, s.
const UNIX_STEP_S: f64 = 3_600.0;

/// Time units, each with the number of units per second.
const UNITS: [(&str, f64); 4] = [("ns", 1e9), ("us", 1e6), ("ms", 1e3), ("s", 1.0)];

/// Role of a time column. The unit follows from the last word of the name, from the magnitude of present Unix times, or from the step between rows.
pub(super) fn time(words: &[String], numbers: &[f64]) -> Role {
    let greatest = numbers.iter().copied().fold(0.0_f64, f64::max);
    let named = match words.last().map(String::as_str) {
        Some("ns" | "nsec" | "nanoseconds") => Some("ns"),
        Some("us" | "usec" | "microseconds") => Some("us"),
        Some("ms" | "msec" | "milliseconds") => Some("ms"),
        Some("s" | "sec" | "secs" | "seconds") => Some("s"),
        _ => None,
    };
    let guessed = || guessed_unit(numbers, greatest);
    let (unit, guess) = named.map_or_else(guessed, |unit| (unit, None));
    let second = UNITS.iter().find(|(known, _)| *known == unit);
    let second = second.map_or(1.0, |(_, second)| *second);
    Role::Time {
        unit,
        is_unix: greatest / second > UNIX_S,
        guess,
    }
}

/// Guessed unit for times without a stated unit, with the reason why the unit may be different.
fn guessed_unit(numbers: &[f64], greatest: f64) -> (&'static str, Option<&'static str>) {
    let step = median_step(numbers);
    let of_now = UNITS.iter().find(|(_, second)| {
        (UNIX_S..UNIX_END_S).contains(&(greatest / second))
            && step.is_none_or(|step| step / second <= UNIX_STEP_S)
    });
    if let Some((unit, _)) = of_now {
        return (*unit, None);
    }
    match step {
        Some(step) if step >= 1e6 => ("ns", Some("a guess: the times are millions apart")),
        Some(step) if step > 2_000.0 => ("us", Some("a guess: the times are thousands apart")),
        Some(step) if step >= 2.0 => (
            "ms",
            Some(
                "a guess: the times are 2 to 2000 apart, and rows are rarely that many seconds apart",
            ),
        ),
        Some(_) if are_counts(numbers) => (
            "?",
            Some("whole numbers that are 1 apart: seconds or counts?"),
        ),
        Some(_) => ("s", None),
        None => ("s", Some("a guess: a single time does not show its unit")),
    }
}

/// True for the time at which a recorder wrote a message, in contrast to the time of the measurement.
pub(crate) fn is_logged(name: &str) -> bool {
    name.starts_with("log_time") || name.starts_with("publish_time")
}

/// Median of the positive steps between `numbers` after sorting; `None` without such a step.
pub(crate) fn median_step(numbers: &[f64]) -> Option<f64> {
    let mut sorted = numbers.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let steps = sorted.windows(2).map(|pair| pair[1] - pair[0]);
    let mut steps: Vec<f64> = steps.filter(|step| *step > 0.0).collect();
    steps.sort_unstable_by(f64::total_cmp);
    steps.get(steps.len() / 2).copied()
}

#[cfg(test)]
mod tests {
    use super::super::role;
    use super::*;

    #[test]
    fn the_unit_of_times_without_one_is_guessed_by_the_median_step() {
        let unit = |first: f64, step: f64| {
            let times: Vec<String> = (0..30)
                .map(|row| format!("{}", first + step * f64::from(row)))
                .collect();
            match role("timestamp", "", &times) {
                Role::Time {
                    unit,
                    is_unix,
                    guess,
                } => (unit, is_unix, guess.is_some()),
                other => panic!("{other:?} for a step of {step}"),
            }
        };
        assert_eq!(unit(0.0, 33.0), ("ms", false, true));
        assert_eq!(unit(0.0, 4.0), ("ms", false, true));
        assert_eq!(unit(0.0, 33_333.0), ("us", false, true));
        assert_eq!(unit(0.0, 33_333_333.0), ("ns", false, true));
        assert_eq!(unit(0.0, 0.03125), ("s", false, false));
        // Seconds from 1970 in each unit.
        assert_eq!(unit(1.7e9, 0.03125), ("s", true, false));
        assert_eq!(unit(1.7e9, 30.0), ("s", true, false));
        assert_eq!(unit(1.7e12, 33.0), ("ms", true, false));
        assert_eq!(unit(1.7e15, 33_333.0), ("us", true, false));
        assert_eq!(unit(1.7e18, 33_333_504.0), ("ns", true, false));
        // Seconds or counts: the numbers do not decide.
        assert_eq!(unit(0.0, 1.0).0, "?");
        assert_eq!(median_step(&[3.0, 1.0, 1.0, 2.0]), Some(1.0));
        assert_eq!(median_step(&[1.0]), None);
    }
}
