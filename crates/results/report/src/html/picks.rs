//! Selects the best and worst predicted samples.

use std::collections::BTreeSet;

use crate::results::Study;
use taceva_results::{SampleChannel, Samples};

/// Number of best samples, and of worst samples, for each study.
const EACH: usize = 4;

/// Selected sample.
#[derive(Clone, Debug, PartialEq)]
pub struct Pick {
    /// Sample id.
    pub id: String,
    /// Row of the sample in the table of samples, from 0.
    pub row: usize,
    /// True for one of the worst samples, false for one of the best samples.
    pub is_worst: bool,
    /// Mean error over channels, as a share of the range of the true values.
    pub error: f64,
}

/// The four worst and the four best predicted samples of a study. Each pick is from another group of the split or contact point, because frames of one place
/// have similar errors. Fewer picks for few places; empty without samples.
pub fn picks(study: &Study) -> Vec<Pick> {
    let Some(samples) = &study.samples else {
        return Vec::new();
    };
    let channels: Vec<(SampleChannel<'_>, f64)> = samples
        .channels()
        .into_iter()
        .filter_map(|channel| Some((channel, range(channel)?)))
        .collect();
    let error = |row: usize| {
        let errors = channels.iter().filter_map(|(channel, range)| {
            let [truth, prediction] = channel.pair(row)?;
            Some((truth - prediction).abs() / range)
        });
        let (sum, count) =
            errors.fold((0.0, 0.0), |(sum, count), error| (sum + error, count + 1.0));
        (count > 0.0).then(|| sum / count)
    };
    let rows = samples.of_protocol("calibration");
    let mut errors: Vec<(usize, f64)> = rows
        .into_iter()
        .filter_map(|row| Some((row, error(row)?)))
        .collect();
    errors.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    let places = errors.iter().map(|(row, _)| place(samples, *row));
    let each = EACH.min(places.collect::<BTreeSet<_>>().len() / 2);
    let mut taken = BTreeSet::new();
    let worst = apart(samples, errors.iter(), each, &mut taken);
    let best = apart(samples, errors.iter().rev(), each, &mut taken);
    let pick = |is_worst: bool| {
        move |(row, error): (usize, f64)| Pick {
            id: samples
                .word(Samples::KEY, row)
                .unwrap_or_default()
                .to_owned(),
            row,
            is_worst,
            error,
        }
    };
    let worst = worst.into_iter().map(pick(true));
    worst.chain(best.into_iter().map(pick(false))).collect()
}

/// Group of the split of the sample in `row`, otherwise its contact point, otherwise the id of the sample.
fn place(samples: &Samples, row: usize) -> Option<&str> {
    samples
        .word(Samples::GROUP, row)
        .or_else(|| samples.word("point_id", row))
        .or_else(|| samples.word(Samples::KEY, row))
}

/// First row in `rows` of each place that is not yet in `taken`, at most `most` rows. Adds the places to `taken`.
fn apart<'a>(
    samples: &'a Samples,
    rows: impl Iterator<Item = &'a (usize, f64)>,
    most: usize,
    taken: &mut BTreeSet<&'a str>,
) -> Vec<(usize, f64)> {
    let mut found = Vec::new();
    for (row, error) in rows {
        let place = place(samples, *row);
        if found.len() < most && place.is_some_and(|place| taken.insert(place)) {
            found.push((*row, *error));
        }
    }
    found
}

/// Width of the range of the true values of predicted samples; `None` if fewer than two values differ.
fn range(channel: SampleChannel<'_>) -> Option<f64> {
    let pairs = (0..channel.rows()).filter_map(|row| channel.pair(row));
    let [low, high] = crate::figure::extent(pairs.map(|[truth, _]| truth))?;
    (high > low).then_some(high - low)
}
