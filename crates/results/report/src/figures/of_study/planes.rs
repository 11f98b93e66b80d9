//! Figure 5 of the TacEva study: errors over normalised radius and depth, with one panel for each plane.

use taceva_core::Unit;
use taceva_metrics::{Curve, plane_axes};

use super::super::overlay::{Line, Sheet, Ways, Words, draw as overlay};
use super::super::spatial::rolling;
use crate::figure::{Figure, axis_label, directed, extent};
use crate::results::Study;
use crate::variables::VARIABLES;
use taceva_results::Value;

/// Half width of the band around the rolling mean, in standard deviations of its bins.
const BAND: f64 = 0.1;

pub(super) fn draw(studies: &[Study], over: &str, room: Option<f64>) -> Option<Figure> {
    let name = match over {
        "depth" => "depth over its greatest",
        _ => "radius over its greatest",
    };
    let mut sheets = Vec::new();
    for plane in VARIABLES {
        let mut lines = Vec::new();
        let mut unit = Unit::One;
        for (study, at) in studies.iter().zip(0..) {
            let Some((curve, own)) = curve(study, plane, over) else {
                continue;
            };
            unit = own;
            let greatest = extent(curve.x.iter().copied()).map_or(1.0, |[_, high]| high);
            let mut levels = rolling(&curve);
            for level in &mut levels {
                level.x /= greatest.max(f64::MIN_POSITIVE);
                // The rolling mean has a band of one standard deviation to both sides.
                level.band = level.y.zip(level.band).map(|(mean, [low, high])| {
                    [mean - BAND * (mean - low), mean + BAND * (high - mean)]
                });
            }
            lines.push(Line { study: at, levels });
        }
        if !lines.is_empty() {
            sheets.push(Sheet {
                title: plane.to_owned(),
                x: name.to_owned(),
                y: directed(&axis_label("MAE", unit), "mae"),
                y_unit: unit,
                least: Some([0.0, 0.0]),
                ways: Ways::Straight,
                lines,
            });
        }
    }
    let words = Words {
        id: "figure-5",
        title: match over {
            "depth" => "Figure 5: errors over depth",
            _ => "Figure 5: errors over the radius",
        },
        caption: format!(
            "Mean absolute error of held-out presses over {name}, by plane: rolling mean of non-empty bins, with a band of {BAND} standard deviations of these bins to both sides, as in the study. The error of a plane is the mean of both axes."
        ),
        description: format!(
            "Mean absolute error over {name} of {}.",
            crate::names::all(studies)
        ),
    };
    overlay(&sheets, studies, 2, words, room)
}

/// Curve of the channel of a plane, or the mean of the curves of both channels.
fn curve(study: &Study, plane: &str, over: &str) -> Option<(Curve, Unit)> {
    let of = |channel: &str| {
        let score = study.score("r_spatial", channel)?;
        match &score.variant(over)?.value {
            Value::Curve(curve) => Some((curve.clone(), score.unit)),
            _ => None,
        }
    };
    if let Some(own) = of(plane) {
        return Some(own);
    }
    let [x, y] = plane_axes(plane)?;
    let ((first, unit), (second, _)) = (of(x)?, of(y)?);
    if first.x.len() != second.x.len() {
        return None;
    }
    let both = first.values.iter().zip(&second.values);
    let values = both.map(|(a, b)| Some(f64::midpoint((*a)?, (*b)?)));
    Some((
        Curve::new(
            first.x.clone(),
            first.x_unit,
            values.collect(),
            first.counts.clone(),
        ),
        unit,
    ))
}
