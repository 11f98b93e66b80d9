//! Tested differences of the errors of later recordings from those of the first recording of a gel.

use taceva_metrics::{Difference, Estimate, Sides, by_intervals};

use crate::difference::{ErrorDifference, decided};
use crate::report::ByChannel;
use crate::score::Scored;

/// Channel and recording of a difference.
struct Place<'a> {
    channel: &'a str,
    /// Index of the recording among the later recordings.
    later: usize,
}

/// Differences of the errors of each of `later` from the errors of `first`. Holm's procedure tests all differences together.
pub(crate) fn differences(first: &Scored, later: &[&Scored]) -> Vec<ByChannel<ErrorDifference>> {
    let mut places: Vec<Place<'_>> = Vec::new();
    let mut tested: Vec<Result<Difference, String>> = Vec::new();
    for (position, of) in later.iter().enumerate() {
        for (channel, own) in &of.scores {
            let Some(before) = first.scores.get(channel) else {
                continue;
            };
            let both = Estimate::try_from_scores(Sides { a: own, b: before });
            let difference = both.and_then(by_intervals);
            tested.push(difference.map_err(|reason| reason.to_string()));
            places.push(Place {
                channel,
                later: position,
            });
        }
    }
    let mut found = vec![ByChannel::new(); later.len()];
    for (place, difference) in places.iter().zip(decided(tested)) {
        found[place.later].insert(place.channel.to_owned(), difference);
    }
    found
}
