//! Spread of the labels of each sensor. Absolute errors tend to be small if labels vary little.

use taceva_core::Unit;
use taceva_metrics::plane_axes;

use crate::names::noun;
use crate::number::{numeral, spaced};
use crate::results::Study;

/// Metrics whose values depend on label spread, each with the protocol phase that contains the labels.
const OF_LABELS: [(&str, &str); 11] = [
    ("agreement", CALIBRATION),
    ("mae", CALIBRATION),
    ("mae_euclid", CALIBRATION),
    ("rmse", CALIBRATION),
    ("smape", CALIBRATION),
    ("tolerance", CALIBRATION),
    ("tolerance_interval", CALIBRATION),
    ("r_spatial", "spatial"),
    ("repeatability", "repeatability"),
    // The samples of this metric are not pressed, so the labels of the training count.
    ("noise_equivalent_force", CALIBRATION),
    ("hysteresis", "load-unload"),
];
const CALIBRATION: &str = "calibration";
/// Ratio of spreads above which a difference is reported.
const ALIKE: f64 = 2.0;

/// Remark on the labels of the studies at `which`: ` (their labels differ in spread: ViTacTip 0.047 N to GelSightWM 0.174 N)`. Also states if R²
/// orders the studies otherwise. Empty if label spreads differ by at most a factor of two.
pub(crate) fn words(
    studies: &[Study],
    names: &[String],
    which: &[usize],
    metric: &str,
    channel: &str,
) -> String {
    match range(studies, names, which, metric, channel) {
        Some((labels, range)) => {
            let other = other_order(studies, names, which, metric, channel);
            let other = other.unwrap_or_default();
            format!(" (their {labels} differ in spread: {range}){other}")
        }
        None => String::new(),
    }
}

/// Remark that the greatest R² belongs to a study with a larger error than others; `None` if both orders begin alike, or for scores other than MAE and RMSE.
fn other_order(
    studies: &[Study],
    names: &[String],
    which: &[usize],
    metric: &str,
    channel: &str,
) -> Option<String> {
    if !matches!(metric, "mae" | "rmse") {
        return None;
    }
    let number = |at: usize, metric: &str| studies.get(at)?.score(metric, channel)?.value.number();
    let known = which.iter().filter_map(|at| {
        let error = number(*at, metric)?;
        Some((*at, error, number(*at, "r2")?))
    });
    let known: Vec<(usize, f64, f64)> = known.collect();
    let (at, error, r2) = *known
        .iter()
        .max_by(|one, other| one.2.total_cmp(&other.2))?;
    let is_larger = known.iter().any(|(_, of_other, _)| *of_other < error);
    let name = names.get(at).filter(|_| is_larger)?;
    Some(format!(
        "; relative to this spread, {name} has the best value: r2 {}",
        numeral(r2)
    ))
}

/// Note below a table on the `scores` (metric and channel) whose labels have different spreads; `None` without such scores.
pub(crate) fn note(studies: &[Study], names: &[String], scores: &[(&str, &str)]) -> Option<String> {
    let all: Vec<usize> = (0..studies.len()).collect();
    let differing = scores.iter().filter_map(|(metric, channel)| {
        let (labels, range) = range(studies, names, &all, metric, channel)?;
        let of_part = labels
            .strip_prefix("labels")
            .filter(|part| !part.is_empty());
        let of_part = of_part.map_or_else(String::new, |part| format!(", labels{part}"));
        Some(format!("{metric} {channel}{of_part}: {range}"))
    });
    let differing: Vec<String> = differing.collect();
    (!differing.is_empty()).then(|| {
        format!(
            "The spread of the labels differs more than twofold between the {}s ({}): part of a score difference may come from the labels.",
            noun(studies),
            differing.join("; ")
        )
    })
}

/// Name of the compared labels and range of their spreads, such as `labels` and `ViTacTip 0.047 N to GelSightWM 0.174 N`. `None` up to a factor of
/// two. Uses `labels of calibration` if a study has no samples of the metric's phase.
fn range(
    studies: &[Study],
    names: &[String],
    which: &[usize],
    metric: &str,
    channel: &str,
) -> Option<(String, String)> {
    let (_, part) = OF_LABELS.iter().find(|(name, _)| *name == metric)?;
    let of_part = |part| spreads(studies, names, which, part, channel);
    let own = of_part(*part).filter(|own| own.len() == which.len());
    let (part_used, spreads) = match own {
        Some(own) => (*part, own),
        None => (CALIBRATION, of_part(CALIBRATION)?),
    };
    let least = spreads
        .iter()
        .min_by(|one, other| one.1.total_cmp(&other.1))?;
    let most = spreads
        .iter()
        .max_by(|one, other| one.1.total_cmp(&other.1))?;
    let said = |(name, of, unit): &(&String, f64, Unit)| {
        format!("{name} {}{}", numeral(*of), spaced(*unit))
    };
    let labels = match *part {
        CALIBRATION => "labels".to_owned(),
        _ => format!("labels of {part_used}"),
    };
    let range = || format!("{} to {}", said(least), said(most));
    (most.1 > ALIKE * least.1).then(|| (labels, range()))
}

/// Names, label spreads and units of the studies with a known spread; `None` if no spread is known.
fn spreads<'a>(
    studies: &[Study],
    names: &'a [String],
    which: &[usize],
    part: &str,
    channel: &str,
) -> Option<Vec<(&'a String, f64, Unit)>> {
    let found = which.iter().filter_map(|at| {
        let study = studies.get(*at)?;
        let unit = study.score("mae", channel)?.unit;
        Some((names.get(*at)?, spread(study, part, channel)?, unit))
    });
    let found: Vec<_> = found.collect();
    (!found.is_empty()).then_some(found)
}

