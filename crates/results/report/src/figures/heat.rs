//! Heat map: coloured numbers by position, with a colour scale.

use taceva_core::Unit;
use taceva_metrics::Map;

use crate::figure::{Anchor, Area, Axes, Canvas, Ink, Label, Panel, Scale, axis_label, sequential};
use crate::number::numeral;

/// Greatest number of cells in a drawn map.
const MOST_CELLS: usize = 10_000;

/// Content of a heat map.
pub(super) struct Heat<'a> {
    pub(super) map: &'a Map,
    pub(super) title: String,
    /// Name of the drawn quantity: `sensitivity`.
    pub(super) what: &'a str,
    pub(super) unit: Unit,
    /// Ends of a logarithmic scale that several maps share; `None` for a linear scale of its own.
    pub(super) shared: Option<[f64; 2]>,
}

/// Draws `heat` into `area`, or a remark if the map has too many cells.
pub(super) fn draw(heat: &Heat<'_>, area: Area, canvas: &mut Canvas) {
    let Map {
        x_mm,
        y_mm,
        values,
        counts,
        ..
    } = heat.map;
    let cells = values.iter().map(Vec::len).sum::<usize>();
    let ends = |edges: &[f64]| {
        [edges.first().copied(), edges.last().copied()].map(|end| end.unwrap_or(0.0))
    };
    let panel = Panel {
        area,
        x: Scale::linear(ends(x_mm), area.across()),
        y: Scale::linear(ends(y_mm), area.upwards()),
    };
    panel.axes(
        &Axes {
            title: heat.title.clone(),
            x: "x (mm)".to_owned(),
            y: "y (mm)".to_owned(),
        },
        canvas,
    );
    if cells > MOST_CELLS {
        let at = [area.left + area.width / 2.0, area.top + area.height / 2.0];
        let words = format!("{cells} cells: too many to draw");
        canvas.label(Label::new(at, words, Anchor::Middle));
        canvas.is_remarked = true;
        return;
    }
    let Some([low, high]) = heat.shared.or_else(|| inner_range(values)) else {
        return;
    };
    let bar = [area.right() + 12.0, area.top, 10.0, area.height];
    let upwards = [bar[1] + bar[3], bar[1]];
    let scale = match heat.shared {
        Some(ends) => Scale::logarithmic(ends, upwards),
        None => Scale::linear([low, high], upwards),
    };
    let suffix = match heat.unit {
        Unit::One => String::new(),
        unit => format!(" {unit}"),
    };
    for (row, (values, counts)) in values.iter().zip(counts).enumerate() {
        for (column, (value, n)) in values.iter().zip(counts).enumerate() {
            let Some(value) = value else { continue };
            let [left, bottom] = panel.at(x_mm[column], y_mm[row]);
            let [right, top] = panel.at(x_mm[column + 1], y_mm[row + 1]);
            let share = match heat.shared {
                Some(_) => (scale.at(*value) - upwards[0]) / (upwards[1] - upwards[0]),
                None => (value - low) / (high - low).max(f64::MIN_POSITIVE),
            };
            let words = format!(
                "{} at ({}, {}) mm: {}{suffix}, n = {n}",
                heat.what,
                numeral(f64::midpoint(x_mm[column], x_mm[column + 1])),
                numeral(f64::midpoint(y_mm[row], y_mm[row + 1])),
                numeral(*value)
            );
            // Slightly wider, to hide the seam between neighbours.
            let place = [left, top, right - left + 0.3, bottom - top + 0.3];
            canvas.fill(place, Ink::Rgb(sequential(share)), words);
        }
    }
    colour_bar(bar, scale, &axis_label(heat.what, heat.unit), canvas);
}

/// Draws a bar with the colours from the least to the greatest number.
pub(super) fn colour_bar(
    [left, top, width, height]: [f64; 4],
    scale: Scale,
    label: &str,
    canvas: &mut Canvas,
) {
    const STEPS: u32 = 40;
    for step in 0..STEPS {
        let share = f64::from(step) / f64::from(STEPS);
        let piece = height / f64::from(STEPS);
        let y = top + height - f64::from(step + 1) * piece;
        canvas.fill(
            [left, y, width, piece + 0.4],
            Ink::Rgb(sequential(share)),
            String::new(),
        );
    }
    for tick in scale.ticks(4.0) {
        let at = [left + width + 5.0, scale.at(tick.value) + 4.0];
        canvas.label(Label::new(at, tick.label, Anchor::Start));
    }
    let at = [left + width / 2.0, top - 9.0];
    canvas.label(Label::new(at, label, Anchor::Middle));
}

/// Range from the 2nd to the 98th percentile. Single extreme cells do not affect the range. `None` for no value.
pub(super) fn inner_range(values: &[Vec<Option<f64>>]) -> Option<[f64; 2]> {
    let mut known: Vec<f64> = values.iter().flatten().flatten().copied().collect();
    known.sort_by(f64::total_cmp);
    let last = known.len().checked_sub(1)?;
    let cut = last / 50;
    Some([known[cut], known[last - cut]])
}
