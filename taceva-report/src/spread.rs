//! The spread of labels of sensors: where labels vary little, errors in units are small.

use taceva_core::Unit;

use crate::number::{numeral, spaced};
use crate::results::Study;

/// Metrics whose values follow the spread of the labels.
const OF_LABELS: [&str; 9] = [
    "mae",
    "mae_euclid",
    "rmse",
    "smape",
    "tolerance",
    "r_spatial",
    "repeatability",
    "minimum_detectable_force",
    "hysteresis",
];
/// Spreads that differ by a greater factor are reported.
const ALIKE: f64 = 2.0;

/// ` (their labels differ in spread: ViTacTip 0.047 N to GelSightWM 0.174 N)`, where scores of those studies that are at `which` are compared
/// and the labels of one spread more than twice as far as those of another; else nothing.
pub(crate) fn words(
    (studies, names): (&[Study], &[String]),
    which: &[usize],
    metric: &str,
    channel: &str,
) -> String {
    match range((studies, names), which, channel).filter(|_| OF_LABELS.contains(&metric)) {
        Some(range) => format!(" (their labels differ in spread: {range})"),
        None => String::new(),
    }
}

/// The channels and planes of `channels` whose labels spread differently, in a sentence for below a table; none where all are alike.
pub(crate) fn note(studies: &[Study], names: &[String], channels: &[&str]) -> Option<String> {
    let all: Vec<usize> = (0..studies.len()).collect();
    let differing = channels.iter().filter_map(|channel| {
        let range = range((studies, names), &all, channel)?;
        Some(format!("{channel}: {range}"))
    });
    let differing: Vec<String> = differing.collect();
    (!differing.is_empty()).then(|| {
        format!(
            "Labels differ more than twofold in spread between the sensors ({}): part of a difference between scores of these channels may be one of labels.",
            differing.join("; ")
        )
    })
}

/// `ViTacTip 0.047 N to GelSightWM 0.174 N`, where the labels of one spread more than twice as far as those of another.
fn range(
    (studies, names): (&[Study], &[String]),
    which: &[usize],
    channel: &str,
) -> Option<String> {
    let spreads = which.iter().filter_map(|at| {
        let study = studies.get(*at)?;
        Some((
            names.get(*at)?,
            spread(study, channel)?,
            study.score("mae", channel)?.unit,
        ))
    });
    let spreads: Vec<(&String, f64, Unit)> = spreads.collect();
    let least = spreads
        .iter()
        .min_by(|one, other| one.1.total_cmp(&other.1))?;
    let most = spreads
        .iter()
        .max_by(|one, other| one.1.total_cmp(&other.1))?;
    let said = |(name, of, unit): &(&String, f64, Unit)| {
        format!("{name} {}{}", numeral(*of), spaced(*unit))
    };
    (most.1 > ALIKE * least.1).then(|| format!("{} to {}", said(least), said(most)))
}

/// How far the labels of a channel lie about their mean, of a plane the mean of both axes: from the samples, and without them the root mean
/// square error over √(1 − R²), which planes do not have.
fn spread(study: &Study, channel: &str) -> Option<f64> {
    let axes = match channel {
        "Pxy" => ["Px", "Py"],
        "Fxy" => ["Fx", "Fy"],
        _ => return of_channel(study, channel),
    };
    let [x, y] = axes.map(|axis| of_channel(study, axis));
    Some(f64::midpoint(x?, y?))
}

fn of_channel(study: &Study, channel: &str) -> Option<f64> {
    let number = |metric: &str| study.score(metric, channel)?.value.number();
    let of_scores = || {
        let spread = number("rmse")? / (1.0 - number("r2")?).sqrt();
        (spread.is_finite() && spread > 0.0).then_some(spread)
    };
    of_samples(study, channel).or_else(of_scores)
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

    /// A study with root mean square errors and R² of shear, and a constant that is far from its labels.
    fn study(rmse: f64, r2: f64) -> Study {
        let of_channel = |metric: &str, value: f64, unit: &str| {
            let channels = ["Fx", "Fy", "Fxy"]
                .map(|channel| format!(r#""{channel}": {{"value": {value}, "unit": "{unit}"}}"#));
            format!(r#""{metric}": {{{}}}"#, channels.join(", "))
        };
        let metrics = [
            of_channel("mae", 0.01, "N"),
            of_channel("rmse", rmse, "N"),
            of_channel("r2", r2, "1"),
            of_channel("skill", 0.99, "1"),
            of_channel("sr", 0.5, "1"),
        ];
        let text = format!(
            r#"{{"schema": "taceva.evaluation/1.1", "subject": {{"sensor": "x"}}, "metrics": {{{}}}}}"#,
            metrics.join(", ")
        );
        Study::read(&text).expect("a result").remove(0)
    }

    #[test]
    fn labels_that_spread_more_than_twofold_about_their_mean_are_said_with_whose_they_are() {
        // 0.012 / √(1 − 0.91) = 0.04; 0.136 / √(1 − 0.36) = 0.17; 0.02 / √(1 − 0.84) = 0.05. Skill, about another constant, plays no part.
        let studies = [study(0.012, 0.91), study(0.136, 0.36), study(0.02, 0.84)];
        let names = ["a", "b", "c"].map(str::to_owned);
        let said = |which: &[usize], metric: &str| words((&studies, &names), which, metric, "Fxy");
        let expected = " (their labels differ in spread: a 0.04 N to b 0.17 N)";
        assert_eq!(said(&[0, 1, 2], "mae"), expected);
        assert_eq!(said(&[0, 1, 2], "repeatability"), expected);
        assert_eq!(said(&[0, 2], "mae"), "");
        assert_eq!(said(&[0, 1], "sr"), "");
        let note = note(&studies, &names, &["Fxy"]).expect("a note");
        assert!(note.contains("(Fxy: a 0.04 N to b 0.17 N)"), "{note}");
    }
}
