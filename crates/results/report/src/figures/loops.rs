//! Loading and unloading curves: force over depth.

use std::collections::BTreeMap;

use crate::figure::{
    Area, Axes, Canvas, Figure, Grid, Ink, Panel, Points, Scale, Stroke, extent, short,
};
use crate::number::{numeral, with_interval};
use crate::results::Study;
use taceva_results::Samples;

/// Greatest number of contact points whose loops are drawn.
const MOST: usize = 12;

/// Loading and unloading branch of one contact point, as pairs of depth and force.
#[derive(Default)]
struct Loop {
    load: Vec<[f64; 2]>,
    unload: Vec<[f64; 2]>,
}

pub(super) fn draw(studies: &[Study], room: Option<f64>) -> Option<Figure> {
    let names = crate::names::names(studies);
    let found: Vec<(usize, BTreeMap<String, Loop>)> = studies
        .iter()
        .enumerate()
        .filter_map(|(at, study)| Some((at, loops(study.samples.as_ref()?))))
        .filter(|(_, loops)| !loops.is_empty())
        .collect();
    if found.is_empty() {
        return None;
    }
    let first = Area {
        left: 58.0,
        top: 34.0,
        width: 330.0,
        height: 220.0,
    };
    let grid = Grid::new(found.len(), 2, first, [66.0, 78.0]).within(room, 16.0);
    let mut canvas = grid.canvas([16.0, 42.0]);
    let mut words = Vec::new();
    for (position, (at, loops)) in found.iter().enumerate() {
        let area = grid.area(position);
        panel(loops, *at, &names[*at], area, &mut canvas);
        let score = studies[*at].of_metric("hysteresis").next();
        words.extend(score.map(|score| format!("{}: {}", names[*at], with_interval(score))));
    }
    Some(Figure {
        id: "hysteresis".to_owned(),
        title: "Loading and unloading".to_owned(),
        caption: format!(
            "True normal force over true depth while loading (solid lines) and unloading (dashed lines). At most {MOST} points of each sensor are drawn, in the order of their names. Area between the branches: {}.",
            words.join("; ")
        ),
        description: format!(
            "Load and unload curves of force over depth of {}.",
            crate::names::listed(&names)
        ),
        canvas,
    })
}

fn panel(loops: &BTreeMap<String, Loop>, at: usize, name: &str, area: Area, canvas: &mut Canvas) {
    let all = || {
        loops
            .values()
            .take(MOST)
            .flat_map(|found| found.load.iter().chain(&found.unload))
    };
    let ends = |axis: usize| extent(all().map(|pair| pair[axis]).chain([0.0]));
    let (Some(x), Some(y)) = (ends(0), ends(1)) else {
        return;
    };
    let panel = Panel {
        area,
        x: Scale::padded(x, area.across()),
        y: Scale::round(y, area.upwards()),
    };
    let axes = Axes {
        title: short(name, 40),
        x: "depth Pz (mm)".to_owned(),
        y: "force Fz (N)".to_owned(),
    };
    panel.axes(&axes, canvas);
    for (point, found) in loops.iter().take(MOST) {
        let mut hovers = Points::default();
        for (branch, dash, word) in [
            (&found.load, "", "loading"),
            (&found.unload, "4 3", "unloading"),
        ] {
            let stroke = Stroke {
                ink: Ink::Series(at),
                width: 1.2,
                dash,
            };
            let line = branch.iter().map(|[depth, force]| panel.at(*depth, *force));
            hovers.at.extend(line.clone());
            canvas.path(line.collect(), stroke);
            hovers.words.extend(branch.iter().map(|[depth, force]| {
                format!(
                    "point {}, {word}: {} N at {} mm",
                    short(point, 20),
                    numeral(*force),
                    numeral(*depth)
                )
            }));
        }
        canvas.points(hovers, Ink::Series(at), 2.5, 0.0);
    }
}

/// Loop of each contact point that has both branches, sorted by depth.
fn loops(samples: &Samples) -> BTreeMap<String, Loop> {
    let mut loops: BTreeMap<String, Loop> = BTreeMap::new();
    let (Some(depth), Some(force)) = (samples.channel("Pz"), samples.channel("Fz")) else {
        return loops;
    };
    for row in samples.of_protocol("load-unload") {
        let (Some(depth), Some(force)) = (depth.truth(row), force.truth(row)) else {
            continue;
        };
        let Some(point) = samples.word("point_id", row) else {
            continue;
        };
        let phase = samples.word("phase", row);
        let found = loops.entry(point.to_owned()).or_default();
        match phase {
            Some("load") => found.load.push([depth, force]),
            Some("unload") => found.unload.push([depth, force]),
            _ => {}
        }
    }
    loops.retain(|_, found| found.load.len() > 1 && found.unload.len() > 1);
    for found in loops.values_mut() {
        for branch in [&mut found.load, &mut found.unload] {
            branch.sort_by(|left, right| left[0].total_cmp(&right[0]));
        }
    }
    loops
}
