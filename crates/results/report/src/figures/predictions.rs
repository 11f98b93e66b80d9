//! Predicted against true values: one panel for each channel, one figure for each sensor.

use crate::figure::{
    Anchor, Area, Axes, Canvas, Figure, Grid, Ink, Label, Panel, Points, Scale, Stroke, axis_label,
    extent, short, width_of,
};
use crate::number::numeral;
use crate::results::Study;
use taceva_results::{SampleChannel, Samples};

use super::SIX;
use super::thin::{rule, thin};

/// Greatest number of dots in a panel. More dots would overlap and enlarge the page.
const MOST: usize = 400;

pub(super) fn draw(studies: &[Study], room: Option<f64>) -> Vec<Option<Figure>> {
    let names = crate::names::names(studies);
    let figures = studies.iter().zip(&names).enumerate();
    figures
        .map(|(at, (study, name))| one(study, at, name, room))
        .collect()
}

fn one(study: &Study, at: usize, name: &str, room: Option<f64>) -> Option<Figure> {
    let samples = study.samples.as_ref()?;
    let rows = samples.of_protocol("calibration");
    let channels: Vec<SampleChannel<'_>> = channels(samples)
        .into_iter()
        .filter(|channel| rows.iter().any(|row| channel.pair(*row).is_some()))
        .collect();
    if channels.is_empty() {
        return None;
    }
    let first = Area {
        left: 58.0,
        top: 34.0,
        width: 216.0,
        height: 196.0,
    };
    let grid = Grid::new(channels.len(), 3, first, [66.0, 78.0]).within(room, 16.0);
    let mut canvas = grid.canvas([16.0, 42.0]);
    let mut drawn = String::new();
    for (position, channel) in channels.iter().enumerate() {
        let area = grid.area(position);
        let (all, shown) = panel(study, samples, &rows, *channel, area, at, &mut canvas)?;
        if position == 0 {
            drawn = rule(shown, all);
        }
    }
    Some(Figure {
        id: format!("predicted-{}", at + 1),
        title: format!("{}: predicted against true", short(name, 60)),
        caption: format!(
            "Samples that the model has not seen, by channel. On the dashed line, prediction and truth are equal. n is the number of samples, R² the score of the channel. {drawn}."
        ),
        description: format!(
            "Predicted over true values of {} for {}.",
            channels
                .iter()
                .map(|channel| channel.name)
                .collect::<Vec<_>>()
                .join(", "),
            short(name, 60)
        ),
        canvas,
    })
}

/// Channels of the sample table, at most nine: positions and forces first, then other channels.
fn channels(samples: &Samples) -> Vec<SampleChannel<'_>> {
    let six: Vec<SampleChannel<'_>> = SIX
        .into_iter()
        .filter_map(|name| samples.channel(name))
        .collect();
    let others = samples.channels().into_iter();
    let others = others.filter(|channel| !SIX.contains(&channel.name));
    six.into_iter().chain(others).take(9).collect()
}

fn panel(
    study: &Study,
    samples: &Samples,
    rows: &[usize],
    channel: SampleChannel<'_>,
    area: Area,
    at: usize,
    canvas: &mut Canvas,
) -> Option<(usize, usize)> {
    let pairs: Vec<(usize, [f64; 2])> = rows
        .iter()
        .filter_map(|row| Some((*row, channel.pair(*row)?)))
        .collect();
    let ends = extent(pairs.iter().flat_map(|(_, pair)| *pair))?;
    let panel = Panel {
        area,
        x: Scale::padded(ends, area.across()),
        y: Scale::padded(ends, area.upwards()),
    };
    let label = |what: &str| {
        axis_label(
            &format!("{what} {}", short(channel.name, 16)),
            channel.unit(),
        )
    };
    let axes = Axes {
        title: short(channel.name, 24),
        x: label("true"),
        y: label("predicted"),
    };
    panel.axes(&axes, canvas);
    let [low, high] = panel.x.values();
    canvas.line(
        panel.at(low, low),
        panel.at(high, high),
        Stroke {
            dash: "4 3",
            ..Stroke::thin(Ink::Muted)
        },
    );
    let errors: Vec<f64> = pairs
        .iter()
        .map(|(_, [truth, prediction])| truth - prediction)
        .collect();
    let drawn = thin(&errors, MOST);
    let mut points = Points::default();
    for position in &drawn {
        let (row, [truth, prediction]) = pairs[*position];
        points.at.push(panel.at(truth, prediction));
        points.words.push(format!(
            "{}: true {}, predicted {}",
            short(samples.word(Samples::KEY, row).unwrap_or("?"), 40),
            numeral(truth),
            numeral(prediction)
        ));
    }
    let shared = format!("n = {}", pairs.len());
    let r2 = study
        .score("r2", channel.name)
        .and_then(|score| score.value.number());
    let words = r2.map_or(shared.clone(), |r2| {
        format!("R² = {}, {shared}", numeral(r2))
    });
    let label = beside_points(words, area, &points.at);
    canvas.points(points, Ink::Series(at), 2.3, 0.55);
    canvas.label(label);
    Some((pairs.len(), drawn.len()))
}

/// Label in the upper left corner of `area`, or in the lower right corner if fewer points are there.
fn beside_points(words: String, area: Area, points: &[[f64; 2]]) -> Label {
    let upper = Label::new([area.left + 5.0, area.top + 11.0], words, Anchor::Start);
    let upper = Label {
        ink: Ink::Text,
        ..upper
    };
    let lower = Label {
        at: [area.right() - 5.0, area.bottom() - 5.0],
        anchor: Anchor::End,
        ..upper.clone()
    };
    let width = width_of(&upper.text, upper.size) + 5.0;
    let height = upper.size + 6.0;
    let count = |left: f64, top: f64| {
        let [right, bottom] = [left + width, top + height];
        let is_inside = |[x, y]: &&[f64; 2]| (left..right).contains(x) && (top..bottom).contains(y);
        points.iter().filter(is_inside).count()
    };
    let above = count(area.left, area.top);
    let below = count(area.right() - width, area.bottom() - height);
    if below < above { lower } else { upper }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_stand_in_the_corner_with_fewer_points() {
        let area = Area {
            left: 50.0,
            top: 30.0,
            width: 200.0,
            height: 200.0,
        };
        let corner = |points: &[[f64; 2]]| beside_points("n = 3".to_owned(), area, points).anchor;
        assert_eq!(corner(&[]), Anchor::Start);
        assert_eq!(corner(&[[60.0, 35.0]]), Anchor::End);
        assert_eq!(corner(&[[60.0, 35.0], [240.0, 225.0]]), Anchor::Start);
    }
}