/// Standard deviation of the labels of a channel in the protocol phase `part`; for a plane, the mean over both axes. For a calibration without
/// samples, RMSE / √(1 − R²) of the scores.
fn spread(study: &Study, part: &str, channel: &str) -> Option<f64> {
    let Some(axes) = plane_axes(channel) else {
        return of_channel(study, part, channel);
    };
    let [x, y] = axes.map(|axis| of_channel(study, part, axis));
    Some(f64::midpoint(x?, y?))
}

fn of_channel(study: &Study, part: &str, channel: &str) -> Option<f64> {
    let number = |metric: &str| study.score(metric, channel)?.value.number();
    let of_scores = || {
        let spread = number("rmse")? / (1.0 - number("r2")?).sqrt();
        (spread.is_finite() && spread > 0.0).then_some(spread)
    };
    let found = of_samples(study, part, channel);
    found.or_else(|| of_scores().filter(|_| part == CALIBRATION))
}

/// Standard deviation of the labels of a channel in the protocol phase `part`; `None` without samples, or if all labels are equal.
fn of_samples(study: &Study, part: &str, channel: &str) -> Option<f64> {
    let samples = study.samples.as_ref()?;
    let labels = samples.channel(channel)?;
    let rows = samples.of_protocol(part);
    let predicted = rows.iter().filter_map(|row| labels.pair(*row));
    let mut truths: Vec<f64> = predicted.map(|[truth, _]| truth).collect();
    if truths.is_empty() {
        // Metrics of the truth alone need no prediction.
        let known = rows.iter().filter_map(|row| labels.truth(*row));
        truths = known.collect();
    }
    let count = truths.iter().fold(0.0, |count, _| count + 1.0);
    let mean = truths.iter().sum::<f64>() / count;
    let squares: f64 = truths.iter().map(|truth| (truth - mean).powi(2)).sum();
    let spread = (squares / count).sqrt();
    (spread.is_finite() && spread > 0.0).then_some(spread)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Study with root mean square errors and R² of shear. The skill uses a constant far from the labels.
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
            r#"{{"schema": "taceva.evaluation/1.0", "subject": {{"sensor": "x"}}, "metrics": {{{}}}}}"#,
            metrics.join(", ")
        );
        crate::results::unsealed(&text).expect("a result").remove(0)
    }

    #[test]
    fn labels_that_spread_more_than_twofold_about_their_mean_are_said_with_whose_they_are() {
        // 0.012 / √(1 − 0.91) = 0.04; 0.136 / √(1 − 0.36) = 0.17; 0.02 / √(1 − 0.84) = 0.05. The skill uses another constant and is ignored.
        let studies = [study(0.012, 0.91), study(0.136, 0.36), study(0.02, 0.84)];
        let names = ["a", "b", "c"].map(str::to_owned);
        let said = |which: &[usize], metric: &str| words(&studies, &names, which, metric, "Fxy");
        let expected = " (their labels differ in spread: a 0.04 N to b 0.17 N)";
        assert_eq!(said(&[0, 1, 2], "mae"), expected);
        // Without samples, the labels of the repeated presses are unknown.
        let of_calibration =
            " (their labels of calibration differ in spread: a 0.04 N to b 0.17 N)";
        assert_eq!(said(&[0, 1, 2], "repeatability"), of_calibration);
        assert_eq!(said(&[0, 2], "mae"), "");
        assert_eq!(said(&[0, 1], "sr"), "");
        let note = note(&studies, &names, &[("mae", "Fxy")]).expect("a note");
        let differ = "(mae Fxy: a 0.04 N to b 0.17 N)";
        assert!(note.contains(differ), "{note}");
    }

    #[test]
    fn the_best_r2_of_a_sensor_with_a_larger_error_is_said_beside_the_spread() {
        let mut studies = [study(0.012, 0.36), study(0.136, 0.91)];
        let names = ["a", "b"].map(str::to_owned);
        let said = |studies: &[Study]| words(studies, &names, &[0, 1], "mae", "Fxy");
        assert!(said(&studies).ends_with("N)"), "{}", said(&studies));
        for score in &mut studies[0].scores {
            if score.metric == "mae" {
                score.value = taceva_results::Value::Number(0.005);
            }
        }
        let expected = "; relative to this spread, b has the best value: r2 0.91";
        assert!(said(&studies).contains(expected), "{}", said(&studies));
    }

    #[test]
    fn a_metric_of_another_part_of_the_protocol_is_held_against_the_labels_of_that_part() {
        let with = |labels: [&str; 4]| {
            let [one, other, first, second] = labels;
            let table = format!(
                "id,protocol,Fx,Fx_predicted\na,calibration,{one},0\nb,calibration,{other},0\nc,load-unload,{first},\nd,load-unload,{second},\n"
            );
            let mut study = study(0.012, 0.91);
            study.samples = Some(taceva_results::Samples::read(&table).expect("a table"));
            study
        };
        // Equal in the calibration; 0.1 N against 0.4 N in the cycles.
        let studies = [
            with(["0", "0.2", "0", "0.2"]),
            with(["0", "0.2", "0", "0.8"]),
        ];
        let names = ["a", "b"].map(str::to_owned);
        let said = |metric: &str| words(&studies, &names, &[0, 1], metric, "Fx");
        assert_eq!(said("mae"), "");
        let cycles = " (their labels of load-unload differ in spread: a 0.1 N to b 0.4 N)";
        assert_eq!(said("hysteresis"), cycles);
    }
}
