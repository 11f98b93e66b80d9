//! Distribution of the truth, channel by channel.

use crate::figure::{
    Area, Axes, Canvas, Figure, Grid, Panel, Points, Scale, Stroke, axis_label, extent,
};
use crate::figure::{Ink, SERIES};
use crate::number::numeral;
use crate::results::Study;
use taceva_core::whole_size;
use taceva_results::SampleChannel;

use super::SIX;

/// Number of bins of a histogram.
const BINS: usize = 24;

pub(super) fn draw(studies: &[Study], room: Option<f64>) -> Option<Figure> {
    let channels: Vec<&str> = SIX
        .into_iter()
        .filter(|name| studies.iter().any(|study| truths(study, name).is_some()))
        .collect();
    if channels.is_empty() {
        return None;
    }
    let names = crate::names::names(studies);
    let first = Area {
        left: 58.0,
        top: 54.0,
        width: 216.0,
        height: 150.0,
    };
    let grid = Grid::new(channels.len(), 3, first, [66.0, 78.0]).within(room, 16.0);
    let mut canvas = grid.canvas([16.0, 42.0]);
    if names.len() > 1 {
        let legend: Vec<(usize, String)> = names.iter().cloned().enumerate().collect();
        canvas.legend([first.left, 16.0], &legend);
    }
    for (position, channel) in channels.iter().enumerate() {
        let area = grid.area(position);
        panel(studies, channel, area, &names, &mut canvas);
    }
    Some(Figure {
        id: "labels".to_owned(),
        title: "Label distributions".to_owned(),
        caption: format!(
            "Labels of the presses for training and test: share in each of {BINS} bins, from the least to the greatest label of all {}s shown.",
            crate::names::noun(studies)
        ),
        description: format!(
            "Histograms of the true {} of {}.",
            channels.join(", "),
            crate::names::listed(&names)
        ),
        canvas,
    })
}

fn panel(
    studies: &[Study],
    channel: &str,
    area: Area,
    names: &[String],
    canvas: &mut Canvas,
) -> Option<()> {
    let truths: Vec<(usize, Vec<f64>, SampleChannel<'_>)> = studies
        .iter()
        .enumerate()
        .filter_map(|(at, study)| truths(study, channel).map(|(values, of)| (at, values, of)))
        .collect();
    let [low, high] = extent(
        truths
            .iter()
            .flat_map(|(_, values, _)| values.iter().copied()),
    )?;
    let x = Scale::linear([low, high], area.across());
    let [low, high] = x.values();
    let shares: Vec<Vec<f64>> = truths
        .iter()
        .map(|(_, values, _)| histogram(values, [low, high]))
        .collect();
    let most = extent(shares.iter().flatten().copied())?[1];
    let panel = Panel {
        area,
        x,
        y: Scale::round([0.0, most], area.upwards()),
    };
    let axes = Axes {
        title: channel.to_owned(),
        x: axis_label(channel, truths.first()?.2.unit()),
        y: "share of samples".to_owned(),
    };
    panel.axes(&axes, canvas);
    let edge = |bin: usize| low + (high - low) * share(bin, BINS);
    for ((at, values, _), shares) in truths.iter().zip(&shares) {
        let mut points = vec![panel.at(low, 0.0)];
        let mut tops = Points::default();
        for (bin, share) in shares.iter().enumerate() {
            points.push(panel.at(edge(bin), *share));
            points.push(panel.at(edge(bin + 1), *share));
            tops.at
                .push(panel.at(f64::midpoint(edge(bin), edge(bin + 1)), *share));
            tops.words.push(format!(
                "{}, {} … {}: {} % of n = {}",
                names[*at],
                numeral(edge(bin)),
                numeral(edge(bin + 1)),
                numeral(share * 100.0),
                values.len()
            ));
        }
        points.push(panel.at(high, 0.0));
        if studies.len() == 1 {
            canvas.area(points.clone(), Ink::Series(0), 0.25);
        }
        canvas.path(points, Stroke::series(at % SERIES));
        canvas.points(tops, Ink::Series(*at), 4.0, 0.0);
    }
    Some(())
}

/// Labels of a channel in the calibration phase, and the channel; `None` without labels.
fn truths<'a>(study: &'a Study, name: &str) -> Option<(Vec<f64>, SampleChannel<'a>)> {
    let samples = study.samples.as_ref()?;
    let channel = samples.channel(name)?;
    let rows = samples.of_protocol("calibration");
    let values: Vec<f64> = rows.iter().filter_map(|row| channel.truth(*row)).collect();
    (!values.is_empty()).then_some((values, channel))
}

/// Share of values in each bin.
fn histogram(values: &[f64], [low, high]: [f64; 2]) -> Vec<f64> {
    let mut counts = vec![0_usize; BINS];
    for value in values {
        let place = (value - low) / (high - low) * share(BINS, 1);
        counts[whole_size(place).min(BINS - 1)] += 1;
    }
    counts
        .into_iter()
        .map(|count| share(count, values.len()))
        .collect()
}

fn share(part: usize, whole: usize) -> f64 {
    part as f64 / whole as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_greatest_value_lies_in_the_last_bin() {
        let shares = histogram(&[0.0, 1.0, 1.0, 0.5], [0.0, 1.0]);
        assert!((shares[BINS - 1] - 0.5).abs() < 1e-12 && (shares[0] - 0.25).abs() < 1e-12);
    }
}
