//! Errors over the distance from the centre and over depth.

use taceva_core::Unit;
use taceva_metrics::Curve;

use crate::figure::{Figure, axis_label, directed};
use crate::results::Study;
use taceva_results::Value;

use super::SIX;
use super::overlay::{Level, Line, Sheet, Ways, Words, draw as overlay};

/// Number of bins in a rolling mean; an odd number.
const WINDOW: usize = 5;

/// Figures of the error over distance and of the error over depth.
pub(super) fn draw(studies: &[Study], room: Option<f64>) -> Vec<Option<Figure>> {
    vec![one(studies, "distance", room), one(studies, "depth", room)]
}

fn one(studies: &[Study], over: &str, room: Option<f64>) -> Option<Figure> {
    let mut sheets = Vec::new();
    for channel in SIX {
        let (mut lines, mut unit, mut x_unit) = (Vec::new(), Unit::One, Unit::Millimetre);
        for (study, at) in studies.iter().zip(0..) {
            let Some(score) = study.score("r_spatial", channel) else {
                continue;
            };
            if let Some(Value::Curve(curve)) = score.variant(over).map(|of| &of.value) {
                (unit, x_unit) = (score.unit, curve.x_unit);
                lines.push(Line {
                    study: at,
                    levels: rolling(curve),
                });
            }
        }
        if !lines.is_empty() {
            sheets.push(Sheet {
                title: channel.to_owned(),
                x: axis_label(over, x_unit),
                y: directed(&axis_label("MAE", unit), "mae"),
                y_unit: unit,
                least: Some([0.0, 0.0]),
                ways: Ways::Straight,
                lines,
            });
        }
    }
    let words = Words {
        id: over,
        title: match over {
            "depth" => "Error against depth",
            _ => "Error against distance from the centre",
        },
        caption: format!(
            "Mean absolute error of held-out presses in 100 bins of {over}: rolling mean of {WINDOW} non-empty bins, with a band of one standard deviation of these bins to both sides. Scores are computed from the bins themselves."
        ),
        description: format!(
            "Mean absolute error over {over} of {}.",
            crate::names::all(studies)
        ),
    };
    overlay(&sheets, studies, 3, words, room)
}

/// Rolling mean over non-empty bins, each with equal weight, with the standard deviation of the averaged bins as the band.
pub(super) fn rolling(curve: &Curve) -> Vec<Level> {
    let bins: Vec<(f64, f64, u64)> = curve
        .x
        .iter()
        .zip(&curve.values)
        .zip(&curve.counts)
        .filter_map(|((x, value), n)| Some((*x, (*value)?, *n)))
        .collect();
    let half = WINDOW / 2;
    let level = |at: usize| {
        // The window shrinks at the ends and stays symmetric.
        let reach = half.min(at).min(bins.len() - 1 - at);
        let window = &bins[at - reach..=at + reach];
        let count = window.iter().fold(0.0, |count, _| count + 1.0);
        let mean = window.iter().map(|(_, value, _)| value).sum::<f64>() / count;
        let squares = window.iter().map(|(_, value, _)| (value - mean).powi(2));
        let deviation = (squares.sum::<f64>() / count).sqrt();
        Level {
            x: bins[at].0,
            y: Some(mean),
            n: window.iter().map(|(_, _, n)| n).sum(),
            band: Some([(mean - deviation).max(0.0), mean + deviation]),
        }
    };
    (0..bins.len()).map(level).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rolling_mean_skips_empty_bins_and_shrinks_at_the_ends() {
        let curve = Curve::new(
            vec![0.0, 1.0, 2.0, 3.0],
            Unit::Millimetre,
            vec![Some(1.0), None, Some(2.0), Some(6.0)],
            vec![1, 0, 2, 3],
        );
        let levels = rolling(&curve);
        let means: Vec<f64> = levels.iter().filter_map(|level| level.y).collect();
        assert_eq!(means.len(), 3);
        assert!((means[0] - 1.0).abs() < 1e-12 && (means[1] - 3.0).abs() < 1e-12);
        assert_eq!(levels[1].n, 6);
    }
}
