//! The spread of labels of sensors: where labels vary little, errors in units are small.

use taceva_core::Unit;

use crate::number::{numeral, spaced};
use crate::results::Study;

/// Metrics whose values follow the spread of the labels.
const OF_ERRORS: [&str; 4] = ["mae", "mae_euclid", "rmse", "r_spatial"];
/// Spreads that differ by a greater factor are reported.
const ALIKE: f64 = 2.0;

/// ` (their labels differ in spread: 0.047 N to 0.174 N)`, where errors of those studies that are at `which` are compared and the labels of
/// one spread more than twice as far as those of another; else nothing.
pub(crate) fn words(studies: &[Study], which: &[usize], metric: &str, channel: &str) -> String {
    let compared = which.iter().filter_map(|at| studies.get(*at));
    let units: Vec<Unit> = compared
        .clone()
        .filter_map(|study| Some(study.score(metric, channel)?.unit))
        .collect();
    let Some(unit) = units.first().filter(|unit| **unit != Unit::One) else {
        return String::new();
    };
    let spreads = compared.filter_map(|study| spread(study, channel));
    match crate::figure::extent(spreads) {
        Some([low, high]) if OF_ERRORS.contains(&metric) && high > ALIKE * low => {
            let [low, high] = [low, high].map(|of| format!("{}{}", numeral(of), spaced(*unit)));
            format!(" (their labels differ in spread: {low} to {high})")
        }
        _ => String::new(),
    }
}

/// The channels and planes of `channels` whose labels spread differently, in a sentence for below a table: `Labels differ in spread between
/// the sensors (Fxy 0.047 N to 0.174 N): …`; none where all are alike.
pub(crate) fn note(studies: &[Study], channels: &[&str]) -> Option<String> {
    let all: Vec<usize> = (0..studies.len()).collect();
    let differing = channels.iter().filter_map(|channel| {
        let words = words(studies, &all, "mae", channel);
        let range = words.rsplit_once(": ")?.1.strip_suffix(')')?;
        Some(format!("{channel} {range}"))
    });
    let differing: Vec<String> = differing.collect();
    (!differing.is_empty()).then(|| {
        format!(
            "Labels differ in spread between the sensors ({}): errors in units, repeatability, spatial robustness and shares within a tolerance follow it.",
            differing.join("; ")
        )
    })
}

/// How far the labels of a channel or plane lie about the constant that skill is measured by: the root mean square error over √(1 − skill).
/// Without them, about their mean, from the samples.
fn spread(study: &Study, channel: &str) -> Option<f64> {
    let number = |metric: &str| study.score(metric, channel)?.value.number();
    let skill = number("skill").or_else(|| number("r2"));
    let said = number("rmse").zip(skill).and_then(|(rmse, skill)| {
        let spread = rmse / (1.0 - skill).sqrt();
        (spread.is_finite() && spread > 0.0).then_some(spread)
    });
    said.or_else(|| of_samples(study, channel))
}

/// The standard deviation of the labels of a channel over the calibration.
fn of_samples(study: &Study, channel: &str) -> Option<f64> {
    let samples = study.samples.as_ref()?;
    let labels = samples.channel(channel)?;
    let rows = samples.of_protocol("calibration").into_iter();
    let truths: Vec<f64> = rows
        .filter_map(|row| labels.pair(row))
        .map(|[truth, _]| truth)
        .collect();
    let count = truths.iter().fold(0.0, |count, _| count + 1.0);
    let mean = truths.iter().sum::<f64>() / count;
    let squares: f64 = truths.iter().map(|truth| (truth - mean).powi(2)).sum();
    let spread = (squares / count).sqrt();
    (spread.is_finite() && spread > 0.0).then_some(spread)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A study with a root mean square error and a skill of shear.
    fn study(rmse: f64, skill: f64) -> Study {
        let text = format!(
            r#"{{"schema": "taceva.evaluation/1.1", "subject": {{"sensor": "x"}}, "metrics": {{
                "mae": {{"Fxy": {{"value": 0.01, "unit": "N"}}}}, "rmse": {{"Fxy": {{"value": {rmse}, "unit": "N"}}}},
                "skill": {{"Fxy": {{"value": {skill}, "unit": "1"}}}}, "sr": {{"Fxy": {{"value": 0.5, "unit": "1"}}}}}}}}"#
        );
        Study::read(&text).expect("a result").remove(0)
    }

    #[test]
    fn labels_that_spread_more_than_twofold_are_said_beside_errors_alone() {
        // 0.012 / √(1 − 0.91) = 0.04; 0.136 / √(1 − 0.36) = 0.17; 0.02 / √(1 − 0.84) = 0.05.
        let studies = [study(0.012, 0.91), study(0.136, 0.36), study(0.02, 0.84)];
        let expected = " (their labels differ in spread: 0.04 N to 0.17 N)";
        assert_eq!(words(&studies, &[0, 1, 2], "mae", "Fxy"), expected);
        assert_eq!(words(&studies, &[0, 2], "mae", "Fxy"), "");
        assert_eq!(words(&studies, &[0, 1], "sr", "Fxy"), "");
    }
}
