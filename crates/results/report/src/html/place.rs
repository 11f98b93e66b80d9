//! Truth and prediction of a sample from above, in one circle for each sensor.

use maud::Markup;

use super::figures::drawing;
use super::picks::Pick;
use crate::figure::{Anchor, Canvas, Figure, Ink, Label, Points, Stroke};
use crate::figures::SIX;
use crate::number::numeral;
use taceva_results::Samples;

/// Side of the drawing, in SVG units.
const SIZE: f64 = 160.0;
/// Length of the arrow for the greatest shear force, in SVG units.
const LONGEST: f64 = 34.0;

/// Scale from the positions of one sensor to the drawing.
pub(super) struct Place {
    study: usize,
    reach_mm: f64,
    force_n: f64,
}

impl Place {
    /// Scale that contains all true positions and the predicted positions of `picks`; `None` if a channel of the plane is missing.
    pub(super) fn of(samples: &Samples, picks: &[Pick], study: usize) -> Option<Place> {
        let greatest = |names: [&str; 2]| {
            let channels = names.into_iter().filter_map(|name| samples.channel(name));
            let truths = channels.flat_map(|channel| channel.truths());
            truths.fold(1e-9_f64, |most, value| most.max(value.abs()))
        };
        let plane = [SIX[0], SIX[1]].map(|name| samples.channel(name));
        let [Some(x), Some(y)] = plane else {
            return None;
        };
        let predicted = picks.iter().flat_map(|pick| {
            let pairs = [x, y]
                .into_iter()
                .filter_map(|channel| channel.pair(pick.row));
            pairs.map(|[_, predicted]| predicted.abs())
        });
        Some(Place {
            study,
            reach_mm: predicted.fold(greatest([SIX[0], SIX[1]]), f64::max),
            force_n: greatest([SIX[3], SIX[4]]),
        })
    }

    /// Circle with the true and the predicted position; empty if a position is unknown.
    pub(super) fn draw(&self, samples: &Samples, pick: &Pick) -> Markup {
        let pair = |name: &str| samples.channel(name)?.pair(pick.row);
        let (Some([true_x, predicted_x]), Some([true_y, predicted_y])) =
            (pair(SIX[0]), pair(SIX[1]))
        else {
            return Markup::default();
        };
        let middle = SIZE / 2.0;
        let mut canvas = Canvas::new(SIZE, SIZE);
        let scale = (middle - 12.0) / self.reach_mm;
        let spot = |x: f64, y: f64| [middle + x * scale, middle - y * scale];
        canvas.path(
            circle([middle; 2], self.reach_mm * scale),
            Stroke::thin(Ink::Muted),
        );
        let shear = [pair(SIX[3]), pair(SIX[4])];
        let ends = [spot(true_x, true_y), spot(predicted_x, predicted_y)];
        let inks = [Ink::Text, Ink::Series(self.study)];
        for (which, (from, ink)) in ends.iter().zip(inks).enumerate() {
            if let [Some(x), Some(y)] = shear {
                let to = [
                    from[0] + x[which] / self.force_n * LONGEST,
                    from[1] - y[which] / self.force_n * LONGEST,
                ];
                let stroke = Stroke {
                    width: 2.0,
                    ..Stroke::thin(ink)
                };
                canvas.line(*from, to, stroke);
            }
        }
        let ring = Stroke {
            width: 1.8,
            ..Stroke::thin(Ink::Text)
        };
        canvas.path(circle(ends[0], 6.0), ring);
        let dot = Points {
            at: vec![ends[1]],
            words: Vec::new(),
        };
        canvas.points(dot, Ink::Series(self.study), 4.0, 1.0);
        canvas.label(Label::new(
            [SIZE - 2.0, SIZE - 3.0],
            format!("± {} mm", numeral(self.reach_mm)),
            Anchor::End,
        ));
        let figure = Figure {
            id: format!("place-{}-{}", self.study, pick.row),
            title: "True and predicted place".to_owned(),
            caption: String::new(),
            description: format!(
                "True place ({}, {}) mm, predicted ({}, {}) mm.",
                numeral(true_x),
                numeral(true_y),
                numeral(predicted_x),
                numeral(predicted_y)
            ),
            canvas,
        };
        drawing(&figure)
    }
}

fn circle([x, y]: [f64; 2], radius: f64) -> Vec<[f64; 2]> {
    let spot = |step: i32| {
        let angle = f64::from(step) * std::f64::consts::TAU / 48.0;
        [x + radius * angle.cos(), y + radius * angle.sin()]
    };
    (0..=48).map(spot).collect()
}
