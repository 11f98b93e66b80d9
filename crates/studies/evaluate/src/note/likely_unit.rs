//! Channels whose predictions are probably in another unit than the truth.

use taceva_results::{Interval, Score};

use super::Note;

/// Name of the metric that fits a line to the predictions against the truth.
const LINE: &str = "linearity";

/// Ratios of units with neighbouring prefixes, such as m and mm.
const RATIOS: [f64; 2] = [1e-3, 1e3];

/// Greatest factor by which an end of the slope's interval may differ from one of [`RATIOS`].
const FACTOR: f64 = 1.5;

impl Note {
    /// Notes on channels whose predictions are about 1000 times the truth, or 1/1000 of the truth.
    ///
    /// Both ends of the interval of the slope must be near the ratio, so a model that predicts near zero gets no note. A model that predicts near the
    /// mean of the truth gets no note either, because its line passes far from zero.
    pub(crate) fn likely_units(scores: &[Score]) -> Vec<Note> {
        let lines = scores.iter();
        let lines = lines.filter(|score| score.metric == LINE && score.of.is_empty());
        lines.filter_map(likely_unit).collect()
    }
}

fn likely_unit(line: &Score) -> Option<Note> {
    let slope = line.variant("slope")?;
    let ends = slope.interval.as_ref().and_then(Interval::ends)?;
    let is_near = |ratio: &f64| {
        let range = ratio / FACTOR..=ratio * FACTOR;
        ends.iter().all(|end| range.contains(end))
    };
    let ratio = RATIOS.into_iter().find(is_near)?;
    let offset = line.variant("offset")?;
    if offset.value.number()?.abs() > ratio * range_of_truth(line)? {
        return None;
    }
    Some(Note::LikelyUnit {
        channel: line.channel.clone(),
        unit: offset.unit,
        is_small: ratio < 1.0,
    })
}

/// Range of the truth: the greatest deviation from the line, divided by the linearity. NaN if all predictions lie on the line. `None` if either
/// number is missing.
fn range_of_truth(line: &Score) -> Option<f64> {
    let greatest = line.variant("greatest_deviation")?.value.number()?;
    Some(greatest / line.value.number()?)
}
