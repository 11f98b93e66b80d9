//! Channels whose predictions are probably in another unit than the truth.

use taceva_results::{Interval, Score};

use super::Note;

/// Metric with the line through predictions over truth.
const LINE: &str = "linearity";

/// Ratio of units with neighbouring prefixes, such as m and mm.
const THOUSAND: f64 = 1000.0;

/// Greatest factor between an end of the interval of the slope and a thousand, or a thousandth.
const FACTOR: f64 = 1.5;

impl Note {
    /// Notes on channels whose predictions follow the truth at about a thousand times its size, or a thousandth.
    ///
    /// The whole interval of the slope decides, so that a model that predicts near zero has no note.
    pub(crate) fn likely_units(scores: &[Score]) -> Vec<Note> {
        let lines = scores.iter();
        let lines = lines.filter(|score| score.metric == LINE && score.of.is_empty());
        lines.filter_map(likely_unit).collect()
    }
}

fn likely_unit(line: &Score) -> Option<Note> {
    let slope = line.variant("slope")?;
    let ends = slope.interval.as_ref().and_then(Interval::ends)?;
    let is_near = |scale: f64| {
        let range = scale / FACTOR..=scale * FACTOR;
        ends.iter().all(|end| range.contains(end))
    };
    let is_small = is_near(THOUSAND.recip());
    if !(is_small || is_near(THOUSAND)) {
        return None;
    }
    Some(Note::LikelyUnit {
        channel: line.channel.clone(),
        unit: line.variant("offset")?.unit,
        is_small,
    })
}
