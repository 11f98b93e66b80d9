//! Curve of precision and recall, with the precision of predicting every sample as positive.

use maud::Markup;
use taceva_tasks::TaskScores;

use super::counts;
use crate::figure::{Anchor, Area, Axes, Canvas, Figure, Ink, Label, Panel, Scale, Stroke};
use crate::html::drawn;
use crate::number::numeral;

/// Greatest number of drawn points.
const MOST_POINTS: usize = 1_000;

pub(super) fn part(task: &TaskScores, at: usize) -> Option<Markup> {
    figure(task, at).map(|figure| drawn(&figure))
}

fn figure(task: &TaskScores, at: usize) -> Option<Figure> {
    let curve = &task.evidence.curve;
    let prevalence = task.evidence.prevalence?;
    let last = curve.len().checked_sub(1)?;
    let mut canvas = Canvas::new(560.0, 440.0);
    let area = Area {
        left: 62.0,
        top: 20.0,
        width: 470.0,
        height: 360.0,
    };
    let panel = Panel {
        area,
        x: Scale::linear([0.0, 1.0], area.across()),
        y: Scale::linear([0.0, 1.0], area.upwards()),
    };
    let axes = Axes {
        title: String::new(),
        x: "recall".to_owned(),
        y: "precision".to_owned(),
    };
    panel.axes(&axes, &mut canvas);
    let y = panel.y.at(prevalence);
    let dashed = Stroke {
        dash: "4 3",
        ..Stroke::thin(Ink::Muted)
    };
    canvas.line([area.left, y], [area.right(), y], dashed);
    let words = format!("prevalence {}: all positive", numeral(prevalence));
    canvas.label(Label::new([area.left + 6.0, y - 5.0], words, Anchor::Start));
    // Steps, because no threshold reaches the precisions between two points.
    let step = curve.len().div_ceil(MOST_POINTS);
    let mut points = Vec::new();
    let mut recall = 0.0;
    for (number, point) in curve.iter().enumerate() {
        if number % step == 0 || number == last {
            points.push(panel.at(recall, point.precision));
            points.push(panel.at(point.recall, point.precision));
            recall = point.recall;
        }
    }
    canvas.path(points, Stroke::series(0));
    let thinned = match step {
        1 => String::new(),
        step => format!(" One of {step} points is drawn."),
    };
    Some(Figure {
        id: format!("precision-recall-{at}"),
        title: format!("Precision and recall of {}", task.name),
        caption: format!(
            "Precision at each threshold, from the greatest score on. Dashed: the share of positive samples, which is the precision of predicting \
             all as positive. {}.{thinned}",
            counts(task)
        ),
        description: format!(
            "Curve of precision against recall of {}; the prevalence is {}.",
            task.name,
            numeral(prevalence)
        ),
        canvas,
    })
}
