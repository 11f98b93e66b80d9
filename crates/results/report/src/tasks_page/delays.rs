//! Histogram of the delays of matched onsets.

use maud::Markup;
use taceva_core::{counted, whole_size};
use taceva_tasks::TaskScores;

use crate::figure::{Area, Axes, Canvas, Figure, Ink, Panel, Scale, extent};
use crate::html::drawn;
use crate::number::numeral;

/// Number of bins.
const BINS: usize = 20;

pub(super) fn part(task: &TaskScores, at: usize) -> Option<Markup> {
    figure(task, at).map(|figure| drawn(&figure))
}

fn figure(task: &TaskScores, at: usize) -> Option<Figure> {
    let delays = &task.evidence.delays_s;
    let ends = extent(delays.iter().copied())?;
    let mut canvas = Canvas::new(560.0, 340.0);
    let area = Area {
        left: 62.0,
        top: 20.0,
        width: 470.0,
        height: 250.0,
    };
    let x = Scale::padded(ends, area.across());
    let [low, high] = x.values();
    let counts = histogram(delays, [low, high]);
    let most = counts.iter().max().copied().unwrap_or_default();
    let panel = Panel {
        area,
        x,
        y: Scale::round([0.0, most as f64], area.upwards()),
    };
    let axes = Axes {
        title: String::new(),
        x: "delay (s), negative where the prediction is early".to_owned(),
        y: "onsets".to_owned(),
    };
    panel.axes(&axes, &mut canvas);
    let edge = |bin: usize| low + (high - low) * (bin as f64 / BINS as f64);
    for (bin, count) in counts.iter().enumerate().filter(|(_, count)| **count > 0) {
        let [left, top] = panel.at(edge(bin), *count as f64);
        let [right, bottom] = panel.at(edge(bin + 1), 0.0);
        let place = [left + 0.5, top, right - left - 1.0, bottom - top];
        let words = format!(
            "{} … {} s: {}",
            numeral(edge(bin)),
            numeral(edge(bin + 1)),
            counted(*count, "onset")
        );
        canvas.fill(place, Ink::Series(0), words);
    }
    let matched = counted(delays.len(), "matched onset");
    Some(Figure {
        id: format!("delays-{at}"),
        title: format!("Delays of {}", task.name),
        caption: format!(
            "Time from the true to the predicted onset, of {matched}. Onsets without a match have no delay."
        ),
        description: format!(
            "Histogram of the delays of {matched} of {}, from {} to {} s.",
            task.name,
            numeral(ends[0]),
            numeral(ends[1])
        ),
        canvas,
    })
}

/// Number of values in each bin.
fn histogram(values: &[f64], [low, high]: [f64; 2]) -> Vec<usize> {
    let mut counts = vec![0; BINS];
    for value in values {
        let place = (value - low) / (high - low) * BINS as f64;
        counts[whole_size(place).min(BINS - 1)] += 1;
    }
    counts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_delay_is_in_one_bin_and_the_greatest_in_the_last() {
        let counts = histogram(&[-0.1, 0.0, 0.0, 0.1], [-0.1, 0.1]);
        assert_eq!((counts[0], counts[BINS / 2], counts[BINS - 1]), (1, 2, 1));
        assert_eq!(counts.iter().sum::<usize>(), 4);
    }
}
