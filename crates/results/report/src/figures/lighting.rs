//! Error by light scene, relative to the error in reference light: one column for each scene, one dot for each sensor.

use taceva_metrics::SensorFacts;

use crate::figure::{
    Area, Axes, Canvas, Figure, Grid, Ink, Panel, Points, Scale, Stroke, directed, extent,
};
use crate::light::{Light, Scene};
use crate::number::numeral;
use crate::results::Study;

use super::SIX;

/// Light scene of the training samples.
const LEARNT_IN: &str = SensorFacts::REFERENCE_SCENE;

/// Lighting scores of one channel, for all sensors that ambient light reaches.
struct Sheet {
    channel: &'static str,
    /// Lighting scores by the position of the study.
    sensors: Vec<(usize, Light)>,
}

pub(super) fn draw(studies: &[Study], room: Option<f64>) -> Option<Figure> {
    let names = crate::names::names(studies);
    let sheets: Vec<Sheet> = SIX
        .into_iter()
        .map(|channel| Sheet::of(studies, channel))
        .filter(|sheet| !sheet.sensors.is_empty())
        .collect();
    if sheets.is_empty() {
        return None;
    }
    let scenes = in_order(sheets.iter().flat_map(Sheet::scenes));
    let (sensors, others): (Vec<usize>, Vec<usize>) = (0..studies.len()).partition(|at| {
        let mut all = sheets.iter().flat_map(|sheet| &sheet.sensors);
        all.any(|(of, _)| of == at)
    });
    let legend: Vec<(usize, String)> = sensors.iter().map(|at| (*at, names[*at].clone())).collect();
    let first = Area {
        left: 58.0,
        top: 54.0,
        width: 216.0,
        height: 168.0,
    };
    let grid = Grid::new(sheets.len(), 3, first, [66.0, 122.0]).within(room, 16.0);
    let mut canvas = grid.canvas([16.0, 86.0]);
    canvas.dot_legend([first.left, 16.0], &legend);
    for (position, sheet) in sheets.iter().enumerate() {
        sheet.draw(grid.area(position), &scenes, &legend, &mut canvas);
    }
    Some(Figure {
        id: "lighting".to_owned(),
        title: "Error by lighting scene".to_owned(),
        caption: caption(studies, &names, &others),
        description: format!(
            "Mean absolute error by lighting scene ({}) over that in unchanged light, of {}.",
            crate::names::listed(&scenes),
            crate::names::listed(&legend.into_iter().map(|(_, name)| name).collect::<Vec<_>>())
        ),
        canvas,
    })
}

fn caption(studies: &[Study], names: &[String], others: &[usize]) -> String {
    let lit = others
        .iter()
        .filter(|at| studies[**at].of_metric("r_light").next().is_some());
    let lit: Vec<String> = lit.map(|at| names[*at].clone()).collect();
    let without = match lit.is_empty() {
        true => String::new(),
        false => format!(
            " The results of {} have no errors by scene and are not drawn.",
            crate::names::listed(&lit)
        ),
    };
    format!(
        "Mean absolute error in each lighting scene, divided by that of the same presses in unchanged light, the training scene “{LEARNT_IN}”. 1 is no change, 10 is ten times the error. The axis is logarithmic. Predictions are not clipped to the bounds of the model, as in r_light. Sensors that no light reaches are not shown. Point at a dot for the light itself.{without}"
    )
}

/// Distinct names of scenes, sorted.
fn in_order<'a>(scenes: impl Iterator<Item = &'a Scene>) -> Vec<String> {
    let mut all: Vec<&str> = scenes.map(|scene| scene.name.as_str()).collect();
    all.sort_unstable();
    all.dedup();
    all.into_iter().map(str::to_owned).collect()
}

/// Error ratio of a scene; `None` if a logarithmic axis cannot show the ratio.
fn drawn(scene: &Scene) -> Option<f64> {
    scene.error.filter(|ratio| *ratio > 0.0)
}

impl Sheet {
    fn of(studies: &[Study], channel: &'static str) -> Sheet {
        let of_one = |(at, study): (usize, &Study)| {
            let light = Light::of(study.score("r_light", channel)?);
            let is_drawn = light.scenes.iter().any(|scene| drawn(scene).is_some());
            is_drawn.then_some((at, light))
        };
        Sheet {
            channel,
            sensors: studies.iter().enumerate().filter_map(of_one).collect(),
        }
    }

    fn scenes(&self) -> impl Iterator<Item = &Scene> {
        self.sensors.iter().flat_map(|(_, light)| &light.scenes)
    }

    fn draw(&self, area: Area, scenes: &[String], legend: &[(usize, String)], canvas: &mut Canvas) {
        let Some([low, high]) = extent(self.scenes().filter_map(drawn).chain([1.0])) else {
            return;
        };
        let panel = Panel {
            area,
            x: Scale::linear([-0.5, scenes.len() as f64 - 0.5], area.across()),
            y: Scale::logarithmic([low / 1.15, high * 1.15], area.upwards()),
        };
        let axes = Axes {
            title: self.channel.to_owned(),
            x: "lighting scene".to_owned(),
            y: directed("error, untouched = 1", "mae"),
        };
        panel.axes_of_names(&axes, scenes, canvas);
        let unchanged = panel.y.at(1.0);
        canvas.line(
            [area.left, unchanged],
            [area.right(), unchanged],
            Stroke::thin(Ink::Muted),
        );
        let spread = 0.7 / legend.len() as f64;
        for (place, (at, name)) in legend.iter().enumerate() {
            let Some((_, light)) = self.sensors.iter().find(|(of, _)| of == at) else {
                continue;
            };
            let aside = (place as f64 - (legend.len() - 1) as f64 / 2.0) * spread;
            let mut points = Points::default();
            for scene in &light.scenes {
                let column = scenes.iter().position(|name| *name == scene.name);
                let (Some(column), Some(ratio)) = (column, drawn(scene)) else {
                    continue;
                };
                points.at.push(panel.at(column as f64 + aside, ratio));
                let light = scene.light.map_or_else(String::new, |light| {
                    format!(", light {} times", numeral(light))
                });
                points.words.push(format!(
                    "{name}, scene {}: error {} times that in unchanged light{light}",
                    scene.name,
                    numeral(ratio),
                ));
            }
            canvas.points(points, Ink::Series(*at), 3.6, 1.0);
        }
    }
}
