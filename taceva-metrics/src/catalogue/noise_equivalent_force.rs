//! Force that is equivalent to the noise of predictions without contact.

use taceva_core::Unit;

use crate::evaluate::family::Numbers;
use crate::evaluate::metric::{Formula, Metric, ScoreUnit};
use crate::exact::moments::Moments;
use crate::families::idle::{GATE_N, IDLE, IDLE_NEEDS, IdleFormula, enough};
use crate::score::Parameter;
use crate::score::direction::Better;
use crate::score::range::Range;
use crate::score::theme::Theme;
use crate::score::value::Finished;
use crate::stats::noncentral::{critical_factor, detection_factor};

/// Factor for a known standard deviation and risks of 5 % each: twice the normal quantile 1.645, k_α + k_β in Currie (1995).
const KNOWN_DEVIATION: f64 = 3.29;
/// The 97.5 % quantile of the normal distribution.
const NORMAL_QUANTILE: f64 = 1.959_963_984_540_054;

pub(crate) static NOISE_EQUIVALENT_FORCE: Metric = Metric {
    id: "noise_equivalent_force",
    title: "noise-equivalent force",
    symbol: Some("$F_{\\mathrm{NE}}$"),
    theme: Theme::Detail,
    better: Better::Lower,
    unit: ScoreUnit::OfChannel,
    range: Range::Positive,
    definition: "noise_equivalent_force/1",
    reference: "Currie 1995, Pure and Applied Chemistry 67; ISO 11843-2, with the factor of the noncentral t distribution",
    documentation: "Least force that exceeds the noise of untouched pictures with 5 % of false alarms and 5 % of misses: δ √(1 + 1/n) s. \
                    Here s is the standard deviation (over n − 1) of predicted force over the n samples without contact, |true Fz| < \
                    0.02 N; δ is the factor for n − 1 degrees of freedom. Forces only, from ten such samples on. It is not a detection \
                    limit, which light presses verify (see detection_limit): other places, other days and the error at zero (see \
                    zero_error) increase it. `critical` is the threshold that zero exceeds in 5 % of cases; `known_deviation` is 3.29 s, as if s \
                    were known. `independent_low` and `independent_high` are its 95 % limits if samples are independent, by Wilson and \
                    Hilferty's approximation of the χ² distribution of s.",
    needs: IDLE_NEEDS,
    forces_only: true,
    constants: gate,
    formula: Formula(&IdleFormula(noise_equivalent_force)),
    ..Metric::of(&IDLE)
};

fn gate(_: Unit) -> Vec<Parameter> {
    vec![Parameter {
        name: "gate",
        value: GATE_N,
    }]
}

/// Noise-equivalent force δ √(1 + 1/n) s for n predictions with the standard deviation s. δ is [`detection_factor`] for n − 1 degrees of freedom.
fn noise_equivalent_force(predictions: &Moments, unit: Unit) -> Numbers {
    let times = |factor: fn(f64) -> f64| -> Finished {
        enough(predictions)?;
        let deviation = predictions.deviation(1).unwrap_or_default();
        let n = number(predictions.n);
        Ok(factor(n - 1.0) * (1.0 + 1.0 / n).sqrt() * deviation)
    };
    let known = enough(predictions).map(|()| {
        let deviation = predictions.deviation(1).unwrap_or_default();
        KNOWN_DEVIATION * deviation
    });
    let limit = |normal: f64| -> Finished {
        let freedom = number(predictions.n.saturating_sub(1));
        Ok(times(detection_factor)? / chi_square_share(freedom, normal).sqrt())
    };
    let (low, high) = (limit(NORMAL_QUANTILE), limit(-NORMAL_QUANTILE));
    Numbers::of(times(detection_factor))
        .with("critical", unit, Range::Positive, times(critical_factor))
        .with("known_deviation", unit, Range::Positive, known)
        .with("independent_low", unit, Range::Positive, low)
        .with("independent_high", unit, Range::Positive, high)
}

/// Quantile of χ²/ν for ν = `freedom` ≥ 9 degrees of freedom, to within 1 %. Its probability is that of a standard normal number below `normal`.
///
/// # Reference
/// Wilson and Hilferty, Proceedings of the National Academy of Sciences 17 (1931).
fn chi_square_share(freedom: f64, normal: f64) -> f64 {
    let variance = 2.0 / (9.0 * freedom);
    let root = 1.0 - variance + normal * variance.sqrt();
    root * root * root
}

fn number(count: u64) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "no recording has 2^53 pictures")]
    let number = count as f64;
    number
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_of_chi_square_are_those_of_tables() {
        // Quantiles of 97.5 % and 2.5 % for 9, 59 and 499 degrees of freedom.
        for (freedom, [upper, lower]) in [
            (9.0, [19.022_768, 2.700_389_5]),
            (59.0, [82.117_406, 39.661_858]),
            (499.0, [562.789_5, 438.998_0]),
        ] {
            for (normal, expected) in [(NORMAL_QUANTILE, upper), (-NORMAL_QUANTILE, lower)] {
                let found = freedom * chi_square_share(freedom, normal);
                let off = (found / expected - 1.0).abs();
                assert!(off < 1e-2, "{freedom}: {found} for {expected}");
            }
        }
    }
}
