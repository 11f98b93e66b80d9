//! Error against light, scene by scene.

use std::collections::BTreeMap;

use crate::figure::{Figure, axis_label};
use crate::results::Study;
use crate::samples::{SampleChannel, Samples};

use super::SIX;
use super::overlay::{Level, Line, Sheet, Ways, Words, draw as overlay};

pub(super) fn draw(studies: &[Study]) -> Option<Figure> {
    let mut sheets = Vec::new();
    let mut scenes: Vec<String> = Vec::new();
    for name in SIX {
        let (mut lines, mut of) = (Vec::new(), None);
        for (study, at) in studies.iter().zip(0..) {
            // Where no light enters, a change of it says nothing of the sensor.
            let is_scored = study.score("r_light", name).is_some();
            let Some(samples) = study.samples.as_ref().filter(|_| is_scored) else {
                continue;
            };
            let Some(channel) = samples.channel(name) else {
                continue;
            };
            let levels = levels(samples, channel, &mut scenes);
            if levels.len() > 1 {
                of = Some(channel.unit());
                lines.push(Line { study: at, levels });
            }
        }
        if let Some(unit) = of {
            sheets.push(Sheet {
                title: name.to_owned(),
                x: "mean grey level".to_owned(),
                y: axis_label("MAE", unit),
                y_unit: unit,
                least: None,
                ways: Ways::LogarithmicY,
                lines,
            });
        }
    }
    let words = Words {
        id: "lighting",
        title: "Error against light",
        caption: format!(
            "Mean absolute error of the same presses in each scene of light, over the mean grey level of its pictures; scenes: {}. A line joins the scenes of a sensor from dark to bright.",
            super::listed(&scenes)
        ),
        description: format!(
            "Mean absolute error over mean grey level by scene of light of {}.",
            super::listed(&super::names(studies))
        ),
    };
    overlay(&sheets, studies, 3, words)
}

/// A level a scene, from dark to bright.
fn levels(samples: &Samples, channel: &SampleChannel, scenes: &mut Vec<String>) -> Vec<Level> {
    struct Sums {
        light: f64,
        error: f64,
        n: u64,
        count: f64,
    }
    let mut sums: BTreeMap<&str, Sums> = BTreeMap::new();
    for row in samples.of_protocol("light-sweep") {
        let light = samples.number("intensity", row);
        let (Some([truth, prediction]), Some(light)) = (channel.pair(row), light) else {
            continue;
        };
        let scene = samples.word("scene", row).unwrap_or("original");
        let sum = sums.entry(scene).or_insert(Sums {
            light: 0.0,
            error: 0.0,
            n: 0,
            count: 0.0,
        });
        sum.light += light;
        sum.error += (truth - prediction).abs();
        sum.n += 1;
        sum.count += 1.0;
    }
    for scene in sums.keys() {
        if !scenes.iter().any(|known| known == scene) {
            scenes.push((*scene).to_owned());
        }
    }
    let mut levels: Vec<Level> = sums
        .values()
        .map(|sum| Level {
            x: sum.light / sum.count,
            y: Some(sum.error / sum.count),
            n: sum.n,
            band: None,
        })
        .collect();
    levels.sort_by(|left, right| left.x.total_cmp(&right.x));
    levels
}
