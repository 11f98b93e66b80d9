//! Sensitivity of the gel, by position.

use crate::figure::{Figure, Grid, short};
use crate::number::with_interval;
use crate::results::Study;
use taceva_results::Value;

use super::heat::{Heat, draw as heat};

pub(super) fn draw(studies: &[Study]) -> Option<Figure> {
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
    let (grid, mut canvas) = Grid::of_maps(maps.len());
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
