//! Grid of faults and severities. The colour and the number of a cell state the growth of the error.

use taceva_metrics::elementary::logarithm;

use crate::figure::{Anchor, Canvas, Figure, Ink, Label, Stroke, diverging, short};
use crate::number::significant;

/// Number of severities of a fault.
const SEVERITIES: usize = 5;
/// Ratio of errors at the end of the colour scale.
const MOST: f64 = 100.0;
/// Dimensions of a panel: left edge of its cells, space above them, size of a cell.
const LEFT: f64 = 118.0;
const ABOVE: f64 = 52.0;
const CELL: [f64; 2] = [66.0, 22.0];
/// Number of lines in a hatched cell.
const HATCHES: u32 = 6;

/// Errors with faults, relative to errors without faults.
#[derive(Clone, Debug)]
pub(crate) struct FaultGrid {
    /// Title of the figure.
    pub(crate) title: String,
    /// Caption: recording, model, conditions.
    pub(crate) caption: String,
    /// A panel for each channel.
    pub(crate) panels: Vec<FaultPanel>,
}

/// Errors of one channel.
#[derive(Clone, Debug)]
pub(crate) struct FaultPanel {
    /// Name of the channel.
    pub(crate) channel: String,
    /// Faults, from top to bottom.
    pub(crate) rows: Vec<FaultRow>,
}

/// Errors with one fault.
#[derive(Clone, Debug)]
pub(crate) struct FaultRow {
    /// Name of the fault.
    pub(crate) fault: String,
    /// Degradation at severities 1 to 5; `None` for a severity that was not tested, or without a ratio.
    pub(crate) degradation: [Option<f64>; 5],
    /// True for each severity of 1 to 5 that was skipped: the fault has no such severity, or the recording lacks required data.
    pub(crate) skipped: [bool; 5],
    /// First severity without skill, from 1; `None` if the skill remains.
    pub(crate) skill_ends: Option<u8>,
}

/// Draws a panel for each channel, one below the other.
pub(crate) fn fault_grid(grid: &FaultGrid) -> Figure {
    let heights = grid.panels.iter().map(height);
    let width = LEFT + SEVERITIES as f64 * CELL[0] + 12.0;
    let mut canvas = Canvas::new(width, heights.sum::<f64>().max(ABOVE));
    let mut top = 0.0;
    for panel in &grid.panels {
        draw(panel, top, &mut canvas);
        top += height(panel);
    }
    let channels: Vec<String> = grid.panels.iter().map(|of| of.channel.clone()).collect();
    let caption = format!(
        "{} Numbers: error with the fault, divided by the error without it. A bar marks the first severity without skill; hatched means skipped, – means not tested.",
        grid.caption
    );
    Figure {
        id: "faults".to_owned(),
        title: grid.title.clone(),
        description: format!(
            "Growth of the errors of {} by fault and severity. {caption}",
            crate::names::listed(&channels)
        ),
        caption,
        canvas,
    }
}

fn height(panel: &FaultPanel) -> f64 {
    ABOVE + panel.rows.len() as f64 * CELL[1] + 14.0
}

fn draw(panel: &FaultPanel, top: f64, canvas: &mut Canvas) {
    let [width, height] = CELL;
    let heading = Label::new([LEFT, top + 18.0], panel.channel.as_str(), Anchor::Start);
    canvas.label(heading.heading());
    let at = [LEFT - 7.0, top + ABOVE - 8.0];
    canvas.label(Label::new(at, "severity", Anchor::End));
    for column in 0..SEVERITIES {
        let x = LEFT + (column as f64 + 0.5) * width;
        let name = (column + 1).to_string();
        canvas.label(Label::new([x, top + ABOVE - 8.0], name, Anchor::Middle));
    }
    for (row, of) in panel.rows.iter().enumerate() {
        let y = top + ABOVE + row as f64 * height;
        let base = y + height / 2.0 + 4.0;
        let name = short(&of.fault, 18);
        canvas.label(Label::new([LEFT - 7.0, base], name, Anchor::End));
        for (column, ratio) in of.degradation.iter().enumerate() {
            let x = LEFT + column as f64 * width;
            let middle = [x + width / 2.0, base];
            let cell = format!("{}, severity {}", of.fault, column + 1);
            let place = [x + 1.0, y + 1.0, width - 2.0, height - 2.0];
            let Some(ratio) = ratio else {
                match of.skipped[column] {
                    true => hatch(place, format!("{cell}: skipped"), canvas),
                    false => canvas.label(Label::new(middle, "–", Anchor::Middle)),
                }
                continue;
            };
            let number = significant(*ratio);
            let words = format!("{cell}: {number}");
            canvas.fill(place, Ink::Rgb(diverging(share(*ratio))), words);
            canvas.cell_label(Label::new(middle, number, Anchor::Middle));
        }
        if let Some(severity) = of.skill_ends {
            let x = LEFT + (f64::from(severity) - 1.0) * width;
            let bar = Stroke {
                width: 3.0,
                ..Stroke::thin(Ink::Text)
            };
            canvas.line([x, y], [x, y + height], bar);
        }
    }
}

/// Fills `place` (left, top, width and height) with slanted lines and the tooltip `words`.
fn hatch(place: [f64; 4], words: String, canvas: &mut Canvas) {
    let [left, top, width, height] = place;
    canvas.fill(place, Ink::Paper, words);
    let step = (width - height) / f64::from(HATCHES - 1);
    for line in 0..HATCHES {
        let x = left + f64::from(line) * step;
        let stroke = Stroke::thin(Ink::Grid);
        canvas.line([x, top + height], [x + height, top], stroke);
    }
}

/// Place of a ratio on the scale of colours: 0 for an unchanged error, 1 for a hundred times the error.
fn share(ratio: f64) -> f64 {
    match ratio > 0.0 {
        true => (logarithm(ratio) / logarithm(MOST)).clamp(-1.0, 1.0),
        false => -1.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_cell_has_its_number_and_the_colour_of_its_growth() {
        let row = |fault: &str, degradation| FaultRow {
            fault: fault.to_owned(),
            degradation,
            skipped: [false, false, false, false, true],
            skill_ends: Some(3),
        };
        let drawn = fault_grid(&FaultGrid {
            title: "Faults".to_owned(),
            caption: "Drawn.".to_owned(),
            panels: vec![FaultPanel {
                channel: "Fz".to_owned(),
                rows: vec![
                    row("tear", [Some(1.0), Some(4.0), Some(100.0), None, None]),
                    row("dust", [None; 5]),
                ],
            }],
        });
        let svg = drawn.svg();
        for title in [
            "tear, severity 1: 1",
            "tear, severity 2: 4",
            "tear, severity 3: 100",
            "tear, severity 5: skipped",
        ] {
            assert!(svg.contains(title), "{title} in {svg}");
        }
        let absent = svg.matches(">–<").count();
        assert_eq!(absent, 5, "{svg}");
        assert!(share(1.0).abs() < 1e-12 && (share(1000.0) - 1.0).abs() < 1e-12);
        assert!(share(0.0) < 0.0 && share(0.5) < 0.0);
    }
}
