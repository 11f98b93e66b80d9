//! Figure 7b of the TacEva study: repeatability over the depth in mm, with one panel for each sensor. Positions use the left axis, forces the right
//! axis.

use std::collections::BTreeMap;

use crate::figure::{
    Anchor, Area, Axes, Figure, Grid, Ink, Label, Panel, Points, Scale, Stroke, extent, short,
};
use crate::number::numeral;
use crate::results::Study;
use crate::variables::VARIABLES;
use taceva_results::{Samples, Value};

/// Curve of a plane: index of the plane, then pairs of depth in mm and spread.
type Curve = (usize, Vec<(f64, Option<f64>)>);

pub(super) fn draw(studies: &[Study], room: Option<f64>) -> Option<Figure> {
    let names = crate::names::names(studies);
    let found: Vec<(usize, Vec<Curve>)> = studies
        .iter()
        .map(curves)
        .enumerate()
        .filter(|(_, curves)| !curves.is_empty())
        .collect();
    if found.is_empty() {
        return None;
    }
    let first = Area {
        left: 58.0,
        top: 54.0,
        width: 300.0,
        height: 200.0,
    };
    let grid = Grid::new(found.len(), 2, first, [122.0, 82.0]).within(room, 62.0);
    let mut canvas = grid.canvas([62.0, 42.0]);
    let legend = VARIABLES.iter().enumerate();
    let legend: Vec<(usize, String)> = legend
        .map(|(at, plane)| (at, format!("σ {plane}")))
        .collect();
    canvas.legend([first.left, 16.0], &legend);
    for (position, (at, curves)) in found.iter().enumerate() {
        let area = grid.area(position);
        let all = || curves.iter().flat_map(|(_, levels)| levels);
        let Some(depths) = extent(all().map(|(depth, _)| *depth)) else {
            continue;
        };
        let scale = |is_force: bool| {
            let own = curves.iter().filter(|(plane, _)| (*plane > 1) == is_force);
            let values = own.flat_map(|(_, levels)| levels.iter().filter_map(|(_, value)| *value));
            let [low, high] = extent(values.chain([0.0])).unwrap_or([0.0, 1.0]);
            Scale::round([low, high], area.upwards())
        };
        let x = Scale::padded(depths, area.across());
        let [positions, forces] = [false, true].map(|is_force| Panel {
            area,
            x,
            y: scale(is_force),
        });
        let axes = Axes {
            title: short(&names[*at], 40),
            x: "depth (mm)".to_owned(),
            y: "σ of position (mm) ↓".to_owned(),
        };
        positions.axes(&axes, &mut canvas);
        for tick in forces.y.ticks((area.height / 34.0).clamp(2.0, 8.0)) {
            let at = [area.right() + 6.0, forces.y.at(tick.value) + 4.0];
            canvas.label(Label::new(at, tick.label, Anchor::Start));
        }
        let right = [area.right(), area.bottom()];
        canvas.line([area.right(), area.top], right, Stroke::thin(Ink::Muted));
        let mut label = Label::new(
            [area.right() + 54.0, area.top + area.height / 2.0],
            "σ of force (N) ↓",
            Anchor::Middle,
        );
        label.upwards = true;
        canvas.label(label);
        for (plane, levels) in curves {
            let panel = if *plane > 1 { forces } else { positions };
            panel.curve(levels.iter().copied(), Stroke::series(*plane), &mut canvas);
            let mut points = Points::default();
            for (depth, value) in levels {
                if let Some(value) = value {
                    points.at.push(panel.at(*depth, *value));
                    points.words.push(format!(
                        "σ {} at {} mm: {}",
                        VARIABLES[*plane],
                        numeral(*depth),
                        numeral(*value)
                    ));
                }
            }
            canvas.points(points, Ink::Series(*plane), 1.8, 1.0);
        }
    }
    Some(Figure {
        id: "figure-7b".to_owned(),
        title: "Figure 7b: repeatability over depth".to_owned(),
        caption: "Standard deviation of predictions of the same press at each step of depth, mean over points; the depth is the mean of the true depths of a step. Positions belong to the left axis, forces to the right one.".to_owned(),
        description: format!(
            "Repeatability over depth in mm of {}.",
            crate::names::listed(&names)
        ),
        canvas,
    })
}

/// Curves of every plane, over the mean true depth of each step.
fn curves(study: &Study) -> Vec<Curve> {
    let Some(depths) = study.samples.as_ref().map(depths) else {
        return Vec::new();
    };
    let of_plane = |(at, plane): (usize, &&str)| {
        let score = study.score("repeatability", plane)?;
        let Value::Curve(curve) = &score.variant("curve")?.value else {
            return None;
        };
        let levels = curve.x.iter().zip(&curve.values);
        let levels =
            levels.filter_map(|(step, value)| Some((*depths.get(&step.to_bits())?, *value)));
        let levels: Vec<(f64, Option<f64>)> = levels.collect();
        (!levels.is_empty()).then_some((at, levels))
    };
    VARIABLES.iter().enumerate().filter_map(of_plane).collect()
}

/// Mean true depth of each step, in mm, by the bits of the step number.
fn depths(samples: &Samples) -> BTreeMap<u64, f64> {
    let mut sums: BTreeMap<u64, (f64, f64)> = BTreeMap::new();
    let Some(depth) = samples.channel("Pz").filter(|_| samples.has("protocol")) else {
        return BTreeMap::new();
    };
    for row in samples.of_protocol("repeatability") {
        if let (Some(step), Some(depth)) = (samples.number("depth_step", row), depth.truth(row)) {
            let (sum, count) = sums.entry(step.to_bits()).or_default();
            *sum += depth;
            *count += 1.0;
        }
    }
    let means = sums.into_iter();
    means
        .map(|(step, (sum, count))| (step, sum / count))
        .collect()
}
