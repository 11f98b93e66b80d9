//! Curves of the bias over the truth, and of the share of samples within a tolerance.

use taceva_core::Unit;
use taceva_metrics::Curve;

use crate::figure::{Figure, axis_label, directed};
use crate::results::Study;
use taceva_results::Value;

use super::SIX;
use super::overlay::{Level, Line, Sheet, Ways, Words, draw as overlay};

/// Least number of samples in a drawn bin. The mean of fewer samples is noise.
const FEWEST: u64 = 5;

/// Points of `curve`, without smoothing.
pub(super) fn levels(curve: &Curve) -> Vec<Level> {
    let band = |at: usize| {
        let band = curve.band.as_ref()?;
        Some([band.low[at]?, band.high[at]?])
    };
    let level = |at: usize| Level {
        x: curve.x[at],
        y: curve.values[at],
        n: curve.counts[at],
        band: band(at),
    };
    (0..curve.x.len()).map(level).collect()
}

/// One sheet for each channel, with the variant `curve` of `metric` for each study. `x` and `y` name the axes.
pub(super) fn sheets(studies: &[Study], metric: &str, x: &str, y: &str, ways: Ways) -> Vec<Sheet> {
    // A level shows a bias, which is best near zero; the metric is the greatest bias.
    let directed_by = match metric {
        "bias_level" => "bias",
        other => other,
    };
    let mut sheets = Vec::new();
    for channel in SIX {
        let (mut lines, mut units) = (Vec::new(), [Unit::One; 2]);
        for (study, at) in studies.iter().zip(0..) {
            let variant = study
                .score(metric, channel)
                .and_then(|score| score.variant("curve"));
            let Some(variant) = variant else { continue };
            if let Value::Curve(curve) = &variant.value {
                units = [curve.x_unit, variant.unit];
                lines.push(Line {
                    study: at,
                    levels: levels(curve),
                });
            }
        }
        if !lines.is_empty() {
            sheets.push(Sheet {
                title: channel.to_owned(),
                x: axis_label(x, units[0]),
                y: directed(&axis_label(y, units[1]), directed_by),
                y_unit: units[1],
                least: Some([0.0, 0.0]),
                ways,
                lines,
            });
        }
    }
    sheets
}

pub(super) fn bias(studies: &[Study], room: Option<f64>) -> Option<Figure> {
    let words = Words {
        id: "bias",
        title: "Bias by level",
        caption: format!(
            "Mean of truth − prediction in bins of the truth with at least {FEWEST} samples; above zero, the sensor reads too low."
        ),
        description: format!(
            "Bias over the true value, by channel, of {}.",
            crate::names::all(studies)
        ),
    };
    let mut sheets = sheets(studies, "bias_level", "truth", "bias", Ways::Straight);
    let lines = sheets.iter_mut().flat_map(|sheet| &mut sheet.lines);
    for level in lines.flat_map(|line| &mut line.levels) {
        level.y = level.y.filter(|_| level.n >= FEWEST);
    }
    overlay(&sheets, studies, 3, words, room)
}

pub(super) fn tolerance(studies: &[Study], room: Option<f64>) -> Option<Figure> {
    let words = Words {
        id: "tolerance",
        title: "Share of samples within a tolerance",
        caption: "Share of held-out samples whose error is at most the tolerance.".to_owned(),
        description: format!(
            "Share of errors within a tolerance, by channel, of {}.",
            crate::names::all(studies)
        ),
    };
    let sheets = sheets(
        studies,
        "tolerance",
        "tolerance",
        "share within",
        Ways::LogarithmicX,
    );
    overlay(&sheets, studies, 3, words, room)
}
