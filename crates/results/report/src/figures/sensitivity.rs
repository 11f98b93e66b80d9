//! Sensitivity of the gel, by position.

use taceva_core::Unit;
use taceva_metrics::Map;

use crate::figure::{Figure, Grid, extent, short};
use crate::number::with_interval;
use crate::results::Study;
use taceva_results::Value;

use super::heat::{Heat, draw as heat, inner_range};

/// Maps of all sensors on one logarithmic colour scale; `None` without maps.
pub(super) fn on_one_scale(studies: &[Study], room: Option<f64>) -> Option<Figure> {
    let names = crate::names::names(studies);
    let maps: Vec<(&str, &Map, Unit)> = studies
        .iter()
        .zip(&names)
        .filter_map(|(study, name)| {
            let score = study.of_metric("sensitivity").next()?;
            match &score.variant("map")?.value {
                Value::Map(map) => Some((name.as_str(), map, score.unit)),
                _ => None,
            }
        })
        .collect();
    let ends = maps
        .iter()
        .filter_map(|(_, map, _)| inner_range(&map.values));
    let shared = extent(ends.flatten().filter(|value| *value > 0.0))?;
    let (grid, mut canvas) = Grid::of_maps(maps.len(), room);
    for (position, (name, map, unit)) in maps.iter().enumerate() {
        let map = Heat {
            map,
            title: short(name, 40),
            what: "S",
            unit: *unit,
            shared: Some(shared),
        };
        heat(&map, grid.area(position), &mut canvas);
    }
    Some(Figure {
        id: "figure-4".to_owned(),
        title: "Figure 4: sensitivity by place".to_owned(),
        caption: "Mean of indentation over normal force in each cell of the sensing surface, in the colours of one logarithmic scale for all sensors; cells without a press are empty.".to_owned(),
        description: format!(
            "Maps of sensitivity on one scale of {}.",
            crate::names::listed(&names)
        ),
        canvas,
    })
}

pub(super) fn draw(studies: &[Study], room: Option<f64>) -> Option<Figure> {
    let names = crate::names::names(studies);
    let mut maps = Vec::new();
    for (study, name) in studies.iter().zip(&names) {
        let Some(score) = study.of_metric("sensitivity").next() else {
            continue;
        };
        let Some(Value::Map(map)) = score.variant("map").map(|variant| &variant.value) else {
            continue;
        };
        let uniformity = study.of_metric("uniformity").next();
        let uniformity = uniformity.map_or_else(String::new, |uniformity| {
            format!(", U = {}", with_interval(uniformity))
        });
        maps.push((
            Heat {
                map,
                title: short(name, 40),
                what: "S",
                unit: score.unit,
                shared: None,
            },
            format!(
                "{}: S = {}{uniformity}",
                short(name, 40),
                with_interval(score)
            ),
        ));
    }
    if maps.is_empty() {
        return None;
    }
    let (grid, mut canvas) = Grid::of_maps(maps.len(), room);
    for (position, (map, _)) in maps.iter().enumerate() {
        heat(map, grid.area(position), &mut canvas);
    }
    let words: Vec<String> = maps.into_iter().map(|(_, words)| words).collect();
    Some(Figure {
        id: "sensitivity".to_owned(),
        title: "Sensitivity by place".to_owned(),
        caption: format!(
            "Mean of indentation over normal force in each cell of the sensing surface; cells without a press are empty. Each map has its own colours, from the 2nd to the 98th percentile of its cells. {}.",
            words.join("; ")
        ),
        description: format!(
            "Maps of sensitivity over the surface. {}.",
            words.join("; ")
        ),
        canvas,
    })
}
