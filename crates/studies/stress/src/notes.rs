//! Notes on the limitations of the numbers of a stress test.

use taceva_core::counted;
use taceva_metrics::LEAST_CLUSTERS;

use crate::fault::{Fault, Scope};
use crate::report::ByChannel;
use crate::score::{MAE, SKILL, Scored};
use crate::setup::StressRequest;

/// Notes on the limitations of the scores of `faults`. `clean` has the scores without a fault, of `samples` predicted samples.
pub(crate) fn notes(
    faults: &[&'static Fault],
    request: &StressRequest,
    clean: &Scored,
    samples: usize,
) -> Vec<String> {
    let drawn = faults.iter().filter(|fault| fault.scope == Scope::Drawn);
    let drawn: Vec<&str> = drawn.map(|fault| fault.id).collect();
    let (names, seed) = (drawn.join(", "), request.seed);
    let of_draws = (!drawn.is_empty()).then(|| match request.draws {
        1 => format!(
            "{names}: one draw of places, by seed {seed}; the interval excludes the variation between draws: repeat with --draws 5."
        ),
        draws => format!(
            "{names}: means over {draws} draws of places, by seed {seed}; the spread shows the variation between draws, which the interval does not include."
        ),
    });
    let lacks = |name: &&str| {
        let of = clean.others.get(*name);
        ![MAE, SKILL].contains(name) && of.is_none_or(ByChannel::is_empty)
    };
    let absent = request.metrics.iter().map(String::as_str).filter(lacks);
    let absent: Vec<&str> = absent.collect();
    let absent = (!absent.is_empty())
        .then(|| format!("No scored channel or plane has {}.", absent.join(", ")));
    let [intervals, labels] = of_scores(clean, samples);
    [intervals, of_draws, labels, absent]
        .into_iter()
        .flatten()
        .collect()
}

/// Notes on absent intervals and on absent labels in the scores of `samples` predicted samples; `None` for a note that does not apply.
pub(crate) fn of_scores(scored: &Scored, samples: usize) -> [Option<String>; 2] {
    let intervals = match scored.clusters() {
        Some(count) if count < LEAST_CLUSTERS => Some(format!(
            "No intervals: {}, {LEAST_CLUSTERS} are needed; a cluster is a contact point or a group.",
            counted(count, "cluster")
        )),
        Some(_) => None,
        None => Some("No intervals: the samples name no contact points.".to_owned()),
    };
    let counts = scored.names().map(|name| (name, scored.count(name)));
    let partial = counts.filter(|(_, count)| *count < samples as u64);
    let partial: Vec<String> = partial
        .map(|(name, count)| format!("{name} {count} of {samples}"))
        .collect();
    let labels = (!partial.is_empty()).then(|| {
        format!(
            "Not every sample has a label; scored samples: {}.",
            partial.join(", ")
        )
    });
    [intervals, labels]
}
