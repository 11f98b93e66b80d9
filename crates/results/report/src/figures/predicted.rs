//! Predicted against true values: one panel per channel, one figure per sensor.

use crate::figure::{
    Area, Axes, Canvas, Figure, Grid, Ink, Panel, Points, Scale, Stroke, axis_label, extent, short,
};
use crate::number::numeral;
use crate::results::Study;
use taceva_results::{SampleChannel, Samples};

use super::SIX;
use super::thin::{rule, thin};

/// Limit of dots in a panel: more would overlap and enlarge the page.
const MOST: usize = 400;

pub(super) fn draw(studies: &[Study]) -> Vec<Option<Figure>> {
    let names = crate::names::names(studies);
    let figures = studies.iter().zip(&names).enumerate();
    figures
        .map(|(at, (study, name))| one(study, at, name))
        .collect()
}

fn one(study: &Study, at: usize, name: &str) -> Option<Figure> {
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
    let grid = Grid::new(channels.len(), 3, first, [66.0, 78.0]);
    let mut canvas = grid.canvas([16.0, 42.0]);
    let mut drawn = String::new();
    for (position, channel) in channels.iter().enumerate() {
        let area = grid.area(position);
        let (all, shown) = panel(samples, &rows, *channel, area, at, &mut canvas)?;
        if position == 0 {
            drawn = rule(shown, all);
        }
    }
    Some(Figure {
        id: format!("predicted-{}", at + 1),
        title: format!("{}: predicted against true", short(name, 60)),
        caption: format!(
            "Samples that the model has not seen, by channel; on the line prediction and truth are equal. {drawn}."
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

/// The six channels, if present; otherwise the first nine of any name.
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
        x: Scale::linear(ends, area.across()),
        y: Scale::linear(ends, area.upwards()),
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
        Stroke::thin(Ink::Muted),
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
    canvas.points(points, Ink::Series(at), 2.3, 0.55);
    Some((pairs.len(), drawn.len()))
}
