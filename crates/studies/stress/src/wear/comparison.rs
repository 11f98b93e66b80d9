//! Differences of errors from the errors of the first recording of a gel.

use taceva_metrics::{ComparisonError, Difference, Estimate, Sides, by_intervals, decide};

use crate::report::ByChannel;
use crate::score::Scored;
use crate::wear::report::WearDifference;

/// A channel of a later recording, with its difference from the first.
struct Compared<'a> {
    channel: &'a str,
    /// Position among the later recordings.
    later: usize,
    difference: Result<Difference, ComparisonError>,
}

/// Differences of the errors of each of `later` from the errors of `first`. The differences are one family of Holm's procedure.
pub(crate) fn differences(first: &Scored, later: &[&Scored]) -> Vec<ByChannel<WearDifference>> {
    let mut all: Vec<Compared<'_>> = Vec::new();
    for (position, of) in later.iter().enumerate() {
        for (channel, own) in &of.scores {
            let Some(before) = first.scores.get(channel) else {
                continue;
            };
            let both = Estimate::try_from_scores(Sides { a: own, b: before });
            all.push(Compared {
                channel,
                later: position,
                difference: both.and_then(by_intervals),
            });
        }
    }
    let tested = all.iter().filter_map(|of| of.difference.as_ref().ok());
    let mut family: Vec<Difference> = tested.cloned().collect();
    decide(&mut family);
    let mut decided = family.iter();
    let mut found = vec![ByChannel::new(); later.len()];
    for of in &all {
        let difference = match &of.difference {
            Ok(_) => decided.next().map_or_else(WearDifference::default, shown),
            Err(reason) => WearDifference {
                reason: Some(reason.to_string()),
                ..WearDifference::default()
            },
        };
        found[of.later].insert(of.channel.to_owned(), difference);
    }
    found
}

fn shown(of: &Difference) -> WearDifference {
    WearDifference {
        value: Some(of.value),
        interval: Some(of.interval),
        confidence: Some(of.confidence),
        p: Some(of.adjusted_p),
        is_shown: of.is_shown,
        reason: None,
    }
}
