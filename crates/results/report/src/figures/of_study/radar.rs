//! Radar charts of given values, including values that verdicts exclude.

use taceva_metrics::Better;

use super::super::radar::shares;
use super::super::radar_web::{Rim, WIDTH, outline, web};
use crate::figure::{Canvas, Figure};
use crate::results::Study;

/// Axis of a radar chart, with one given value for each study.
pub(super) struct Spoke {
    /// Name of the axis. The first word has its own line.
    pub(super) name: String,
    pub(super) better: Better,
    pub(super) values: Vec<Option<f64>>,
}

/// Draws a radar chart of `spokes`; `None` without any value.
pub(super) fn draw_spokes(
    studies: &[Study],
    spokes: &[Spoke],
    title: &str,
    caption: String,
) -> Option<Figure> {
    let names = crate::names::names(studies);
    let shares: Vec<Vec<Option<(f64, f64)>>> = spokes
        .iter()
        .map(|spoke| shares(&spoke.values, spoke.better))
        .collect();
    let is_drawn = |at: &usize| shares.iter().any(|axis| axis[*at].is_some());
    let drawn: Vec<usize> = (0..studies.len()).filter(is_drawn).collect();
    if drawn.is_empty() {
        return None;
    }
    let mut canvas = Canvas::new(WIDTH, 400.0);
    let legend: Vec<(usize, String)> = drawn.iter().map(|&at| (at, names[at].clone())).collect();
    canvas.legend([12.0, 18.0], &legend);
    let centre = [WIDTH / 2.0, 226.0];
    let of_axes = spokes.iter().map(|spoke| Rim {
        name: spoke.name.as_str(),
        better: spoke.better,
    });
    let of_axes: Vec<Rim<'_>> = of_axes.collect();
    web(&of_axes, centre, &mut canvas);
    for &at in &drawn {
        let of_one: Vec<Option<(f64, f64)>> = shares.iter().map(|axis| axis[at]).collect();
        outline(&of_one, &of_axes, centre, at, &names[at], &mut canvas);
    }
    let listed: Vec<&str> = spokes.iter().map(|spoke| spoke.name.as_str()).collect();
    Some(Figure {
        id: String::new(),
        title: title.to_owned(),
        caption,
        description: format!("A radar of {}.", listed.join(", ")),
        canvas,
    })
}
