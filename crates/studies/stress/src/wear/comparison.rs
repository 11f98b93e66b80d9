//! Differences of errors from the errors of the first recording of a gel.

use taceva_metrics::{Difference, Estimate, Sides, by_intervals};

use crate::difference::{ErrorDifference, decided};
use crate::report::ByChannel;
use crate::score::Scored;

/// Channel of a later recording.
struct Place<'a> {
    channel: &'a str,
    /// Position among the later recordings.
    later: usize,
}

/// Differences of the errors of each of `later` from the errors of `first`. The differences are one family of Holm's procedure.
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
