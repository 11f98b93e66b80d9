//! Distance between the surfaces of two sensor units, by position.

use std::collections::BTreeMap;

use crate::figure::{
    Anchor, Area, Axes, Canvas, Figure, Grid, Ink, Label, Panel, Points, Scale, diverging, extent,
    short,
};
use crate::number::{numeral, with_interval};
use crate::results::Study;
use taceva_results::Samples;

/// Contact point that was measured on two units.
struct Gap {
    at: [f64; 2],
    height: f64,
}

pub(super) fn draw(studies: &[Study], room: Option<f64>) -> Option<Figure> {
    let names = crate::names::names(studies);
    let found: Vec<(usize, Vec<Gap>, [String; 2])> = studies
        .iter()
        .enumerate()
        .filter_map(|(at, study)| {
            let (gaps, units) = gaps(study.samples.as_ref()?)?;
            Some((at, gaps, units))
        })
        .collect();
    if found.is_empty() {
        return None;
    }
    let (grid, mut canvas) = Grid::of_maps(found.len(), room);
    let mut words = Vec::new();
    for (position, (at, gaps, units)) in found.iter().enumerate() {
        let area = grid.area(position);
        let title = format!(
            "{}: unit {} minus {}",
            short(&names[*at], 24),
            short(&units[1], 8),
            short(&units[0], 8)
        );
        panel(gaps, title, area, &mut canvas);
        let score = studies[*at].of_metric("inter_sensor").next();
        words.extend(score.map(|score| format!("{}: {}", names[*at], with_interval(score))));
    }
    Some(Figure {
        id: "units".to_owned(),
        title: "Differences between units".to_owned(),
        caption: format!(
            "Height of the surface of the second unit minus that of the first at the same points, as measured, before the two surfaces are aligned. Mean distance of the aligned surfaces: {}.",
            words.join("; ")
        ),
        description: format!(
            "Maps of differences in height of {}.",
            crate::names::listed(&names)
        ),
        canvas,
    })
}

fn panel(gaps: &[Gap], title: String, area: Area, canvas: &mut Canvas) {
    let reach = extent(gaps.iter().flat_map(|gap| gap.at)).unwrap_or([-1.0, 1.0]);
    let panel = Panel {
        area,
        x: Scale::round(reach, area.across()),
        y: Scale::round(reach, area.upwards()),
    };
    let axes = Axes {
        title,
        x: "x (mm)".to_owned(),
        y: "y (mm)".to_owned(),
    };
    panel.axes(&axes, canvas);
    let most = gaps.iter().map(|gap| gap.height.abs()).fold(0.0, f64::max);
    let most = most.max(f64::MIN_POSITIVE);
    for gap in gaps {
        let points = Points {
            at: vec![panel.at(gap.at[0], gap.at[1])],
            words: vec![format!(
                "at ({}, {}) mm: {} mm",
                numeral(gap.at[0]),
                numeral(gap.at[1]),
                numeral(gap.height)
            )],
        };
        // An outline keeps dots near zero visible on white.
        let rim = Points {
            words: Vec::new(),
            ..points.clone()
        };
        canvas.points(rim, Ink::Muted, 5.0, 0.6);
        canvas.points(points, Ink::Rgb(diverging(gap.height / most)), 4.4, 1.0);
    }
    let (left, top) = (area.right() + 12.0, area.top);
    for step in 0..40 {
        let share = f64::from(step) / 19.5 - 1.0;
        let piece = area.height / 40.0;
        let y = top + area.height - f64::from(step + 1) * piece;
        canvas.fill(
            [left, y, 10.0, piece + 0.4],
            Ink::Rgb(diverging(share)),
            String::new(),
        );
    }
    let scale = Scale::linear([-most, most], area.upwards());
    for tick in scale.ticks(4.0) {
        let at = [left + 15.0, scale.at(tick.value) + 4.0];
        canvas.label(Label::new(at, tick.label, Anchor::Start));
    }
    canvas.label(Label::new([left + 5.0, top - 9.0], "mm", Anchor::Middle));
}

/// Contact points that the first two units, ordered by name, have in common, and the names of these units.
fn gaps(samples: &Samples) -> Option<(Vec<Gap>, [String; 2])> {
    let channels = ["Px", "Py", "surface_z"].map(|name| samples.channel(name));
    let [Some(x), Some(y), Some(height)] = channels else {
        return None;
    };
    let mut points: BTreeMap<&str, BTreeMap<&str, [f64; 3]>> = BTreeMap::new();
    let mut units: Vec<&str> = Vec::new();
    for row in samples.of_protocol("surface-map") {
        let place = [x.truth(row), y.truth(row), height.truth(row)];
        let ([Some(x), Some(y), Some(z)], Some(unit), Some(point)) = (
            place,
            samples.word("unit_id", row),
            samples.word("point_id", row),
        ) else {
            continue;
        };
        units.push(unit);
        points.entry(point).or_default().insert(unit, [x, y, z]);
    }
    units.sort_unstable();
    units.dedup();
    let [first, second] = [*units.first()?, *units.get(1)?];
    let gap = |found: &BTreeMap<&str, [f64; 3]>| {
        let [x, y, low] = *found.get(first)?;
        let [_, _, high] = *found.get(second)?;
        Some(Gap {
            at: [x, y],
            height: high - low,
        })
    };
    let gaps: Vec<Gap> = points.values().filter_map(gap).collect();
    (!gaps.is_empty()).then(|| (gaps, [first, second].map(str::to_owned)))
}
