//! Error by scene of light: a column a scene, a dot a sensor.

use std::collections::BTreeMap;

use taceva_core::Unit;
use taceva_metrics::SensorFacts;

use crate::figure::{
    Area, Axes, Canvas, Figure, Grid, Ink, Panel, Points, Scale, axis_label, directed, extent,
};
use crate::number::{numeral, spaced};
use crate::results::Study;
use crate::samples::{SampleChannel, Samples};

use super::SIX;

/// The scene that models learn in.
const LEARNT_IN: &str = SensorFacts::REFERENCE_SCENE;

/// What a sensor says of one channel in one scene.
struct Level {
    scene: String,
    mae: f64,
    grey: f64,
    n: u64,
}

/// A channel of every sensor that light reaches.
struct Sheet {
    channel: &'static str,
    unit: Unit,
    /// By the position of the study.
    sensors: Vec<(usize, Vec<Level>)>,
}

pub(super) fn draw(studies: &[Study]) -> Option<Figure> {
    let names = super::names(studies);
    let sheets: Vec<Sheet> = SIX
        .into_iter()
        .filter_map(|channel| Sheet::of(studies, channel))
        .collect();
    if sheets.is_empty() {
        return None;
    }
    let levels = || {
        sheets
            .iter()
            .flat_map(|sheet| &sheet.sensors)
            .flat_map(|(_, levels)| levels)
    };
    let scenes = in_order(levels().map(|level| level.scene.as_str()));
    let sensors: Vec<usize> = (0..studies.len())
        .filter(|at| {
            let mut all = sheets.iter().flat_map(|sheet| &sheet.sensors);
            all.any(|(of, _)| of == at)
        })
        .collect();
    let legend: Vec<(usize, String)> = sensors.iter().map(|at| (*at, names[*at].clone())).collect();
    let first = Area {
        left: 58.0,
        top: 54.0,
        width: 216.0,
        height: 168.0,
    };
    let grid = Grid::new(sheets.len(), 3, first, [66.0, 122.0]);
    let mut canvas = grid.canvas([16.0, 86.0]);
    canvas.dot_legend([first.left, 16.0], &legend);
    for (position, sheet) in sheets.iter().enumerate() {
        sheet.draw(grid.area(position), (&scenes, &legend), &mut canvas);
    }
    Some(Figure {
        id: "lighting".to_owned(),
        title: "Error by scene of light".to_owned(),
        caption: format!(
            "Mean absolute error of the same presses in each scene of light, a column a scene, on a logarithmic axis; models learn in the scene “{LEARNT_IN}”. Sensors that no light reaches are not shown. Point at a dot for the mean grey level of its pictures."
        ),
        description: format!(
            "Mean absolute error by scene of light ({}) of {}.",
            super::listed(&scenes),
            super::listed(&legend.into_iter().map(|(_, name)| name).collect::<Vec<_>>())
        ),
        canvas,
    })
}

/// The scene of learning first, then by name.
fn in_order<'a>(scenes: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut all: Vec<&str> = scenes.collect();
    all.sort_unstable_by_key(|scene| (*scene != LEARNT_IN, *scene));
    all.dedup();
    all.into_iter().map(str::to_owned).collect()
}

impl Sheet {
    fn of(studies: &[Study], name: &'static str) -> Option<Sheet> {
        let (mut sensors, mut unit) = (Vec::new(), None);
        for (at, study) in studies.iter().enumerate() {
            // Where no light enters, a change of it says nothing of the sensor.
            let is_scored = study.score("r_light", name).is_some();
            let Some(samples) = study.samples.as_ref().filter(|_| is_scored) else {
                continue;
            };
            let Some(channel) = samples.channel(name) else {
                continue;
            };
            let levels = levels(samples, channel);
            if levels.len() > 1 {
                unit = Some(channel.unit());
                sensors.push((at, levels));
            }
        }
        Some(Sheet {
            channel: name,
            unit: unit?,
            sensors,
        })
    }

    #[expect(
        clippy::cast_precision_loss,
        reason = "a handful of scenes and sensors"
    )]
    fn draw(
        &self,
        area: Area,
        (scenes, legend): (&[String], &[(usize, String)]),
        canvas: &mut Canvas,
    ) {
        let values = self.sensors.iter().flat_map(|(_, levels)| levels);
        let Some([low, high]) = extent(values.map(|level| level.mae).filter(|mae| *mae > 0.0))
        else {
            return;
        };
        let panel = Panel {
            area,
            x: Scale::linear([-0.5, scenes.len() as f64 - 0.5], area.across()),
            y: Scale::logarithmic([low / 1.15, high * 1.15], area.upwards()),
        };
        let axes = Axes {
            title: self.channel.to_owned(),
            x: "scene of light".to_owned(),
            y: directed(&axis_label("MAE", self.unit), "mae"),
        };
        panel.axes_of_names(&axes, scenes, canvas);
        let spread = 0.7 / legend.len() as f64;
        for (place, (at, name)) in legend.iter().enumerate() {
            let Some((_, levels)) = self.sensors.iter().find(|(of, _)| of == at) else {
                continue;
            };
            let aside = (place as f64 - (legend.len() - 1) as f64 / 2.0) * spread;
            let mut points = Points::default();
            for level in levels.iter().filter(|level| level.mae > 0.0) {
                let column = scenes.iter().position(|scene| *scene == level.scene);
                let Some(column) = column else { continue };
                points.at.push(panel.at(column as f64 + aside, level.mae));
                points.words.push(format!(
                    "{name}, scene {}: MAE {}{}, mean grey level {}, n = {}",
                    level.scene,
                    numeral(level.mae),
                    spaced(self.unit),
                    numeral(level.grey),
                    level.n
                ));
            }
            canvas.points(points, Ink::Series(*at), 3.6, 1.0);
        }
    }
}

/// A level a scene.
fn levels(samples: &Samples, channel: &SampleChannel) -> Vec<Level> {
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
        let scene = samples.word("scene", row).unwrap_or(LEARNT_IN);
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
    let level = |(scene, sum): (&str, Sums)| Level {
        scene: scene.to_owned(),
        mae: sum.error / sum.count,
        grey: sum.light / sum.count,
        n: sum.n,
    };
    sums.into_iter().map(level).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scene_of_learning_comes_first() {
        let scenes = ["S2", "normal", "S1", "S2"];
        assert_eq!(in_order(scenes.into_iter()), ["normal", "S1", "S2"]);
    }
}
