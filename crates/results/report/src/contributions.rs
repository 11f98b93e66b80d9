//! Bar chart of a budget: signed contribution of each source as a bar, and the expanded uncertainty U as a line.

use taceva_metrology::budget::{Budget, Source};

use crate::figure::{Anchor, Area, Axes, Canvas, Figure, Ink, Label, Panel, Scale, Stroke, short};
use crate::number::numeral;

/// Least and greatest width of the plotting area, in canvas units.
const PLACE: [f64; 2] = [240.0, 640.0];
/// Half of the width of a bar, as a share of its space.
const HALF: f64 = 0.3;

/// Figure number `number` of a page; `None` without an uncertainty.
pub(crate) fn draw(budget: &Budget, number: usize) -> Option<Figure> {
    if budget.sources.is_empty() || budget.u <= 0.0 {
        return None;
    }
    let expanded = budget.half_width();
    let contributions = || budget.sources.iter().map(|source| source.contribution);
    let low = contributions().fold(0.0, f64::min);
    let high = contributions().fold(expanded.unwrap_or(budget.u), f64::max);
    let count = budget.sources.len() as f64;
    let area = Area {
        left: 70.0,
        top: 34.0,
        width: (90.0 * count).clamp(PLACE[0], PLACE[1]),
        height: 220.0,
    };
    let panel = Panel {
        area,
        x: Scale::linear([-0.5, count - 0.5], area.across()),
        y: Scale::round([low, high * 1.05], area.upwards()),
    };
    let mut canvas = Canvas::new(area.right() + 24.0, area.bottom() + 96.0);
    let at = budget.at.map_or_else(String::new, |at| {
        format!(" at {} {}", numeral(at), budget.unit)
    });
    let axes = Axes {
        title: short(&format!("{}{at}", budget.measurand), 40),
        x: "source".to_owned(),
        y: format!("contribution c u ({})", short(&budget.unit, 12)),
    };
    let names: Vec<String> = budget.sources.iter().map(|of| of.name.clone()).collect();
    panel.axes_of_names(&axes, &names, &mut canvas);
    for (position, source) in budget.sources.iter().enumerate() {
        bar(source, position as f64, budget, &panel, &mut canvas);
    }
    if let Some(expanded) = expanded {
        let y = panel.y.at(expanded);
        let stroke = Stroke {
            dash: "5 3",
            ..Stroke::thin(Ink::Text)
        };
        canvas.line([area.left, y], [area.right(), y], stroke);
        canvas.label(Label::new(
            [area.right() + 5.0, y + 4.0],
            "U",
            Anchor::Start,
        ));
    }
    Some(Figure {
        id: format!("contributions-{number}"),
        title: format!("Contributions to the uncertainty{at}"),
        caption: format!(
            "Standard uncertainty of each source times its sensitivity, with its sign. The dashed line is the expanded uncertainty. {}.",
            budget.statement()
        ),
        description: format!("Bars of {}.", crate::names::listed(&names)),
        canvas,
    })
}

fn bar(source: &Source, position: f64, budget: &Budget, panel: &Panel, canvas: &mut Canvas) {
    let [left, top] = panel.at(position - HALF, source.contribution.max(0.0));
    let [right, bottom] = panel.at(position + HALF, source.contribution.min(0.0));
    let share = source.share.map_or_else(String::new, |share| {
        format!(", {} % of the variance", numeral(100.0 * share))
    });
    let words = format!(
        "{}: {} {}{share}",
        short(&source.name, 40),
        numeral(source.contribution),
        budget.unit
    );
    let place = [left, top, right - left, (bottom - top).max(0.5)];
    canvas.fill(place, Ink::Series(0), words);
}
