//! Figure 6b of the TacEva study: error of each plane against the mean grey level of the frames, with one dot for each light scene.

use std::collections::BTreeMap;

use taceva_core::Unit;
use taceva_metrics::plane_axes;

use super::super::overlay::{Level, Line, Sheet, Ways, Words, draw as overlay};
use crate::figure::{Figure, axis_label, directed};
use crate::results::Study;
use crate::variables::VARIABLES;
use taceva_results::Samples;

/// Sums over the samples of a light scene.
#[derive(Default)]
struct Sums {
    grey: f64,
    error: f64,
    count: u64,
}

pub(super) fn draw(studies: &[Study], room: Option<f64>) -> Option<Figure> {
    let mut sheets = Vec::new();
    for plane in VARIABLES {
        let lines = studies.iter().zip(0..).filter_map(|(study, at)| {
            let levels = levels(study.samples.as_ref()?, plane);
            (levels.len() > 1).then_some(Line { study: at, levels })
        });
        let lines: Vec<Line> = lines.collect();
        let unit = match plane.starts_with('P') {
            true => Unit::Millimetre,
            false => Unit::Newton,
        };
        if !lines.is_empty() {
            sheets.push(Sheet {
                title: plane.to_owned(),
                x: "mean grey level".to_owned(),
                y: directed(&axis_label("MAE", unit), "mae"),
                y_unit: unit,
                least: Some([0.0, 0.0]),
                ways: Ways::Straight,
                lines,
            });
        }
    }
    let words = Words {
        id: "figure-6b",
        title: "Figure 6b: error against mean grey level",
        caption: "Mean absolute error in each lighting scene against the mean grey level of its frames, by plane; scenes in the order of their grey level. Predictions are clipped to the bounds of the model.".to_owned(),
        description: format!("Mean absolute error over mean grey level of {}.", crate::names::all(studies)),
    };
    overlay(&sheets, studies, 2, words, room)
}

/// Light scenes, from the darkest to the brightest.
fn levels(samples: &Samples, plane: &str) -> Vec<Level> {
    let channels = plane_axes(plane).map_or(vec![plane], |axes| axes.to_vec());
    let mut scenes: BTreeMap<&str, Sums> = BTreeMap::new();
    for row in samples.of_protocol("light-sweep") {
        let (Some(scene), Some(grey)) =
            (samples.word("scene", row), samples.number("intensity", row))
        else {
            continue;
        };
        let errors = channels.iter().map(|channel| {
            let [truth, prediction] = samples.channel(channel)?.pair(row)?;
            Some((truth - prediction).abs())
        });
        let Some(errors) = errors.collect::<Option<Vec<f64>>>() else {
            continue;
        };
        let count = errors.iter().fold(0.0, |count, _| count + 1.0);
        let sums = scenes.entry(scene).or_default();
        sums.grey += grey;
        sums.error += errors.iter().sum::<f64>() / count;
        sums.count += 1;
    }
    let mut levels: Vec<Level> = scenes
        .values()
        .map(|sums| {
            let count = u32::try_from(sums.count).map_or(f64::MAX, f64::from);
            Level {
                x: sums.grey / count,
                y: Some(sums.error / count),
                n: sums.count,
                band: None,
            }
        })
        .collect();
    levels.sort_by(|left, right| left.x.total_cmp(&right.x));
    levels
}
