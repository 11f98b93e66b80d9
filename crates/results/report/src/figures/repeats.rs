//! Spread of predictions of the same press, over depth and by position.

use crate::figure::{
    Area, Axes, Canvas, Figure, Grid, Ink, Panel, Points, Scale, Stroke, extent, short,
};
use crate::number::numeral;
use crate::results::Study;
use taceva_results::Samples;

use super::levels::sheets;
use super::overlay::{Ways, Words, draw as overlay};

/// Factor by which the drawing enlarges the spread.
const LARGER: f64 = 3.0;

pub(super) fn curves(studies: &[Study], room: Option<f64>) -> Option<Figure> {
    let words = Words {
        id: "repeatability",
        title: "Repeatability over depth",
        caption: "Standard deviation of predictions of the same press at each step of depth, mean over points.".to_owned(),
        description: format!("Repeatability over steps of depth, by channel, of {}.", crate::names::all(studies)),
    };
    let sheets = sheets(
        studies,
        "repeatability",
        "step of depth (count)",
        "spread σ",
        Ways::Straight,
    );
    overlay(&sheets, studies, 3, words, room)
}

/// Predictions of one contact point at the greatest depth that all of its presses reach.
struct Cloud {
    point: String,
    mean: [f64; 3],
    spread: [f64; 3],
    n: usize,
}

pub(super) fn volumes(studies: &[Study], room: Option<f64>) -> Option<Figure> {
    let names = crate::names::names(studies);
    let clouds: Vec<(usize, Vec<Cloud>)> = studies
        .iter()
        .enumerate()
        .filter_map(|(at, study)| Some((at, clouds(study.samples.as_ref()?))))
        .filter(|(_, clouds)| !clouds.is_empty())
        .collect();
    if clouds.is_empty() {
        return None;
    }
    let first = Area {
        left: 58.0,
        top: 34.0,
        width: 300.0,
        height: 300.0,
    };
    let grid = Grid::new(clouds.len(), 2, first, [74.0, 82.0]).within(room, 16.0);
    let mut canvas = grid.canvas([16.0, 42.0]);
    for (position, (at, clouds)) in clouds.iter().enumerate() {
        let area = grid.area(position);
        panel(clouds, *at, &names[*at], area, &mut canvas);
    }
    Some(Figure {
        id: "repeatability-volumes".to_owned(),
        title: "Repeatability by place".to_owned(),
        caption: format!(
            "Spread of predictions of repeated presses at the deepest repeated step. Half axes of an ellipse: standard deviations of Px and Py. Bar beside it: that of Pz. All are enlarged {LARGER} times."
        ),
        description: format!(
            "Ellipses of repeated predictions over the surface of {}.",
            crate::names::listed(&names)
        ),
        canvas,
    })
}

fn panel(clouds: &[Cloud], at: usize, name: &str, area: Area, canvas: &mut Canvas) {
    let reach = |axis: usize| {
        clouds.iter().flat_map(move |cloud| {
            [-1.0, 1.0].map(|side| cloud.mean[axis] + side * LARGER * cloud.spread[axis])
        })
    };
    let Some([low, high]) = extent(reach(0).chain(reach(1))) else {
        return;
    };
    let panel = Panel {
        area,
        x: Scale::round([low, high], area.across()),
        y: Scale::round([low, high], area.upwards()),
    };
    let axes = Axes {
        title: short(name, 40),
        x: "Px (mm)".to_owned(),
        y: "Py (mm)".to_owned(),
    };
    panel.axes(&axes, canvas);
    let mut centres = Points::default();
    for cloud in clouds {
        let [x, y, _] = cloud.mean;
        let [half_x, half_y, half_z] = cloud.spread.map(|spread| spread * LARGER);
        let ring = (0..=36).map(|step| {
            let angle = f64::from(step) * std::f64::consts::TAU / 36.0;
            panel.at(x + half_x * angle.cos(), y + half_y * angle.sin())
        });
        let ring: Vec<[f64; 2]> = ring.collect();
        canvas.area(ring.clone(), Ink::Series(at), 0.25);
        canvas.path(
            ring,
            Stroke {
                width: 1.2,
                ..Stroke::thin(Ink::Series(at))
            },
        );
        let [right, middle] = panel.at(x + half_x, y);
        let [_, tip] = panel.at(x, y + half_z);
        let bar = Stroke {
            width: 2.4,
            ..Stroke::thin(Ink::Text)
        };
        canvas.line([right + 5.0, middle], [right + 5.0, tip], bar);
        centres.at.push(panel.at(x, y));
        let [sx, sy, sz] = cloud.spread.map(numeral);
        centres.words.push(format!(
            "point {}: spread {sx}, {sy}, {sz} mm in x, y, z, n = {}",
            short(&cloud.point, 20),
            cloud.n
        ));
    }
    canvas.points(centres, Ink::Series(at), 2.6, 1.0);
}

/// Clouds of all contact points that were pressed at least twice.
fn clouds(samples: &Samples) -> Vec<Cloud> {
    let Some(channels) = ["Px", "Py", "Pz"]
        .into_iter()
        .map(|name| samples.channel(name))
        .collect::<Option<Vec<_>>>()
    else {
        return Vec::new();
    };
    if !samples.has("protocol") {
        return Vec::new();
    }
    // By point and depth step; later steps are deeper.
    let mut cells: std::collections::BTreeMap<(&str, u64), Vec<[f64; 3]>> = Default::default();
    for row in samples.of_protocol("repeatability") {
        let step = samples.number("depth_step", row);
        let (Some(point), Some(step)) = (samples.word("point_id", row), step) else {
            continue;
        };
        let place: Option<Vec<f64>> = channels
            .iter()
            .map(|channel| channel.prediction(row))
            .collect();
        if let Some(Ok(place)) = place.map(TryInto::try_into) {
            cells
                .entry((point, step.to_bits()))
                .or_default()
                .push(place);
        }
    }
    let mut deepest: std::collections::BTreeMap<&str, Vec<[f64; 3]>> = Default::default();
    for ((point, _), places) in cells {
        if places.len() > 1 {
            deepest.insert(point, places);
        }
    }
    deepest
        .into_iter()
        .map(|(point, places)| Cloud::of(point, &places))
        .collect()
}

impl Cloud {
    fn of(point: &str, places: &[[f64; 3]]) -> Cloud {
        let count = places.iter().fold(0.0, |count, _| count + 1.0);
        let mean: [f64; 3] =
            std::array::from_fn(|axis| places.iter().map(|place| place[axis]).sum::<f64>() / count);
        let spread = std::array::from_fn(|axis| {
            let squares = places
                .iter()
                .map(|place| (place[axis] - mean[axis]).powi(2));
            (squares.sum::<f64>() / (count - 1.0)).sqrt()
        });
        Cloud {
            point: point.to_owned(),
            mean,
            spread,
            n: places.len(),
        }
    }
}
